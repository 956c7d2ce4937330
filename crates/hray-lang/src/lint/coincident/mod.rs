//! Surfaces that lie in each other, so that rounding, or the order of the source, decides which of them is seen.
//!
//! Only what can be seen counts: where a box stands on a floor its underside cannot, and two boxes of one plain material
//! look the same whichever is met. Faces are sorted by numbers of the plane, sphere, cone or torus that they lie in, so that
//! those of one are next to each other; in a plane, faces are then swept along one axis. Points where both faces are tell,
//! by what is inside on either side, what is seen there.
//!
//! Meshes and quadrics are not looked at, and in a huge scene not everything is: there are limits on faces, on candidates of
//! each, and on the work.

mod surfaces;
#[cfg(test)]
mod tests;
mod tree;

use glam::{DVec2, DVec3};
use hray_core::{Camera, Field, Material, Primitive, Scene, Texture};
use hray_expr::{Function, Input};
use std::cmp::Ordering;
use surfaces::{Face, Sample, Sheet, across, area, common, corners, faces, samples, square};
use tree::{Leaf, Tree};

/// So many faces are looked at.
const MOST_FACES: usize = 1 << 18;
/// So many shapes are, those without faces and the parts of solids among them.
const MOST_LEAVES: usize = 1 << 20;
/// Each is compared with so many at most.
const MOST_CANDIDATES: usize = 64;
/// So many leaves and operations are visited.
const MOST_WORK: usize = 50_000_000;
/// Faces have to share more than this part of the smaller one.
const LEAST_SHARE: f64 = 1e-6;

/// Two surfaces in the same place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Coincidence {
    /// Both, in the order of the source.
    pub(crate) surfaces: [Surface; 2],
    pub(crate) kind: Kind,
}

/// Whose surface it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Surface {
    /// Which primitive of the scene.
    pub(crate) object: usize,
    /// Which of its leaves, where it is made of others.
    pub(crate) part: Option<usize>,
}

/// What rounding decides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Which of two objects is seen.
    Objects,
    /// Whether a skin is left of a solid where nothing should be.
    Skin,
    /// Which part of a solid is seen.
    Parts,
    /// Whether a surface is left where it is clipped.
    Clip,
}

/// Looks for surfaces in the same place until `found` returns false.
pub(crate) fn check(scene: &Scene, mut found: impl FnMut(Coincidence) -> bool) {
    let mut search = Search::new(scene);
    let mut keyed: Vec<(u64, u32)> = (0..).zip(&search.faces).map(|(i, face)| (face.key(), i)).collect();
    keyed.sort_unstable();
    let mut groups: Vec<Vec<u32>> = keyed
        .chunk_by(|a, b| a.0 == b.0)
        .filter(|group| group.len() > 1)
        .map(|group| group.iter().map(|(_, face)| *face).collect())
        .collect();
    groups.sort_unstable();
    for group in groups {
        for [a, b] in search.candidates(&group) {
            if let Some(coincidence) = search.compare(a as usize, b as usize)
                && !found(coincidence)
            {
                return;
            }
            if search.work > MOST_WORK {
                return;
            }
        }
    }
}

/// Where the picture is taken from.
enum Eye {
    At(DVec3),
    Along(DVec3),
}

impl Eye {
    /// Whether one sees a surface with this outward normal from outside.
    fn is_before(&self, sample: &Sample, outward: DVec3) -> bool {
        match self {
            Self::At(eye) => outward.dot(*eye - sample.point) > 0.0,
            Self::Along(direction) => outward.dot(*direction) < 0.0,
        }
    }
}

struct Object {
    /// Its first leaf.
    first: u32,
    /// Where it is made of others.
    tree: Option<Tree>,
    is_around_eye: bool,
}

struct Search<'a> {
    leaves: Vec<Leaf<'a>>,
    objects: Vec<Object>,
    faces: Vec<Face>,
    eye: Eye,
    work: usize,
}

impl<'a> Search<'a> {
    fn new(scene: &'a Scene) -> Self {
        let eye = match scene.camera {
            Camera::Perspective(camera) => Eye::At(camera.from),
            Camera::Orthographic(camera) => Eye::Along(camera.to - camera.from),
            Camera::Window(camera) => Eye::At(camera.eye),
        };
        let mut search = Self { leaves: Vec::new(), objects: Vec::new(), faces: Vec::new(), eye, work: 0 };
        for primitive in &scene.primitives {
            let is_full = search.faces.len() >= MOST_FACES || search.leaves.len() >= MOST_LEAVES;
            if is_full || !search.add(primitive) {
                break;
            }
        }
        search
    }

