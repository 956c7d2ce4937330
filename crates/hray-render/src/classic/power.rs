//! The power of the specular highlight.

use super::lanes::Lanes;
use fearless_simd::prelude::*;

/// Each lane to the power `exponent`, in the bits of [`libm::pow`].
#[inline(always)]
pub(super) fn power<S: Simd>(simd: S, base: Lanes<S>, exponent: f64) -> Lanes<S> {
    Lanes::<S>::from_fn(simd, |i| libm::pow(base[i], exponent))
}
