//! Building a tree from the top down by the surface area heuristic over bins (Wald, *On Fast Construction of SAH-based Bounding
//! Volume Hierarchies*, 2007): a large set is cut in two until there are eight, each time the one with the greatest surface; a
//! small one is cut down to its leaves, and what comes of that is made a tree of eight ([`Collapse`]).
//!
//! What is cut where depends on the boxes alone; threads build disjoint parts, which are put together in order.

use crate::Bounds;
use crate::collapse::{Binary, Collapse};
use crate::memory::{Array, Plain};
use crate::tree::{Child, MOST_UNITS, Node, Tree, WIDTH};
use fearless_simd::{Level, dispatch, f32x4, prelude::*};
use rayon::prelude::*;
use zerocopy::{FromBytes, Immutable, IntoBytes, KnownLayout};

/// A thing to be sorted into the tree: half a cache line, read as two vectors.
#[repr(C, align(32))]
#[derive(Clone, Copy, Debug, FromBytes, IntoBytes, Immutable, KnownLayout)]
pub(crate) struct Primitive {
    /// The fourth is not used.
    min: [f32; 4],
    /// The fourth holds, in the bits below `MARK`, what the caller calls the thing.
    max: [f32; 4],
}

/// Makes a number the bits of a float between 2 and 2^17: arithmetic in all four lanes never meets a subnormal number, which
/// is slow.
const MARK: u32 = 1 << 30;

impl Primitive {
    pub(crate) fn new(bounds: &Bounds, number: u32) -> Self {
        let ([a, b, c], [d, e, f]) = (bounds.min, bounds.max);
        Self { min: [a, b, c, 0.0], max: [d, e, f, f32::from_bits(number | MARK)] }
    }

    /// What the caller calls it.
    pub(crate) fn number(&self) -> u32 {
        self.max[3].to_bits() & !MARK
    }

    #[inline(always)]
    fn middle(&self, axis: usize) -> f32 {
        0.5 * self.min[axis] + 0.5 * self.max[axis]
    }
}

/// What leaves are made of: units of up to `UNIT` things that are tested together.
pub(crate) trait Store: Sync {
    type Unit: Plain;
    const UNIT: usize;
    /// What a node costs, where a unit costs 1.
    const NODE_COST: f32;
    /// Makes one.
    fn unit(&self, primitives: &[Primitive]) -> Self::Unit;
}

const MOST_BINS: usize = 32;
/// Sets of more things are built by several threads.
const PARALLEL: usize = 1 << 13;
/// Things that a thread bins at a time.
pub(crate) const CHUNK: usize = 1 << 15;
/// Deeper down, sets are halved.
const DEEPEST: usize = 40;

/// A box to be widened quickly; the fourth lane is not used.
#[derive(Clone, Copy)]
#[repr(C, align(32))]
struct Wide {
    min: [f32; 4],
    max: [f32; 4],
}

impl Wide {
    const EMPTY: Self = Self { min: [f32::INFINITY; 4], max: [f32::NEG_INFINITY; 4] };

    #[inline(always)]
    fn add(&mut self, min: [f32; 4], max: [f32; 4]) {
        // Compiles to one instruction each, which `f32::min` does not, because of numbers that are none.
        for lane in 0..4 {
            self.min[lane] = if min[lane] < self.min[lane] { min[lane] } else { self.min[lane] };
            self.max[lane] = if max[lane] > self.max[lane] { max[lane] } else { self.max[lane] };
        }
    }

    #[inline(always)]
    fn bounds(&self) -> Bounds {
        let [a, b, c, _] = self.min;
        let [d, e, f, _] = self.max;
        Bounds { min: [a, b, c], max: [d, e, f] }
    }
}

/// The box of things, or that of their middles.
fn over<const MIDDLES: bool>(primitives: &[Primitive]) -> Wide {
    if primitives.len() <= CHUNK {
        return dispatch!(Level::baseline(), simd => over_in::<MIDDLES, _>(simd, primitives));
    }
    let join = |mut a: Wide, b: Wide| {
        a.add(b.min, b.max);
        a
    };
    primitives.par_chunks(CHUNK).map(over::<MIDDLES>).reduce(|| Wide::EMPTY, join)
}

