//! The tables behind the noise of 1985.

use crate::apply::SplitMix64;
use std::fmt;

/// What gradient noise draws from: permutations of 0..=255 and 256 gradient vectors. Thesis §3.4, after
/// K. Perlin, "An Image Synthesizer", SIGGRAPH 1985.
///
/// The first permutation serves every texture; the second and third are the green and blue of plasma. The
/// thesis prints only the first few entries of the tables it used, so the project has tables of its own,
/// [`NoiseTables::generate`]; others can be loaded to reproduce pictures made with them.
#[derive(Clone, PartialEq)]
pub struct NoiseTables {
    permutations: [[u8; 256]; 3],
    gradients: [[f64; 3]; 256],
}

impl NoiseTables {
    /// The seed of the tables that hray ships: the year of the thesis.
    pub const SEED: u64 = 2005;

    /// Tables from given parts.
    ///
    /// # Errors
    /// [`NoiseTablesError`] where a permutation holds a value twice, or a gradient is not finite. Gradients
    /// need not have length 1: what is loaded is used as it is.
    pub fn new(permutations: [[u8; 256]; 3], gradients: [[f64; 3]; 256]) -> Result<Self, NoiseTablesError> {
        for (table, permutation) in permutations.iter().enumerate() {
            let mut seen = [false; 256];
            for &value in permutation {
                if std::mem::replace(&mut seen[usize::from(value)], true) {
                    return Err(NoiseTablesError::Repeated { table, value });
                }
            }
        }
        if let Some(index) = gradients.iter().position(|g| g.iter().any(|c| !c.is_finite())) {
            return Err(NoiseTablesError::NotFinite { index });
        }
        Ok(Self { permutations, gradients })
    }

    /// The tables that hray ships, from a seed (by default [`NoiseTables::SEED`]).
    ///
    /// The procedure, so that anyone can repeat it: 64-bit words come from `SplitMix64` (Steele, Lea and
    /// Flood, OOPSLA 2014) started at the seed. Each of the three permutations is 0..=255 shuffled by
    /// Fisher and Yates from the top: for i = 255 down to 1, swap entry i with entry (w >> 32) (i + 1) >> 32
    /// of the next word w. Each gradient takes points of the cube [-1, 1)^3, one word per coordinate,
    /// 2^-52 (w >> 11) - 1, until one has a squared length in (0.01, 1], and divides it by its length. Only
    /// operations that IEEE 754 rounds exactly are used, so every machine makes the same tables.
    #[must_use]
    pub fn generate(seed: u64) -> Self {
        let mut words = SplitMix64(seed);
        let mut permutations = [identity(); 3];
        for permutation in &mut permutations {
            words.shuffle(permutation);
        }
        let mut coordinate = || (words.next() >> 11) as f64 / (1u64 << 52) as f64 - 1.0;
        let gradients = std::array::from_fn(|_| {
            loop {
                let [x, y, z] = [coordinate(), coordinate(), coordinate()];
                let squared = x * x + y * y + z * z;
                if squared > 0.01 && squared <= 1.0 {
                    let length = squared.sqrt();
                    break [x / length, y / length, z / length];
                }
            }
        });
        Self { permutations, gradients }
    }

    /// The permutations of 0..=255: red or all, green, blue.
    #[must_use]
    pub const fn permutations(&self) -> &[[u8; 256]; 3] {
        &self.permutations
    }

    /// The gradient vectors.
    #[must_use]
    pub const fn gradients(&self) -> &[[f64; 3]; 256] {
        &self.gradients
    }

    /// The permutation of a seed: 0, 1 and 2 are those of the tables, any other is the first, shuffled as in
    /// [`NoiseTables::generate`] by words from that seed.
    #[must_use]
    pub fn permutation(&self, seed: u64) -> [u8; 256] {
        match seed {
            0 => self.permutations[0],
            1 => self.permutations[1],
            2 => self.permutations[2],
            _ => {
                let mut permutation = self.permutations[0];
                SplitMix64(seed).shuffle(&mut permutation);
                permutation
            }
        }
    }
}

/// 0, 1, 2 and so on to 255.
fn identity() -> [u8; 256] {
    let mut permutation = [0; 256];
    for (entry, value) in permutation.iter_mut().zip(0..=255) {
        *entry = value;
    }
    permutation
}

impl Default for NoiseTables {
    fn default() -> Self {
        Self::generate(Self::SEED)
    }
}

impl fmt::Debug for NoiseTables {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("NoiseTables").finish_non_exhaustive()
    }
}

/// Why given tables cannot serve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoiseTablesError {
    /// A permutation holds a value twice, and so lacks another.
    Repeated {
        /// Which permutation, from 0.
        table: usize,
        /// The value it holds twice.
        value: u8,
    },
    /// A gradient has a component that is infinite or not a number.
    NotFinite {
        /// Which gradient, from 0.
        index: usize,
    },
}

impl fmt::Display for NoiseTablesError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Repeated { table, value } => {
                write!(
                    f,
                    "permutation {} holds the value {value} twice; it must hold each of 0 to 255 once",
                    table + 1
                )
            }
            Self::NotFinite { index } => write!(f, "gradient {index} is not a vector of finite numbers"),
        }
    }
}

impl std::error::Error for NoiseTablesError {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn generated_tables_are_valid_and_unit_length() {
        for seed in [0, 1, NoiseTables::SEED, u64::MAX] {
            let t = NoiseTables::generate(seed);
            assert!(NoiseTables::new(*t.permutations(), *t.gradients()).is_ok());
            for g in t.gradients() {
                let squared = g[0] * g[0] + g[1] * g[1] + g[2] * g[2];
                assert!((squared - 1.0).abs() < 1e-15, "{g:?}");
            }
        }
    }

    #[test]
    fn seeds_give_different_tables_and_the_three_permutations_differ() {
        let t = NoiseTables::generate(7);
        assert_ne!(t, NoiseTables::generate(8));
        let p = t.permutations();
        assert!(p[0] != p[1] && p[1] != p[2] && p[0] != p[2]);
    }

    #[test]
    fn bad_tables_are_refused() {
        let t = NoiseTables::default();
        let mut p = *t.permutations();
        p[1][3] = p[1][4];
        assert_eq!(
            NoiseTables::new(p, *t.gradients()),
            Err(NoiseTablesError::Repeated { table: 1, value: p[1][4] })
        );
        let mut g = *t.gradients();
        g[9][2] = f64::NAN;
        assert_eq!(NoiseTables::new(*t.permutations(), g), Err(NoiseTablesError::NotFinite { index: 9 }));
    }
}
