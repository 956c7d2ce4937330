//! Small scenes, and their colours.

use hray_core::{
    Background, Camera, Cuboid, DAffine3, DVec3, Description, Encoding, Field, Frustum, Function, Implicit,
    Integrator, Light, Material, Mesh, NoiseTables, PerspectiveCamera, Plane, Primitive, Resolution, Rgb,
    Scene, Shape, Sphere, Texture, Torus,
};
use hray_expr::{Binary, Builder, Input, NodeId, Unary};
use hray_render::{Control, Settings, render};
use std::num::{NonZeroU32, NonZeroUsize};
use std::sync::Arc;

/// What is seen where nothing is.
pub(crate) const NOTHING: Rgb = Rgb::new(9.0, 8.0, 7.0);

pub(crate) fn v(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

/// A view of the origin from +z, 4 away and 4 high there.
pub(crate) fn camera() -> PerspectiveCamera {
    PerspectiveCamera { from: v(0.0, 0.0, 4.0), to: DVec3::ZERO, up: DVec3::Y, fov: 2.0 * libm::atan(0.5) }
}

pub(crate) fn description(side: i64, primitives: Vec<Primitive>, lights: Vec<Light>) -> Description {
    Description {
        resolution: Resolution::new(side, side).unwrap(),
        max_depth: 4,
        samples: NonZeroU32::MIN,
        integrator: Integrator::Classic,
        encoding: Encoding::Raw,
        scene: Scene {
            camera: Camera::Perspective(camera()),
            background: Background::Uniform(NOTHING),
            primitives,
            lights,
            time: 0.0,
        },
    }
}

/// The colours, row by row from the top.
pub(crate) fn colors(description: &Description) -> Vec<Rgb> {
    let threads = NonZeroUsize::new(1);
    let settings = Settings { threads, ..Settings::of(description) };
    let mut pixels = Vec::new();
    let take = |run: Vec<Rgb>| {
        pixels.extend(run);
        Ok::<(), ()>(())
    };
    let tables = NoiseTables::default();
    render(description, &tables, &settings, &Control::new(), <[Rgb]>::to_vec, take).unwrap();
    pixels
}

/// The colour in the middle of a picture of one pixel.
pub(crate) fn middle(primitives: Vec<Primitive>, lights: Vec<Light>) -> Rgb {
    colors(&description(1, primitives, lights))[0]
}

/// The directions of the rays of [`camera`].
pub(crate) fn directions(side: i64) -> Vec<DVec3> {
    let at = |i: i64| (i as f64 + 0.5) / side as f64 - 0.5;
    let pixels = (0..side).flat_map(|y| (0..side).map(move |x| (x, y)));
    pixels.map(|(x, y)| v(at(x), -at(y), -1.0).normalize()).collect()
}

/// A function of the hit, built from its inputs.
pub(crate) fn function(make: impl FnOnce(&mut Builder) -> Vec<NodeId>) -> Arc<Function> {
    let mut builder = Builder::new(1000);
    let outputs = make(&mut builder);
    Arc::new(builder.finish(&outputs))
}

/// Three inputs, scaled and shifted: a input + b.
pub(crate) fn affine(inputs: [Input; 3], a: f64, b: f64) -> Arc<Function> {
    function(|builder| {
        let (a, b) = (builder.constant(a).unwrap(), builder.constant(b).unwrap());
        let mut one = |input| {
            let x = builder.input(input).unwrap();
            let x = builder.binary(Binary::Mul, x, a).unwrap();
            builder.binary(Binary::Add, x, b).unwrap()
        };
        inputs.map(&mut one).to_vec()
    })
}

pub(crate) const WORLD: [Input; 3] = [Input::Wx, Input::Wy, Input::Wz];
pub(crate) const OBJECT: [Input; 3] = [Input::Px, Input::Py, Input::Pz];
pub(crate) const NORMAL: [Input; 3] = [Input::Nx, Input::Ny, Input::Nz];

/// Something that gives off the numbers it is asked for, from -10 to 10, and nothing else.
pub(crate) fn showing(inputs: [Input; 3]) -> Arc<Material> {
    let glow = Some(Texture::Function(affine(inputs, 0.05, 0.5)));
    Arc::new(Material { glow, ..Material::matte(Texture::Solid(Rgb::BLACK)) })
}

/// The numbers that were shown; none where nothing was.
pub(crate) fn shown(color: Rgb) -> Option<DVec3> {
    (color != NOTHING).then(|| (DVec3::from_array(color.to_array()) - 0.5) * 20.0)
}

pub(crate) fn gray(level: f64) -> Rgb {
    Rgb::new(level, level, level)
}

pub(crate) fn matte(level: f64) -> Arc<Material> {
    Arc::new(Material::matte(Texture::Solid(gray(level))))
}

pub(crate) fn mirror() -> Arc<Material> {
    Arc::new(Material {
        reflection: 1.0.into(),
        highlight: Some(Field::Constant(0.0)),
        ..Material::matte(Texture::Solid(Rgb::BLACK))
    })
}

pub(crate) fn glass(index: f64) -> Arc<Material> {
    Arc::new(Material {
        transmission: 1.0.into(),
        refractive_index: index.into(),
        ..Material::matte(Texture::Solid(Rgb::BLACK))
    })
}

pub(crate) fn sphere(center: DVec3, radius: f64) -> Shape {
    Shape::Sphere(Sphere { radius, center })
}

pub(crate) fn plane(normal: DVec3, offset: f64) -> Shape {
    Shape::Plane(Plane { normal, offset })
}

pub(crate) fn frustum(base: DVec3, top: DVec3, radii: [f64; 2]) -> Shape {
    Shape::Frustum(Arc::new(Frustum { base, top, radii, is_capped: true }))
}

pub(crate) fn torus(center: DVec3, axis: DVec3, radius: f64, tube: f64) -> Shape {
    Shape::Torus(Arc::new(Torus { center, axis: axis.normalize(), radius, tube }))
}

/// An implicit ball with waves, in a box that may cut it.
pub(crate) fn lump(center: DVec3, radius: f64, wave: f64, box_size: DVec3) -> Shape {
    let mut b = Builder::new(1000);
    let offsets =
        [Input::Px, Input::Py, Input::Pz].into_iter().zip(center.to_array()).map(|(input, center)| {
            let (p, center) = (b.input(input).unwrap(), b.constant(center).unwrap());
            b.binary(Binary::Sub, p, center).unwrap()
        });
    let [x, y, z] = <[NodeId; 3]>::try_from(offsets.collect::<Vec<_>>()).unwrap();
    let squares = [x, y, z].map(|v| b.binary(Binary::Mul, v, v).unwrap());
    let sum = b.binary(Binary::Add, squares[0], squares[1]).unwrap();
    let sum = b.binary(Binary::Add, sum, squares[2]).unwrap();
    let length = b.unary(Unary::Sqrt, sum).unwrap();
    let (radius, wave) = (b.constant(radius).unwrap(), b.constant(wave).unwrap());
    let ball = b.binary(Binary::Sub, length, radius).unwrap();
    let four = b.constant(4.0).unwrap();
    let angle = b.binary(Binary::Div, y, radius).unwrap();
    let angle = b.binary(Binary::Mul, angle, four).unwrap();
    let sine = b.unary(Unary::Sin, angle).unwrap();
    let height = b.binary(Binary::Mul, sine, wave).unwrap();
    let value = b.binary(Binary::Add, ball, height).unwrap();
    let (min, max) = (center - box_size * 0.5, center + box_size * 0.5);
    Shape::Implicit(Arc::new(Implicit { function: Arc::new(b.finish(&[value])), min, max }))
}

pub(crate) fn cuboid(min: DVec3, max: DVec3) -> Shape {
    Shape::Cuboid(Cuboid { min, max })
}

/// A ball of triangles around a point: the octahedron, its faces cut in four `cuts` times.
pub(crate) fn ball(center: DVec3, radius: f64, cuts: usize, smooth: bool) -> Shape {
    let mut points: Vec<DVec3> = DVec3::AXES.into_iter().flat_map(|axis| [axis, -axis]).collect();
    let mut faces = Vec::new();
    for (x, y, z) in (0..8).map(|i| (i & 1, 2 + (i >> 1 & 1), 4 + (i >> 2 & 1))) {
        let even = (x + y + z) % 2 == 0;
        faces.push(if even { [x, y, z] } else { [x, z, y] });
    }
    for _ in 0..cuts {
        let mut finer = Vec::new();
        for [a, b, c] in faces {
            let mut middle = |a: usize, b: usize| {
                let point = (points[a] + points[b]).normalize();
                points.iter().position(|p| *p == point).unwrap_or_else(|| {
                    points.push(point);
                    points.len() - 1
                })
            };
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            finer.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        faces = finer;
    }
    let single = |p: DVec3| p.to_array().map(|x| x as f32);
    let positions = points.iter().map(|p| single(center + *p * radius)).collect();
    let triangles = faces.iter().map(|face| face.map(|vertex| vertex as u32)).collect();
    let normals = if smooth { points.iter().copied().map(single).collect() } else { Vec::new() };
    let mesh = Mesh::new(positions, triangles).and_then(|mesh| mesh.with_normals(normals)).unwrap();
    Shape::Mesh(Arc::new(mesh))
}

pub(crate) fn of(shape: Shape, material: &Arc<Material>) -> Primitive {
    Primitive { shape, transform: None, material: material.clone() }
}

pub(crate) fn placed(primitive: Primitive, transform: DAffine3) -> Primitive {
    Primitive { transform: Some(Arc::new(transform)), ..primitive }
}

/// A stream of numbers in [0, 1) from a seed: `SplitMix64`.
pub(crate) struct Numbers(pub(crate) u64);

impl Numbers {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    pub(crate) fn below(&mut self, n: usize) -> usize {
        (self.next() * n as f64) as usize
    }

    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    pub(crate) fn point(&mut self, size: f64) -> DVec3 {
        v(self.between(-size, size), self.between(-size, size), self.between(-size, size))
    }
}
