//! The direct light at every hit: `shadePt`, `diff` and `spec`, summed over the lights.

use super::Integrator;
use super::frame::{Columns, Frame};
use super::material::{COLOR, FIELDS, GLOW, Material, Number};
use super::shapes::Rays;
use super::solid::Walk;
use super::steps::{places, tilted, unit};
use super::texture::color_at;
use super::trace::shadowed;
use crate::Control;
use fearless_simd::prelude::*;
use hray_core::{DVec3, Light, Rgb, Texture};
use hray_expr::kernels::lanes::{Lanes, MAX_LANES, Vec3};
use hray_expr::kernels::power::power;

/// A highlight of coefficient 0 vanishes whatever its power, as long as that is finite; up to this exponent
/// it is, because the cosine exceeds 1 by rounding only.
const FINITE_POWER: f64 = (1u64 << 40) as f64;

/// Hits, one per lane.
#[derive(Clone, Copy)]
struct Hits<S: Simd> {
    /// Where shadow rays start.
    point: Vec3<S>,
    /// In the space of the textures.
    object: Vec3<S>,
    normal: Vec3<S>,
    direction: Vec3<S>,
    /// Their place in the columns.
    place: usize,
    /// The lanes that are hits; others repeat the last.
    lanes: u32,
}

/// What all hits of a group share.
#[derive(Clone, Copy)]
struct Group<'a> {
    scene: &'a Integrator,
    material: &'a Material,
    fields: &'a [&'a [f64]; FIELDS],
}

/// The direct light at every hit. Returns how many shadow rays it took.
#[inline(always)]
pub(super) fn shade<S: Simd>(
    simd: S,
    scene: &Integrator,
    frame: &mut Frame,
    walk: &mut Walk,
    control: &Control,
) -> u64 {
    let mut hits = 0;
    let fields = &frame.fields.get();
    for &group in &frame.groups {
        let (leaf, material) = (group.leaf, scene.material(group.leaf));
        let placed = scene.geometry.placement(leaf).is_some() && material.uses_noise();
        let shared = Group { scene, material, fields };
        hits += group.len as u64;
        for i in places::<S>(group.start, group.len) {
            let mut point = Vec3::load(simd, frame.hit_point.get(), i);
            let mut normal = Vec3::load(simd, frame.hit_normal.get(), i);
            let direction = Vec3::load(simd, frame.hit_direction.get(), i);
            let object = if placed { Vec3::load(simd, frame.hit_object.get(), i) } else { point };
            let geometric = normal;
            let smooth = scene.geometry.is_smooth(group.leaf);
            if smooth {
                let [x, y, z, ..] = frame.hit_smooth.get();
                normal = Vec3::load(simd, [x, y, z], i);
            }
            if material.has_bumps {
                normal = tilted(simd, &scene.geometry, fields, leaf, i, normal);
            }
            if scene.exact {
                let side = Side::of(simd, &frame.hit_side, i, geometric, direction);
                (point, normal) = (side.clear_of(point), normal.scale(side.outside));
                side.store(&mut frame.hit_side, i);
            }
            if scene.exact || smooth || material.has_bumps {
                normal.store(frame.hit_normal.get_mut(), i);
            }
            if smooth {
                let [_, _, _, x, y, z] = frame.hit_smooth.get();
                point = point.add(Vec3::load(simd, [x, y, z], i));
            }
            let lanes = (1u32 << (group.start + group.len - i).min(MAX_LANES)) - 1;
            let hits = Hits { point, object, normal, direction, place: i, lanes };
            let color = light(simd, &shared, &hits, walk, control);
            color.store(frame.hit_color.get_mut(), i);
        }
    }
    let lights = scene.lights.iter().filter(|light| !matches!(light, Light::Ambient { .. })).count();
    hits * lights as u64
}

/// The viewer's side of a surface.
struct Side<S: Simd> {
    /// The geometric normal that faces the viewer.
    normal: Vec3<S>,
    /// How far along it a ray has to start.
    clear: Lanes<S>,
    /// 1 where the viewer is on the outside, else -1.
    outside: Lanes<S>,
}

