//! One level of the recursion: a batch of rays, what they hit, and what is still owed to them.

use super::material::FIELDS;
use hray_expr::kernels::lanes::MAX_LANES;

/// Columns of doubles that grow together.
pub(super) struct Columns<const N: usize> {
    columns: [Vec<f64>; N],
}

impl<const N: usize> Columns<N> {
    pub(super) fn new() -> Self {
        Self { columns: std::array::from_fn(|_| Vec::new()) }
    }

    /// Makes room for `len` entries and a vector's width beyond.
    pub(super) fn reserve(&mut self, len: usize) {
        if self.columns[0].len() < len + MAX_LANES {
            for column in &mut self.columns {
                column.resize(len + MAX_LANES, 0.0);
            }
        }
    }

    pub(super) fn get(&self) -> [&[f64]; N] {
        self.columns.each_ref().map(Vec::as_slice)
    }

    pub(super) fn get_mut(&mut self) -> [&mut [f64]; N] {
        self.columns.each_mut().map(Vec::as_mut_slice)
    }

    /// Repeats the last of `len` entries to the end of its vector, so that unused lanes hold a harmless ray.
    pub(super) fn pad(&mut self, len: usize) {
        if len > 0 {
            for column in &mut self.columns {
                let last = column[len - 1];
                column[len..len.next_multiple_of(MAX_LANES)].fill(last);
            }
        }
    }
}

/// What the rays of a frame see where they hit nothing.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Background {
    /// The scene's own.
    Scene,
    /// Black, for the thesis' mirrored rays.
    Black,
    /// One colour per ray, for the thesis' refracted rays.
    PerRay,
}

/// Where a frame's work stands.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Phase {
    Trace,
    AfterReflection,
    AfterRefraction,
}

/// Hits of one leaf, consecutive in the hit columns from a multiple of the vector width.
#[derive(Clone, Copy)]
pub(super) struct Group {
    pub(super) leaf: usize,
    pub(super) start: usize,
    pub(super) len: usize,
}

/// A batch of rays at one depth of the recursion.
pub(super) struct Frame {
    pub(super) phase: Phase,
    pub(super) background: Background,
    /// Number of rays.
    pub(super) len: usize,
    pub(super) origin: Columns<3>,
    pub(super) direction: Columns<3>,
    pub(super) behind: Columns<3>,
    /// Where the colour of each ray goes in the hits of the frame above.
    pub(super) parent: Vec<u32>,
    /// Distance to the nearest hit, its leaf, counted from [`NOTHING`],
    /// and, where that is a mesh, the triangle.
    pub(super) nearest: Columns<3>,
    pub(super) color: Columns<3>,

    pub(super) groups: Vec<Group>,
    /// The ray of each hit.
    pub(super) slot: Vec<u32>,
    pub(super) hit_point: Columns<3>,
    pub(super) hit_normal: Columns<3>,
    pub(super) hit_direction: Columns<3>,
    pub(super) hit_color: Columns<3>,
    /// By the exact rules: the unit geometric normal that faces the viewer, how far along it a ray has to start,
    /// and 1 where the viewer is on the outside, else -1.
    pub(super) hit_side: Columns<5>,
    /// Where functions or placed noise ask for it: the point in object space.
    pub(super) hit_object: Columns<3>,
    /// Where functions ask for them: the surface parameters.
    pub(super) hit_uv: Columns<2>,
    /// Where there are meshes: the outward unit normal to shade with, and how shadow rays are lifted off the triangles.
    pub(super) hit_smooth: Columns<6>,
    /// Where functions are evaluated: what they give.
    pub(super) fields: Columns<FIELDS>,
}

/// Which columns of a frame a scene has a use for.
#[derive(Clone, Copy)]
pub(super) struct Uses {
    pub(super) sides: bool,
    pub(super) object: bool,
    pub(super) uv: bool,
    pub(super) fields: bool,
    pub(super) smooth: bool,
}

