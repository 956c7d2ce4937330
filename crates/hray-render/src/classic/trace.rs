//! Which rays meet what, and which do not see a light.

use super::geometry::{Geometry, Root};
use super::shapes::{Prepared, Rays};
use super::solid::{Ray, Solid, Walk};
use fearless_simd::prelude::*;
use hray_core::DVec3;
use hray_expr::kernels::lanes::{Lanes, MAX_LANES, Mask};

/// The nearest hits so far: distance and leaf of each ray.
#[derive(Clone, Copy)]
pub(super) struct Nearest<S: Simd> {
    pub(super) distance: Lanes<S>,
    /// Counted from `NOTHING` of the frame, for nothing.
    pub(super) leaf: Lanes<S>,
    /// Where the leaf is a mesh, which of its triangles.
    pub(super) triangle: Lanes<S>,
}

impl<S: Simd> Nearest<S> {
    #[inline(always)]
    fn take(&mut self, distance: Lanes<S>, hit: Mask<S>, leaf: Lanes<S>) -> Mask<S> {
        // Before the first hit the distance is not a number, and nothing is farther than that.
        let nearer = hit & !distance.simd_ge(self.distance);
        self.distance = nearer.select(distance, self.distance);
        self.leaf = nearer.select(leaf, self.leaf);
        nearer
    }

    /// As [`Self::take`] does in the order of leaves, but in any order. Returns what was taken.
    #[inline(always)]
    pub(super) fn take_any(&mut self, distance: Lanes<S>, hit: Mask<S>, leaf: Lanes<S>) -> Mask<S> {
        let earlier = distance.simd_eq(self.distance) & leaf.simd_lt(self.leaf);
        let nearer = hit & (earlier | !distance.simd_ge(self.distance));
        self.distance = nearer.select(distance, self.distance);
        self.leaf = nearer.select(leaf, self.leaf);
        nearer
    }
}

/// The nearest hit of each ray: `intersect`. A later leaf must be strictly nearer. `nothing` is what a leaf's
/// number is counted from.
#[inline(always)]
pub(super) fn nearest<S: Simd>(
    simd: S,
    geometry: &Geometry,
    rays: &Rays<S>,
    nothing: f64,
    walk: &mut Walk,
) -> Nearest<S> {
    let mut nearest = Nearest {
        distance: Lanes::<S>::splat(simd, f64::NAN),
        leaf: Lanes::<S>::splat(simd, nothing),
        triangle: Lanes::<S>::splat(simd, 0.0),
    };
    for root in &geometry.roots {
        match root {
            Root::Plain(leaves) => {
                let mut which = nothing + f64::from(leaves.start);
                for shape in geometry.run(leaves) {
                    which += 1.0;
                    if let Some((distance, hit)) = shape.hit(simd, rays) {
                        nearest.take(distance, hit, Lanes::<S>::splat(simd, which));
                    }
                }
            }
            Root::Placed(leaves) => {
                for leaf in leaves.clone() {
                    if let Some((distance, hit)) = placed_hit(simd, geometry, leaf as usize, rays) {
                        let which = nothing + 1.0 + f64::from(leaf);
                        nearest.take(distance, hit, Lanes::<S>::splat(simd, which));
                    }
                }
            }
            Root::Solid(solid) => {
                let (solid, far) = (geometry.solid_at(*solid), nearest.distance);
                let [distance, leaf, triangle] =
                    solid_hit(simd, geometry, solid, rays, far, nothing + 1.0, walk);
                let taken: Mask<S> = nearest.take(distance, distance.simd_eq(distance), leaf);
                nearest.triangle = taken.select(triangle, nearest.triangle);
            }
            Root::Single(leaf) => {
                let (distance, triangle) =
                    single_hit(simd, geometry, *leaf as usize, rays, nearest.distance, walk);
                let met = distance.simd_eq(distance);
                let leaf = Lanes::<S>::splat(simd, nothing + 1.0 + f64::from(*leaf));
                let taken: Mask<S> = nearest.take_any(distance, met, leaf);
                nearest.triangle = taken.select(triangle, nearest.triangle);
            }
        }
    }
    if let Some(tree) = &geometry.tree {
        simd.vectorize(
            #[inline(always)]
            || tree.nearest(simd, geometry, rays, nothing, walk, &mut nearest),
        );
    }
    nearest
}

