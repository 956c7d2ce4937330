//! Constructive solid geometry.

use crate::common::{
    NORMAL, Numbers, WORLD, colors, cuboid, description, frustum, matte, middle, of, placed, plane, showing,
    shown, sphere, v,
};
use crate::shapes::{compare, random_leaf};
use hray_core::{
    Clip, Csg, CsgOperation, DAffine3, DVec3, Disc, Frustum, Integrator, Light, Mesh, NoiseTables, Primitive,
    Rgb, Shape, Texture,
};
use hray_expr::Input;
use hray_render::{Control, RenderError, Settings, render};
use std::sync::Arc;

fn csg(operation: CsgOperation, a: Primitive, b: Primitive) -> Primitive {
    of(Shape::Csg(Arc::new(Csg { operation, operands: [a, b] })), &matte(0.0))
}

fn inverse(solid: Primitive) -> Primitive {
    of(Shape::Inverse(Arc::new(solid)), &matte(0.0))
}

fn clip(within: Primitive, shape: Primitive) -> Primitive {
    of(Shape::Clip(Arc::new(Clip { shape, within })), &matte(0.0))
}

fn random_solid(n: &mut Numbers, depth: usize, show: [Input; 3]) -> Primitive {
    if depth == 0 || n.below(4) == 0 {
        return random_leaf(n, show, true);
    }
    if n.below(5) == 0 {
        return inverse(random_solid(n, depth - 1, show));
    }
    let operation = [CsgOperation::Union, CsgOperation::Intersection, CsgOperation::Difference][n.below(3)];
    let a = random_solid(n, depth - 1, show);
    let b = random_solid(n, depth - 1, show);
    let solid = csg(operation, a, b);
    if n.below(3) == 0 { placed(solid, DAffine3::from_rotation_y(n.between(0.0, 6.0))) } else { solid }
}

#[test]
fn random_solids_are_the_references() {
    let scene = |seed, show| {
        let n = &mut Numbers(seed * 77);
        (0..1 + n.below(3)).map(|_| random_solid(n, 4, show)).collect()
    };
    compare(scene, &[Integrator::Classic, Integrator::Classic2005], 1e-9);
}

/// Shapes and solids, open ones among them, clipped once or twice.
#[test]
fn random_clipped_shapes_are_the_references() {
    let clipped = |n: &mut Numbers, show| {
        let mut shape = match n.below(4) {
            0 => random_solid(n, 2, show),
            1 => of(random_open(n), &showing(show)),
            _ => random_leaf(n, show, true),
        };
        for _ in 0..1 + n.below(2) {
            shape = clip(random_solid(n, 1, show), shape);
            if n.below(3) == 0 {
                shape = placed(shape, DAffine3::from_rotation_x(n.between(0.0, 6.0)));
            }
        }
        shape
    };
    let scene = |seed, show| {
        let n = &mut Numbers(seed * 79);
        (0..6 + n.below(3)).map(|_| clipped(n, show)).collect()
    };
    compare(scene, &[Integrator::Classic, Integrator::Classic2005], 1e-9);
}

fn random_open(n: &mut Numbers) -> Shape {
    match n.below(3) {
        0 => Shape::Disc(Arc::new(Disc {
            center: n.point(0.8),
            normal: n.point(1.0).normalize(),
            radius: n.between(0.6, 1.6),
            hole: n.between(0.0, 0.4),
        })),
        1 => {
            let (base, radii) = (n.point(0.8), [n.between(0.3, 1.0), n.between(0.3, 1.0)]);
            Shape::Frustum(Arc::new(Frustum { base, top: base + n.point(1.2), radii, is_capped: false }))
        }
        _ => {
            let single = |p: DVec3| p.to_array().map(|x| x as f32);
            let corners = (0..9).map(|_| single(n.point(1.5))).collect();
            Shape::Mesh(Arc::new(Mesh::new(corners, vec![[0, 1, 2], [3, 4, 5], [6, 7, 8]]).unwrap()))
        }
    }
}

/// What is not inside a ball has the ball's surface, and its outside is where the ball's inside was.
#[test]
fn an_inverse_by_itself() {
    let show = |inputs| {
        let ball = of(sphere(DVec3::ZERO, 1.0), &showing(inputs));
        let one = inverse(ball.clone());
        [one.clone(), inverse(one)].map(|solid| shown(middle(vec![solid], Vec::new())).unwrap())
    };
    assert_eq!(show(WORLD).map(|p| p.distance(DVec3::Z) < 1e-14), [true; 2]);
    let [once, twice] = show(NORMAL);
    assert!(once.distance(DVec3::NEG_Z) < 1e-14 && twice.distance(DVec3::Z) < 1e-14);
}

