//! Keeps what the integrator finds out about one pixel.
//!
//! The rays of a pixel's point are traced by the very steps of a render, in batches of one. After each level is lit, and
//! again when it is finished, the recorder reads what the frame holds, works out each light's part by the same functions
//! that lit it, and checks that the parts add up to what the step found, to the bit.

use super::frame::{Background, Frame, NOTHING};
use super::light::{self, Parts};
use super::solid::Walk;
use super::{Integrator, Scratch};
use crate::Control;
use crate::explain::{
    ExplainedHit, ExplainedRay, Followed, LightPart, MAX_EXPLAINED_RAYS, ObjectId, RayKind, Reach, Seen, same,
};
use fearless_simd::dispatch;
use hray_core::{DVec3, Light, Primitive, Rgb};
use std::collections::BTreeMap;

/// Which object the leaves of the geometry belong to.
#[derive(Clone, Default)]
pub(crate) struct Owners {
    /// The first leaf of each primitive, from the last primitive to the first, as the geometry has them.
    first: Vec<u32>,
    /// Whether each is made of others.
    solid: Vec<bool>,
}

impl Owners {
    pub(crate) fn of(primitives: &[Primitive]) -> Self {
        let mut owners = Self::default();
        let mut leaves = 0;
        for primitive in primitives.iter().rev() {
            owners.first.push(leaves);
            let is_solid = primitive.shape.is_made_of_others();
            owners.solid.push(is_solid);
            leaves += if is_solid { primitive.leaves().count() as u32 } else { 1 };
        }
        owners
    }

    fn owner(&self, leaf: usize) -> ObjectId {
        let after = self.first.partition_point(|&first| first as usize <= leaf);
        let at = after.saturating_sub(1);
        let part = leaf - self.first.get(at).map_or(0, |&first| first as usize);
        let is_solid = self.solid.get(at).copied().unwrap_or(false);
        ObjectId { primitive: self.first.len() - 1 - at, part: is_solid.then_some(part) }
    }
}

/// What is kept of a pixel.
pub(crate) struct Recorder {
    what: What,
}

enum What {
    /// What the samples of the pixel see, by leaves.
    Samples(BTreeMap<Option<u32>, u32>),
    Rays(Box<Rays>),
}

/// The rays of one point.
struct Rays {
    owners: Owners,
    list: Vec<ExplainedRay>,
    omitted: u64,
    /// Rays are kept up to this level.
    deepest: usize,
    /// How many rays there are at each level.
    levels: Vec<u64>,
    /// The rays that are not finished, each led to by the one before.
    open: Vec<Open>,
    /// Of what kind the next ray is.
    next: RayKind,
    /// Whether everything added up so far.
    adds_up: bool,
    /// For shadow rays.
    shadow: Frame,
}

/// A ray that is not finished.
struct Open {
    /// Its place among the rays, where it is kept.
    place: Option<usize>,
    kind: RayKind,
    /// The sum of what its hit gives off, so far.
    sum: Rgb,
    weight: f64,
    /// By the exact rules: the normal of the hit on the side of the viewer.
    side: DVec3,
    /// What its mirrored and its refracted ray are multiplied with.
    shares: [f64; 2],
}

impl Recorder {
    /// Of what the samples of a pixel see.
    pub(crate) fn of_samples() -> Self {
        Self { what: What::Samples(BTreeMap::new()) }
    }

    /// Of the rays of a single point, down to a level.
    pub(crate) fn of_rays(owners: Owners, deepest: usize) -> Self {
        let rays = Rays {
            owners,
            list: Vec::new(),
            omitted: 0,
            deepest,
            levels: Vec::new(),
            open: Vec::new(),
            next: RayKind::Camera,
            adds_up: true,
            shadow: Frame::new(),
        };
        Self { what: What::Rays(Box::new(rays)) }
    }

