//! An expression has another type than its place takes.

use super::super::infer::{Allowed, Infer, Why, written_operator};
use super::super::store::{Clash, Node, Ty};
use crate::diagnostic::{Diagnostic, Span};
use crate::hry::ast::{Expr, ExprKind};
use crate::hry::program::{Global, standard};
use crate::hry::types::names::Meaning;

/// How a mismatch is put: its code, the sentence, and what is to be shown beside it.
struct Told {
    code: &'static str,
    message: String,
    beside: Option<(Span, String)>,
}

fn told(code: &'static str, message: String) -> Told {
    Told { code, message, beside: None }
}

impl Told {
    fn beside(mut self, span: Span, text: impl Into<String>) -> Self {
        self.beside = Some((span, text.into()));
        self
    }
}

impl<'p> Infer<'p> {
    /// The complaint about a type that is not the expected one.
    pub(in crate::hry::types) fn mismatch(
        &self,
        expr: Option<&'p Expr>,
        span: Span,
        found: Ty,
        expected: Ty,
        why: Why<'p>,
        clash: Clash,
    ) -> Diagnostic {
        if let Some(error) = self.special_clash(span, found, clash) {
            let error = match (clash, self.hidden_by_itself(why)) {
                (Clash::Infinite, Some(name)) => error.with_help(format!(
                    "inside its own definition, `{name}` is that definition and not the library's `{name}`: give yours \
                     another name"
                )),
                _ => error,
            };
            return self.beside(error, why);
        }
        let told = self.told(found, expected, why);
        let label = format!("expected {}, found `{}`", self.expected(expected, why), self.show(found));
        let mut error = Diagnostic::error(told.code, told.message, span, label);
        if let Some((place, text)) = told.beside {
            error = error.with_secondary(place, text);
        }
        if let Some(note) = self.inner_difference(found, expected, clash) {
            error = error.with_note(note);
        }
        self.hint(error, expr, span, found, expected, Some(why))
    }

