//! A tree over triangles.

use crate::build::{CHUNK, Primitive, Store, build};
use crate::memory::Array;
use crate::prefetch::prefetch;
use crate::triangle::{Block, LANES, NO_TRIANGLE, Shear, hits};
use crate::{Bounds, Leaves, Ray, Stack, Tree};
use fearless_simd::prelude::*;
use rayon::prelude::*;
use std::fmt;

/// Where a ray meets a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// How far along the ray, in units of its direction's length.
    pub distance: f32,
    /// The triangle's number.
    pub triangle: u32,
    /// The weights of its second and third vertex.
    pub weights: [f32; 2],
}

/// Why a mesh cannot be built.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum MeshError {
    /// A triangle names a vertex that is not there.
    NoSuchVertex {
        /// The triangle.
        triangle: usize,
        /// The vertex.
        vertex: u32,
    },
    /// Another number of triangles than the mesh was built of.
    OtherTriangles {
        /// How many it was built of.
        built: usize,
        /// How many there are now.
        triangles: usize,
    },
    /// A triangle that was left out when the mesh was built, because it had a coordinate that was no number or infinite, has
    /// none any more.
    LeftOut {
        /// The triangle.
        triangle: usize,
    },
    /// More triangles than the tree can number.
    TooMany {
        /// How many there are.
        triangles: usize,
    },
}

impl fmt::Display for MeshError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoSuchVertex { triangle, vertex } => {
                write!(f, "triangle {triangle} has vertex {vertex}, which is not there")
            }
            Self::OtherTriangles { built, triangles } => {
                write!(f, "there are {triangles} triangles, and the mesh was built of {built}: build it anew")
            }
            Self::LeftOut { triangle } => {
                write!(
                    f,
                    "triangle {triangle} was left out when the mesh was built, because a coordinate of it was no number or \
                     infinite; now it can be hit: build the mesh anew"
                )
            }
            Self::TooMany { triangles } => {
                write!(f, "{triangles} triangles are more than {}, the most there may be", crate::tree::MOST)
            }
        }
    }
}

impl std::error::Error for MeshError {}

/// Triangles that share vertices, in a tree.
///
/// Triangles with a coordinate that is no number, or infinite, are never hit.
#[derive(Clone, Debug, PartialEq)]
pub struct TriangleMesh {
    tree: Tree,
    blocks: Array<Block>,
    /// How many triangles there are, those included that are left out.
    triangles: usize,
    /// Those that have no box.
    left_out: Vec<u32>,
}

impl TriangleMesh {
    /// Sorts triangles into a tree. The outcome is the same for any number of threads.
    ///
    /// # Errors
    /// Where a triangle names a vertex that is not there, or where there are more than 2^27 triangles.
    pub fn build(vertices: &[[f32; 3]], triangles: &[[u32; 3]]) -> Result<Self, MeshError> {
        if triangles.len() >= crate::tree::MOST {
            return Err(MeshError::TooMany { triangles: triangles.len() });
        }
        let mut primitives = Array::zeroed(triangles.len());
        let places = primitives.par_chunks_mut(CHUNK).zip(triangles.par_chunks(CHUNK)).enumerate();
        let make = |(chunk, (places, triangles))| boxes(vertices, triangles, chunk * CHUNK, places);
        let finite: Vec<Result<usize, MeshError>> = places.map(make).collect();
        let mut total = 0;
        for (chunk, count) in finite.into_iter().enumerate() {
            let count = count?;
            if total != chunk * CHUNK {
                primitives.copy_within(chunk * CHUNK..chunk * CHUNK + count, total);
            }
            total += count;
        }
        primitives.truncate(total);
        let left_out = if total == triangles.len() {
            Vec::new()
        } else {
            let numbered = (0u32..).zip(triangles);
            numbered.filter(|(_, corners)| !is_finite(vertices, corners)).map(|(number, _)| number).collect()
        };
        let (tree, blocks) = build(primitives, &Packed { vertices, triangles });
        Ok(Self { tree, blocks, triangles: triangles.len(), left_out })
    }

