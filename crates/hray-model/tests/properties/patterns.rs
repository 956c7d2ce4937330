//! The eight patterns made of noise.

use crate::common::*;
use hray_model::*;
use proptest::prelude::*;

const P: Point3D = (1.3, -2.7, 5.9);

fn noise_with(p_list: &[u8; 256], p: Point3D) -> f64 {
    noise(2.0, p, p_list, &tables().g_list)
}

fn brought_to_0_1(v: f64) -> f64 {
    (v + 1.0) / 2.0
}

proptest! {
    /// Nothing is clipped: a base of any size is scaled.
    #[test]
    fn solid_and_the_turbulences_scale_their_base(base in triple(5.0), p in triple(100.0), freq in 0..8u64) {
        let t = tables();
        let solid = perlin(NoiseF::PerlinSolid { base, grid_s: 2.0 }, p, t);
        prop_assert_eq!(solid, scale(base, brought_to_0_1(noise_with(&t.p_list, p))));
        let semi = perlin(NoiseF::PerlinSemiTurbulence { base, freq, grid_s: 2.0 }, p, t);
        prop_assert_eq!(semi, scale(base, brought_to_0_1(semi_turbulence(freq, 2.0, p, t))));
        let turb = perlin(NoiseF::PerlinTurbulence { base, freq, grid_s: 2.0 }, p, t);
        prop_assert_eq!(turb, scale(base, turbulence(freq, 2.0, p, t)));
    }

    #[test]
    fn each_component_of_plasma_has_a_permutation_of_its_own(p in triple(100.0)) {
        let t = tables();
        let (r, g, b) = perlin(NoiseF::PerlinPlasma { grid_s: 2.0 }, p, t);
        prop_assert_eq!(r, brought_to_0_1(noise_with(&t.p_list, p)));
        prop_assert_eq!(g, brought_to_0_1(noise_with(&t.p_list2, p)));
        prop_assert_eq!(b, brought_to_0_1(noise_with(&t.p_list3, p)));
    }

    #[test]
    fn fire_and_marble_add_the_added_colour_and_clip(
        base in triple(2.0), add_color in triple(2.0), p in triple(100.0), freq in 0..8u64,
    ) {
        let t = tables();
        let fire = perlin(NoiseF::PerlinFire { add_color, base, freq, grid_s: 2.0 }, p, t);
        prop_assert_eq!(fire, clip(add(add_color, scale(base, turbulence(freq, 2.0, p, t)))));
        let (factors, pow) = ((0.4, 0.1, -0.2), 3.0);
        let plain = perlin(NoiseF::PerlinMarble { base, freq, grid_s: 2.0, factors, pow }, p, t);
        let marble = perlin(NoiseF::PerlinMarbleBase { base, add_color, freq, grid_s: 2.0, factors, pow }, p, t);
        prop_assert_eq!(marble, clip(add(add_color, plain)));
    }

    /// Without turbulence marble is a plane wave: (sin (p • factors) + 1) / 2.
    #[test]
    fn unbent_marble_is_a_wave_along_its_factors(p in triple(30.0), factors in triple(1.0), side in unit()) {
        let marble = |p: Point3D| {
            perlin(NoiseF::PerlinMarble { base: grey(1.0), freq: 3, grid_s: 2.0, factors, pow: 0.0 }, p, tables())
        };
        let (v, _, _) = marble(p);
        prop_assert!((v - brought_to_0_1(libm::sin(dot(p, factors)))).abs() < 1e-14);
        let across = cross(side, factors);
        let (w, _, _) = marble(add(p, across));
        prop_assert!((v - w).abs() < 1e-13);
    }

    /// Turbulence moves the phase of the wave by `pow` times its value.
    #[test]
    fn marble_is_bent_by_turbulence(p in triple(30.0), pow in -10.0..10.0) {
        let (base, freq, grid_s, factors) = (grey(1.0), 3, 2.0, (0.3, 0.2, 0.1));
        let (v, _, _) = perlin(NoiseF::PerlinMarble { base, freq, grid_s, factors, pow }, p, tables());
        let phase = dot(p, factors) + pow * turbulence(3, 2.0, p, tables());
        prop_assert!((v - brought_to_0_1(libm::sin(phase))).abs() < 1e-14);
    }

    /// Without turbulence wood is the same at the same distance from the origin, in every direction.
    #[test]
    fn unbent_wood_has_rings_around_the_origin(a in unit(), b in unit(), radius in 0.0..50.0, base in color()) {
        let wood = |p: Point3D| {
            perlin(NoiseF::PerlinWood { base, freq: 3, grid_s: 2.0, xy_fact: 0.8, pow: 0.0 }, p, tables())
        };
        prop_assert!(dist(wood(scale(a, radius)), wood(scale(b, radius))) < 1e-12);
        let lighter = 0.25 * libm::sin(0.8 * radius).abs();
        prop_assert!(dist(wood(scale(a, radius)), clip(add(base, grey(lighter)))) < 1e-12);
    }

    /// `pow` times the turbulence is added to the distance before the rings are spaced.
    #[test]
    fn wood_is_bent_by_turbulence(p in triple(30.0), pow in 0.0..5.0, xy_fact in 0.1..2.0) {
        let base = grey(0.0);
        let (v, _, _) = perlin(NoiseF::PerlinWood { base, freq: 3, grid_s: 2.0, xy_fact, pow }, p, tables());
        let distance = len(p) + pow * turbulence(3, 2.0, p, tables());
        prop_assert!((v - 0.25 * libm::sin(xy_fact * distance).abs()).abs() < 1e-14);
    }
}

/// The order of the two colours is not the same: fire and marble would swap them.
#[test]
fn the_added_colour_is_first_in_fire_and_second_in_marble() {
    let (red, green) = ((0.5, 0.0, 0.0), (0.0, 0.5, 0.0));
    let (r, g, _) = perlin_fire(red, green, 0, 2.0, P, tables());
    assert!(r == 0.5 && g < 0.5);
    let (r, g, _) = perlin_marble_base(red, green, 0, 2.0, (0.1, 0.2, 0.3), 1.0, P, tables());
    assert!(r < 0.5 && g == 0.5);
}

#[test]
fn undefined_wood_is_its_base_unclipped() {
    let base = (2.0, -1.0, 0.5);
    assert_eq!(perlin_wood(base, 0, 2.0, f64::NAN, 1.0, P, tables()), base);
    assert_eq!(perlin_wood(base, 0, 2.0, 1.0, 1.0, P, tables()).0, 1.0);
}
