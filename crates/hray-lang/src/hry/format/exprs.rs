//! Expressions over several lines.

use super::source::Part;
use super::writer::{Lead, Writer};
use crate::hry::syntax::SyntaxKind;

/// How tightly an operator binds, and whether a chain of them leans left; operators of one group are one chain.
fn group(kind: SyntaxKind) -> (u8, bool) {
    use SyntaxKind as S;
    match kind {
        S::Pipe => (1, true),
        S::Compose => (2, true),
        S::OrKeyword => (3, true),
        S::AndKeyword => (4, true),
        S::Append => (7, false),
        S::Plus | S::Minus => (8, true),
        S::Star | S::Slash | S::Percent => (9, true),
        S::Caret => (11, false),
        _ => (6, true),
    }
}

impl Writer<'_, '_> {
    /// An expression on a line that is indented by `indent`, with `rest` characters to follow it.
    pub(super) fn expr(&mut self, expr: u32, indent: usize, rest: usize) {
        let node = self.source.node(expr);
        if self.fits(node.first_token, node.end_token, rest) {
            return self.tokens(node.first_token, node.end_token);
        }
        match node.kind {
            SyntaxKind::ListExpr | SyntaxKind::RecordExpr | SyntaxKind::VectorExpr => {
                self.broken_list(expr, indent)
            }
            SyntaxKind::UpdateExpr => self.broken_update(expr, indent),
            SyntaxKind::MatchExpr => self.broken_match(expr, indent),
            SyntaxKind::ComprehensionExpr => self.broken_comprehension(expr),
            SyntaxKind::ApplyExpr => self.broken_application(expr, indent, rest),
            SyntaxKind::BinaryExpr => self.broken_operation(expr, indent, rest),
            SyntaxKind::IfExpr => self.broken_if(expr, rest),
            SyntaxKind::LetExpr => self.broken_let(expr, rest),
            SyntaxKind::LambdaExpr => self.broken_lambda(expr, indent, rest),
            _ => self.generic(expr, indent),
        }
    }

    /// What follows an `=` or `->` on a line that is indented by `indent`.
    pub(super) fn body(&mut self, body: u32, indent: usize, rest: usize) {
        let node = self.source.node(body);
        let has_comments = self.source.has_comments(node.first_token);
        let fits_here = !has_comments && self.fits(node.first_token, node.end_token, rest);
        if fits_here || !has_comments && self.stays_behind(body, indent, rest) {
            self.expr(body, indent, rest);
        } else {
            self.lead = Lead::line(indent + 2);
            self.expr(body, indent + 2, rest);
        }
    }

    /// Whether a body that does not fit begins on the line of its `=` all the same.
    fn stays_behind(&self, body: u32, indent: usize, rest: usize) -> bool {
        let node = self.source.node(body);
        let fits_below = |first: u32, end: u32| {
            self.source.flat_width(first, end).is_some_and(|width| indent + 2 + width + rest <= super::WIDTH)
        };
        match node.kind {
            SyntaxKind::RecordExpr
            | SyntaxKind::UpdateExpr
            | SyntaxKind::ListExpr
            | SyntaxKind::VectorExpr
            | SyntaxKind::MatchExpr => true,
            SyntaxKind::ApplyExpr => {
                !fits_below(node.first_token, node.end_token) && self.last_argument(body).is_some()
            }
            SyntaxKind::LambdaExpr => !fits_below(node.first_token, node.end_token),
            SyntaxKind::BinaryExpr => {
                let (operands, operators) = self.chain(body);
                let is_append = operators
                    .first()
                    .is_some_and(|operator| self.source.kind(*operator) == SyntaxKind::Append);
                let first = operands.first().map(|operand| self.source.kind_of(*operand));
                is_append
                    && matches!(first, Some(SyntaxKind::ListExpr))
                    && !fits_below(node.first_token, node.end_token)
            }
            _ => false,
        }
    }

    /// The last argument of an application, where everything before it and its opening bracket fit on the line. Of several
    /// calls in parentheses none is hidden by the last.
    fn last_argument(&self, application: u32) -> Option<u32> {
        let node = self.source.node(application);
        let last = *self.source.children(application).last()?;
        let has_brackets = matches!(
            self.source.kind_of(last),
            SyntaxKind::RecordExpr
                | SyntaxKind::UpdateExpr
                | SyntaxKind::ListExpr
                | SyntaxKind::VectorExpr
                | SyntaxKind::ParenExpr
                | SyntaxKind::MatchExpr
        );
        let open = self.source.first_token(last);
        if self.source.kind_of(last) == SyntaxKind::ParenExpr && self.has_call_before(application) {
            return None;
        }
        let fits = has_brackets && !self.source.has_comments(open) && self.fits(node.first_token, open, 2);
        fits.then_some(last)
    }

    /// Whether an argument before the last is in parentheses.
    fn has_call_before(&self, application: u32) -> bool {
        let mut function = self.source.children(application).first().copied();
        while let Some(here) = function.filter(|here| self.source.kind_of(*here) == SyntaxKind::ApplyExpr) {
            let [inner, argument] = self.source.children(here)[..] else { return false };
            if self.source.kind_of(argument) == SyntaxKind::ParenExpr {
                return true;
            }
            function = Some(inner);
        }
        false
    }

