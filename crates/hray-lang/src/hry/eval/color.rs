//! Colours as they are written.

/// Linear light from a byte of encoded sRGB (IEC 61966-2-1).
pub(super) fn decode(byte: u8) -> f64 {
    let v = f64::from(byte) / 255.0;
    if v <= 0.04045 { v / 12.92 } else { libm::pow((v + 0.055) / 1.055, 2.4) }
}
