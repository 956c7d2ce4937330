//! The text of a P3 file, as the program of 2005 wrote it.
//!
//! Every component is an integer followed by one space: round(255 c), half to even, of any size and sign.
//! Haskell's `round` knows no overflow, so a background of 2 is 510, one of 10^300 has 303 digits, and an
//! infinite one is 2^1024 in full; NaN, which no scene brings this far, is -3/2 of that, as there.
//!
//! A picture is mostly components in 0..=255, and formatting them was the larger part of the time of a simple
//! scene. They come from a table of ready-made four-byte texts: each is stored whole, and the next begins
//! where its text ended.

use super::quantize::round_255;
use hray_core::Rgb;

/// Pixels formatted at a time, into a block that stays in the fastest cache.
const BLOCK: usize = 64;

/// The texts "0 " to "255 ": in the low four bytes, the first character lowest, and their length above.
const TEXTS: [u64; 256] = {
    let mut texts = [0; 256];
    let mut n = 0;
    while n < 256 {
        let mut text = b' ' as u64;
        let mut length = 1;
        let mut rest = n as u64;
        while length == 1 || rest > 0 {
            text = text << 8 | (b'0' as u64 + rest % 10);
            rest /= 10;
            length += 1;
        }
        texts[n] = length << 32 | text;
        n += 1;
    }
    texts
};

/// The text of a run of pixels.
pub(super) fn ppm_text(pixels: &[Rgb]) -> Vec<u8> {
    let mut text = Vec::with_capacity(12 * pixels.len());
    for block in pixels.chunks(BLOCK) {
        if !common(block, &mut text) {
            for component in block.iter().flat_map(|pixel| pixel.to_array()) {
                text.extend_from_slice(integer(component).as_bytes());
                text.push(b' ');
            }
        }
    }
    text
}

/// Appends the text of a block whose components are all in 0..=255; appends nothing where one is not.
fn common(block: &[Rgb], out: &mut Vec<u8>) -> bool {
    // The mask changes nothing; it tells the compiler that there is room, whatever the position.
    const MASK: usize = (12 * BLOCK).next_power_of_two() - 1;
    let mut bytes = [0; MASK + 1 + 4];
    let mut end = 0;
    let mut all = 0;
    for pixel in block {
        for component in pixel.to_array() {
            let value = round_255(component);
            all |= value;
            let text = TEXTS[usize::from(value as u8)];
            bytes[end & MASK..][..4].copy_from_slice(&(text as u32).to_le_bytes());
            end += (text >> 32) as usize;
        }
    }
    if all > 255 {
        return false;
    }
    out.extend_from_slice(&bytes[..end.min(MASK)]);
    true
}

/// round(255 c) in decimal.
fn integer(component: f64) -> String {
    let value = 255.0 * component;
    let sign = if value < 0.0 || value.is_nan() { "-" } else { "" };
    if value.is_nan() {
        format!("{sign}{}", multiple_of_2_to_1023(3))
    } else if value.is_infinite() {
        format!("{sign}{}", multiple_of_2_to_1023(2))
    } else {
        // Adding zero turns -0 into 0.
        format!("{:.0}", value.round_ties_even() + 0.0)
    }
}

/// factor 2^1023 in decimal.
fn multiple_of_2_to_1023(factor: u8) -> String {
    let power = f64::from_bits(0x7fe0_0000_0000_0000);
    let mut carry = 0;
    let mut digits: Vec<char> = Vec::new();
    for digit in format!("{power:.0}").bytes().rev() {
        let product = (digit - b'0') * factor + carry;
        digits.push(char::from(b'0' + product % 10));
        carry = product / 10;
    }
    if carry > 0 {
        digits.push(char::from(b'0' + carry));
    }
    digits.iter().rev().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn text_of(components: &[f64]) -> String {
        let pixels: Vec<Rgb> = components.chunks_exact(3).map(|c| Rgb::new(c[0], c[1], c[2])).collect();
        String::from_utf8(ppm_text(&pixels)).unwrap()
    }

    /// What the fast path must equal. Without infinities and NaN, which have tests of their own.
    fn oracle(components: &[f64]) -> String {
        components
            .iter()
            .map(|c| format!("{:.0} ", (255.0 * c).round_ties_even()).replace("-0 ", "0 "))
            .collect()
    }

    #[test]
    fn components_are_rounded_half_to_even_and_unbounded() {
        let half = 0.5 / 255.0;
        assert_eq!(255.0 * half, 0.5);
        assert_eq!(text_of(&[0.0, 1.0, 0.5]), "0 255 128 ");
        assert_eq!(text_of(&[half, 3.0 * half, 5.0 * half]), "0 2 2 ");
        assert_eq!(text_of(&[2.0, -0.3, -0.0]), "510 -76 0 ");
        assert_eq!(text_of(&[-0.001, -1e-300, 1e17]), "0 0 25500000000000000000 ");
    }

    #[test]
    fn infinities_are_printed_in_full() {
        let text = text_of(&[f64::INFINITY, f64::NEG_INFINITY, f64::NAN]);
        let numbers: Vec<&str> = text.split(' ').collect();
        assert_eq!(numbers.len(), 4);
        assert_eq!(numbers[0].len(), 309);
        assert!(numbers[0].starts_with("17976931348623159077") && numbers[0].ends_with("356329624224137216"));
        assert_eq!(numbers[1], format!("-{}", numbers[0]));
        assert!(numbers[2].starts_with("-26965397022934738615"), "{}", numbers[2]);
    }

    #[test]
    fn every_text_of_the_table_is_right() {
        for n in 0..=255u32 {
            let c = f64::from(n) / 255.0;
            assert_eq!(text_of(&[c, c, c]), format!("{n} {n} {n} "));
        }
    }

    fn any_finite() -> impl Strategy<Value = f64> {
        prop_oneof![
            1 => any::<u64>().prop_map(f64::from_bits).prop_filter("a finite product", |c| (255.0 * c).is_finite()),
            20 => -0.01..1.01f64,
            20 => (-2..=514i32).prop_map(|n| f64::from(n) / 510.0),
        ]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(500))]

        #[test]
        fn the_fast_path_equals_the_obvious_one(components in prop::collection::vec(any_finite(), 0..600)) {
            let components = &components[..components.len() / 3 * 3];
            prop_assert_eq!(text_of(components), oracle(components));
        }

        #[test]
        fn ordinary_colours_equal_the_obvious_text(components in prop::collection::vec(0.0..=1.0f64, 0..900)) {
            let components = &components[..components.len() / 3 * 3];
            prop_assert_eq!(text_of(components), oracle(components));
        }

        #[test]
        fn no_bit_pattern_panics(bits in any::<[u64; 3]>()) {
            let text = text_of(&bits.map(f64::from_bits));
            prop_assert_eq!(text.matches(' ').count(), 3);
        }
    }
}
