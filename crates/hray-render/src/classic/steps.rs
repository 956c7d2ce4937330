//! The steps of the integrator but for light, each over a whole frame: written once for every vector width.

use super::Integrator;
use super::frame::{Background, Frame, Group, NOTHING};
use super::geometry::Geometry;
use super::implicit::PreparedImplicit;
use super::material::{BUMP, FIELDS, Number};
use super::mesh::PreparedMesh;
use super::placement::{Placement, size};
use super::round::NO_SPOT;
use super::shapes::{BOUND, Prepared, Rays, Surface};
use super::solid::Walk;
use super::trace::{nearest, ray_of};
use super::uv::uv;
use crate::Control;
use fearless_simd::prelude::*;
use hray_core::DVec3;
use hray_expr::kernels::lanes::{Lanes, MAX_LANES, Vec3, consecutive, gather};

/// The places at which vectors start in `len` entries from `start`.
#[inline(always)]
pub(super) fn places<S: Simd>(start: usize, len: usize) -> impl Iterator<Item = usize> {
    (start..start + len).step_by(Lanes::<S>::LEN)
}

/// The direction of a vector of any length but zero and those whose squares are out of range.
#[inline(always)]
pub(super) fn unit<S: Simd>(simd: S, v: Vec3<S>) -> Vec3<S> {
    v.scale(Lanes::<S>::splat(simd, 1.0) / v.dot(v).sqrt())
}

#[inline(always)]
fn negated<S: Simd>(v: Vec3<S>) -> Vec3<S> {
    Vec3 { x: -v.x, y: -v.y, z: -v.z }
}

/// Directions of rays that lead away from the eye: `mkNormVect eye p`.
#[inline(always)]
pub(super) fn away_from_eye<S: Simd>(simd: S, eye: DVec3, exact: bool, frame: &mut Frame) {
    for i in places::<S>(0, frame.len) {
        let p = Vec3::load(simd, frame.origin.get(), i);
        let away = p.sub(Vec3::splat(simd, eye));
        let direction = if exact { unit(simd, away) } else { away.norm(simd).0 };
        direction.store(frame.direction.get_mut(), i);
    }
}

/// The nearest hit of each ray.
#[inline(always)]
pub(super) fn intersect<S: Simd>(
    simd: S,
    geometry: &Geometry,
    frame: &mut Frame,
    walk: &mut Walk,
    control: &Control,
) {
    frame.nearest.reserve(frame.len);
    for i in places::<S>(0, frame.len) {
        if control.is_cancelled() {
            // What was not computed will not be looked at.
            return;
        }
        let origin = Vec3::load(simd, frame.origin.get(), i);
        let direction = Vec3::load(simd, frame.direction.get(), i);
        let found = nearest(simd, geometry, &Rays::new(origin, direction), NOTHING, walk);
        let [distances, leaves, triangles] = frame.nearest.get_mut();
        found.distance.store_slice(&mut distances[i..i + Lanes::<S>::LEN]);
        found.leaf.store_slice(&mut leaves[i..i + Lanes::<S>::LEN]);
        found.triangle.store_slice(&mut triangles[i..i + Lanes::<S>::LEN]);
    }
}

/// Where hits are, and the geometric normals there: outward, of the whole where a shape is part of a solid.
#[inline(always)]
pub(super) fn locate<S: Simd>(simd: S, scene: &Integrator, frame: &mut Frame, walk: &mut Walk) {
    for at in 0..frame.groups.len() {
        let group = frame.groups[at];
        let geometry = &scene.geometry;
        let shape = geometry.shape(group.leaf);
        let special = scene.exact
            || geometry.is_single(group.leaf)
            || geometry.placement(group.leaf).is_some()
            || geometry.is_turned(group.leaf)
            || scene.uses.object
            || scene.uses.smooth
            || scene.uses.uv;
        for i in places::<S>(group.start, group.len) {
            let slots = &frame.slot[i..i + Lanes::<S>::LEN];
            let origin = Vec3::gather(simd, frame.origin.get(), slots);
            let direction = Vec3::gather(simd, frame.direction.get(), slots);
            let distance = gather(simd, frame.nearest.get()[0], slots);
            direction.store(frame.hit_direction.get_mut(), i);
            let rays = Rays::new(origin, direction);
            if special {
                simd.vectorize(
                    #[inline(always)]
                    || locate_special(simd, scene, frame, walk, (group, i), &rays, distance),
                );
                continue;
            }
            let point = origin.add(direction.scale(distance));
            let normal = shape.thesis_normal(simd, point, &rays, distance);
            point.store(frame.hit_point.get_mut(), i);
            normal.store(frame.hit_normal.get_mut(), i);
        }
    }
}