#[inline(always)]
fn over_in<const MIDDLES: bool, S: Simd>(simd: S, primitives: &[Primitive]) -> Wide {
    let mut least = f32x4::splat(simd, f32::INFINITY);
    let mut greatest = f32x4::splat(simd, f32::NEG_INFINITY);
    for primitive in primitives {
        let min: f32x4<S> = primitive.min.simd_into(simd);
        let max: f32x4<S> = primitive.max.simd_into(simd);
        let middle = min * 0.5 + max * 0.5;
        least = least.min(if MIDDLES { middle } else { min });
        greatest = greatest.max(if MIDDLES { middle } else { max });
    }
    Wide { min: least.into(), max: greatest.into() }
}

fn extent(primitives: &[Primitive]) -> Wide {
    over::<false>(primitives)
}

fn middles(primitives: &[Primitive]) -> Wide {
    over::<true>(primitives)
}

/// A set that is to become a child.
#[derive(Clone, Copy)]
struct Set {
    start: usize,
    end: usize,
    extent: Wide,
    /// Not to be cut further.
    is_leaf: bool,
}

impl Set {
    fn len(&self) -> usize {
        self.end - self.start
    }
}

/// A part of the tree, before it is put together.
enum Part {
    /// Nodes that begin with the part's first, and how many things are in each leaf, in order.
    Whole { nodes: Vec<Node>, leaves: Vec<u32>, units: usize },
    /// A node whose children were built apart.
    Forked { sets: Vec<(Set, Branch)>, nodes: usize, units: usize },
}

enum Branch {
    Leaf,
    Part(Part),
}

impl Part {
    /// How many nodes and units it has.
    fn len(&self) -> (usize, usize) {
        match self {
            Self::Whole { nodes, units, .. } => (nodes.len(), *units),
            Self::Forked { nodes, units, .. } => (*nodes, *units),
        }
    }
}

/// Builds a tree, and the units in its leaves.
pub(crate) fn build<S: Store>(mut primitives: Array<Primitive>, store: &S) -> (Tree, Array<S::Unit>) {
    let extent = extent(&primitives);
    let bounds = extent.bounds();
    if primitives.is_empty() {
        let tree = Tree { nodes: Array::zeroed(0), root: None, bounds, reach: bounds.reach(), stack: 1 };
        return (tree, Array::zeroed(0));
    }
    let set = Set { start: 0, end: primitives.len(), extent, is_leaf: false };
    let (whole, depth) = part::<S>(&mut primitives, set, 0);
    let (nodes, units) = whole.len();
    let (mut nodes, mut units) = (Array::zeroed(nodes), Array::zeroed(units));
    Joiner { store }.join(whole, Places { node: 0, unit: 0 }, &primitives, &mut nodes, &mut units);
    let root = Some(Child::node(0));
    (Tree { nodes, root, bounds, reach: bounds.reach(), stack: (WIDTH - 1) * depth + 1 }, units)
}

/// Builds a set, with others if it is large. Returns how deep its nodes go.
fn part<S: Store>(primitives: &mut [Primitive], set: Set, depth: usize) -> (Part, usize) {
    if set.len() <= PARALLEL {
        return whole::<S>(primitives, set);
    }
    let sets = cut::<S>(primitives, set, depth);
    let mut rest = primitives;
    let mut jobs = Vec::new();
    for child in sets {
        let (before, after) = rest.split_at_mut(child.len());
        rest = after;
        jobs.push((child, before));
    }
    let make = |(set, primitives): (Set, &mut [Primitive])| {
        if set.is_leaf {
            return (set, Branch::Leaf, 0);
        }
        let here = Set { start: 0, end: primitives.len(), ..set };
        let (part, deep) = part::<S>(primitives, here, depth + 1);
        (set, Branch::Part(part), deep)
    };
    let made: Vec<(Set, Branch, usize)> = jobs.into_par_iter().with_max_len(1).map(make).collect();
    let (mut nodes, mut units, mut deepest) = (1, 0, 0);
    let mut sets = Vec::with_capacity(made.len());
    for (set, branch, deep) in made {
        let (more_nodes, more_units) = match &branch {
            Branch::Leaf => (0, set.len().div_ceil(S::UNIT)),
            Branch::Part(part) => part.len(),
        };
        (nodes, units, deepest) = (nodes + more_nodes, units + more_units, deepest.max(deep));
        sets.push((set, branch));
    }
    (Part::Forked { sets, nodes, units }, deepest + 1)
}