    /// Adds an object; false where it is too large.
    fn add(&mut self, primitive: &'a Primitive) -> bool {
        let (first, object) = (self.leaves.len(), self.objects.len() as u32);
        let tree = if primitive.shape.is_made_of_others() {
            if primitive.leaves().take(MOST_FACES).count() == MOST_FACES {
                return false;
            }
            Some(Tree::new(primitive, object, &mut self.leaves))
        } else {
            self.leaves.push(Leaf { primitive, to_world: primitive.transform.clone(), object });
            None
        };
        let is_simple = tree.is_none();
        self.objects.push(Object { first: first as u32, tree, is_around_eye: false });
        if let Eye::At(eye) = self.eye {
            let is_around = self.values(object, eye, &[]).is_some_and(|[inside, _]| inside);
            if let Some(object) = self.objects.last_mut() {
                object.is_around_eye = is_around;
            }
        }
        for leaf in first..self.leaves.len() {
            let Leaf { primitive, to_world, .. } = &self.leaves[leaf];
            let before = self.faces.len();
            faces(&primitive.shape, to_world.as_deref(), leaf as u32, &mut self.faces);
            if is_simple {
                // What is turned away from the eye is not seen.
                let mut added = self.faces.split_off(before);
                added.retain(|face| match face.sheet {
                    Sheet::Plane { normal, offset } => {
                        let sample = Sample { point: normal * offset, normal };
                        self.is_seen(face, &sample, self.is_transparent(face))
                    }
                    _ => true,
                });
                self.faces.append(&mut added);
            }
        }
        true
    }

