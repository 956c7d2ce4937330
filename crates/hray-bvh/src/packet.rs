//! Rays that walk through a tree together. Each is tested against the boxes that it would be tested against alone, but what
//! is in a leaf can be tested for all at once, and neighbours share the waits for memory and the branches.

use crate::prefetch::prefetch;
use crate::ray::{FLATTEST, SLACK};
use crate::tree::{Child, LEAF, Node, Tree, WIDTH, entry, plane};
use fearless_simd::f32x8;
use fearless_simd::prelude::*;
use std::ops::Range;

/// The most rays of a packet.
pub const MOST_RAYS: usize = 8;

/// Rays made ready for boxes, as columns of one number of each ray. See [`Ray::new`](crate::Ray::new).
#[derive(Clone, Copy, Debug)]
pub struct Packet {
    /// How far each ray goes, in units of its direction's length; never more than the greatest single.
    pub far: [f32; MOST_RAYS],
    inverse: [[f32; MOST_RAYS]; 3],
    first: [[f32; MOST_RAYS]; 3],
    last: [[f32; MOST_RAYS]; 3],
    /// A bit for each ray that goes down the axis.
    down: [u32; 3],
    /// The rays whose numbers are in the range of single precision.
    sane: u32,
}

impl Packet {
    /// Makes rays ready for things whose greatest coordinate is `reach`, from columns of the coordinates of where they start and
    /// where they go. They count from distance 0 on.
    #[inline(always)]
    #[must_use]
    pub fn new<S: Simd>(
        simd: S,
        origin: &[[f32; MOST_RAYS]; 3],
        direction: &[[f32; MOST_RAYS]; 3],
        far: &[f32; MOST_RAYS],
        reach: f32,
    ) -> Self {
        let slack = (greatest(simd, origin) + reach) * SLACK;
        let flattest = greatest(simd, direction) * FLATTEST;
        let mut packet = Self {
            far: *far,
            inverse: [[0.0; MOST_RAYS]; 3],
            first: [[0.0; MOST_RAYS]; 3],
            last: [[0.0; MOST_RAYS]; 3],
            down: [0; 3],
            sane: 0,
        };
        let mut sum = f32x8::splat(simd, 0.0);
        for axis in 0..3 {
            let along: f32x8<S> = direction[axis].simd_into(simd);
            let from: f32x8<S> = origin[axis].simd_into(simd);
            let flat = along.abs().simd_lt(flattest);
            let inverse = f32x8::splat(simd, 1.0) / flat.select(flattest.copysign(along), along);
            let (centre, widen) = (from * inverse, inverse.abs() * slack);
            let (first, last) = (-(centre + widen), widen - centre);
            sum = sum + first.abs() + last.abs();
            packet.down[axis] = inverse.simd_lt(0.0).to_bitmask() as u32;
            packet.inverse[axis] = inverse.into();
            packet.first[axis] = first.into();
            packet.last[axis] = last.into();
        }
        packet.sane = sum.simd_lt(f32::INFINITY).to_bitmask() as u32;
        let far: f32x8<S> = (*far).simd_into(simd);
        packet.far = far.simd_lt(f32::MAX).select(far, f32x8::splat(simd, f32::MAX)).into();
        packet
    }

    /// Whether the first `count` rays can meet anything: where a ray's numbers leave the range of single precision, its walk
    /// finds nothing.
    #[inline(always)]
    #[must_use]
    pub fn is_sane(&self, count: usize) -> bool {
        let all = (1 << count) - 1;
        self.sane & all == all
    }

