//! Where the objects and lights of a scene were made: from a thing in the picture back to the text.
//!
//! A scene of a million objects has few places that make objects. Each object keeps the number of its place, and the
//! places stand in one table.

use crate::diagnostic::Span;
use crate::hry::sources::STANDARD_BASE;
use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

/// Calls that are kept of those that led to a place.
const MOST_CALLS: usize = 4;
/// Where the calls make more places than this, new ones are kept without their calls.
const MOST_PLACES: usize = 1 << 16;

/// A place that makes objects or lights.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Origin {
    /// The call of the constructor, or the operation that makes a solid.
    pub span: Span,
    /// The calls of functions that led there, the innermost first: at most four of them, and none that is in the standard
    /// library.
    pub calls: Vec<Span>,
}

/// The place of each object and each light of a scene. Cheap to clone.
#[derive(Clone, Debug, Default)]
pub struct Origins {
    inner: Arc<Inner>,
}

#[derive(Debug)]
enum Inner {
    /// Numbers of places.
    Numbered {
        places: Vec<Origin>,
        objects: Vec<u32>,
        /// By objects that are solids: the places of their parts, from the first operand to the last.
        parts: Parts,
        lights: Vec<u32>,
    },
    /// A place for each.
    Single { objects: Vec<Span>, lights: Vec<Span> },
}

impl Default for Inner {
    fn default() -> Self {
        Self::Single { objects: Vec::new(), lights: Vec::new() }
    }
}

impl Origins {
    pub(super) fn new(places: &Places, objects: Vec<u32>, parts: Parts, lights: Vec<u32>) -> Self {
        Self { inner: Arc::new(Inner::Numbered { places: places.list.clone(), objects, parts, lights }) }
    }

    /// The origins of a scene whose objects and lights have a place each, such as a classic one.
    #[must_use]
    pub fn single(objects: Vec<Span>, lights: Vec<Span>) -> Self {
        Self { inner: Arc::new(Inner::Single { objects, lights }) }
    }

    /// Where an object was made, by its place in [`hray_core::Scene::primitives`].
    #[must_use]
    pub fn object(&self, object: usize) -> Option<Origin> {
        match &*self.inner {
            Inner::Numbered { places, objects, .. } => numbered(places, objects.get(object)),
            Inner::Single { objects, .. } => single(objects.get(object)),
        }
    }

    /// Where a part of a solid was made: the solid's place in [`hray_core::Scene::primitives`], and the part's in its
    /// [`hray_core::Primitive::leaves`].
    #[must_use]
    pub fn part(&self, object: usize, part: usize) -> Option<Origin> {
        match &*self.inner {
            Inner::Numbered { places, parts, .. } => numbered(places, parts.get(&object)?.get(part)),
            Inner::Single { .. } => None,
        }
    }

    /// Where a light was made, by its place in [`hray_core::Scene::lights`].
    #[must_use]
    pub fn light(&self, light: usize) -> Option<Origin> {
        match &*self.inner {
            Inner::Numbered { places, lights, .. } => numbered(places, lights.get(light)),
            Inner::Single { lights, .. } => single(lights.get(light)),
        }
    }
}

fn numbered(places: &[Origin], number: Option<&u32>) -> Option<Origin> {
    places.get(*number? as usize).cloned()
}

fn single(span: Option<&Span>) -> Option<Origin> {
    span.map(|&span| Origin { span, calls: Vec::new() })
}

/// Parts of solids, by the solids.
pub(super) type Parts = BTreeMap<usize, Vec<u32>>;

/// The places that made something so far. Numbers are never taken back, because values that are kept from one moment to the
/// next hold them.
#[derive(Debug, Default)]
pub(super) struct Places {
    list: Vec<Origin>,
    /// Only looked up.
    known: HashMap<Origin, u32>,
    last: u32,
}

impl Places {
    /// The number of a place, of which `calls` are the running calls, the innermost last.
    pub(super) fn number(&mut self, span: Span, calls: &[Span]) -> u32 {
        // Neighbours are mostly made in one place.
        let told = || calls.iter().rev().filter(|call| call.start < STANDARD_BASE).take(MOST_CALLS);
        if self
            .list
            .get(self.last as usize)
            .is_some_and(|last| last.span == span && last.calls.iter().eq(told()))
        {
            return self.last;
        }
        let calls = told().copied().collect();
        let mut origin = Origin { span, calls };
        if self.list.len() >= MOST_PLACES && !self.known.contains_key(&origin) {
            origin.calls.clear();
        }
        let next = self.list.len() as u32;
        self.last = *self.known.entry(origin).or_insert_with_key(|origin| {
            self.list.push(origin.clone());
            next
        });
        self.last
    }
}

/// Primitives with the numbers of the places that made them.
#[derive(Default)]
pub(super) struct Flat {
    pub(super) primitives: Vec<hray_core::Primitive>,
    pub(super) origins: Vec<u32>,
    pub(super) parts: Parts,
}

impl Flat {
    /// Adds a primitive; `parts` are those of a solid.
    pub(super) fn push(&mut self, primitive: hray_core::Primitive, origin: u32, parts: Vec<u32>) {
        if !parts.is_empty() {
            self.parts.insert(self.primitives.len(), parts);
        }
        self.primitives.push(primitive);
        self.origins.push(origin);
    }

    /// The places of everything that the primitives are made of, in order.
    pub(super) fn leaves(&mut self) -> Vec<u32> {
        let origins = self.origins.iter().enumerate();
        origins.flat_map(|(i, origin)| self.parts.remove(&i).unwrap_or_else(|| vec![*origin])).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_has_one_number() {
        let mut places = Places::default();
        let (a, b) = (Span::new(3, 9), Span::new(10, 12));
        assert_eq!([places.number(a, &[]), places.number(b, &[]), places.number(a, &[])], [0, 1, 0]);
        assert_eq!([places.number(a, &[b]), places.number(a, &[b]), places.number(a, &[])], [2, 2, 0]);
        // Calls inside the library say nothing about the scene.
        let library = Span::new(STANDARD_BASE + 5, STANDARD_BASE + 7);
        assert_eq!(places.number(a, &[b, library]), 2);
    }

    #[test]
    fn only_the_innermost_calls_are_kept() {
        let mut places = Places::default();
        let calls: Vec<Span> = (0..9).map(|i| Span::new(i, i + 1)).collect();
        let number = places.number(Span::new(20, 30), &calls);
        let kept: Vec<usize> = places.list[number as usize].calls.iter().map(|call| call.start).collect();
        assert_eq!(kept, [8, 7, 6, 5]);
    }

    #[test]
    fn there_are_never_more_places_than_memory() {
        let mut places = Places::default();
        for i in 0..2 * MOST_PLACES {
            places.number(Span::new(1, 2), &[Span::new(i, i)]);
        }
        assert!(places.list.len() <= MOST_PLACES + 1, "{}", places.list.len());
    }
}
