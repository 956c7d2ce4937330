//! The steps of the classic integrator, each over a whole frame: written once for every vector width.

use super::Integrator;
use super::frame::{Background, Frame, Group, NOTHING};
use super::material::Material;
use super::shapes::{Prepared, Rays};
use super::texture::color_at;
use crate::Control;
use fearless_simd::prelude::*;
use hray_core::{DVec3, Light};
use hray_expr::kernels::lanes::{Lanes, Mask, Vec3, consecutive, gather};
use hray_expr::kernels::power::power;

/// A highlight of coefficient 0 vanishes whatever its power, as long as that is finite; up to this exponent
/// it is, because the cosine exceeds 1 by rounding only.
const FINITE_POWER: f64 = (1u64 << 40) as f64;

/// The places at which vectors start in `len` entries from `start`.
#[inline(always)]
fn places<S: Simd>(start: usize, len: usize) -> impl Iterator<Item = usize> {
    (start..start + len).step_by(Lanes::<S>::LEN)
}

/// Directions of rays that lead away from the eye: `mkNormVect eye p`.
#[inline(always)]
pub(super) fn away_from_eye<S: Simd>(simd: S, eye: DVec3, frame: &mut Frame) {
    for i in places::<S>(0, frame.len) {
        let p = Vec3::load(simd, frame.origin.get(), i);
        let (direction, _) = p.sub(Vec3::splat(simd, eye)).norm(simd);
        direction.store(frame.direction.get_mut(), i);
    }
}

/// The nearest hit of each ray: `intersect`. A later primitive must be strictly nearer.
#[inline(always)]
pub(super) fn intersect<S: Simd>(simd: S, shapes: &[Prepared], frame: &mut Frame, control: &Control) {
    frame.nearest.reserve(frame.len);
    for i in places::<S>(0, frame.len) {
        if control.is_cancelled() {
            // What was not computed will not be looked at.
            return;
        }
        let origin = Vec3::load(simd, frame.origin.get(), i);
        let direction = Vec3::load(simd, frame.direction.get(), i);
        let rays = Rays::new(origin, direction);
        // Before the first hit the distance is not a number, and nothing is farther than that.
        let mut nearest = Lanes::<S>::splat(simd, f64::NAN);
        let mut primitive = Lanes::<S>::splat(simd, NOTHING);
        let mut which = NOTHING;
        for shape in shapes {
            which += 1.0;
            if let Some((distance, hit)) = shape.hit(simd, &rays) {
                let nearer = hit & !distance.simd_ge(nearest);
                nearest = nearer.select(distance, nearest);
                primitive = nearer.select(Lanes::<S>::splat(simd, which), primitive);
            }
        }
        let [distances, primitives] = frame.nearest.get_mut();
        nearest.store_slice(&mut distances[i..i + Lanes::<S>::LEN]);
        primitive.store_slice(&mut primitives[i..i + Lanes::<S>::LEN]);
    }
}

/// The direct light at every hit: `shadePt` summed over the lights. Returns how many shadow rays it took.
#[inline(always)]
pub(super) fn shade<S: Simd>(simd: S, scene: &Integrator, frame: &mut Frame, control: &Control) -> u64 {
    let mut hits = 0;
    for group in &frame.groups {
        hits += group.len as u64;
        for i in places::<S>(group.start, group.len) {
            let rays = &frame.slot[i..i + Lanes::<S>::LEN];
            let origin = Vec3::gather(simd, frame.origin.get(), rays);
            let direction = Vec3::gather(simd, frame.direction.get(), rays);
            let distances = frame.nearest.get()[0];
            let distance = gather(simd, distances, rays);
            let point = origin.add(direction.scale(distance));
            let normal = scene.shapes[group.primitive].normal(simd, point);
            point.store(frame.hit_point.get_mut(), i);
            normal.store(frame.hit_normal.get_mut(), i);
            direction.store(frame.hit_direction.get_mut(), i);
            let color = light(simd, scene, group.primitive, [point, normal, direction], control);
            color.store(frame.hit_color.get_mut(), i);
        }
    }
    let point_lights = scene.lights.iter().filter(|light| matches!(light, Light::Point { .. })).count();
    hits * point_lights as u64
}

