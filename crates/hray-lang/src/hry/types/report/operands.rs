//! Operators whose operands do not go with them.

use super::super::infer::{Infer, written_operator};
use super::super::kind::{Head, Kind};
use super::super::store::{Node, Ty};
use crate::diagnostic::{Diagnostic, Span};
use crate::hry::ast::{BinaryOperator, Expr, ExprKind};

type Side<'p> = (&'p Expr, Ty);

impl<'p> Infer<'p> {
    /// Arithmetic on what does not go together.
    pub(in crate::hry::types) fn operands(
        &self,
        operator: BinaryOperator,
        span: Span,
        left: Side<'p>,
        right: Side<'p>,
    ) -> Diagnostic {
        let word = written_operator(operator);
        for (expr, ty) in [left, right] {
            let store = &self.types.store;
            let rigid = matches!(store.get(ty), Node::Rigid { kind, .. } if !kind.within(Kind::NUMERIC));
            if !store.is_error(ty) && (rigid || store.heads(ty).meet(Kind::NUMERIC).is_empty()) {
                return self.not_numeric(word, span, expr, ty);
            }
        }
        let (l, r) = (self.words(left.1), self.words(right.1));
        let message = format!("`{word}` does not go with {l} and {r}");
        let error = Diagnostic::error(
            "wrong-operand",
            message,
            span,
            "takes two of the same type, or one of them a number",
        )
        .with_secondary(left.0.span, format!("`{}`", self.show(left.1)))
        .with_secondary(right.0.span, format!("`{}`", self.show(right.1)));
        let heads = [self.types.store.head(left.1), self.types.store.head(right.1)];
        match heads {
            [Some(Head::Vec2), Some(Head::Vec3)] | [Some(Head::Vec3), Some(Head::Vec2)] => error.with_help(
                "`v.xy` is a vector of three without its third component; `(v.x, v.y, 0)` adds one",
            ),
            [Some(Head::Color), Some(Head::Vec2 | Head::Vec3)]
            | [Some(Head::Vec2 | Head::Vec3), Some(Head::Color)] => error.with_help(
                "`rgb v.x v.y v.z` makes a colour of a vector v, `(c.r, c.g, c.b)` a vector of a colour c",
            ),
            _ => error,
        }
    }

    /// Arithmetic on something that is no number, vector or colour.
    pub(in crate::hry::types) fn not_numeric(
        &self,
        word: &str,
        span: Span,
        expr: &'p Expr,
        ty: Ty,
    ) -> Diagnostic {
        let message =
            format!("`{word}` calculates with numbers, vectors and colours, but this is {}", self.words(ty));
        let label = format!("found `{}`", self.show(ty));
        let error =
            Diagnostic::error("wrong-operand", message, expr.span, label).with_secondary(span, "calculates");
        match self.types.store.get(ty) {
            Node::Rigid { name, .. } => error.with_help(format!(
                "the annotation says `{name}`, which may be anything; `numeric` stands for numbers, vectors and colours"
            )),
            Node::Alone(Head::Text) if word == "+" => {
                error.with_help("texts are joined by `++`; `show x` turns a number into text")
            }
            Node::Alone(Head::Text) => error.with_help("numbers have no quotes"),
            Node::Alone(Head::Bool) => error.with_help("`if condition then 1 else 0` makes a number of it"),
            Node::Alone(Head::Hit) => error.with_help("the place that was hit is `h.p`, a vector"),
            Node::Alone(Head::Shape) => match word {
                "+" => error.with_help("several shapes are a list: `[a, b]`; one solid of two: `union a b`"),
                "-" => error.with_help("to cut one shape out of another: `difference a b`"),
                "*" => error.with_help("to make it larger: `shape |> scale 2`"),
                _ => error,
            },
            Node::Alone(Head::Light) => error.with_help("several lights are a list: `[a, b]`"),
            Node::List(_) if word == "+" => error.with_help("lists are joined by `++`; the sum of a list of numbers is `sum list`"),
            Node::List(_) => error.with_help("to calculate with each element: `[ x * 2 | x <- list ]`"),
            Node::Function(from, _) if self.types.store.head(*from) == Some(Head::Hit) => {
                let name = self.quoted(expr.span).unwrap_or("f");
                error.with_help(format!("it varies over a surface: calculate with its value at a hit, `\\h -> {name} h {word} ...`"))
            }
            // `ball 1 - 2`
            Node::Function(..)
                if word == "-" && expr.span.end < span.start && matches!(expr.kind, ExprKind::Apply { .. }) =>
            {
                let error = error.with_note("a minus with a space on both sides subtracts");
                let gap = Span::new(span.end, span.end + 1);
                error.with_suggestion(gap, "", "for one more argument, which is negative:")
            }
            Node::Function(..) => {
                self.hint(error, Some(expr), expr.span, ty, Ty::NUMBER, None)
            }
            _ => error,
        }
    }

