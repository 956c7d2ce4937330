//! The tokens of the classic grammar, and the near misses that deserve a word of their own.

use super::comments::{Comments, skip_comment};
use crate::diagnostic::Span;
use logos::Logos;

/// A kind of token, as in the lexer of thesis appendix A.5, plus what that lexer chokes on.
///
/// White space separates tokens and is not needed between them: a word is a run of letters, so `sphere3.0`
/// is `sphere` and `3.0`. What the last four kinds match is never part of a scene, so that they change the
/// reading of no scene.
#[derive(Logos, Clone, Copy, Debug, PartialEq, Eq)]
#[logos(extras = Comments)]
#[logos(skip r"\s+")]
pub(crate) enum Token {
    /// A run of letters.
    #[regex(r"\p{Alphabetic}+")]
    Word,
    /// Digits without a point; a `-` directly before them belongs to them.
    #[regex(r"-?[0-9]+", priority = 20)]
    Integer,
    /// Digits on both sides of a point; a `-` directly before them belongs to them.
    #[regex(r"-?[0-9]+\.[0-9]+", priority = 20)]
    Real,
    #[token("(", |_| Bracket::Round)]
    #[token("[", |_| Bracket::Square)]
    #[token("{", |_| Bracket::Curly)]
    Open(Bracket),
    #[token(")", |_| Bracket::Round)]
    #[token("]", |_| Bracket::Square)]
    #[token("}", |_| Bracket::Curly)]
    Close(Bracket),
    #[token(",")]
    Comma,
    /// A number as other languages write it: `1.`, `.5`, `+5`, `1e5`, `- 5`, `1.2.3`, with a typographic
    /// minus, or a lone sign.
    #[regex(r"[+-]?[0-9.]*[0-9][0-9.]*([eE][+-]?[0-9]+)?", priority = 10)]
    #[regex(r"[+-][+-][0-9.]*[0-9][0-9.]*([eE][+-]?[0-9]+)?", priority = 10)]
    #[regex(r"[+-][ \t]+[0-9.]*[0-9][0-9.]*", priority = 10)]
    #[regex(r"[−–—][ \t]*[0-9.]*[0-9][0-9.]*([eE][+-]?[0-9]+)?", priority = 10)]
    #[regex(r"[+−–—-]", priority = 5)]
    OddNumber,
    /// What starts a comment in some other language; never handed out.
    #[regex(r"//|#|%|--|\{-|/\*", skip_comment, priority = 30)]
    Comment,
    /// Characters that belong to nothing.
    Unknown,
    /// The end of the file.
    End,
}

/// A kind of bracket.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Bracket {
    Round,
    Square,
    Curly,
}

impl Bracket {
    pub(crate) const fn opening(self) -> &'static str {
        match self {
            Self::Round => "(",
            Self::Square => "[",
            Self::Curly => "{",
        }
    }

    pub(crate) const fn closing(self) -> &'static str {
        match self {
            Self::Round => ")",
            Self::Square => "]",
            Self::Curly => "}",
        }
    }
}

/// A token with its place and text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Lexeme<'s> {
    pub(crate) token: Token,
    pub(crate) span: Span,
    pub(crate) text: &'s str,
}

impl Lexeme<'_> {
    pub(crate) fn is_word(&self, word: &str) -> bool {
        self.token == Token::Word && self.text == word
    }

    /// The token as a message names it: "`(`", "the word `cube`", "the integer `3`", "the end of the file".
    pub(crate) fn describe(&self) -> String {
        match self.token {
            Token::Word | Token::Integer | Token::Real | Token::End => format!("the {}", self.name()),
            _ => self.name(),
        }
    }

    /// The same without the article.
    pub(crate) fn name(&self) -> String {
        let text = quoted(self.text);
        match self.token {
            Token::Word => format!("word {text}"),
            Token::Integer => format!("integer {text}"),
            Token::Real => format!("real number {text}"),
            Token::End => "end of the file".into(),
            _ => text,
        }
    }
}

/// Source text between backticks, cut where it is long.
pub(crate) fn quoted(text: &str) -> String {
    const LONGEST: usize = 40;
    match text.get(..text.floor_char_boundary(LONGEST)) {
        Some(head) if text.len() > LONGEST => format!("`{head}...`"),
        _ => format!("`{text}`"),
    }
}