impl<S: Simd> Side<S> {
    #[inline(always)]
    fn of(simd: S, columns: &Columns<5>, i: usize, outward: Vec3<S>, direction: Vec3<S>) -> Self {
        let one = Lanes::<S>::splat(simd, 1.0);
        let outside = direction.dot(outward).simd_le(0.0).select(one, -one);
        let clear = Lanes::<S>::from_slice(simd, &columns.get()[3][i..i + Lanes::<S>::LEN]);
        Self { normal: outward.scale(outside), clear, outside }
    }

    #[inline(always)]
    fn clear_of(&self, point: Vec3<S>) -> Vec3<S> {
        point.add(self.normal.scale(self.clear))
    }

    #[inline(always)]
    fn store(&self, columns: &mut Columns<5>, i: usize) {
        let [x, y, z, _, outside] = columns.get_mut();
        self.normal.store([x, y, z], i);
        self.outside.store_slice(&mut outside[i..i + Lanes::<S>::LEN]);
    }
}

/// The light that reaches hits of a leaf and leaves them against the rays. A render that is stopped gets the light
/// of the lamps so far.
#[inline(always)]
fn light<S: Simd>(simd: S, group: &Group<'_>, hits: &Hits<S>, walk: &mut Walk, control: &Control) -> Vec3<S> {
    let Group { scene, material, .. } = *group;
    let mut sum = Vec3::splat(simd, DVec3::ZERO);
    let mut color = None;
    for source in &scene.lights {
        if control.is_cancelled() {
            break;
        }
        if let Light::Ambient { intensity } = *source {
            let intensity = Vec3::splat(simd, intensity);
            sum = sum.add(if scene.exact {
                let color = *color.get_or_insert_with(
                    #[inline(always)]
                    || diffuse_color(simd, group, hits),
                );
                intensity.mul(color)
            } else {
                intensity
            });
            continue;
        }
        let Toward { to_light, distance, intensity } = toward(simd, source, scene.exact, hits.point);
        let cosine = to_light.dot(hits.normal);
        // Not towards the light, or in the very place of it.
        let away = !cosine.simd_gt(0.0);
        if scene.exact && away.all_true() {
            continue;
        }
        let asked = if scene.exact { hits.lanes & !(away.to_bitmask() as u32) } else { hits.lanes };
        let rays = Rays::new(hits.point, to_light);
        let mut dark = shadowed(simd, &scene.geometry, &rays, distance, asked, walk);
        if scene.exact {
            dark |= away;
        }
        if dark.all_true() {
            continue;
        }
        let color = match color {
            Some(color) => color,
            None => *color.insert(diffuse_color(simd, group, hits)),
        };
        let (diffuse, highlight) = scattered(simd, group, hits, [to_light, intensity], cosine, color);
        let lit = match highlight {
            Some(highlight) => diffuse.add(highlight),
            None => diffuse,
        };
        sum = sum.add(lit.zero_where(simd, dark));
    }
    match material.glow() {
        None => sum,
        Some(glow) => sum.add(color_of(simd, group, hits, glow, GLOW)),
    }
}

/// What a surface of that colour makes of light that comes from `to_light`: what it scatters, and the highlight.
#[inline(always)]
#[allow(clippy::manual_map, reason = "see inside")]
fn scattered<S: Simd>(
    simd: S,
    group: &Group<'_>,
    hits: &Hits<S>,
    [to_light, intensity]: [Vec3<S>; 2],
    cosine: Lanes<S>,
    color: Vec3<S>,
) -> (Vec3<S>, Option<Vec3<S>>) {
    let diffuse = intensity.scale(cosine).mul(color);
    // No closures: they would not be compiled for the machine's vectors.
    let highlight = match highlight(simd, group, hits, to_light) {
        Some(factor) => Some(intensity.scale(factor)),
        None => None,
    };
    (diffuse, highlight)
}

/// What the light of a hit is made of, were there no shadows.
pub(super) struct Parts {
    /// Where shadow rays start.
    pub(super) start: DVec3,
    /// The surface's own colour.
    pub(super) base: Rgb,
    /// What it gives off by itself.
    pub(super) glow: Rgb,
    /// In the order in which lights are summed.
    pub(super) lights: Vec<Part>,
}

/// What a light gives, were there no shadows.
pub(super) struct Part {
    pub(super) to_light: DVec3,
    pub(super) distance: f64,
    /// Of the angle between the normal and the light.
    pub(super) cosine: f64,
    pub(super) is_outside_cone: bool,
    pub(super) diffuse: Rgb,
    pub(super) highlight: Option<Rgb>,
}

