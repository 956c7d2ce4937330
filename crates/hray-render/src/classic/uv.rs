//! Surface parameters.

use super::shapes::Prepared;
use hray_core::DVec3;
use std::f64::consts::{PI, TAU};

/// The surface parameters u and v of a point of a shape, in its own space, where it has that outward unit normal.
///
/// - Sphere: u is the longitude, in [0, 1) from the half plane x = 0, z < 0 eastward, so that 1/2 is at +z and 3/4
///   at +x; v is the latitude, from 0 at the south pole (-y) to 1 at the north pole.
/// - Plane: distances from the foot of the origin along two unit vectors at right angles to the normal, those of
///   T. Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017. For the normal +y, u is x and v
///   is -z; for +z they are x and y.
/// - Box: on each face u and v go from 0 to 1. Seen from outside, u to the right and v upward, with +y up on the
///   four sides, -z up on the top and +z up on the bottom.
pub(super) fn uv(shape: &Prepared, p: DVec3, normal: DVec3) -> [f64; 2] {
    match *shape {
        Prepared::Sphere { center, .. } | Prepared::ExactSphere { center, .. } => direction_uv(p - center),
        Prepared::Plane { unit_normal: n, .. } | Prepared::ExactPlane { unit: n, .. } => {
            let sign = 1f64.copysign(n.z);
            let a = -1.0 / (sign + n.z);
            let b = n.x * n.y * a;
            let across = DVec3::new(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x);
            let up = DVec3::new(b, sign + n.y * n.y * a, -n.y);
            [p.dot(across), p.dot(up)]
        }
        Prepared::Cuboid { min, max, .. } => {
            let q = DVec3::from_array(std::array::from_fn(|axis| {
                let size = max[axis] - min[axis];
                if size > 0.0 { (p[axis] - min[axis]) / size } else { 0.0 }
            }));
            if normal.x > 0.5 {
                [1.0 - q.z, q.y]
            } else if normal.x < -0.5 {
                [q.z, q.y]
            } else if normal.y > 0.5 {
                [q.x, 1.0 - q.z]
            } else if normal.y < -0.5 {
                [q.x, q.z]
            } else if normal.z > 0.0 {
                [q.x, q.y]
            } else {
                [1.0 - q.x, q.y]
            }
        }
        Prepared::Round { ref shape, .. } => shape.uv(p),
        Prepared::Implicit(ref surface) => surface.uv(p),
        // Located by itself.
        Prepared::Mesh(_) => [0.0; 2],
    }
}

/// The sphere's parameters of a direction from its centre.
pub(super) fn direction_uv(d: DVec3) -> [f64; 2] {
    let across = (d.x * d.x + d.z * d.z).sqrt();
    let v = 0.5 + libm::atan2(d.y, across) / PI;
    [longitude(d.x, d.z), v]
}

/// The angle about the y axis, in turns, in [0, 1): from -z eastward.
pub(super) fn longitude(x: f64, z: f64) -> f64 {
    let u = 0.5 + libm::atan2(x, z) / TAU;
    if u < 1.0 { u } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hray_core::{Cuboid, Integrator, Plane, Shape};

    fn prepared(shape: Shape) -> Prepared {
        Prepared::new(&shape, Integrator::Classic).unwrap()
    }

    #[test]
    fn a_sphere_is_a_globe() {
        for (direction, expected) in [
            (DVec3::Z, [0.5, 0.5]),
            (DVec3::X, [0.75, 0.5]),
            (DVec3::NEG_X, [0.25, 0.5]),
            (DVec3::NEG_Z, [0.0, 0.5]),
            (DVec3::Y, [0.5, 1.0]),
            (DVec3::NEG_Y, [0.5, 0.0]),
        ] {
            assert_eq!(direction_uv(direction), expected, "{direction}");
        }
    }

    #[test]
    fn a_plane_has_a_grid() {
        let plane = |normal| prepared(Shape::Plane(Plane { normal, offset: -2.0 }));
        let p = DVec3::new(3.0, 2.0, 5.0);
        assert_eq!(uv(&plane(DVec3::Y), p, DVec3::Y), [3.0, -5.0]);
        assert_eq!(uv(&plane(DVec3::Z), p, DVec3::Z), [3.0, 2.0]);
        let n = DVec3::new(0.6, 0.0, -0.8);
        let [u, v] = uv(&plane(n), p, n);
        assert!(
            (u * u + v * v + p.dot(n) * p.dot(n) - p.dot(p)).abs() < 1e-12,
            "at right angles, of length 1"
        );
    }

    /// The corner that is on the right and up, seen from outside.
    #[test]
    fn every_face_of_a_box_is_a_square() {
        let cube = prepared(Shape::Cuboid(Cuboid {
            min: DVec3::new(-1.0, 0.0, 2.0),
            max: DVec3::new(1.0, 4.0, 8.0),
        }));
        for (normal, right_and_up) in [
            (DVec3::Z, [1.0, 4.0, 8.0]),
            (DVec3::NEG_Z, [-1.0, 4.0, 2.0]),
            (DVec3::X, [1.0, 4.0, 2.0]),
            (DVec3::NEG_X, [-1.0, 4.0, 8.0]),
            (DVec3::Y, [1.0, 4.0, 2.0]),
            (DVec3::NEG_Y, [1.0, 0.0, 8.0]),
        ] {
            assert_eq!(uv(&cube, right_and_up.into(), normal), [1.0, 1.0], "{normal}");
        }
    }
}
