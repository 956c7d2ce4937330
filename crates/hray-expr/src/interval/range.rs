//! Ranges of numbers, eight at a time, and their arithmetic.
//!
//! Sums, products, quotients and square roots are rounded to the nearest, here as in the function itself. Such rounding is
//! monotonic: what is computed from any numbers of two ranges lies between what is computed from their ends. So ranges need
//! no rounding outward to hold every value that the *computed* function takes. What `libm` computes is not known to be
//! monotonic, and is widened by more than its error.
//!
//! A range whose ends are not numbers is empty: the function has no value there.

#![allow(clippy::needless_range_loop, reason = "a lane is the same place in several arrays")]

use crate::{Binary, Unary};

/// How many ranges are worked out together.
pub const LANES: usize = 8;

pub(super) type Eight = [f64; LANES];

/// A range of numbers in each lane, both ends included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// The lower ends.
    pub low: Eight,
    /// The upper ends.
    pub high: Eight,
}

/// What `libm` may be off by, relative to the value: more than the ulp that its documentation promises.
const LIBM: f64 = 4.0 * f64::EPSILON;

impl Range {
    /// Everything.
    pub const ENTIRE: Self = Self::from_ends(f64::NEG_INFINITY, f64::INFINITY);
    /// Nothing but 0.
    pub const ZERO: Self = Self::from_ends(0.0, 0.0);

    /// The same in every lane.
    #[must_use]
    pub const fn from_ends(low: f64, high: f64) -> Self {
        Self { low: [low; LANES], high: [high; LANES] }
    }

    /// Single numbers.
    #[must_use]
    pub const fn points(at: Eight) -> Self {
        Self { low: at, high: at }
    }

    /// The range in one lane.
    #[must_use]
    pub const fn lane(&self, lane: usize) -> [f64; 2] {
        [self.low[lane], self.high[lane]]
    }

    #[inline(always)]
    pub(super) fn set(&mut self, lane: usize, [low, high]: [f64; 2]) {
        (self.low[lane], self.high[lane]) = (low, high);
    }

