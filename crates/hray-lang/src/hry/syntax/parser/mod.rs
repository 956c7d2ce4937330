//! From tokens to nodes.
//!
//! The parser never fails: what it cannot read becomes an error node, and it goes on at the next place where it can be
//! sure again. That is the next comma or bracket inside brackets, and the end of the binding outside of them.

mod binding;
mod bracketed;
mod comprehension;
mod expr;
mod operators;
mod pattern;
mod types;

pub(super) use binding::Promise;

use super::brackets::Brackets;
use super::kind::SyntaxKind;
use super::lexer::Token;
use super::tree::Node;
use crate::diagnostic::{Diagnostic, Span};

/// How many brackets, functions and bindings may be inside each other.
const DEEPEST_NESTING: u32 = 200;
/// How many operators, arguments and `else if` may follow each other without brackets.
const LONGEST_CHAIN: u32 = 500;
/// How many errors are worth reporting.
pub(super) const MOST_ERRORS: usize = 20;

/// A place in the nodes and tokens where a node may begin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mark {
    node: u32,
    token: u32,
}

impl Done {
    pub(super) const fn kind(self) -> SyntaxKind {
        self.kind
    }

    pub(super) const fn start(self) -> Mark {
        self.start
    }
}

/// A finished node.
#[derive(Clone, Copy, Debug)]
pub(super) struct Done {
    start: Mark,
    kind: SyntaxKind,
    /// How many nodes deep it is.
    height: u32,
}

/// Where a binding ends: at a line that starts in a column below `limit`, outside the brackets opened since.
#[derive(Clone, Copy, Debug)]
pub(super) struct Layout {
    pub(super) limit: u32,
    brackets: u32,
    /// The token that the binding begins with.
    pub(super) first: usize,
}

/// What an `=` would mean, and what else ends an expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Around {
    /// The body of a definition, or a field: a `name =` begins the next one.
    Binding,
    /// The inside of parentheses or a list: an `=` is meant to compare.
    Condition,
    /// The condition of an `if`: the same, and a `then` follows.
    Test,
    /// The subject of a `match`: a `{` begins its arms.
    Subject,
    /// The body of an arm of a `match`: a `pattern ->` begins the next one.
    Arm,
}

/// That no unclosed bracket is around.
const NO_WALL: usize = usize::MAX;

/// A set of kinds of tokens.
#[derive(Clone, Copy, Debug)]
pub(super) struct Set(u128);

impl Set {
    pub(super) const fn of(kinds: &[SyntaxKind]) -> Self {
        let (mut set, mut rest) = (0, kinds);
        while let [kind, others @ ..] = rest {
            set |= 1 << *kind as u32;
            rest = others;
        }
        Self(set)
    }

    const fn has(self, kind: SyntaxKind) -> bool {
        self.0 >> kind as u32 & 1 == 1
    }
}

pub(super) struct Parser<'t> {
    pub(super) text: &'t str,
    pub(super) base: usize,
    pub(super) tokens: &'t [Token],
    pub(super) brackets: &'t Brackets,
    pub(super) nodes: Vec<Node>,
    /// The token to read.
    pub(super) at: usize,
    /// Its kind; [`SyntaxKind::End`] where what is being read ends before it.
    pub(super) current: SyntaxKind,
    pub(super) layouts: Vec<Layout>,
    /// How many brackets are open.
    pub(super) open: u32,
    /// The token before which an unclosed bracket ends everything in it; [`NO_WALL`] outside of such.
    pub(super) wall: usize,
    pub(super) around: Around,
    pub(super) nesting: u32,
    /// How many nodes are begun that will hold what comes next.
    pub(super) chain: u32,
    pub(super) operators: Vec<operators::Operator>,
    pub(super) errors: Vec<Diagnostic>,
    /// The token where the last error was.
    pub(super) failed_at: Option<usize>,
    pub(super) is_too_deep: bool,
    /// Whether what is said already explains all that is wrong with this definition.
    pub(super) is_quiet: bool,
    /// Whether an arm of a `match` began with a `|`, and was reported.
    pub(super) has_bars: bool,
    /// How many brackets were open, and where, when a comma was missing.
    pub(super) last_comma: (u32, usize),
    /// Upper-case names of values that were reported.
    pub(super) upper_case_names: Vec<&'t str>,
}