/// Builds a set's nodes, its own first. Returns how deep they go.
fn whole<S: Store>(primitives: &mut [Primitive], set: Set) -> (Part, usize) {
    let mut binary = Vec::with_capacity(set.len());
    halve::<S>(primitives, set, &mut binary, 0, &mut Box::new(NO_BINS));
    let leaf = |count: usize| {
        let units = count.div_ceil(S::UNIT);
        (units <= MOST_UNITS).then_some(units as f32)
    };
    let collapse = Collapse::new(&binary, S::NODE_COST, leaf);
    let mut emit = Emit {
        binary: &binary,
        collapse: &collapse,
        unit: S::UNIT,
        nodes: Vec::with_capacity(binary.len() / 4),
        leaves: Vec::with_capacity(binary.len() / 2 + 1),
        units: 0,
    };
    let depth = emit.node(0);
    let Emit { nodes, leaves, units, .. } = emit;
    (Part::Whole { nodes, leaves, units }, depth)
}

/// The first node and the first unit of a part.
#[derive(Clone, Copy)]
struct Places {
    node: usize,
    unit: usize,
}

/// Puts parts together, each where it belongs.
struct Joiner<'a, S> {
    store: &'a S,
}

impl<S: Store> Joiner<'_, S> {
    fn join(
        &self,
        part: Part,
        first: Places,
        primitives: &[Primitive],
        nodes: &mut [Node],
        units: &mut [S::Unit],
    ) {
        match part {
            Part::Whole { nodes: made, leaves, .. } => {
                for (place, node) in nodes.iter_mut().zip(&made) {
                    *place = node.moved(first.node, first.unit);
                }
                drop(made);
                let mut rest = primitives;
                let mut units = units.iter_mut();
                for count in leaves {
                    let (leaf, after) = rest.split_at(count as usize);
                    rest = after;
                    self.fill(leaf, &mut units);
                }
            }
            Part::Forked { sets, .. } => {
                let Some((node, nodes)) = nodes.split_first_mut() else { return };
                *node = Node::EMPTY;
                let mut next = Places { node: first.node + 1, unit: first.unit };
                let (mut nodes, mut units) = (nodes, units);
                let mut jobs = Vec::with_capacity(WIDTH);
                for (slot, (set, branch)) in sets.into_iter().enumerate() {
                    let bounds = set.extent.bounds();
                    let primitives = &primitives[set.start..set.end];
                    let (more_nodes, more_units) = match branch {
                        Branch::Leaf => {
                            let count = set.len().div_ceil(S::UNIT);
                            node.set(slot, &bounds, Child::leaf(next.unit, count));
                            self.fill(primitives, &mut units.iter_mut());
                            (0, count)
                        }
                        Branch::Part(_) => {
                            node.set(slot, &bounds, Child::node(next.node));
                            if let Branch::Part(part) = &branch { part.len() } else { (0, 0) }
                        }
                    };
                    let (here_nodes, after_nodes) = nodes.split_at_mut(more_nodes);
                    let (here_units, after_units) = units.split_at_mut(more_units);
                    (nodes, units) = (after_nodes, after_units);
                    if let Branch::Part(part) = branch {
                        jobs.push((part, next, primitives, here_nodes, here_units));
                    }
                    next = Places { node: next.node + more_nodes, unit: next.unit + more_units };
                }
                jobs.into_par_iter().with_max_len(1).for_each(|(part, first, primitives, nodes, units)| {
                    self.join(part, first, primitives, nodes, units);
                });
            }
        }
    }

    /// Makes the units of a leaf.
    fn fill<'a>(&self, leaf: &[Primitive], units: &mut impl Iterator<Item = &'a mut S::Unit>)
    where
        S::Unit: 'a,
    {
        for chunk in leaf.chunks(S::UNIT) {
            // There are as many places as units were counted.
            if let Some(unit) = units.next() {
                *unit = self.store.unit(chunk);
            }
        }
    }
}

/// Cuts a set into up to eight, in the order of their places.
fn cut<S: Store>(primitives: &mut [Primitive], set: Set, depth: usize) -> Vec<Set> {
    let mut bins = Box::new(NO_BINS);
    let mut sets = Vec::with_capacity(WIDTH);
    sets.push(set);
    while sets.len() < WIDTH {
        let area = |set: &Set| set.extent.bounds().half_area();
        let mut largest: Option<usize> = None;
        for (index, set) in sets.iter().enumerate() {
            if !set.is_leaf && largest.is_none_or(|other| area(set) > area(&sets[other])) {
                largest = Some(index);
            }
        }
        let Some(index) = largest else { break };
        match split::<S>(primitives, &sets[index], depth, &mut bins) {
            Some([left, right]) => {
                sets[index] = left;
                sets.insert(index + 1, right);
            }
            None => sets[index].is_leaf = true,
        }
    }
    sets
}