    #[inline(always)]
    fn map(self, f: impl Fn(f64, f64) -> [f64; 2]) -> Self {
        let mut out = Self::ZERO;
        for lane in 0..LANES {
            let [low, high] = f(self.low[lane], self.high[lane]);
            (out.low[lane], out.high[lane]) = (low, high);
        }
        out
    }

    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f64, f64, f64, f64) -> [f64; 2]) -> Self {
        let mut out = Self::ZERO;
        for lane in 0..LANES {
            let [low, high] = f(self.low[lane], self.high[lane], other.low[lane], other.high[lane]);
            (out.low[lane], out.high[lane]) = (low, high);
        }
        out
    }

    /// The other where `lanes` says so.
    #[inline(always)]
    pub(super) fn replaced(self, lanes: [bool; LANES], other: Self) -> Self {
        let mut out = self;
        for lane in 0..LANES {
            out.low[lane] = if lanes[lane] { other.low[lane] } else { out.low[lane] };
            out.high[lane] = if lanes[lane] { other.high[lane] } else { out.high[lane] };
        }
        out
    }

    /// The least range that holds both; an empty one adds nothing.
    #[inline(always)]
    pub(super) fn hull(self, other: Self) -> Self {
        self.zip(
            other,
            #[inline(always)]
            |a, b, c, d| [if a <= c || c.is_nan() { a } else { c }, if b >= d || d.is_nan() { b } else { d }],
        )
    }

    #[inline(always)]
    pub(super) fn neg(self) -> Self {
        self.map(
            #[inline(always)]
            |a, b| [-b, -a],
        )
    }

    #[inline(always)]
    pub(super) fn add(self, other: Self) -> Self {
        self.zip(
            other,
            #[inline(always)]
            |a, b, c, d| whole(a + c, b + d, a, c),
        )
    }

    #[inline(always)]
    pub(super) fn sub(self, other: Self) -> Self {
        self.zip(
            other,
            #[inline(always)]
            |a, b, c, d| whole(a - d, b - c, a, c),
        )
    }

    #[inline(always)]
    pub(super) fn mul(self, other: Self) -> Self {
        self.zip(
            other,
            #[inline(always)]
            |a, b, c, d| {
                let (p, q, r, s) = (product(a, c), product(a, d), product(b, c), product(b, d));
                let low = least(least(p, q), least(r, s));
                let high = most(most(p, q), most(r, s));
                if a.is_nan() || c.is_nan() { [f64::NAN; 2] } else { [low, high] }
            },
        )
    }

    /// Of the same number with itself.
    #[inline(always)]
    pub(super) fn square(self) -> Self {
        self.map(
            #[inline(always)]
            |a, b| {
                let (p, q) = (a * a, b * b);
                let low = if a <= 0.0 && b >= 0.0 { 0.0 } else { least(p, q) };
                [low, most(p, q)]
            },
        )
    }

    #[inline(always)]
    pub(super) fn div(self, other: Self) -> Self {
        self.zip(
            other,
            #[inline(always)]
            |a, b, c, d| {
                if a.is_nan() || c.is_nan() {
                    return [f64::NAN; 2];
                }
                if c > 0.0 || d < 0.0 {
                    let (p, q, r, s) = (quotient(a, c), quotient(a, d), quotient(b, c), quotient(b, d));
                    // Infinity by infinity may be anything in between.
                    let endless =
                        (a.is_infinite() || b.is_infinite()) && (c.is_infinite() || d.is_infinite());
                    let low = least(least(p, q), least(r, s));
                    let high = most(most(p, q), most(r, s));
                    return if endless {
                        [least(low, if a < 0.0 || b < 0.0 { low } else { 0.0 }), most(high, 0.0)]
                    } else {
                        [low, high]
                    };
                }
                if a == 0.0 && b == 0.0 {
                    return [0.0; 2];
                }
                // 0 is the least or the greatest of what is divided by, or within.
                match (c == 0.0, d == 0.0) {
                    (true, false) if a >= 0.0 => [a / d, f64::INFINITY],
                    (true, false) if b <= 0.0 => [f64::NEG_INFINITY, b / d],
                    (false, true) if a >= 0.0 => [f64::NEG_INFINITY, a / c],
                    (false, true) if b <= 0.0 => [b / c, f64::INFINITY],
                    _ => [f64::NEG_INFINITY, f64::INFINITY],
                }
            },
        )
    }

    #[inline(always)]
    pub(super) fn min(self, other: Self) -> Self {
        self.zip(
            other,
            #[inline(always)]
            |a, b, c, d| [least(a, c), least(b, d)],
        )
    }

    #[inline(always)]
    pub(super) fn max(self, other: Self) -> Self {
        self.zip(
            other,
            #[inline(always)]
            |a, b, c, d| [most(a, c), most(b, d)],
        )
    }

    #[inline(always)]
    pub(super) fn abs(self) -> Self {
        self.map(
            #[inline(always)]
            |a, b| {
                let low = if a <= 0.0 && b >= 0.0 { 0.0 } else { least(a.abs(), b.abs()) };
                [low, most(a.abs(), b.abs())]
            },
        )
    }

    #[inline(always)]
    pub(super) fn sqrt(self) -> Self {
        // Where there is no root there is no value.
        self.map(
            #[inline(always)]
            |a, b| [if b >= 0.0 { most(a, 0.0).sqrt() } else { f64::NAN }, b.sqrt()],
        )
    }

    /// A function of one number that rises, from [`Unary`]; one of `libm` is widened.
    pub(super) fn rising(self, f: Unary, exact: bool) -> Self {
        self.map(|a, b| {
            let (low, high) = (f.apply(a), f.apply(b));
            if exact { [low, high] } else { wider(low, high) }
        })
    }

    /// The same, falling.
    pub(super) fn falling(self, f: Unary) -> Self {
        self.map(|a, b| wider(f.apply(b), f.apply(a)))
    }

    /// Only what lies between two numbers.
    pub(super) fn within(self, least: f64, most: f64) -> Self {
        self.map(|a, b| {
            if b < least || a > most {
                [f64::NAN; 2]
            } else {
                [if a < least { least } else { a }, if b > most { most } else { b }]
            }
        })
    }

    /// sin (x + quarters π/2).
    pub(super) fn sine(self, quarters: f64) -> Self {
        use std::f64::consts::FRAC_PI_2;
        self.map(|a, b| {
            if !(b - a < 4.0 * FRAC_PI_2 && a.abs() < 1e9 && b.abs() < 1e9) {
                return if a.is_nan() { [f64::NAN; 2] } else { [-1.0, 1.0] };
            }
            let f = if quarters == 0.0 { Unary::Sin } else { Unary::Cos };
            let (p, q) = (f.apply(a), f.apply(b));
            // In quarters of a turn, widened: whether a crest (1 modulo 4) or a trough (3) lies between.
            let (from, to) = (a / FRAC_PI_2 + quarters - 1e-6, b / FRAC_PI_2 + quarters + 1e-6);
            let holds = |top: f64| ((to - top) / 4.0).floor() > ((from - top) / 4.0).floor();
            let [low, high] = wider(least(p, q), most(p, q));
            [if holds(3.0) { -1.0 } else { most(low, -1.0) }, if holds(1.0) { 1.0 } else { least(high, 1.0) }]
        })
    }

    pub(super) fn tan(self) -> Self {
        use std::f64::consts::{FRAC_PI_2, PI};
        self.map(|a, b| {
            let (from, to) = (((a + FRAC_PI_2) / PI - 1e-9).floor(), ((b + FRAC_PI_2) / PI + 1e-9).floor());
            if from == to && a.abs() < 1e6 && b.abs() < 1e6 {
                wider(libm::tan(a), libm::tan(b))
            } else if a.is_nan() {
                [f64::NAN; 2]
            } else {
                [f64::NEG_INFINITY, f64::INFINITY]
            }
        })
    }

    /// The power of a whole number from 1 on.
    #[inline(always)]
    pub(super) fn whole_power(self, exponent: u32) -> Self {
        let off = f64::EPSILON * f64::from(exponent) + LIBM;
        let mut powers = Self::from_ends(1.0, 1.0);
        for _ in 0..exponent {
            for lane in 0..LANES {
                powers.low[lane] *= self.low[lane];
                powers.high[lane] *= self.high[lane];
            }
        }
        self.zip(
            powers,
            #[inline(always)]
            |a, b, p, q| {
                let [low, high] = if exponent % 2 == 1 {
                    [p, q]
                } else if a <= 0.0 && b >= 0.0 {
                    [0.0, most(p, q)]
                } else {
                    [least(p, q), most(p, q)]
                };
                wider_by(off, low, high)
            },
        )
    }

    /// Any power. Of a number below 0 only whole powers have a value.
    pub(super) fn power(self, exponent: Self) -> Self {
        self.zip(exponent, |a, b, c, d| {
            if a.is_nan() || c.is_nan() {
                return [f64::NAN; 2];
            }
            if !c.is_finite() || !d.is_finite() {
                return [if a < 0.0 { f64::NEG_INFINITY } else { 0.0 }, f64::INFINITY];
            }
            if b < 0.0 && c == d && c.fract() != 0.0 {
                return [f64::NAN; 2];
            }
            if a < 0.0 && (c != d || c.fract() == 0.0) {
                // A whole power of negative numbers, or one that varies: from what bounds the magnitude.
                let largest = most(a.abs(), b.abs());
                let smallest = if b < 0.0 { b.abs() } else { 0.0 };
                let ends = [
                    libm::pow(largest, c),
                    libm::pow(largest, d),
                    libm::pow(smallest, c),
                    libm::pow(smallest, d),
                ];
                let most_of = ends.into_iter().fold(0.0, most);
                return wider(-most_of, most_of);
            }
            let a = most(a, 0.0);
            let ends = [libm::pow(a, c), libm::pow(a, d), libm::pow(b, c), libm::pow(b, d)];
            let low = ends.into_iter().fold(f64::INFINITY, least);
            let high = ends.into_iter().fold(f64::NEG_INFINITY, most);
            wider(low, high)
        })
    }

    /// a - b floor(a / b), and in which lanes it does not jump.
    pub(super) fn modulo(self, other: Self) -> (Self, [bool; LANES]) {
        let mut smooth = [false; LANES];
        let mut out = Self::ENTIRE;
        for lane in 0..LANES {
            let ([a, b], [c, d]) = (self.lane(lane), other.lane(lane));
            let (from, to) = ((a / c).floor(), (b / c).floor());
            if a.is_nan() || c.is_nan() {
                out.set(lane, [f64::NAN; 2]);
            } else if c == d && from == to {
                smooth[lane] = true;
                out.set(lane, [a - c * from, b - c * from]);
            } else if c > 0.0 {
                // Rounding may give the divisor itself, or a little less than 0.
                out.set(
                    lane,
                    [
                        -d * f64::EPSILON - a.abs().max(b.abs()) * f64::EPSILON,
                        d + a.abs().max(b.abs()) * f64::EPSILON,
                    ],
                );
            } else if d < 0.0 {
                out.set(
                    lane,
                    [
                        c - a.abs().max(b.abs()) * f64::EPSILON,
                        -c * f64::EPSILON + a.abs().max(b.abs()) * f64::EPSILON,
                    ],
                );
            }
        }
        (out, smooth)
    }

    /// The angle of the point (x = other, y = self), and in which lanes it does not jump.
    pub(super) fn atan2(self, other: Self) -> (Self, [bool; LANES]) {
        use std::f64::consts::PI;
        let mut smooth = [false; LANES];
        let mut out = Self::from_ends(-PI, PI);
        for lane in 0..LANES {
            let ([y0, y1], [x0, x1]) = (self.lane(lane), other.lane(lane));
            if y0.is_nan() || x0.is_nan() {
                out.set(lane, [f64::NAN; 2]);
            } else if x0 > 0.0 || y0 > 0.0 || y1 < 0.0 {
                let corners =
                    [libm::atan2(y0, x0), libm::atan2(y0, x1), libm::atan2(y1, x0), libm::atan2(y1, x1)];
                let low = corners.into_iter().fold(f64::INFINITY, least);
                let high = corners.into_iter().fold(f64::NEG_INFINITY, most);
                smooth[lane] = true;
                out.set(lane, wider(low, high));
            }
        }
        (out, smooth)
    }

    /// What a comparison or connective may be.
    pub(super) fn truth(self, f: Binary, other: Self) -> Self {
        self.zip(other, |a, b, c, d| {
            let (surely, surely_not) = match f {
                Binary::Less => (b < c, a >= d),
                Binary::LessEqual => (b <= c, a > d),
                Binary::Equal => (a == b && c == d && a == c, b < c || a > d),
                Binary::And => (!holds_zero(a, b) && !holds_zero(c, d), is_zero(a, b) || is_zero(c, d)),
                _ => (!holds_zero(a, b) || !holds_zero(c, d), is_zero(a, b) && is_zero(c, d)),
            };
            // What is not a number compares to nothing.
            let surely_not = surely_not || (!surely && (a.is_nan() || c.is_nan()));
            [if surely { 1.0 } else { 0.0 }, if surely_not { 0.0 } else { 1.0 }]
        })
    }

    /// Where it is certain that this is not 0, and where it is certain that it is.
    #[inline(always)]
    pub(super) fn certain(&self) -> [[bool; LANES]; 2] {
        let mut out = [[false; LANES]; 2];
        for lane in 0..LANES {
            let [a, b] = self.lane(lane);
            out[0][lane] = !holds_zero(a, b);
            out[1][lane] = is_zero(a, b);
        }
        out
    }
}