impl Frame {
    pub(super) fn new() -> Self {
        Self {
            phase: Phase::Trace,
            background: Background::Scene,
            len: 0,
            origin: Columns::new(),
            direction: Columns::new(),
            behind: Columns::new(),
            parent: Vec::new(),
            nearest: Columns::new(),
            color: Columns::new(),
            groups: Vec::new(),
            slot: Vec::new(),
            hit_point: Columns::new(),
            hit_normal: Columns::new(),
            hit_direction: Columns::new(),
            hit_color: Columns::new(),
            hit_side: Columns::new(),
            hit_object: Columns::new(),
            hit_uv: Columns::new(),
            hit_smooth: Columns::new(),
            fields: Columns::new(),
        }
    }

    /// Empties the frame for at most `capacity` rays.
    pub(super) fn begin(&mut self, background: Background, capacity: usize) {
        self.phase = Phase::Trace;
        self.background = background;
        self.len = 0;
        self.parent.clear();
        self.origin.reserve(capacity);
        self.direction.reserve(capacity);
        if background == Background::PerRay {
            self.behind.reserve(capacity);
        }
    }

    /// Sorts the rays that hit something by what they hit: fills `groups` and `slot`, and makes room in the columns
    /// of hits.
    ///
    /// Every group starts at a multiple of the vector width; the lanes up to there repeat the last ray of the
    /// group before. Within a group the rays keep their order.
    pub(super) fn group_hits(&mut self, leaves: usize, uses: Uses, keys: &mut Vec<u64>) {
        self.groups.clear();
        self.slot.clear();
        let hit = &self.nearest.get()[1][..self.len];
        if leaves <= COUNTED {
            // Neighbours mostly hit the same, so both passes go run by run.
            let mut places = [0usize; COUNTED + 1];
            for run in hit.chunk_by(|a, b| a.to_bits() == b.to_bits()) {
                places[place(run[0])] += run.len();
            }
            let mut start = 0;
            for (leaf, place) in places[1..=leaves].iter_mut().enumerate() {
                let len = std::mem::replace(place, start);
                if len > 0 {
                    self.groups.push(Group { leaf, start, len });
                    start = (start + len).next_multiple_of(MAX_LANES);
                }
            }
            self.slot.resize(start, u32::MAX);
            let mut ray = 0;
            for run in hit.chunk_by(|a, b| a.to_bits() == b.to_bits()) {
                let which = place(run[0]);
                if which > 0 {
                    let start = places[which];
                    for (slot, ray) in self.slot[start..start + run.len()].iter_mut().zip(ray..) {
                        *slot = ray;
                    }
                    places[which] = start + run.len();
                }
                ray += run.len() as u32;
            }
        } else {
            keys.clear();
            let hits = hit.iter().zip(0u64..).filter(|(which, _)| place(**which) > 0);
            keys.extend(hits.map(|(&which, ray)| (place(which) as u64 - 1) << 32 | ray));
            keys.sort_unstable();
            for run in keys.chunk_by(|a, b| a >> 32 == b >> 32) {
                let start = self.slot.len();
                self.slot.extend(run.iter().map(|&key| key as u32));
                self.slot.resize(self.slot.len().next_multiple_of(MAX_LANES), u32::MAX);
                self.groups.push(Group { leaf: (run[0] >> 32) as usize, start, len: run.len() });
            }
        }
        for group in &self.groups {
            let end = group.start + group.len;
            let last = self.slot[end - 1];
            self.slot[end..end.next_multiple_of(MAX_LANES)].fill(last);
        }
        let len = self.slot.len();
        self.hit_point.reserve(len);
        self.hit_normal.reserve(len);
        self.hit_direction.reserve(len);
        self.hit_color.reserve(len);
        if uses.sides {
            self.hit_side.reserve(len);
        }
        if uses.object {
            self.hit_object.reserve(len);
        }
        if uses.uv {
            self.hit_uv.reserve(len);
        }
        if uses.smooth {
            self.hit_smooth.reserve(len);
        }
        if uses.fields {
            self.fields.reserve(len);
        }
    }
}

/// What [`Frame::nearest`] holds for a ray that hits nothing. The first leaf is one more, and so on: the
/// low bits of the number count.
pub(super) const NOTHING: f64 = (1u64 << 52) as f64;

/// 0 for nothing, 1 for the first leaf, and so on.
fn place(which: f64) -> usize {
    which.to_bits() as u32 as usize
}

/// Up to this many leaves hits are grouped by counting, beyond by sorting.
const COUNTED: usize = 256;
