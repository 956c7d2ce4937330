//! What a picture of 256 by 256 pixels costs on one thread, by what the scene is made of.
//!
//! `cargo bench -p hray-render`

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use hray_core::{
    Background, Camera, Csg, CsgOperation, Cuboid, DVec3, Description, Encoding, Integrator, Light, Material,
    NoiseTables, NoiseTexture, Plane, Primitive, Resolution, Rgb, Scene, Shape, Sphere, Texture,
    WindowCamera,
};
use hray_render::{Control, Settings, render};
use std::hint::black_box;
use std::num::{NonZeroU32, NonZeroUsize};
use std::sync::Arc;

const SIDE: u32 = 256;

fn scene(shapes: Vec<Shape>, material: &Arc<Material>) -> Scene {
    let camera = WindowCamera { eye: DVec3::new(0.0, 0.0, 150.0), window: [100.0, 100.0] };
    let primitive = |shape| Primitive { shape, transform: None, material: material.clone() };
    Scene {
        camera: Camera::Window(camera),
        background: Background::Uniform(Rgb::new(0.2, 0.3, 0.4)),
        primitives: shapes.into_iter().map(primitive).collect(),
        lights: vec![Light::Point {
            position: DVec3::new(100.0, 200.0, 100.0),
            intensity: Rgb::new(0.8, 0.8, 0.8),
        }],
        time: 0.0,
    }
}

fn material(texture: Texture, reflection: f64) -> Arc<Material> {
    Arc::new(Material { reflection: reflection.into(), shine: 60.0.into(), ..Material::matte(texture) })
}

fn wall() -> Shape {
    Shape::Plane(Plane { normal: DVec3::new(0.0, 0.0, 1.0), offset: 350.0 })
}

fn bench(c: &mut Criterion, name: &str, scene: &Scene, depth: i32) {
    bench_by(Integrator::Classic2005, c, name, scene, depth);
}

fn bench_by(integrator: Integrator, c: &mut Criterion, name: &str, scene: &Scene, depth: i32) {
    let Ok(resolution) = Resolution::new(SIDE.into(), SIDE.into()) else { return };
    let description = Description {
        resolution,
        max_depth: depth,
        samples: NonZeroU32::MIN,
        integrator,
        encoding: Encoding::Raw,
        scene: scene.clone(),
    };
    let settings = Settings { threads: Some(NonZeroUsize::MIN), ..Settings::of(&description) };
    let tables = NoiseTables::default();
    let mut group = c.benchmark_group("classic");
    group.throughput(Throughput::Elements(resolution.pixels()));
    group.bench_function(name, |b| {
        b.iter(|| {
            render(
                &description,
                &tables,
                &settings,
                &Control::new(),
                |pixels| pixels.len(),
                |n| {
                    black_box(n);
                    Ok::<(), ()>(())
                },
            )
        });
    });
    group.finish();
}

fn classic(c: &mut Criterion) {
    let gray = Rgb::new(0.6, 0.6, 0.6);
    let solid = material(Texture::Solid(gray), 0.0);
    bench(c, "one plane, lit", &scene(vec![wall()], &solid), 0);
    bench(
        c,
        "one plane, lit, with a highlight",
        &scene(vec![wall()], &material(Texture::Solid(gray), 0.5)),
        0,
    );
    for octaves in [0, 5, 10] {
        let texture = Texture::Noise(NoiseTexture::Turbulence { base: gray, octaves, grid: 32.0 });
        let name = format!("one plane, turbulence of {} octaves", octaves + 1);
        bench(c, &name, &scene(vec![wall()], &material(texture, 0.0)), 0);
    }
    let spheres = |n: usize| {
        let at = |i: usize| DVec3::new((i % 10) as f64 * 20.0 - 90.0, (i / 10) as f64 * 20.0 - 90.0, -200.0);
        (0..n).map(|i| Shape::Sphere(Sphere { radius: 8.0, center: at(i) })).collect::<Vec<_>>()
    };
    bench(c, "100 spheres", &scene(spheres(100), &solid), 0);
    let mirrors = scene(spheres(100), &material(Texture::Solid(gray), 0.8));
    bench(c, "100 mirrors, 5 levels", &mirrors, 5);
    bench_by(Integrator::Classic, c, "100 mirrors, 5 levels, exact rules", &mirrors, 5);
    let boxes = |n: usize| {
        let at = |i: usize| DVec3::new((i % 10) as f64 * 20.0 - 90.0, (i / 10) as f64 * 20.0 - 90.0, -200.0);
        let cuboid = |i| Cuboid { min: at(i) - 8.0, max: at(i) + 8.0 };
        (0..n).map(|i| Shape::Cuboid(cuboid(i))).collect::<Vec<_>>()
    };
    bench_by(Integrator::Classic, c, "100 boxes", &scene(boxes(100), &solid), 0);
    let bored = |(a, b)| {
        let operands = [a, b].map(|shape| Primitive { shape, transform: None, material: solid.clone() });
        Shape::Csg(Arc::new(Csg { operation: CsgOperation::Difference, operands }))
    };
    let solids = boxes(100).into_iter().zip(spheres(100)).map(bored).collect();
    bench_by(Integrator::Classic, c, "100 bored boxes", &scene(solids, &solid), 0);
}

criterion_group!(benches, classic);
criterion_main!(benches);