    /// What the samples saw, what most of them saw first.
    pub(crate) fn seen(self, owners: &Owners) -> Vec<Seen> {
        let What::Samples(counts) = self.what else { return Vec::new() };
        let mut by_object = BTreeMap::<Option<ObjectId>, u32>::new();
        for (leaf, samples) in counts {
            *by_object.entry(leaf.map(|leaf| owners.owner(leaf as usize))).or_default() += samples;
        }
        let mut seen: Vec<Seen> =
            by_object.into_iter().map(|(object, samples)| Seen { object, samples }).collect();
        seen.sort_by_key(|seen| std::cmp::Reverse(seen.samples));
        seen
    }

    /// Where rays had to be left out: the deepest level down to which all can be kept.
    pub(crate) fn deepest_that_fits(&self) -> Option<usize> {
        let What::Rays(rays) = &self.what else { return None };
        let mut total = 0u64;
        let fits = rays.levels.iter().take_while(|count| {
            total = total.saturating_add(**count);
            total <= MAX_EXPLAINED_RAYS as u64
        });
        let fits = fits.count();
        (rays.omitted > 0).then_some(fits.saturating_sub(1))
    }

    /// The rays, and how many were left out; none where they do not add up.
    pub(crate) fn rays(self) -> Option<(Vec<ExplainedRay>, u64)> {
        match self.what {
            What::Rays(rays) if rays.adds_up => Some((rays.list, rays.omitted)),
            _ => None,
        }
    }

    /// Says of what kind the rays of the next level are.
    pub(super) fn next_is(&mut self, kind: RayKind) {
        if let What::Rays(rays) = &mut self.what {
            rays.next = kind;
        }
    }

    /// Reads a frame whose hits have been lit, at `level` below the camera.
    pub(super) fn lit(
        &mut self,
        scene: &Integrator,
        frame: &Frame,
        [level, depth_left]: [usize; 2],
        walk: &mut Walk,
        control: &Control,
    ) {
        match &mut self.what {
            What::Samples(counts) if level == 0 => {
                for ray in 0..frame.len {
                    *counts.entry(leaf_of(frame, ray)).or_default() += 1;
                }
            }
            What::Samples(_) => {}
            What::Rays(rays) => rays.lit(scene, frame, [level, depth_left], walk, control),
        }
    }

    /// Reads a frame whose colours are final.
    pub(super) fn finished(&mut self, frame: &Frame) {
        if let What::Rays(rays) = &mut self.what {
            rays.finished(frame);
        }
    }
}

impl Scratch {
    /// Keeps from now on what a recorder wants of all points that are traced. One of rays must be given a single point.
    pub(crate) fn record(&mut self, recorder: Recorder) {
        self.recorder = Some(recorder);
    }

    /// Gives the recorder back.
    pub(crate) fn recorded(&mut self) -> Option<Recorder> {
        self.recorder.take()
    }
}

/// The leaf that a ray of a frame meets.
fn leaf_of(frame: &Frame, ray: usize) -> Option<u32> {
    let [_, leaves, _] = frame.nearest.get();
    let number = (leaves.get(ray)?.to_bits() - NOTHING.to_bits()) as u32;
    number.checked_sub(1)
}

fn vector(columns: [&[f64]; 3]) -> DVec3 {
    DVec3::from_array(columns.map(|column| column.first().copied().unwrap_or(0.0)))
}

fn color(columns: [&[f64]; 3]) -> Rgb {
    Rgb::from(vector(columns).to_array())
}