    /// Where a ray enters each child of a node, and a bit for each that it meets.
    #[inline(always)]
    fn enter<S: Simd>(&self, simd: S, node: &Node, lane: usize) -> (f32x8<S>, u64) {
        let lane = lane & (MOST_RAYS - 1);
        let [dx, dy, dz] = self.down.map(|bits| (bits >> lane & 1) as usize);
        let ([ix, iy, iz], [fx, fy, fz], [lx, ly, lz]) = (&self.inverse, &self.first, &self.last);
        let bounds = &node.bounds;
        let x0 = plane(simd, &bounds[dx & 1], ix[lane], fx[lane]);
        let y0 = plane(simd, &bounds[2 + (dy & 1)], iy[lane], fy[lane]);
        let z0 = plane(simd, &bounds[4 + (dz & 1)], iz[lane], fz[lane]);
        let x1 = plane(simd, &bounds[1 - (dx & 1)], ix[lane], lx[lane]);
        let y1 = plane(simd, &bounds[3 - (dy & 1)], iy[lane], ly[lane]);
        let z1 = plane(simd, &bounds[5 - (dz & 1)], iz[lane], lz[lane]);
        let enter = x0.max(y0).max(z0.max(f32x8::splat(simd, 0.0)));
        let leave = x1.min(y1).min(z1.min(f32x8::splat(simd, self.far[lane])));
        let met = enter.simd_le(leave);
        (met.select(enter, f32x8::splat(simd, f32::INFINITY)), met.to_bitmask())
    }

    /// Which rays go as far as a distance.
    #[inline(always)]
    fn reaching<S: Simd>(&self, simd: S, distance: f32) -> u32 {
        let far: f32x8<S> = self.far.simd_into(simd);
        far.simd_ge(distance).to_bitmask() as u32
    }
}

/// The greatest magnitude of each vector's components.
#[inline(always)]
fn greatest<S: Simd>(simd: S, columns: &[[f32; MOST_RAYS]; 3]) -> f32x8<S> {
    let [x, y, z] = columns;
    let (x, y, z): (f32x8<S>, f32x8<S>, f32x8<S>) =
        ((*x).simd_into(simd), (*y).simd_into(simd), (*z).simd_into(simd));
    x.abs().max(y.abs()).max(z.abs())
}

/// Tests what is in a leaf for the nearest hits of several rays.
pub trait ClosestLeaves<S: Simd> {
    /// Tests a leaf's units, and shortens the rays (`far`) to what they meet. Only the rays of `lanes` are known to meet the
    /// leaf's box; others may be tested as well. What lies as far as `far` counts.
    fn closest(&mut self, simd: S, rays: &mut Packet, lanes: u32, units: Range<usize>);
}

/// Tests what is in a leaf for any hits of several rays.
pub trait AnyLeaves<S: Simd> {
    /// Which of the rays of `lanes` meet any of a leaf's units; others may be among them if they do.
    fn any(&mut self, simd: S, lanes: u32, units: Range<usize>) -> u32;
}

#[derive(Clone, Copy, Debug, Default)]
struct Entry {
    /// Distance and child.
    key: u64,
    /// The rays that meet it.
    lanes: u32,
}

/// What a walk has still to visit; made once for many packets.
#[derive(Clone, Debug, Default)]
pub struct PacketStack {
    entries: Vec<Entry>,
}

impl Tree {
    /// Visits leaves, roughly from the nearest on, until what remains is farther than the `far` of each ray of `lanes`.
    #[inline(always)]
    pub fn closest_packet<S: Simd>(
        &self,
        simd: S,
        rays: &mut Packet,
        lanes: u32,
        stack: &mut PacketStack,
        leaves: &mut impl ClosestLeaves<S>,
    ) {
        self.walk_packet(
            simd,
            rays,
            lanes,
            stack,
            #[inline(always)]
            |simd, rays, lanes, units| {
                leaves.closest(simd, rays, lanes, units);
                0
            },
        );
    }

    /// Which of the rays of `lanes` meet anything, as bits.
    #[inline(always)]
    pub fn any_packet<S: Simd>(
        &self,
        simd: S,
        rays: &mut Packet,
        lanes: u32,
        stack: &mut PacketStack,
        leaves: &mut impl AnyLeaves<S>,
    ) -> u32 {
        self.walk_packet(
            simd,
            rays,
            lanes,
            stack,
            #[inline(always)]
            |simd, _, lanes, units| leaves.any(simd, lanes, units),
        )
    }

