//! From text to tokens.

use super::complaint::{characters, numbers};
use super::kind::SyntaxKind;
use super::parser::MOST_ERRORS;
use crate::diagnostic::{Diagnostic, Span};
use logos::{Lexer, Logos};

/// What the generated lexer tells apart: the tokens of the language, and what users of other languages write instead.
#[derive(Logos, Clone, Copy, Debug, PartialEq, Eq)]
enum Raw {
    #[regex(r"[ \t\r\n]+")]
    Whitespace,
    /// Characters that look like white space, or cannot be seen.
    #[regex(
        "[\u{b}\u{c}\u{85}\u{a0}\u{ad}\u{1680}\u{2000}-\u{200d}\u{2028}\u{2029}\u{202f}\u{205f}\u{2060}\u{3000}\u{feff}]+"
    )]
    OddSpace,
    #[regex(r"--[^\n]*", allow_greedy = true)]
    Comment,
    #[token("{-", block_comment)]
    BlockComment,
    #[token("/*", c_comment)]
    #[regex(r"//[^\n]*", allow_greedy = true)]
    #[regex(r"#[^0-9A-Za-z_\n][^\n]*", allow_greedy = true)]
    #[token("#")]
    ForeignComment,

    #[regex(r"[0-9][0-9_]*(\.[0-9][0-9_]*)?([eE][+-]?[0-9][0-9_]*)?(deg)?", priority = 20)]
    Number,
    #[regex(r"[0-9][0-9_]*(\.[0-9][0-9_]*)*([\p{XID_Start}_][\p{XID_Continue}]*)?", priority = 10)]
    OddNumber,
    #[regex(r"#[0-9A-Za-z_]+")]
    Color,
    #[regex(r#""([^"\\\n]|\\[^\n])*""#)]
    Text,
    #[regex(r#""([^"\\\n]|\\[^\n])*\\?"#)]
    UnclosedText,
    #[regex(r"'[^'\n]*'")]
    #[regex(
        "[\u{201c}\u{201d}\u{201e}\u{ab}\u{bb}][^\u{201c}\u{201d}\u{ab}\u{bb}\"\n]*[\u{201c}\u{201d}\u{ab}\u{bb}\"]"
    )]
    #[regex("[\u{2018}\u{2019}][^\u{2018}\u{2019}'\n]*[\u{2018}\u{2019}']")]
    OddText,
    #[regex(r"[\p{XID_Start}_][\p{XID_Continue}']*")]
    Name,

    #[token("(")]
    OpenParen,
    #[token(")")]
    CloseParen,
    #[token("[")]
    OpenBracket,
    #[token("]")]
    CloseBracket,
    #[token("{")]
    OpenBrace,
    #[token("}")]
    CloseBrace,
    #[token("|>")]
    Pipe,
    #[token(">>")]
    Compose,
    #[token("++")]
    Append,
    #[token("+")]
    Plus,
    #[token("-")]
    Minus,
    #[token("*")]
    Star,
    #[token("/")]
    Slash,
    #[token("%")]
    Percent,
    #[token("^")]
    Caret,
    #[token("==")]
    Equal,
    #[token("!=")]
    NotEqual,
    #[token("<")]
    Less,
    #[token("<=")]
    LessEqual,
    #[token(">")]
    Greater,
    #[token(">=")]
    GreaterEqual,
    #[token("=")]
    Define,
    #[token("->")]
    Arrow,
    #[token("<-")]
    From,
    #[token("|")]
    Bar,
    #[token("\\")]
    Backslash,
    #[token(".")]
    Dot,
    #[token("..")]
    DotDot,
    #[token(",")]
    Comma,
    #[token(":")]
    Colon,
    #[token(";")]
    Semicolon,
    #[token("!")]
    Bang,

    #[token("&&")]
    #[token("&")]
    #[token("\u{2227}")]
    OddAnd,
    #[token("||")]
    #[token("\u{2228}")]
    OddOr,
    #[token("\u{ac}")]
    OddNot,
    #[token("===")]
    OddEqual,
    #[token("!==")]
    #[token("/=")]
    #[token("=/=")]
    #[token("<>")]
    #[token("\u{2260}")]
    OddNotEqual,
    #[token("=<")]
    #[token("\u{2264}")]
    OddLessEqual,
    #[token("\u{2265}")]
    OddGreaterEqual,
    #[token("**")]
    OddPower,
    #[token("=>")]
    #[token("\u{2192}")]
    #[token("\u{21d2}")]
    OddArrow,
    #[token("\u{2190}")]
    OddFrom,
    #[token(":=")]
    #[token("+=")]
    #[token("-=")]
    #[token("*=")]
    OddDefine,
    #[token("::")]
    OddColon,
    #[token("...")]
    #[token("\u{2026}")]
    OddDotDot,
    #[token("\u{2212}")]
    #[token("\u{2013}")]
    #[token("\u{2014}")]
    OddMinus,
    #[token("\u{d7}")]
    #[token("\u{b7}")]
    #[token("\u{22c5}")]
    OddTimes,
    #[token("\u{f7}")]
    OddDivide,
    #[token("<<")]
    OddCompose,
    #[token("<|")]
    OddApply,
}