#[inline(always)]
fn holds_zero(a: f64, b: f64) -> bool {
    a <= 0.0 && b >= 0.0
}

#[inline(always)]
fn is_zero(a: f64, b: f64) -> bool {
    a == 0.0 && b == 0.0
}

/// Infinity less infinity may be anything.
#[inline(always)]
fn whole(low: f64, high: f64, a: f64, c: f64) -> [f64; 2] {
    if a.is_nan() || c.is_nan() {
        return [f64::NAN; 2];
    }
    [if low.is_nan() { f64::NEG_INFINITY } else { low }, if high.is_nan() { f64::INFINITY } else { high }]
}

/// 0 times infinity is 0: an end that is infinite is one that no number reaches.
#[inline(always)]
fn product(x: f64, y: f64) -> f64 {
    let p = x * y;
    if p.is_nan() { 0.0 } else { p }
}

/// The same.
#[inline(always)]
fn quotient(x: f64, y: f64) -> f64 {
    let q = x / y;
    if q.is_nan() { 0.0 } else { q }
}

#[inline(always)]
fn least(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

#[inline(always)]
fn most(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// By what `libm` may be off.
#[inline(always)]
fn wider(low: f64, high: f64) -> [f64; 2] {
    wider_by(LIBM, low, high)
}

#[inline(always)]
fn wider_by(share: f64, low: f64, high: f64) -> [f64; 2] {
    // Infinity stays as it is.
    let off_low = if low.is_finite() { low.abs() * share } else { 0.0 };
    let off_high = if high.is_finite() { high.abs() * share } else { 0.0 };
    [low - off_low, high + off_high]
}
