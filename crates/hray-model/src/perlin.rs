//! The patterns of §3.4: module `HRayPerlin` of A.3, after K. Perlin, "An Image Synthesizer", SIGGRAPH 1985.
//!
//! Chapter 2 knows nothing of them; chapter 3 gives types and leaves the definitions to the appendix.

use crate::concepts::{Color, Point3D, Vector};
use crate::maths::{add, clip, scale};

/// What the noise is drawn from: `getPList`, `getPList2`, `getPList3` and `getGList`.
///
/// The thesis prints only the start of these lists, so they are a parameter here.
#[derive(Clone, Debug, PartialEq)]
pub struct NoiseTables {
    /// A permutation of 0..=255, for every pattern.
    pub p_list: [u8; 256],
    /// A second one, for the green of plasma.
    pub p_list2: [u8; 256],
    /// A third one, for the blue of plasma.
    pub p_list3: [u8; 256],
    /// The gradients. Those of 2005 have length 1 to nine digits.
    pub g_list: [Vector; 256],
}

/// A pattern with its parameters: what the grammar calls `NoiseF`. Order and meaning of the parameters are
/// those of the function of the same name.
///
/// `freq` counts the octaves above the first, so n means n + 1 evaluations of noise. It is an `Int` in the
/// program, which never ended for a negative one; here the type has none.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "each parameter is explained at the function of the variant's name")]
pub enum NoiseF {
    /// [`perlin_solid`].
    PerlinSolid { base: Color, grid_s: f64 },
    /// [`perlin_semi_turbulence`].
    PerlinSemiTurbulence { base: Color, freq: u64, grid_s: f64 },
    /// [`perlin_turbulence`].
    PerlinTurbulence { base: Color, freq: u64, grid_s: f64 },
    /// [`perlin_fire`].
    PerlinFire { add_color: Color, base: Color, freq: u64, grid_s: f64 },
    /// [`perlin_plasma`].
    PerlinPlasma { grid_s: f64 },
    /// [`perlin_marble`].
    PerlinMarble { base: Color, freq: u64, grid_s: f64, factors: Vector, pow: f64 },
    /// [`perlin_marble_base`].
    PerlinMarbleBase { base: Color, add_color: Color, freq: u64, grid_s: f64, factors: Vector, pow: f64 },
    /// [`perlin_wood`].
    PerlinWood { base: Color, freq: u64, grid_s: f64, xy_fact: f64, pow: f64 },
}

/// The colour of a pattern in a point: the application of the function that `Perlin` holds in Haskell.
#[must_use]
pub fn perlin(f: NoiseF, int_pt: Point3D, tables: &NoiseTables) -> Color {
    match f {
        NoiseF::PerlinSolid { base, grid_s } => perlin_solid(base, grid_s, int_pt, tables),
        NoiseF::PerlinSemiTurbulence { base, freq, grid_s } => {
            perlin_semi_turbulence(base, freq, grid_s, int_pt, tables)
        }
        NoiseF::PerlinTurbulence { base, freq, grid_s } => {
            perlin_turbulence(base, freq, grid_s, int_pt, tables)
        }
        NoiseF::PerlinFire { add_color, base, freq, grid_s } => {
            perlin_fire(add_color, base, freq, grid_s, int_pt, tables)
        }
        NoiseF::PerlinPlasma { grid_s } => perlin_plasma(grid_s, int_pt, tables),
        NoiseF::PerlinMarble { base, freq, grid_s, factors, pow } => {
            perlin_marble(base, freq, grid_s, factors, pow, int_pt, tables)
        }
        NoiseF::PerlinMarbleBase { base, add_color, freq, grid_s, factors, pow } => {
            perlin_marble_base(base, add_color, freq, grid_s, factors, pow, int_pt, tables)
        }
        NoiseF::PerlinWood { base, freq, grid_s, xy_fact, pow } => {
            perlin_wood(base, freq, grid_s, xy_fact, pow, int_pt, tables)
        }
    }
}

