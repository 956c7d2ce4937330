//! From points of the picture to rays.

use super::frame::Frame;
use hray_core::{Camera, DVec3, WindowCamera};

/// A camera with its directions at hand.
pub(super) enum View {
    /// The thesis': rays start at points of a window in the plane z = 0 and lead away from the eye.
    Window(WindowCamera),
    /// Rays start at one point. `across` and `up` are as long as the picture is high at distance 1.
    Perspective { from: DVec3, forward: DVec3, across: DVec3, up: DVec3 },
    /// Rays are parallel. `across` and `up` are as long as what the picture's height shows.
    Orthographic { from: DVec3, forward: DVec3, across: DVec3, up: DVec3 },
}

impl View {
    pub(super) fn new(camera: &Camera) -> Self {
        match *camera {
            Camera::Window(camera) => Self::Window(camera),
            Camera::Perspective(camera) => {
                let [forward, across, up] = frame(camera.from, camera.to, camera.up);
                let height = 2.0 * libm::tan(camera.fov / 2.0);
                Self::Perspective { from: camera.from, forward, across: across * height, up: up * height }
            }
            Camera::Orthographic(camera) => {
                let [forward, across, up] = frame(camera.from, camera.to, camera.up);
                let (across, up) = (across * camera.height, up * camera.height);
                Self::Orthographic { from: camera.from, forward, across, up }
            }
        }
    }

    /// The point of the film that a point of a picture of `size` stands for. The picture's is counted in pixels
    /// from the lower left, and whole for the lower left corner of a pixel.
    ///
    /// For the classic camera it is the point itself, on the window: `mapToWin`. For the others it is the centre
    /// of the pixel whose corner is given, in units of the picture's height from its middle.
    pub(super) fn film_point(&self, [width, height]: [f64; 2], [px, py]: [f64; 2]) -> [f64; 2] {
        if let Self::Window(WindowCamera { window: [window_width, window_height], .. }) = self {
            [(px - width / 2.0) * window_width / width, (py - height / 2.0) * window_height / height]
        } else {
            [(px + 0.5 - width / 2.0) / height, (py + 0.5 - height / 2.0) / height]
        }
    }

    /// The rays through points of the film; for the classic camera only where they start.
    pub(super) fn start(&self, points: &[[f64; 2]], frame: &mut Frame) {
        let mut put = |i: usize, from: DVec3, toward: DVec3| {
            let ends = [(frame.origin.get_mut(), from), (frame.direction.get_mut(), toward)];
            for (columns, v) in ends {
                columns.into_iter().zip(v.to_array()).for_each(|(column, component)| column[i] = component);
            }
        };
        for (i, &[x, y]) in points.iter().enumerate() {
            match *self {
                Self::Window(_) => put(i, DVec3::new(x, y, 0.0), DVec3::ZERO),
                Self::Perspective { from, forward, across, up } => {
                    put(i, from, unit(forward + across * x + up * y));
                }
                Self::Orthographic { from, forward, across, up } => {
                    put(i, from + across * x + up * y, forward);
                }
            }
        }
        frame.origin.pad(points.len());
        frame.direction.pad(points.len());
    }
}

/// Unit vectors forward, to the right and up. Where the line of sight has no direction, or is that of `up`, they
/// are no numbers, and nothing is hit.
fn frame(from: DVec3, to: DVec3, up: DVec3) -> [DVec3; 3] {
    let forward = unit(to - from);
    let across = unit(forward.cross(up));
    [forward, across, across.cross(forward)]
}

