//! What lights do to a surface.
//!
//! Most tests look straight down from the origin onto a plane at z = -10.

use crate::common::*;
use hray_model::*;
use proptest::prelude::*;

const DOWN: Vector = (0.0, 0.0, -1.0);

/// The plane z = -10 with its normal towards the viewer.
fn floor(t: Texture) -> TexturedObject {
    (plane(0.0, 0.0, 1.0, 10.0), t)
}

/// The same plane with its normal away from the viewer.
fn floor_upside_down(t: Texture) -> TexturedObject {
    (plane(0.0, 0.0, -1.0, -10.0), t)
}

/// Where the ray straight down hits.
fn hit(o: TexturedObject) -> Intersection {
    intersect(mk_ray_dir((0.0, 0.0, 0.0), DOWN), &[o]).unwrap()
}

/// What the ray straight down sees, with no reflection.
fn seen(objects: &[TexturedObject], lights: &[Light]) -> Color {
    let ray = mk_ray_dir((0.0, 0.0, 0.0), DOWN);
    color_pt(Depth::new(0).unwrap(), ray, grey(0.5), objects, lights, tables())
}

proptest! {
    /// Neither is it clipped, one light by one.
    #[test]
    fn an_ambient_light_adds_its_intensity_unmultiplied(int in triple(5.0), c in color(), d in unit()) {
        let o = floor(plain(c));
        prop_assert_eq!(shade_pt(hit(o), d, &[o], ambient(int), tables()), int);
        prop_assert_eq!(diff(Some(hit(o)), ambient(int), tables()), (0.0, 0.0, 0.0));
        prop_assert_eq!(spec(Some(hit(o)), d, ambient(int)), (0.0, 0.0, 0.0));
    }

    /// Lambert's cosine law, with its sign.
    #[test]
    fn a_diffuse_colour_goes_with_the_cosine(pos in triple(50.0), int in color(), c in color()) {
        prop_assume!(dist(pos, (0.0, 0.0, -10.0)) > 1.0);
        let light = point_light(pos, int);
        let cosine = (pos.2 + 10.0) / dist(pos, (0.0, 0.0, -10.0));
        let expected = mul(scale(int, cosine), c);
        prop_assert!(dist(diff(Some(hit(floor(plain(c)))), light, tables()), expected) < 1e-14);
        let behind = diff(Some(hit(floor_upside_down(plain(c)))), light, tables());
        prop_assert!(dist(behind, scale(expected, -1.0)) < 1e-14);
    }

    /// The same for the highlight, which is also proportional to the coefficient of reflection.
    #[test]
    fn a_highlight_goes_with_the_power_of_the_half_way_cosine(
        pos in (-50.0..50.0, -50.0..50.0, -9.0..50.0), refl in 0.0..1.0, exponent in 0..40i64,
    ) {
        let t = Texture { spec_coef: exponent, ..mirror(refl) };
        let half = norm(add((0.0, 0.0, 1.0), mk_norm_vect((0.0, 0.0, -10.0), pos)));
        let mut power = 1.0;
        for _ in 0..exponent {
            power *= half.2;
        }
        let (r, _, _) = spec(Some(hit(floor(t))), DOWN, point_light(pos, grey(1.0)));
        prop_assert!((r - refl * power).abs() < 1e-12);
    }

    #[test]
    fn a_point_light_contributes_diffuse_colour_and_highlight(
        pos in (-50.0..50.0, -50.0..50.0, -9.0..50.0), int in color(), c in color(), refl_coef in 0.1..1.0,
    ) {
        let o = floor(Texture { refl_coef, spec_coef: 2, ..plain(c) });
        let light = point_light(pos, int);
        let (diff, spec) = (diff(Some(hit(o)), light, tables()), spec(Some(hit(o)), DOWN, light));
        prop_assert!(spec != grey(0.0) || int == grey(0.0));
        prop_assert_eq!(shade_pt(hit(o), DOWN, &[o], light, tables()), add(diff, spec));
    }

    /// `**` is the power of two doubles: -1 to the n is 1 for even n and -1 for odd n, whatever its sign.
    #[test]
    fn a_highlight_of_a_negative_cosine_has_the_sign_of_its_parity(exponent in -1000..1000i64) {
        let t = Texture { spec_coef: exponent, ..mirror(0.5) };
        let light = point_light((0.0, 0.0, 0.0), grey(1.0));
        let expected = if exponent % 2 == 0 { 0.5 } else { -0.5 };
        prop_assert_eq!(spec(Some(hit(floor_upside_down(t))), DOWN, light), grey(expected));
    }

    /// The light is 15 above the floor and the blocker somewhere on the way or beyond.
    #[test]
    fn whatever_is_not_farther_than_the_light_blocks_it(height in 1.0..30.0, coef in 0.0..1.0) {
        let o = [floor(plain(grey(1.0))), (plane(0.0, 0.0, -1.0, height - 10.0), clear(coef, 1.3))];
        let light = point_light((0.0, 0.0, 5.0), grey(0.75));
        let i = hit(o[0]);
        let lit = shade_pt(i, DOWN, &o, light, tables());
        prop_assert_eq!(lit, if height <= 15.0 { grey(0.0) } else { grey(0.75) });
    }
}

#[test]
fn a_hit_exactly_at_the_light_blocks_it_even_if_transparent() {
    let at_the_light = (plane(0.0, 0.0, -1.0, 5.0), clear(1.0, 1.0));
    let o = [floor(plain(grey(1.0))), at_the_light];
    let light = point_light((0.0, 0.0, 5.0), grey(0.75));
    assert_eq!(shade_pt(hit(o[0]), DOWN, &o, light, tables()), grey(0.0));
    assert_eq!(shade_pt(hit(o[0]), DOWN, &o[..1], light, tables()), grey(0.75));
}

#[test]
fn zero_to_the_zero_is_1_in_a_highlight() {
    // The light is straight behind the surface: there is no half-way vector.
    let light = point_light((0.0, 0.0, -20.0), grey(1.0));
    assert_eq!(spec(Some(hit(floor(mirror(0.5)))), DOWN, light), grey(0.5));
    let t = Texture { spec_coef: 1, ..mirror(0.5) };
    assert_eq!(spec(Some(hit(floor(t))), DOWN, light), grey(0.0));
}

/// Chapter 2 clips the contribution of each light and would see 0.75 here.
#[test]
fn one_light_can_darken_what_another_lit() {
    let o = [floor_upside_down(plain(grey(1.0)))];
    let lights = [ambient(grey(0.75)), point_light((0.0, 0.0, 0.0), grey(0.5))];
    assert_eq!(seen(&o, &lights), grey(0.25));
    // And a sum of light beyond 1 is clipped only as a whole.
    let lights = [ambient(grey(1.25)), point_light((0.0, 0.0, 0.0), grey(0.5))];
    assert_eq!(seen(&o, &lights), grey(0.75));
}

#[test]
fn the_light_written_last_is_added_first() {
    let o = [floor(plain(grey(1.0)))];
    let [a, b, c] = [0.1, 0.2, 0.3].map(|v| ambient(grey(v)));
    assert_ne!((0.1 + 0.2) + 0.3, (0.3 + 0.2) + 0.1);
    assert_eq!(seen(&o, &[a, b, c]), grey((0.3 + 0.2) + 0.1));
    assert_eq!(seen(&o, &[c, b, a]), grey((0.1 + 0.2) + 0.3));
}