impl Rays {
    fn lit(
        &mut self,
        scene: &Integrator,
        frame: &Frame,
        [level, depth_left]: [usize; 2],
        walk: &mut Walk,
        control: &Control,
    ) {
        let parent = self.open.last();
        let mut kind = self.next;
        let weight = match (kind, parent) {
            (RayKind::Camera, _) | (_, None) => 1.0,
            (RayKind::Reflection, Some(parent)) => parent.shares[0],
            (_, Some(parent)) => parent.shares[1],
        };
        let (parent, side_above) = parent.map_or((None, DVec3::ZERO), |parent| (parent.place, parent.side));
        let (origin, direction) = (vector(frame.origin.get()), vector(frame.direction.get()));
        if kind == RayKind::Transmission && direction.dot(side_above) > 0.0 {
            kind = RayKind::InnerReflection;
        }
        let side = if scene.exact && !frame.groups.is_empty() {
            let [x, y, z, ..] = frame.hit_side.get();
            vector([x, y, z])
        } else {
            DVec3::ZERO
        };
        let group = frame.groups.first();
        let shares = group.map_or([0.0; 2], |group| {
            let material = scene.material(group.leaf);
            [material.reflection, material.transmission].map(|share| share.of(&frame.fields.get(), 0))
        });
        if self.levels.len() <= level {
            self.levels.resize(level + 1, 0);
        }
        if let Some(count) = self.levels.get_mut(level) {
            *count += 1;
        }
        if level > self.deepest || self.list.len() == MAX_EXPLAINED_RAYS {
            self.omitted += 1;
            let sum = color(frame.hit_color.get());
            self.open.push(Open { place: None, kind, sum, weight, side, shares });
            return;
        }
        let hit = group.and_then(|group| self.hit(scene, frame, group.leaf, shares, walk, control));
        if let Some(hit) = &hit
            && !same(hit.sum, color(frame.hit_color.get()))
        {
            // A render that is stopped gets only some of the light.
            self.adds_up &= control.is_cancelled();
        }
        let sum = hit.as_ref().map_or(Rgb::BLACK, |hit| hit.sum);
        let mut ray = ExplainedRay {
            kind,
            parent,
            level: level as u32,
            origin,
            direction,
            weight,
            color: Rgb::BLACK,
            hit,
        };
        if depth_left == 0
            && let Some(hit) = &mut ray.hit
        {
            let cut = |share: f64| if share == 0.0 { Followed::NotAsked } else { Followed::TooDeep };
            (hit.mirrored, hit.refracted) = (cut(shares[0]), cut(shares[1]));
        }
        self.open.push(Open { place: Some(self.list.len()), kind, sum, weight, side, shares });
        self.list.push(ray);
    }

    /// What there is to say of the only hit of a frame.
    fn hit(
        &mut self,
        scene: &Integrator,
        frame: &Frame,
        leaf: usize,
        [reflection, transmission]: [f64; 2],
        walk: &mut Walk,
        control: &Control,
    ) -> Option<ExplainedHit> {
        let [distance, _, triangle] = frame.nearest.get().map(|column| column.first().copied());
        let material = scene.material(leaf);
        let fields = &frame.fields.get();
        let parts: Parts = dispatch!(scene.level, simd => light::parts(simd, scene, frame));
        let mut sum = Rgb::BLACK;
        let mut lights = Vec::with_capacity(scene.lights.len());
        for (source, part) in scene.lights.iter().zip(&parts.lights) {
            let reach = self.reach(scene, source, part, parts.start, walk, control);
            let is_dark = match reach {
                Reach::Shadowed { .. } => true,
                Reach::Behind => scene.exact,
                Reach::Everywhere | Reach::Lit | Reach::OutsideCone => false,
            };
            let part = if is_dark {
                LightPart {
                    reach,
                    distance: part.distance,
                    diffuse: Rgb::BLACK,
                    highlight: Rgb::BLACK,
                    contribution: Rgb::BLACK,
                }
            } else {
                let contribution = part.highlight.map_or(part.diffuse, |highlight| part.diffuse + highlight);
                let highlight = part.highlight.unwrap_or(Rgb::BLACK);
                LightPart { reach, distance: part.distance, diffuse: part.diffuse, highlight, contribution }
            };
            sum = sum + part.contribution;
            lights.push(part);
        }
        if material.glow().is_some() {
            sum = sum + parts.glow;
        }
        lights.reverse();
        let (direction, normal) = (vector(frame.hit_direction.get()), vector(frame.hit_normal.get()));
        let [_, _, _, _, outside] = frame.hit_side.get();
        let inside = match outside.first() {
            Some(outside) if scene.exact => *outside < 0.0,
            _ => direction.dot(normal) > 0.0,
        };
        let asked = |share: f64| if share == 0.0 { Followed::NotAsked } else { Followed::Lost };
        Some(ExplainedHit {
            object: self.owners.owner(leaf),
            triangle: scene.geometry.is_mesh(leaf).then(|| triangle.map_or(0, |triangle| triangle as u32)),
            distance: distance?,
            point: vector(frame.hit_point.get()),
            normal,
            inside,
            base: parts.base,
            reflection,
            transmission,
            refractive_index: material.refractive_index.of(fields, 0),
            highlight: material.highlight.of(fields, 0),
            shine: material.shine.of(fields, 0),
            lights,
            glow: parts.glow,
            mirrored: asked(reflection),
            refracted: asked(transmission),
            sum,
        })
    }

