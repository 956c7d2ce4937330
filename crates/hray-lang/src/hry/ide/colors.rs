//! Colours in a text: literals, and calls of `rgb` and `hsl` with numbers.

use super::analysis::{Analysis, FileId};
use super::context::{span_of, token_at};
use crate::diagnostic::Span;
use crate::hry::ast::{Expr, ExprKind, UnaryOperator};
use crate::hry::library::Native;
use crate::hry::program::{Global, application};
use crate::hry::syntax::{SyntaxKind, parse};
use crate::hry::types::Target;

/// How far names are followed that are only other names for colours.
const FOLLOWED: usize = 16;

/// A colour in the text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ColorPlace {
    /// Where it is written.
    pub span: Span,
    /// Red, green and blue as displays encode them (sRGB), 0 to 1.
    pub color: [f64; 3],
}

/// A way to write a colour.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Presentation {
    /// What it looks like.
    pub label: String,
    /// What is put in the place of the old.
    pub text: String,
}

impl Analysis {
    /// The colours that are written in the file, in order.
    #[must_use]
    pub fn colors(&self) -> Vec<ColorPlace> {
        let Some((program, _)) = &self.hry else { return Vec::new() };
        let Some(root) = program.root() else { return Vec::new() };
        let mut found = Vec::new();
        for definition in &root.syntax.definitions {
            definition.body.walk(&mut |expr| {
                let color = match &expr.kind {
                    ExprKind::Color(bytes) => Some(bytes.map(|byte| f64::from(byte) / 255.0)),
                    ExprKind::Apply { .. } => self.call(expr, false).map(|linear| linear.map(encode)),
                    _ => None,
                };
                let span = without_brackets(expr.span, &self.text);
                if let (Some(color), false) = (color, span.is_empty()) {
                    found.push(ColorPlace { span, color });
                }
            });
        }
        found.sort_by_key(|color| color.span);
        found.dedup_by_key(|color| color.span);
        found
    }

    /// How a colour, encoded, could be written at a place where there is one already.
    #[must_use]
    pub fn presentations(&self, span: Span, color: [f64; 3]) -> Vec<Presentation> {
        let color = color.map(|part| if part.is_finite() { part.clamp(0.0, 1.0) } else { 0.0 });
        let bare = |text: String| Presentation { label: text.clone(), text };
        let wrap = self.needs_brackets(span);
        let call = |text: String| {
            let inside = if wrap { format!("({text})") } else { text.clone() };
            Presentation { label: text, text: inside }
        };
        let [r, g, b] = color.map(|part| short(decode(part), 4));
        let (h, s, l) = hsl(color);
        vec![
            bare(hex(color)),
            call(format!("rgb {r} {g} {b}")),
            call(format!("hsl {}deg {} {}", short(h, 1), short(s, 3), short(l, 3))),
        ]
    }

    /// Whether a call at that place would need brackets around it.
    fn needs_brackets(&self, span: Span) -> bool {
        let root = parse(&self.text, 0).root();
        let Some(literal) = token_at(&root, span.start + 1).and_then(|token| token.parent()) else {
            return false;
        };
        let around = [SyntaxKind::ApplyExpr, SyntaxKind::FieldExpr, SyntaxKind::UnaryExpr];
        let is_literal = literal.kind() == SyntaxKind::Literal && span_of(literal.text_range()) == span;
        is_literal && literal.parent().is_some_and(|parent| around.contains(&parent.kind()))
    }

    /// The colour, as linear light, that an expression always is.
    pub(super) fn constant(&self, expr: &Expr, in_library: bool, followed: usize) -> Option<[f64; 3]> {
        match &expr.kind {
            ExprKind::Color(bytes) => Some(bytes.map(|byte| decode(f64::from(byte) / 255.0))),
            ExprKind::Apply { .. } => self.call(expr, in_library),
            ExprKind::Name(_) if followed < FOLLOWED => {
                self.constant_global(self.global(expr, in_library)?, followed + 1)
            }
            _ => None,
        }
    }

    /// The colour, as linear light, that a definition is.
    pub(super) fn constant_global(&self, global: Global, followed: usize) -> Option<[f64; 3]> {
        let definition = super::describe::definition(self, global)?;
        let in_library = matches!(self.place(definition.span)?.file, FileId::Library(_));
        definition.parameters.is_empty().then(|| self.constant(&definition.body, in_library, followed))?
    }

    /// What a name means where it is no local.
    fn global(&self, expr: &Expr, in_library: bool) -> Option<Global> {
        let ExprKind::Name(name) = &expr.kind else { return None };
        if in_library {
            return crate::hry::program::standard().names.get(name).copied();
        }
        match self.hry.as_ref()?.1.definition_at(expr.span.start)? {
            Target::Global(global) => Some(global),
            _ => None,
        }
    }