/// Which rays of `lanes` meet something that is not farther than `distance`; others may be among them.
#[inline(always)]
pub(super) fn shadowed<S: Simd>(
    simd: S,
    geometry: &Geometry,
    rays: &Rays<S>,
    distance: Lanes<S>,
    lanes: u32,
    walk: &mut Walk,
) -> Mask<S> {
    let mut dark = Mask::<S>::splat(simd, false);
    for root in &geometry.roots {
        match root {
            Root::Plain(leaves) => {
                for shape in geometry.run(leaves) {
                    if let Some((at, hit)) = shape.hit(simd, rays) {
                        dark |= hit & at.simd_le(distance);
                        if dark.all_true() {
                            return dark;
                        }
                    }
                }
            }
            Root::Placed(leaves) => {
                for leaf in leaves.clone() {
                    if let Some((at, hit)) = placed_hit(simd, geometry, leaf as usize, rays) {
                        dark |= hit & at.simd_le(distance);
                        if dark.all_true() {
                            return dark;
                        }
                    }
                }
            }
            Root::Solid(solid) => {
                let far = only(simd, distance, lanes & !(dark.to_bitmask() as u32));
                let [at, ..] = solid_hit(simd, geometry, geometry.solid_at(*solid), rays, far, 0.0, walk);
                // Where nothing is met, the distance is no number.
                dark |= at.simd_le(distance);
                if dark.all_true() {
                    return dark;
                }
            }
            Root::Single(leaf) => {
                let far = only(simd, distance, lanes & !(dark.to_bitmask() as u32));
                dark |= single_shadow(simd, geometry, *leaf as usize, rays, far, walk);
                if dark.all_true() {
                    return dark;
                }
            }
        }
    }
    match &geometry.tree {
        Some(tree) => {
            dark | simd.vectorize(
                #[inline(always)]
                || tree.shadowed(simd, geometry, rays, distance, lanes & !(dark.to_bitmask() as u32), walk),
            )
        }
        None => dark,
    }
}

/// Distances of the rays of `lanes`, and less than 0 for others: what takes rays one at a time leaves these out.
#[inline(always)]
pub(super) fn only<S: Simd>(simd: S, far: Lanes<S>, lanes: u32) -> Lanes<S> {
    let mut kept = [-1.0; MAX_LANES];
    for (lane, kept) in kept.iter_mut().enumerate().take(Lanes::<S>::LEN) {
        if lanes >> lane & 1 == 1 {
            *kept = far[lane];
        }
    }
    Lanes::<S>::from_slice(simd, &kept[..Lanes::<S>::LEN])
}

/// The rays that meet a leaf, one at a time, up to `far` (or at any distance, where that is no number): how far, which is no
/// number where a ray misses, and which triangle, where it is a mesh.
#[inline(always)]
pub(super) fn single_hit<S: Simd>(
    simd: S,
    geometry: &Geometry,
    leaf: usize,
    rays: &Rays<S>,
    far: Lanes<S>,
    walk: &mut Walk,
) -> (Lanes<S>, Lanes<S>) {
    let (mut distances, mut triangles) = ([f64::NAN; MAX_LANES], [0.0; MAX_LANES]);
    let shape = geometry.shape(leaf);
    for lane in (0..Lanes::<S>::LEN).filter(|lane| !is_left_out(far[*lane])) {
        let far = if far[lane] < f64::INFINITY { far[lane] } else { f64::INFINITY };
        let ends = [geometry.nearest, far];
        let ray = geometry.own_ray(leaf, &ray_of(rays, lane));
        let hit = match shape {
            Prepared::Mesh(mesh) => mesh.hit(simd, &ray, ends, &mut walk.stack),
            Prepared::Implicit(surface) => {
                let hit = surface.hit(simd, &ray, ends, &mut walk.stack, &mut walk.implicit);
                hit.map(|distance| (distance, 0))
            }
            _ => None,
        };
        if let Some((distance, triangle)) = hit {
            (distances[lane], triangles[lane]) = (distance, f64::from(triangle));
        }
    }
    let len = Lanes::<S>::LEN;
    (Lanes::<S>::from_slice(simd, &distances[..len]), Lanes::<S>::from_slice(simd, &triangles[..len]))
}

