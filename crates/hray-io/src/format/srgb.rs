//! Linear light to the components of sRGB: the transfer function of IEC 61966-2-1.

use hray_core::Rgb;
use std::sync::LazyLock;

/// Up to here the transfer function is a line; it goes through the origin.
const LINE_END: f64 = 0.003_130_8;

/// The component that stands for an amount of linear light. Below 0 it is the mirror image of that above, and
/// beyond 1 the curve goes on, for formats that can hold such a component.
fn encode(linear: f64) -> f64 {
    let size = linear.abs();
    let encoded = if size <= LINE_END { 12.92 * size } else { 1.055 * libm::pow(size, 1.0 / 2.4) - 0.055 };
    encoded.copysign(linear)
}

/// The colours as components of sRGB.
pub(super) fn encoded(pixels: &[Rgb]) -> Vec<Rgb> {
    pixels.iter().map(|pixel| pixel.to_array().map(encode).into()).collect()
}

/// For each number from 1 to 255 the least amount of linear light that is rounded to it.
static LEAST: LazyLock<[f64; 255]> = LazyLock::new(|| std::array::from_fn(|i| least(i as u8 + 1)));

/// round(255 encode(linear)), half to even, of linear light in [0, 1].
fn rounded(linear: f64) -> u8 {
    (255.0 * encode(linear)).round_ties_even() as u8
}

/// The least double in [0, 1] that is rounded to `value` or more, by bisection over the bits, which are in the
/// order of the numbers.
fn least(value: u8) -> f64 {
    let (mut below, mut above) = (0.0f64.to_bits(), 1.0f64.to_bits());
    while above - below > 1 {
        let middle = below + (above - below) / 2;
        if rounded(f64::from_bits(middle)) < value { below = middle } else { above = middle }
    }
    f64::from_bits(above)
}

/// Cells of [`FIRST`]: enough that few hold more than one threshold.
const CELLS: usize = 4096;

/// For each cell of [0, 1) the number that its lowest light is rounded to.
static FIRST: LazyLock<[u8; CELLS + 1]> =
    LazyLock::new(|| std::array::from_fn(|cell| rounded(cell as f64 / CELLS as f64)));

/// Eight bits a component, red first: the bytes of rounding [`encoded`], without a power for each.
pub(super) fn rgb8(pixels: &[Rgb]) -> Vec<u8> {
    let (first, least) = (&*FIRST, &*LEAST);
    let byte = |linear: f64| {
        // NaN becomes 255, as everywhere.
        let linear = if linear < 1.0 { linear } else { 1.0 };
        let linear = if linear > 0.0 { linear } else { 0.0 };
        let mut value = first[((linear * CELLS as f64) as usize).min(CELLS)];
        while least.get(usize::from(value)).is_some_and(|&next| linear >= next) {
            value += 1;
        }
        value
    };
    let mut bytes = vec![0; 3 * pixels.len()];
    for (out, pixel) in bytes.chunks_exact_mut(3).zip(pixels) {
        out.copy_from_slice(&pixel.to_array().map(byte));
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::quantize;
    use proptest::prelude::*;

    #[test]
    fn known_values() {
        let byte = |linear: f64| rgb8(&[Rgb::new(linear, 0.0, 1.0)])[0];
        // Middle grey: half of the light is written 188.
        assert_eq!([byte(0.5), byte(0.0), byte(1.0), byte(0.214_041_140_482_232_55)], [188, 0, 255, 128]);
        assert_eq!([byte(-3.0), byte(7.0), byte(f64::NAN), byte(f64::INFINITY)], [0, 255, 255, 255]);
        assert!((encode(LINE_END) - encode(LINE_END * 1.000_001)).abs() < 1e-6, "the parts meet");
        assert_eq!(encode(-0.5), -encode(0.5));
    }

    #[test]
    fn both_sides_of_every_threshold_are_right() {
        for (i, &least) in LEAST.iter().enumerate() {
            for near in [least, f64::from_bits(least.to_bits() - 1)] {
                assert_eq!(rgb8(&[Rgb::new(near, 0.0, 0.0)])[0], rounded(near), "around threshold {i}");
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4000))]

        #[test]
        fn the_table_gives_what_the_function_gives(
            linear in prop_oneof![any::<u64>().prop_map(f64::from_bits), -0.1..1.1f64, 0.0..0.01f64],
        ) {
            let pixel = [Rgb::new(linear, 0.0, 1.0)];
            prop_assert_eq!(rgb8(&pixel), quantize::rgb8(&encoded(&pixel)));
        }
    }
}
