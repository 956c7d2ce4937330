//! Ranges of values together with ranges of slopes: automatic differentiation, forward, in intervals.

use super::range::{LANES, Range};
use crate::{Binary, Unary};

/// What a number may be, and how fast it may change along the given direction.
///
/// Where a function jumps or has a crease, its slope's range holds all that it is on both sides, or everything.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dual {
    pub(super) value: Range,
    pub(super) slope: Range,
}

impl Dual {
    pub(super) const ENTIRE: Self = Self { value: Range::ENTIRE, slope: Range::ENTIRE };

    /// No value at all.
    pub(super) const EMPTY: Self =
        Self { value: Range::from_ends(f64::NAN, f64::NAN), slope: Range::from_ends(f64::NAN, f64::NAN) };

    pub(super) const fn constant(v: f64) -> Self {
        Self { value: Range::from_ends(v, v), slope: Range::ZERO }
    }

    /// Where it is one number. (Where its slope is 0 rounding may still change it, and a jump makes much of that.)
    #[inline(always)]
    fn still(&self) -> [bool; LANES] {
        std::array::from_fn(|lane| self.value.low[lane] == self.value.high[lane])
    }

    /// A value that jumps, but where all that it is made of stands still.
    #[inline(always)]
    pub(super) fn jumping<const SLOPE: bool>(value: Range, of: &[&Self]) -> Self {
        if !SLOPE {
            return Self { value, slope: Range::ZERO };
        }
        let mut still = [true; LANES];
        for operand in of {
            for (all, one) in still.iter_mut().zip(operand.still()) {
                *all &= one;
            }
        }
        Self { value, slope: Range::ENTIRE.replaced(still, Range::ZERO) }
    }

    /// The same, but it has the given slope in some lanes.
    #[inline(always)]
    fn smooth_in<const SLOPE: bool>(self, lanes: [bool; LANES], slope: Range) -> Self {
        if SLOPE { Self { value: self.value, slope: self.slope.replaced(lanes, slope) } } else { self }
    }

    /// The other in some lanes.
    #[inline(always)]
    pub(super) fn replaced(&self, lanes: [bool; LANES], other: &Self) -> Self {
        let (value, slope) =
            (self.value.replaced(lanes, other.value), self.slope.replaced(lanes, other.slope));
        Self { value, slope }
    }

    #[inline(always)]
    pub(super) fn hull(&self, other: &Self) -> Self {
        Self { value: self.value.hull(other.value), slope: self.slope.hull(other.slope) }
    }

