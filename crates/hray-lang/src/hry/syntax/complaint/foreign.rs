//! Words of other languages.
//!
//! They are names like any other here, so a text that is right may use them. Where one is wrong, such a word explains it
//! better than whatever the parser stumbled over.

use super::super::kind::SyntaxKind;
use super::super::parser::Parser;
use crate::diagnostic::{Diagnostic, Span};

/// How many tokens before an error may be its cause.
const FAR: usize = 40;

/// Where in a definition a word means something elsewhere.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Place {
    First,
    Any,
}

/// What to do about a word.
enum Remedy {
    /// Advice.
    Help(&'static str),
    /// Leave it out, with the white space after it.
    Remove,
    /// Write something else.
    Replace(&'static str),
}

/// A word, what to say about it, and what to do.
struct Word {
    words: &'static [&'static str],
    place: Place,
    message: &'static str,
    remedy: Remedy,
}

const WORDS: &[Word] = &[
    Word {
        words: &["def", "function", "func", "fn", "fun", "defun", "macro", "proc", "sub"],
        place: Place::First,
        message: "a function is defined by its name and parameters alone",
        remedy: Remedy::Help(
            "write `ring n radius = ...`: no word before the name, no parentheses, no braces",
        ),
    },
    Word {
        words: &[
            "var", "const", "val", "local", "static", "final", "auto", "float", "int", "double", "bool",
            "string", "vec2", "vec3", "vec4", "number",
        ],
        place: Place::First,
        message: "a definition begins with its name",
        remedy: Remedy::Remove,
    },
    Word {
        words: &["type", "data", "newtype", "class", "struct", "enum", "interface", "trait"],
        place: Place::First,
        message: "types are not declared in hry",
        remedy: Remedy::Help(
            "records, lists and functions have the types that their parts give them; delete this",
        ),
    },
    Word {
        words: &["module", "package", "namespace", "program"],
        place: Place::First,
        message: "a file has no header in hry",
        remedy: Remedy::Help("delete this line; a file is its definitions"),
    },
    Word {
        words: &["from", "include", "use", "using", "require", "open"],
        place: Place::First,
        message: "definitions of another file come in with `import`",
        remedy: Remedy::Help("write `import \"palette.hry\" (gold, ink)`"),
    },
    Word {
        words: &["for", "foreach", "forM", "while", "loop", "repeat"],
        place: Place::Any,
        message: "there are no loops in hry; a list is made from another",
        remedy: Remedy::Help("write `[sphere { radius = r } | r <- [1 .. 3]]`: one element for each r"),
    },
    Word {
        words: &["where"],
        place: Place::Any,
        message: "local definitions come before the value, between `let` and `in`",
        remedy: Remedy::Help("write `let y = x * 2 in y + 1`"),
    },
    Word {
        words: &["case", "switch", "of"],
        place: Place::Any,
        message: "a choice by pattern is written `match`, with its arms in braces",
        remedy: Remedy::Help("write `match list { [] -> 0, [first, ..rest] -> first }`"),
    },
    Word {
        words: &["elif", "elsif", "elseif", "elseIf"],
        place: Place::Any,
        message: "another condition follows `else if`",
        remedy: Remedy::Replace("else if"),
    },
    Word {
        words: &["lambda", "function", "func", "fn", "fun"],
        place: Place::Any,
        message: "a function without a name is written with `\\` and `->`",
        remedy: Remedy::Help("write `\\x -> x * 2`"),
    },
    Word {
        words: &["return"],
        place: Place::Any,
        message: "there is no `return`: a definition is its value",
        remedy: Remedy::Remove,
    },
    Word {
        words: &["do"],
        place: Place::Any,
        message: "there are no `do` blocks in hry, because nothing is done one after the other",
        remedy: Remedy::Help("name values with `let ... in ...`, and pass one on with `value |> function`"),
    },
    Word {
        words: &["new"],
        place: Place::Any,
        message: "a thing is made by its name and a record, without `new`",
        remedy: Remedy::Remove,
    },
];

/// Whether other languages put this word before a definition.
pub(crate) fn is_put_before_definitions(text: &str) -> bool {
    WORDS.iter().any(|word| word.place == Place::First && word.words.contains(&text))
}

impl Parser<'_> {
    /// What a word of another language, not far before the current token, has to do with an error here.
    pub(in super::super) fn foreign_word(&self) -> Option<Diagnostic> {
        let first = self.layouts.last()?.first;
        let last = self.at.min(self.tokens.len().saturating_sub(1));
        let near = first.max(last.saturating_sub(FAR))..=last;
        near.rev().find_map(|token| self.word_at(token, first))
    }

    fn word_at(&self, token: usize, first: usize) -> Option<Diagnostic> {
        let is_field = token.checked_sub(1).is_some_and(|before| self.kind_of(before) == SyntaxKind::Dot);
        if self.kind_of(token) != SyntaxKind::Name || is_field || !self.is_said(token + 1) {
            return None;
        }
        let text = self.text_of(token);
        let is_first = token == first;
        let known = |word: &&Word| (word.place == Place::Any || is_first) && word.words.contains(&text);
        let word = WORDS.iter().find(known)?;
        let span = self.span_of(token);
        let label = format!("`{text}` is not a word of hry");
        let error = Diagnostic::error("foreign-word", word.message, span, label);
        let is_block =
            token.checked_sub(1).is_some_and(|before| self.kind_of(before) == SyntaxKind::OpenBrace);
        if text == "return" && is_block {
            return Some(error.with_help("leave out `return` and the braces around it: braces make records"));
        }
        Some(match word.remedy {
            Remedy::Help(help) => error.with_help(help),
            Remedy::Replace(other) => error.with_suggestion(span, other, format!("write `{other}`")),
            Remedy::Remove => {
                let next = self.span_of(token + 1).start;
                error.with_suggestion(Span::new(span.start, next), "", format!("leave out `{text}`"))
            }
        })
    }

    /// Whether what follows a name shows that it is not used as a name.
    fn is_said(&self, next: usize) -> bool {
        use SyntaxKind as S;
        let kind = self.kind_of(next);
        !matches!(
            kind,
            S::Define | S::Comma | S::Dot | S::CloseBrace | S::CloseParen | S::CloseBracket | S::Pipe
        )
    }
}
