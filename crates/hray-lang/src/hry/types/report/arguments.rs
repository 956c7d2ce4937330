//! Calls that are not calls: too many arguments, none of a function, or written as in another language.

use super::super::infer::{Infer, counted};
use super::super::kind::Head;
use super::super::store::{Node, Ty};
use crate::diagnostic::{Diagnostic, Span, Suggestion};
use crate::hry::ast::{Expr, ExprKind, UnaryOperator};

impl<'p> Infer<'p> {
    /// Something is given an argument that takes none, or no more. `index` counts the arguments that went
    /// well.
    pub(in crate::hry::types) fn not_a_function(
        &self,
        callee: &'p Expr,
        whole: Ty,
        arguments: &[&'p Expr],
        index: usize,
    ) -> Diagnostic {
        let Some(argument) = arguments.get(index) else {
            return Diagnostic::error("not-a-function", "this is not a function", callee.span, "");
        };
        if let Some(error) = self.negative_argument(callee, whole, argument, index) {
            return error;
        }
        if index > 0 {
            return self.too_many(callee, whole, argument, index, arguments.len());
        }
        let is = self.words(whole);
        // What is piped in stands before the function.
        if argument.span.end <= callee.span.start {
            let message = format!("`|>` gives a value to a function, but this is {is}");
            let error = Diagnostic::error(
                "not-a-function",
                message,
                callee.span,
                format!("found `{}`", self.show(whole)),
            );
            return error.with_secondary(argument.span, "the value");
        }
        let message = format!("this is {is}, not a function, so it takes no argument");
        let error = Diagnostic::error(
            "not-a-function",
            message,
            callee.span,
            format!("found `{}`", self.show(whole)),
        )
        .with_secondary(argument.span, "taken for its argument");
        match (&callee.kind, &argument.kind) {
            (ExprKind::Number(_), ExprKind::Name(_) | ExprKind::Number(_)) => {
                let between = Span::new(callee.span.end, argument.span.start);
                error.with_suggestion(between, " * ", "to multiply, write `*`:")
            }
            (ExprKind::Vector(_) | ExprKind::Color(_) | ExprKind::List(_), _) => {
                error.with_help("is a comma missing before the argument?")
            }
            (_, ExprKind::List(index))
                if self.types.store.head(whole) == Some(Head::List)
                    && index.len() == 1
                    && callee.span.end == argument.span.start =>
            {
                match (self.quoted(callee.span), index.first().and_then(|index| self.quoted(index.span))) {
                    (Some(list), Some(index)) => error.with_suggestion(
                        callee.span.to(argument.span),
                        format!("(at {} {list})", as_index(index)),
                        "an element of a list, counted from 0, is taken by `at`:",
                    ),
                    _ => error.with_help("element i of a list, counted from 0, is `at i list`"),
                }
            }
            _ if self.types.store.head(whole) == Some(Head::List) => {
                error.with_help("element i of a list, counted from 0, is `at i list`")
            }
            (_, ExprKind::Record(_)) => error.with_help("is a comma missing, or `=`?"),
            _ => error.with_help("is an operator or a comma missing between the two?"),
        }
    }

    /// `a -1`, which gives -1 to `a`.
    fn negative_argument(
        &self,
        callee: &Expr,
        whole: Ty,
        argument: &Expr,
        index: usize,
    ) -> Option<Diagnostic> {
        let ExprKind::Unary { operator: UnaryOperator::Negate, operand } = &argument.kind else {
            return None;
        };
        let text = self.text(argument.span);
        if !text.starts_with('-') || index > 0 && !matches!(callee.kind, ExprKind::Name(_)) {
            return None;
        }
        let name = self.quoted(callee.span).unwrap_or("it");
        let operand = self.quoted(operand.span).unwrap_or("1");
        let (_, result) = self.types.store.parameters(whole);
        let message = if index == 0 {
            format!(
                "`{name} -{operand}` gives -{operand} to `{name}` as an argument, but `{name}` is {}",
                self.words(whole)
            )
        } else {
            format!(
                "`-{operand}` is taken for one more argument of `{name}`, whose result is {}",
                self.words(result)
            )
        };
        let sign = Span::new(argument.span.start, argument.span.start + 1);
        let error = Diagnostic::error(
            "negative-argument",
            message,
            argument.span,
            "a minus with space only before it begins an argument",
        );
        Some(error.with_suggestion(sign, "- ", "to subtract, put a space after the minus, too:"))
    }

    fn too_many(
        &self,
        callee: &'p Expr,
        whole: Ty,
        argument: &Expr,
        index: usize,
        count: usize,
    ) -> Diagnostic {
        let name = self.quoted(callee.span).unwrap_or("this function");
        let takes = counted(index, "argument");
        let message = format!("`{name}` takes {takes}, but is given {count}");
        let (_, result) = self.types.store.parameters(whole);
        let error = Diagnostic::error("too-many-arguments", message, argument.span, "one too many")
            .with_secondary(callee.span, format!("its type: `{}`", self.show(whole)));
        match (&argument.kind, self.types.store.get(result)) {
            (ExprKind::Name(_), _) if index > 0 => {
                error.with_help("an argument that is itself a call needs parentheses: `f (g x)`")
            }
            (ExprKind::Record(_), Node::Alone(_)) => error.with_help("is a comma missing before the record?"),
            _ => error.with_help("is an operator or a comma missing before it?"),
        }
    }

    /// Adds to a complaint that the arguments fit in another order.
    pub(in crate::hry::types) fn suggest_order(
        &mut self,
        complaint: usize,
        callee: &Expr,
        arguments: &[&'p Expr],
    ) {
        let piped = arguments.iter().any(|argument| argument.span.end <= callee.span.start);
        let words: Option<Vec<&str>> = arguments.iter().map(|argument| self.quoted(argument.span)).collect();
        let swapped = match (arguments, words.as_deref()) {
            ([first, second], Some([a, b])) if !piped => {
                Some((first.span.to(second.span), format!("{b} {a}")))
            }
            _ => None,
        };
        let Some(error) = self.diagnostics.get_mut(complaint) else { return };
        error.help = None;
        match swapped {
            Some((span, replacement)) => {
                let text = "the arguments fit in the other order:".to_owned();
                error.suggestion = Some(Suggestion { span, replacement, text });
            }
            None => error.help = Some("are the arguments in the wrong order?".into()),
        }
    }

    /// Adds to a complaint about `g` in `f g x` that `f (g x)` was probably meant.
    pub(in crate::hry::types) fn suggest_parentheses(
        &mut self,
        complaint: usize,
        arguments: &[&'p Expr],
        index: usize,
        count: usize,
    ) {
        let rest = arguments.get(index..index + count).unwrap_or_default();
        let (Some(first), Some(last)) = (rest.first(), rest.last()) else { return };
        let span = first.span.to(last.span);
        let Some(text) = self.quoted(span) else { return };
        let replacement = format!("({text})");
        if let Some(error) = self.diagnostics.get_mut(complaint) {
            error.help = None;
            let text = "an argument that is itself a call needs parentheses:".to_owned();
            error.suggestion = Some(Suggestion { span, replacement, text });
        }
    }

    /// Adds to a complaint that calls of constructors need parentheses, or are the elements of a list.
    pub(in crate::hry::types) fn suggest_calls(
        &mut self,
        complaint: usize,
        arguments: &[&'p Expr],
        calls: &[String],
        is_list: bool,
    ) {
        let (Some(first), Some(last)) = (arguments.first(), arguments.last()) else { return };
        let span = first.span.to(last.span);
        let (replacement, text) = if is_list {
            (format!("[{}]", calls.join(", ")), "several are written as a list, in brackets:")
        } else {
            let wrapped =
                calls.iter().map(|call| if call.contains(' ') { format!("({call})") } else { call.clone() });
            (wrapped.collect::<Vec<_>>().join(" "), "an argument that is itself a call needs parentheses:")
        };
        if let Some(error) = self.diagnostics.get_mut(complaint) {
            error.help = None;
            error.notes.clear();
            error.suggestion = Some(Suggestion { span, replacement, text: text.into() });
        }
    }

    /// `group (a, b)`
    pub(in crate::hry::types) fn list_in_parentheses(&self, callee: &Expr, argument: &Expr) -> Diagnostic {
        let name = self.quoted(callee.span).unwrap_or("this function");
        let message = format!("`{name}` takes a list, and lists are written in brackets");
        let error = Diagnostic::error(
            "wrong-argument",
            message,
            argument.span,
            "parentheses make a vector of numbers",
        );
        let inner = self.quoted(argument.span).and_then(|text| text.strip_prefix('(')?.strip_suffix(')'));
        match inner {
            Some(inner) => {
                let space = if callee.span.end == argument.span.start { " " } else { "" };
                error.with_suggestion(argument.span, format!("{space}[{inner}]"), "write brackets:")
            }
            None => error.with_help("write `[a, b]`"),
        }
    }

    /// Adds to a complaint about `g` in `x |> f a g b` that a `|>` is missing before it.
    pub(in crate::hry::types) fn suggest_pipe(&mut self, complaint: usize, argument: &Expr) {
        if let Some(error) = self.diagnostics.get_mut(complaint) {
            error.help = None;
            error.notes.clear();
            error.suggestion = Some(Suggestion {
                span: Span::at(argument.span.start),
                replacement: "|> ".into(),
                text: "to pass the result on to the next function, write `|>` again:".into(),
            });
        }
    }

    /// Adds to a complaint that the arguments are the elements of a list.
    pub(in crate::hry::types) fn suggest_list(&mut self, complaint: usize, arguments: &[&'p Expr]) {
        let words: Option<Vec<&str>> =
            arguments.iter().map(|argument| Some(bare(self.quoted(argument.span)?))).collect();
        let (Some(first), Some(last)) = (arguments.first(), arguments.last()) else { return };
        let span = first.span.to(last.span);
        let Some(error) = self.diagnostics.get_mut(complaint) else { return };
        let text = "several are written as a list, in brackets:".to_owned();
        match words {
            Some(words) => {
                let replacement = format!("[{}]", words.join(", "));
                error.help = None;
                error.suggestion = Some(Suggestion { span, replacement, text });
            }
            None => {
                error.suggestion = None;
                error.help = Some("several are written as a list, in brackets: `[a, b]`".into());
            }
        }
    }

    /// Adds to a complaint that arguments are the components of a vector.
    pub(in crate::hry::types) fn suggest_vector(&mut self, complaint: usize, parts: &[&'p Expr]) {
        let words: Option<Vec<&str>> = parts.iter().map(|part| self.quoted(part.span)).collect();
        let is_plain = |part: &&Expr| match &part.kind {
            ExprKind::Number(_) | ExprKind::Name(_) | ExprKind::Field { .. } => true,
            ExprKind::Unary { operand, .. } => {
                matches!(operand.kind, ExprKind::Number(_) | ExprKind::Name(_))
            }
            _ => false,
        };
        let (Some(first), Some(last)) = (parts.first(), parts.last()) else { return };
        let words = words.filter(|_| parts.iter().all(is_plain));
        let Some(error) = self.diagnostics.get_mut(complaint) else { return };
        let text = "a vector is written in parentheses, with commas:";
        match words {
            Some(words) => {
                let replacement = format!("({})", words.join(", "));
                let span = first.span.to(last.span);
                error.help = None;
                error.suggestion = Some(Suggestion { span, replacement, text: text.to_owned() });
            }
            None => error.help = Some(format!("{text} `(x, y, z)`")),
        }
    }

    /// `mix (a, b)` where `mix a b` was meant.
    pub(in crate::hry::types) fn call_with_commas(
        &self,
        callee: &'p Expr,
        whole: Ty,
        argument: &'p Expr,
    ) -> Diagnostic {
        let name = self.quoted(callee.span).unwrap_or("this function");
        let ExprKind::Vector(parts) = &argument.kind else {
            return Diagnostic::error("call-with-commas", "arguments have no commas", argument.span, "");
        };
        let message = format!(
            "`{name}` is given one vector here: commas in parentheses make a vector of {}",
            parts.len()
        );
        let error =
            Diagnostic::error("call-with-commas", message, argument.span, "a vector, not several arguments")
                .with_secondary(callee.span, format!("its type: `{}`", self.show(whole)));
        match self.parts_as_arguments(argument) {
            Some(words) => {
                let words = if callee.span.end == argument.span.start { format!(" {words}") } else { words };
                error.with_suggestion(
                    argument.span,
                    words,
                    "arguments are written one after another, without commas:",
                )
            }
            None => error.with_help("arguments are written one after another, without commas: `f x y`"),
        }
    }
}

/// Text as it is written where an argument stands.
fn as_index(text: &str) -> String {
    let plain = text.chars().all(|c| c.is_alphanumeric() || c == '_' || c == '.');
    if plain { text.into() } else { format!("({text})") }
}

/// Text without the parentheses around the whole of it.
fn bare(text: &str) -> &str {
    let Some(inner) = text.strip_prefix('(').and_then(|text| text.strip_suffix(')')) else { return text };
    let mut open = 0_i32;
    for c in inner.chars() {
        open += match c {
            '(' => 1,
            ')' => -1,
            // A comma makes a vector of it.
            ',' if open == 0 => return text,
            _ => 0,
        };
        if open < 0 {
            return text;
        }
    }
    inner
}