/// Takes a comment that nests, after its `{-`.
fn block_comment(lexer: &mut Lexer<'_, Raw>) {
    let (mut open, mut at) = (1_usize, 0);
    let bytes = lexer.remainder().as_bytes();
    while open > 0 && at < bytes.len() {
        match bytes.get(at..at + 2) {
            Some(b"{-") => (open, at) = (open + 1, at + 2),
            Some(b"-}") => (open, at) = (open - 1, at + 2),
            _ => at += 1,
        }
    }
    lexer.bump(at);
}

/// Takes a comment of C, after its `/*`.
fn c_comment(lexer: &mut Lexer<'_, Raw>) {
    let rest = lexer.remainder();
    lexer.bump(rest.find("*/").map_or(rest.len(), |at| at + 2));
}

/// Whether a text that begins with `{-` ends where that comment is closed.
pub(crate) fn is_closed_comment(text: &str) -> bool {
    let mut open = 0_usize;
    let (bytes, mut at) = (text.as_bytes(), 0);
    while at < bytes.len() {
        match bytes.get(at..at + 2) {
            Some(b"{-") => (open, at) = (open + 1, at + 2),
            Some(b"-}") => (open, at) = (open.saturating_sub(1), at + 2),
            _ => at += 1,
        }
    }
    open == 0
}

/// A token that means something; white space and comments are what lies between.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Token {
    pub(crate) kind: SyntaxKind,
    /// Whether it is the first of its line.
    pub(crate) starts_line: bool,
    /// Whether white space or a comment is directly before it.
    pub(crate) spaced: bool,
    /// Its first byte.
    pub(crate) start: u32,
    /// One past its last byte.
    pub(crate) end: u32,
    /// How many characters are before it on its line.
    pub(crate) column: u32,
}

/// Where the current line began, in characters.
struct Line {
    start: usize,
    /// How many bytes since then are not the first of their character.
    extra: usize,
}

/// The tokens of a text of less than 4 GiB, and complaints about its characters.
pub(crate) fn lex(text: &str, base: usize) -> (Vec<Token>, Vec<Diagnostic>) {
    let mut tokens = Vec::with_capacity(text.len() / 4);
    let mut errors = Vec::new();
    let is_ascii = text.is_ascii();
    let mut line = Line { start: 0, extra: 0 };
    let (mut starts_line, mut last_end) = (true, 0);
    let mut lexer = Raw::lexer(text);
    while let Some(raw) = lexer.next() {
        let kind = match raw {
            Ok(raw) => meant(raw, &mut lexer, base, &mut errors),
            Err(()) => {
                if errors.len() < MOST_ERRORS {
                    errors.push(characters::unknown(lexer.slice(), place(&lexer, base)));
                }
                SyntaxKind::Unknown
            }
        };
        let span = lexer.span();
        if kind.is_trivia() {
            let slice = lexer.slice();
            match slice.rfind('\n').map(|at| at + 1) {
                Some(after) => {
                    starts_line = true;
                    line.start = span.start + after;
                    line.extra = if is_ascii { 0 } else { extra_bytes(slice.get(after..).unwrap_or("")) };
                }
                None if !is_ascii => line.extra += extra_bytes(slice),
                None => {}
            }
            if span.start == 0 && slice.starts_with('\u{feff}') {
                line.start = '\u{feff}'.len_utf8();
                line.extra = 0;
            }
            continue;
        }
        tokens.push(Token {
            kind,
            starts_line,
            spaced: span.start > last_end,
            start: span.start as u32,
            end: span.end as u32,
            column: (span.start - line.start).saturating_sub(line.extra) as u32,
        });
        if !is_ascii {
            line.extra += extra_bytes(lexer.slice());
        }
        (starts_line, last_end) = (false, span.end);
    }
    (tokens, errors)
}

fn extra_bytes(text: &str) -> usize {
    text.bytes().filter(|byte| *byte & 0xc0 == 0x80).count()
}

fn place(lexer: &Lexer<'_, Raw>, base: usize) -> Span {
    Span::new(base + lexer.span().start, base + lexer.span().end)
}