/// `floor x :: Int`, as GHC compiles it for a 64-bit machine: truncate, then subtract 1 if that was upwards.
///
/// The truncation is the machine's: NaN and whatever does not fit give the smallest `Int`, and subtracting
/// from that wraps. Modulo 256 a huge x therefore counts as 0, as does NaN, and an x below -2⁶³ as 255.
#[must_use]
pub fn floor_to_int(x: f64) -> i64 {
    let two_to_63 = 9_223_372_036_854_775_808.0;
    let n = if x >= -two_to_63 && x < two_to_63 { x as i64 } else { i64::MIN };
    if x < n as f64 { n.wrapping_sub(1) } else { n }
}

/// `fromIntegral (floor x)`, which goes through the unbounded `Integer`: the largest whole number not above x.
///
/// Adding 0 turns a negative zero into the zero that an `Integer` has.
fn whole(x: f64) -> f64 {
    x.floor() + 0.0
}

/// `mod n 256`, which is never negative.
fn mod_256(n: i64) -> usize {
    n.rem_euclid(256) as usize
}

/// Gradient noise: 0 in the corners of a grid of cubes with edge `grid_size`, smooth in between.
///
/// ```text
/// A.3      noise :: Double -> Point3D -> [Int] -> [Color] -> Double
/// ```
///
/// In each of the eight corners around the point there is a gradient, picked by the permutation. The result
/// is their scalar products with the offsets from the corners, interpolated by t²(3 - 2t) in x, then y, then
/// z. In a cell with fractions x, y, z it is at most 2 √(x²(1-x)² + y²(1-y)² + z²(1-z)²) times the longest
/// gradient, so at most √3/2 for gradients of length 1; §3.4 promises [-1, 1]. It repeats every 256 cells.
///
/// The cell is counted from x + 256 and the fraction from x. Where the sum rounds up to a whole number and x
/// does not (just below a whole number: -1e-15, but 1 - 1e-16 as well) the cell is the next one while the
/// fraction stays near 1, so there the noise jumps to its value one cell further.
///
/// §3.4 and the appendix differ in the type of the last list, vectors or colours, which is one type here.
#[must_use]
pub fn noise(grid_size: f64, (xt, yt, zt): Point3D, p_list: &[u8; 256], g_list: &[Vector; 256]) -> f64 {
    let (x, y, z) = (xt / grid_size, yt / grid_size, zt / grid_size);
    let s_curve = |t: f64| t * t * (3.0 - 2.0 * t);
    let lerp = |t: f64, a: f64, b: f64| a + t * (b - a);
    let (tx, ty, tz) = (x + 256.0, y + 256.0, z + 256.0);
    let bx0 = mod_256(floor_to_int(tx));
    let (bx1, rx0) = ((bx0 + 1) % 256, x - whole(x));
    let rx1 = rx0 - 1.0;
    let by0 = mod_256(floor_to_int(ty));
    let (by1, ry0) = ((by0 + 1) % 256, y - whole(y));
    let ry1 = ry0 - 1.0;
    let bz0 = mod_256(floor_to_int(tz));
    let (bz1, rz0) = ((bz0 + 1) % 256, z - whole(z));
    let rz1 = rz0 - 1.0;
    let p = |n: usize| usize::from(p_list[n % 256]);
    let g = |n: usize| g_list[n % 256];
    let (i, j) = (p(bx0), p(bx1));
    let (b00, b10, b01, b11) = (p(i + by0), p(j + by0), p(i + by1), p(j + by1));
    let (t, sy, sz) = (s_curve(rx0), s_curve(ry0), s_curve(rz0));
    let at3 = |(qx, qy, qz): Vector, (rx, ry, rz): Vector| rx * qx + ry * qy + rz * qz;
    let u1 = at3(g(b00 + bz0), (rx0, ry0, rz0));
    let v1 = at3(g(b10 + bz0), (rx1, ry0, rz0));
    let a1 = lerp(t, u1, v1);
    let u2 = at3(g(b01 + bz0), (rx0, ry1, rz0));
    let v2 = at3(g(b11 + bz0), (rx1, ry1, rz0));
    let b1 = lerp(t, u2, v2);
    let c = lerp(sy, a1, b1);
    let u3 = at3(g(b00 + bz1), (rx0, ry0, rz1));
    let v3 = at3(g(b10 + bz1), (rx1, ry0, rz1));
    let a2 = lerp(t, u3, v3);
    let u4 = at3(g(b01 + bz1), (rx0, ry1, rz1));
    let v4 = at3(g(b11 + bz1), (rx1, ry1, rz1));
    let b2 = lerp(t, u4, v4);
    let d = lerp(sy, a2, b2);
    lerp(sz, c, d)
}

