//! Arrays that rays jump about in. Where pages have 4 KiB, a large mesh has far more of them than the processor keeps
//! addresses of, and every node costs a second wait; so they lie in huge pages where the system has these.

use zerocopy::{FromBytes, Immutable, IntoBytes, KnownLayout};

/// What is the same as its bytes.
pub(crate) trait Plain: FromBytes + IntoBytes + Immutable + KnownLayout + Clone + Send + Sync {}

impl<T> Plain for T where T: FromBytes + IntoBytes + Immutable + KnownLayout + Clone + Send + Sync {}

/// An array of fixed length, aligned as its type wants it.
pub(crate) struct Array<T> {
    memory: Memory<T>,
}

enum Memory<T> {
    Heap(Vec<T>),
    #[cfg(target_os = "linux")]
    Pages(pages::Pages),
}

impl<T: Plain> Array<T> {
    /// All bytes are 0. Memory is not touched, so that each page is made by the thread that writes it first.
    pub(crate) fn zeroed(len: usize) -> Self {
        #[cfg(target_os = "linux")]
        if let Some(pages) = pages::Pages::new::<T>(len) {
            return Self { memory: Memory::Pages(pages) };
        }
        Self { memory: Memory::Heap(vec![T::new_zeroed(); len]) }
    }

    /// Forgets what is behind the first `len`.
    pub(crate) fn truncate(&mut self, len: usize) {
        match &mut self.memory {
            Memory::Heap(heap) => heap.truncate(len),
            #[cfg(target_os = "linux")]
            Memory::Pages(pages) => pages.truncate::<T>(len),
        }
    }

    /// Its bytes.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val::<[T]>(self)
    }
}

impl<T: Plain> std::ops::Deref for Array<T> {
    type Target = [T];

    #[inline(always)]
    fn deref(&self) -> &[T] {
        match &self.memory {
            Memory::Heap(heap) => heap,
            #[cfg(target_os = "linux")]
            Memory::Pages(pages) => pages.get(),
        }
    }
}

impl<T: Plain> std::ops::DerefMut for Array<T> {
    fn deref_mut(&mut self) -> &mut [T] {
        match &mut self.memory {
            Memory::Heap(heap) => heap,
            #[cfg(target_os = "linux")]
            Memory::Pages(pages) => pages.get_mut(),
        }
    }
}

impl<T: Plain> Clone for Array<T> {
    fn clone(&self) -> Self {
        let mut clone = Self::zeroed(self.len());
        clone.clone_from_slice(self);
        clone
    }
}

impl<T: Plain + PartialEq> PartialEq for Array<T> {
    fn eq(&self, other: &Self) -> bool {
        **self == **other
    }
}

impl<T: Plain + std::fmt::Debug> std::fmt::Debug for Array<T> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        (**self).fmt(f)
    }
}

#[cfg(target_os = "linux")]
mod pages {
    use super::Plain;
    use memmap2::{Advice, MmapMut};
    use std::ops::Range;
    use zerocopy::FromBytes as _;

    /// A huge page of x86-64, and of ARM where ordinary ones have 4 KiB.
    const HUGE: usize = 1 << 21;

    /// Memory that begins where a huge page does.
    pub(super) struct Pages {
        map: MmapMut,
        used: Range<usize>,
    }

    impl Pages {
        /// Zeros; none where the array is smaller than a huge page, or where the system refuses.
        pub(super) fn new<T: Plain>(len: usize) -> Option<Self> {
            let bytes = len.checked_mul(size_of::<T>()).filter(|bytes| *bytes >= HUGE)?;
            let map = MmapMut::map_anon(bytes.checked_add(HUGE)?).ok()?;
            let start = map.as_ptr().align_offset(HUGE);
            // The last page stays an ordinary one where the array does not fill it: no memory is wasted. Where there are
            // no huge pages the advice fails, and the array is as good as any other.
            let _ = map.advise_range(Advice::HugePage, start, bytes / HUGE * HUGE);
            let pages = Self { map, used: start..start.checked_add(bytes)? };
            (pages.try_get::<T>()?.len() == len).then_some(pages)
        }

        pub(super) fn truncate<T>(&mut self, len: usize) {
            self.used.end = self.used.end.min(self.used.start + len * size_of::<T>());
        }

        #[inline(always)]
        fn try_get<T: Plain>(&self) -> Option<&[T]> {
            <[T]>::ref_from_bytes(self.map.get(self.used.clone())?).ok()
        }

        /// The array. That it can be had was seen when it was made.
        #[inline(always)]
        pub(super) fn get<T: Plain>(&self) -> &[T] {
            self.try_get().unwrap_or_default()
        }

        pub(super) fn get_mut<T: Plain>(&mut self) -> &mut [T] {
            let bytes = self.map.get_mut(self.used.clone()).unwrap_or_default();
            <[T]>::mut_from_bytes(bytes).unwrap_or_default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrays_of_all_sizes_are_zeros_and_keep_what_is_written() {
        for len in [0, 1, 1000, 1 << 18, (1 << 18) - 1, (1 << 19) + 12_345] {
            let mut array = Array::<[u32; 2]>::zeroed(len);
            assert_eq!(array.len(), len);
            assert_eq!(array.bytes(), 8 * len);
            assert!(array.iter().all(|pair| *pair == [0, 0]));
            for (number, pair) in (0u32..).zip(array.iter_mut()) {
                *pair = [number, !number];
            }
            let mut clone = array.clone();
            assert!(clone == array);
            for (number, pair) in (0u32..).zip(array.iter()) {
                assert_eq!(*pair, [number, !number]);
            }
            clone.truncate(len / 2);
            assert_eq!(clone[..], array[..len / 2]);
            assert_eq!(clone == array, len == 0);
        }
    }
}