/// The light that reaches points of a primitive and leaves them against `direction`. A render that is stopped
/// gets the light of the lamps so far.
#[inline(always)]
fn light<S: Simd>(
    simd: S,
    scene: &Integrator,
    primitive: usize,
    [point, normal, direction]: [Vec3<S>; 3],
    control: &Control,
) -> Vec3<S> {
    let material = &scene.materials[primitive];
    let mut sum = Vec3::splat(simd, DVec3::ZERO);
    let mut color = None;
    for source in &scene.lights {
        if control.is_cancelled() {
            break;
        }
        match *source {
            Light::Ambient { intensity } => sum = sum.add(Vec3::splat(simd, intensity)),
            Light::Directional { .. } | Light::Spot { .. } => {}
            Light::Point { position, intensity } => {
                let (to_light, distance) = Vec3::splat(simd, position).sub(point).norm(simd);
                let dark = shadowed(simd, &scene.shapes, &Rays::new(point, to_light), distance);
                if dark.all_true() {
                    continue;
                }
                let color = match color {
                    Some(color) => color,
                    None => *color.insert(color_at(simd, &scene.noise, &material.texture, point)),
                };
                let intensity = Vec3::splat(simd, intensity);
                let diffuse = intensity.scale(to_light.dot(normal)).mul(color);
                let lit = match highlight(simd, material, normal, direction, to_light) {
                    Some(factor) => diffuse.add(intensity.scale(factor)),
                    None => diffuse,
                };
                sum = sum.add(lit.zero_where(simd, dark));
            }
        }
    }
    sum
}

/// Which points do not see a light at `distance`: any hit that is not farther blocks it.
#[inline(always)]
fn shadowed<S: Simd>(simd: S, shapes: &[Prepared], rays: &Rays<S>, distance: Lanes<S>) -> Mask<S> {
    let mut dark = Mask::<S>::splat(simd, false);
    for shape in shapes {
        if let Some((at, hit)) = shape.hit(simd, rays) {
            dark |= hit & at.simd_le(distance);
            if dark.all_true() {
                break;
            }
        }
    }
    dark
}

/// The factor of the highlight (`spec` without the intensity), unless it is certain to vanish.
#[inline(always)]
fn highlight<S: Simd>(
    simd: S,
    material: &Material,
    normal: Vec3<S>,
    direction: Vec3<S>,
    to_light: Vec3<S>,
) -> Option<Lanes<S>> {
    if material.reflection == 0.0 && (0.0..=FINITE_POWER).contains(&material.shine) {
        return None;
    }
    let (half, _) = to_light.sub(direction).norm(simd);
    Some(power(simd, normal.dot(half), material.shine) * material.reflection)
}

/// The mirrored rays of a frame: `reflectPt`.
#[inline(always)]
pub(super) fn reflect<S: Simd>(simd: S, materials: &[Material], frame: &Frame, next: &mut Frame) {
    next.begin(Background::Black, frame.len);
    for group in frame.groups.iter().filter(|group| materials[group.primitive].reflection != 0.0) {
        for i in places::<S>(group.start, group.len) {
            let normal = Vec3::load(simd, frame.hit_normal.get(), i);
            let direction = Vec3::load(simd, frame.hit_direction.get(), i);
            let mirrored = direction.sub(normal.scale(normal.dot(direction) * 2.0));
            let to = next.len + (i - group.start);
            Vec3::load(simd, frame.hit_point.get(), i).store(next.origin.get_mut(), to);
            mirrored.store(next.direction.get_mut(), to);
        }
        extend_parents(next, group);
    }
    next.origin.pad(next.len);
    next.direction.pad(next.len);
}