/// `2^freq` as a `Double`: exact, and infinite from 2^1024 on.
fn two_to(freq: u64) -> f64 {
    let mut power = 1.0;
    for _ in 0..freq.min(1024) {
        power *= 2.0;
    }
    power
}

/// Noise summed over octaves, each of twice the frequency and half the strength of the one before.
///
/// ```text
/// A.3      semiTurbulence 0 gridS intPt    = noise gridS intPt getPList getGList
///          semiTurbulence freq gridS intPt = coef + (semiTurbulence (freq-1) gridS intPt)
///              where coef = (1/(2^freq))*(noise gridS (intPt *> (2^freq)) getPList getGList)
/// ```
///
/// The additions are the recursion's, from octave 0 upwards; written as a loop it needs no stack for a huge
/// `freq`.
#[must_use]
pub fn semi_turbulence(freq: u64, grid_s: f64, int_pt: Point3D, tables: &NoiseTables) -> f64 {
    let noise_at = |p: Point3D| noise(grid_s, p, &tables.p_list, &tables.g_list);
    let mut sum = noise_at(int_pt);
    for k in 1..=freq {
        let coef = (1.0 / two_to(k)) * noise_at(scale(int_pt, two_to(k)));
        sum += coef;
    }
    sum
}

/// The absolute value of noise summed over octaves, otherwise as [`semi_turbulence`].
///
/// ```text
/// A.3      turbulence 0 gridS intPt    = abs (noise gridS intPt getPList getGList)
///          turbulence freq gridS intPt = coef + (turbulence (freq-1) gridS intPt)
///              where coef = (1/(2^freq))*(abs (noise gridS (intPt *> (2^freq)) getPList getGList))
/// ```
#[must_use]
pub fn turbulence(freq: u64, grid_s: f64, int_pt: Point3D, tables: &NoiseTables) -> f64 {
    let noise_at = |p: Point3D| noise(grid_s, p, &tables.p_list, &tables.g_list);
    let mut sum = noise_at(int_pt).abs();
    for k in 1..=freq {
        let coef = (1.0 / two_to(k)) * noise_at(scale(int_pt, two_to(k))).abs();
        sum += coef;
    }
    sum
}

/// A stained colour (figure 3.1): `base` times the noise, brought from [-1, 1] to [0, 1].
///
/// ```text
/// A.3      perlinSolid base gridS intPt = base *> (((noise gridS intPt getPList getGList)+1)/2)
/// ```
#[must_use]
pub fn perlin_solid(base: Color, grid_s: f64, int_pt: Point3D, tables: &NoiseTables) -> Color {
    scale(base, (noise(grid_s, int_pt, &tables.p_list, &tables.g_list) + 1.0) / 2.0)
}

/// Clouds (figure 3.2): as [`perlin_solid`], of several octaves. The sum may leave [-1, 1].
///
/// ```text
/// A.3      perlinSemiTurbulence base freq gridS intPt = base *> (((semiTurbulence freq gridS intPt)+1)/2)
/// ```
#[must_use]
pub fn perlin_semi_turbulence(
    base: Color,
    freq: u64,
    grid_s: f64,
    int_pt: Point3D,
    tables: &NoiseTables,
) -> Color {
    scale(base, (semi_turbulence(freq, grid_s, int_pt, tables) + 1.0) / 2.0)
}

/// Sharp creases (figure 3.3): `base` times the turbulence.
///
/// ```text
/// A.3      perlinTurbulence base freq gridS intPt = base *> (turbulence freq gridS intPt)
/// ```
#[must_use]
pub fn perlin_turbulence(
    base: Color,
    freq: u64,
    grid_s: f64,
    int_pt: Point3D,
    tables: &NoiseTables,
) -> Color {
    scale(base, turbulence(freq, grid_s, int_pt, tables))
}

/// Fire (figure 3.3): a colour to which turbulence adds. The colour that is added comes **first**.
///
/// ```text
/// A.3      perlinFire addColor base freq gridS intPt
///            = clip (addColor <+> (perlinTurbulence base freq gridS intPt))
/// ```
#[must_use]
pub fn perlin_fire(
    add_color: Color,
    base: Color,
    freq: u64,
    grid_s: f64,
    int_pt: Point3D,
    tables: &NoiseTables,
) -> Color {
    clip(add(add_color, perlin_turbulence(base, freq, grid_s, int_pt, tables)))
}

