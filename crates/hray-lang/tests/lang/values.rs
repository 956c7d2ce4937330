//! What an accepted scene means.

use crate::common::{SCENE, broken};
use hray_core::{
    Background, Camera, DVec3, Field, Light, NoiseTexture, Plane, Rgb, Shape, Sphere, Texture, WindowCamera,
};
use hray_lang::classic::{Spans, parse};

#[test]
fn every_number_goes_where_it_belongs() {
    let description = parse(SCENE).description.unwrap();
    assert_eq!((description.resolution.width(), description.resolution.height()), (400, 300));
    assert_eq!(description.max_depth, 3);
    let scene = description.scene;
    let camera = WindowCamera { eye: DVec3::new(0.0, 0.0, 150.0), window: [100.0, 75.0] };
    assert_eq!(scene.camera, Camera::Window(camera));
    assert_eq!(scene.background, Background::Uniform(Rgb::new(0.8, 0.8, 0.8)));

    let [ball, floor] = &scene.primitives[..] else { panic!() };
    let sphere = Sphere { radius: 40.0, center: DVec3::new(0.0, 0.0, -150.0) };
    assert_eq!(ball.shape, Shape::Sphere(sphere));
    assert_eq!(ball.material.texture, Texture::Solid(Rgb::new(0.8, 0.2, 0.2)));
    assert_eq!([&ball.material.reflection, &ball.material.shine], [&Field::Constant(0.3), &60.0.into()]);
    assert!(ball.material.transmission.is_zero() && ball.material.refractive_index.is_zero());
    assert_eq!(floor.shape, Shape::Plane(Plane { normal: DVec3::Y, offset: 50.0 }));

    let point = Light::Point { position: DVec3::new(90.0, 80.0, 70.0), intensity: Rgb::new(0.7, 0.7, 0.7) };
    assert_eq!(scene.lights, [point, Light::Ambient { intensity: Rgb::new(0.1, 0.1, 0.1) }]);
}

#[test]
fn the_eight_noises_take_their_arguments_in_the_order_of_the_grammar() {
    let [a, b] = [Rgb::new(0.1, 0.2, 0.3), Rgb::new(0.4, 0.5, 0.6)];
    let (grid, direction, power) = (8.0, DVec3::new(1.0, 2.0, 3.0), 9.0);
    for (text, noise) in [
        ("perlinSolid (0.1,0.2,0.3) 8.0", NoiseTexture::Solid { base: a, grid }),
        ("perlinSemiTurb (0.1,0.2,0.3) 7 8.0", NoiseTexture::SemiTurbulence { base: a, octaves: 7, grid }),
        ("perlinTurb (0.1,0.2,0.3) 7 8.0", NoiseTexture::Turbulence { base: a, octaves: 7, grid }),
        // The added colour first ...
        (
            "perlinFire (0.1,0.2,0.3) (0.4,0.5,0.6) 7 8.0",
            NoiseTexture::Fire { added: a, base: b, octaves: 7, grid },
        ),
        ("perlinPlasma 8.0", NoiseTexture::Plasma { grid }),
        (
            "perlinMarble (0.1,0.2,0.3) 7 8.0 (1.0,2.0,3.0) 9.0",
            NoiseTexture::Marble { base: a, octaves: 7, grid, direction, power },
        ),
        // ... and here second.
        (
            "perlinMarbleBase (0.1,0.2,0.3) (0.4,0.5,0.6) 7 8.0 (1.0,2.0,3.0) 9.0",
            NoiseTexture::MarbleBase { base: a, added: b, octaves: 7, grid, direction, power },
        ),
        (
            "perlinWood (0.1,0.2,0.3) 7 8.0 5.0 9.0",
            NoiseTexture::Wood { base: a, octaves: 7, grid, rings: 5.0, power },
        ),
    ] {
        let source = broken("solid (0.8,0.2,0.2)", &format!("perlin ( {text} )"));
        let scene = parse(&source).description.unwrap().scene;
        assert_eq!(scene.primitives[0].material.texture, Texture::Noise(noise), "{text}");
    }
}

#[test]
fn tokens_need_no_white_space_between_them() {
    let dense = "renderDescr(resolution(4,3))-1[scene{camera(0.0,0.0,9.0)(4,3)}{background(0.0,-0.0,1.0)}\
        {objects(object(sphere3.0(0.0,0.0,-9.0))(texture(diffsolid(0.0,0.0,0.0))0.0-1 0.0-1.0))}{lights}]";
    assert!(parse(dense).description.is_none(), "`diffsolid` is one word");
    let dense = dense.replace("diffsolid", "diff\u{a0}solid");
    let description = parse(&dense).description.unwrap();
    assert_eq!(description.max_depth, -1);
    let Background::Uniform(background) = description.scene.background else { panic!() };
    assert!(background.g.is_sign_negative());
    assert_eq!(description.scene.primitives[0].material.shine, Field::Constant(-1.0));
}

#[test]
fn a_byte_order_mark_is_skipped_and_spans_count_it() {
    let source = format!("\u{feff}{SCENE}");
    let parsed = parse(&source);
    assert_eq!(parsed.description, parse(SCENE).description);
    assert_eq!(parsed.spans.resolution.text(&source), "400,300");
}

#[test]
fn spans_name_the_parts_of_a_scene() {
    let spans = parse(SCENE).spans;
    assert_eq!(spans.depth.text(SCENE), "3");
    assert_eq!(spans.background.text(SCENE), "{ background (0.8,0.8,0.8) }");
    assert_eq!(spans.lights.text(SCENE), "{ lights");
    assert_eq!(Spans::shape(SCENE, spans.primitives[0]).text(SCENE), "sphere 40.0 (0.0,0.0,-150.0)");
    assert_eq!(Spans::shape(SCENE, spans.primitives[1]).text(SCENE), "plane (0.0,1.0,0.0,50.0)");
    assert_eq!(Spans::numbers(SCENE, spans.primitives[1], 10, 2).text(SCENE), "10 64.0");
    assert_eq!(Spans::numbers(SCENE, spans.light_list[1], 0, 3).text(SCENE), "0.1,0.1,0.1");
    assert_eq!(Spans::numbers(SCENE, spans.camera, 3, 2).text(SCENE), "100,75");
}

#[test]
fn the_largest_numbers_are_accepted() {
    for (from, to) in [
        ("(400,300)", "(32768,32768)"),
        (") 3 [", ") 10000 ["),
        (") 3 [", ") -1 ["),
        ("10 64.0", "4294967295 64.0"),
        ("0.3 60", "0.3 9223372036854775807"),
        ("(100,75)", "(-9223372036854775808,-0)"),
    ] {
        assert!(parse(&broken(from, to)).description.is_some(), "{to}");
    }
    assert!(parse(&broken("(400,300)", "(32768,32769)")).description.is_none());
}
