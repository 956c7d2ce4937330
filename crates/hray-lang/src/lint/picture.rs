//! Lints about the picture as a whole: its size, the camera, the lights.

use super::sink::Sink;
use crate::classic::Spans;
use crate::diagnostic::Span;
use hray_core::{Camera, Description, MIN_DEPTH, Resolution};

/// How far the pixels may be from square.
const ASPECT_TOLERANCE: f64 = 0.01;
/// Of the numbers of the camera, the first of the window.
const WINDOW: usize = 3;

pub(super) fn check(sink: &mut Sink<'_>, description: &Description, spans: &Spans) {
    let scene = &description.scene;
    if description.max_depth == MIN_DEPTH {
        sink.report("black-picture", |words| {
            words
                .warning("the picture will be black", spans.depth, "a recursion depth of -1 traces no ray")
                .with_suggestion(
                    spans.depth,
                    "0",
                    "a depth of 0 shows all surfaces, but no reflections and refractions",
                )
        });
    }
    if scene.lights.is_empty() && !scene.primitives.is_empty() {
        sink.report("no-lights", |words| {
            let label = "expected at least one light in this section";
            words
                .warning("there are no lights, so all surfaces are black", spans.lights, label)
                .with_help("write, for example, `(pointLight (30.0,50.0,100.0) (0.8,0.8,0.8))`")
        });
    }
    let Camera::Window(camera) = scene.camera else { return };
    if camera.eye.z == 0.0 {
        sink.report("eye-in-window", |words| {
            let eye = words.numbers(spans.camera, 0, WINDOW);
            let label = "the window lies in the plane z = 0";
            words
                .warning("the eye lies in the plane of the window", eye, label)
                .with_note("rays lead from the eye to the points of the window, here all along that plane")
                .with_help("move the eye along the z axis, for example to (0.0,0.0,150.0)")
        });
    }
    let [width, height] = camera.window;
    if width < 1.0 || height < 1.0 {
        sink.report("window-size", |words| {
            let label = "a side of 0 leaves nothing to see, a negative one mirrors the picture";
            let message = format!("the camera's window is {width} by {height}");
            words.warning(message, words.numbers(spans.camera, WINDOW, 2), label)
        });
    } else {
        check_aspect(sink, description.resolution, [width, height], spans);
    }
}

fn check_aspect(sink: &mut Sink<'_>, resolution: Resolution, [width, height]: [f64; 2], spans: &Spans) {
    let (across, up) = (f64::from(resolution.width()), f64::from(resolution.height()));
    let ratio = (width / across) / (height / up);
    let square = (across * height / width).round();
    // A picture of few pixels cannot always have the proportions of the window.
    if (ratio - 1.0).abs() <= ASPECT_TOLERANCE || (up - square).abs() <= 1.0 {
        return;
    }
    sink.report("pixel-aspect", |words| {
        let percent = (ratio.max(1.0 / ratio) - 1.0) * 100.0;
        let wide = if ratio > 1.0 { "wider than high" } else { "higher than wide" };
        let message = format!("pixels are not square: they are {percent:.1} % {wide}");
        let window = words.numbers(spans.camera, WINDOW, 2);
        let label = "the resolution has other proportions than the camera's window";
        let warning = words
            .warning(message, spans.resolution, label)
            .with_secondary(window, "the window is this wide and high");
        let fits = Resolution::new(i64::from(resolution.width()), square as i64).is_ok();
        let end = Span::at(spans.resolution.end);
        match words.text(spans.resolution).rsplit_once(',') {
            Some((_, old)) if fits => {
                let span = Span::new(end.end - old.len(), end.end);
                let words = format!("a height of {square} makes them square");
                warning.with_suggestion(span, format!("{square}"), words)
            }
            _ => warning,
        }
    });
}