    /// Whether a light reaches a point.
    fn reach(
        &mut self,
        scene: &Integrator,
        source: &Light,
        part: &light::Part,
        start: DVec3,
        walk: &mut Walk,
        control: &Control,
    ) -> Reach {
        if matches!(source, Light::Ambient { .. }) {
            return Reach::Everywhere;
        }
        // What is no number is behind as well.
        let is_behind = !matches!(part.cosine.partial_cmp(&0.0), Some(std::cmp::Ordering::Greater));
        if scene.exact && is_behind {
            return Reach::Behind;
        }
        let frame = &mut self.shadow;
        frame.begin(Background::Black, 1);
        frame.len = 1;
        for (columns, from) in [(&mut frame.origin, start), (&mut frame.direction, part.to_light)] {
            columns.get_mut().into_iter().zip(from.to_array()).for_each(|(column, v)| column[0] = v);
            columns.pad(1);
        }
        scene.intersect(frame, walk, control);
        let distance = frame.nearest.get()[0].first().copied().unwrap_or(f64::NAN);
        match leaf_of(frame, 0) {
            Some(leaf) if distance <= part.distance => {
                Reach::Shadowed { by: self.owners.owner(leaf as usize), distance }
            }
            _ if is_behind => Reach::Behind,
            _ if part.is_outside_cone => Reach::OutsideCone,
            _ => Reach::Lit,
        }
    }

    fn finished(&mut self, frame: &Frame) {
        let Some(open) = self.open.pop() else { return };
        let found = color(frame.color.get());
        if let Some(ray) = open.place.and_then(|place| self.list.get_mut(place)) {
            ray.color = found;
            if let Some(hit) = &mut ray.hit {
                hit.sum = open.sum;
                self.adds_up &=
                    same(open.sum, color(frame.hit_color.get())) && same(clipped(open.sum), found);
            }
        }
        let Some(above) = self.open.last_mut() else { return };
        above.sum = above.sum + found * open.weight;
        if let Some(hit) = above.place.and_then(|place| self.list.get_mut(place)?.hit.as_mut()) {
            match open.kind {
                RayKind::Reflection => hit.mirrored = Followed::Yes,
                _ => hit.refracted = Followed::Yes,
            }
        }
    }
}

/// As the step `finish` clips: what is no number becomes 1.
fn clipped(color: Rgb) -> Rgb {
    let clip = |v: f64| {
        let v = if v <= 1.0 { v } else { 1.0 };
        if v <= 0.0 { 0.0 } else { v }
    };
    Rgb::new(clip(color.r), clip(color.g), clip(color.b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use hray_core::{Csg, CsgOperation, Material, Shape, Sphere, Texture};
    use std::sync::Arc;

    #[test]
    fn leaves_belong_to_their_objects() {
        let ball = Primitive {
            shape: Shape::Sphere(Sphere { radius: 1.0, center: DVec3::ZERO }),
            transform: None,
            material: Arc::new(Material::matte(Texture::Solid(Rgb::BLACK))),
        };
        let csg = |a: &Primitive, b: &Primitive| Primitive {
            shape: Shape::Csg(Arc::new(Csg {
                operation: CsgOperation::Union,
                operands: [a.clone(), b.clone()],
            })),
            ..ball.clone()
        };
        let pair = csg(&ball, &ball);
        let three = csg(&pair, &ball);
        let owners = Owners::of(&[ball.clone(), three, ball.clone()]);
        let found: Vec<_> = (0..5).map(|leaf| owners.owner(leaf)).map(|o| (o.primitive, o.part)).collect();
        assert_eq!(found, [(2, None), (1, Some(0)), (1, Some(1)), (1, Some(2)), (0, None)]);
    }
}