/// The kind of token that was meant. What is not written as the language wants it is reported here and taken for what it
/// looks like, so that nothing else has to be wrong because of it.
fn meant(raw: Raw, lexer: &mut Lexer<'_, Raw>, base: usize, errors: &mut Vec<Diagnostic>) -> SyntaxKind {
    use SyntaxKind as S;
    let kind = match raw {
        Raw::Whitespace => return S::Whitespace,
        Raw::Comment => return S::Comment,
        Raw::Name => return name(lexer.slice()),
        Raw::Number => return number(lexer, base, errors),
        Raw::OpenParen => return S::OpenParen,
        Raw::CloseParen => return S::CloseParen,
        Raw::OpenBracket => return S::OpenBracket,
        Raw::CloseBracket => return S::CloseBracket,
        Raw::OpenBrace => return S::OpenBrace,
        Raw::CloseBrace => return S::CloseBrace,
        Raw::Pipe => return S::Pipe,
        Raw::Compose => return S::Compose,
        Raw::Append => return S::Append,
        Raw::Plus => return S::Plus,
        Raw::Minus => return S::Minus,
        Raw::Star => return S::Star,
        Raw::Slash => return S::Slash,
        Raw::Percent => return S::Percent,
        Raw::Caret => return S::Caret,
        Raw::Equal => return S::Equal,
        Raw::NotEqual => return S::NotEqual,
        Raw::Less => return S::Less,
        Raw::LessEqual => return S::LessEqual,
        Raw::Greater => return S::Greater,
        Raw::GreaterEqual => return S::GreaterEqual,
        Raw::Define => return S::Define,
        Raw::Arrow => return S::Arrow,
        Raw::From => return S::From,
        Raw::Bar => return S::Bar,
        Raw::Backslash => return S::Backslash,
        Raw::Dot => return S::Dot,
        Raw::DotDot => return S::DotDot,
        Raw::Comma => return S::Comma,
        Raw::Colon => return S::Colon,
        Raw::Semicolon => return S::Semicolon,
        Raw::Bang => return S::Bang,
        Raw::BlockComment => S::BlockComment,
        Raw::OddSpace => S::Whitespace,
        Raw::ForeignComment => S::Comment,
        Raw::OddNumber => S::Number,
        Raw::Color => S::Color,
        Raw::Text | Raw::UnclosedText | Raw::OddText => S::Text,
        Raw::OddAnd => S::AndKeyword,
        Raw::OddOr => S::OrKeyword,
        Raw::OddNot => S::NotKeyword,
        Raw::OddEqual => S::Equal,
        Raw::OddNotEqual => S::NotEqual,
        Raw::OddLessEqual => S::LessEqual,
        Raw::OddGreaterEqual => S::GreaterEqual,
        Raw::OddPower => S::Caret,
        Raw::OddArrow => S::Arrow,
        Raw::OddFrom => S::From,
        Raw::OddDefine => S::Define,
        Raw::OddColon => S::Colon,
        Raw::OddDotDot => S::DotDot,
        Raw::OddMinus => S::Minus,
        Raw::OddTimes => S::Star,
        Raw::OddDivide => S::Slash,
        Raw::OddCompose => S::Compose,
        Raw::OddApply => S::Unknown,
    };
    let (text, span) = (lexer.slice(), place(lexer, base));
    let error = match raw {
        Raw::BlockComment => characters::block_comment(text, span),
        Raw::OddSpace if span.start == base && text == "\u{feff}" => None,
        Raw::OddSpace => Some(characters::odd_space(text, span)),
        Raw::ForeignComment => Some(characters::foreign_comment(text, span)),
        Raw::OddNumber => Some(numbers::odd_number(text, span)),
        Raw::Color => numbers::color(text, span),
        Raw::Text => characters::escapes(text, span),
        Raw::UnclosedText => Some(characters::unclosed_text(text, span)),
        Raw::OddText => Some(characters::odd_text(text, span)),
        _ => Some(characters::foreign_operator(text, kind, span)),
    };
    if errors.len() < MOST_ERRORS {
        errors.extend(error);
    }
    kind
}

fn name(text: &str) -> SyntaxKind {
    if text == "_" {
        return SyntaxKind::Underscore;
    }
    if let Some(keyword) = SyntaxKind::keyword(text) {
        return keyword;
    }
    match text.chars().next() {
        Some(initial) if initial.is_uppercase() => SyntaxKind::TypeName,
        _ => SyntaxKind::Name,
    }
}

/// A `%` directly after the digits belongs to them, unless an operand follows it directly.
fn number(lexer: &mut Lexer<'_, Raw>, base: usize, errors: &mut Vec<Diagnostic>) -> SyntaxKind {
    let mut rest = lexer.remainder().chars();
    if rest.next() == Some('%') && !lexer.slice().ends_with("deg") {
        match rest.next() {
            Some(next) if next.is_alphanumeric() || matches!(next, '(' | '_') => {
                errors.push(numbers::tight_modulo(lexer.slice(), lexer.remainder(), place(lexer, base)));
            }
            _ => lexer.bump(1),
        }
    }
    errors.extend(numbers::too_large(lexer.slice(), place(lexer, base)));
    SyntaxKind::Number
}

/// The white space and comments between two tokens, each with its kind.
pub(crate) fn trivia(text: &str) -> impl Iterator<Item = (SyntaxKind, &str)> {
    let mut lexer = Raw::lexer(text);
    std::iter::from_fn(move || {
        let kind = match lexer.next()? {
            Ok(Raw::Whitespace | Raw::OddSpace) => SyntaxKind::Whitespace,
            Ok(Raw::Comment | Raw::ForeignComment) => SyntaxKind::Comment,
            Ok(Raw::BlockComment) => SyntaxKind::BlockComment,
            _ => SyntaxKind::Unknown,
        };
        Some((kind, lexer.slice()))
    })
}
