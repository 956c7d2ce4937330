//! What is said about a text that is not hry: every message of the lexer and the parser, by what it is about.

mod bindings;
mod bracketed;
pub(crate) mod brackets;
pub(crate) mod characters;
mod expressions;
mod found;
pub(crate) mod numbers;
mod patterns;

/// Source text between backticks, cut where it is long.
pub(crate) fn quoted(text: &str) -> String {
    const LONGEST: usize = 40;
    let line = text.lines().next().unwrap_or("");
    match line.get(..line.floor_char_boundary(LONGEST)) {
        Some(head) if line.len() > LONGEST || line.len() < text.len() => format!("`{head}...`"),
        _ => format!("`{line}`"),
    }
}