/// Cuts a set in two, and those again, as long as it can be done. Their nodes follow one upon the other.
fn halve<S: Store>(
    primitives: &mut [Primitive],
    set: Set,
    nodes: &mut Vec<Binary>,
    depth: usize,
    bins: &mut Bins,
) -> usize {
    let index = nodes.len();
    let places = set.start..set.end;
    nodes.push(Binary { bounds: set.extent.bounds(), places, children: None });
    if let Some([left, right]) = split::<S>(primitives, &set, depth, bins) {
        let left = halve::<S>(primitives, left, nodes, depth + 1, bins);
        let right = halve::<S>(primitives, right, nodes, depth + 1, bins);
        nodes[index].children = Some([left, right]);
    }
    index
}

/// Makes nodes of eight from nodes of two.
struct Emit<'a> {
    binary: &'a [Binary],
    collapse: &'a Collapse<'a>,
    /// How many things are in a unit.
    unit: usize,
    nodes: Vec<Node>,
    /// How many things are in each leaf.
    leaves: Vec<u32>,
    units: usize,
}

impl Emit<'_> {
    /// Makes one, and all below it. Returns how deep they go.
    fn node(&mut self, index: usize) -> usize {
        let place = self.nodes.len();
        self.nodes.push(Node::EMPTY);
        let mut deepest = 0;
        for (slot, child) in self.collapse.children(index).iter().enumerate() {
            let reference = if self.collapse.is_leaf(child) {
                let count = self.binary[child].places.len();
                let units = count.div_ceil(self.unit);
                self.leaves.push(count as u32);
                self.units += units;
                Child::leaf(self.units - units, units)
            } else {
                let reference = Child::node(self.nodes.len());
                deepest = deepest.max(self.node(child));
                reference
            };
            self.nodes[place].set(slot, &self.binary[child].bounds, reference);
        }
        deepest + 1
    }
}

#[derive(Clone, Copy)]
struct Bin {
    extent: Wide,
    count: u32,
}

/// For each axis; as many as a set needs are in use.
type Bins = [[Bin; MOST_BINS]; 3];

const NO_BINS: Bins = [[Bin { extent: Wide::EMPTY, count: 0 }; MOST_BINS]; 3];

/// From here on, floats are whole numbers, whose lowest bits are those of the float.
const WHOLE: f32 = (1 << 23) as f32;

/// From a middle to a bin.
struct Ruler {
    bins: usize,
    least: [f32; 3],
    scale: [f32; 3],
}

impl Ruler {
    fn new(count: usize, middles: &Wide) -> Self {
        let bins = (4 + count / 20).min(MOST_BINS);
        let middles = middles.bounds();
        // Not along axes in which all middles are the same, or too far apart to be told.
        let scale = middles.extent().map(|x| {
            let scale = bins as f32 * 0.999_99 / x;
            if x > 0.0 && scale.is_finite() { scale } else { 0.0 }
        });
        Self { bins, least: middles.min, scale }
    }

    /// Adding 2^23 leaves the whole part in the lowest bits: quicker than a conversion, which has to mind numbers that do
    /// not fit.
    #[inline(always)]
    fn bin(&self, primitive: &Primitive, axis: usize) -> usize {
        let place = (primitive.middle(axis) - self.least[axis]) * self.scale[axis];
        let place = place + (WHOLE - 0.5);
        (if place > WHOLE { place } else { WHOLE }).to_bits() as usize & (MOST_BINS - 1)
    }

    /// By the vectors that every machine of the kind has: the compiler finds worse ones, and each call is too short to look
    /// for better.
    fn count(&self, primitives: &[Primitive], bins: &mut Bins) {
        dispatch!(Level::baseline(), simd => self.count_in(simd, primitives, bins));
    }

