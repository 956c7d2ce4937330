//! What the text says about widths, comments and line breaks.

use crate::hry::syntax::{Node, Parse, SyntaxKind, Token, children_reversed, trivia};

/// A comment.
#[derive(Clone, Copy, Debug)]
pub(super) struct Comment<'t> {
    pub(super) text: &'t str,
    /// Whether it goes on to the end of its line.
    pub(super) is_line: bool,
    /// How many line breaks are directly before it.
    pub(super) breaks: usize,
}

impl Comment<'_> {
    /// Whether nothing may follow it on its line. What follows the last line of a comment that has several would be hard
    /// to see, and would begin a line at a column of its own.
    pub(super) fn closes_line(&self) -> bool {
        self.is_line || self.text.contains('\n')
    }
}

/// A token or a node below another.
#[derive(Clone, Copy, Debug)]
pub(super) enum Part {
    Token(u32),
    Node(u32),
}

/// The tokens and nodes of a text, and sums over them.
pub(super) struct Source<'t> {
    text: &'t str,
    tokens: &'t [Token],
    nodes: &'t [Node],
    /// Whether a token is a `-` in front of its operand, or the `..` of a rest.
    prefix: Vec<bool>,
    /// Whether a token is the comma after a last element, which only broken brackets have.
    last_comma: Vec<bool>,
    /// How wide everything before a token is on one line.
    widths: Vec<usize>,
    /// How many places before a token, itself included, have to be on a new line.
    breaks: Vec<u32>,
}

impl<'t> Source<'t> {
    pub(super) fn new(text: &'t str, parse: &'t Parse) -> Self {
        let (tokens, nodes) = parse.parts();
        let mut source = Self {
            text,
            tokens,
            nodes,
            prefix: vec![false; tokens.len()],
            last_comma: vec![false; tokens.len()],
            widths: Vec::with_capacity(tokens.len() + 1),
            breaks: Vec::with_capacity(tokens.len() + 1),
        };
        source.find_marks();
        source.add_up();
        source
    }

    /// Finds the tokens that are more than their kind tells.
    fn find_marks(&mut self) {
        for node in self.nodes {
            let first = node.first_token;
            let may_be_minus = matches!(node.kind, SyntaxKind::UnaryExpr | SyntaxKind::LiteralPattern);
            if may_be_minus && self.kind(first) == SyntaxKind::Minus {
                mark(&mut self.prefix, first);
            }
            if node.kind == SyntaxKind::RestPattern {
                mark(&mut self.prefix, first);
            }
        }
        for (number, pair) in self.tokens.windows(2).enumerate() {
            if let [comma, next] = pair
                && comma.kind == SyntaxKind::Comma
                && next.kind.is_close()
            {
                mark(&mut self.last_comma, number as u32);
            }
        }
    }

    fn add_up(&mut self) {
        let forced = self.forced_breaks();
        let (mut width, mut breaks) = (0, 0);
        for token in 0..self.tokens.len() as u32 {
            self.widths.push(width);
            for comment in self.comments(token) {
                width += 1 + comment.text.chars().count();
                let is_apart = comment.breaks > 0 || comment.closes_line();
                breaks += u32::from(is_apart);
            }
            breaks += u32::from(forced.get(token as usize).copied().unwrap_or(false));
            self.breaks.push(breaks);
            if !self.is_last_comma(token) {
                width += usize::from(self.is_spaced(token)) + self.token_text(token).chars().count();
            }
        }
        self.widths.push(width);
        self.breaks.push(breaks);
    }

    /// The tokens that begin a line because the author wanted it so.
    fn forced_breaks(&self) -> Vec<bool> {
        let mut forced = vec![false; self.tokens.len()];
        for (number, node) in self.nodes.iter().enumerate() {
            if matches!(node.kind, SyntaxKind::LetExpr | SyntaxKind::LetQualifier) {
                self.force_let(number as u32, &mut forced);
                continue;
            }
            for token in self.break_places(number as u32, node) {
                if self.gap(token).contains('\n') {
                    mark(&mut forced, token);
                }
            }
        }
        forced
    }

    /// The tokens of a node that stay on a line of their own where the author put them there.
    fn break_places(&self, number: u32, node: &Node) -> Vec<u32> {
        use SyntaxKind as S;
        let (kinds, offset): (&[SyntaxKind], u32) = match node.kind {
            S::ListExpr | S::RecordExpr | S::VectorExpr => {
                let first = node.first_token + 1;
                return if first + 1 < node.end_token { vec![first] } else { Vec::new() };
            }
            S::MatchExpr => (&[S::OpenBrace], 1),
            S::UpdateExpr => {
                let bar = self.parts(number).into_iter().find_map(|part| match part {
                    Part::Token(token) if self.kind(token) == S::Bar => Some(token),
                    _ => None,
                });
                return bar.map_or_else(Vec::new, |bar| vec![bar, bar + 1]);
            }
            S::ComprehensionExpr => (&[S::Bar], 0),
            S::BinaryExpr => (&[S::Pipe], 0),
            S::IfExpr => (&[S::ThenKeyword, S::ElseKeyword], 0),
            _ => return Vec::new(),
        };
        let own = |part| match part {
            Part::Token(token) if kinds.contains(&self.kind(token)) => Some(token + offset),
            _ => None,
        };
        self.parts(number).into_iter().filter_map(own).collect()
    }

