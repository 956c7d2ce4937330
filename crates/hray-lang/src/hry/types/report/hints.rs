//! What to do about a type that is not the expected one.

use super::super::infer::{Infer, Why, counted};
use super::super::kind::{Head, Kind};
use super::super::store::{Node, Ty};
use crate::diagnostic::{Diagnostic, Span};
use crate::hry::ast::{Expr, ExprKind};
use crate::hry::library::{CONSTRUCTORS, Constructor, FieldType};
use crate::hry::program::{Global, application};
use crate::hry::types::names::Meaning;
use crate::hry::types::scheme::Binding;
use std::sync::Arc;

impl<'p> Infer<'p> {
    /// Adds what to do, where that can be told from the types.
    pub(super) fn hint(
        &self,
        error: Diagnostic,
        expr: Option<&'p Expr>,
        span: Span,
        found: Ty,
        expected: Ty,
        why: Option<Why<'p>>,
    ) -> Diagnostic {
        let store = &self.types.store;
        let expected_head = store.head(expected);
        if let (Some(expr), Node::Function(from, to)) = (expr, store.get(found))
            && expected_head != Some(Head::Function)
        {
            return self.missing_arguments(error, expr, found, (*from, *to), expected, why);
        }
        if let (Node::Function(given, _), Node::Function(taken, _)) = (store.get(found), store.get(expected))
        {
            return self.other_parameter(error, span, (*given, *taken), found, expected);
        }
        let varies =
            |ty: Ty| matches!(store.get(ty), Node::Function(from, _) if store.head(*from) == Some(Head::Hit));
        if matches!(why, Some(Why::Branch { .. } | Why::Arm { .. } | Why::Item { .. }))
            && varies(found) != varies(expected)
        {
            return error.with_help(
                "one of them varies over the surface, and is a function of the hit; give it the hit, inside a function of \
                 one: `\\h -> if c then checker white black h else blue`",
            );
        }
        if let (Node::List(of), Some(found)) = (store.get(expected), store.head(found))
            && store.head(*of) == Some(found)
        {
            if matches!(why, Some(Why::Field { field, .. }) if field.name == "faces") {
                return error.with_help("each face is a list of its own: `faces = [[0, 1, 2]]`");
            }
            return self.suggest(
                error,
                span,
                |text| format!("[{text}]"),
                "a list of one is written in brackets:",
            );
        }
        if let (Node::Record(expected_fields), Some(Why::Argument { callee, .. })) =
            (store.get(expected), why)
        {
            return self.record_of_a_function(error, callee, found, expected_fields);
        }
        if let (Node::List(of), Some(vector @ (Head::Vec2 | Head::Vec3))) = (store.get(found), expected_head)
            && store.heads(*of).has(Head::Number)
        {
            return self.list_for_vector(error, expr, span, vector);
        }
        if let (Node::Record(_), Some(vector @ (Head::Vec2 | Head::Vec3))) = (store.get(found), expected_head)
        {
            return self.record_for_vector(error, expr, span, vector);
        }
        if let (Node::List(of), Some(expected)) = (store.get(found), expected_head)
            && store.head(*of) == Some(expected)
        {
            if let Some((two, text)) = self.two_of_a_list(expr, why) {
                return error.with_suggestion(span, two, text);
            }
            return self.list_for_one(error, expected, why);
        }
        if let (Some(why), Node::Rigid { .. }) = (why, store.get(expected)) {
            return self.rigid_hint(error, found, expected, why);
        }
        if let Node::Rigid { name, .. } = store.get(found) {
            let help = format!(
                "the annotation promises to take any type `{name}`; say there which type it really is"
            );
            return error.with_help(help);
        }
        if let (Node::List(of), Some(Kind::PLACEABLE)) = (store.get(found), store.kind(expected))
            && !store.heads(*of).meet(Kind::PLACEABLE).is_empty()
        {
            return self.list_to_place(error, expr, span, *of, why);
        }
        if let (Some(Head::Number), Some(kind)) = (store.head(found), store.kind(expected))
            && kind == Kind::PLACEABLE
        {
            return error.with_help("what is moved, turned or scaled comes last: `shape |> scale 2`");
        }
        match (store.head(found), expected_head) {
            (Some(found), Some(expected)) => self.hint_of_heads(error, expr, span, found, expected, why),
            _ => error,
        }
    }