/// De Morgan: the same solids in other words, to the bit.
#[test]
fn what_is_cut_away_is_what_is_not_inside() {
    for seed in 0..40 {
        let picture = |make: &dyn Fn(Primitive, Primitive) -> Primitive| {
            let n = &mut Numbers(seed * 83);
            let [a, b] = [random_solid(n, 2, WORLD), random_solid(n, 2, WORLD)];
            colors(&description(16, vec![make(a, b)], Vec::new()))
        };
        let difference = picture(&|a, b| csg(CsgOperation::Difference, a, b));
        let intersection = picture(&|a, b| csg(CsgOperation::Intersection, a, inverse(b)));
        let union = picture(&|a, b| inverse(csg(CsgOperation::Union, inverse(a), b)));
        assert!(difference == intersection && intersection == union, "{seed}");
    }
}

/// One looks into a ball that is cut open, at its far side from within, and through a hole that is cut into both sides.
#[test]
fn nothing_closes_a_cut() {
    let show = |inputs| {
        let ball = of(sphere(DVec3::ZERO, 1.0), &showing(inputs));
        let cut = clip(of(plane(DVec3::Z, -0.5), &matte(0.0)), ball);
        shown(middle(vec![cut], Vec::new())).unwrap()
    };
    assert!(show(WORLD).distance(DVec3::NEG_Z) < 1e-14);
    assert!(show(NORMAL).distance(DVec3::NEG_Z) < 1e-14, "not turned: it leads out of the ball");
    let hole = of(frustum(v(0.0, 0.0, -2.0), v(0.0, 0.0, 2.0), [0.3; 2]), &matte(0.0));
    let ball = of(sphere(DVec3::ZERO, 1.0), &showing(WORLD));
    assert_eq!(shown(middle(vec![clip(inverse(hole), ball)], Vec::new())), None);
}

/// With the tree over many objects: what is clipped has a box, whatever it was.
#[test]
fn many_clipped_shapes_are_the_references() {
    let scene = |seed, show| {
        let n = &mut Numbers(seed * 89);
        let clipped = |n: &mut Numbers| {
            let shape = random_leaf(n, show, true);
            let within = of(sphere(n.point(1.0), n.between(0.5, 1.2)), &matte(0.0));
            let shape = clip(within, shape);
            if n.below(2) == 0 { shape } else { placed(shape, DAffine3::from_translation(n.point(0.5))) }
        };
        (0..20).map(|_| clipped(n)).collect()
    };
    compare(scene, &[Integrator::Classic], 1e-9);
}

/// Two spheres of radius 2 around (0, 0, ±1): the lens between them ends at z = 1 and -1.
#[test]
fn a_lens() {
    let show = |inputs| {
        let ball = |z| of(sphere(v(0.0, 0.0, z), 2.0), &showing(inputs));
        shown(middle(vec![csg(CsgOperation::Intersection, ball(1.0), ball(-1.0))], Vec::new())).unwrap()
    };
    assert!(show(WORLD).distance(DVec3::Z) < 1e-14);
    assert!(show(NORMAL).distance(DVec3::Z) < 1e-14);
}

/// A ball of radius 2 with one of radius 1.5 cut away and half of space, so that one looks into the shell: what is
/// seen is the inside of the hollow, at z = -1.5, turned to the viewer.
#[test]
fn a_shell_that_is_cut_open() {
    let show = |inputs| {
        let ball = |radius| of(sphere(DVec3::ZERO, radius), &showing(inputs));
        let front = of(plane(DVec3::NEG_Z, 0.5), &showing(inputs));
        let shell = csg(CsgOperation::Difference, ball(2.0), ball(1.5));
        shown(middle(vec![csg(CsgOperation::Difference, shell, front)], Vec::new())).unwrap()
    };
    assert!(show(WORLD).distance(v(0.0, 0.0, -1.5)) < 1e-14);
    assert!(show(NORMAL).distance(DVec3::Z) < 1e-14);
}

/// The inside of a plane is the half space its normal leads away from: below, for a normal that points up.
#[test]
fn the_inside_of_a_plane_is_below_its_normal() {
    let half = |normal| {
        let ball = of(sphere(DVec3::ZERO, 1.0), &showing(WORLD));
        shown(middle(
            vec![csg(CsgOperation::Intersection, ball, of(plane(normal, 0.0), &showing(WORLD)))],
            Vec::new(),
        ))
    };
    assert!(half(DVec3::Z).unwrap().distance(DVec3::ZERO) < 1e-14, "the far half");
    assert!(half(DVec3::NEG_Z).unwrap().distance(DVec3::Z) < 1e-14, "the near half");
}