fn unit(v: DVec3) -> DVec3 {
    // First by the largest component, so that no square overflows or vanishes.
    let v = v / v.abs().max_element();
    v / (v.x * v.x + v.y * v.y + v.z * v.z).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use hray_core::{OrthographicCamera, PerspectiveCamera};

    fn rays(camera: &Camera, size: [f64; 2], pixels: &[[f64; 2]]) -> Vec<[DVec3; 2]> {
        let view = View::new(camera);
        let points: Vec<[f64; 2]> = pixels.iter().map(|&pixel| view.film_point(size, pixel)).collect();
        let mut frame = Frame::new();
        frame.begin(super::super::frame::Background::Scene, points.len());
        frame.len = points.len();
        view.start(&points, &mut frame);
        let at = |columns: [&[f64]; 3], i: usize| DVec3::from_array(columns.map(|column| column[i]));
        (0..points.len()).map(|i| [at(frame.origin.get(), i), at(frame.direction.get(), i)]).collect()
    }

    fn near(a: DVec3, b: DVec3) -> bool {
        (a - b).abs().max_element() < 1e-15
    }

    /// Two by two pixels over an angle of 90°: centres at a quarter of the height from the middle.
    #[test]
    fn perspective_rays_lead_through_the_centres_of_pixels() {
        let from = DVec3::new(0.0, 0.0, 5.0);
        let fov = std::f64::consts::FRAC_PI_2;
        let camera = PerspectiveCamera { from, to: DVec3::ZERO, up: DVec3::Y, fov };
        let found = rays(&Camera::Perspective(camera), [2.0, 2.0], &[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]);
        for ([origin, direction], [x, y]) in found.into_iter().zip([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5]]) {
            assert_eq!(origin, from);
            assert!(near(direction, DVec3::new(x, y, -1.0) / 1.5f64.sqrt()), "{direction}");
        }
    }

    /// The angle is the one between the lower and the upper edge, however wide the picture.
    #[test]
    fn the_field_of_view_is_vertical() {
        let camera = PerspectiveCamera { from: DVec3::ZERO, to: DVec3::X, up: DVec3::Z, fov: 1.0 };
        let [[_, low], [_, high]] =
            rays(&Camera::Perspective(camera), [64.0, 8.0], &[[31.5, -0.5], [31.5, 7.5]])[..]
        else {
            panic!()
        };
        assert!((libm::acos(low.dot(high)) - 1.0).abs() < 1e-15);
        assert!(high.z > 0.0 && low.z < 0.0 && high.y.abs() < 1e-15);
    }

    /// Looking down, with -z up in the picture.
    #[test]
    fn orthographic_rays_are_parallel() {
        let camera = OrthographicCamera {
            from: DVec3::new(1.0, 10.0, 2.0),
            to: DVec3::new(1.0, 0.0, 2.0),
            up: DVec3::NEG_Z,
            height: 4.0,
        };
        let found = rays(&Camera::Orthographic(camera), [4.0, 2.0], &[[0.0, 0.0], [3.0, 1.0]]);
        for ([origin, direction], [x, z]) in found.into_iter().zip([[-3.0, 1.0], [3.0, -1.0]]) {
            assert!(near(direction, DVec3::NEG_Y));
            assert!(near(origin, DVec3::new(1.0 + x, 10.0, 2.0 + z)), "{origin}");
        }
    }

    #[test]
    fn the_classic_camera_keeps_the_lower_left_corner() {
        let camera = WindowCamera { eye: DVec3::Z, window: [100.0, 50.0] };
        let found = rays(&Camera::Window(camera), [4.0, 2.0], &[[0.0, 0.0], [2.0, 1.0]]);
        let origins: Vec<DVec3> = found.into_iter().map(|[origin, _]| origin).collect();
        assert_eq!(origins, [DVec3::new(-50.0, -25.0, 0.0), DVec3::ZERO]);
    }

    #[test]
    fn a_camera_without_a_direction_does_not_panic() {
        let camera = PerspectiveCamera { from: DVec3::X, to: DVec3::X, up: DVec3::Y, fov: 1.0 };
        let parallel = PerspectiveCamera { to: DVec3::X + DVec3::Y, ..camera };
        for camera in [camera, parallel] {
            assert!(rays(&Camera::Perspective(camera), [2.0, 2.0], &[[0.0, 0.0]])[0][1].is_nan());
        }
    }
}