    fn suggest(
        &self,
        error: Diagnostic,
        span: Span,
        with: impl Fn(&str) -> String,
        text: &str,
    ) -> Diagnostic {
        match self.quoted(span) {
            Some(quoted) => {
                let replacement = with(quoted);
                error.with_suggestion(span, replacement, text)
            }
            None => error.with_help(text),
        }
    }

    /// Something is given where an annotation says that it may be anything.
    fn rigid_hint(&self, error: Diagnostic, found: Ty, expected: Ty, why: Why<'p>) -> Diagnostic {
        let name = self.show(expected);
        if let Why::Argument { callee, .. } = why
            && self.is_recursive(callee)
        {
            let function = self.quoted(callee.span).unwrap_or("it");
            return error.with_help(format!(
                    "inside its own definition `{function}` has one type, and cannot be used for another than `{name}`"
                ));
        }
        let found = self.show(found);
        error.with_help(format!(
            "the annotation promises that this works whatever type `{name}` is; if it is always `{found}`, say so there"
        ))
    }

    /// Whether a name means a definition that is not known for every use yet: one that uses itself.
    fn is_recursive(&self, callee: &Expr) -> bool {
        let binding = match self.names.uses.get(&callee.span.start) {
            Some(Meaning::Global(Global::Definition { module, index })) => {
                self.types.definitions.get(*module).and_then(|m| m.get(*index))
            }
            Some(Meaning::Local(local))
                if self.names.locals.get(*local).is_some_and(|local| local.is_let) =>
            {
                self.locals.get(*local).and_then(Option::as_ref)
            }
            _ => None,
        };
        matches!(binding, Some(Binding::Mono(_)))
    }

    fn grey(
        &self,
        error: Diagnostic,
        expr: Option<&'p Expr>,
        span: Span,
        why: Option<Why<'p>>,
    ) -> Diagnostic {
        let is_plain = expr.is_some_and(|expr| matches!(expr.kind, ExprKind::Number(_) | ExprKind::Name(_)));
        if is_plain {
            let text = "a grey of that strength:";
            return self.suggest(error, span, |n| in_place(format!("grey {n}"), why), text);
        }
        error.with_help("a grey of strength n is `grey n`")
    }

    /// A number stands first where colours follow.
    fn grey_before(&self, error: Diagnostic, why: Option<Why<'p>>) -> Diagnostic {
        let Some(Why::Branch { first } | Why::Arm { first } | Why::Item { first }) = why else {
            return error;
        };
        let text = "if the number is meant as a grey of that strength:";
        match self.quoted(first) {
            Some(n) if n.chars().all(|c| c.is_alphanumeric() || matches!(c, '.' | '_')) => {
                error.with_suggestion(first, format!("grey {n}"), text)
            }
            _ => error.with_help("a grey of strength n, as a colour, is `grey n`"),
        }
    }

    fn shown(
        &self,
        error: Diagnostic,
        expr: Option<&'p Expr>,
        span: Span,
        why: Option<Why<'p>>,
    ) -> Diagnostic {
        let with = |text: &str| expr.map_or_else(|| format!("({text})"), |expr| self.as_argument(expr, text));
        self.suggest(
            error,
            span,
            |n| in_place(format!("show {}", with(n)), why),
            "`show` turns a number into text:",
        )
    }

