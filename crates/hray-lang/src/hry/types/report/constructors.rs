//! Constructors that are not given what they take.

use super::super::infer::{Allowed, Infer, field_of};
use super::super::kind::{Head, Kind};
use super::super::scheme::Access;
use super::super::store::{Node, Ty};
use super::super::unknown::{field_synonym, near};
use super::hints::field_for;
use super::mismatch::field_words;
use crate::diagnostic::{Diagnostic, Span};
use crate::hry::ast::{Expr, ExprKind, FieldValue};
use crate::hry::library::{CONSTRUCTORS, Constructor, FieldSpec, FieldType};
use crate::hry::program::listed;
use crate::hry::sources::STANDARD_BASE;

impl<'p> Infer<'p> {
    /// Reports a field that a constructor does not have.
    pub(in crate::hry::types) fn unknown_constructor_field(
        &mut self,
        constructor: &'static Constructor,
        name: &str,
        span: Span,
        via: Option<Span>,
        is_name: bool,
    ) {
        let owner = constructor.name;
        let article = if owner == "scene" { "a scene" } else { "" };
        let whose = if article.is_empty() { format!("`{owner}`") } else { article.to_owned() };
        let label = if is_name { "no such field" } else { "the record given here has one" };
        let mut error =
            Diagnostic::error("unknown-field", format!("{whose} has no field `{name}`"), span, label);
        if let Some(via) = via.filter(|via| via.start < STANDARD_BASE) {
            error = error.with_secondary(via, format!("the record goes to `{owner}` here"));
        }
        let names: Vec<&str> = constructor.fields.iter().map(|field| field.name).collect();
        let all = format!("{whose} has {}", listed(&names));
        let near = meant_field(constructor, name);
        let error = match near {
            _ if other_measure(owner, name).is_some() => {
                error.with_note(all).with_help(other_measure(owner, name).unwrap_or_default())
            }
            Some("material") if matches!(name, "color" | "colour" | "texture" | "pigment" | "reflection" | "shine") => error
                .with_help(format!("colours and the like belong to the material: `{owner} {{ material = classic {{ color = ... }} }}`"))
                .with_note(all),
            Some(near) if is_name => {
                error.with_note(all).with_suggestion(span, near, format!("did you mean `{near}`?"))
            }
            Some(near) => error.with_note(all).with_help(format!("did you mean `{near}`?")),
            None => match elsewhere(constructor, name) {
                Some(other) => error.with_note(all).with_help(format!("`{name}` is a field of `{other}`")),
                None => error.with_help(all),
            },
        };
        self.report(error);
    }

    /// `light = point { ... }` where the field `lights` takes a list.
    pub(in crate::hry::types) fn one_of_a_list(
        &self,
        constructor: &'static Constructor,
        field: &FieldValue,
        ty: Ty,
    ) -> Option<Diagnostic> {
        let meant = meant_field(constructor, &field.name.text)?;
        let (_, spec) = constructor.field(meant)?;
        let of = Allowed::of(spec).list?;
        if self.types.store.head(ty) != self.types.store.head(of) {
            return None;
        }
        let (name, value) = (&field.name, &field.value);
        let message = format!("a scene has no field `{}`, but a list `{meant}`", name.text);
        let error = Diagnostic::error("unknown-field", message, name.span, "no such field")
            .with_secondary(value.span, format!("an element of `{meant}`"));
        let text = "a list of one is written in brackets:";
        Some(match self.quoted(value.span) {
            Some(quoted) => {
                let written = format!("{meant} = [{quoted}]");
                error.with_suggestion(name.span.to(value.span), written, text)
            }
            None => error.with_help(format!("{text} `{meant} = [ ... ]`")),
        })
    }

