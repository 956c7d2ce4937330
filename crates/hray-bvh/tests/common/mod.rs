//! Meshes, rays, and the comparison of a tree with a walk over all triangles.

#![allow(dead_code, unreachable_pub, reason = "each test uses a part")]

use fearless_simd::{Level, Simd, dispatch};
use hray_bvh::{Hit, Ray, Stack, TriangleMesh};

/// Numbers that look random and are the same each time (Steele, Lea and Flood, *Fast Splittable Pseudorandom Number
/// Generators*, 2014).
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Below `end`.
    pub fn below(&mut self, end: usize) -> usize {
        (self.next() % end.max(1) as u64) as usize
    }

    /// From 0 to 1.
    pub fn unit(&mut self) -> f32 {
        (self.next() >> 40) as f32 / (1 << 24) as f32
    }

    /// From -1 to 1.
    pub fn signed(&mut self) -> f32 {
        2.0 * self.unit() - 1.0
    }

    pub fn point(&mut self) -> [f32; 3] {
        [self.signed(), self.signed(), self.signed()]
    }
}

pub struct Mesh {
    pub vertices: Vec<[f32; 3]>,
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    pub fn build(&self) -> TriangleMesh {
        TriangleMesh::build(&self.vertices, &self.triangles).unwrap()
    }

    pub fn corners(&self, triangle: usize) -> [[f32; 3]; 3] {
        self.triangles[triangle].map(|vertex| self.vertices[vertex as usize])
    }

    /// Every coordinate times `scale`, plus `shift`.
    pub fn moved(mut self, scale: f32, shift: [f32; 3]) -> Self {
        for vertex in &mut self.vertices {
            *vertex = add(vertex.map(|x| x * scale), shift, 1.0);
        }
        self
    }
}

/// Triangles that have nothing to do with each other.
pub fn soup(random: &mut Random, count: usize, size: f32) -> Mesh {
    let mut mesh = Mesh { vertices: Vec::new(), triangles: Vec::new() };
    for triangle in 0..count as u32 {
        let place = random.point();
        mesh.vertices.extend([0; 3].map(|_| add(place, random.point(), size)));
        mesh.triangles.push([0, 1, 2].map(|corner| 3 * triangle + corner));
    }
    mesh
}

/// A landscape of `cells` by `cells` squares from -1 to 1; flat where `height` is 0.
pub fn terrain(random: &mut Random, cells: u32, height: f32) -> Mesh {
    let mut mesh = Mesh { vertices: Vec::new(), triangles: Vec::new() };
    let at = |i: u32| 2.0 * i as f32 / cells as f32 - 1.0;
    for (j, i) in (0..=cells).flat_map(|j| (0..=cells).map(move |i| (j, i))) {
        mesh.vertices.push([at(i), height * random.signed(), at(j)]);
    }
    for (j, i) in (0..cells).flat_map(|j| (0..cells).map(move |i| (j, i))) {
        let a = j * (cells + 1) + i;
        let (b, c, d) = (a + 1, a + cells + 1, a + cells + 2);
        mesh.triangles.extend([[a, c, b], [b, c, d]]);
    }
    mesh
}

/// A closed surface: an octahedron whose triangles were split in four `times` times, blown up to a ball with bumps.
pub fn ball(random: &mut Random, times: usize, bumps: f32) -> Mesh {
    let mut vertices: Vec<[f32; 3]> = Vec::new();
    for axis in 0..3 {
        for sign in [1.0, -1.0] {
            let mut vertex = [0.0; 3];
            vertex[axis] = sign;
            vertices.push(vertex);
        }
    }
    let mut triangles: Vec<[u32; 3]> = Vec::new();
    for (x, y, z) in (0..8).map(|bits: u32| (bits & 1, 2 + (bits >> 1 & 1), 4 + (bits >> 2))) {
        triangles.push([x, y, z]);
    }
    for _ in 0..times {
        let mut middles = std::collections::HashMap::new();
        let mut middle = |p: u32, q: u32| {
            *middles.entry((p.min(q), p.max(q))).or_insert_with(|| {
                let sum = add(vertices[p as usize], vertices[q as usize], 1.0);
                let length = dot(sum, sum).sqrt();
                vertices.push(sum.map(|x| x / length));
                vertices.len() as u32 - 1
            })
        };
        let split = |&[a, b, c]: &[u32; 3]| {
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        };
        triangles = triangles.iter().flat_map(split).collect();
    }
    for vertex in &mut vertices {
        let scale = 1.0 + bumps * random.signed();
        *vertex = vertex.map(|x| x * scale);
    }
    Mesh { vertices, triangles }
}

pub fn add(a: [f32; 3], b: [f32; 3], times: f32) -> [f32; 3] {
    [0, 1, 2].map(|axis| a[axis] + b[axis] * times)
}

