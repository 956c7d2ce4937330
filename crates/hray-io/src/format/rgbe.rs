//! Radiance's pixel: three mantissas of eight bits under one exponent.
//!
//! G. Ward, "Real Pixels", Graphics Gems II, 1991. The largest component m = f 2^e with f in [1/2, 1) sets
//! the exponent; every component c is stored as floor(256 c / 2^e). The exponent is read from the bits of
//! the number, so that no platform's logarithm decides it.

use hray_core::Rgb;

/// The largest value that the eight bits of the exponent reach.
const LARGEST: f64 = f64::from_bits((1023 + 126) << 52 | 0x000f_e000_0000_0000);

/// Four bytes a pixel. Negative components become 0; what is too large, or no number, the largest there is.
pub(super) fn rgbe(pixels: &[Rgb]) -> Vec<u8> {
    pixels.iter().flat_map(|pixel| encode(pixel.to_array())).collect()
}

fn encode(components: [f64; 3]) -> [u8; 4] {
    let clipped = components.map(|c| if c < LARGEST { if c > 0.0 { c } else { 0.0 } } else { LARGEST });
    let largest = clipped.iter().fold(0.0, |m: f64, &c| if c > m { c } else { m });
    // The exponent e of largest = f 2^e, f in [1/2, 1).
    let exponent = (largest.to_bits() >> 52) as i64 - 1022;
    if exponent < -127 {
        return [0; 4];
    }
    let scale = f64::from_bits(((1023 + 8 - exponent) as u64) << 52);
    let [r, g, b] = clipped.map(|c| (c * scale) as u8);
    [r, g, b, (exponent + 128) as u8]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn decode([r, g, b, e]: [u8; 4]) -> [f64; 3] {
        let scale = power_of_two(i32::from(e) - 136);
        [r, g, b].map(|m| f64::from(m) * scale)
    }

    fn power_of_two(exponent: i32) -> f64 {
        f64::from_bits(((1023 + i64::from(exponent)) as u64) << 52)
    }

    #[test]
    fn known_pixels() {
        assert_eq!(encode([0.0, -1.0, 0.0]), [0, 0, 0, 0]);
        assert_eq!(encode([1.0, 0.5, 0.25]), [128, 64, 32, 129]);
        assert_eq!(encode([f64::INFINITY, f64::NAN, 0.0]), [255, 255, 0, 255]);
        assert_eq!(encode([f64::from_bits(1), 0.0, 0.0]), [0, 0, 0, 0]);
    }

    proptest! {
        #[test]
        fn decoding_comes_within_one_part_of_the_largest_component(
            r in 0.0..8.0f64, g in 0.0..8.0f64, b in 0.0..8.0f64
        ) {
            let decoded = decode(encode([r, g, b]));
            let largest = r.max(g).max(b);
            for (c, d) in [r, g, b].into_iter().zip(decoded) {
                prop_assert!(d <= c && c - d <= largest / 128.0, "{c} became {d}");
            }
        }

        #[test]
        fn no_bit_pattern_panics_or_looks_like_a_compressed_line(bits in any::<[u64; 3]>()) {
            // A flat pixel must not read as the marker (2, 2, below 128) of a run-length encoded line.
            let [r, g, b, _] = encode(bits.map(f64::from_bits));
            prop_assert!((r, g, b) == (0, 0, 0) || r.max(g).max(b) >= 128);
        }
    }
}
