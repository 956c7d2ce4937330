//! Expressions without their operators and brackets.

use super::super::kind::SyntaxKind;
use super::{Around, Done, LONGEST_CHAIN, Mark, Parser, Set};

/// What may come after an expression that could not be read.
const AFTER: Set = Set::of(&[
    SyntaxKind::Comma,
    SyntaxKind::InKeyword,
    SyntaxKind::ThenKeyword,
    SyntaxKind::ElseKeyword,
    SyntaxKind::Bar,
    SyntaxKind::DotDot,
]);

impl Parser<'_> {
    /// An expression.
    pub(super) fn expr(&mut self) -> Done {
        let start = self.mark();
        match self.nested(Self::operation) {
            Some(done) => done,
            None => self.error_expr(start),
        }
    }

    /// Everything since `start` could not be read.
    pub(in super::super) fn error_expr(&mut self, start: Mark) -> Done {
        self.node(SyntaxKind::ErrorExpr, start);
        Done { start, kind: SyntaxKind::ErrorExpr, height: 1 }
    }

    /// What follows an expression is too much: leaves it out.
    pub(super) fn abandon(&mut self, done: Done) -> Done {
        self.too_deep();
        self.skip_until(AFTER);
        self.error_expr(done.start)
    }

    /// Goes on to where an expression around could go on.
    pub(in super::super) fn skip_expr(&mut self) {
        self.skip_until(AFTER);
    }

    /// A function and its arguments.
    pub(super) fn application(&mut self) -> Done {
        let mut function = self.postfix();
        loop {
            let argument = match self.current {
                SyntaxKind::Minus if self.is_negative_argument() => {
                    self.check_application(function);
                    self.negative()
                }
                SyntaxKind::Backslash | SyntaxKind::LetKeyword | SyntaxKind::IfKeyword => {
                    self.bare_argument()
                }
                SyntaxKind::Less | SyntaxKind::From if self.is_angle_vector() => self.postfix(),
                kind if self.begins_argument(kind) => {
                    if !self.check_application(function) {
                        return function;
                    }
                    self.postfix()
                }
                _ => return function,
            };
            function =
                self.expr_node(SyntaxKind::ApplyExpr, function.start, function.height.max(argument.height));
            if function.height >= LONGEST_CHAIN {
                return self.abandon(function);
            }
        }
    }

    /// Whether the current token begins an argument of what comes before.
    fn begins_argument(&self, kind: SyntaxKind) -> bool {
        match kind {
            SyntaxKind::OpenBrace => self.around != Around::Subject,
            SyntaxKind::Name => !self.begins_next() && !self.is_for_of_python(),
            SyntaxKind::OpenParen | SyntaxKind::OpenBracket => !self.begins_arm(),
            SyntaxKind::Number | SyntaxKind::Text | SyntaxKind::TrueKeyword | SyntaxKind::FalseKeyword => {
                !self.begins_arm()
            }
            SyntaxKind::Color | SyntaxKind::TypeName | SyntaxKind::MatchKeyword => true,
            _ => false,
        }
    }

    /// Whether a name is the beginning of the next field, binding or arm, so that a comma or the like is missing.
    fn begins_next(&self) -> bool {
        match self.around {
            Around::Binding => self.kind_ahead(1) == SyntaxKind::Define,
            Around::Arm => self.begins_arm(),
            Around::Condition | Around::Test | Around::Subject => false,
        }
    }

    /// Whether a line begins that looks like the next arm of a `match`.
    fn begins_arm(&self) -> bool {
        self.around == Around::Arm
            && self.starts_line()
            && super::super::brackets::leads_to(self.tokens, self.at, SyntaxKind::Arrow, true).is_some()
    }

    /// A `-` with white space before it and none after it.
    fn is_negative_argument(&self) -> bool {
        let is_followed = self.tokens.get(self.at + 1).is_some_and(|next| !next.spaced);
        !self.is_tight()
            && is_followed
            && matches!(
                self.kind_ahead(1),
                SyntaxKind::Number | SyntaxKind::Name | SyntaxKind::OpenParen | SyntaxKind::OpenBracket
            )
    }

    /// `-` and its operand, as an argument.
    fn negative(&mut self) -> Done {
        let start = self.mark();
        self.bump();
        let operand = self.postfix();
        self.expr_node(SyntaxKind::UnaryExpr, start, operand.height)
    }

    /// Something and its fields.
    pub(in super::super) fn postfix(&mut self) -> Done {
        let mut record = self.primary();
        while self.is(SyntaxKind::Dot) && self.is_tight() {
            if !self.field_name() {
                return record;
            }
            record = self.expr_node(SyntaxKind::FieldExpr, record.start, record.height);
            if record.height >= LONGEST_CHAIN {
                return self.abandon(record);
            }
        }
        record
    }

    fn primary(&mut self) -> Done {
        let start = self.mark();
        match self.current {
            SyntaxKind::Number
            | SyntaxKind::Text
            | SyntaxKind::Color
            | SyntaxKind::TrueKeyword
            | SyntaxKind::FalseKeyword => {
                self.bump();
                self.expr_node(SyntaxKind::Literal, start, 0)
            }
            SyntaxKind::Name => {
                self.bump();
                self.expr_node(SyntaxKind::NameExpr, start, 0)
            }
            SyntaxKind::OpenParen => self.parenthesised(),
            SyntaxKind::OpenBracket => self.list(),
            SyntaxKind::OpenBrace => self.record(),
            SyntaxKind::MatchKeyword => self.match_arms(),
            _ => self.no_expr(),
        }
    }

    /// `\parameters -> body`
    pub(super) fn lambda(&mut self) -> Done {
        let start = self.mark();
        self.bump();
        if !self.begins_pattern() {
            self.fail(Self::no_parameter);
        }
        while self.begins_pattern() {
            self.pattern(false);
        }
        self.expect_arrow();
        let body = self.expr();
        self.expr_node(SyntaxKind::LambdaExpr, start, body.height)
    }

    /// `if condition then a else b`, and any number of `else if`.
    pub(super) fn if_then_else(&mut self) -> Done {
        let chain = self.chain;
        let (mut starts, mut height) = (Vec::new(), 0);
        while self.is(SyntaxKind::IfKeyword) {
            let start = self.mark();
            starts.push((start, self.at));
            self.bump();
            let condition = self.inside(Around::Test, Self::expr);
            self.expect_word(SyntaxKind::ThenKeyword, start);
            let then = self.expr();
            self.expect_word(SyntaxKind::ElseKeyword, start);
            height = condition.height.max(then.height).max(height);
            self.chain += 1;
            if self.chain >= LONGEST_CHAIN {
                self.too_deep();
                self.skip_expr();
                break;
            }
        }
        let mut done = self.expr();
        done.height = done.height.max(height);
        for (start, _) in starts.into_iter().rev() {
            done = self.expr_node(SyntaxKind::IfExpr, start, done.height);
        }
        self.chain = chain;
        done
    }

    /// `match subject { arms }`
    fn match_arms(&mut self) -> Done {
        let start = self.mark();
        self.bump();
        let has_arms = self.is(SyntaxKind::OpenBrace)
            && super::super::brackets::leads_to(self.tokens, self.at + 1, SyntaxKind::Arrow, false).is_some();
        let mut height = if has_arms {
            self.fail(Self::no_subject);
            self.error_expr(self.mark()).height
        } else {
            self.inside(Around::Subject, Self::expr).height
        };
        if !self.is(SyntaxKind::OpenBrace) {
            self.fail(|parser| parser.no_arms(start));
            return self.expr_node(SyntaxKind::ErrorExpr, start, height);
        }
        let outer = self.open();
        self.elements(SyntaxKind::CloseBrace, |parser| height = height.max(parser.arm()));
        self.close(SyntaxKind::CloseBrace, outer);
        self.expr_node(SyntaxKind::MatchExpr, start, height)
    }

    /// `pattern -> body`; how deep it is.
    fn arm(&mut self) -> u32 {
        if self.is(SyntaxKind::Bar) {
            self.bar_before_arm();
            self.bump();
        }
        let start = self.mark();
        self.pattern(true);
        self.expect_arrow();
        let body = self.inside(Around::Arm, Self::expr);
        self.node(SyntaxKind::MatchArm, start);
        body.height + 1
    }
}
