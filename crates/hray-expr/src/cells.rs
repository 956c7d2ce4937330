//! Worley's cellular texture at one point: the definition, plain and slow.
//!
//! Every unit cell has one feature point, anywhere in it. The own cell's is at most sqrt(3) away, and so is that
//! of the nearest neighbour cell; whatever lies two cells further is at least 2 away. So the 5 x 5 x 5 cells around
//! a point always hold the two nearest; the 3 x 3 x 3 around it, which hold everything within 1, do not.

use crate::apply::{mix, unit};
use crate::noise::cell;

/// How far apart neighbouring cells are in the count that is hashed, along each axis: odd, without pattern.
pub(crate) const STRIDES: [u64; 3] = [0x9E37_79B9_7F4A_7C15, 0xC2B2_AE3D_27D4_EB4F, 0x1656_67B1_9E37_79F9];
/// What distinguishes the number that belongs to a feature point from its place.
pub(crate) const IDENTITY: u64 = 0x2545_F491_4F6C_DD1D;

/// The cells around a point's own, nearest kind first: itself, then those that share a face, an edge, a corner,
/// then the 98 beyond. Where two feature points are equally near, the earlier cell's counts as the nearest.
pub(crate) const AROUND: [[i8; 3]; 125] = around();
/// How many of [`AROUND`] are at most one cell away.
pub(crate) const NEAR: usize = 27;

const fn around() -> [[i8; 3]; 125] {
    let mut cells = [[0; 3]; 125];
    let mut len = 0;
    // The squared distance, for those beyond after that of all the others.
    let mut rank = 0;
    while rank < 32 {
        let mut i = 0;
        while i < 125 {
            let offset: [i32; 3] = [i % 5 - 2, i / 5 % 5 - 2, i / 25 - 2];
            let squared = offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2];
            let beyond = offset[0].abs() == 2 || offset[1].abs() == 2 || offset[2].abs() == 2;
            if rank == squared + 16 * beyond as i32 {
                cells[len] = [offset[0] as i8, offset[1] as i8, offset[2] as i8];
                len += 1;
            }
            i += 1;
        }
        rank += 1;
    }
    cells
}

/// The distances from a point to the nearest and to the second nearest feature point, a number in [0, 1) that
/// belongs to the nearest, and the vector (x, y, z) to it.
///
/// S. Worley, "A Cellular Texture Basis Function", SIGGRAPH 1996, with one feature point a unit cell, at a place
/// that a hash of the cell and the seed gives: coordinates are multiples of 2^-21. Where a coordinate of the point
/// is infinite or not a number the distances are infinite and the rest is 0.
#[must_use]
pub fn cells(seed: u64, p: [f64; 3]) -> [f64; 6] {
    let own = p.map(cell);
    let fraction = p.map(|v| v - v.floor());
    let (mut first, mut second) = (f64::INFINITY, f64::INFINITY);
    let (mut hash, mut vector) = (None, [0.0; 3]);
    for offset in AROUND {
        let h = feature(seed, own, offset);
        let d = [0, 1, 2].map(|axis| (f64::from(offset[axis]) + place(h, axis)) - fraction[axis]);
        let squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        if squared < first {
            (first, second) = (squared, first);
            (hash, vector) = (Some(h), d);
        } else if squared < second {
            second = squared;
        }
    }
    let identity = hash.map_or(0.0, |h| unit(mix(h ^ IDENTITY)));
    [first.sqrt(), second.sqrt(), identity, vector[0], vector[1], vector[2]]
}

/// The hash of a neighbour of the cell `own`.
fn feature(seed: u64, own: [u64; 3], offset: [i8; 3]) -> u64 {
    let mut number = mix(seed);
    for axis in 0..3 {
        let cell = own[axis].wrapping_add_signed(offset[axis].into());
        number = number.wrapping_add(cell.wrapping_mul(STRIDES[axis]));
    }
    mix(number)
}

/// Where the feature point of a hash is in its cell along an axis.
fn place(hash: u64, axis: usize) -> f64 {
    ((hash >> (21 * axis)) & 0x1F_FFFF) as f64 / f64::from(1 << 21)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cells_around_are_all_there_and_the_near_ones_first() {
        let mut sorted = AROUND;
        sorted.sort_unstable();
        assert!(sorted.windows(2).all(|pair| pair[0] != pair[1]));
        assert_eq!(AROUND[0], [0; 3]);
        assert!(AROUND.iter().take(NEAR).flatten().all(|o| o.abs() <= 1));
    }

    /// Against a search of 9 x 9 x 9 cells, everything counted from the lattice.
    #[test]
    fn the_two_nearest_are_found() {
        for n in 0..300u64 {
            let p = [0, 1, 2].map(|axis| unit(mix(n * 3 + axis)) * 20.0 - 10.0);
            let own = p.map(cell);
            let mut distances = Vec::new();
            for i in 0..729 {
                let offset = [i % 9 - 4, i / 9 % 9 - 4, i / 81 - 4];
                let h = feature(5, own, offset.map(|o| o as i8));
                let d = |axis: usize| p[axis].floor() + f64::from(offset[axis]) + place(h, axis) - p[axis];
                distances.push((d(0) * d(0) + d(1) * d(1) + d(2) * d(2)).sqrt());
            }
            distances.sort_by(f64::total_cmp);
            let [first, second, identity, x, y, z] = cells(5, p);
            assert!((first - distances[0]).abs() < 1e-12 && (second - distances[1]).abs() < 1e-12);
            assert!((0.0..1.0).contains(&identity));
            assert!(((x * x + y * y + z * z).sqrt() - first).abs() < 1e-15);
        }
    }

    #[test]
    fn a_feature_point_is_one_seen_from_everywhere() {
        let [.., x, y, z] = cells(1, [0.5, 0.5, 0.5]);
        let [first, _, identity, ..] = cells(1, [0.5 + x, 0.5 + y, 0.5 + z]);
        assert!(first < 1e-12);
        assert_eq!(identity, cells(1, [0.5, 0.5, 0.5])[2]);
    }

    #[test]
    fn strange_coordinates_are_defined() {
        let nothing = [f64::INFINITY, f64::INFINITY, 0.0, 0.0, 0.0, 0.0];
        assert_eq!(cells(1, [f64::NAN, 0.0, 0.0]), nothing);
        assert_eq!(cells(1, [0.0, f64::INFINITY, 0.0]), nothing);
        assert!(cells(1, [1e300, -1e17, 0.5])[0] < 2.0);
    }
}