pub fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Where a ray is, before it is made ready.
#[derive(Clone, Copy, Debug)]
pub struct Plain {
    pub origin: [f32; 3],
    pub direction: [f32; 3],
    pub near: f32,
    pub far: f32,
}

impl Plain {
    pub fn new(origin: [f32; 3], direction: [f32; 3]) -> Self {
        Self { origin, direction, near: 0.0, far: f32::INFINITY }
    }

    pub fn to(origin: [f32; 3], target: [f32; 3]) -> Self {
        Self::new(origin, add(target, origin, -1.0))
    }

    #[inline(always)]
    pub fn ready<S: Simd>(&self, simd: S, mesh: &TriangleMesh) -> Ray {
        Ray::new(simd, self.origin, self.direction, self.near, self.far, mesh.reach())
    }
}

/// A ray of one of many kinds towards a mesh; `size` is the mesh's.
pub fn ray(random: &mut Random, mesh: &Mesh, centre: [f32; 3], size: f32) -> Plain {
    let mut around = |times: f32| add(centre, random.point(), size * times);
    let (outside, inside) = (around(3.0), around(1.0));
    let triangle = random.below(mesh.triangles.len());
    let corners = if mesh.triangles.is_empty() { [centre; 3] } else { mesh.corners(triangle) };
    let on_edge = |random: &mut Random| {
        let edge = add(corners[1], corners[0], -1.0);
        add(corners[0], edge, random.unit())
    };
    let mut plain = match random.below(10) {
        0 => Plain::new(outside, random.point()),
        1 => Plain::to(outside, inside),
        2 => Plain::to(outside, corners[0]),
        3 => Plain::to(inside, on_edge(random)),
        4 => Plain::to(corners[1], inside),
        5 => Plain::to(corners[0], corners[2]),
        // In a triangle's plane, past it and through it.
        6 => {
            let (u, v) = (3.0 * random.signed(), 3.0 * random.signed());
            let [a, b, c] = corners;
            let origin = add(add(a, add(b, a, -1.0), u), add(c, a, -1.0), v);
            Plain::to(origin, on_edge(random))
        }
        // Along an axis, towards a point or a vertex.
        kind => {
            let target = if kind == 7 { inside } else { corners[random.below(3)] };
            let (axis, sign) = (random.below(3), if random.below(2) == 0 { 1.0 } else { -1.0 });
            let mut direction = [0.0; 3];
            direction[axis] = sign * size;
            if kind == 9 {
                direction[(axis + 1) % 3] = random.signed() * size;
            }
            Plain::new(add(target, direction, -2.0), direction)
        }
    };
    if plain.direction == [0.0; 3] {
        plain.direction[0] = 1.0;
    }
    match random.below(6) {
        0 => plain.near = random.unit(),
        1 => plain.far = random.unit() * 2.0,
        2 => plain.direction = plain.direction.map(|x| x * 1e3),
        _ => {}
    }
    plain
}

/// Every way in which this machine can compute.
pub fn levels() -> Vec<Level> {
    let mut levels = vec![Level::baseline()];
    #[cfg(target_arch = "x86_64")]
    {
        levels.extend(Level::new().as_sse4_2().map(Level::Sse4_2));
        levels.extend(Level::new().as_avx2().map(Level::Avx2));
        levels.extend(Level::new().as_avx512().map(Level::Avx512));
    }
    levels
}

/// What a ray meets: the nearest, whether there is any, and the nearest of all triangles.
pub fn answers(level: Level, mesh: &TriangleMesh, ray: &Plain, stack: &mut Stack) -> [Option<Hit>; 3] {
    dispatch!(level, simd => {
        let ray = ray.ready(simd, mesh);
        let of_all = mesh.closest_of_all(simd, &ray);
        let any = if mesh.any(simd, &ray, stack) { of_all } else { None };
        [mesh.closest(simd, &ray, stack), any, of_all]
    })
}

/// The same to the last bit.
pub fn bits(hit: Option<Hit>) -> Option<(u32, u32, [u32; 2])> {
    hit.map(|hit| (hit.triangle, hit.distance.to_bits(), hit.weights.map(f32::to_bits)))
}

/// Compares a tree with a walk over all triangles, at all levels.
pub fn compare(mesh: &TriangleMesh, rays: &[Plain]) -> Result<usize, String> {
    let mut stack = Stack::default();
    let levels = levels();
    let mut hits = 0;
    for ray in rays {
        let mut expected = None;
        for &level in &levels {
            let [closest, any, of_all] = answers(level, mesh, ray, &mut stack);
            let expected = *expected.get_or_insert(of_all);
            if [closest, any, of_all].iter().any(|hit| bits(*hit) != bits(expected)) {
                return Err(format!(
                    "{ray:?} at {level:?}: {closest:?}, any {any:?}, of all {of_all:?}, before {expected:?}"
                ));
            }
        }
        hits += usize::from(expected.flatten().is_some());
    }
    Ok(hits)
}