fn extend_parents(next: &mut Frame, group: &Group) {
    next.parent.extend((group.start..group.start + group.len).map(|place| place as u32));
    next.len += group.len;
}

/// The refracted rays of a frame: `refractPt`. Where all light is reflected inside there is none.
#[inline(always)]
pub(super) fn refract<S: Simd>(simd: S, scene: &Integrator, frame: &Frame, next: &mut Frame) {
    next.begin(Background::PerRay, frame.len);
    for group in &frame.groups {
        let material = &scene.materials[group.primitive];
        if material.transmission == 0.0 {
            continue;
        }
        for i in places::<S>(group.start, group.len) {
            let normal = Vec3::load(simd, frame.hit_normal.get(), i);
            let direction = Vec3::load(simd, frame.hit_direction.get(), i);
            let refracted = refracted(simd, direction, normal, material.refractive_index);
            let lanes = Lanes::<S>::LEN.min(group.start + group.len - i);
            for lane in 0..lanes {
                let toward = [refracted.x[lane], refracted.y[lane], refracted.z[lane]];
                if toward != [0.0; 3] {
                    push_refracted(scene, material, frame, next, i + lane, toward);
                }
            }
        }
    }
    next.origin.pad(next.len);
    next.direction.pad(next.len);
}

/// Appends the refracted ray of one hit, with the background that it will see.
fn push_refracted(
    scene: &Integrator,
    material: &Material,
    frame: &Frame,
    next: &mut Frame,
    hit: usize,
    toward: [f64; 3],
) {
    let ray = frame.slot[hit] as usize;
    let behind = match frame.background {
        Background::Scene => scene.background.to_array(),
        Background::Black => [0.0; 3],
        Background::PerRay => frame.behind.get().map(|column| column[ray]),
    };
    let to = next.len;
    let columns = next.origin.get_mut().into_iter().zip(frame.hit_point.get());
    columns.for_each(|(column, from)| column[to] = from[hit]);
    next.direction.get_mut().into_iter().zip(toward).for_each(|(column, v)| column[to] = v);
    next.behind
        .get_mut()
        .into_iter()
        .zip(behind)
        .for_each(|(column, v)| column[to] = v * material.transmission);
    next.parent.push(hit as u32);
    next.len += 1;
}

/// `refractDir` of appendix A.1: the direction zero where all light is reflected inside.
#[inline(always)]
fn refracted<S: Simd>(simd: S, incoming: Vec3<S>, normal: Vec3<S>, index: f64) -> Vec3<S> {
    let cosine = normal.dot(Vec3 { x: -incoming.x, y: -incoming.y, z: -incoming.z });
    let leaving = cosine.simd_lt(0.0);
    let ratio = leaving.select(Lanes::<S>::splat(simd, index), Lanes::<S>::splat(simd, 1.0 / index));
    let v = ratio * ratio * (cosine * cosine - 1.0) + 1.0;
    let bend = ratio * cosine.abs() - v.sqrt();
    let (direction, _) = incoming.scale(ratio).add(normal.scale(bend)).norm(simd);
    direction.zero_where(simd, v.simd_lt(0.0))
}

/// Clips the colours of the hits and gives them to their rays.
#[inline(always)]
pub(super) fn finish<S: Simd>(simd: S, frame: &mut Frame) {
    for group in &frame.groups {
        for i in places::<S>(group.start, group.len) {
            let color = Vec3::load(simd, frame.hit_color.get(), i).clip(simd);
            let lanes = Lanes::<S>::LEN.min(group.start + group.len - i);
            let rays = &frame.slot[i..i + Lanes::<S>::LEN];
            if consecutive(rays) {
                color.store(frame.color.get_mut(), rays[0] as usize);
                continue;
            }
            let [r, g, b] = frame.color.get_mut();
            for (lane, &ray) in rays[..lanes].iter().enumerate() {
                let ray = ray as usize;
                (r[ray], g[ray], b[ray]) = (color.x[lane], color.y[lane], color.z[lane]);
            }
        }
    }
}
