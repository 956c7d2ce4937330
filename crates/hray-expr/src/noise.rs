//! Noise at one point: the definitions that the lanes are compared with.

use crate::NoiseTables;
use crate::apply::mix;
use crate::kernels::noise::Noise;

/// Perlin's permutation, as published with "Improving Noise" (SIGGRAPH 2002).
pub(crate) const PERMUTATION: [u8; 256] = [
    151, 160, 137, 91, 90, 15, 131, 13, 201, 95, 96, 53, 194, 233, 7, 225, 140, 36, 103, 30, 69, 142, 8, 99,
    37, 240, 21, 10, 23, 190, 6, 148, 247, 120, 234, 75, 0, 26, 197, 62, 94, 252, 219, 203, 117, 35, 11, 32,
    57, 177, 33, 88, 237, 149, 56, 87, 174, 20, 125, 136, 171, 168, 68, 175, 74, 165, 71, 134, 139, 48, 27,
    166, 77, 146, 158, 231, 83, 111, 229, 122, 60, 211, 133, 230, 220, 105, 92, 41, 55, 46, 245, 40, 244,
    102, 143, 54, 65, 25, 63, 161, 1, 216, 80, 73, 209, 76, 132, 187, 208, 89, 18, 169, 200, 196, 135, 130,
    116, 188, 159, 86, 164, 100, 109, 198, 173, 186, 3, 64, 52, 217, 226, 250, 124, 123, 5, 202, 38, 147,
    118, 126, 255, 82, 85, 212, 207, 206, 59, 227, 47, 16, 58, 17, 182, 189, 28, 42, 223, 183, 170, 213, 119,
    248, 152, 2, 44, 154, 163, 70, 221, 153, 101, 155, 167, 43, 172, 9, 129, 22, 39, 253, 19, 98, 108, 110,
    79, 113, 224, 232, 178, 185, 112, 104, 218, 246, 97, 228, 251, 34, 242, 193, 238, 210, 144, 12, 191, 179,
    162, 241, 81, 51, 145, 235, 249, 14, 239, 107, 49, 192, 214, 31, 181, 199, 106, 157, 184, 84, 204, 176,
    115, 121, 50, 45, 127, 4, 150, 254, 138, 236, 205, 93, 222, 114, 67, 29, 24, 72, 243, 141, 128, 195, 78,
    66, 215, 61, 156, 180,
];

/// A permutation shuffled by a seed, as [`NoiseTables::generate`] shuffles.
pub(crate) fn shuffled(mut permutation: [u8; 256], seed: u64) -> [u8; 256] {
    let mut state = seed;
    for i in (1..256usize).rev() {
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let j = ((mix(state) >> 32) * (i as u64 + 1)) >> 32;
        permutation.swap(i, j as usize);
    }
    permutation
}

/// The permutation of a seed of improved noise.
pub(crate) fn improved_permutation(seed: u64) -> [u8; 256] {
    if seed == 0 { PERMUTATION } else { shuffled(PERMUTATION, seed) }
}

/// K. Perlin, "Improving Noise", SIGGRAPH 2002, at a point.
#[must_use]
pub fn improved_noise(seed: u64, p: [f64; 3]) -> f64 {
    let permutation = improved_permutation(seed);
    improved(&permutation, p)
}

pub(crate) fn improved(permutation: &[u8; 256], p: [f64; 3]) -> f64 {
    let floor = p.map(f64::floor);
    let cell = floor.map(|v| (v as i64 & 255) as usize);
    let [x, y, z] = [p[0] - floor[0], p[1] - floor[1], p[2] - floor[2]];
    let fade = |t: f64| t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    let lerp = |t: f64, a: f64, b: f64| a + t * (b - a);
    let [u, v, w] = [fade(x), fade(y), fade(z)];
    let at = |i: usize| usize::from(permutation[i & 255]);
    let corner = |i: usize, j: usize, k: usize| {
        let hash = at(at(at(cell[0] + i) + cell[1] + j) + cell[2] + k);
        gradient(hash, x - i as f64, y - j as f64, z - k as f64)
    };
    let low = lerp(v, lerp(u, corner(0, 0, 0), corner(1, 0, 0)), lerp(u, corner(0, 1, 0), corner(1, 1, 0)));
    let high = lerp(v, lerp(u, corner(0, 0, 1), corner(1, 0, 1)), lerp(u, corner(0, 1, 1), corner(1, 1, 1)));
    lerp(w, low, high)
}

/// The product with one of twelve directions, to the middles of a cube's edges.
fn gradient(hash: usize, x: f64, y: f64, z: f64) -> f64 {
    let h = hash & 15;
    let u = if h < 8 { x } else { y };
    let v = if h < 4 {
        y
    } else if h == 12 || h == 14 {
        x
    } else {
        z
    };
    (if h & 1 == 0 { u } else { -u }) + (if h & 2 == 0 { v } else { -v })
}

/// K. Perlin, "An Image Synthesizer", SIGGRAPH 1985, at a point.
#[must_use]
pub fn classic_noise(tables: &NoiseTables, seed: u64, p: [f64; 3]) -> f64 {
    match seed {
        0..=2 => Noise::new(tables).at(seed as usize, p),
        seed => {
            let mut permutations = *tables.permutations();
            permutations[0] = shuffled(permutations[0], seed);
            match NoiseTables::new(permutations, *tables.gradients()) {
                Ok(tables) => Noise::new(&tables).at(0, p),
                Err(_) => f64::NAN,
            }
        }
    }
}

/// Worley's cellular texture at a point, see [`crate::Block::Cells`]. Feature points lie anywhere in their cells, so the two
/// nearest lie within two cells: 5³ are searched.
#[must_use]
pub fn cells(seed: u64, p: [f64; 3]) -> [f64; 6] {
    let base = p.map(f64::floor);
    let (mut first, mut second, mut id, mut toward) = (f64::INFINITY, f64::INFINITY, 0.0, [0.0; 3]);
    for k in -2..=2 {
        for j in -2..=2 {
            for i in -2..=2 {
                let cell = [base[0] + f64::from(i), base[1] + f64::from(j), base[2] + f64::from(k)];
                let mut word = mix(seed.wrapping_add(0x9E37_79B9_7F4A_7C15));
                for c in cell {
                    word = mix(word ^ (c + 0.0).to_bits());
                }
                let fraction = |word: u64| (word >> 11) as f64 / (1u64 << 53) as f64;
                let (a, b, c, d) = (mix(word ^ 1), mix(word ^ 2), mix(word ^ 3), mix(word ^ 4));
                let offset = [fraction(a), fraction(b), fraction(c)];
                let v = [cell[0] + offset[0] - p[0], cell[1] + offset[1] - p[1], cell[2] + offset[2] - p[2]];
                let squared = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
                if squared < first {
                    (second, first, id, toward) = (first, squared, fraction(d), v);
                } else if squared < second {
                    second = squared;
                }
            }
        }
    }
    [first.sqrt(), second.sqrt(), id, toward[0], toward[1], toward[2]]
}
