//! Implicit surfaces: functions of a point, and the boxes in which they are 0.

use super::construct::Fields;
use super::failure::{Failure, Outcome};
use super::machine::Machine;
use super::texture::{Compiled, single};
use super::value::{Given, Kind, Value};
use crate::diagnostic::{Diagnostic, Span};
use glam::DVec3;
use hray_core::{Function, Implicit, NoiseTables, Shape};
use hray_expr::{Binary, Extent, Node, NoiseKind, RangePlan, RangeScratch, Unary, Unknown};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Surfaces that are known, by how many operations their functions have: what is made again in a list is one surface.
pub(super) type Known = BTreeMap<usize, Vec<KnownSurface>>;

/// An implicit surface as it was asked for.
pub(super) struct KnownSurface {
    center: DVec3,
    size: Option<DVec3>,
    surface: Arc<Implicit>,
}

impl Fields<'_, '_> {
    pub(super) fn implicit(&mut self) -> Outcome<Shape> {
        let (function, span) = self.value("function")?;
        let center = self.vector("center")?;
        let size = match self.optional("size") {
            Some(_) => Some(self.vector("size")?),
            None => None,
        };
        let whole = self.span;
        let center_span = self.optional("center").map_or(whole, |given| given.span);
        let machine = self.machine();
        let given = Given { value: function, span };
        let compiled = machine.compile(
            &given.value,
            span,
            |hit| super::scalar::assemble(Kind::Vec3, hit.p),
            |graph, value: &Value| Ok(vec![single(graph, value, span)?]),
        )?;
        let function = match compiled {
            Compiled::Function(function) => function,
            Compiled::Constant([value, ..]) => return Err(Failure::new(constant(value, span))),
        };
        let alike = machine.surfaces.entry(function.nodes().len()).or_default();
        let known = alike
            .iter()
            .find(|known| known.center == center && known.size == size && known.surface.function == function);
        if let Some(known) = known {
            return Ok(Shape::Implicit(known.surface.clone()));
        }
        let [min, max] = machine.bounds(&function, center, size, [whole, span, center_span])?;
        let surface = Arc::new(Implicit { function: function.clone(), min, max });
        let known = KnownSurface { center, size, surface: surface.clone() };
        machine.surfaces.entry(function.nodes().len()).or_default().push(known);
        Ok(Shape::Implicit(surface))
    }
}

impl Machine<'_> {
    /// The box that was asked for, or the one that the surface is found in.
    fn bounds(
        &mut self,
        function: &Function,
        center: DVec3,
        size: Option<DVec3>,
        [whole, span, center_span]: [Span; 3],
    ) -> Outcome<[DVec3; 2]> {
        let plan = RangePlan::new(function, &NoiseTables::default());
        let scratch = &mut RangeScratch::default();
        let given = match size {
            Some(size) => Some([center - size * 0.5, center + size * 0.5]),
            None => match plan.extent(center.to_array(), scratch) {
                Extent::Within(half) => Some([center - half, center + half]),
                Extent::Nothing => None,
                Extent::InsideOut(_) => return Err(Failure::new(inside_out(whole, span))),
                Extent::Endless => {
                    let unknown = plan.unknown([[-1e3; 3], [1e3; 3]], scratch);
                    return Err(Failure::new(endless(unknown.as_ref(), whole, span)));
                }
            },
        };
        let found = given.and_then(|corners| {
            let corners = corners.map(|corner| corner.to_array());
            plan.tight_bounds(corners, scratch).map(|bounds| bounds.map(DVec3::from))
        });
        let (Some(given), Some(found)) = (given, found) else {
            let message = "the function is nowhere 0, so there is no surface to see";
            let label = match size {
                Some(_) => "nowhere in the box that `size` and `center` give",
                None => "it is greater than 0 everywhere",
            };
            let warning = Diagnostic::warning("no-surface", message, span, label);
            let help = if size.is_some() {
                "the surface is where it is 0; a larger `size`, or another `center`, may reach it"
            } else {
                "the surface is where it is 0; less than 0 is inside, more outside"
            };
            self.warn(warning.with_help(help));
            // A box of any size will do.
            return Ok(given.unwrap_or([center - 0.5, center + 0.5]));
        };
        if let Some(unknown) = plan.unknown(found.map(|corner| corner.to_array()), scratch) {
            self.warn(not_bounded(&unknown, span));
        }
        let corners = if size.is_some() { given } else { found };
        let is_sane = corners.iter().all(|corner| corner.abs().max_element() < 1e30);
        if !is_sane || (corners[1] - corners[0]).min_element() <= 0.0 {
            let message = "the box of this surface is beyond what can be calculated with";
            let error = Diagnostic::error("out-of-range", message, center_span, "too far away, or too small");
            return Err(Failure::new(error));
        }
        Ok(corners)
    }
}