/// Takes apart the light of the first hit of a frame, which has been lit.
#[inline(always)]
pub(super) fn parts<S: Simd>(simd: S, scene: &Integrator, frame: &Frame) -> Parts {
    let first = |v: Vec3<S>| [v.x[0], v.y[0], v.z[0]];
    let black = || Parts { start: DVec3::ZERO, base: Rgb::BLACK, glow: Rgb::BLACK, lights: Vec::new() };
    let Some(leaf) = frame.groups.first().map(|group| group.leaf) else { return black() };
    let (material, fields) = (scene.material(leaf), &frame.fields.get());
    let group = &Group { scene, material, fields };
    let placed = scene.geometry.placement(leaf).is_some() && material.uses_noise();
    let surface = Vec3::load(simd, frame.hit_point.get(), 0);
    let object = if placed { Vec3::load(simd, frame.hit_object.get(), 0) } else { surface };
    let mut point = surface;
    if scene.exact {
        let [x, y, z, clear, _] = frame.hit_side.get();
        let clear = Lanes::<S>::from_slice(simd, &clear[..Lanes::<S>::LEN]);
        point = point.add(Vec3::load(simd, [x, y, z], 0).scale(clear));
    }
    if scene.geometry.is_smooth(leaf) {
        let [_, _, _, x, y, z] = frame.hit_smooth.get();
        point = point.add(Vec3::load(simd, [x, y, z], 0));
    }
    let hits = &Hits {
        point,
        object,
        normal: Vec3::load(simd, frame.hit_normal.get(), 0),
        direction: Vec3::load(simd, frame.hit_direction.get(), 0),
        place: 0,
        lanes: 1,
    };
    let color = diffuse_color(simd, group, hits);
    let mut parts = Parts { start: DVec3::from(first(point)), base: Rgb::from(first(color)), ..black() };
    if let Some(glow) = material.glow() {
        parts.glow = Rgb::from(first(color_of(simd, group, hits, glow, GLOW)));
    }
    for source in &scene.lights {
        parts.lights.push(if let Light::Ambient { intensity } = *source {
            let intensity = Vec3::splat(simd, intensity);
            let all = if scene.exact { intensity.mul(color) } else { intensity };
            Part {
                to_light: DVec3::ZERO,
                distance: 0.0,
                cosine: 1.0,
                is_outside_cone: false,
                diffuse: Rgb::from(first(all)),
                highlight: None,
            }
        } else {
            let Toward { to_light, distance, intensity } = toward(simd, source, scene.exact, point);
            let cosine = to_light.dot(hits.normal);
            let (diffuse, highlight) = scattered(simd, group, hits, [to_light, intensity], cosine, color);
            Part {
                to_light: DVec3::from(first(to_light)),
                distance: distance[0],
                cosine: cosine[0],
                is_outside_cone: matches!(source, Light::Spot { .. }) && first(intensity) == [0.0; 3],
                diffuse: Rgb::from(first(diffuse)),
                highlight: highlight.map(|lit| Rgb::from(first(lit))),
            }
        });
    }
    parts
}

#[inline(always)]
fn diffuse_color<S: Simd>(simd: S, group: &Group<'_>, hits: &Hits<S>) -> Vec3<S> {
    color_of(simd, group, hits, group.material.texture(), COLOR)
}

/// The colours of a texture; those of a function are in the columns from `first`.
#[inline(always)]
fn color_of<S: Simd>(simd: S, group: &Group<'_>, hits: &Hits<S>, texture: &Texture, first: usize) -> Vec3<S> {
    if let Texture::Function(_) = texture {
        if !group.material.varies(first) {
            return Vec3::splat(simd, DVec3::ZERO);
        }
        let columns = [group.fields[first], group.fields[first + 1], group.fields[first + 2]];
        return Vec3::load(simd, columns, hits.place);
    }
    if let Texture::Solid(color) = *texture {
        return Vec3::splat(simd, color);
    }
    noise_color(simd, group.scene, texture, hits.object)
}

