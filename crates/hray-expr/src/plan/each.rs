//! Functions of one, two or three numbers over whole registers: loops that the compiler makes vectors of.

use super::run::Line;
use crate::kernels::lanes::{Lanes, MAX_LANES, Mask};
use crate::kernels::power::power;
use crate::kernels::sine::{cosine, sine};
use fearless_simd::prelude::*;

/// A function of one number, in lanes.
pub(super) trait One: Copy {
    fn at<S: Simd>(self, simd: S, a: Lanes<S>) -> Lanes<S>;
}

/// A function of two numbers, in lanes.
pub(super) trait Two: Copy {
    fn at<S: Simd>(self, simd: S, a: Lanes<S>, b: Lanes<S>) -> Lanes<S>;
}

/// A function of three numbers, in lanes.
pub(super) trait Three: Copy {
    fn at<S: Simd>(self, simd: S, a: Lanes<S>, b: Lanes<S>, c: Lanes<S>) -> Lanes<S>;
}

#[inline(always)]
pub(super) fn each1<S: Simd, F: One>(simd: S, f: F, a: &[Line], out: &mut [Line]) {
    for (a, out) in a.iter().zip(out) {
        let mut k = 0;
        while k < MAX_LANES {
            f.at(simd, a.load(simd, k)).store_slice(out.part::<S>(k));
            k += Lanes::<S>::LEN;
        }
    }
}

#[inline(always)]
pub(super) fn each2<S: Simd, F: Two>(simd: S, f: F, a: &[Line], b: &[Line], out: &mut [Line]) {
    for ((a, b), out) in a.iter().zip(b).zip(out) {
        let mut k = 0;
        while k < MAX_LANES {
            f.at(simd, a.load(simd, k), b.load(simd, k)).store_slice(out.part::<S>(k));
            k += Lanes::<S>::LEN;
        }
    }
}

#[inline(always)]
pub(super) fn each3<S: Simd, F: Three>(simd: S, f: F, a: &[Line], b: &[Line], c: &[Line], out: &mut [Line]) {
    for (((a, b), c), out) in a.iter().zip(b).zip(c).zip(out) {
        let mut k = 0;
        while k < MAX_LANES {
            f.at(simd, a.load(simd, k), b.load(simd, k), c.load(simd, k)).store_slice(out.part::<S>(k));
            k += Lanes::<S>::LEN;
        }
    }
}

/// A function of two numbers with the second fixed.
#[derive(Clone, Copy)]
pub(super) struct Right<F>(pub(super) F, pub(super) f64);

impl<F: Two> One for Right<F> {
    #[inline(always)]
    fn at<S: Simd>(self, simd: S, a: Lanes<S>) -> Lanes<S> {
        self.0.at(simd, a, Lanes::<S>::splat(simd, self.1))
    }
}

/// A function of two numbers with the first fixed.
#[derive(Clone, Copy)]
pub(super) struct Left<F>(pub(super) F, pub(super) f64);

impl<F: Two> One for Left<F> {
    #[inline(always)]
    fn at<S: Simd>(self, simd: S, b: Lanes<S>) -> Lanes<S> {
        self.0.at(simd, Lanes::<S>::splat(simd, self.1), b)
    }
}

/// A function of three numbers with the second fixed.
#[derive(Clone, Copy)]
pub(super) struct Second<F>(pub(super) F, pub(super) f64);

impl<F: Three> Two for Second<F> {
    #[inline(always)]
    fn at<S: Simd>(self, simd: S, a: Lanes<S>, c: Lanes<S>) -> Lanes<S> {
        self.0.at(simd, a, Lanes::<S>::splat(simd, self.1), c)
    }
}

/// A function of three numbers with the third fixed.
#[derive(Clone, Copy)]
pub(super) struct Third<F>(pub(super) F, pub(super) f64);

impl<F: Three> Two for Third<F> {
    #[inline(always)]
    fn at<S: Simd>(self, simd: S, a: Lanes<S>, b: Lanes<S>) -> Lanes<S> {
        self.0.at(simd, a, b, Lanes::<S>::splat(simd, self.1))
    }
}

/// Names a function of lanes.
macro_rules! function {
    ($kind:ident $name:ident($simd:ident, $($a:ident),+) = $value:expr) => {
        #[derive(Clone, Copy)]
        pub(super) struct $name;

        impl $kind for $name {
            #[inline(always)]
            fn at<S: Simd>(self, $simd: S, $($a: Lanes<S>),+) -> Lanes<S> {
                $value
            }
        }
    };
}

function!(One Neg(_simd, a) = -a);
function!(One Abs(_simd, a) = a.abs());
function!(One Floor(_simd, a) = a.floor());
function!(One Ceil(_simd, a) = a.ceil());
function!(One Round(simd, a) = round(simd, a));
function!(One Sqrt(_simd, a) = a.sqrt());
function!(One Sin(simd, a) = sine(simd, a));
function!(One Cos(simd, a) = cosine(simd, a));
function!(One Not(simd, a) = truth(simd, a.simd_eq(0.0)));

function!(Two Add(_simd, a, b) = a + b);
function!(Two Sub(_simd, a, b) = a - b);
function!(Two Mul(_simd, a, b) = a * b);
function!(Two Div(_simd, a, b) = a / b);
function!(Two Modulo(_simd, a, b) = a - b * (a / b).floor());
function!(Two Min(_simd, a, b) = a.simd_lt(b).select(a, b));
function!(Two Max(_simd, a, b) = a.simd_gt(b).select(a, b));
function!(Two Less(simd, a, b) = truth(simd, a.simd_lt(b)));
function!(Two LessEqual(simd, a, b) = truth(simd, a.simd_le(b)));
function!(Two Equal(simd, a, b) = truth(simd, a.simd_eq(b)));
function!(Two And(simd, a, b) = truth(simd, !(a.simd_eq(0.0) | b.simd_eq(0.0))));
function!(Two Or(simd, a, b) = truth(simd, !(a.simd_eq(0.0) & b.simd_eq(0.0))));

function!(Three MulAdd(_simd, a, b, c) = a * b + c);
function!(Three Choose(_simd, condition, a, b) = condition.simd_eq(0.0).select(b, a));

/// The power of a fixed exponent.
#[derive(Clone, Copy)]
pub(super) struct Power(pub(super) f64);

impl One for Power {
    #[inline(always)]
    fn at<S: Simd>(self, simd: S, a: Lanes<S>) -> Lanes<S> {
        power(simd, a, self.0)
    }
}

/// 1 where the mask is set, else 0.
#[inline(always)]
fn truth<S: Simd>(simd: S, mask: Mask<S>) -> Lanes<S> {
    mask.select(Lanes::<S>::splat(simd, 1.0), Lanes::<S>::splat(simd, 0.0))
}

/// Halves away from zero: the fraction is exact, and so is the step from the truncated number.
#[inline(always)]
fn round<S: Simd>(simd: S, a: Lanes<S>) -> Lanes<S> {
    let whole = a.trunc();
    let up = (a - whole).abs().simd_ge(0.5);
    up.select(whole + Lanes::<S>::splat(simd, 1.0).copysign(a), whole)
}