/// The hits from `i` of a leaf that has a placement, is turned inside out, or is to be known exactly.
#[inline(always)]
fn locate_special<S: Simd>(
    simd: S,
    scene: &Integrator,
    frame: &mut Frame,
    walk: &mut Walk,
    (group, i): (Group, usize),
    rays: &Rays<S>,
    distance: Lanes<S>,
) {
    let geometry = &scene.geometry;
    let (shape, placement) = (geometry.shape(group.leaf), geometry.placement(group.leaf));
    let own = placement.map_or(*rays, |placement| placement.rays(simd, rays));
    let (object, own_normal, bound) = if let Prepared::Mesh(mesh) = shape {
        locate_mesh(simd, scene, mesh, frame, group, i, &own)
    } else if let Prepared::Implicit(surface) = shape {
        locate_implicit(simd, surface, walk, &own, distance)
    } else if scene.exact {
        let surface = shape.surface(simd, &own, distance);
        (surface.point, surface.normal, surface.bound)
    } else {
        let object = own.origin.add(own.direction.scale(distance));
        (object, shape.thesis_normal(simd, object, &own, distance), distance)
    };
    let (mut point, mut normal, mut bound) = (object, own_normal, bound);
    if let Some(placement) = placement {
        normal = placement.normal_to_world::<S>(own_normal);
        if scene.exact {
            point = placement.to_world(simd, object);
            let length = normal.dot(normal).sqrt();
            bound = (bound + placement.round_trip(simd, object, point, own_normal)) / length;
            normal = normal.scale(Lanes::<S>::splat(simd, 1.0) / length);
        } else {
            point = rays.origin.add(rays.direction.scale(distance));
            normal = normal.norm(simd).0;
        }
        if geometry.is_smooth(group.leaf) {
            smooth_to_world(simd, placement, frame, i);
        }
    }
    if geometry.is_turned(group.leaf) {
        normal = negated(normal);
        if geometry.is_smooth(group.leaf) {
            let [x, y, z, ..] = frame.hit_smooth.get_mut();
            negated(Vec3::load(simd, [&*x, &*y, &*z], i)).store([x, y, z], i);
        }
    }
    point.store(frame.hit_point.get_mut(), i);
    normal.store(frame.hit_normal.get_mut(), i);
    if scene.exact {
        // Adding it to the point rounds once more.
        let distance = bound + size(normal).dot(size(point)) * BOUND;
        distance.store_slice(&mut frame.hit_side.get_mut()[3][i..i + Lanes::<S>::LEN]);
    }
    if scene.uses.object {
        object.store(frame.hit_object.get_mut(), i);
    }
    if scene.uses.uv && scene.takes_uv(group.leaf) && !matches!(shape, Prepared::Mesh(_)) {
        let [us, vs] = frame.hit_uv.get_mut();
        for lane in 0..Lanes::<S>::LEN {
            let of = |v: Vec3<S>| DVec3::new(v.x[lane], v.y[lane], v.z[lane]);
            [us[i + lane], vs[i + lane]] = uv(shape, of(object), of(own_normal));
        }
    }
}

