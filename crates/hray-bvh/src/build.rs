//! Building a tree from the top down by the surface area heuristic over bins (Wald, *On Fast Construction of SAH-based Bounding
//! Volume Hierarchies*, 2007): a large set is cut in two until there are eight, each time the one with the greatest surface; a
//! small one is cut down to its leaves, and what comes of that is made a tree of eight ([`Collapse`]).
//!
//! What is cut where depends on the boxes alone; threads build disjoint parts, which are put together in order.

use crate::Bounds;
use crate::collapse::{Binary, Collapse};
use crate::tree::{Child, MOST_UNITS, Node, Tree, WIDTH};
use fearless_simd::{Level, dispatch, f32x4, prelude::*};
use rayon::prelude::*;

/// A thing to be sorted into the tree: half a cache line, read as two vectors.
#[repr(C, align(32))]
#[derive(Clone, Copy, Debug)]
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

/// Where the things in leaves are kept, in units of up to `UNIT` things that are tested together.
pub(crate) trait Store: Send + Sync + Sized {
    const UNIT: usize;
    /// What a node costs, where a unit costs 1.
    const NODE_COST: f32;
    /// One for a part of the tree.
    fn empty(&self) -> Self;
    /// How many units it has.
    fn len(&self) -> usize;
    /// Adds a leaf.
    fn push(&mut self, primitives: &[Primitive]);
    /// Adds all of another, behind.
    fn append(&mut self, other: Self);
    /// Makes room for so many units.
    fn reserve(&mut self, units: usize);
}

const MOST_BINS: usize = 32;
/// Sets of more things are built by several threads.
const PARALLEL: usize = 1 << 13;
/// Things that a thread bins at a time.
const CHUNK: usize = 1 << 15;
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
enum Part<S> {
    /// Nodes that begin with the part's first, and what is in its leaves.
    Whole { nodes: Vec<Node>, store: S, depth: usize },
    /// A node whose children were built apart.
    Forked { node: Box<Node>, parts: Vec<(usize, Self)>, store: S },
}

impl<S: Store> Part<S> {
    /// How many nodes and units it has.
    fn len(&self) -> (usize, usize) {
        match self {
            Self::Whole { nodes, store, .. } => (nodes.len(), store.len()),
            Self::Forked { parts, store, .. } => {
                parts.iter().fold((1, store.len()), |(nodes, units), (_, part)| {
                    let (more_nodes, more_units) = part.len();
                    (nodes + more_nodes, units + more_units)
                })
            }
        }
    }
}

/// Builds a tree, and fills a store with what is in its leaves.
pub(crate) fn build<S: Store>(mut primitives: Vec<Primitive>, store: S) -> (Tree, S) {
    let extent = extent(&primitives);
    let bounds = extent.bounds();
    let mut tree = Tree { nodes: Vec::new(), root: None, bounds, reach: bounds.reach(), stack: 1 };
    let mut all = store.empty();
    if primitives.is_empty() {
        return (tree, all);
    }
    let set = Set { start: 0, end: primitives.len(), extent, is_leaf: false };
    let whole = part(&mut primitives, set, &store, 0);
    drop(primitives);
    let (nodes, units) = whole.len();
    tree.nodes.reserve_exact(nodes);
    all.reserve(units);
    let (root, depth) = flatten(whole, &mut tree.nodes, &mut all);
    tree.root = Some(root);
    tree.stack = (WIDTH - 1) * depth + 1;
    (tree, all)
}