    /// A `let` is broken where it was, or has several bindings.
    fn force_let(&self, node: u32, forced: &mut [bool]) {
        let bindings: Vec<u32> = self
            .children(node)
            .into_iter()
            .filter(|child| matches!(self.kind_of(*child), SyntaxKind::Definition | SyntaxKind::Annotation))
            .collect();
        let (Some(first), Some(last)) = (bindings.first(), bindings.last()) else { return };
        if first != last {
            mark(forced, self.first_token(*last));
        }
        let end = self.node(*last).end_token;
        let in_word = self.kind(end) == SyntaxKind::InKeyword && self.kind_of(node) == SyntaxKind::LetExpr;
        let let_word = self.first_token(node);
        if in_word && (let_word + 1..=end).any(|token| self.gap(token).contains('\n')) {
            mark(forced, end);
        }
    }

    // Tokens.

    pub(super) fn token_count(&self) -> u32 {
        self.tokens.len() as u32
    }

    pub(super) fn kind(&self, token: u32) -> SyntaxKind {
        self.tokens.get(token as usize).map_or(SyntaxKind::End, |token| token.kind)
    }

    pub(super) fn token_text(&self, token: u32) -> &'t str {
        let token = self.tokens.get(token as usize);
        token.and_then(|token| self.text.get(token.start as usize..token.end as usize)).unwrap_or("")
    }

    /// What is between a token and the one before it.
    pub(super) fn gap(&self, token: u32) -> &'t str {
        let before = token.checked_sub(1).and_then(|before| self.tokens.get(before as usize));
        let start = before.map_or(0, |before| before.end as usize);
        let end = self.tokens.get(token as usize).map_or(self.text.len(), |token| token.start as usize);
        self.text.get(start..end).unwrap_or("")
    }

    /// The comments before a token.
    pub(super) fn comments(&self, token: u32) -> Vec<Comment<'t>> {
        let gap = self.gap(token);
        if !gap.contains('-') {
            return Vec::new();
        }
        let (mut comments, mut breaks) = (Vec::new(), 0);
        for (kind, text) in trivia(gap) {
            match kind {
                SyntaxKind::Comment | SyntaxKind::BlockComment => {
                    let is_line = kind == SyntaxKind::Comment;
                    let text = if is_line { text.trim_end() } else { text };
                    comments.push(Comment { text, is_line, breaks });
                    breaks = 0;
                }
                _ => breaks += text.matches('\n').count(),
            }
        }
        comments
    }

    /// How many line breaks are directly before a token, after the comments.
    pub(super) fn breaks_before(&self, token: u32) -> usize {
        let gap = self.gap(token);
        let white = gap.len() - gap.trim_end().len();
        gap.get(gap.len() - white..).unwrap_or("").matches('\n').count()
    }

    pub(super) fn has_comments(&self, token: u32) -> bool {
        !self.gap(token).trim().trim_matches('\u{feff}').is_empty()
    }

    pub(super) fn is_last_comma(&self, token: u32) -> bool {
        self.last_comma.get(token as usize).copied().unwrap_or(false)
    }

    /// Whether a space is before a token on one line.
    pub(super) fn is_spaced(&self, token: u32) -> bool {
        use SyntaxKind as S;
        let Some(mut before) = token.checked_sub(1) else { return false };
        if self.is_last_comma(before) {
            before = before.saturating_sub(1);
        }
        let (last, next) = (self.kind(before), self.kind(token));
        let is_prefix = self.prefix.get(before as usize).copied().unwrap_or(false);
        match (last, next) {
            (S::OpenBrace, S::CloseBrace) => false,
            (_, S::Comma | S::CloseParen | S::CloseBracket | S::Dot) => false,
            (S::OpenParen | S::OpenBracket | S::Dot | S::Backslash, _) => false,
            // Two signs without a space would begin a comment.
            _ if is_prefix => next == S::Minus,
            _ => true,
        }
    }

    // Nodes.

    pub(super) fn node(&self, node: u32) -> Node {
        let none = Node { kind: SyntaxKind::ErrorExpr, first_node: node, first_token: 0, end_token: 0 };
        self.nodes.get(node as usize).copied().unwrap_or(none)
    }

    pub(super) fn root(&self) -> u32 {
        self.nodes.len().saturating_sub(1) as u32
    }

    pub(super) fn kind_of(&self, node: u32) -> SyntaxKind {
        self.node(node).kind
    }

    pub(super) fn first_token(&self, node: u32) -> u32 {
        self.node(node).first_token
    }

    pub(super) fn children(&self, node: u32) -> Vec<u32> {
        let mut children: Vec<u32> = children_reversed(self.nodes, node).collect();
        children.reverse();
        children
    }

    /// What a node consists of, in order.
    pub(super) fn parts(&self, node: u32) -> Vec<Part> {
        let mut parts = Vec::new();
        let Node { first_token, end_token, .. } = self.node(node);
        let mut token = first_token;
        for child in self.children(node) {
            let below = self.node(child);
            parts.extend((token..below.first_token).map(Part::Token));
            parts.push(Part::Node(child));
            token = below.end_token;
        }
        parts.extend((token..end_token).map(Part::Token));
        parts
    }

    /// How wide some tokens are on one line, without the space before the first. None where they cannot be on one.
    pub(super) fn flat_width(&self, first: u32, end: u32) -> Option<usize> {
        if first >= end {
            return Some(0);
        }
        let sum = |sums: &[usize], at: u32| sums.get(at as usize).copied().unwrap_or(0);
        let breaks = |at: u32| self.breaks.get(at as usize).copied().unwrap_or(0);
        if breaks(end - 1) != breaks(first) {
            return None;
        }
        let before =
            self.comments(first).iter().map(|comment| 1 + comment.text.chars().count()).sum::<usize>();
        let space = usize::from(self.is_spaced(first));
        Some((sum(&self.widths, end) - sum(&self.widths, first)).saturating_sub(before + space))
    }
}

fn mark(marks: &mut [bool], at: u32) {
    if let Some(place) = marks.get_mut(at as usize) {
        *place = true;
    }
}
