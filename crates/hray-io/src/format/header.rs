//! The headers of formats whose pixels follow as they are.

/// PPM, as text or binary: <https://netpbm.sourceforge.net/doc/ppm.html>.
pub(super) fn ppm(magic: &str, width: u32, height: u32) -> Vec<u8> {
    format!("{magic}\n{width} {height}\n255\n").into_bytes()
}

/// farbfeld: <https://tools.suckless.org/farbfeld/>.
pub(super) fn farbfeld(width: u32, height: u32) -> Vec<u8> {
    let mut header = b"farbfeld".to_vec();
    header.extend_from_slice(&width.to_be_bytes());
    header.extend_from_slice(&height.to_be_bytes());
    header
}

/// TGA 2.0 (Truevision, 1991): uncompressed true colour of 24 bits, lines from the top. Sides of at most
/// 65535, which [`super::PictureFormat::check_size`] sees to.
pub(super) fn tga(width: u32, height: u32) -> Vec<u8> {
    const TRUE_COLOR: u8 = 2;
    const FROM_THE_TOP: u8 = 0x20;
    let mut header = vec![0, 0, TRUE_COLOR, 0, 0, 0, 0, 0, 0, 0, 0, 0];
    header.extend_from_slice(&(width as u16).to_le_bytes());
    header.extend_from_slice(&(height as u16).to_le_bytes());
    header.extend_from_slice(&[24, FROM_THE_TOP]);
    header
}

/// Radiance, flat (not run-length encoded): Radiance reference manual, "picture file format".
pub(super) fn hdr(width: u32, height: u32) -> Vec<u8> {
    format!("#?RADIANCE\nSOFTWARE=hray\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n").into_bytes()
}