    /// The walk. `visit` says which rays need not go on; so does what is returned.
    #[inline(always)]
    fn walk_packet<S: Simd>(
        &self,
        simd: S,
        rays: &mut Packet,
        lanes: u32,
        stack: &mut PacketStack,
        mut visit: impl FnMut(S, &mut Packet, u32, Range<usize>) -> u32,
    ) -> u32 {
        let Some(root) = self.root else { return 0 };
        let nodes = &self.nodes[..];
        let all = lanes & rays.sane;
        if all == 0 {
            return 0;
        }
        if stack.entries.len() < self.stack {
            stack.entries.resize(self.stack, Entry::default());
        }
        let entries = &mut stack.entries[..];
        let (mut done, mut top) = (0, 0);
        let (mut child, mut lanes) = (root.0, all);
        loop {
            if child & LEAF == 0 {
                let node = &nodes[child as usize];
                let (nearest, met) = enter(simd, node, rays, lanes);
                let mut any = fold(met);
                if any != 0 {
                    let distances: [f32; WIDTH] = nearest.into();
                    let bottom = top;
                    let mut first = Entry { key: u64::MAX, lanes: 0 };
                    while any != 0 {
                        let slot = (any.trailing_zeros() & 7) as usize;
                        any &= any - 1;
                        let reference = node.child(slot);
                        // A leaf's number is that of no node.
                        if let Some(node) = nodes.get(reference as usize) {
                            prefetch(node);
                        }
                        let new = Entry { key: entry(distances[slot], reference), lanes: of_slot(met, slot) };
                        let farther =
                            if new.key < first.key { std::mem::replace(&mut first, new) } else { new };
                        if farther.lanes == 0 {
                            continue;
                        }
                        let mut at = top;
                        while at > bottom && entries[at - 1].key < farther.key {
                            entries[at] = entries[at - 1];
                            at -= 1;
                        }
                        entries[at] = farther;
                        top += 1;
                    }
                    (child, lanes) = (first.key as u32, first.lanes);
                    continue;
                }
            } else {
                done |= visit(simd, rays, lanes, Child(child).units());
                if done & all == all {
                    return done;
                }
            }
            loop {
                if top == 0 {
                    return done;
                }
                top -= 1;
                let next = entries[top];
                let distance = f32::from_bits((next.key >> 32) as u32);
                let going = next.lanes & !done & rays.reaching(simd, distance);
                if going != 0 {
                    (child, lanes) = (next.key as u32, going);
                    break;
                }
            }
        }
    }
}

/// Where the first of the rays enters each child, and for each ray a byte of which children it meets.
#[inline(always)]
fn enter<S: Simd>(simd: S, node: &Node, rays: &Packet, lanes: u32) -> (f32x8<S>, u64) {
    let (mut nearest, mut met) = (f32x8::splat(simd, f32::INFINITY), 0);
    let mut rest = lanes;
    while rest != 0 {
        let lane = rest.trailing_zeros() as usize;
        rest &= rest - 1;
        let (at, children) = rays.enter(simd, node, lane);
        nearest = nearest.min(at);
        met |= children << (8 * lane);
    }
    (nearest, met)
}

/// The children that any ray meets.
#[inline(always)]
fn fold(met: u64) -> u32 {
    let four = met | met >> 32;
    let two = four | four >> 16;
    ((two | two >> 8) & 0xFF) as u32
}

/// The rays that meet a child: one bit of each byte, gathered in the highest by a product without carries.
#[inline(always)]
fn of_slot(met: u64, slot: usize) -> u32 {
    ((met >> slot & 0x0101_0101_0101_0101).wrapping_mul(0x0102_0408_1020_4080) >> 56) as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_are_gathered() {
        for met in [0u64, 1, 0x8040_2010_0804_0201, u64::MAX, 0x1234_5678_9ABC_DEF0, 0xFF00_0000_0000_0000] {
            for slot in 0..8 {
                let expected =
                    (0..8).map(|lane| ((met >> (8 * lane + slot) & 1) as u32) << lane).sum::<u32>();
                assert_eq!(of_slot(met, slot), expected, "{met:x} {slot}");
            }
            assert_eq!(fold(met), met.to_le_bytes().iter().fold(0, |a, b| a | u32::from(*b)));
        }
    }
}