/// One copy for each width of vectors: there is much of it.
#[inline(never)]
fn noise_color<S: Simd>(simd: S, scene: &Integrator, texture: &Texture, p: Vec3<S>) -> Vec3<S> {
    simd.vectorize(
        #[inline(always)]
        || color_at(simd, &scene.noise, texture, p),
    )
}

/// Where a light is, seen from points.
struct Toward<S: Simd> {
    to_light: Vec3<S>,
    distance: Lanes<S>,
    intensity: Vec3<S>,
}

#[inline(always)]
fn toward<S: Simd>(simd: S, light: &Light, exact: bool, point: Vec3<S>) -> Toward<S> {
    match *light {
        Light::Point { position, intensity } => from_point(simd, exact, point, position, intensity),
        Light::Ambient { intensity } => from_point(simd, exact, point, DVec3::ZERO, intensity),
        Light::Directional { direction, intensity } => Toward {
            to_light: Vec3::splat(simd, -direction),
            distance: Lanes::<S>::splat(simd, f64::INFINITY),
            intensity: Vec3::splat(simd, intensity),
        },
        Light::Spot { position, axis, cos_inner, cos_outer, intensity } => {
            let mut seen = from_point(simd, exact, point, position, intensity);
            let cosine = -seen.to_light.dot(Vec3::splat(simd, axis));
            seen.intensity = seen.intensity.scale(inside_cone(simd, cosine, cos_inner, cos_outer));
            seen
        }
    }
}

/// The way to a point, and what shines there. A function, because a closure would be called and not inlined, and then not
/// compiled for the machine's vectors.
#[inline(always)]
fn from_point<S: Simd>(simd: S, exact: bool, point: Vec3<S>, position: DVec3, intensity: Rgb) -> Toward<S> {
    let way = Vec3::splat(simd, position).sub(point);
    let (to_light, distance) = if exact { (unit(simd, way), way.dot(way).sqrt()) } else { way.norm(simd) };
    Toward { to_light, distance, intensity: Vec3::splat(simd, intensity) }
}

/// 1 in the inner cone, 0 outside the outer one, smooth between.
#[inline(always)]
fn inside_cone<S: Simd>(simd: S, cosine: Lanes<S>, inner: f64, outer: f64) -> Lanes<S> {
    let (zero, one) = (Lanes::<S>::splat(simd, 0.0), Lanes::<S>::splat(simd, 1.0));
    let t = (cosine - outer) / (inner - outer);
    let between = t * t * (Lanes::<S>::splat(simd, 3.0) - t * 2.0);
    let factor = cosine.simd_gt(outer).select(between, zero);
    cosine.simd_ge(inner).select(one, factor)
}

/// The factor of the highlight (`spec` without the intensity), unless it is certain to vanish.
#[inline(always)]
fn highlight<S: Simd>(simd: S, group: &Group<'_>, hits: &Hits<S>, to_light: Vec3<S>) -> Option<Lanes<S>> {
    let Group { scene, material, fields } = group;
    if material.highlight.vanishes() {
        let finite = |shine: f64| (0.0..=FINITE_POWER).contains(&shine);
        if scene.exact || matches!(material.shine, Number::Constant(shine) if finite(shine)) {
            return None;
        }
    }
    let strength = material.highlight.load(simd, fields, hits.place);
    let mut cosine = if scene.exact {
        hits.normal.dot(unit(simd, to_light.sub(hits.direction)))
    } else {
        hits.normal.dot(to_light.sub(hits.direction).norm(simd).0)
    };
    if scene.exact {
        let zero = Lanes::<S>::splat(simd, 0.0);
        cosine = cosine.simd_gt(zero).select(cosine, zero);
    }
    Some(match material.shine {
        Number::Constant(shine) if shine.fract() == 0.0 => power(simd, cosine, shine) * strength,
        shine => powers(simd, cosine, shine.load(simd, fields, hits.place)) * strength,
    })
}

/// Each lane to a power of its own.
#[inline(always)]
fn powers<S: Simd>(simd: S, base: Lanes<S>, exponent: Lanes<S>) -> Lanes<S> {
    let mut result = [0.0; MAX_LANES];
    for lane in 0..Lanes::<S>::LEN {
        result[lane] = libm::pow(base[lane], exponent[lane]);
    }
    Lanes::<S>::from_slice(simd, &result[..Lanes::<S>::LEN])
}