    /// The name of a function that is called, where the program's own definition hides one of the library.
    fn hidden_by_itself(&self, why: Why<'p>) -> Option<&'p str> {
        let Why::Argument { callee, .. } = why else { return None };
        let ExprKind::Name(name) = &callee.kind else { return None };
        let is_own = match self.names.uses.get(&callee.span.start) {
            Some(Meaning::Global(Global::Definition { module, .. })) => {
                self.modules.get(*module).is_some_and(|module| !module.is_standard)
            }
            _ => false,
        };
        (is_own && standard().names.contains_key(name)).then_some(name)
    }

    /// Clashes that are not about two types that differ.
    fn special_clash(&self, span: Span, found: Ty, clash: Clash) -> Option<Diagnostic> {
        match clash {
            Clash::Infinite => {
                let message = "the type of this would contain itself without end";
                let error = Diagnostic::error(
                    "infinite-type",
                    message,
                    span,
                    format!("found `{}`", self.show(found)),
                );
                Some(error.with_help(
                    "this happens where a function is given itself, or a list is put into itself: is an argument missing \
                     or one too many?",
                ))
            }
            Clash::TooDeep => {
                let message = "the type of this is nested too deeply";
                Some(Diagnostic::error(
                    "type-too-large",
                    message,
                    span,
                    "too many lists or functions inside each other",
                ))
            }
            Clash::Escape(variable) => {
                let name = self.show(variable);
                let message = format!(
                    "the annotation says `{name}`, any type, but this has the type of something outside"
                );
                let error =
                    Diagnostic::error("not-general", message, span, format!("found `{}`", self.show(found)));
                Some(error.with_help(
                    "leave the annotation away, or give the outer value to the function as a parameter",
                ))
            }
            Clash::Differ(..) | Clash::Kind(..) => None,
        }
    }

    fn beside(&self, error: Diagnostic, why: Why<'p>) -> Diagnostic {
        match why {
            Why::Recursion(name) => error.with_secondary(name, "in this definition"),
            Why::Annotation(span) => error.with_secondary(span, "the annotation"),
            Why::Argument { callee, whole, .. } => {
                error.with_secondary(callee.span, format!("its type: `{}`", self.show(whole)))
            }
            _ => error,
        }
    }

    fn expected(&self, expected: Ty, why: Why<'p>) -> String {
        let written = match why {
            Why::Field { field, .. } if !self.is_part(expected, why) => Allowed::written(field),
            _ => match self.types.store.kind(expected) {
                Some(kind) if kind.name().is_none() && !kind.is_any() => return kind.words(),
                _ => self.show(expected),
            },
        };
        format!("`{written}`")
    }

    /// Whether what is expected is a part of what a field takes: an element of its list.
    fn is_part(&self, expected: Ty, why: Why<'p>) -> bool {
        let Why::Field { field, .. } = why else { return false };
        let list = Allowed::of(field).list.is_some();
        list && !matches!(self.types.store.get(expected), Node::List(_))
    }

    fn told(&self, found: Ty, expected: Ty, why: Why<'p>) -> Told {
        let is = self.words(found);
        let takes = self.words(expected);
        match why {
            Why::Argument { callee, index, whole } => self.told_argument((callee, index, whole), &takes, &is),
            Why::Condition(word) => told(
                "condition-not-bool",
                format!("the condition of an `if` is true or false, but this is {is}"),
            )
            .beside(word, "this decides between its branches"),
            Why::Guard => told(
                "condition-not-bool",
                format!(
                    "what follows `,` in a comprehension is a condition or `x <- list`, but this is {is}"
                ),
            ),
            Why::Logic(word, operator) => {
                told("wrong-operand", format!("`{operator}` takes conditions, but this is {is}"))
                    .beside(word, "takes true or false")
            }
            Why::Order(word, operator) => {
                let operator = written_operator(operator);
                told("wrong-operand", format!("`{operator}` compares numbers, but this is {is}"))
                    .beside(word, "compares two numbers")
            }
            Why::Exponent(word) => {
                told("wrong-operand", format!("an exponent is a number, but this is {is}"))
                    .beside(word, "raises to the power of a number")
            }
            Why::Component => {
                told("wrong-component", format!("the components of a vector are numbers, but this is {is}"))
            }
            Why::Bound => {
                told("wrong-bound", format!("a range goes from number to number, but this is {is}"))
            }
            Why::Generator(pattern) => {
                told("not-a-list", format!("`<-` draws from a list, but this is {is}"))
                    .beside(pattern, "takes the elements, one by one")
            }
            Why::Item { first } => told(
                "mixed-list",
                format!("the elements of a list are of one type: this is {is}, but the first is {takes}"),
            )
            .beside(first, format!("the first element: `{}`", self.show(expected))),
            Why::Branch { first } => told(
                "branches-differ",
                format!("the branches of an `if` are of one type: this is {is}, but the first is {takes}"),
            )
            .beside(first, format!("the first branch: `{}`", self.show(expected))),
            Why::Arm { first } => told(
                "arms-differ",
                format!("the cases of a match are of one type: this is {is}, but the first is {takes}"),
            )
            .beside(first, format!("the first case: `{}`", self.show(expected))),
            Why::Append { left } => told(
                "wrong-operand",
                format!("`++` joins two of the same type: this is {is}, but the left side is {takes}"),
            )
            .beside(left, format!("the left side: `{}`", self.show(expected))),
            Why::Annotation(span) => {
                told("wrong-annotation", format!("the annotation says {takes}, but this is {is}"))
                    .beside(span, "the annotation")
            }
            Why::Field { constructor, field, name } => {
                let owner = constructor.name;
                if self.is_part(expected, why) {
                    let message = format!(
                        "`{}` of `{owner}` holds {}, but this is {is}",
                        field.name,
                        plural(field.name)
                    );
                    return told("wrong-element", message)
                        .beside(name, format!("takes `{}`", Allowed::written(field)));
                }
                let takes = field_words(field);
                told("wrong-field", format!("`{}` of `{owner}` takes {takes}, but this is {is}", field.name))
                    .beside(name, format!("takes `{}`", Allowed::written(field)))
            }
            Why::Update { name, record } => told(
                "wrong-field",
                format!("`{}` is {takes} and has to stay one, but this is {is}", name.text),
            )
            .beside(record, format!("has `{}`: `{}`", name.text, self.show(expected))),
            Why::Pattern { subject } => {
                told("wrong-pattern", format!("this pattern takes {is}, but the value is {takes}"))
                    .beside(subject, format!("the value: `{}`", self.show(expected)))
            }
            Why::Recursion(name) => {
                let defined = self.text(name);
                told(
                    "wrong-recursion",
                    format!("`{defined}` is {is}, but where it uses itself it is taken for {takes}"),
                )
                .beside(name, "a definition has one type inside itself")
            }
        }
    }

    fn told_argument(&self, (callee, index, whole): (&'p Expr, usize, Ty), takes: &str, is: &str) -> Told {
        let ordinal = ordinal(index);
        let name = self.quoted(callee.span).filter(|name| name.len() < 40);
        let message = match name {
            Some(name) => format!("the {ordinal} argument of `{name}` is {takes}, but this is {is}"),
            None => format!("the {ordinal} argument of this function is {takes}, but this is {is}"),
        };
        let mut text = format!("its type: `{}`", self.show(whole));
        if let Some(parameter) = self.parameter_name(callee, index) {
            text = format!("{text}; the {ordinal} parameter is `{parameter}`");
        }
        told("wrong-argument", message).beside(callee.span, text)
    }

    /// Where two large types differ, in what.
    fn inner_difference(&self, found: Ty, expected: Ty, clash: Clash) -> Option<String> {
        let store = &self.types.store;
        if let (Node::Record(a), Node::Record(b)) = (store.get(found), store.get(expected))
            && let Some(note) = record_difference(a, b)
        {
            return Some(note);
        }
        match clash {
            Clash::Differ(a, b) => {
                let whole = [store.find(found), store.find(expected)];
                let inner = !whole.contains(&store.find(a)) && !whole.contains(&store.find(b));
                let (a, b) = (self.show(a), self.show(b));
                (inner && a != b && !a.contains('?')).then(|| format!("they differ in `{a}` and `{b}`"))
            }
            Clash::Kind(ty, kind) if store.find(ty) != store.find(found) => {
                Some(format!("`{}` would have to be {}", self.show(ty), kind.words()))
            }
            _ => None,
        }
    }
}

fn record_difference(
    found: &[(std::sync::Arc<str>, Ty)],
    expected: &[(std::sync::Arc<str>, Ty)],
) -> Option<String> {
    let missing = expected.iter().find(|(name, _)| found.iter().all(|(other, _)| other != name));
    let surplus = found.iter().find(|(name, _)| expected.iter().all(|(other, _)| other != name));
    match (missing, surplus) {
        (Some((missing, _)), Some((surplus, _))) => {
            Some(format!("it has no field `{missing}`, but a field `{surplus}`"))
        }
        (Some((missing, _)), None) => Some(format!("it has no field `{missing}`")),
        (None, Some((surplus, _))) => Some(format!("it has a field `{surplus}` more")),
        (None, None) => None,
    }
}

/// What the elements of a list in a field are.
fn plural(field: &str) -> &'static str {
    match field {
        "lights" => "lights",
        "points" | "normals" => "vectors of three",
        "uvs" => "vectors of two",
        "faces" => "lists of numbers, the corners of each face",
        _ => "shapes",
    }
}

/// What a field takes, in words.
pub(super) fn field_words(field: &crate::hry::library::FieldSpec) -> String {
    use crate::hry::library::FieldType as T;
    let plain = match field.kind {
        T::Number => "a number",
        T::Bool => "a truth value",
        T::Text => "a text",
        T::Vec2 => "a vector of two",
        T::Vec3 => "a vector of three",
        T::Color => "a colour",
        T::Material => "a material",
        T::Camera => "a camera",
        T::Lights => "a list of lights",
        T::Shapes => "a list of shapes",
        T::Points => "a list of vectors of three",
        T::Pairs => "a list of vectors of two",
        T::Faces => "a list of lists of numbers",
        T::Integrator => "an integrator",
        T::Encoding => "an encoding",
        T::Background => "a colour, or a function from a direction to a colour",
        T::Height => "a function from a hit to a number",
        T::Space => "a function from a point to a number",
    };
    if field.varies { format!("{plain}, or a function from a hit to one") } else { plain.into() }
}

/// `first`, `second`, ...
pub(super) fn ordinal(index: usize) -> String {
    const WORDS: [&str; 6] = ["first", "second", "third", "fourth", "fifth", "sixth"];
    WORDS.get(index).map_or_else(|| format!("{}th", index + 1), |word| (*word).into())
}
