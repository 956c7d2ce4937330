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
}

impl<S: Simd> Nearest<S> {
    #[inline(always)]
    fn take(&mut self, distance: Lanes<S>, hit: Mask<S>, leaf: Lanes<S>) {
        // Before the first hit the distance is not a number, and nothing is farther than that.
        let nearer = hit & !distance.simd_ge(self.distance);
        self.distance = nearer.select(distance, self.distance);
        self.leaf = nearer.select(leaf, self.leaf);
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
    let mut nearest =
        Nearest { distance: Lanes::<S>::splat(simd, f64::NAN), leaf: Lanes::<S>::splat(simd, nothing) };
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
                let (distance, leaf) =
                    solid_hit(simd, geometry, geometry.solid_at(*solid), rays, nothing + 1.0, walk);
                nearest.take(distance, distance.simd_eq(distance), leaf);
            }
        }
    }
    nearest
}

/// Which rays meet something that is not farther than `distance`.
#[inline(always)]
pub(super) fn shadowed<S: Simd>(
    simd: S,
    geometry: &Geometry,
    rays: &Rays<S>,
    distance: Lanes<S>,
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
                let (at, _) = solid_hit(simd, geometry, geometry.solid_at(*solid), rays, 0.0, walk);
                // Where nothing is met, the distance is no number.
                dark |= at.simd_le(distance);
                if dark.all_true() {
                    return dark;
                }
            }
        }
    }
    dark
}

/// Called, not inlined, so that the loop over what is in world space stays small.
#[inline(always)]
fn placed_hit<S: Simd>(
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

/// Distances, which are no numbers where the ray misses, and leaves, the first of the scene being `first`.
#[inline(always)]
fn solid_hit<S: Simd>(
    simd: S,
    geometry: &Geometry,
    solid: &Solid,
    rays: &Rays<S>,
    first: f64,
    walk: &mut Walk,
) -> (Lanes<S>, Lanes<S>) {
    let mut found = [[f64::NAN; MAX_LANES]; 2];
    let (o, d) = (rays.origin, rays.direction);
    for lane in 0..Lanes::<S>::LEN {
        let ray = Ray {
            origin: DVec3::new(o.x[lane], o.y[lane], o.z[lane]),
            direction: DVec3::new(d.x[lane], d.y[lane], d.z[lane]),
        };
        if let Some((distance, leaf)) = solid.hit(geometry, &ray, walk) {
            found[0][lane] = distance;
            found[1][lane] = first + leaf as f64;
        }
    }
    let [distance, leaf] = found;
    let len = Lanes::<S>::LEN;
    (Lanes::<S>::from_slice(simd, &distance[..len]), Lanes::<S>::from_slice(simd, &leaf[..len]))
}
