//! Building a tree from the top down by the surface area heuristic over bins (Wald, *On Fast Construction of SAH-based Bounding
//! Volume Hierarchies*, 2007): a large set is cut in two until there are eight, each time the one with the greatest surface; a
//! small one is cut down to its leaves, and what comes of that is made a tree of eight ([`Collapse`]).
//!
//! What is cut where depends on the boxes alone; threads build disjoint parts, which are put together in order.

use crate::Bounds;
use crate::collapse::{Binary, Collapse};
use crate::memory::{Array, Plain};
use crate::tree::{Child, MOST_UNITS, Node, Tree, WIDTH};
use fearless_simd::{Level, dispatch, f32x4, f32x8, prelude::*};
use rayon::prelude::*;
use zerocopy::{FromBytes, Immutable, IntoBytes, KnownLayout};

/// A thing to be sorted into the tree: half a cache line, read as one vector.
#[repr(C, align(32))]
#[derive(Clone, Copy, Debug, FromBytes, IntoBytes, Immutable, KnownLayout)]
pub(crate) struct Primitive {
    /// Least x, y, z, and nothing; greatest x, y, z, all with their signs changed, and, in the bits below `MARK`, what the
    /// caller calls the thing. So that a box is widened by one minimum.
    sides: [f32; 8],
}

/// Makes a number the bits of a float between 2 and 2^17: arithmetic in all lanes never meets a subnormal number, which
/// is slow.
const MARK: u32 = 1 << 30;

impl Primitive {
    pub(crate) fn new(bounds: &Bounds, number: u32) -> Self {
        let ([a, b, c], [d, e, f]) = (bounds.min, bounds.max);
        Self { sides: [a, b, c, 0.0, -d, -e, -f, f32::from_bits(number | MARK)] }
    }

    /// What the caller calls it.
    pub(crate) fn number(&self) -> u32 {
        self.sides[7].to_bits() & !MARK
    }

    #[inline(always)]
    fn middle(&self, axis: usize) -> f32 {
        0.5 * self.sides[axis] - 0.5 * self.sides[4 + axis]
    }