    /// Pairs of faces that may lie in each other, among those with the same key.
    fn candidates(&self, group: &[u32]) -> Vec<[u32; 2]> {
        let Some(Sheet::Plane { normal, .. }) = group.first().map(|&face| self.faces[face as usize].sheet)
        else {
            let pairs = group
                .iter()
                .enumerate()
                .flat_map(|(i, a)| group.iter().skip(i + 1).take(MOST_CANDIDATES).map(move |b| [*a, *b]));
            return pairs.collect();
        };
        let [axis, _] = across(normal);
        let mut spans: Vec<(f64, f64, u32)> = group
            .iter()
            .map(|&face| {
                let Some(corners) = self.corners(face as usize) else {
                    return (f64::NEG_INFINITY, f64::INFINITY, face);
                };
                let along = corners.iter().map(|corner| corner.dot(axis));
                let low = along.clone().fold(f64::INFINITY, f64::min);
                (low, along.fold(f64::NEG_INFINITY, f64::max), face)
            })
            .collect();
        spans.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.2.cmp(&b.2)));
        let mut pairs = Vec::new();
        for (i, (_, end, face)) in spans.iter().enumerate() {
            let met = spans.iter().skip(i + 1).take_while(|(start, ..)| start < end).take(MOST_CANDIDATES);
            pairs.extend(met.map(|(.., other)| [*face.min(other), *face.max(other)]));
        }
        pairs.sort_unstable();
        pairs
    }

    fn corners(&self, face: usize) -> Option<Vec<DVec3>> {
        let Face { leaf, side, .. } = self.faces[face];
        let Leaf { primitive, to_world, .. } = &self.leaves[leaf as usize];
        corners(&primitive.shape, to_world.as_deref(), side)
    }

    /// What is to be said of two faces.
    fn compare(&mut self, a: usize, b: usize) -> Option<Coincidence> {
        let [face_a, face_b] = [self.faces[a], self.faces[b]];
        self.work += 8;
        if face_a.leaf == face_b.leaf || !face_a.is_in_sheet_of(&face_b) {
            return None;
        }
        let objects = [face_a, face_b].map(|face| self.leaves[face.leaf as usize].object);
        let is_plain = self.look_the_same(&face_a, &face_b);
        if objects[0] != objects[1] && is_plain {
            return None;
        }
        let samples = match face_a.sheet {
            Sheet::Plane { normal, offset } => self.shared(a, b, normal, offset),
            _ => samples(&face_a, &face_b),
        };
        self.work += samples.len();
        for sample in &samples {
            let kind = if objects[0] == objects[1] {
                self.in_one_solid(&face_a, &face_b, sample, is_plain)
            } else {
                let is_clear = [&face_a, &face_b].iter().all(|face| self.is_transparent(face));
                let is_seen = |face| self.is_seen(face, sample, is_clear);
                (is_seen(&face_a) && is_seen(&face_b)).then_some(Kind::Objects)
            };
            let trees =
                objects.map(|object| self.objects[object as usize].tree.as_ref().map_or(0, Tree::work));
            self.work += 5 * (trees[0] + trees[1]);
            if let Some(kind) = kind {
                let surfaces = [face_a, face_b].map(|face| self.surface(&face));
                return Some(Coincidence { surfaces, kind });
            }
            if self.work > MOST_WORK {
                break;
            }
        }
        None
    }

    fn surface(&self, face: &Face) -> Surface {
        let object = self.leaves[face.leaf as usize].object as usize;
        let Object { first, tree, .. } = &self.objects[object];
        Surface { object, part: tree.as_ref().map(|_| (face.leaf - first) as usize) }
    }

    /// Points of what two faces in a plane have in common, if that is more than a line.
    fn shared(&self, a: usize, b: usize, normal: DVec3, offset: f64) -> Vec<Sample> {
        let (foot, [x, y]) = (normal * offset, across(normal));
        let flat = |face: usize| -> Option<Vec<DVec2>> {
            let corners = self.corners(face)?;
            let mut flat: Vec<DVec2> =
                corners.iter().map(|p| DVec2::new((*p - foot).dot(x), (*p - foot).dot(y))).collect();
            if area(&flat) < 0.0 {
                flat.reverse();
            }
            Some(flat)
        };
        let polygon = match [flat(a), flat(b)] {
            [None, None] => square(offset),
            [Some(only), None] | [None, Some(only)] => only,
            [Some(one), Some(other)] => {
                let polygon = common(&one, &other);
                // Also where one of them is nothing.
                let least = LEAST_SHARE * area(&one).min(area(&other));
                if area(&polygon).partial_cmp(&least) != Some(Ordering::Greater) {
                    return Vec::new();
                }
                polygon
            }
        };
        let middle = polygon.iter().sum::<DVec2>() / polygon.len() as f64;
        let shares = [0.5, 0.95].into_iter();
        let toward =
            shares.flat_map(|share| polygon.iter().map(move |corner| middle + (*corner - middle) * share));
        let points = std::iter::once(middle).chain(toward).map(|p| foot + x * p.x + y * p.y);
        let is_on_both = |point: &DVec3| {
            [a, b].iter().all(|&face| self.leaves[self.faces[face].leaf as usize].covers(*point))
        };
        points.filter(is_on_both).map(|point| Sample { point, normal }).collect()
    }

    /// Which leaves of an object a point is in; none where that is not known. The inside of a single shape that is clipped
    /// does not matter.
    fn inside(&self, object: u32, point: DVec3) -> Option<Vec<bool>> {
        let Object { first, tree, .. } = &self.objects[object as usize];
        let after =
            self.objects.get(object as usize + 1).map_or(self.leaves.len(), |next| next.first as usize);
        let leaves = self.leaves[*first as usize..after].iter().enumerate();
        let is_open = tree.as_ref().is_some_and(Tree::is_clipped_leaf);
        leaves.map(|(i, leaf)| if is_open && i == 0 { Some(false) } else { leaf.contains(point) }).collect()
    }

    /// Whether a point is inside of an object, and within what that is clipped by, where some of its leaves (by their place in
    /// the object) are taken to be left or entered.
    fn values(&self, object: u32, point: DVec3, changes: &[(usize, bool)]) -> Option<[bool; 2]> {
        let mut inside = self.inside(object, point)?;
        for &(leaf, is_inside) in changes {
            inside[leaf] = is_inside;
        }
        match &self.objects[object as usize].tree {
            Some(tree) => Some(tree.values(&inside)),
            None => Some([inside.first().copied()?, true]),
        }
    }

    /// Whether the direction of a sample leads out of a face's leaf.
    fn leads_out(face: &Face) -> bool {
        match face.sheet {
            Sheet::Plane { .. } => face.is_along,
            _ => true,
        }
    }

    fn is_transparent(&self, face: &Face) -> bool {
        !self.leaves[face.leaf as usize].primitive.material.transmission.is_zero()
    }

    /// Whether a face is seen at a point of it, from outside, or from behind as well.
    fn is_seen(&self, face: &Face, sample: &Sample, is_clear: bool) -> bool {
        let leaf = &self.leaves[face.leaf as usize];
        let Object { first, tree, is_around_eye } = &self.objects[leaf.object as usize];
        let out = if Self::leads_out(face) { sample.normal } else { -sample.normal };
        let Some(tree) = tree else {
            return leaf.is_open() || is_clear || self.eye.is_before(sample, out) != *is_around_eye;
        };
        let part = (face.leaf - first) as usize;
        if !tree.is_of_surface(part) {
            return false;
        }
        if tree.is_clipped_leaf() {
            return self.inside(leaf.object, sample.point).is_some_and(|inside| tree.values(&inside)[1]);
        }
        let value = |is_inside| self.values(leaf.object, sample.point, &[(part, is_inside)]);
        let (Some([inside, within]), Some([outside, _])) = (value(true), value(false)) else { return false };
        if inside == outside || !within {
            return false;
        }
        let out = if inside { out } else { -out };
        is_clear || tree.is_clipped() || self.eye.is_before(sample, out) != *is_around_eye
    }

    /// What rounding decides where two leaves of one solid have a surface in common.
    fn in_one_solid(&self, a: &Face, b: &Face, sample: &Sample, is_plain: bool) -> Option<Kind> {
        let object = self.leaves[a.leaf as usize].object;
        let Object { first, tree, is_around_eye } = &self.objects[object as usize];
        let tree = tree.as_ref()?;
        let [part_a, part_b] = [a, b].map(|face| (face.leaf - first) as usize);
        let mut inside = self.inside(object, sample.point)?;
        let mut value = |at_a: bool, at_b: bool| {
            (inside[part_a], inside[part_b]) = (at_a, at_b);
            tree.values(&inside)
        };
        match [part_a, part_b].map(|part| tree.is_of_surface(part)) {
            [false, false] => return None,
            [true, true] => {}
            [is_a, _] => {
                let mut value =
                    |surface, within| if is_a { value(surface, within) } else { value(within, surface) };
                let is_surface = tree.is_clipped_leaf() || value(false, true)[0] != value(true, true)[0];
                let is_cut = value(true, false)[1] != value(true, true)[1];
                return (is_surface && is_cut && !self.is_exact(a, b)).then_some(Kind::Clip);
            }
        }
        // Below and above the surface, and where one is left or entered a little earlier than the other.
        let [out_a, out_b] = [a, b].map(Self::leads_out);
        let ([below, within], [above, _]) = (value(out_a, out_b), value(!out_a, !out_b));
        let between = [value(!out_a, out_b)[0], value(out_a, !out_b)[0]];
        if !within {
            return None;
        }
        let is_transparent = [a, b]
            .iter()
            .any(|face| !self.leaves[face.leaf as usize].primitive.material.transmission.is_zero());
        if below == above {
            let is_thin = between.iter().any(|&value| value != below) && !self.is_exact(a, b);
            return (is_thin && (!below || is_transparent)).then_some(if below {
                Kind::Parts
            } else {
                Kind::Skin
            });
        }
        let out = if below { sample.normal } else { -sample.normal };
        let is_seen =
            is_transparent || tree.is_clipped() || self.eye.is_before(sample, out) != *is_around_eye;
        (is_seen && !is_plain).then_some(Kind::Parts)
    }

    /// Whether rays meet both at the same distance to the bit, so that nothing is left between, and the order of the source
    /// decides which is seen.
    fn is_exact(&self, a: &Face, b: &Face) -> bool {
        let [one, other] = [a, b].map(|face| &self.leaves[face.leaf as usize]);
        match [one.slab(a.side), other.slab(b.side)] {
            [Some(one), Some(other)] => one == other,
            _ => one.to_world == other.to_world && one.primitive.shape == other.primitive.shape,
        }
    }

    /// Whether it makes no difference which of two faces is seen.
    fn look_the_same(&self, a: &Face, b: &Face) -> bool {
        let [one, other] = [a, b].map(|face| &self.leaves[face.leaf as usize]);
        let [material, same] = [&one.primitive.material, &other.primitive.material];
        material == same
            && material.transmission.is_zero()
            && (one.to_world == other.to_world || is_of_the_world(material) || self.is_exact(a, b))
    }
}

/// Whether a material is the same on every shape that passes through a point of the world in the same direction.
fn is_of_the_world(material: &Material) -> bool {
    let Material { texture, reflection, shine, transmission, refractive_index, highlight, glow, bump } =
        material;
    let fields = [reflection, shine, transmission, refractive_index].into_iter().chain(highlight);
    let textures = [texture].into_iter().chain(glow);
    let is_of_the_world = |function: &Function| {
        function
            .inputs_used()
            .all(|input| !matches!(input, Input::Px | Input::Py | Input::Pz | Input::U | Input::V))
    };
    bump.is_none()
        && fields.into_iter().all(|field| match field {
            Field::Constant(_) => true,
            Field::Function(function) => is_of_the_world(function),
        })
        && textures.into_iter().all(|texture| match texture {
            Texture::Solid(_) => true,
            Texture::Function(function) => is_of_the_world(function),
            Texture::Noise(_) => false,
        })
}
