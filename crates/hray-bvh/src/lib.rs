//! Bounding volume hierarchies: which of many things a ray meets first.
//!
//! A [`Tree`] sorts boxes into nodes of eight, whose bounds one ray is tested against at once. What the boxes hold is the
//! caller's: a [`Leaves`] tests the things of a leaf. [`TriangleMesh`] is a tree over triangles with a watertight test.
//!
//! Culling never changes what is found. Boxes are tested conservatively: a ray's own slabs are widened by what rounding may
//! have moved the result of a test in a leaf ([`Ray::new`]), so that a tree finds what a walk over all things would find,
//! ties included (the one with the greater number wins).

mod bounds;
mod build;
mod collapse;
mod memory;
mod mesh;
mod packet;
mod prefetch;
mod ray;
mod tree;
mod triangle;

pub use bounds::Bounds;
pub use mesh::{Hit, MeshError, TriangleMesh};
pub use packet::{AnyLeaves, ClosestLeaves, MOST_RAYS, Packet, PacketStack};
pub use ray::{Ray, SLACK};
pub use tree::{Leaves, Stack, Tree};