    #[inline(always)]
    fn middles<S: Simd>(&self, simd: S) -> f32x4<S> {
        let sides: f32x8<S> = self.sides.simd_into(simd);
        let (min, max) = sides.split();
        min * 0.5 - max * 0.5
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
/// Smaller sets are not worth a call.
const FEW: usize = 64;
/// Deeper down, sets are halved.
const DEEPEST: usize = 40;

/// A box to be widened quickly, in the form of [`Primitive::sides`].
#[derive(Clone, Copy)]
#[repr(C, align(32))]
struct Wide {
    sides: [f32; 8],
}

impl Wide {
    const EMPTY: Self = Self { sides: [f32::INFINITY; 8] };

    #[inline(always)]
    fn add(&mut self, other: &Self) {
        // Compiles to one instruction, which `f32::min` does not, because of numbers that are none.
        for (side, other) in self.sides.iter_mut().zip(&other.sides) {
            *side = if *other < *side { *other } else { *side };
        }
    }

    #[inline(always)]
    fn bounds(&self) -> Bounds {
        let [a, b, c, _, d, e, f, _] = self.sides;
        Bounds { min: [a, b, c], max: [-d, -e, -f] }
    }

    /// Half its surface, unless it is empty.
    #[inline(always)]
    fn half_area(&self) -> f32 {
        let [x, y, z] = [0, 1, 2].map(|axis| -self.sides[axis] - self.sides[4 + axis]);
        x * (y + z) + y * z
    }
}

/// The vectors for a set: of a small one those that every machine of the kind has, because a call to code for others takes
/// longer than they save.
fn of_few(level: Level, primitives: &[Primitive]) -> Level {
    if primitives.len() < FEW { Level::baseline() } else { level }
}

/// The box of things, and that of their middles.
fn extents(level: Level, primitives: &[Primitive]) -> [Wide; 2] {
    if primitives.len() <= CHUNK {
        return dispatch!(of_few(level, primitives), simd => extents_in(simd, primitives));
    }
    let join = |[mut a, mut b]: [Wide; 2], [other_a, other_b]: [Wide; 2]| {
        a.add(&other_a);
        b.add(&other_b);
        [a, b]
    };
    let chunks = primitives.par_chunks(CHUNK);
    chunks.map(|chunk| extents(level, chunk)).reduce(|| [Wide::EMPTY; 2], join)
}

#[inline(always)]
fn extents_in<S: Simd>(simd: S, primitives: &[Primitive]) -> [Wide; 2] {
    let mut extent = f32x8::splat(simd, f32::INFINITY);
    let mut middles = extent;
    for primitive in primitives {
        let sides: f32x8<S> = primitive.sides.simd_into(simd);
        extent = extent.min(sides);
        let middle = primitive.middles(simd);
        middles = middles.min(middle.combine(-middle));
    }
    [Wide { sides: extent.into() }, Wide { sides: middles.into() }]
}

/// A set that is to become a child.
#[derive(Clone, Copy)]
struct Set {
    start: usize,
    end: usize,
    extent: Wide,
    /// What the middles of its things extend over.
    middles: Wide,
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
    let level = Level::new();
    let [extent, middles] = extents(level, &primitives);
    let bounds = extent.bounds();
    if primitives.is_empty() {
        let tree = Tree { nodes: Array::zeroed(0), root: None, bounds, reach: bounds.reach(), stack: 1 };
        return (tree, Array::zeroed(0));
    }
    let set = Set { start: 0, end: primitives.len(), extent, middles, is_leaf: false };
    let (whole, depth) = part::<S>(level, &mut primitives, set, 0);
    let (nodes, units) = whole.len();
    let (mut nodes, mut units) = (Array::zeroed(nodes), Array::zeroed(units));
    Joiner { store }.join(whole, Places { node: 0, unit: 0 }, &primitives, &mut nodes, &mut units);
    let root = Some(Child::node(0));
    (Tree { nodes, root, bounds, reach: bounds.reach(), stack: (WIDTH - 1) * depth + 1 }, units)
}

/// Builds a set, with others if it is large. Returns how deep its nodes go.
fn part<S: Store>(level: Level, primitives: &mut [Primitive], set: Set, depth: usize) -> (Part, usize) {
    if set.len() <= PARALLEL {
        return whole::<S>(level, primitives, set);
    }
    let sets = cut::<S>(level, primitives, set, depth);
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
        let (part, deep) = part::<S>(level, primitives, here, depth + 1);
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
fn whole<S: Store>(level: Level, primitives: &mut [Primitive], set: Set) -> (Part, usize) {
    let mut binary = Vec::with_capacity(set.len());
    halve::<S>(level, primitives, set, &mut binary, 0, &mut Box::new(NO_BINS));
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
fn cut<S: Store>(level: Level, primitives: &mut [Primitive], set: Set, depth: usize) -> Vec<Set> {
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
        match split::<S>(level, primitives, &sets[index], depth, &mut bins) {
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
    level: Level,
    primitives: &mut [Primitive],
    set: Set,
    nodes: &mut Vec<Binary>,
    depth: usize,
    bins: &mut Bins,
) -> usize {
    let index = nodes.len();
    let places = set.start..set.end;
    nodes.push(Binary { bounds: set.extent.bounds(), places, children: None });
    if let Some([left, right]) = split::<S>(level, primitives, &set, depth, bins) {
        let left = halve::<S>(level, primitives, left, nodes, depth + 1, bins);
        let right = halve::<S>(level, primitives, right, nodes, depth + 1, bins);
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

impl Bin {
    #[inline(always)]
    fn add<S: Simd>(&mut self, simd: S, sides: f32x8<S>) {
        let here: f32x8<S> = self.extent.sides.simd_into(simd);
        self.extent.sides = here.min(sides).into();
        self.count += 1;
    }
}

/// For each axis; as many as a set needs are in use.
type Bins = [[Bin; MOST_BINS]; 3];

const NO_BINS: Bins = [[Bin { extent: Wide::EMPTY, count: 0 }; MOST_BINS]; 3];

/// From here on, floats are whole numbers, whose lowest bits are those of the float.
const WHOLE: f32 = (1 << 23) as f32;

/// From a middle to a bin.
struct Ruler {
    bins: usize,
    /// In all axes, and one that is not used.
    least: [f32; 4],
    scale: [f32; 4],
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
        let four = |[x, y, z]: [f32; 3]| [x, y, z, 0.0];
        Self { bins, least: four(middles.min), scale: four(scale) }
    }

    /// A bin, as that many more than 2^23. Adding this number leaves the whole part in the lowest bits: quicker than a
    /// conversion, which has to mind numbers that do not fit.
    #[inline(always)]
    fn place(&self, primitive: &Primitive, axis: usize) -> f32 {
        (primitive.middle(axis) - self.least[axis]) * self.scale[axis] + (WHOLE - 0.5)
    }

    fn count(&self, level: Level, primitives: &[Primitive], bins: &mut Bins) {
        dispatch!(of_few(level, primitives), simd => self.count_in(simd, primitives, bins));
    }

    /// The same arithmetic as in `place`, for all axes at once.
    #[inline(always)]
    fn count_in<S: Simd>(&self, simd: S, primitives: &[Primitive], bins: &mut Bins) {
        for bins in bins.iter_mut() {
            bins[..self.bins].fill(Bin { extent: Wide::EMPTY, count: 0 });
        }
        // Neighbours fall into the same bin, and each has to wait for the one before. So two are taken that lie far apart.
        let (near, far) = primitives.split_at(primitives.len() / 2);
        for (a, b) in near.iter().zip(far) {
            self.add(simd, a, bins);
            self.add(simd, b, bins);
        }
        for primitive in &far[near.len()..] {
            self.add(simd, primitive, bins);
        }
    }

    #[inline(always)]
    fn add<S: Simd>(&self, simd: S, primitive: &Primitive, [bins_x, bins_y, bins_z]: &mut Bins) {
        let sides: f32x8<S> = primitive.sides.simd_into(simd);
        let least: f32x4<S> = self.least.simd_into(simd);
        let scale: f32x4<S> = self.scale.simd_into(simd);
        let place = (primitive.middles(simd) - least) * scale + (WHOLE - 0.5);
        let [x, y, z, _]: [f32; 4] = place.max(f32x4::splat(simd, WHOLE)).into();
        bins_x[x.to_bits() as usize & (MOST_BINS - 1)].add(simd, sides);
        bins_y[y.to_bits() as usize & (MOST_BINS - 1)].add(simd, sides);
        bins_z[z.to_bits() as usize & (MOST_BINS - 1)].add(simd, sides);
    }

    fn count_all(&self, level: Level, primitives: &[Primitive], bins: &mut Bins) {
        if primitives.len() <= CHUNK {
            return self.count(level, primitives, bins);
        }
        let count = |chunk: &[Primitive]| {
            let mut bins = NO_BINS;
            self.count(level, chunk, &mut bins);
            bins
        };
        *bins = primitives.par_chunks(CHUNK).map(count).reduce(
            || NO_BINS,
            |mut a, b| {
                for (a, b) in a.as_flattened_mut().iter_mut().zip(b.as_flattened()) {
                    a.extent.add(&b.extent);
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
                extent.add(&bin.extent);
                count += bin.count;
                right[cut] = (cost::<S>(&extent, count), extent);
            }
            let total = count + bins[0].count;
            (extent, count) = (Wide::EMPTY, 0);
            for (cut, bin) in (1..self.bins).zip(bins) {
                extent.add(&bin.extent);
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
    if count == 0 { 0.0 } else { extent.half_area() * count.div_ceil(S::UNIT as u32) as f32 }
}

/// Cuts a set in two, unless it had better be a leaf.
fn split<S: Store>(
    level: Level,
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
    let ruler = Ruler::new(count, &set.middles);
    let best = if depth < DEEPEST {
        ruler.count_all(level, here, bins);
        ruler.best::<S>(bins)
    } else {
        None
    };
    let Some(cut) = best else {
        let fits = count <= MOST_UNITS * S::UNIT;
        return (!fits).then(|| halves(level, here, set));
    };
    let Sides { left, middles: [of_low, of_high] } = partition(level, here, &ruler, &cut);
    let middle = set.start + left;
    let [low, high] = cut.extents;
    Some([
        Set { end: middle, extent: low, middles: of_low, ..*set },
        Set { start: middle, extent: high, middles: of_high, ..*set },
    ])
}

/// Cuts a set in the middle, as its things lie.
fn halves(level: Level, here: &[Primitive], set: &Set) -> [Set; 2] {
    let (left, right) = here.split_at(here.len() / 2);
    let middle = set.start + left.len();
    let [[low, of_low], [high, of_high]] = [left, right].map(|half| extents(level, half));
    [
        Set { end: middle, extent: low, middles: of_low, ..*set },
        Set { start: middle, extent: high, middles: of_high, ..*set },
    ]
}

/// What is on the two sides of a cut.
struct Sides {
    /// How many things are on the left.
    left: usize,
    /// What the middles of each side extend over.
    middles: [Wide; 2],
}

/// Brings things that belong to the left before all others.
fn partition(level: Level, here: &mut [Primitive], ruler: &Ruler, cut: &Cut) -> Sides {
    if here.len() <= CHUNK {
        return dispatch!(of_few(level, here), simd => partition_in(simd, here, ruler, cut));
    }
    // Each chunk by itself; then what is right in the left part is exchanged with what is left in the right part.
    let chunks = here.par_chunks_mut(CHUNK);
    let sides: Vec<Sides> = chunks.map(|chunk| partition(level, chunk, ruler, cut)).collect();
    let lefts: Vec<usize> = sides.iter().map(|sides| sides.left).collect();
    let left = lefts.iter().sum();
    exchange(here, &lefts, left);
    let mut middles = [Wide::EMPTY; 2];
    for sides in &sides {
        for (all, side) in middles.iter_mut().zip(&sides.middles) {
            all.add(side);
        }
    }
    Sides { left, middles }
}

/// What has been seen of the right side lies from `left` on, in any order. Each thing is exchanged with the first of these,
/// and belongs to the left side if that grows: there is no branch, which would be wrong half of the time.
#[inline(always)]
fn partition_in<S: Simd>(simd: S, here: &mut [Primitive], ruler: &Ruler, cut: &Cut) -> Sides {
    let end = WHOLE + cut.bin as f32;
    let nothing = f32x8::splat(simd, f32::INFINITY);
    let (mut left, mut low, mut high) = (0, nothing, nothing);
    for place in 0..here.len() {
        let primitive = here[place];
        let is_left = ruler.place(&primitive, cut.axis) < end;
        let middle = primitive.middles(simd);
        let middle = middle.combine(-middle);
        let on_left = f32x8::splat(simd, ruler.place(&primitive, cut.axis)).simd_lt(end);
        low = on_left.select(low.min(middle), low);
        high = on_left.select(high, high.min(middle));
        here[place] = here[left];
        here[left] = primitive;
        left += usize::from(is_left);
    }
    Sides { left, middles: [low, high].map(|sides| Wide { sides: sides.into() }) }
}

/// Brings the left things of all chunks before all others, where each chunk has its own in front. Together they are `middle`.
fn exchange(here: &mut [Primitive], lefts: &[usize], middle: usize) {
    let (low, high) = here.split_at_mut(middle);
    let low_chunks = low.chunks_mut(CHUNK).zip(lefts);
    let mut of_low = low_chunks.map(|(chunk, &left)| chunk.split_at_mut(left.min(chunk.len())).1);
    // The chunk that the middle lies in is cut by it.
    let mut rest = high;
    let high_chunks = lefts.iter().enumerate().skip(middle / CHUNK);
    let mut of_high = high_chunks.map(|(chunk, &left)| {
        let start = (chunk * CHUNK).max(middle);
        let all = std::mem::take(&mut rest);
        let (here, after) = all.split_at_mut(((chunk + 1) * CHUNK - start).min(all.len()));
        rest = after;
        here.split_at_mut((chunk * CHUNK + left).saturating_sub(start)).0
    });
    let mut pairs = Vec::new();
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
            let box_of = |x: u32| Bounds { min: [x as f32, 1.0, 0.0], max: [x as f32, 2.0, 4.0] };
            // Of places 0 to 9, those below `share` are on the left; where they lie mixed, or sorted either way.
            for order in 0..3 {
                let mut places: Vec<u32> = (0..len).map(|_| next() % 10).collect();
                match order {
                    0 => places.sort_unstable(),
                    1 => places.sort_unstable_by(|a, b| b.cmp(a)),
                    _ => {}
                }
                let numbered = (0u32..).zip(&places);
                let mut here: Vec<Primitive> =
                    numbered.map(|(number, &place)| Primitive::new(&box_of(place), number)).collect();
                let ruler = Ruler { bins: 10, least: [-0.5; 4], scale: [1.0; 4] };
                let cut = Cut { axis: 0, bin: share, extents: [Wide::EMPTY; 2] };
                let sides = partition(Level::new(), &mut here, &ruler, &cut);
                let is_left = |primitive: &Primitive| primitive.sides[0] < share as f32;
                assert_eq!(sides.left, here.iter().filter(|primitive| is_left(primitive)).count());
                let (low, high) = here.split_at(sides.left);
                assert!(low.iter().all(is_left) && !high.iter().any(is_left));
                for (half, middles) in [low, high].into_iter().zip(&sides.middles) {
                    let [_, expected] = extents(Level::new(), half);
                    assert_eq!(middles.bounds(), expected.bounds());
                }
                let mut numbers: Vec<u32> = here.iter().map(Primitive::number).collect();
                numbers.sort_unstable();
                assert!(numbers.into_iter().eq(0..len as u32));
            }
        }
    }
}