    #[inline(always)]
    pub(super) fn unary<const SLOPE: bool>(f: Unary, a: &Self) -> Self {
        let (value, slope) = (a.value, a.slope);
        match f {
            Unary::Neg => Self { value: value.neg(), slope: if SLOPE { slope.neg() } else { Range::ZERO } },
            Unary::Abs => {
                let result = value.abs();
                if !SLOPE {
                    return Self { value: result, slope };
                }
                let (mut above, mut below) = ([false; LANES], [false; LANES]);
                for lane in 0..LANES {
                    let [low, high] = value.lane(lane);
                    (above[lane], below[lane]) = (low > 0.0, high < 0.0);
                }
                let both = slope.hull(slope.neg());
                Self { value: result, slope: both.replaced(above, slope).replaced(below, slope.neg()) }
            }
            Unary::Floor | Unary::Ceil | Unary::Round => {
                let value = value.rising(f, true);
                let mut constant = [false; LANES];
                for (lane, constant) in constant.iter_mut().enumerate() {
                    let [low, high] = value.lane(lane);
                    *constant = low == high;
                }
                Self::jumping::<SLOPE>(value, &[a]).smooth_in::<SLOPE>(constant, Range::ZERO)
            }
            Unary::Not => {
                let [not_zero, zero] = value.certain();
                let out = Range::from_ends(0.0, 1.0)
                    .replaced(not_zero, Range::ZERO)
                    .replaced(zero, Range::from_ends(1.0, 1.0));
                let mut certain = not_zero;
                certain.iter_mut().zip(zero).for_each(|(a, b)| *a |= b);
                Self::jumping::<SLOPE>(out, &[a]).smooth_in::<SLOPE>(certain, Range::ZERO)
            }
            Unary::Sqrt => with::<SLOPE>(
                value.sqrt(),
                #[inline(always)]
                |root| slope.div(root.add(root)),
            ),
            Unary::Sin => with::<SLOPE>(
                value.sine(0.0),
                #[inline(always)]
                |_| slope.mul(value.sine(1.0)),
            ),
            Unary::Cos => with::<SLOPE>(
                value.sine(1.0),
                #[inline(always)]
                |_| slope.mul(value.sine(0.0).neg()),
            ),
            Unary::Tan => with::<SLOPE>(
                value.tan(),
                #[inline(always)]
                |tan| slope.mul(ONE.add(tan.square())),
            ),
            Unary::Asin | Unary::Acos => {
                let inside = value.within(-1.0, 1.0);
                let root = |_| ONE.sub(inside.square()).within(0.0, 1.0).sqrt();
                if f == Unary::Asin {
                    with::<SLOPE>(
                        inside.rising(f, false),
                        #[inline(always)]
                        |v| slope.div(root(v)),
                    )
                } else {
                    with::<SLOPE>(
                        inside.falling(f),
                        #[inline(always)]
                        |v| slope.div(root(v)).neg(),
                    )
                }
            }
            Unary::Atan => with::<SLOPE>(
                value.rising(f, false),
                #[inline(always)]
                |_| slope.div(ONE.add(value.square())),
            ),
            Unary::Exp => with::<SLOPE>(
                value.rising(f, false),
                #[inline(always)]
                |exp| slope.mul(exp),
            ),
            Unary::Ln => with::<SLOPE>(
                value.within(0.0, f64::INFINITY).rising(f, false),
                #[inline(always)]
                |_| slope.div(value.within(0.0, f64::INFINITY)),
            ),
        }
    }

    /// `same` says that both are one and the same number.
    #[inline(always)]
    pub(super) fn binary<const SLOPE: bool>(f: Binary, a: &Self, b: &Self, same: bool) -> Self {
        match f {
            Binary::Add => with::<SLOPE>(
                a.value.add(b.value),
                #[inline(always)]
                |_| a.slope.add(b.slope),
            ),
            Binary::Sub if same => Self::jumping::<SLOPE>(a.value.sub(b.value), &[]),
            Binary::Sub => with::<SLOPE>(
                a.value.sub(b.value),
                #[inline(always)]
                |_| a.slope.sub(b.slope),
            ),
            Binary::Mul if same => with::<SLOPE>(
                a.value.square(),
                #[inline(always)]
                |_| {
                    let product = a.value.mul(a.slope);
                    product.add(product)
                },
            ),
            Binary::Mul => with::<SLOPE>(
                a.value.mul(b.value),
                #[inline(always)]
                |_| a.slope.mul(b.value).add(b.slope.mul(a.value)),
            ),
            Binary::Div => {
                let value = a.value.div(b.value);
                with::<SLOPE>(
                    value,
                    #[inline(always)]
                    |_| a.slope.sub(value.mul(b.slope)).div(b.value),
                )
            }
            Binary::Modulo => {
                let (value, smooth) = a.value.modulo(b.value);
                // Where it is smooth the divisor is one number.
                Self::jumping::<SLOPE>(value, &[a, b]).smooth_in::<SLOPE>(smooth, a.slope)
            }
            Binary::Min | Binary::Max => {
                let value = if f == Binary::Min { a.value.min(b.value) } else { a.value.max(b.value) };
                with::<SLOPE>(
                    value,
                    #[inline(always)]
                    |_| {
                        let (mut only_a, mut only_b) = ([false; LANES], [false; LANES]);
                        for lane in 0..LANES {
                            let ([low, high], [from, to]) = (a.value.lane(lane), b.value.lane(lane));
                            let (below, above) = (high < from, to < low);
                            (only_a[lane], only_b[lane]) =
                                if f == Binary::Min { (below, above) } else { (above, below) };
                        }
                        a.slope.hull(b.slope).replaced(only_a, a.slope).replaced(only_b, b.slope)
                    },
                )
            }
            Binary::Pow => Self::power::<SLOPE>(a, b),
            Binary::Atan2 => {
                let (value, smooth) = a.value.atan2(b.value);
                let out = Self::jumping::<SLOPE>(value, &[a, b]);
                if !SLOPE {
                    return out;
                }
                let top = a.slope.mul(b.value).sub(b.slope.mul(a.value));
                out.smooth_in::<SLOPE>(smooth, top.div(a.value.square().add(b.value.square())))
            }
            Binary::Less | Binary::LessEqual | Binary::Equal | Binary::And | Binary::Or => {
                let value = a.value.truth(f, b.value);
                let [yes, no] = value.certain();
                let mut certain = yes;
                certain.iter_mut().zip(no).for_each(|(a, b)| *a |= b);
                Self::jumping::<SLOPE>(value, &[a, b]).smooth_in::<SLOPE>(certain, Range::ZERO)
            }
            Binary::Random => {
                let mut value = Range::from_ends(0.0, 1.0);
                for lane in 0..LANES {
                    let ([low, high], [from, to]) = (a.value.lane(lane), b.value.lane(lane));
                    if low == high && from == to {
                        let number = crate::random(low, from);
                        value.set(lane, [number, number]);
                    }
                }
                Self::jumping::<SLOPE>(value, &[a, b])
            }
        }
    }