    /// Takes over new places of the vertices: the boxes are worked out anew, but the tree stays as it was sorted. That is much
    /// quicker than to build it, and as good as long as neighbours stay neighbours. `triangles` are those that the mesh was
    /// built of. Those that now have a coordinate that is no number or infinite are not hit, until another call moves them
    /// back.
    ///
    /// # Errors
    /// Where a triangle names a vertex that is not there, where there are more triangles or fewer, or where one that was left
    /// out by [`Self::build`] could be hit now. Then nothing has changed.
    pub fn refit(&mut self, vertices: &[[f32; 3]], triangles: &[[u32; 3]]) -> Result<(), MeshError> {
        if triangles.len() != self.triangles {
            return Err(MeshError::OtherTriangles { built: self.triangles, triangles: triangles.len() });
        }
        for (triangle, corners) in triangles.iter().enumerate() {
            if let Some(&vertex) = corners.iter().find(|vertex| **vertex as usize >= vertices.len()) {
                return Err(MeshError::NoSuchVertex { triangle, vertex });
            }
        }
        for triangle in self.left_out.iter().map(|number| *number as usize) {
            if is_finite(vertices, &triangles[triangle]) {
                return Err(MeshError::LeftOut { triangle });
            }
        }
        self.blocks.par_iter_mut().with_min_len(1 << 10).for_each(|block| {
            for (lane, number) in block.numbers.into_iter().enumerate().filter(|(_, n)| *n != NO_TRIANGLE) {
                let corners = &triangles[number as usize];
                if is_finite(vertices, corners) {
                    block.set(lane, number, corners.map(|vertex| vertices[vertex as usize]));
                } else {
                    block.set(lane, number, [[f32::NAN; 3]; 3]);
                }
            }
        });
        let blocks = &self.blocks[..];
        self.tree.refit(|units| {
            blocks[units].iter().fold(Bounds::EMPTY, |bounds, block| bounds.union(&block.bounds()))
        });
        Ok(())
    }

    /// The box of all triangles.
    #[must_use]
    pub fn bounds(&self) -> &Bounds {
        self.tree.bounds()
    }

    /// The greatest coordinate, which rays want to know.
    #[inline(always)]
    #[must_use]
    pub fn reach(&self) -> f32 {
        self.tree.reach
    }

    /// The tree's bytes, triangles included.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.tree.bytes() + self.blocks.bytes()
    }

    /// How many nodes the tree has, and how many blocks of up to eight triangles.
    #[must_use]
    pub fn counts(&self) -> (usize, usize) {
        (self.tree.nodes(), self.blocks.len())
    }

    /// The nearest triangle that a ray meets; of two at the same distance, the one with the greater number.
    #[inline(always)]
    pub fn closest<S: Simd>(&self, simd: S, ray: &Ray, stack: &mut Stack) -> Option<Hit> {
        let mut ray = *ray;
        let mut leaves = MeshLeaves { blocks: &self.blocks, shear: Shear::new(&ray), hit: None };
        self.tree.closest(simd, &mut ray, stack, &mut leaves);
        leaves.hit
    }

    /// Whether a ray meets any triangle.
    #[inline(always)]
    pub fn any<S: Simd>(&self, simd: S, ray: &Ray, stack: &mut Stack) -> bool {
        let mut leaves = MeshLeaves { blocks: &self.blocks, shear: Shear::new(ray), hit: None };
        self.tree.any(simd, ray, stack, &mut leaves)
    }

    /// Every triangle that a ray may meet, in the order in which boxes are come to; most are missed narrowly.
    #[inline(always)]
    pub fn candidates<S: Simd>(&self, simd: S, ray: &Ray, stack: &mut Stack, found: impl FnMut(u32)) {
        let mut found = found;
        self.tree.visit(simd, ray, stack, |units| {
            self.blocks[units].iter().flat_map(Block::present).for_each(&mut found);
        });
    }

    /// The nearest hit by trying every triangle: what [`Self::closest`] has to find.
    #[must_use]
    pub fn closest_of_all<S: Simd>(&self, simd: S, ray: &Ray) -> Option<Hit> {
        let mut ray = *ray;
        let mut leaves = MeshLeaves { blocks: &self.blocks, shear: Shear::new(&ray), hit: None };
        leaves.closest(simd, &mut ray, 0..self.blocks.len());
        leaves.hit
    }
}

