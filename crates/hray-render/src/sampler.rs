//! Where inside its neighbourhood a pixel is sampled. Thesis §6.1 names anti-aliasing as work to be done.

/// The samples of one pixel: points of an Owen-scrambled Sobol' (0, 2)-sequence, warped to a tent filter.
///
/// Any power of two of consecutive points is stratified in both dimensions and in every elementary interval,
/// so noise falls faster than with independent samples. Scrambling makes neighbouring pixels independent; it
/// depends on the pixel's coordinates alone. B. Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4),
/// 2020; the hash of its section 3 with the constants of N. Vegdahl, "Building a Better LK Hash", 2021.
#[derive(Clone, Copy)]
pub(crate) struct PixelSamples {
    seeds: [u32; 2],
}

impl PixelSamples {
    /// The samples of the pixel `x` from the left and `y` from the top of the whole picture.
    pub(crate) fn of(x: u32, y: u32) -> Self {
        let pixel = mix(x ^ mix(y ^ 0x9E37_79B9));
        Self { seeds: [mix(pixel ^ 0x68BC_21EB), mix(pixel ^ 0x02E5_BE93)] }
    }

    /// Offset of sample `index` from the pixel's own point, in pixels, each in (-1, 1).
    pub(crate) fn offset(&self, index: u32) -> [f64; 2] {
        let [first, second] = sobol(index);
        [tent(scramble(first, self.seeds[0])), tent(scramble(second, self.seeds[1]))]
    }
}

/// A finalizer of good avalanche: the 32-bit `lowbias32` of C. Wellons' hash prospector.
fn mix(mut v: u32) -> u32 {
    v ^= v >> 16;
    v = v.wrapping_mul(0x7FEB_352D);
    v ^= v >> 15;
    v = v.wrapping_mul(0x846C_A68B);
    v ^ (v >> 16)
}

/// The first two dimensions of the Sobol' sequence, as fractions of 2^32.
fn sobol(index: u32) -> [u32; 2] {
    let (mut second, mut direction, mut bits) = (0, 1u32 << 31, index);
    while bits != 0 {
        if bits & 1 == 1 {
            second ^= direction;
        }
        direction ^= direction >> 1;
        bits >>= 1;
    }
    [index.reverse_bits(), second]
}

/// A nested uniform scramble: each bit is flipped depending on the bits above it and the seed.
fn scramble(v: u32, seed: u32) -> u32 {
    let mut v = v.reverse_bits();
    v ^= v.wrapping_mul(0x3D20_ADEA);
    v = v.wrapping_add(seed);
    v = v.wrapping_mul((seed >> 16) | 1);
    v ^= v.wrapping_mul(0x0552_6C56);
    v ^= v.wrapping_mul(0x53A2_2864);
    v.reverse_bits()
}

/// Warps a fraction of 2^32 so that its density is the tent 1 - |t| on (-1, 1).
fn tent(fraction: u32) -> f64 {
    let u = (f64::from(fraction) + 0.5) / 4_294_967_296.0;
    if u < 0.5 { (2.0 * u).sqrt() - 1.0 } else { 1.0 - (2.0 * (1.0 - u)).sqrt() }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// In every elementary interval of area 1/64 lies exactly one of the first 64 points, scrambled or not.
    #[test]
    fn the_points_are_a_net() {
        for pixel in 0..20 {
            let samples = PixelSamples::of(pixel, 7 * pixel);
            let points: Vec<[u32; 2]> = (0..64)
                .map(|i| {
                    let [x, y] = sobol(i);
                    [scramble(x, samples.seeds[0]), scramble(y, samples.seeds[1])]
                })
                .collect();
            for columns in [0u32, 1, 2, 3, 4, 5, 6] {
                let mut seen = [false; 64];
                for [x, y] in &points {
                    let column = (u64::from(*x) >> (32 - columns)) as usize;
                    let row = (u64::from(*y) >> (32 - (6 - columns))) as usize;
                    let cell = column << (6 - columns) | row;
                    assert!(
                        !std::mem::replace(&mut seen[cell], true),
                        "{columns}: two points in cell {cell}"
                    );
                }
            }
        }
    }

    /// The tent has mean 0 and variance 1/6.
    #[test]
    fn offsets_follow_the_tent() {
        let n = 1 << 12;
        let samples = PixelSamples::of(3, 5);
        let (mut sum, mut squares) = (0.0, 0.0);
        for i in 0..n {
            let [x, y] = samples.offset(i);
            assert!(x.abs() < 1.0 && y.abs() < 1.0);
            sum += x;
            squares += y * y;
        }
        assert!((sum / f64::from(n)).abs() < 1e-3);
        assert!((squares / f64::from(n) - 1.0 / 6.0).abs() < 1e-3);
    }

    #[test]
    fn neighbouring_pixels_differ() {
        assert_ne!(PixelSamples::of(0, 0).offset(0), PixelSamples::of(1, 0).offset(0));
        assert_ne!(PixelSamples::of(0, 0).offset(0), PixelSamples::of(0, 1).offset(0));
        assert_ne!(PixelSamples::of(2, 1).offset(0), PixelSamples::of(1, 2).offset(0));
    }
}