/// Builds a set, with others if it is large.
fn part<S: Store>(primitives: &mut [Primitive], set: Set, store: &S, depth: usize) -> Part<S> {
    let mut own = store.empty();
    if set.len() <= PARALLEL {
        let (nodes, depth) = whole(primitives, set, &mut own);
        return Part::Whole { nodes, store: own, depth };
    }
    let sets = cut::<S>(primitives, set, depth);
    let mut node = Box::new(Node::EMPTY);
    let mut rest = &mut primitives[..];
    let mut taken = set.start;
    let mut jobs = Vec::new();
    for (slot, child) in sets.iter().enumerate() {
        let (before, after) = rest.split_at_mut(child.end - taken);
        (rest, taken) = (after, child.end);
        if child.is_leaf {
            node.set(slot, &child.extent.bounds(), push(before, &mut own));
        } else {
            node.set(slot, &child.extent.bounds(), Child::node(0));
            let here = Set { start: 0, end: before.len(), ..*child };
            jobs.push((slot, before, here));
        }
    }
    let parts = jobs
        .into_par_iter()
        .with_max_len(1)
        .map(|(slot, primitives, set)| (slot, part(primitives, set, store, depth + 1)))
        .collect();
    Part::Forked { node, parts, store: own }
}

/// Builds a set's nodes, its own first. Returns how deep they go.
fn whole<S: Store>(primitives: &mut [Primitive], set: Set, store: &mut S) -> (Vec<Node>, usize) {
    let mut binary = Vec::with_capacity(set.len());
    halve::<S>(primitives, set, &mut binary, 0, &mut Box::new(NO_BINS));
    let leaf = |count: usize| {
        let units = count.div_ceil(S::UNIT);
        (units <= MOST_UNITS).then_some(units as f32)
    };
    let collapse = Collapse::new(&binary, S::NODE_COST, leaf);
    let mut nodes = Vec::with_capacity(binary.len() / 4);
    let depth = emit(&binary, &collapse, 0, primitives, &mut nodes, store);
    (nodes, depth)
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

/// Makes a node of eight from one of two, and all below it. Returns how deep they go.
fn emit<S: Store>(
    binary: &[Binary],
    collapse: &Collapse<'_>,
    index: usize,
    primitives: &[Primitive],
    nodes: &mut Vec<Node>,
    store: &mut S,
) -> usize {
    let place = nodes.len();
    nodes.push(Node::EMPTY);
    let mut deepest = 0;
    for (slot, child) in collapse.children(index).iter().enumerate() {
        let reference = if collapse.is_leaf(child) {
            push(&primitives[binary[child].places.clone()], store)
        } else {
            let reference = Child::node(nodes.len());
            deepest = deepest.max(emit(binary, collapse, child, primitives, nodes, store));
            reference
        };
        nodes[place].set(slot, &binary[child].bounds, reference);
    }
    deepest + 1
}

fn push<S: Store>(primitives: &[Primitive], store: &mut S) -> Child {
    let first = store.len();
    store.push(primitives);
    Child::leaf(first, store.len() - first)
}

/// Puts parts together; the root and the depth.
fn flatten<S: Store>(part: Part<S>, nodes: &mut Vec<Node>, store: &mut S) -> (Child, usize) {
    let (first_node, first_unit) = (nodes.len(), store.len());
    match part {
        Part::Whole { nodes: mut new, store: units, depth } => {
            for node in &mut new {
                node.move_children(first_node, first_unit);
            }
            nodes.append(&mut new);
            store.append(units);
            (Child::node(first_node), depth)
        }
        Part::Forked { mut node, parts, store: units } => {
            node.move_children(0, first_unit);
            nodes.push(*node);
            store.append(units);
            let mut deepest = 0;
            for (slot, part) in parts {
                let (child, depth) = flatten(part, nodes, store);
                nodes[first_node].point(slot, child);
                deepest = deepest.max(depth);
            }
            (Child::node(first_node), deepest + 1)
        }
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
    // What has been seen of the right side lies from `left` on, in any order. Each thing is exchanged with the first of these,
    // and belongs to the left side if that grows: there is no branch, which would be wrong half of the time.
    let mut left = 0;
    for place in 0..here.len() {
        let is_left = ruler.bin(&here[place], cut.axis) < cut.bin;
        here.swap(left, place);
        left += usize::from(is_left);
    }
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