    /// Reports fields that have no default and are not there.
    pub(in crate::hry::types) fn missing_fields(
        &mut self,
        constructor: &'static Constructor,
        given: &[&str],
        span: Span,
        via: Option<Span>,
    ) {
        // A misspelt field was reported, so it is not missing as well.
        let unknown = given.iter().filter(|name| constructor.field(name).is_none());
        let meant: Vec<&str> = unknown.filter_map(|name| meant_field(constructor, name)).collect();
        let is_missing = |field: &&FieldSpec| {
            field.default.is_none() && !given.contains(&field.name) && !meant.contains(&field.name)
        };
        let missing: Vec<&FieldSpec> = constructor.fields.iter().filter(is_missing).collect();
        let Some(first) = missing.first() else { return };
        let owner = constructor.name;
        let names: Vec<&str> = missing.iter().map(|field| field.name).collect();
        let message = match names.as_slice() {
            [one] => format!("`{owner}` needs the field `{one}`, which is not given"),
            several => format!("`{owner}` needs the fields {}, which are not given", listed(several)),
        };
        let mut error =
            Diagnostic::error("missing-field", message, span, format!("without `{}`", first.name));
        if let Some(via) = via.filter(|via| via.start < STANDARD_BASE) {
            error = error.with_secondary(via, format!("the record goes to `{owner}` here"));
        }
        for field in &missing {
            error = error.with_note(format!("`{}` : {}. {}", field.name, Allowed::written(field), field.doc));
        }
        self.report(error.with_help(format!("for example: {}", constructor.example)));
    }

    /// `sphere 0.5`
    pub(in crate::hry::types) fn without_braces(
        &self,
        expr: &'p Expr,
        constructor: &'static Constructor,
        callee: &'p Expr,
        arguments: &[&'p Expr],
        ty: Ty,
    ) -> Diagnostic {
        let name = constructor.name;
        let message = format!("`{name}` takes a record with named fields, but this is {}", self.words(ty));
        let span = arguments.first().map_or(expr.span, |argument| argument.span);
        let error = Diagnostic::error(
            "constructor-without-braces",
            message,
            span,
            format!("found `{}`", self.show(ty)),
        )
        .with_secondary(callee.span, "its fields are given by name, in braces");
        let piped = span.end <= callee.span.start;
        if let (Some(fields), false) = (self.guessed_fields(constructor, arguments), piped) {
            let last = arguments.last().map_or(span, |argument| argument.span);
            let text = "name what you give:";
            return error.with_suggestion(span.to(last), format!("{{ {fields} }}"), text);
        }
        error.with_help(format!("for example: {}", constructor.example))
    }

    /// `radius = 0.5, center = (0, 1, 0)` for values whose types tell their fields.
    fn guessed_fields(&self, constructor: &'static Constructor, arguments: &[&'p Expr]) -> Option<String> {
        let mut used: Vec<&str> = Vec::new();
        let mut fields = Vec::new();
        for argument in arguments {
            let ty = self.notes.iter().rev().find(|(span, _)| *span == argument.span)?.1;
            let head = self.types.store.head(ty)?;
            let field = field_for(constructor, head, &used)?;
            used.push(field);
            fields.push(format!("{field} = {}", self.quoted(argument.span)?));
        }
        Some(fields.join(", "))
    }