/// Reads a file.
pub(super) fn parse(
    text: &str,
    base: usize,
    tokens: &[Token],
    brackets: &Brackets,
) -> (Vec<Node>, Vec<Diagnostic>) {
    let mut parser = Parser {
        text,
        base,
        tokens,
        brackets,
        nodes: Vec::with_capacity(tokens.len()),
        at: 0,
        current: SyntaxKind::End,
        layouts: Vec::new(),
        open: 0,
        wall: NO_WALL,
        around: Around::Binding,
        nesting: 0,
        chain: 0,
        operators: Vec::new(),
        errors: Vec::new(),
        failed_at: None,
        is_too_deep: false,
        is_quiet: false,
        has_bars: false,
        last_comma: (0, 0),
        upper_case_names: Vec::new(),
    };
    parser.look();
    parser.file();
    (parser.nodes, parser.errors)
}

impl<'t> Parser<'t> {
    // What is there.

    /// Finds the kind of the current token.
    pub(super) fn look(&mut self) {
        self.current = match self.tokens.get(self.at) {
            Some(token) if self.at < self.wall => {
                let ends = token.starts_line
                    && self.layouts.last().is_some_and(|layout| {
                        token.column < layout.limit && self.open == layout.brackets && self.at != layout.first
                    });
                if ends { SyntaxKind::End } else { token.kind }
            }
            _ => SyntaxKind::End,
        };
    }

    pub(super) fn is(&self, kind: SyntaxKind) -> bool {
        self.current == kind
    }

    pub(super) fn is_end(&self) -> bool {
        self.current == SyntaxKind::End
    }