/// Plasma (figure 3.5): a noise of its own for each of red, green and blue.
///
/// ```text
/// A.3      perlinPlasma gridS intPt = (noise1,noise2,noise3)
///            where noise1 = (((noise gridS intPt getPList  getGList) +1)/2)
///                  noise2 = (((noise gridS intPt getPList2 getGList) +1)/2)
///                  noise3 = (((noise gridS intPt getPList3 getGList) +1)/2)
/// ```
#[must_use]
pub fn perlin_plasma(grid_s: f64, int_pt: Point3D, tables: &NoiseTables) -> Color {
    let noise1 = (noise(grid_s, int_pt, &tables.p_list, &tables.g_list) + 1.0) / 2.0;
    let noise2 = (noise(grid_s, int_pt, &tables.p_list2, &tables.g_list) + 1.0) / 2.0;
    let noise3 = (noise(grid_s, int_pt, &tables.p_list3, &tables.g_list) + 1.0) / 2.0;
    (noise1, noise2, noise3)
}

/// Marble with black veins (figure 3.4): a wave across the direction of the factors, bent by `pow` times the
/// turbulence.
///
/// ```text
/// A.3      perlinMarble base freq gridS (xf,yf,zf) pow intPt@(x,y,z)
///            = base *> (((sin (x*xf+y*yf+z*zf + pow*turb))+1)/2)   where turb = turbulence freq gridS intPt
/// ```
#[must_use]
pub fn perlin_marble(
    base: Color,
    freq: u64,
    grid_s: f64,
    (xf, yf, zf): Vector,
    pow: f64,
    (x, y, z): Point3D,
    tables: &NoiseTables,
) -> Color {
    let turb = turbulence(freq, grid_s, (x, y, z), tables);
    scale(base, (libm::sin(x * xf + y * yf + z * zf + pow * turb) + 1.0) / 2.0)
}

/// Marble with coloured veins: a colour to which [`perlin_marble`] adds. The colour that is added comes
/// **second**, unlike in [`perlin_fire`].
///
/// ```text
/// A.3      perlinMarbleBase base addColor freq gridS (xf,yf,zf) pow intPt
///            = clip (addColor <+> (perlinMarble base freq gridS (xf,yf,zf) pow intPt))
/// ```
#[must_use]
#[expect(clippy::too_many_arguments, reason = "the thesis' seven and the tables")]
pub fn perlin_marble_base(
    base: Color,
    add_color: Color,
    freq: u64,
    grid_s: f64,
    factors: Vector,
    pow: f64,
    int_pt: Point3D,
    tables: &NoiseTables,
) -> Color {
    clip(add(add_color, perlin_marble(base, freq, grid_s, factors, pow, int_pt, tables)))
}

/// Wood (figure 3.6): rings around the origin, in all three coordinates whatever `xyFact` is called.
///
/// ```text
/// A.3      perlinWood base@(r,g,b) freq gridS xyFact pow intPt@(x,y,z)
///            | (sinVal < 0.5) = clip (r+sinVal,g+sinVal,b+sinVal)
///            | otherwise      = (r,g,b)
///            where sinVal = 0.25 * (abs (sin (xyFact*(sqrt ((x*x+y*y+z*z)) + pow*turb))))
///                  turb   = turbulence freq gridS intPt
/// ```
///
/// `sinVal` is at most 1/4, so the second case is that of NaN.
#[must_use]
pub fn perlin_wood(
    (r, g, b): Color,
    freq: u64,
    grid_s: f64,
    xy_fact: f64,
    pow: f64,
    (x, y, z): Point3D,
    tables: &NoiseTables,
) -> Color {
    let turb = turbulence(freq, grid_s, (x, y, z), tables);
    let sin_val = 0.25 * libm::sin(xy_fact * ((x * x + y * y + z * z).sqrt() + pow * turb)).abs();
    if sin_val < 0.5 { clip((r + sin_val, g + sin_val, b + sin_val)) } else { (r, g, b) }
}