    /// `==` of two types.
    pub(in crate::hry::types) fn not_same(
        &self,
        operator: BinaryOperator,
        span: Span,
        left: Side<'p>,
        right: Side<'p>,
    ) -> Diagnostic {
        let word = written_operator(operator);
        let message = format!(
            "`{word}` compares two of the same type, but these are {} and {}",
            self.words(left.1),
            self.words(right.1)
        );
        let error = Diagnostic::error("compare-different", message, span, "never the same")
            .with_secondary(left.0.span, format!("`{}`", self.show(left.1)))
            .with_secondary(right.0.span, format!("`{}`", self.show(right.1)));
        let heads = [self.types.store.head(left.1), self.types.store.head(right.1)];
        match heads {
            [Some(Head::Text), Some(Head::Number)] | [Some(Head::Number), Some(Head::Text)] => {
                error.with_help("numbers have no quotes; `show x` turns a number into text")
            }
            [Some(Head::Vec2 | Head::Vec3), Some(Head::Number)]
            | [Some(Head::Number), Some(Head::Vec2 | Head::Vec3)] => error.with_help(
                "compare a component (`v.x`), or the length (`length v`), of a vector v with a number",
            ),
            _ => error,
        }
    }

    /// `==` of what cannot be compared.
    pub(in crate::hry::types) fn not_comparable(
        &self,
        operator: BinaryOperator,
        span: Span,
        left: &Expr,
        ty: Ty,
    ) -> Diagnostic {
        let message =
            format!("`{}` cannot compare {}", written_operator(operator), self.words_of_several(ty));
        let label = "there is no telling whether two of them are the same";
        let error = Diagnostic::error("not-comparable", message, span, label)
            .with_secondary(left.span, format!("`{}`", self.show(ty)))
            .with_note("what can be compared: numbers, vectors, colours, texts, truth values, and lists and records of them");
        match self.types.store.get(ty) {
            Node::Function(..) => error.with_help("compare what the functions give: `f x == g x`"),
            Node::Alone(Head::Hit) => error.with_help("compare its fields, such as `h.p`"),
            _ => error.with_help("compare the numbers that they are made from"),
        }
    }

    /// `>>` beside something that is no function.
    pub(in crate::hry::types) fn not_a_function_beside(
        &self,
        word: &str,
        span: Span,
        side: &'p Expr,
        ty: Ty,
    ) -> Diagnostic {
        let message = format!("`{word}` joins two functions, but this is {}", self.words(ty));
        Diagnostic::error("wrong-operand", message, side.span, format!("found `{}`", self.show(ty)))
            .with_secondary(span, "`f >> g` is the function that does first f, then g")
            .with_help("to give a value to a function: `value |> function`")
    }

    /// `f >> g` where g does not take what f gives.
    pub(in crate::hry::types) fn not_composed(
        &self,
        span: Span,
        left: Side<'p>,
        right: Side<'p>,
    ) -> Diagnostic {
        let message = format!(
            "the left function gives {}, but the right one takes {}",
            self.words(left.1),
            self.words(right.1)
        );
        Diagnostic::error("wrong-operand", message, span, "`f >> g` gives what f makes to g")
            .with_secondary(left.0.span, format!("gives `{}`", self.show(left.1)))
            .with_secondary(right.0.span, format!("takes `{}`", self.show(right.1)))
    }

    /// `++` of something else than lists and texts.
    pub(in crate::hry::types) fn not_appendable(&self, span: Span, side: &'p Expr, ty: Ty) -> Diagnostic {
        let message = format!("`++` joins lists, or texts, but this is {}", self.words(ty));
        let error =
            Diagnostic::error("wrong-operand", message, side.span, format!("found `{}`", self.show(ty)))
                .with_secondary(span, "joins two lists, or two texts");
        match (self.types.store.head(ty), self.quoted(side.span)) {
            (Some(Head::Number), _) => {
                error.with_help("numbers are added by `+`; `show x` turns one into text")
            }
            (Some(Head::Function), _) => error,
            (_, Some(text)) => {
                error.with_suggestion(side.span, format!("[{text}]"), "a list of one is written in brackets:")
            }
            _ => error,
        }
    }

    /// A vector in parentheses where an expression was meant to be called with commas.
    pub(super) fn parts_as_arguments(&self, argument: &Expr) -> Option<String> {
        let ExprKind::Vector(parts) = &argument.kind else { return None };
        let words: Option<Vec<String>> =
            parts.iter().map(|part| Some(self.as_argument(part, self.quoted(part.span)?))).collect();
        words.map(|words| words.join(" "))
    }
}
