//! From real numbers to the whole numbers of a picture.

use hray_core::Rgb;

/// 2^52 + 2^51: between 2^52 and 2^53 neighbouring doubles are 1 apart, so adding this rounds a number of
/// magnitude below 2^51 to an integer, half to even as every addition does, and leaves that integer in the
/// low bits. No call of a library, and it vectorises.
const ROUND: f64 = 6_755_399_441_055_744.0;

/// round(255 c), half to even, as a difference of bit patterns: the number itself where it is in 0..=255, and
/// something larger where it is not (or is no number).
pub(super) fn round_255(component: f64) -> u64 {
    (255.0 * component + ROUND).to_bits().wrapping_sub(ROUND.to_bits())
}

/// round(max c) clipped to 0..=max, half to even. NaN becomes max, as the thesis' clip makes it 1.
fn clipped(component: f64, max: f64) -> u64 {
    let value = max * component;
    // Two comparisons in this order are one instruction each, and let NaN fall on max.
    let value = if value < max { value } else { max };
    let value = if value > 0.0 { value } else { 0.0 };
    (value + ROUND).to_bits()
}

/// Eight bits a component, red first.
pub(super) fn rgb8(pixels: &[Rgb]) -> Vec<u8> {
    let mut bytes = vec![0; 3 * pixels.len()];
    for (out, pixel) in bytes.chunks_exact_mut(3).zip(pixels) {
        out.copy_from_slice(&pixel.to_array().map(|component| clipped(component, 255.0) as u8));
    }
    bytes
}

/// Sixteen bits a component in the byte order of the machine: red, green, blue and full opacity.
pub(super) fn rgba16(pixels: &[Rgb]) -> Vec<u8> {
    let mut bytes = vec![0xff; 8 * pixels.len()];
    for (out, pixel) in bytes.chunks_exact_mut(8).zip(pixels) {
        for (pair, component) in out.chunks_exact_mut(2).zip(pixel.to_array()) {
            pair.copy_from_slice(&(clipped(component, 65535.0) as u16).to_ne_bytes());
        }
    }
    bytes
}

/// Single precision in the byte order of the machine, neither scaled nor clipped.
pub(super) fn rgb32(pixels: &[Rgb]) -> Vec<u8> {
    let mut bytes = vec![0; 12 * pixels.len()];
    for (out, pixel) in bytes.chunks_exact_mut(12).zip(pixels) {
        for (four, component) in out.chunks_exact_mut(4).zip(pixel.to_array()) {
            four.copy_from_slice(&(component as f32).to_ne_bytes());
        }
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn oracle(c: f64, max: f64) -> u16 {
        if c.is_nan() { max as u16 } else { (max * c).round_ties_even().clamp(0.0, max) as u16 }
    }

    fn any_double() -> impl Strategy<Value = f64> {
        prop_oneof![
            any::<u64>().prop_map(f64::from_bits),
            -0.5..1.5f64,
            (0..=1020u32).prop_map(|n| f64::from(n) / 510.0),
            (0..=131_070u32).prop_map(|n| f64::from(n) / 131_070.0),
        ]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4000))]

        #[test]
        fn integers_are_the_nearest_ones(r in any_double(), g in any_double(), b in any_double()) {
            let pixel = [Rgb::new(r, g, b)];
            let eight = [r, g, b].map(|c| oracle(c, 255.0) as u8);
            prop_assert_eq!(rgb8(&pixel), eight);
            let words: Vec<u16> = rgba16(&pixel)
                .chunks_exact(2)
                .map(|pair| u16::from_ne_bytes([pair[0], pair[1]]))
                .collect();
            prop_assert_eq!(words, [oracle(r, 65535.0), oracle(g, 65535.0), oracle(b, 65535.0), 65535]);
        }

        #[test]
        fn singles_are_the_nearest_ones(r in any_double()) {
            let expected = [r as f32, 0.0, 1.0].map(f32::to_ne_bytes);
            prop_assert_eq!(rgb32(&[Rgb::new(r, 0.0, 1.0)]), expected.as_flattened());
        }

        #[test]
        fn the_common_components_are_found_and_no_others(c in any_double()) {
            let v = (255.0 * c).round_ties_even();
            let found = round_255(c);
            if (0.0..=255.0).contains(&v) {
                prop_assert_eq!(found, v as u64);
            } else {
                prop_assert!(found > 255, "{c}: {found}");
            }
        }
    }
}