/// The hits from `i` of a mesh: points, normals, and how far along these a ray has to start.
fn locate_mesh<S: Simd>(
    simd: S,
    scene: &Integrator,
    mesh: &PreparedMesh,
    frame: &mut Frame,
    group: Group,
    i: usize,
    own: &Rays<S>,
) -> (Vec3<S>, Vec3<S>, Lanes<S>) {
    let with_uv = scene.uses.uv && scene.takes_uv(group.leaf);
    let mut columns = [[0.0; MAX_LANES]; 7];
    for lane in 0..Lanes::<S>::LEN {
        let triangle = frame.nearest.get()[2][frame.slot[i + lane] as usize] as u32;
        let at = mesh.locate(&ray_of(own, lane), triangle);
        let [x, y, z] = at.point.to_array();
        let [nx, ny, nz] = at.normal.to_array();
        for (column, value) in columns.iter_mut().zip([x, y, z, nx, ny, nz, at.bound]) {
            column[lane] = value;
        }
        let smooth = at.shading.to_array().into_iter().chain(at.lift.to_array());
        for (column, value) in frame.hit_smooth.get_mut().into_iter().zip(smooth) {
            column[i + lane] = value;
        }
        if with_uv {
            let [us, vs] = frame.hit_uv.get_mut();
            [us[i + lane], vs[i + lane]] = at.uv;
        }
    }
    let [x, y, z, nx, ny, nz, bound] = &columns;
    (
        Vec3::load(simd, [x, y, z], 0),
        Vec3::load(simd, [nx, ny, nz], 0),
        Lanes::<S>::from_slice(simd, &bound[..Lanes::<S>::LEN]),
    )
}

/// The hits of an implicit surface.
fn locate_implicit<S: Simd>(
    simd: S,
    surface: &PreparedImplicit,
    walk: &mut Walk,
    own: &Rays<S>,
    distance: Lanes<S>,
) -> (Vec3<S>, Vec3<S>, Lanes<S>) {
    let mut spots = [NO_SPOT; MAX_LANES];
    for (lane, spot) in spots.iter_mut().enumerate().take(Lanes::<S>::LEN) {
        *spot = surface.spot(&ray_of(own, lane), distance[lane], &mut walk.implicit);
    }
    let Surface { point, normal, bound } = Surface::of_spots(simd, &spots);
    (point, normal, bound)
}

/// Takes what smooth shading needs from a mesh's own space to the world.
fn smooth_to_world<S: Simd>(simd: S, placement: &Placement, frame: &mut Frame, i: usize) {
    let [x, y, z, mut lift @ ..] = frame.hit_smooth.get_mut();
    let normal = placement.normal_to_world::<S>(Vec3::load(simd, [x, y, z], i));
    unit(simd, normal).store([x, y, z], i);
    for lane in i..i + Lanes::<S>::LEN {
        let own = DVec3::from(lift.each_ref().map(|column| column[lane]));
        let world = placement.vector_to_world(own).to_array();
        lift.iter_mut().zip(world).for_each(|(column, v)| column[lane] = v);
    }
}

/// The normals to shade with, from the gradient of the height above the surface in object space.
#[inline(always)]
pub(super) fn tilted<S: Simd>(
    simd: S,
    geometry: &Geometry,
    fields: &[&[f64]; FIELDS],
    leaf: usize,
    i: usize,
    normal: Vec3<S>,
) -> Vec3<S> {
    let gradient = Vec3::load(simd, [fields[BUMP], fields[BUMP + 1], fields[BUMP + 2]], i);
    let gradient =
        geometry.placement(leaf).map_or(gradient, |placement| placement.normal_to_world::<S>(gradient));
    // Heights are above the shape, also where that is turned inside out.
    let gradient = if geometry.is_turned(leaf) { negated(gradient) } else { gradient };
    let along = gradient.sub(normal.scale(gradient.dot(normal)));
    unit(simd, normal.sub(along))
}