    /// The same arithmetic as in `bin`, for all axes at once.
    #[inline(always)]
    fn count_in<S: Simd>(&self, simd: S, primitives: &[Primitive], bins: &mut Bins) {
        let [bins_x, bins_y, bins_z] = bins;
        for bins in [&mut *bins_x, &mut *bins_y, &mut *bins_z] {
            bins[..self.bins].fill(Bin { extent: Wide::EMPTY, count: 0 });
        }
        let four = |[x, y, z]: [f32; 3]| -> f32x4<S> { [x, y, z, 0.0].simd_into(simd) };
        let (least, scale) = (four(self.least), four(self.scale));
        let whole = f32x4::splat(simd, WHOLE);
        for primitive in primitives {
            let min: f32x4<S> = primitive.min.simd_into(simd);
            let max: f32x4<S> = primitive.max.simd_into(simd);
            let place = (min * 0.5 + max * 0.5 - least) * scale + (WHOLE - 0.5);
            let [x, y, z, _]: [f32; 4] = place.max(whole).into();
            let add = |bin: &mut Bin| {
                let here: f32x4<S> = bin.extent.min.simd_into(simd);
                bin.extent.min = here.min(min).into();
                let here: f32x4<S> = bin.extent.max.simd_into(simd);
                bin.extent.max = here.max(max).into();
                bin.count += 1;
            };
            add(&mut bins_x[x.to_bits() as usize & (MOST_BINS - 1)]);
            add(&mut bins_y[y.to_bits() as usize & (MOST_BINS - 1)]);
            add(&mut bins_z[z.to_bits() as usize & (MOST_BINS - 1)]);
        }
    }

    fn count_all(&self, primitives: &[Primitive], bins: &mut Bins) {
        if primitives.len() <= CHUNK {
            return self.count(primitives, bins);
        }
        let count = |chunk: &[Primitive]| {
            let mut bins = NO_BINS;
            self.count(chunk, &mut bins);
            bins
        };
        *bins = primitives.par_chunks(CHUNK).map(count).reduce(
            || NO_BINS,
            |mut a, b| {
                for (a, b) in a.as_flattened_mut().iter_mut().zip(b.as_flattened()) {
                    a.extent.add(b.extent.min, b.extent.max);
                    a.count += b.count;
                }
                a
            },
        );
    }

    /// The cheapest cut in areas times units, if there is any.
    fn best<S: Store>(&self, bins: &Bins) -> Option<Cut> {
        let (mut best, mut least) = (None, f32::INFINITY);
        for (axis, bins) in bins.iter().enumerate() {
            if self.scale[axis] == 0.0 {
                continue;
            }
            let bins = &bins[..self.bins];
            let mut right = [(0.0, Wide::EMPTY); MOST_BINS];
            let (mut extent, mut count) = (Wide::EMPTY, 0);
            for (cut, bin) in bins.iter().enumerate().skip(1).rev() {
                extent.add(bin.extent.min, bin.extent.max);
                count += bin.count;
                right[cut] = (cost::<S>(&extent, count), extent);
            }
            let total = count + bins[0].count;
            (extent, count) = (Wide::EMPTY, 0);
            for (cut, bin) in (1..self.bins).zip(bins) {
                extent.add(bin.extent.min, bin.extent.max);
                count += bin.count;
                let cost = cost::<S>(&extent, count) + right[cut].0;
                if cost < least && count > 0 && count < total {
                    least = cost;
                    best = Some(Cut { axis, bin: cut, extents: [extent, right[cut].1] });
                }
            }
        }
        best
    }
}

/// Where to cut a set, and what its parts extend over.
struct Cut {
    axis: usize,
    /// The first on the right.
    bin: usize,
    extents: [Wide; 2],
}

fn cost<S: Store>(extent: &Wide, count: u32) -> f32 {
    if count == 0 { 0.0 } else { extent.bounds().half_area() * count.div_ceil(S::UNIT as u32) as f32 }
}

/// Cuts a set in two, unless it had better be a leaf.
fn split<S: Store>(
    primitives: &mut [Primitive],
    set: &Set,
    depth: usize,
    bins: &mut Bins,
) -> Option<[Set; 2]> {
    let count = set.len();
    if count <= S::UNIT {
        return None;
    }
    let here = &mut primitives[set.start..set.end];
    let ruler = Ruler::new(count, &middles(here));
    let best = if depth < DEEPEST {
        ruler.count_all(here, bins);
        ruler.best::<S>(bins)
    } else {
        None
    };
    let Some(cut) = best else {
        let fits = count <= MOST_UNITS * S::UNIT;
        return (!fits).then(|| halves(here, set));
    };
    let left = partition(here, &|primitive| ruler.bin(primitive, cut.axis) < cut.bin);
    let middle = set.start + left;
    let [low, high] = cut.extents;
    Some([Set { end: middle, extent: low, ..*set }, Set { start: middle, extent: high, ..*set }])
}

