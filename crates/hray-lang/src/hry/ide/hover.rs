//! What is said of the text under the pointer.

use super::analysis::{Analysis, FileId};
use super::colors::{encode, hex};
use super::context::{span_of, token_at};
use super::describe;
use crate::diagnostic::Span;
use crate::hry::assets::resolve;
use crate::hry::ast::ExprKind;
use crate::hry::syntax::{SyntaxKind, SyntaxToken, parse};
use crate::hry::types::Target;

/// What is said of a place.
#[derive(Clone, Debug, PartialEq)]
pub struct Hover {
    /// What it is about.
    pub span: Span,
    /// Its type, or what else it is, as hry writes it; may be empty.
    pub code: String,
    /// The colour that it is, as displays encode it (sRGB), 0 to 1.
    pub color: Option<[f64; 3]>,
    /// Its documentation, as Markdown; may be empty.
    pub text: String,
}

impl Analysis {
    /// What is to be said of the text at an offset.
    #[must_use]
    pub fn hover(&self, offset: usize) -> Option<Hover> {
        self.hry.as_ref()?;
        let root = parse(&self.text, 0).root();
        let token = token_at(&root, offset)?;
        let span = span_of(token.text_range());
        let plain = Hover { span, code: String::new(), color: None, text: String::new() };
        match token.kind() {
            SyntaxKind::Name => self.hover_name(&token, plain),
            SyntaxKind::Color => self.hover_color(plain),
            SyntaxKind::Text if token.parent().is_some_and(|parent| parent.kind() == SyntaxKind::Import) => {
                self.hover_import(&token, plain)
            }
            SyntaxKind::TypeName => type_text(token.text()).map(|text| Hover { text: text.into(), ..plain }),
            kind if kind.is_trivia() => None,
            _ => self.hover_type(offset, plain),
        }
    }

    fn hover_name(&self, token: &SyntaxToken, plain: Hover) -> Option<Hover> {
        let (_, checked) = self.hry.as_ref()?;
        let (span, name) = (plain.span, token.text());
        match self.target(span.start) {
            Some(Target::Global(global)) => {
                let mut text = describe::documentation(self, global);
                if let Some(definition) = describe::definition(self, global)
                    && let Some(FileId::Own(path)) = self.place(definition.span).map(|place| place.file)
                    && path != self.path
                {
                    text = format!("{text}\n\nFrom `{path}`.").trim().to_owned();
                }
                let color = self.constant_global(global, 0).map(|linear| linear.map(encode));
                Some(Hover { code: describe::signature(self, name, global), color, text, ..plain })
            }
            Some(Target::Field(constructor, field)) => {
                let code = format!("{name} : {}", describe::field_type(field));
                Some(Hover { code, text: describe::field_text(constructor, field), ..plain })
            }
            Some(Target::Local(_)) | None => {
                let (_, ty) = checked.type_at(span.start)?;
                Some(Hover { code: format!("{name} : {ty}"), ..plain })
            }
        }
    }

    fn hover_color(&self, plain: Hover) -> Option<Hover> {
        let color = self.colors().into_iter().find(|color| color.span == plain.span)?.color;
        Some(Hover { code: format!("{} : Color", hex(color)), color: Some(color), ..plain })
    }

    fn hover_import(&self, token: &SyntaxToken, plain: Hover) -> Option<Hover> {
        let (program, _) = self.hry.as_ref()?;
        let path = resolve(&self.path, token.text().trim_matches('"'))?;
        let module = program.modules.iter().find(|module| !module.is_standard && module.path == path)?;
        let names = module.syntax.definitions.iter().filter_map(|definition| definition.name());
        let names: Vec<String> = names.map(|name| format!("`{}`", name.text)).collect();
        Some(Hover { code: format!("{path:?}"), text: format!("Defines {}.", names.join(", ")), ..plain })
    }

    /// The type of the expression around a token, and of a call of a colour the colour.
    fn hover_type(&self, offset: usize, plain: Hover) -> Option<Hover> {
        let (program, checked) = self.hry.as_ref()?;
        let (span, ty) = checked.type_at(offset)?;
        let mut color = None;
        for definition in program
            .root()?
            .syntax
            .definitions
            .iter()
            .filter(|d| d.span.start <= offset && offset <= d.span.end)
        {
            definition.body.walk(&mut |expr| {
                if expr.span == span && matches!(expr.kind, ExprKind::Apply { .. }) {
                    color = self.constant(expr, false, 0).map(|linear| linear.map(encode));
                }
            });
        }
        Some(Hover { span, code: ty, color, ..plain })
    }
}

/// What the types of the language are.
pub(super) fn type_text(name: &str) -> Option<&'static str> {
    Some(match name {
        "Number" => "A number. Angles are numbers in radians: `180deg`.",
        "Bool" => "`true` or `false`.",
        "Text" => "A text: `\"...\"`.",
        "Vec2" => "Two numbers: `(x, y)`.",
        "Vec3" => "Three numbers: `(x, y, z)`.",
        "Color" => "A colour, as linear light: `#rrggbb`, `rgb r g b`.",
        "Shape" => "A shape, with its material.",
        "Material" => "What a shape is made of.",
        "Light" => "A light.",
        "Camera" => "Where a picture is taken from.",
        "Image" => "An image from a file: `image \"wood.png\"`.",
        "Hit" => {
            "A point on a surface: `p` (in the shape's own coordinates), `world`, `normal`, `uv`, `time`."
        }
        "Integrator" => "How light is followed: `whitted`, `classic2005`.",
        "Encoding" => "How colours are written to a picture: `srgb`, `raw`.",
        _ => return None,
    })
}

/// The names of all types.
pub(super) const TYPES: &[&str] = &[
    "Number",
    "Bool",
    "Text",
    "Vec2",
    "Vec3",
    "Color",
    "Shape",
    "Material",
    "Light",
    "Camera",
    "Image",
    "Hit",
    "Integrator",
    "Encoding",
];
