//! Rays that walk through a tree together. Each is tested against the boxes that it would be tested against alone, but what
//! is in a leaf can be tested for all at once, and neighbours share the waits for memory and the branches.

use crate::Ray;
use crate::prefetch::prefetch;
use crate::tree::{COUNT_SHIFT, LEAF, MOST, Node, Tree, WIDTH, entry};
use fearless_simd::f32x8;
use fearless_simd::prelude::*;
use std::ops::Range;

/// The most rays of a packet.
pub const MOST_RAYS: usize = 8;

/// Tests what is in a leaf, for several rays.
pub trait PacketLeaves {
    /// Tests a leaf's units for the nearest hits, and shortens the rays (`far`) to them. Only the rays of `lanes` are known to
    /// meet the leaf's box; others may be tested as well. What lies as far as `far` counts.
    fn closest<S: Simd>(&mut self, simd: S, rays: &mut [Ray], lanes: u32, units: Range<usize>);

    /// Which of the rays of `lanes` meet any of a leaf's units; others may be among them if they do.
    fn any<S: Simd>(&mut self, simd: S, rays: &[Ray], lanes: u32, units: Range<usize>) -> u32;
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
    /// Visits leaves, roughly from the nearest on, until what remains is farther than each ray's `far`. There are at most
    /// [`MOST_RAYS`] rays.
    #[inline(always)]
    pub fn closest_packet<S: Simd>(
        &self,
        simd: S,
        rays: &mut [Ray],
        stack: &mut PacketStack,
        leaves: &mut impl PacketLeaves,
    ) {
        self.walk_packet(
            simd,
            rays,
            stack,
            #[inline(always)]
            |simd, rays, lanes, units| {
                leaves.closest(simd, rays, lanes, units);
                0
            },
        );
    }

    /// Which rays meet anything, as bits. There are at most [`MOST_RAYS`] rays.
    #[inline(always)]
    pub fn any_packet<S: Simd>(
        &self,
        simd: S,
        rays: &mut [Ray],
        stack: &mut PacketStack,
        leaves: &mut impl PacketLeaves,
    ) -> u32 {
        self.walk_packet(
            simd,
            rays,
            stack,
            #[inline(always)]
            |simd, rays, lanes, units| leaves.any(simd, rays, lanes, units),
        )
    }

    /// The walk. `visit` says which rays need not go on; so does what is returned.
    #[inline(always)]
    fn walk_packet<S: Simd>(
        &self,
        simd: S,
        rays: &mut [Ray],
        stack: &mut PacketStack,
        mut visit: impl FnMut(S, &mut [Ray], u32, Range<usize>) -> u32,
    ) -> u32 {
        let Some(root) = self.root else { return 0 };
        let count = rays.len().min(MOST_RAYS);
        let rays = &mut rays[..count];
        if stack.entries.len() < self.stack {
            stack.entries.resize(self.stack, Entry::default());
        }
        let entries = &mut stack.entries[..];
        let all = (1u32 << count) - 1;
        let (mut done, mut top) = (0, 0);
        let (mut child, mut lanes) = (root.0, all);
        loop {
            if child & LEAF == 0 {
                let node = &self.nodes[child as usize];
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
                        if reference & LEAF == 0 {
                            if let Some(node) = self.nodes.get(reference as usize) {
                                prefetch(node);
                            }
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
                let first = (child & (MOST as u32 - 1)) as usize;
                let count = ((child & !LEAF) >> COUNT_SHIFT) as usize + 1;
                done |= visit(simd, rays, lanes, first..first + count);
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
                let going = next.lanes & !done;
                let distance = f32::from_bits((next.key >> 32) as u32);
                if going != 0 && reaches(rays, going, distance) {
                    (child, lanes) = (next.key as u32, going);
                    break;
                }
            }
        }
    }
}

/// Where the first of the rays enters each child, and for each ray a byte of which children it meets.
#[inline(always)]
fn enter<S: Simd>(simd: S, node: &Node, rays: &[Ray], lanes: u32) -> (f32x8<S>, u64) {
    let mut nearest = f32x8::splat(simd, f32::INFINITY);
    let mut met = 0;
    for (lane, ray) in rays.iter().enumerate() {
        if lanes >> lane & 1 == 1 {
            let (at, mask) = node.enter(simd, ray, ray.far);
            nearest = nearest.min(mask.select(at, f32x8::splat(simd, f32::INFINITY)));
            met |= mask.to_bitmask() << (8 * lane);
        }
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

#[inline(always)]
fn reaches(rays: &[Ray], lanes: u32, distance: f32) -> bool {
    let mut reaches = false;
    for (lane, ray) in rays.iter().enumerate() {
        reaches |= (lanes >> lane & 1 == 1) & (distance <= ray.far);
    }
    reaches
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