    /// A list is given to a transform, which moves one thing.
    fn list_to_place(
        &self,
        error: Diagnostic,
        expr: Option<&'p Expr>,
        span: Span,
        of: Ty,
        why: Option<Why<'p>>,
    ) -> Diagnostic {
        let name = match why {
            Some(Why::Argument { callee, .. }) => self.quoted(callee.span).unwrap_or("translate"),
            _ => "translate",
        };
        let each = format!("to change each of them: `list |> map ({name} ...)`");
        if self.types.store.head(of) != Some(Head::Shape) {
            return error.with_help(each);
        }
        let grouped = |text: &str| {
            let list = expr.map_or_else(|| format!("({text})"), |expr| self.as_argument(expr, text));
            format!("group {list}")
        };
        let piped = matches!(why, Some(Why::Argument { callee, .. }) if span.end <= callee.span.start);
        let with = |text: &str| if piped { grouped(text) } else { format!("({})", grouped(text)) };
        self.suggest(error.with_note(each), span, with, "to make one shape of them, which moves as a whole:")
    }

    /// `wood { light = brown }`, `tiles white black`: a function of a record gets something else.
    fn record_of_a_function(
        &self,
        error: Diagnostic,
        callee: &Expr,
        found: Ty,
        expected: &[(Arc<str>, Ty)],
    ) -> Diagnostic {
        let name = self.quoted(callee.span).unwrap_or("f");
        let given: &[(Arc<str>, Ty)] = match self.types.store.get(found) {
            Node::Record(fields) => fields,
            _ => &[],
        };
        let is_given = |field: &str| given.iter().any(|(name, _)| **name == *field);
        let missing: Vec<&str> =
            expected.iter().map(|(name, _)| &**name).filter(|name| !is_given(name)).collect();
        let mut error = error;
        error.notes.clear();
        if !given.is_empty() && !missing.is_empty() {
            error = error.with_note(format!("missing: {}", crate::hry::program::listed(&missing)));
        }
        let surplus: Vec<&str> = given
            .iter()
            .map(|(name, _)| &**name)
            .filter(|name| !expected.iter().any(|(other, _)| **other == **name))
            .collect();
        if !surplus.is_empty() {
            error = error.with_note(format!("not known: {}", crate::hry::program::listed(&surplus)));
        }
        let fields: Vec<String> =
            expected.iter().map(|(name, ty)| format!("{name} = {}", self.sample(*ty))).collect();
        error.with_help(format!("all fields are needed, for example: `{name} {{ {} }}`", fields.join(", ")))
    }

