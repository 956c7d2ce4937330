//! Reading one sequence of the grammar, token by token, and mending it where it does not fit.

use super::grammar::{Item, NumberKind};
use super::number::{read_integer, read_real, too_large};
use super::parser::{Halt, MOST_ERRORS_IN_SEQUENCE, OpenBracket, Parser};
use super::repair::{self, Edit, WINDOW};
use super::route::{Route, Slot, Step};
use super::token::{Lexeme, Token};
use crate::diagnostic::Span;

impl<'s> Parser<'s> {
    /// Reads a sequence; `follows` says which tokens may come after it. Its values are in `self.values`
    /// afterwards, and mean something where no error was reported. Where it comes to a halt, an error was.
    pub(crate) fn sequence(
        &mut self,
        items: &'static [Item],
        follows: fn(&Lexeme<'_>) -> bool,
    ) -> Result<(), Halt> {
        self.values.clear();
        let mut route = Route::new(items);
        let errors = self.diagnostics.len();
        while let Some(step) = route.step() {
            let now = self.cursor.now();
            if step.accepts(&now) {
                self.take(step, &mut route);
            } else if now.token == Token::End {
                return Err(self.unfinished(&route));
            } else if self.is_full() {
                return Err(Halt::Stop);
            } else if self.diagnostics.len() >= errors + MOST_ERRORS_IN_SEQUENCE {
                return Err(Halt::Lost);
            } else {
                self.mend(step, &mut route, follows)?;
            }
        }
        Ok(())
    }

    /// Takes the token here, which is what is due.
    fn take(&mut self, step: Step, route: &mut Route) {
        let lexeme = self.cursor.bump();
        match step {
            Step::Number(slot) => self.take_number(slot, lexeme),
            Step::Choice(choice) => {
                if let Some(form) = choice.form(lexeme.text) {
                    self.values.push_form(form.word);
                    route.choose(form);
                }
                return;
            }
            _ => self.keep_brackets(step, Some(lexeme.span)),
        }
        route.advance();
    }

    /// Keeps account of a bracket that is due, whether it stands in the source (at `span`) or not.
    fn keep_brackets(&mut self, step: Step, span: Option<Span>) {
        match step {
            Step::Open(bracket, what, _) => self.open.push(OpenBracket { span, bracket, what }),
            Step::Close(..) => drop(self.open.pop()),
            _ => {}
        }
    }

    fn take_number(&mut self, slot: Slot, lexeme: Lexeme<'_>) {
        let read = match slot.kind() {
            NumberKind::Real => read_real(lexeme.text).map(|value| self.values.push_real(value)),
            NumberKind::Integer => {
                read_integer(lexeme.text).map(|value| self.values.push_integer(value, lexeme.span))
            }
        };
        if read.is_none() {
            self.report(too_large(slot.kind(), lexeme.text, lexeme.span));
        }
    }

    /// Reports a token that is not what is due and makes the cheapest change that lets reading go on.
    fn mend(&mut self, step: Step, route: &mut Route, follows: fn(&Lexeme<'_>) -> bool) -> Result<(), Halt> {
        if self.mend_decimal_comma(step, route) {
            return Ok(());
        }
        let tokens = self.cursor.ahead(WINDOW);
        let plan = repair::plan(route, &tokens, follows).filter(|edits| !edits.is_empty());
        let Some(edits) = plan else {
            self.complain_unexpected(step);
            return Err(Halt::Lost);
        };
        for group in edits.chunk_by(same_kind) {
            self.complain(group, route);
            for edit in group {
                self.carry_out(*edit, route);
            }
        }
        Ok(())
    }

    /// Goes on as if the change had been made.
    fn carry_out(&mut self, edit: Edit, route: &mut Route) {
        match edit {
            Edit::Insert(step) => {
                self.keep_brackets(step, None);
                route.advance();
            }
            Edit::InsertTuple(_) => route.skip_item(),
            Edit::InsertForm(_, form) => route.choose(form),
            Edit::Delete => drop(self.cursor.bump()),
            Edit::Replace(step) => {
                let lexeme = self.cursor.bump();
                let is_bracket = matches!(lexeme.token, Token::Open(_));
                self.keep_brackets(step, is_bracket.then_some(lexeme.span));
                route.advance();
            }
            Edit::ReplaceTuple(_) => {
                self.cursor.bump();
                route.skip_item();
            }
            Edit::ReplaceForm(_, form) => {
                self.cursor.bump();
                route.choose(form);
            }
            Edit::SkipForm(_) => {
                self.skip_group();
                route.skip_item();
            }
        }
    }

    /// Passes everything up to the bracket that closes the group here, but nothing that starts a section.
    fn skip_group(&mut self) {
        let mut depth = 0_usize;
        while self.cursor.now().token != Token::End && !self.at_section() {
            match self.cursor.now().token {
                Token::Open(_) => depth += 1,
                Token::Close(_) if depth == 0 => return,
                Token::Close(_) => depth -= 1,
                _ => {}
            }
            self.cursor.bump();
        }
    }
}

/// Whether two changes are told in one message.
fn same_kind(a: &Edit, b: &Edit) -> bool {
    let inserts = |edit: &Edit| matches!(edit, Edit::Insert(_) | Edit::InsertTuple(_) | Edit::InsertForm(..));
    inserts(a) && inserts(b) || matches!((a, b), (Edit::Delete, Edit::Delete))
}
