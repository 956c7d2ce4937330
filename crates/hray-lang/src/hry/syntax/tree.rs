//! The syntax tree as the parser leaves it: a list of nodes, each after its children, over a list of tokens.
//!
//! Lowering reads this list. The lossless tree with white space and comments is made from it when somebody asks for it.

use super::kind::{Hry, SyntaxKind, SyntaxNode};
use super::lexer::{Token, trivia};
use rowan::{GreenNode, GreenToken, Language, NodeOrToken};

/// A node.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    pub(crate) kind: SyntaxKind,
    /// The first node below it; its own number where there is none. Those below it are `first_node..itself`.
    pub(crate) first_node: u32,
    /// Its first token.
    pub(crate) first_token: u32,
    /// One past its last token.
    pub(crate) end_token: u32,
}

/// The children of a node, last first.
pub(crate) fn children_reversed(nodes: &[Node], node: u32) -> impl Iterator<Item = u32> {
    let first = nodes.get(node as usize).map_or(node, |node| node.first_node);
    let mut after = node;
    std::iter::from_fn(move || {
        let child = after.checked_sub(1).filter(|child| *child >= first)?;
        after = nodes.get(child as usize)?.first_node;
        Some(child)
    })
}

/// What waits for its parent: its place in the order of tokens (twice the number of a token, one less for what is before
/// it) or of nodes.
enum Part {
    Token(u32, GreenToken),
    Node(u32, GreenNode),
}

/// The lossless tree.
pub(crate) fn lossless(text: &str, tokens: &[Token], nodes: &[Node]) -> SyntaxNode {
    let mut builder = Builder { text, tokens, parts: Vec::new(), next_token: 0, end: 0 };
    for (number, node) in nodes.iter().enumerate() {
        builder.tokens_before(node.end_token);
        if node.kind == SyntaxKind::File {
            builder.trivia(text.len(), u32::MAX);
        }
        builder.node(number as u32, node);
    }
    match builder.parts.pop() {
        Some(Part::Node(_, root)) => SyntaxNode::new_root(root),
        _ => SyntaxNode::new_root(GreenNode::new(Hry::kind_to_raw(SyntaxKind::File), [])),
    }
}

struct Builder<'t> {
    text: &'t str,
    tokens: &'t [Token],
    parts: Vec<Part>,
    next_token: u32,
    /// How much of the text is in `parts`.
    end: usize,
}

impl Builder<'_> {
    fn tokens_before(&mut self, end: u32) {
        while self.next_token < end {
            let number = self.next_token;
            self.next_token += 1;
            let Some(token) = self.tokens.get(number as usize) else { continue };
            self.trivia(token.start as usize, 2 * number);
            let text = self.text.get(token.start as usize..token.end as usize).unwrap_or("");
            let green = GreenToken::new(Hry::kind_to_raw(token.kind), text);
            self.parts.push(Part::Token(2 * number + 1, green));
            self.end = token.end as usize;
        }
    }

    fn trivia(&mut self, end: usize, place: u32) {
        let gap = self.text.get(self.end..end).unwrap_or("");
        for (kind, text) in trivia(gap) {
            self.parts.push(Part::Token(place, GreenToken::new(Hry::kind_to_raw(kind), text)));
        }
        self.end = end;
    }

    fn node(&mut self, number: u32, node: &Node) {
        let is_file = node.kind == SyntaxKind::File;
        let below = |part: &Part| match part {
            _ if is_file => true,
            Part::Token(place, _) => *place > 2 * node.first_token,
            Part::Node(child, _) => *child >= node.first_node,
        };
        let first = self.parts.iter().rposition(|part| !below(part)).map_or(0, |at| at + 1);
        let children: Vec<NodeOrToken<GreenNode, GreenToken>> = self
            .parts
            .drain(first..)
            .map(|part| match part {
                Part::Token(_, token) => NodeOrToken::Token(token),
                Part::Node(_, node) => NodeOrToken::Node(node),
            })
            .collect();
        self.parts.push(Part::Node(number, GreenNode::new(Hry::kind_to_raw(node.kind), children)));
    }
}