    /// A value of a type.
    fn sample(&self, ty: Ty) -> &'static str {
        match self.types.store.head(ty) {
            Some(Head::Number) => "0.5",
            Some(Head::Color) => "white",
            Some(Head::Vec3) => "(0, 1, 0)",
            Some(Head::Vec2) => "(1, 1)",
            Some(Head::Bool) => "true",
            _ => "...",
        }
    }

    /// `difference [a, b]`
    fn two_of_a_list(&self, expr: Option<&'p Expr>, why: Option<Why<'p>>) -> Option<(String, &'static str)> {
        let (Some(Why::Argument { callee, index: 0, .. }), ExprKind::List(items)) = (why, &expr?.kind) else {
            return None;
        };
        let name = self.quoted(callee.span)?;
        let ("union" | "intersection" | "difference") = name else { return None };
        let words: Option<Vec<String>> =
            items.iter().map(|item| Some(self.as_argument(item, self.quoted(item.span)?))).collect();
        let words = words.filter(|words| words.len() >= 2)?;
        let (last, before) = words.split_last()?;
        let first = before.iter().cloned().reduce(|all, next| format!("({name} {all} {next})"))?;
        Some((format!("{first} {last}"), "it takes two shapes, one after the other:"))
    }

    /// `[0, 1, 0]` for `(0, 1, 0)`
    fn list_for_vector(
        &self,
        error: Diagnostic,
        expr: Option<&'p Expr>,
        span: Span,
        vector: Head,
    ) -> Diagnostic {
        let (count, example) = if vector == Head::Vec2 { (2, "(x, y)") } else { (3, "(x, y, z)") };
        let text = "a vector is written in parentheses:";
        match (expr.map(|expr| &expr.kind), self.quoted(span)) {
            (Some(ExprKind::List(items)), Some(quoted)) if items.len() == count => {
                let inner = quoted.trim_start_matches('[').trim_end_matches(']');
                error.with_suggestion(span, format!("({inner})"), text)
            }
            _ => error.with_help(format!("{text} `{example}`")),
        }
    }

    /// `{ x = 0, y = 1, z = 0 }` for `(0, 1, 0)`
    fn record_for_vector(
        &self,
        error: Diagnostic,
        expr: Option<&'p Expr>,
        span: Span,
        vector: Head,
    ) -> Diagnostic {
        let names: &[&str] = if vector == Head::Vec2 { &["x", "y"] } else { &["x", "y", "z"] };
        let text = "a vector is written in parentheses, without names:";
        if let Some(ExprKind::Record(fields)) = expr.map(|expr| &expr.kind)
            && fields.len() == names.len()
        {
            let value = |name: &&str| {
                let field = fields.iter().find(|field| &*field.name.text == *name)?;
                self.quoted(field.value.span)
            };
            let words: Option<Vec<&str>> = names.iter().map(value).collect();
            if let Some(words) = words {
                return error.with_suggestion(span, format!("({})", words.join(", ")), text);
            }
        }
        error.with_help(format!("{text} `({})`", names.join(", ")))
    }

    fn list_for_one(&self, error: Diagnostic, expected: Head, why: Option<Why<'p>>) -> Diagnostic {
        let help = match (expected, why) {
            (Head::Shape, Some(Why::Field { .. } | Why::Item { .. })) => {
                "a list inside a list: join them with `++`, as in `[a, b] ++ list`, or make the list one shape: `group list`"
            }
            (Head::Shape, _) => {
                "`group list` makes one shape of a list of them; to change each, write `[ f shape | shape <- list ]`"
            }
            (_, Some(Why::Field { .. } | Why::Item { .. })) => {
                "a list inside a list: join them with `++`, as in `[a, b] ++ list`"
            }
            (_, Some(Why::Bound)) => "the number of its elements is `count list`",
            _ => "`at 0 list` is the first element; to use each, write `[ f x | x <- list ]`",
        };
        error.with_help(help)
    }

    fn hint_of_heads(
        &self,
        error: Diagnostic,
        expr: Option<&'p Expr>,
        span: Span,
        found: Head,
        expected: Head,
        why: Option<Why<'p>>,
    ) -> Diagnostic {
        use Head as H;
        match (found, expected) {
            (H::Light, H::Shape) => error.with_help("lights belong in the list `lights` of the scene"),
            (H::Shape, H::Light) => error.with_help("shapes belong in the list `objects` of the scene"),
            (H::Camera, H::Shape | H::Light) => error.with_help("the camera is a field of its own: `scene = { camera = ..., ... }`"),
            (H::Material, H::Shape) => error.with_help("a material goes into a shape: `sphere { material = ... }`, or `shape |> paint material`"),
            (H::Color, H::Material) => self.suggest(
                error,
                span,
                |text| in_place(format!("classic {{ color = {text} }}"), why),
                "a colour alone is not a material; a matte material of that colour:",
            ),
            (H::Function, H::Material) => self.suggest(
                error,
                span,
                |text| in_place(format!("classic {{ color = {text} }}"), why),
                "a texture alone is not a material; a matte material with that texture:",
            ),
            (H::Vec3, H::Color) => self.vector_for_color(error, expr, span, why),
            (H::Color, H::Vec3) => {
                error.with_help("the components of a colour c are `(c.r, c.g, c.b)`, a vector; directions and places are written `(x, y, z)`")
            }
            (H::Text, H::Color) => error.with_help("colours have no quotes: `#ff8800`, `rgb 1 0.5 0`, or the name of a definition"),
            (H::Number, H::Color) => self.grey(error, expr, span, why),
            (H::Number, H::Vec3) => self.number_for_vector(error, expr, span, why),
            (H::Number, H::Vec2) => error.with_help("a vector is written `(x, y)`"),
            (H::Vec2, H::Vec3) => error.with_help("the third component is missing: `(x, y, z)`"),
            (H::Vec3, H::Vec2) => error.with_help("it has one component too many; `v.xy` drops the third of a vector v"),
            (H::Vec2 | H::Vec3, H::Number) => self.vector_for_number(error, span, found, why),
            (H::Color, H::Number) if matches!(why, Some(Why::Branch { .. } | Why::Arm { .. } | Why::Item { .. })) => {
                self.grey_before(error, why)
            }
            (H::Color, H::Number) if self.is_called(why, "mix") => {
                error.with_help("`mix` takes two colours or two numbers: as colours, 0 is `black` and 1 is `white`")
            }
            (H::Color, H::Number) => error.with_help("a colour has the numbers `c.r`, `c.g` and `c.b`"),
            (H::Number, H::Text) => self.shown(error, expr, span, why),
            (H::Text, H::Image) => self.suggest(
                error,
                span,
                |text| in_place(format!("image {text}"), why),
                "a file is read as a picture by `image`:",
            ),
            (H::Shape | H::Light | H::Camera | H::Material, H::Number) if self.is_called(why, "rotate") => {
                error.with_help("`rotate` takes an axis and an angle: `rotate up 30deg`")
            }
            (H::Text, H::Number) => error.with_help("numbers have no quotes"),
            (H::Number, H::Bool) => error.with_help("compare it with something, for example `x > 0` or `x == 1`"),
            (H::Hit, H::Vec3) => self.suggest(error, span, |h| format!("{h}.p"), "the place that was hit is the field `p`:"),
            (H::Vec3, H::Hit) => error.with_help("a hit is more than its place: give the whole hit `h` instead of `h.p`"),
            (H::Record, _) => self.record_for(error, span, expected, why),
            (H::Number, H::List) if matches!(why, Some(Why::Generator(_))) => {
                self.suggest(error, span, |n| format!("[0 .. {n} - 1]"), "the whole numbers below it are a range:")
            }
            (H::Bool, H::Number) => error.with_help("`if condition then 1 else 0` makes a number of it"),
            _ => error,
        }
    }

    /// Whether the value is an argument of that function.
    fn is_called(&self, why: Option<Why<'p>>, name: &str) -> bool {
        matches!(why, Some(Why::Argument { callee, .. }) if self.quoted(callee.span) == Some(name))
    }

    /// `size = 2` of a box, `stretch 2`
    fn number_for_vector(
        &self,
        error: Diagnostic,
        expr: Option<&'p Expr>,
        span: Span,
        why: Option<Why<'p>>,
    ) -> Diagnostic {
        let is_literal = expr.is_some_and(|expr| matches!(expr.kind, ExprKind::Number(_)));
        let is_size = match why {
            Some(Why::Field { field, .. }) => field.name == "size",
            _ => self.is_called(why, "stretch"),
        };
        let error = match why {
            Some(Why::Field { constructor, .. }) if constructor.name == "box" && is_size => {
                error.with_note("where all sides are equal, `cube { size = 2 }` does it, too")
            }
            Some(Why::Argument { callee, .. }) if is_size => {
                let text = "to change the size in all directions alike:";
                return error.with_suggestion(callee.span, "scale", text);
            }
            _ => error,
        };
        if is_literal && is_size {
            return self.suggest(error, span, |n| format!("({n}, {n}, {n})"), "along x, y and z:");
        }
        error.with_help("a vector is written `(x, y, z)`")
    }

    fn vector_for_number(
        &self,
        error: Diagnostic,
        span: Span,
        found: Head,
        why: Option<Why<'p>>,
    ) -> Diagnostic {
        match why {
            Some(Why::Argument { callee, .. })
                if found == Head::Vec3 && self.quoted(callee.span) == Some("scale") =>
            {
                let text = "`scale` changes the size in all directions alike; along x, y and z:";
                return error.with_suggestion(callee.span, "stretch", text);
            }
            Some(Why::Field { constructor, field, .. })
                if found == Head::Vec3 && constructor.name == "cube" && field.name == "size" =>
            {
                let size = self.quoted(span).unwrap_or("(1, 2, 1)");
                return error.with_help(format!(
                    "all sides of a cube are equal; with different ones it is a box: `box {{ size = {size} }}`"
                ));
            }
            _ => {}
        }
        let components = if found == Head::Vec2 { "`.x` and `.y`" } else { "`.x`, `.y` and `.z`" };
        match why {
            Some(Why::Order(..)) => {
                error.with_help(format!("compare its components ({components}), or its `length`"))
            }
            _ => error.with_help(format!(
                "it has the numbers {components}; `length v` is the length of a vector v"
            )),
        }
    }

    fn vector_for_color(
        &self,
        error: Diagnostic,
        expr: Option<&'p Expr>,
        span: Span,
        why: Option<Why<'p>>,
    ) -> Diagnostic {
        let text = "a colour is made by `rgb` from red, green and blue:";
        if let Some(ExprKind::Vector(parts)) = expr.map(|expr| &expr.kind) {
            let words: Option<Vec<String>> =
                parts.iter().map(|part| Some(self.as_argument(part, self.quoted(part.span)?))).collect();
            if let Some(words) = words {
                return error.with_suggestion(span, in_place(format!("rgb {}", words.join(" ")), why), text);
            }
        }
        error
            .with_help("a colour is made by `rgb` from red, green and blue: `rgb v.x v.y v.z` for a vector v")
    }

    /// An expression as it has to be written where an argument stands.
    pub(super) fn as_argument(&self, expr: &Expr, text: &str) -> String {
        let plain = matches!(
            expr.kind,
            ExprKind::Number(_)
                | ExprKind::Bool(_)
                | ExprKind::Text(_)
                | ExprKind::Color(_)
                | ExprKind::Name(_)
                | ExprKind::Vector(_)
                | ExprKind::List(_)
                | ExprKind::Range { .. }
                | ExprKind::Comprehension { .. }
                | ExprKind::Record(_)
                | ExprKind::Update { .. }
                | ExprKind::Field { .. }
                | ExprKind::Annotated { .. }
        );
        if plain { text.into() } else { format!("({text})") }
    }

    fn record_for(&self, error: Diagnostic, span: Span, expected: Head, why: Option<Why<'p>>) -> Diagnostic {
        let constructors = constructors_of(expected);
        if let ([], Some(Why::Argument { callee, whole, .. })) = (constructors.as_slice(), why) {
            let name = self.quoted(callee.span).unwrap_or("f");
            let count = self.types.store.parameters(whole).0.len();
            let words: Vec<String> = (0..count)
                .map(|index| self.parameter_name(callee, index).unwrap_or_else(|| "x".into()))
                .collect();
            return error.with_help(format!(
                    "only constructors take fields by name; `{name}` takes its values one after another: `{name} {}`",
                    words.join(" ")
                ));
        }
        match constructors.as_slice() {
            [] => error,
            [one] => self.suggest(
                error,
                span,
                |text| in_place(format!("{} {text}", one.name), why),
                &format!("a record alone is not {}; `{}` makes one of it:", expected.words(), one.name),
            ),
            several => {
                let names: Vec<&str> = several.iter().map(|c| c.name).collect();
                error.with_help(format!(
                    "a record alone is not {}: write the name of a constructor before it, one of {}",
                    expected.words(),
                    crate::hry::program::listed(&names)
                ))
            }
        }
    }

    /// A function where a plain value is expected: it may lack arguments.
    fn missing_arguments(
        &self,
        error: Diagnostic,
        expr: &'p Expr,
        found: Ty,
        (from, to): (Ty, Ty),
        expected: Ty,
        why: Option<Why<'p>>,
    ) -> Diagnostic {
        let store = &self.types.store;
        if let (ExprKind::Lambda { .. }, Some(Why::Field { field, .. })) = (&expr.kind, why) {
            return error.with_help(format!(
                "`{}` has one value for all places: it cannot vary over a surface",
                field.name
            ));
        }
        if let Some(constructor) = self.named_constructor(expr) {
            return self.bare_constructor(error, expr.span, constructor, why);
        }
        let (taken, result) = store.parameters(found);
        if store.head(expected) == Some(Head::Material) && store.head(to) == Some(Head::Color) {
            return self.hint_of_heads(error, Some(expr), expr.span, Head::Function, Head::Material, why);
        }
        let fits = store.head(result).is_some() && store.head(result) == store.head(expected);
        let (callee, arguments) = application(expr);
        let Some(name) = self.quoted(callee.span) else { return error };
        if fits && taken.len() == 1 && store.head(from) == Some(Head::Hit) {
            let text = format!(
                "`{name}` varies over a surface; where there is a hit `h`, its value is `{} h`",
                self.as_function(expr)
            );
            return error.with_help(text);
        }
        if !fits && !store.is_variable(result) {
            return error;
        }
        let names: Vec<String> = (arguments.len()..arguments.len() + taken.len())
            .filter_map(|index| self.parameter_name(callee, index))
            .map(|name| format!("`{name}`"))
            .collect();
        let which =
            if names.len() == taken.len() { format!(": {}", names.join(", ")) } else { String::new() };
        let more = if arguments.is_empty() { "" } else { "still " };
        error.with_help(format!("`{name}` {more}needs {}{which}", counted(taken.len(), "argument")))
    }

    fn as_function(&self, expr: &Expr) -> String {
        self.quoted(expr.span).map_or_else(
            || "f".into(),
            |text| match expr.kind {
                ExprKind::Name(_) | ExprKind::Apply { .. } => text.into(),
                _ => format!("({text})"),
            },
        )
    }

    fn bare_constructor(
        &self,
        error: Diagnostic,
        span: Span,
        constructor: &'static Constructor,
        why: Option<Why<'p>>,
    ) -> Diagnostic {
        let required: Vec<&str> =
            constructor.fields.iter().filter(|f| f.default.is_none()).map(|f| f.name).collect();
        let name = constructor.name;
        if required.is_empty() {
            let text = format!("`{name}` takes a record; an empty one leaves all at their defaults:");
            return error.with_suggestion(span, in_place(format!("{name} {{}}"), why), text);
        }
        let fields: Vec<String> = required.iter().map(|field| format!("{field} = ...")).collect();
        error.with_help(format!("`{name}` takes a record: `{name} {{ {} }}`", fields.join(", ")))
    }

    /// The constructor that a name means.
    fn named_constructor(&self, expr: &Expr) -> Option<&'static Constructor> {
        match (&expr.kind, self.names.uses.get(&expr.span.start)) {
            (ExprKind::Name(_), Some(Meaning::Global(Global::Constructor(constructor)))) => Some(constructor),
            _ => None,
        }
    }

    /// A function that takes something else than is given to it.
    fn other_parameter(
        &self,
        error: Diagnostic,
        span: Span,
        (given, taken): (Ty, Ty),
        found: Ty,
        expected: Ty,
    ) -> Diagnostic {
        let store = &self.types.store;
        let heads = store.heads(given);
        let likely = [Head::Vec3, Head::Vec2]
            .into_iter()
            .find(|head| !heads.is_any() && !heads.has(Head::Hit) && heads.has(*head));
        match (likely.or_else(|| store.head(given)), store.head(taken)) {
            (Some(Head::Vec3), Some(Head::Hit)) => self.suggest(
                error,
                span,
                |text| format!("(\\h -> {} h.p)", parenthesised(text)),
                "the function takes a place; to give it the place of the hit:",
            ),
            (Some(Head::Vec2), Some(Head::Hit)) => self.suggest(
                error,
                span,
                |text| format!("(\\h -> {} h.uv)", parenthesised(text)),
                "the function takes a vector of two; to give it the surface coordinates of the hit:",
            ),
            (Some(first), Some(Head::Hit)) if first != Head::Hit => {
                let (parameters, _) = store.parameters(found);
                let before = parameters.iter().position(|ty| store.head(*ty) == Some(Head::Hit));
                let help = match before {
                    Some(before) => {
                        let what = counted(before, "argument");
                        format!(
                            "it takes {} first: give it {what} here, so that only the hit is left",
                            first.words()
                        )
                    }
                    None => {
                        format!("it takes {}, not a hit: `\\h -> f ...` can make one of a hit", first.words())
                    }
                };
                error.with_help(help)
            }
            _ => {
                let count = |ty| store.parameters(ty).0.len();
                let (found, expected) = (count(found), count(expected));
                if found == expected {
                    return error;
                }
                let words = [counted(found, "parameter"), counted(expected, "parameter")];
                error.with_help(format!("it takes {}, but a function with {} is needed", words[0], words[1]))
            }
        }
    }

    /// The name of a parameter of a function, where it is known.
    pub(super) fn parameter_name(&self, callee: &Expr, index: usize) -> Option<String> {
        let ExprKind::Name(_) = callee.kind else { return None };
        let Some(Meaning::Global(Global::Definition { module, index: definition })) =
            self.names.uses.get(&callee.span.start)
        else {
            return None;
        };
        let definition = self.modules.get(*module)?.syntax.definitions.get(*definition)?;
        match &definition.parameters.get(index)?.kind {
            crate::hry::ast::PatternKind::Name(name) => Some(name.to_string()),
            _ => None,
        }
    }
}

