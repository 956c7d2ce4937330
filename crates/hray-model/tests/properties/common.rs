//! What several modules need: noise tables, simple materials, and how random values are drawn.

use hray_model::*;
use proptest::prelude::*;
use std::sync::LazyLock;

/// Noise tables of these tests: permutations shuffled and gradients drawn from a fixed stream of numbers. The
/// gradients have length 1.
pub(crate) fn tables() -> &'static NoiseTables {
    static TABLES: LazyLock<NoiseTables> = LazyLock::new(|| {
        let mut stream = Stream(2005);
        NoiseTables {
            p_list: stream.permutation(),
            p_list2: stream.permutation(),
            p_list3: stream.permutation(),
            g_list: std::array::from_fn(|_| norm((stream.signed() + 1e-3, stream.signed(), stream.signed()))),
        }
    });
    &TABLES
}

/// Knuth's linear congruential generator for MMIX.
struct Stream(u64);

impl Stream {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        self.0 >> 33
    }

    /// A number in [-1, 1].
    fn signed(&mut self) -> f64 {
        self.next() as f64 / f64::from(1u32 << 30) - 1.0
    }

    fn permutation(&mut self) -> [u8; 256] {
        let mut list: [u8; 256] = std::array::from_fn(|i| i as u8);
        for i in (1..256).rev() {
            let j = self.next() as usize % (i + 1);
            list.swap(i, j);
        }
        list
    }
}

/// A material of one colour that neither reflects nor lets light through.
pub(crate) fn plain(color: Color) -> Texture {
    Texture { diff: Diff::Solid(color), refl_coef: 0.0, spec_coef: 0, refr_coef: 0.0, refr_index: 0.0 }
}

/// A black mirror with a given coefficient.
pub(crate) fn mirror(refl_coef: f64) -> Texture {
    Texture { refl_coef, ..plain((0.0, 0.0, 0.0)) }
}

/// A black material that lets light through.
pub(crate) fn clear(refr_coef: f64, refr_index: f64) -> Texture {
    Texture { refr_coef, refr_index, ..plain((0.0, 0.0, 0.0)) }
}

pub(crate) fn sphere(cen: Point3D, rad: f64) -> Object {
    Object::Sphere(mk_sphere(cen, rad))
}

pub(crate) fn plane(a: f64, b: f64, c: f64, d: f64) -> Object {
    Object::Plane(mk_plane((a, b, c, d)))
}

pub(crate) fn ambient(int: Intensity) -> Light {
    Light::AmbientLight(AmbientLight { int })
}

pub(crate) fn point_light(pos: Point3D, int: Intensity) -> Light {
    Light::PointLight(PointLight { pos, int })
}

pub(crate) fn grey(v: f64) -> Color {
    (v, v, v)
}

/// The vector product, which the model never needs.
pub(crate) fn cross((a, b, c): Vector, (x, y, z): Vector) -> Vector {
    (b * z - c * y, c * x - a * z, a * y - b * x)
}

/// A triple of numbers below `size` in absolute value.
pub(crate) fn triple(size: f64) -> impl Strategy<Value = (f64, f64, f64)> {
    (-size..size, -size..size, -size..size)
}

/// A direction of length 1.
pub(crate) fn unit() -> impl Strategy<Value = Vector> {
    triple(1.0).prop_filter("too short for a direction", |v| len(*v) > 0.1).prop_map(norm)
}

/// A colour in [0, 1]³.
pub(crate) fn color() -> impl Strategy<Value = Color> {
    (0.0..=1.0, 0.0..=1.0, 0.0..=1.0)
}

/// A sphere or a plane.
pub(crate) fn object() -> impl Strategy<Value = Object> {
    prop_oneof![
        (triple(50.0), -30.0..30.0).prop_map(|(cen, rad)| sphere(cen, rad)),
        (triple(1.0), -50.0..50.0).prop_map(|((a, b, c), d)| plane(a, b, c, d)),
    ]
}

/// A ray with a direction of length 1.
pub(crate) fn ray() -> impl Strategy<Value = Ray> {
    (triple(50.0), unit()).prop_map(|(start, dir)| mk_ray_dir(start, dir))
}