    /// `sphere { ... } x`
    pub(in crate::hry::types) fn surplus_for_constructor(
        &self,
        constructor: &'static Constructor,
        callee: &Expr,
        arguments: &[&'p Expr],
        made: Ty,
    ) -> Diagnostic {
        let span = arguments.get(1).map_or(callee.span, |argument| argument.span);
        let message = format!("`{}` takes one record, and then is {}", constructor.name, self.words(made));
        let error = Diagnostic::error("too-many-arguments", message, span, "one too many")
            .with_secondary(callee.span, "takes one record");
        error.with_help("is a comma missing before it, or a `|>`?")
    }

    /// A value that a field of a constructor does not take.
    #[allow(clippy::too_many_arguments, reason = "each is a part of the sentence")]
    pub(in crate::hry::types) fn wrong_slot(
        &self,
        expr: Option<&'p Expr>,
        span: Span,
        ty: Ty,
        constructor: &'static Constructor,
        field: &'static FieldSpec,
        name: Option<Span>,
        via: Option<Span>,
    ) -> Diagnostic {
        let message = format!(
            "`{}` of `{}` takes {}, but this is {}",
            field.name,
            constructor.name,
            field_words(field),
            self.words(ty)
        );
        let written = Allowed::written(field);
        let label = format!("expected `{written}`, found `{}`", self.show(ty));
        let mut error = Diagnostic::error("wrong-field", message, span, label);
        if let Some(name) = name {
            error = error.with_secondary(name, format!("takes `{written}`"));
        }
        if let Some(via) = via.filter(|via| via.start < STANDARD_BASE) {
            error = error.with_secondary(via, format!("it goes to `{}` here", constructor.name));
        }
        self.slot_hint(error, expr, span, ty, field)
    }

    fn slot_hint(
        &self,
        error: Diagnostic,
        expr: Option<&'p Expr>,
        span: Span,
        ty: Ty,
        field: &'static FieldSpec,
    ) -> Diagnostic {
        let allowed = Allowed::of(field);
        let plain =
            allowed.heads.heads().find(|head| *head != Head::Number).or_else(|| allowed.heads.heads().next());
        if let Node::Function(given, _) = self.types.store.get(ty) {
            let store = &self.types.store;
            let Some(taken) = allowed.from else {
                let takes_hit = store.head(*given) == Some(Head::Hit);
                if takes_hit && matches!(field.kind, FieldType::Number | FieldType::Color | FieldType::Vec3) {
                    let help =
                        "this field has one value for the whole surface; it cannot vary from hit to hit";
                    return error.with_help(help);
                }
                return plain
                    .map_or(error.clone(), |head| self.hint(error, expr, span, ty, Ty::alone(head), None));
            };
            if !store.heads(*given).has(store.head(taken).unwrap_or(Head::Hit)) {
                return match self
                    .other_or_missing(expr, ty, taken)
                    .or_else(|| self.unfinished(expr, ty, field))
                {
                    Some(help) => error.with_help(help),
                    None => self.function_hint(error, span, ty, taken),
                };
            }
            let (parameters, result) = self.types.store.parameters(ty);
            if field.kind == FieldType::Space && parameters.len() == 3 {
                return error.with_help(
                    "it takes one point, not its coordinates one by one: `\\p -> p.x ^ 2 + p.y ^ 2 - 1`",
                );
            }
            let result_fits = self.types.store.head(result).is_some_and(|head| allowed.heads.has(head));
            if result_fits && parameters.len() > 1 {
                return self.unfinished_body(error, expr, &parameters);
            }
            if self.types.store.head(result) == Some(Head::Vec3) && field.kind == FieldType::Color {
                return error.with_help("a colour is made of a vector v by `rgb v.x v.y v.z`");
            }
            let plain = plain.map_or("something else", Head::words);
            let gives = format!("the function gives {}, but has to give {plain}", self.words(result));
            return error.with_help(gives);
        }
        if field.kind == FieldType::Space {
            return error.with_help(
                "a surface is where a function of a point is 0: `function = \\p -> length p - 1`",
            );
        }
        if field.kind == FieldType::Height {
            return error.with_help("bumps are a function: `bump = \\h -> 0.02 * sin (h.p.x * 40)`");
        }
        plain.map_or(error.clone(), |head| self.hint(error, expr, span, ty, Ty::alone(head), None))
    }

    /// For a function of several parameters: which are to be given first.
    fn other_or_missing(&self, expr: Option<&'p Expr>, ty: Ty, taken: Ty) -> Option<String> {
        let store = &self.types.store;
        let (parameters, _) = store.parameters(ty);
        let before = parameters.iter().position(|parameter| store.head(*parameter) == store.head(taken))?;
        if before == 0 {
            return None;
        }
        let (callee, arguments) = crate::hry::program::application(expr?);
        let name = self.quoted(callee.span)?;
        let names: Vec<String> = (arguments.len()..arguments.len() + before)
            .filter_map(|index| self.parameter_name(callee, index).map(|name| format!("`{name}`")))
            .collect();
        let which = if names.len() == before { format!(" ({})", names.join(", ")) } else { String::new() };
        let more = if arguments.is_empty() { "" } else { "still " };
        let count = super::super::infer::counted(before, "argument");
        Some(format!(
            "`{name}` {more}needs {count}{which} before the {}",
            if taken == Ty::HIT { "hit" } else { "direction" }
        ))
    }

    /// `\\h -> checker white black`: the body is a function itself.
    fn unfinished_body(&self, error: Diagnostic, expr: Option<&'p Expr>, parameters: &[Ty]) -> Diagnostic {
        let missing = parameters.len() - 1;
        let is_hit = parameters.get(1).is_some_and(|ty| self.types.store.head(*ty) == Some(Head::Hit));
        if let (Some(ExprKind::Lambda { parameters: names, body }), 1, true) =
            (expr.map(|expr| &expr.kind), missing, is_hit)
            && let (Some(name), ExprKind::Apply { .. } | ExprKind::Name(_)) =
                (names.first().and_then(|name| self.quoted(name.span)), &body.kind)
        {
            let text = "what varies over a surface still needs the hit:";
            return error.with_suggestion(Span::at(body.span.end), format!(" {name}"), text);
        }
        let shown: Vec<String> =
            parameters.iter().skip(1).map(|ty| format!("`{}`", self.show(*ty))).collect();
        let count = super::super::infer::counted(missing, "argument");
        error.with_help(format!("the body still needs {count} ({}) to be a value", shown.join(", ")))
    }

    /// For a call that lacks arguments and would then be what the field takes.
    fn unfinished(&self, expr: Option<&'p Expr>, ty: Ty, field: &'static FieldSpec) -> Option<String> {
        let (callee, arguments) = crate::hry::program::application(expr?);
        let store = &self.types.store;
        let (parameters, result) = store.parameters(ty);
        let fits = store.head(result).is_some_and(|head| Allowed::of(field).heads.has(head));
        let name = self.quoted(callee.span)?;
        let is_varying = parameters.iter().any(|parameter| store.head(*parameter) == Some(Head::Hit));
        let takes_number = parameters.first().is_some_and(|first| store.head(*first) == Some(Head::Number));
        if !fits || is_varying || arguments.is_empty() && !takes_number {
            return None;
        }
        let shown: Vec<String> = parameters.iter().map(|ty| format!("`{}`", self.show(*ty))).collect();
        let count = super::super::infer::counted(parameters.len(), "argument");
        let call = self.quoted(expr?.span)?;
        let varying = if name != "rgb"
            && field.varies
            && parameters.len() == 1
            && store.head(*parameters.first()?) == Some(Head::Number)
        {
            format!("; to let it vary over the surface: `\\h -> {call} h.p.y`")
        } else {
            String::new()
        };
        let more = if arguments.is_empty() { "" } else { "still " };
        Some(format!("`{name}` {more}needs {count} ({}){varying}", shown.join(", ")))
    }

    fn function_hint(&self, error: Diagnostic, span: Span, ty: Ty, taken: Ty) -> Diagnostic {
        let first = self.types.store.parameters(ty).0.first().copied();
        let demanded = first.map(|first| self.demanded_fields(first)).unwrap_or_default();
        let foreign = demanded.iter().find(|name| field_of(Head::Hit, name, Access::Read).is_none());
        let only_records = first.is_some_and(|first| {
            !self.types.store.heads(first).has(Head::Vec2) && !self.types.store.heads(first).has(Head::Vec3)
        });
        if let (Some(foreign), Ty::HIT, true) = (foreign, taken, only_records) {
            let help = format!(
                "the function reads the field `{foreign}`, but a hit has `p`, `world`, `normal`, `uv` and `time`"
            );
            return error.with_help(help);
        }
        let heads = self.types.store.parameters(ty).0.first().map(|first| self.types.store.heads(*first));
        let likely =
            [Head::Vec3, Head::Vec2].into_iter().find(|head| heads.is_some_and(|heads| heads.has(*head)));
        match (likely.or_else(|| heads.and_then(Kind::only)), taken) {
            (Some(Head::Vec3), Ty::HIT) => self.place_of_hit(error, span, "h.p", "the function takes a place; to give it the place of the hit:"),
            (Some(Head::Vec2), Ty::HIT) => {
                self.place_of_hit(error, span, "h.uv", "the function takes a vector of two; to give it the surface coordinates of the hit:")
            }
            (Some(Head::Hit), _) => error.with_help("what lies behind everything has no hit: the function gets the direction one looks in, a vector, as in `background = \\d -> mix white #4f86c6 d.y`"),
            (Some(first), Ty::HIT) => error.with_help(format!("a function for this field takes a hit, and not {}", first.words())),
            _ => error,
        }
    }

    fn place_of_hit(&self, error: Diagnostic, span: Span, place: &str, text: &str) -> Diagnostic {
        match self.quoted(span) {
            Some(quoted) => {
                let plain = quoted.chars().all(|c| c.is_alphanumeric() || "_' .#".contains(c));
                let function = if plain { quoted.to_owned() } else { format!("({quoted})") };
                error.with_suggestion(span, format!("\\h -> {function} {place}"), text)
            }
            None => error.with_help(format!("{text} `\\h -> f {place}`")),
        }
    }

    /// A `scene` that is no scene.
    pub(in crate::hry::types) fn wrong_scene(&self, body: &'p Expr, ty: Ty) -> Diagnostic {
        let message = format!(
            "`scene` is a record, or a function from the time in seconds to one, but this is {}",
            self.words(ty)
        );
        let error =
            Diagnostic::error("wrong-scene", message, body.span, format!("found `{}`", self.show(ty)));
        match (self.types.store.get(ty), self.quoted(body.span)) {
            (Node::Alone(Head::Shape), Some(text)) => {
                error.with_suggestion(body.span, format!("{{ objects = [{text}] }}"), "shapes are the objects of a scene:")
            }
            (Node::List(of), Some(text)) if self.types.store.head(*of) == Some(Head::Shape) => {
                error.with_suggestion(body.span, format!("{{ objects = {text} }}"), "shapes are the objects of a scene:")
            }
            _ => error.with_help("for example: scene = { objects = [ sphere {} ], lights = [ point { position = (3, 4, 5) } ] }"),
        }
    }
}

/// The field that was probably meant.
fn meant_field(constructor: &'static Constructor, name: &str) -> Option<&'static str> {
    near(name, constructor.fields.iter().map(|field| field.name)).or_else(|| field_synonym(constructor, name))
}

/// What to do about a field that another program measures differently.
fn other_measure(owner: &str, name: &str) -> Option<&'static str> {
    Some(match (owner, name.to_lowercase().as_str()) {
        ("sphere" | "cylinder" | "disc", "diameter") => {
            "the radius is half of the diameter: `radius = d / 2`"
        }
        ("classic", "roughness") => {
            "`shine` is large where a surface is smooth: 10 is a broad and dull highlight, 200 a small and sharp one"
        }
        ("box", "width" | "height" | "depth" | "length") => {
            "the three sides are one vector: `size = (1, 2, 3)`"
        }
        ("scene", "width" | "height") => "width and height are one vector: `size = (800, 600)`",
        ("box", "min" | "max" | "min_corner" | "max_corner") => {
            "a box is given by its sides and its centre: `size = (2, 2, 2), center = (0, 1, 0)`"
        }
        ("plane", "x" | "y" | "z" | "distance" | "d") => {
            "a plane has a direction at right angles to it and a distance along that: `normal = up, offset = -1`"
        }
        ("triangles", "vertices") => "the vertices are called `points`",
        ("triangles", "indices" | "triangles") => {
            "the corners of each face are in `faces`: `faces = [[0, 1, 2]]`"
        }
        _ => return None,
    })
}

/// Another constructor, of the same kind of thing, that has such a field.
fn elsewhere(constructor: &Constructor, name: &str) -> Option<&'static str> {
    let others =
        CONSTRUCTORS.iter().filter(|other| other.name != constructor.name && other.field(name).is_some());
    let mut others: Vec<&Constructor> = others.collect();
    others.sort_by_key(|other| other.makes != constructor.makes);
    others.first().map(|other| other.name)
}