/// Seen from inside, a solid ends where one leaves it.
#[test]
fn a_ray_may_start_inside() {
    let far = of(cuboid(v(-9.0, -9.0, -3.0), v(9.0, 9.0, 9.0)), &showing(WORLD));
    let room = csg(CsgOperation::Union, far.clone(), of(sphere(DVec3::ZERO, 1.0), &showing(WORLD)));
    assert!(shown(middle(vec![room], Vec::new())).unwrap().distance(v(0.0, 0.0, -3.0)) < 1e-13);
    let hollow = csg(CsgOperation::Difference, far, of(sphere(DVec3::ZERO, 1.0), &showing(WORLD)));
    assert!(shown(middle(vec![hollow], Vec::new())).unwrap().distance(DVec3::Z) < 1e-13);
}

/// Where surfaces coincide the operand that is written last is seen, and what is cut away flush leaves no skin.
#[test]
fn surfaces_in_the_same_place() {
    let cube = |show| of(cuboid(DVec3::NEG_ONE, DVec3::ONE), &showing(show));
    let solid = |operation, a, b| shown(middle(vec![csg(operation, cube(a), cube(b))], Vec::new()));
    for operation in [CsgOperation::Union, CsgOperation::Intersection] {
        assert!(solid(operation, WORLD, NORMAL).unwrap().distance(DVec3::Z) < 1e-14);
        assert!(solid(operation, NORMAL, WORLD).unwrap().distance(DVec3::Z) < 1e-14);
    }
    assert_eq!(solid(CsgOperation::Difference, WORLD, NORMAL), None);
    // Flush with the front of a deeper box.
    let deep = of(cuboid(v(-1.0, -1.0, -2.0), DVec3::ONE), &showing(WORLD));
    let rest = csg(CsgOperation::Difference, deep, cube(WORLD));
    assert!(shown(middle(vec![rest], Vec::new())).unwrap().distance(DVec3::NEG_Z) < 1e-14);
}

/// A solid that is used twice at each of 60 levels has 2^60 leaves.
#[test]
fn too_many_parts_are_an_error() {
    let mut solid = of(sphere(DVec3::ZERO, 1.0), &matte(1.0));
    for _ in 0..60 {
        solid = csg(CsgOperation::Union, solid.clone(), solid);
    }
    let description = description(1, vec![solid], Vec::new());
    let settings = Settings::of(&description);
    let result = render(
        &description,
        &NoiseTables::default(),
        &settings,
        &Control::new(),
        |_| (),
        |()| Ok::<(), ()>(()),
    );
    assert_eq!(result, Err(RenderError::Solids));
}

/// As deep as the language allows, and every part counts: two hundred overlapping slices of a ball.
#[test]
fn deep_nesting() {
    let mut solid = of(sphere(DVec3::ZERO, 1.5), &showing(WORLD));
    for i in 0..199 {
        let z = 1.5 - 0.005 * f64::from(i);
        let slice = of(cuboid(v(-2.0, -2.0, z - 0.006), v(2.0, 2.0, z)), &showing(WORLD));
        solid = csg(CsgOperation::Difference, solid, slice);
    }
    let end = shown(middle(vec![solid], Vec::new())).unwrap();
    assert!((end.z - (1.5 - 0.005 * 198.0 - 0.006)).abs() < 1e-12, "{end}");
}

/// Light that enters the cut reaches the inside; what is left keeps its shadow.
#[test]
fn shadows_of_solids() {
    let white = Arc::new(hray_core::Material::matte(Texture::Solid(Rgb::new(1.0, 1.0, 1.0))));
    let light = Light::Directional { direction: DVec3::NEG_Y, intensity: Rgb::new(1.0, 1.0, 1.0) };
    // A floor below a box, with and without a shaft through that.
    let floor = of(plane(DVec3::Y, 1.0), &white);
    let lid = of(cuboid(v(-2.0, 0.5, -2.0), v(2.0, 1.0, 2.0)), &white);
    let shaft = of(cuboid(v(-0.5, 0.0, -0.5), v(0.5, 2.0, 0.5)), &white);
    let lit = |solid: Primitive| {
        let mut description = description(1, vec![floor.clone(), solid], vec![light]);
        let hray_core::Camera::Perspective(camera) = &mut description.scene.camera else { panic!() };
        camera.to = v(0.0, -1.0, 0.0);
        colors(&description)[0].r
    };
    assert_eq!(lit(lid.clone()), 0.0);
    assert!((lit(csg(CsgOperation::Difference, lid, shaft)) - 1.0).abs() < 1e-12);
}