    fn power<const SLOPE: bool>(a: &Self, b: &Self) -> Self {
        let [low, high] = b.value.lane(0);
        let constant = (b.value == Range::from_ends(low, high) && low == high).then_some(low);
        let whole = |v: f64| (v.fract() == 0.0 && (1.0..=64.0).contains(&v)).then_some(v as u32);
        let value = match constant.and_then(whole) {
            Some(exponent) => a.value.whole_power(exponent),
            None => a.value.power(b.value),
        };
        if !SLOPE {
            return Self { value, slope: Range::ZERO };
        }
        let base = match constant {
            Some(exponent) => {
                let lower = match whole(exponent - 1.0) {
                    Some(lower) => a.value.whole_power(lower),
                    None => a.value.power(Range::from_ends(exponent - 1.0, exponent - 1.0)),
                };
                a.slope.mul(Range::from_ends(exponent, exponent)).mul(lower)
            }
            None => a.slope.mul(b.value).mul(a.value.power(b.value.sub(ONE))),
        };
        if b.still() == [true; LANES] {
            return Self { value, slope: base };
        }
        let log = a.value.within(0.0, f64::INFINITY).rising(Unary::Ln, false);
        // Below 0 there is no logarithm, but whole exponents have a value.
        let mut unknown = [false; LANES];
        for (lane, unknown) in unknown.iter_mut().enumerate() {
            *unknown = a.value.lane(lane)[0] < 0.0;
        }
        let slope = base.add(b.slope.mul(value.mul(log))).replaced(unknown, Range::ENTIRE);
        Self { value, slope }
    }

    /// The second where the first is not 0, else the third.
    pub(super) fn select<const SLOPE: bool>(condition: &Self, a: &Self, b: &Self) -> Self {
        let [yes, no] = condition.value.certain();
        let both = Self::jumping::<SLOPE>(a.value.hull(b.value), &[condition, a, b]);
        let value = both.value.replaced(yes, a.value).replaced(no, b.value);
        Self { value, ..both }.smooth_in::<SLOPE>(yes, a.slope).smooth_in::<SLOPE>(no, b.slope)
    }
}

/// A value, and the slope that is made of it where it is asked for.
#[inline(always)]
fn with<const SLOPE: bool>(value: Range, slope: impl FnOnce(Range) -> Range) -> Dual {
    Dual { value, slope: if SLOPE { slope(value) } else { Range::ZERO } }
}

const ONE: Range = Range::from_ends(1.0, 1.0);
