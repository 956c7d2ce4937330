//! Bringing memory nearer before it is needed.

#![allow(unsafe_code, reason = "the machine's instruction takes a pointer; it reads nothing and cannot fail")]

/// Asks for all cache lines of a value. Where the machine is not known to have such an instruction, nothing happens.
#[inline(always)]
pub(crate) fn prefetch<T>(value: &T) {
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        let start: *const i8 = std::ptr::from_ref(value).cast();
        for line in 0..size_of::<T>().div_ceil(64) {
            // SAFETY: prefetching is a hint, for any address, and every x86-64 has it.
            unsafe { _mm_prefetch::<_MM_HINT_T0>(start.wrapping_add(64 * line)) };
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = value;
}