fn constant(value: f64, span: Span) -> Diagnostic {
    let message = format!("the function is {value} everywhere, so it has no surface");
    let error = Diagnostic::error("no-surface", message, span, "it does not depend on the point");
    error.with_help(
        "the surface is where a function of a point is 0; for a sphere of radius 1: `\\p -> length p - 1`",
    )
}

fn inside_out(whole: Span, span: Span) -> Diagnostic {
    let message = "the function is less than 0 far away, so everything out there would be inside";
    let error = Diagnostic::error("inside-out", message, span, "less than 0 is inside");
    error.with_secondary(whole, "this surface has no `size`").with_help(
        "turn the sign round, as in `\\p -> -(f p)`; or give a `size`, the box in which the surface is",
    )
}

fn endless(unknown: Option<&Unknown>, whole: Span, span: Span) -> Diagnostic {
    let message = "no end of this surface was found, so it needs a `size`";
    let mut error =
        Diagnostic::error("no-bounds", message, span, "0 also far away, or it cannot be ruled out");
    if let Some(cause) = unknown.and_then(|unknown| unknown.cause.as_ref()).and_then(said) {
        error = error
            .with_note(format!("{cause} may be infinite, so nothing is known of what is calculated with it"));
    }
    error.with_secondary(whole, "the surface").with_help(
        "for example `size = (4, 4, 4)`: the sides of a box around `center`, beyond which it is cut off",
    )
}

fn not_bounded(unknown: &Unknown, span: Span) -> Diagnostic {
    let [x, y, z] = unknown.place.map(|v| format!("{}", (v * 1000.0).round() / 1000.0 + 0.0));
    let message = "nothing can be said of this function in some places, so its surface may have flaws there";
    let label = format!("for example near ({x}, {y}, {z})");
    let warning = Diagnostic::warning("unbounded-function", message, span, label);
    let warning = match unknown.cause.as_ref().and_then(said) {
        Some(cause) => {
            warning.with_note(format!("{cause} may be infinite there, and the function 0 as well"))
        }
        None => warning,
    };
    warning.with_help(
        "where the function jumps, as at the poles of `tan` or of 1/x, no surface should be; let it have a limit there, for \
         example by `clamp`",
    )
}

/// An operation in words.
fn said(node: &Node) -> Option<&'static str> {
    Some(match node {
        Node::Binary(Binary::Div, ..) => "a division by what may be 0",
        Node::Binary(Binary::Pow, ..) => "a power",
        Node::Binary(Binary::Modulo, ..) => "a rest of a division",
        Node::Unary(Unary::Tan, _) => "`tan`",
        Node::Unary(Unary::Ln, _) => "`ln`",
        Node::Unary(Unary::Exp, _) => "`exp`",
        Node::Binary(Binary::Mul, ..) => "a product",
        Node::Noise(NoiseKind::Classic | NoiseKind::Improved, ..) => "noise",
        _ => return None,
    })
}