    /// A function and its arguments: the last of them over several lines, or an argument a line.
    fn broken_application(&mut self, application: u32, indent: usize, rest: usize) {
        let first = self.source.first_token(application);
        if let Some(last) = self.last_argument(application) {
            self.tokens(first, self.source.first_token(last));
            return self.expr(last, indent, rest);
        }
        let mut arguments = Vec::new();
        let mut function = application;
        while self.source.kind_of(function) == SyntaxKind::ApplyExpr {
            let [inner, argument] = self.source.children(function)[..] else { break };
            arguments.push(argument);
            function = inner;
        }
        self.expr(function, indent, 0);
        let count = arguments.len();
        for (number, argument) in arguments.into_iter().rev().enumerate() {
            self.lead = Lead::line(indent + 2);
            self.expr(argument, indent + 2, if number + 1 == count { rest } else { 0 });
        }
    }

    /// The operands of a chain of operators that bind equally, and the operators between them.
    fn chain(&self, operation: u32) -> (Vec<u32>, Vec<u32>) {
        let operator = |node: u32| {
            let left = *self.source.children(node).first()?;
            Some((left, self.source.node(left).end_token))
        };
        let Some((_, token)) = operator(operation) else { return (vec![operation], Vec::new()) };
        let (precedence, leans_left) = group(self.source.kind(token));
        let (mut operands, mut operators, mut here) = (Vec::new(), Vec::new(), operation);
        while self.source.kind_of(here) == SyntaxKind::BinaryExpr {
            let Some((left, token)) = operator(here) else { break };
            let [_, right] = self.source.children(here)[..] else { break };
            if group(self.source.kind(token)).0 != precedence {
                break;
            }
            operators.push(token);
            operands.push(if leans_left { right } else { left });
            here = if leans_left { left } else { right };
        }
        operands.push(here);
        if leans_left {
            operands.reverse();
            operators.reverse();
        }
        (operands, operators)
    }

    /// An operator a line, before its right operand.
    fn broken_operation(&mut self, operation: u32, indent: usize, rest: usize) {
        let (operands, operators) = self.chain(operation);
        let is_pipe =
            operators.first().is_some_and(|operator| self.source.kind(*operator) == SyntaxKind::Pipe);
        let Some((first, others)) = operands.split_first() else { return };
        let mut before = self.length();
        self.expr(*first, indent, 0);
        for (number, (operator, operand)) in operators.iter().zip(others).enumerate() {
            let rest = if number + 1 == others.len() { rest } else { 0 };
            let follows_bracket = !is_pipe && self.is_broken_since(before) && self.ends_with_bracket();
            let node = self.source.node(*operand);
            let stays = follows_bracket && self.fits(*operator, node.end_token, rest);
            before = self.length();
            if !stays || self.source.has_comments(*operator) {
                self.lead = Lead::line(indent + 2);
            }
            self.token(*operator);
            self.expr(*operand, indent + 2, rest);
        }
    }

    /// `if condition then a`, `else if ...`, `else b`, all in the column of the `if`.
    fn broken_if(&mut self, mut expr: u32, rest: usize) {
        let mut column = None;
        loop {
            let parts = self.source.parts(expr);
            let [
                Part::Token(word),
                Part::Node(condition),
                Part::Token(then),
                Part::Node(yes),
                Part::Token(otherwise),
                Part::Node(no),
            ] = parts[..]
            else {
                return;
            };
            self.token(word);
            let column = *column.get_or_insert(self.column_of(word));
            self.expr(condition, column + 2, 5);
            self.token(then);
            self.body(yes, column, 0);
            self.lead = Lead::line(column);
            self.token(otherwise);
            let goes_on = self.source.kind_of(no) == SyntaxKind::IfExpr
                && !self.source.has_comments(self.source.first_token(no));
            if !goes_on {
                return self.body(no, column, rest);
            }
            expr = no;
        }
    }

    /// `let bindings`, `in body`, both in one column.
    fn broken_let(&mut self, expr: u32, rest: usize) {
        let node = self.source.node(expr);
        let mut children = self.source.children(expr);
        let Some(body) = children.pop() else { return };
        self.token(node.first_token);
        let column = self.column_of(node.first_token);
        self.bindings(&children, column + 4);
        self.lead = Lead::closing(column, column + 4);
        self.token(self.source.first_token(body) - 1);
        self.body(body, column, rest);
    }

    /// Bindings below each other at `column`, the first after the `let` that was just written.
    pub(super) fn bindings(&mut self, bindings: &[u32], column: usize) {
        for (number, binding) in bindings.iter().enumerate() {
            let first = self.source.first_token(*binding);
            if number > 0 {
                self.lead = Lead::item(column);
            } else if self.source.has_comments(first) {
                self.lead = Lead::line(column);
            }
            self.item(*binding, column);
        }
    }

    /// `\parameters -> body`
    fn broken_lambda(&mut self, expr: u32, indent: usize, rest: usize) {
        let parts = self.source.parts(expr);
        let Some((Part::Node(body), head)) = parts.split_last() else { return };
        for part in head {
            match part {
                Part::Token(token) => self.token(*token),
                Part::Node(pattern) => self.generic(*pattern, indent),
            }
        }
        self.body(*body, indent, rest);
    }
}