    pub(super) fn token(&self) -> Option<&'t Token> {
        self.tokens.get(self.at)
    }

    /// The kind of the token `ahead` of the current one, whatever the layout says.
    pub(super) fn kind_ahead(&self, ahead: usize) -> SyntaxKind {
        self.tokens.get(self.at + ahead).map_or(SyntaxKind::End, |token| token.kind)
    }

    pub(super) fn span_of(&self, token: usize) -> Span {
        let end = self.base + self.text.len();
        self.tokens.get(token).map_or(Span::at(end), |token| {
            Span::new(self.base + token.start as usize, self.base + token.end as usize)
        })
    }

    pub(super) fn slice(&self, span: Span) -> Option<&'t str> {
        self.text.get(span.start.checked_sub(self.base)?..span.end.checked_sub(self.base)?)
    }

    pub(super) fn text_of(&self, token: usize) -> &'t str {
        self.tokens
            .get(token)
            .and_then(|token| self.text.get(token.start as usize..token.end as usize))
            .unwrap_or("")
    }

    /// The current token's place. Where reading ends here, that is the place after the last token.
    pub(super) fn here(&self) -> Span {
        if self.is_end() { self.gap() } else { self.span_of(self.at) }
    }

    /// The place directly after the last token.
    pub(super) fn gap(&self) -> Span {
        match self.at.checked_sub(1) {
            Some(last) => Span::at(self.span_of(last).end),
            None => Span::at(self.base),
        }
    }

    /// Whether the current token follows the last one without white space.
    pub(super) fn is_tight(&self) -> bool {
        self.token().is_some_and(|token| !token.spaced)
    }

    pub(super) fn starts_line(&self) -> bool {
        self.token().is_some_and(|token| token.starts_line)
    }

    // Nodes.

    pub(super) fn mark(&self) -> Mark {
        Mark { node: self.nodes.len() as u32, token: self.at as u32 }
    }

    /// Makes a node of everything since `start`.
    pub(super) fn node(&mut self, kind: SyntaxKind, start: Mark) {
        self.nodes.push(Node {
            kind,
            first_node: start.node,
            first_token: start.token,
            end_token: self.at as u32,
        });
    }

    /// Makes an expression of everything since `start`, whose deepest part is `below` nodes deep.
    pub(super) fn expr_node(&mut self, kind: SyntaxKind, start: Mark, below: u32) -> Done {
        let height = below + 1;
        if height > LONGEST_CHAIN {
            self.too_deep();
            self.node(SyntaxKind::ErrorExpr, start);
            return Done { start, kind: SyntaxKind::ErrorExpr, height };
        }
        self.node(kind, start);
        Done { start, kind, height }
    }

    // Moving on.

    pub(super) fn bump(&mut self) {
        self.at += 1;
        self.look();
    }

    pub(super) fn eat(&mut self, kind: SyntaxKind) -> bool {
        let is = self.is(kind);
        if is {
            self.bump();
        }
        is
    }

    /// Goes past an opening bracket; what [`Self::close`] wants back.
    pub(super) fn open(&mut self) -> usize {
        let outer = self.wall;
        if let Some(wall) = self.brackets.unclosed.get(&(self.at as u32)) {
            self.wall = outer.min(*wall as usize);
        }
        self.open += 1;
        self.bump();
        outer
    }

    /// Goes past everything up to the closing bracket, and past that.
    pub(super) fn close(&mut self, closing: SyntaxKind, outer: usize) {
        if !self.is(closing) {
            self.skip_until(Set::of(&[]));
        }
        let is_closed = self.is(closing);
        if !is_closed {
            self.failed_at = Some(self.at);
        }
        self.open -= 1;
        self.wall = outer;
        if is_closed {
            self.bump();
        } else {
            self.look();
        }
    }

    /// Goes on to a token of the set, to the bracket that closes the innermost open one, or to the end.
    pub(super) fn skip_until(&mut self, stop: Set) {
        let mut inner = 0_u32;
        while !self.is_end() {
            if inner == 0 && stop.has(self.current) {
                return;
            }
            if self.current.is_open() {
                if !self.brackets.unclosed.contains_key(&(self.at as u32)) {
                    inner += 1;
                    self.open += 1;
                }
            } else if self.current.is_close() {
                match inner.checked_sub(1) {
                    Some(left) => (inner, self.open) = (left, self.open - 1),
                    None if self.open > 0 => return,
                    None => {}
                }
            }
            self.bump();
        }
        // A wall, or a line that ends a binding, may lie inside brackets that were skipped.
        self.open -= inner;
        self.look();
    }

    /// Reads with the inside of brackets being its own world.
    pub(super) fn inside<T>(&mut self, around: Around, read: impl FnOnce(&mut Self) -> T) -> T {
        let outer = std::mem::replace(&mut self.around, around);
        let read = read(self);
        self.around = outer;
        read
    }

    /// Reads something that may hold itself. None, and everything up to a place to go on, where it is nested too deeply.
    pub(super) fn nested<T>(&mut self, read: impl FnOnce(&mut Self) -> T) -> Option<T> {
        if self.nesting >= DEEPEST_NESTING || self.chain >= LONGEST_CHAIN {
            self.too_deep();
            self.skip_until(Set::of(&[SyntaxKind::Comma]));
            return None;
        }
        self.nesting += 1;
        self.chain += 1;
        let read = read(self);
        self.nesting -= 1;
        self.chain -= 1;
        Some(read)
    }

    // Errors.

    /// Reports an error at the current token, unless there is one already, or an unclosed bracket is why it is here.
    pub(super) fn fail(&mut self, error: impl FnOnce(&Self) -> Diagnostic) {
        if self.failed_at != Some(self.at) && !self.is_silent() {
            match self.foreign_word() {
                Some(foreign) => {
                    self.report(foreign);
                    self.is_quiet = true;
                }
                None => {
                    let error = error(self);
                    self.report(error);
                }
            }
        }
        self.failed_at = Some(self.at);
    }

    /// The same, where the definition is so unlike the language that its other errors would say nothing.
    pub(super) fn fail_for_good(&mut self, error: impl FnOnce(&Self) -> Diagnostic) {
        self.fail(error);
        self.is_quiet = true;
    }

    /// Whether an error would only repeat that this definition is not understood, or that a bracket around is not closed.
    fn is_silent(&self) -> bool {
        self.is_quiet || self.wall != NO_WALL
    }

    /// Reports an error beside the way: reading goes on as if nothing were wrong.
    pub(super) fn report(&mut self, error: Diagnostic) {
        // Some are thrown away when they are tidied.
        if self.errors.len() < 4 * MOST_ERRORS && !self.is_silent() {
            self.errors.push(error);
        }
    }

    pub(super) fn too_deep(&mut self) {
        if self.is_too_deep {
            return;
        }
        self.is_too_deep = true;
        let message = "this is nested too deeply";
        let label =
            format!("more than {DEEPEST_NESTING} levels of brackets, or {LONGEST_CHAIN} operators in a row");
        let error = Diagnostic::error("nested-too-deeply", message, self.here(), label);
        self.report(
            error.with_help("give parts of it names, and build lists with `[ ... | i <- [1 .. n] ]`"),
        );
        self.failed_at = Some(self.at);
    }
}