/// Cuts a set in the middle, as its things lie.
fn halves(here: &[Primitive], set: &Set) -> [Set; 2] {
    let (left, right) = here.split_at(here.len() / 2);
    let middle = set.start + left.len();
    [Set { end: middle, extent: extent(left), ..*set }, Set { start: middle, extent: extent(right), ..*set }]
}

/// Brings things that belong to the left before all others. Returns how many there are.
fn partition(here: &mut [Primitive], is_left: &(impl Fn(&Primitive) -> bool + Sync)) -> usize {
    if here.len() <= CHUNK {
        // What has been seen of the right side lies from `left` on, in any order. Each thing is exchanged with the first of
        // these, and belongs to the left side if that grows: there is no branch, which would be wrong half of the time.
        let mut left = 0;
        for place in 0..here.len() {
            let is_left = is_left(&here[place]);
            here.swap(left, place);
            left += usize::from(is_left);
        }
        return left;
    }
    // Each chunk by itself; then what is right in the left part is exchanged with what is left in the right part.
    let lefts: Vec<usize> = here.par_chunks_mut(CHUNK).map(|chunk| partition(chunk, is_left)).collect();
    let middle = lefts.iter().sum();
    let (low, high) = here.split_at_mut(middle);
    let (mut of_low, mut of_high) = (Vec::new(), Vec::new());
    let low_chunks = low.chunks_mut(CHUNK).zip(&lefts);
    of_low.extend(low_chunks.map(|(chunk, &left)| chunk.split_at_mut(left.min(chunk.len())).1));
    // The chunk that the middle lies in is cut by it.
    let first = middle / CHUNK;
    let mut rest = high;
    for (chunk, &left) in lefts.iter().enumerate().skip(first) {
        let start = (chunk * CHUNK).max(middle);
        let (here, after) = rest.split_at_mut(((chunk + 1) * CHUNK - start).min(rest.len()));
        rest = after;
        of_high.push(here.split_at_mut((chunk * CHUNK + left).saturating_sub(start)).0);
    }
    let mut pairs = Vec::new();
    let (mut of_low, mut of_high) = (of_low.into_iter(), of_high.into_iter());
    let (mut a, mut b): (&mut [Primitive], &mut [Primitive]) = (&mut [], &mut []);
    loop {
        if a.is_empty() {
            let Some(next) = of_low.next() else { break };
            a = next;
        } else if b.is_empty() {
            let Some(next) = of_high.next() else { break };
            b = next;
        } else {
            let len = a.len().min(b.len());
            let ((here_a, after_a), (here_b, after_b)) = (a.split_at_mut(len), b.split_at_mut(len));
            pairs.push((here_a, here_b));
            (a, b) = (after_a, after_b);
        }
    }
    pairs.into_par_iter().for_each(|(a, b)| a.swap_with_slice(b));
    middle
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chunks_are_partitioned_like_one() {
        let mut state = 1u32;
        for (len, share) in [(0, 3), (5, 1), (CHUNK, 2), (CHUNK + 1, 7), (5 * CHUNK + 77, 2), (4 * CHUNK, 9)]
        {
            let mut next = || {
                state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
                state >> 16
            };
            let box_of = |x: u32| Bounds { min: [x as f32; 3], max: [x as f32; 3] };
            for sides in [0, 1, share, u32::MAX] {
                let mut here: Vec<Primitive> =
                    (0..len as u32).map(|number| Primitive::new(&box_of(next() % share), number)).collect();
                // On the left: those of place 0, none, all.
                let is_left = |primitive: &Primitive| match sides {
                    0 => false,
                    u32::MAX => true,
                    sides => primitive.number() % sides == 0 || primitive.min[0] == 0.0,
                };
                let expected = here.iter().filter(|primitive| is_left(primitive)).count();
                assert_eq!(partition(&mut here, &is_left), expected);
                assert!(here[..expected].iter().all(is_left));
                assert!(!here[expected..].iter().any(is_left));
                let mut numbers: Vec<u32> = here.iter().map(Primitive::number).collect();
                numbers.sort_unstable();
                assert!(numbers.into_iter().eq(0..len as u32));
            }
        }
    }
}