/// The mirrored rays of a frame: `reflectPt`.
#[inline(always)]
pub(super) fn reflect<S: Simd>(simd: S, scene: &Integrator, frame: &Frame, next: &mut Frame) {
    next.begin(if scene.exact { Background::Scene } else { Background::Black }, frame.len);
    for group in &frame.groups {
        let material = scene.material(group.leaf);
        if material.reflection.vanishes() {
            continue;
        }
        let all = matches!(material.reflection, Number::Constant(_));
        let shaded = material.has_bumps || scene.geometry.is_smooth(group.leaf);
        for i in places::<S>(group.start, group.len) {
            let normal = Vec3::load(simd, frame.hit_normal.get(), i);
            let direction = Vec3::load(simd, frame.hit_direction.get(), i);
            let mirrored = direction.sub(normal.scale(normal.dot(direction) * 2.0));
            let mut point = Vec3::load(simd, frame.hit_point.get(), i);
            let mirrored = if scene.exact {
                let [x, y, z, clear, _] = frame.hit_side.get();
                let side = Vec3::load(simd, [x, y, z], i);
                let clear = Lanes::<S>::from_slice(simd, &clear[i..i + Lanes::<S>::LEN]);
                point = point.add(side.scale(clear));
                outward(simd, shaded, direction, mirrored, side)
            } else {
                mirrored
            };
            if all {
                let to = next.len + (i - group.start);
                point.store(next.origin.get_mut(), to);
                mirrored.store(next.direction.get_mut(), to);
                continue;
            }
            for lane in 0..Lanes::<S>::LEN.min(group.start + group.len - i) {
                if material.reflection.of(&frame.fields.get(), i + lane) != 0.0 {
                    push(next, lane_of(point, lane), lane_of(mirrored, lane), i + lane);
                }
            }
        }
        if all {
            extend_parents(next, group);
        }
    }
    next.origin.pad(next.len);
    next.direction.pad(next.len);
}

/// Mirrored directions; where bumps or smooth normals would mirror into the surface, those of the surface itself.
#[inline(always)]
fn outward<S: Simd>(simd: S, shaded: bool, direction: Vec3<S>, mirrored: Vec3<S>, side: Vec3<S>) -> Vec3<S> {
    if !shaded {
        return unit(simd, mirrored);
    }
    let plain = direction.sub(side.scale(side.dot(direction) * 2.0));
    let out = mirrored.dot(side).simd_gt(0.0);
    let mirrored = Vec3 {
        x: out.select(mirrored.x, plain.x),
        y: out.select(mirrored.y, plain.y),
        z: out.select(mirrored.z, plain.z),
    };
    unit(simd, mirrored)
}

#[inline(always)]
fn lane_of<S: Simd>(v: Vec3<S>, lane: usize) -> [f64; 3] {
    [v.x[lane], v.y[lane], v.z[lane]]
}

fn extend_parents(next: &mut Frame, group: &Group) {
    next.parent.extend((group.start..group.start + group.len).map(|place| place as u32));
    next.len += group.len;
}

/// Appends one ray that is owed to a hit.
fn push(next: &mut Frame, from: [f64; 3], toward: [f64; 3], hit: usize) {
    let to = next.len;
    next.origin.get_mut().into_iter().zip(from).for_each(|(column, v)| column[to] = v);
    next.direction.get_mut().into_iter().zip(toward).for_each(|(column, v)| column[to] = v);
    next.parent.push(hit as u32);
    next.len += 1;
}

/// The refracted rays of a frame: `refractPt`. Where all light is reflected inside there is none by the thesis'
/// rules, and by the exact ones the mirrored ray.
#[inline(always)]
pub(super) fn refract<S: Simd>(simd: S, scene: &Integrator, frame: &Frame, next: &mut Frame) {
    next.begin(if scene.exact { Background::Scene } else { Background::PerRay }, frame.len);
    for group in &frame.groups {
        let material = scene.material(group.leaf);
        if material.transmission.vanishes() {
            continue;
        }
        let shaded = material.has_bumps || scene.geometry.is_smooth(group.leaf);
        for i in places::<S>(group.start, group.len) {
            let fields = frame.fields.get();
            let normal = Vec3::load(simd, frame.hit_normal.get(), i);
            let direction = Vec3::load(simd, frame.hit_direction.get(), i);
            let index = material.refractive_index.load(simd, &fields, i);
            let lanes = Lanes::<S>::LEN.min(group.start + group.len - i);
            if scene.exact {
                let (from, toward) = exactly_refracted(simd, frame, shaded, i, [direction, normal], index);
                for lane in 0..lanes {
                    if material.transmission.of(&fields, i + lane) != 0.0 {
                        push(next, lane_of(from, lane), lane_of(toward, lane), i + lane);
                    }
                }
                continue;
            }
            let point = Vec3::load(simd, frame.hit_point.get(), i);
            let refracted = refracted(simd, direction, normal, index);
            for lane in 0..lanes {
                let toward = lane_of(refracted, lane);
                let share = material.transmission.of(&fields, i + lane);
                if toward != [0.0; 3] && share != 0.0 {
                    push_behind(scene, share, frame, next, i + lane);
                    push(next, lane_of(point, lane), toward, i + lane);
                }
            }
        }
    }
    next.origin.pad(next.len);
    next.direction.pad(next.len);
}

