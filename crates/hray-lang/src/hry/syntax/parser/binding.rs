//! A file and its bindings: imports, annotations, definitions; `let`.

use super::super::brackets::defines;
use super::super::kind::SyntaxKind;
use super::{Around, Done, Layout, Mark, Parser, Set};

/// An annotation that waits for its definition.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Promise {
    /// The token of its name.
    name: usize,
}

impl Promise {
    pub(in super::super) const fn name(self) -> usize {
        self.name
    }
}

impl Parser<'_> {
    pub(super) fn file(&mut self) {
        let start = self.mark();
        let mut promise = None;
        let mut is_well = true;
        while self.at < self.tokens.len() {
            let (before, errors) = (self.at, self.errors.len());
            self.layout_here();
            // What follows an error and is no definition is still part of that.
            self.is_quiet = !is_well && !self.begins_item() && !self.begins_povray();
            self.item(&mut promise);
            is_well = self.errors.len() == errors && !self.is_quiet;
            self.is_quiet = false;
            self.layouts.pop();
            if self.at == before {
                self.at += 1;
            }
            self.look();
        }
        self.kept_promise(&mut promise, None);
        self.node(SyntaxKind::File, start);
    }

    fn begins_item(&self) -> bool {
        let after_let = usize::from(self.is(SyntaxKind::LetKeyword));
        let is_other = self.current.is_keyword() && self.kind_ahead(1) == SyntaxKind::Define;
        if self.is(SyntaxKind::ImportKeyword) || is_other {
            return true;
        }
        super::super::brackets::begins_item(self.tokens, self.at + after_let)
    }

    /// An import, annotation or definition, or what stands there instead.
    fn item(&mut self, promise: &mut Option<Promise>) {
        if self.is(SyntaxKind::ImportKeyword) {
            self.kept_promise(promise, None);
            self.import();
        } else if self.begins_definition() {
            self.binding(promise, true);
        } else if self.is(SyntaxKind::LetKeyword) && self.begins_item() {
            self.let_at_the_top();
            self.bump();
            self.binding(promise, true);
        } else {
            *promise = None;
            self.no_definition();
            self.skip_binding(Set::of(&[]));
        }
    }

    /// A binding begins here: its column says where it ends.
    fn layout_here(&mut self) {
        let column = self.token().map_or(0, |token| token.column);
        self.layouts.push(Layout { limit: column + 1, brackets: self.open, first: self.at });
        self.look();
    }

    /// `import "path" (names)`, `import "path" as name`
    fn import(&mut self) {
        let start = self.mark();
        self.bump();
        if self.is(SyntaxKind::Text) {
            self.bump();
        } else {
            self.fail(Self::no_path);
            self.skip_binding(Set::of(&[]));
            self.node(SyntaxKind::Import, start);
            return;
        }
        if self.is(SyntaxKind::AsKeyword) {
            self.bump();
            self.import_name();
        } else if self.is(SyntaxKind::OpenParen) {
            let outer = self.open();
            self.elements(SyntaxKind::CloseParen, Self::import_name);
            self.close(SyntaxKind::CloseParen, outer);
        }
        if !self.is_end() {
            self.fail(Self::after_import);
            self.skip_binding(Set::of(&[]));
        }
        self.node(SyntaxKind::Import, start);
    }

    fn import_name(&mut self) {
        if self.is(SyntaxKind::TypeName) {
            self.upper_case();
            self.bump();
        } else if !self.eat(SyntaxKind::Name) {
            self.fail(Self::no_import_name);
        }
    }

    /// An annotation or a definition, in a layout of its own; how deep it is.
    fn binding(&mut self, promise: &mut Option<Promise>, is_top: bool) -> u32 {
        let (start, first) = (self.mark(), self.at);
        self.pattern(false);
        if self.is(SyntaxKind::Colon) {
            self.annotation(promise, first);
            self.node(SyntaxKind::Annotation, start);
            return 1;
        }
        self.kept_promise(promise, Some(first));
        let body = if self.parameters(first, is_top) {
            let body = self.mark();
            let done = self.inside(Around::Binding, Self::expr);
            if is_top && self.open == 0 && self.is(SyntaxKind::Comma) {
                // Part of a list, so its type means nothing.
                self.commas_in_definition(Self::token_of(body));
                self.skip_binding(Set::of(&[]));
                self.error_expr(body)
            } else {
                done
            }
        } else {
            let body = self.mark();
            self.skip_binding(Set::of(&[SyntaxKind::InKeyword, SyntaxKind::Comma]));
            self.error_expr(body)
        };
        self.end_of_binding(first, is_top);
        self.node(SyntaxKind::Definition, start);
        body.height + 1
    }

    /// `: type` after a name.
    fn annotation(&mut self, promise: &mut Option<Promise>, first: usize) {
        let errors = self.errors.len();
        match promise.take() {
            Some(before) if self.text_of(before.name()) == self.text_of(first) => {
                self.second_annotation(before, first);
            }
            other => {
                *promise = other;
                self.kept_promise(promise, None);
            }
        }
        self.bump();
        self.type_expr();
        if !self.is_end() && !self.is(SyntaxKind::InKeyword) {
            self.fail(|parser| parser.after_annotation(first));
            self.skip_binding(Set::of(&[SyntaxKind::InKeyword]));
        }
        if self.kind_of(first) == SyntaxKind::Name && self.errors.len() == errors {
            *promise = Some(Promise { name: first });
        }
    }

    /// The parameters of a definition and its `=`. False where there is none.
    fn parameters(&mut self, first: usize, is_top: bool) -> bool {
        if defines(self.tokens, first).is_none() {
            // What follows is no parameter list, so nothing is to be said about parameters.
            while matches!(self.current, SyntaxKind::Name | SyntaxKind::Underscore) {
                self.pattern(false);
            }
            if !self.is(SyntaxKind::Define) {
                self.fail_for_good(|parser| parser.no_define(first));
                return false;
            }
        }
        if is_top {
            self.check_target(first);
        }
        while self.begins_pattern() {
            self.pattern(false);
        }
        if !self.is(SyntaxKind::Define) {
            self.fail(|parser| parser.no_define(first));
        }
        self.eat(SyntaxKind::Define)
    }

    /// Everything up to the end of the binding.
    fn skip_binding(&mut self, stop: Set) {
        let start = self.mark();
        self.skip_until(stop);
        self.error_since(start);
    }

    /// What is left of a binding after its body was read: nothing, if all is well.
    fn end_of_binding(&mut self, first: usize, is_top: bool) {
        let is_followed = match self.current {
            SyntaxKind::End => true,
            SyntaxKind::InKeyword | SyntaxKind::Semicolon => !is_top,
            SyntaxKind::Comma => self.open > 0 || !is_top && self.separates_bindings(),
            SyntaxKind::Name => !is_top && !self.starts_line() && self.kind_ahead(1) == SyntaxKind::Define,
            kind => self.open > 0 && kind.is_close(),
        };
        if is_followed {
            return;
        }
        if self.is(SyntaxKind::Semicolon) {
            self.semicolon();
        } else {
            self.fail(|parser| parser.after_body(first, is_top));
        }
        let stop: &[SyntaxKind] = match (is_top, self.open > 0) {
            (true, _) => &[],
            (false, true) => &[SyntaxKind::InKeyword, SyntaxKind::Comma],
            (false, false) => &[SyntaxKind::InKeyword],
        };
        self.skip_binding(Set::of(stop));
    }

    /// `let bindings in body`
    pub(super) fn let_in(&mut self) -> Done {
        let (start, first) = (self.mark(), self.at);
        self.bump();
        let height = self.let_bindings();
        if !self.eat(SyntaxKind::InKeyword) {
            self.fail(|parser| parser.no_in(first));
        }
        let around = if self.around == Around::Subject { Around::Condition } else { self.around };
        let body = self.inside(around, Self::expr);
        self.expr_node(SyntaxKind::LetExpr, start, height.max(body.height))
    }

    /// The bindings after `let`; how deep they are.
    pub(super) fn let_bindings(&mut self) -> u32 {
        let mut promise = None;
        let mut height = 0;
        let mut count = 0;
        while self.begins_let_binding(count) {
            let before = self.at;
            self.layout_here();
            let read = self.nested(|parser| parser.binding(&mut promise, false));
            height = height.max(read.unwrap_or(0));
            self.layouts.pop();
            self.look();
            count += 1;
            if self.at == before {
                break;
            }
            self.between_bindings();
        }
        if count == 0 {
            self.fail(Self::no_binding);
        }
        self.kept_promise(&mut promise, None);
        height
    }

    /// Whether another binding of a `let` begins here.
    fn begins_let_binding(&self, count: usize) -> bool {
        self.begins_pattern()
            && (count == 0
                || self.kind_ahead(1) == SyntaxKind::Colon
                || defines(self.tokens, self.at).is_some())
    }

    /// Whether a definition begins here.
    fn begins_definition(&self) -> bool {
        match self.current {
            SyntaxKind::Name | SyntaxKind::TypeName => true,
            _ => self.begins_pattern() && defines(self.tokens, self.at).is_some(),
        }
    }

    /// The place where a node began, as a token.
    pub(in super::super) const fn token_of(start: Mark) -> usize {
        start.token as usize
    }
}