/// A call as it has to be written at its place: an argument needs parentheses.
fn in_place(call: String, why: Option<Why<'_>>) -> String {
    if matches!(why, Some(Why::Argument { .. })) { format!("({call})") } else { call }
}

/// Text that can be applied to an argument.
fn parenthesised(text: &str) -> String {
    let plain = text.chars().all(|c| c.is_alphanumeric() || c == '_' || c == '\'' || c == ' ' || c == '.');
    if plain { text.into() } else { format!("({text})") }
}

/// The constructors that make something.
pub(super) fn constructors_of(head: Head) -> Vec<&'static Constructor> {
    use crate::hry::library::Makes;
    let makes = match head {
        Head::Shape => Makes::Shape,
        Head::Material => Makes::Material,
        Head::Light => Makes::Light,
        Head::Camera => Makes::Camera,
        _ => return Vec::new(),
    };
    CONSTRUCTORS.iter().filter(|constructor| constructor.makes == makes).collect()
}

/// The first field of a constructor that takes such a value.
pub(super) fn field_for(
    constructor: &'static Constructor,
    head: Head,
    used: &[&str],
) -> Option<&'static str> {
    let takes = |kind: FieldType| match head {
        Head::Number => {
            matches!(kind, FieldType::Number) || (constructor.name == "ambient" && kind == FieldType::Color)
        }
        Head::Vec2 => kind == FieldType::Vec2,
        Head::Vec3 => kind == FieldType::Vec3,
        Head::Color => kind == FieldType::Color,
        Head::Material => kind == FieldType::Material,
        _ => false,
    };
    // Directions and places: `center` rather than `normal` where both could be.
    constructor
        .fields
        .iter()
        .find(|field| takes(field.kind) && !used.contains(&field.name))
        .map(|field| field.name)
}
