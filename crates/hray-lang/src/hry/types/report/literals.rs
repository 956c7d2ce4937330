//! Numbers that stand there in another unit than the library's functions take: degrees, percent, bytes.

use super::super::infer::Infer;
use super::super::names::Meaning;
use super::ranges::constant;
use crate::diagnostic::Diagnostic;
use crate::hry::ast::{Expr, ExprKind};
use crate::hry::program::Global;

/// Which argument of a function of the library is an angle.
const ANGLES: &[(&str, usize)] =
    &[("cos", 0), ("hsl", 0), ("oklch", 2), ("rotate", 1), ("sin", 0), ("tan", 0)];
/// Which arguments are shares from 0 to 1.
const SHARES: &[(&str, &[usize])] = &[("hsl", &[1, 2]), ("oklch", &[0])];
/// An angle from here on, more than a turn, is hardly meant in radians.
const LARGEST_ANGLE: f64 = 7.0;
/// A component from here on is hardly meant as linear light.
const LARGEST_LIGHT: f64 = 16.0;

impl Infer<'_> {
    /// Warns of arguments in another unit, as far as they stand there as numbers.
    pub(in crate::hry::types) fn odd_literals(&mut self, callee: &Expr, arguments: &[&Expr]) {
        let ExprKind::Name(name) = &callee.kind else { return };
        if !self.is_of_library(callee) {
            return;
        }
        if let Some((_, place)) = ANGLES.iter().find(|(function, _)| **function == **name)
            && let Some(argument) = arguments.get(*place)
        {
            self.degrees(name, argument);
        }
        if let Some((_, places)) = SHARES.iter().find(|(function, _)| **function == **name) {
            for argument in places.iter().filter_map(|place| arguments.get(*place)) {
                self.percent(name, argument);
            }
        }
        if &**name == "rgb" {
            self.bytes(callee, arguments);
        }
    }

    fn is_of_library(&self, callee: &Expr) -> bool {
        match self.names.uses.get(&callee.span.start) {
            Some(Meaning::Global(Global::Native(_))) => true,
            Some(Meaning::Global(Global::Definition { module, .. })) => {
                self.modules.get(*module).is_some_and(|module| module.is_standard)
            }
            _ => false,
        }
    }

    fn degrees(&mut self, name: &str, argument: &Expr) {
        let Some(value) = constant(argument) else { return };
        let text = self.text(argument.span).to_owned();
        if value.abs() < LARGEST_ANGLE || !text.ends_with(|c: char| c.is_ascii_digit()) {
            return;
        }
        let turns = (value.abs() / std::f64::consts::TAU * 10.0).round() / 10.0;
        let message = format!("`{name}` takes an angle in radians, of which {text} is {turns} turns");
        let warning = Diagnostic::warning("angle-unit", message, argument.span, "surely meant in degrees");
        self.report(warning.with_suggestion(argument.span, format!("{text}deg"), "in degrees:"));
    }

    fn percent(&mut self, name: &str, argument: &Expr) {
        let Some(value) = constant(argument) else { return };
        let text = self.text(argument.span).to_owned();
        if value <= 1.0 || !text.ends_with(|c: char| c.is_ascii_digit()) {
            return;
        }
        let message = format!("this argument of `{name}` goes from 0 to 1, but is {text}");
        let warning = Diagnostic::warning("share-range", message, argument.span, "surely meant in percent");
        self.report(warning.with_suggestion(argument.span, format!("{text}%"), "in percent:"));
    }

    /// `rgb 255 128 0`
    fn bytes(&mut self, callee: &Expr, arguments: &[&Expr]) {
        let values: Option<Vec<f64>> = arguments.iter().map(|argument| constant(argument)).collect();
        let Some([r, g, b]) = values.as_deref() else { return };
        let (components, Some(last)) = ([*r, *g, *b], arguments.last()) else { return };
        let is_byte = |value: &f64| value.fract() == 0.0 && (0.0..=255.0).contains(value);
        if !components.iter().all(is_byte) || components.iter().all(|value| *value < LARGEST_LIGHT) {
            return;
        }
        let span = callee.span.to(last.span);
        // `rgb 200 100 50 / 255` divides what it makes.
        let file = self.sources.file(span.end);
        let rest = file.and_then(|file| file.text.get(span.end - file.base..)).unwrap_or("");
        if rest.trim_start().starts_with(['/', '*']) {
            return;
        }
        let message = "`rgb` takes red, green and blue as linear light from 0 to 1, not from 0 to 255";
        let [r, g, b] = components.map(|value| value as u8);
        let color = format!("#{r:02x}{g:02x}{b:02x}");
        let warning = Diagnostic::warning("color-scale", message, span, "far brighter than white");
        self.report(warning.with_suggestion(span, color, "the colour of these bytes on a display:"));
    }
}