    /// `rgb 1 0 0`, `hsl 0deg 1 0.5`, `grey 0.5`.
    fn call(&self, expr: &Expr, in_library: bool) -> Option<[f64; 3]> {
        let (callee, arguments) = application(expr);
        let ExprKind::Name(name) = &callee.kind else { return None };
        let numbers: Vec<f64> = arguments.iter().map(|argument| number(argument)).collect::<Option<_>>()?;
        let color = match (&**name, numbers.as_slice()) {
            ("rgb", [r, g, b]) => [*r, *g, *b],
            ("hsl", [h, s, l]) => from_hsl(*h, *s, *l).map(decode),
            ("grey", [v]) => [*v; 3],
            _ => return None,
        };
        let is_own = match self.global(callee, in_library)? {
            Global::Native(native) => native.native == Native::Rgb,
            global => matches!(
                self.place(super::describe::definition(self, global)?.span)?.file,
                FileId::Library(_)
            ),
        };
        is_own.then_some(color)
    }
}

/// A call's place without the brackets around it; empty where it is not in the text.
fn without_brackets(span: Span, text: &str) -> Span {
    let mut inner = span.text(text);
    while let Some(stripped) = inner.strip_prefix('(').and_then(|rest| rest.strip_suffix(')')) {
        inner = stripped.trim();
    }
    let start = span.text(text).find(inner).map_or(span.start, |at| span.start + at);
    Span::new(start, start + inner.len())
}

fn number(expr: &Expr) -> Option<f64> {
    match &expr.kind {
        ExprKind::Number(number) => Some(*number),
        ExprKind::Unary { operator: UnaryOperator::Negate, operand } => match &operand.kind {
            ExprKind::Number(number) => Some(-number),
            _ => None,
        },
        _ => None,
    }
}

/// `#rrggbb` of an encoded colour.
pub(super) fn hex(color: [f64; 3]) -> String {
    let [r, g, b] = color.map(|part| (part.clamp(0.0, 1.0) * 255.0).round() as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// A number with a few digits after its point, and none that say nothing.
fn short(number: f64, digits: usize) -> String {
    let text = format!("{number:.digits$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".into() } else { text.into() }
}

/// Encoded sRGB of linear light (IEC 61966-2-1).
pub(super) fn encode(v: f64) -> f64 {
    let v = v.clamp(0.0, 1.0);
    let encoded = if v <= 0.003_130_8 { v * 12.92 } else { 1.055 * libm::pow(v, 1.0 / 2.4) - 0.055 };
    encoded.clamp(0.0, 1.0)
}

/// Linear light of encoded sRGB.
fn decode(v: f64) -> f64 {
    if v <= 0.04045 { v / 12.92 } else { libm::pow((v + 0.055) / 1.055, 2.4) }
}

/// Hue in degrees, saturation and lightness of an encoded colour, as in CSS.
fn hsl([r, g, b]: [f64; 3]) -> (f64, f64, f64) {
    let (most, least) = (r.max(g).max(b), r.min(g).min(b));
    let (range, lightness) = (most - least, (most + least) / 2.0);
    if range == 0.0 {
        return (0.0, 0.0, lightness);
    }
    let saturation = range / (1.0 - (2.0 * lightness - 1.0).abs());
    let hue = if most == r {
        ((g - b) / range).rem_euclid(6.0)
    } else if most == g {
        (b - r) / range + 2.0
    } else {
        (r - g) / range + 4.0
    };
    (hue * 60.0, saturation, lightness)
}

/// The encoded colour of a hue in radians, a saturation and a lightness, as in CSS.
fn from_hsl(hue: f64, saturation: f64, lightness: f64) -> [f64; 3] {
    let a = saturation * lightness.min(1.0 - lightness);
    [0.0, 8.0, 4.0].map(|n| {
        let k = (n + hue.to_degrees() / 30.0).rem_euclid(12.0);
        lightness - a * (k - 3.0).min(9.0 - k).clamp(-1.0, 1.0)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_survive_their_other_forms() {
        for color in
            [[0.0, 0.0, 0.0], [1.0, 1.0, 1.0], [1.0, 0.6, 0.2], [0.12, 0.91, 0.33], [0.2, 0.31, 0.92]]
        {
            let (h, s, l) = hsl(color);
            let back = from_hsl(h.to_radians(), s, l);
            assert_eq!(hex(back), hex(color));
            assert_eq!(hex(color.map(decode).map(encode)), hex(color));
        }
        assert_eq!(
            (short(0.5, 4), short(1.0, 4), short(-0.000_01, 3), short(210.0, 0)),
            ("0.5".into(), "1".into(), "0".into(), "210".into())
        );
    }
}