/// Notes the background that the next ray will see: by the thesis' rules that of the ray that is refracted, times
/// the transparency.
fn push_behind(scene: &Integrator, share: f64, frame: &Frame, next: &mut Frame, hit: usize) {
    let ray = frame.slot[hit] as usize;
    let behind = match frame.background {
        Background::Scene => scene.uniform_background(),
        Background::Black => [0.0; 3],
        Background::PerRay => frame.behind.get().map(|column| column[ray]),
    };
    let to = next.len;
    next.behind.get_mut().into_iter().zip(behind).for_each(|(column, v)| column[to] = v * share);
}

/// `refractDir` of appendix A.1: the direction zero where all light is reflected inside.
#[inline(always)]
fn refracted<S: Simd>(simd: S, incoming: Vec3<S>, normal: Vec3<S>, index: Lanes<S>) -> Vec3<S> {
    let cosine = normal.dot(negated(incoming));
    let leaving = cosine.simd_lt(0.0);
    let ratio = leaving.select(index, Lanes::<S>::splat(simd, 1.0) / index);
    let v = ratio * ratio * (cosine * cosine - 1.0) + 1.0;
    let bend = ratio * cosine.abs() - v.sqrt();
    let (direction, _) = incoming.scale(ratio).add(normal.scale(bend)).norm(simd);
    direction.zero_where(simd, v.simd_lt(0.0))
}

/// Where refracted rays start, and their directions by Snell's law, on the way in and out alike.
#[inline(always)]
fn exactly_refracted<S: Simd>(
    simd: S,
    frame: &Frame,
    shaded: bool,
    i: usize,
    [incoming, normal]: [Vec3<S>; 2],
    index: Lanes<S>,
) -> (Vec3<S>, Vec3<S>) {
    let [x, y, z, clear, outside] = frame.hit_side.get();
    let side = Vec3::load(simd, [x, y, z], i);
    let load = |column: &[f64]| Lanes::<S>::from_slice(simd, &column[i..i + Lanes::<S>::LEN]);
    let (clear, outside) = (load(clear), load(outside));
    let one = Lanes::<S>::splat(simd, 1.0);
    // Bumps may turn a normal away from the viewer; there light is refracted as without them.
    let cosine = -normal.dot(incoming);
    let turned = cosine.simd_le(0.0);
    let normal = Vec3 {
        x: turned.select(side.x, normal.x),
        y: turned.select(side.y, normal.y),
        z: turned.select(side.z, normal.z),
    };
    let cosine = -normal.dot(incoming);
    let ratio = outside.simd_gt(0.0).select(one / index, index);
    let squared_sine = ratio * ratio * (one - cosine * cosine);
    let through = squared_sine.simd_le(1.0);
    let bend = ratio * cosine - (one - squared_sine).sqrt();
    let bent = incoming.scale(ratio).add(normal.scale(bend));
    let mirrored = incoming.add(normal.scale(cosine * 2.0));
    let mirrored = outward(simd, shaded, incoming, mirrored, side);
    let bent = unit(simd, bent);
    let toward = Vec3 {
        x: through.select(bent.x, mirrored.x),
        y: through.select(bent.y, mirrored.y),
        z: through.select(bent.z, mirrored.z),
    };
    // To the far side, or back to the near one.
    let clear = through.select(-clear, clear);
    let point = Vec3::load(simd, frame.hit_point.get(), i);
    (point.add(side.scale(clear)), toward)
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