/// Which rays meet a leaf, one at a time, that is not farther than `distance`.
#[inline(always)]
pub(super) fn single_shadow<S: Simd>(
    simd: S,
    geometry: &Geometry,
    leaf: usize,
    rays: &Rays<S>,
    distance: Lanes<S>,
    walk: &mut Walk,
) -> Mask<S> {
    let mut met = [f64::NAN; MAX_LANES];
    let shape = geometry.shape(leaf);
    for lane in (0..Lanes::<S>::LEN).filter(|lane| !is_left_out(distance[*lane])) {
        let ends = [geometry.nearest, distance[lane]];
        let ray = geometry.own_ray(leaf, &ray_of(rays, lane));
        let is_met = match shape {
            Prepared::Mesh(mesh) => mesh.is_hit(simd, &ray, ends, &mut walk.stack),
            Prepared::Implicit(surface) => {
                surface.hit(simd, &ray, ends, &mut walk.stack, &mut walk.implicit).is_some()
            }
            _ => false,
        };
        if is_met {
            met[lane] = 0.0;
        }
    }
    let met = Lanes::<S>::from_slice(simd, &met[..Lanes::<S>::LEN]);
    met.simd_eq(met)
}

/// See [`only`]; before the first hit distances are no numbers.
#[inline(always)]
fn is_left_out(far: f64) -> bool {
    far < 0.0
}

/// One of the rays.
#[inline(always)]
pub(super) fn ray_of<S: Simd>(rays: &Rays<S>, lane: usize) -> Ray {
    let (o, d) = (rays.origin, rays.direction);
    Ray {
        origin: DVec3::new(o.x[lane], o.y[lane], o.z[lane]),
        direction: DVec3::new(d.x[lane], d.y[lane], d.z[lane]),
    }
}

/// Called, not inlined, so that the loop over what is in world space stays small.
#[inline(always)]
pub(super) fn placed_hit<S: Simd>(
    simd: S,
    geometry: &Geometry,
    leaf: usize,
    rays: &Rays<S>,
) -> Option<(Lanes<S>, Mask<S>)> {
    simd.vectorize(
        #[inline(always)]
        || {
            let shape: &Prepared = geometry.shape(leaf);
            match geometry.placement(leaf) {
                None => shape.hit(simd, rays),
                Some(placement) => shape.hit(simd, &placement.rays(simd, rays)),
            }
        },
    )
}

/// Distances up to `far` (or any, where that is no number), which are no numbers where the ray misses; leaves, the first of
/// the scene being `first`; and triangles, where these are meshes.
#[inline(always)]
pub(super) fn solid_hit<S: Simd>(
    simd: S,
    geometry: &Geometry,
    solid: &Solid,
    rays: &Rays<S>,
    far: Lanes<S>,
    first: f64,
    walk: &mut Walk,
) -> [Lanes<S>; 3] {
    let mut columns = [[f64::NAN; MAX_LANES], [f64::NAN; MAX_LANES], [0.0; MAX_LANES]];
    for lane in (0..Lanes::<S>::LEN).filter(|lane| !is_left_out(far[*lane])) {
        let far = if far[lane] < f64::INFINITY { far[lane] } else { f64::INFINITY };
        if let Some(hit) = solid.hit(simd, geometry, &ray_of(rays, lane), far, walk) {
            let hit = [hit.at, first + hit.leaf as f64, f64::from(hit.triangle)];
            columns.iter_mut().zip(hit).for_each(|(column, value)| column[lane] = value);
        }
    }
    columns.map(|column| Lanes::<S>::from_slice(simd, &column[..Lanes::<S>::LEN]))
}