struct MeshLeaves<'a> {
    blocks: &'a [Block],
    shear: Shear,
    hit: Option<Hit>,
}

impl Leaves for MeshLeaves<'_> {
    #[inline(always)]
    fn prefetch(&self, unit: usize) {
        if let Some(block) = self.blocks.get(unit) {
            prefetch(block);
        }
    }

    #[inline(always)]
    fn closest<S: Simd>(&mut self, simd: S, ray: &mut Ray, units: std::ops::Range<usize>) {
        for block in &self.blocks[units] {
            let Some(found) = hits(simd, block, &self.shear, ray.near, ray.far) else { continue };
            let mut mask = found.mask;
            while mask != 0 {
                let lane = (mask.trailing_zeros() & 7) as usize;
                mask &= mask - 1;
                let (distance, triangle) = (found.distance[lane], block.numbers[lane]);
                let nearer = distance < ray.far
                    || (distance == ray.far && self.hit.is_none_or(|hit| triangle > hit.triangle));
                if nearer {
                    ray.far = distance;
                    let weights = [found.weights[0][lane], found.weights[1][lane]];
                    self.hit = Some(Hit { distance, triangle, weights });
                }
            }
        }
    }

    #[inline(always)]
    fn any<S: Simd>(&mut self, simd: S, ray: &Ray, units: std::ops::Range<usize>) -> bool {
        self.blocks[units].iter().any(
            #[inline(always)]
            |block| hits(simd, block, &self.shear, ray.near, ray.far).is_some(),
        )
    }
}

/// Whether a triangle's corners are all numbers and not infinite; they are there.
fn is_finite(vertices: &[[f32; 3]], corners: &[u32; 3]) -> bool {
    corners.iter().all(|vertex| vertices[*vertex as usize].iter().all(|x| x.is_finite()))
}

/// Makes what the tree sorts of triangles, whose numbers begin with `first`, at the beginning of `places`. Returns how many
/// there are: of triangles that have no box there is nothing.
fn boxes(
    vertices: &[[f32; 3]],
    triangles: &[[u32; 3]],
    first: usize,
    places: &mut [Primitive],
) -> Result<usize, MeshError> {
    let mut count = 0;
    for (number, corners) in (first..).zip(triangles) {
        let mut bounds = Bounds::EMPTY;
        let mut finite = true;
        for &vertex in corners {
            let Some(point) = vertices.get(vertex as usize) else {
                return Err(MeshError::NoSuchVertex { triangle: number, vertex });
            };
            finite &= point.iter().all(|x| x.is_finite());
            bounds = bounds.union(&Bounds { min: *point, max: *point });
        }
        if let Some(place) = places.get_mut(count).filter(|_| finite) {
            *place = Primitive::new(&bounds, number as u32);
            count += 1;
        }
    }
    Ok(count)
}

/// Packs the triangles of leaves into blocks.
struct Packed<'a> {
    vertices: &'a [[f32; 3]],
    triangles: &'a [[u32; 3]],
}

impl Store for Packed<'_> {
    type Unit = Block;
    const UNIT: usize = LANES;
    const NODE_COST: f32 = 1.4;

    fn unit(&self, primitives: &[Primitive]) -> Block {
        let mut block = Block::EMPTY;
        for (lane, primitive) in primitives.iter().enumerate() {
            let corners = self.triangles[primitive.number() as usize];
            block.set(lane, primitive.number(), corners.map(|vertex| self.vertices[vertex as usize]));
        }
        block
    }
}
