//! The formatter: one layout for every file.
//!
//! A line is at most [`WIDTH`] characters wide where that can be had. What fits on a line is put there, except where the
//! author broke it: brackets with a line break after the opening one, a pipeline with one before a `|>`, an `if` or a
//! `let` over several lines stay broken. Comments stay beside what they are beside; parentheses, numbers, colours and
//! texts stay as they are written. Formatting twice changes nothing more, and the meaning never changes.
//!
//! - `source`: what the text says about widths, comments and line breaks, in tables that answer at once.
//! - `writer`: puts tokens and comments on lines.
//! - `items`, `exprs`, `brackets`: the layout of every kind of node.

mod brackets;
mod exprs;
mod items;
mod source;
mod writer;

use super::syntax::parse;
use crate::diagnostic::Diagnostic;
use source::Source;
use writer::Writer;

/// How many characters a line has.
pub const WIDTH: usize = 100;

/// The text in the canonical layout.
///
/// # Errors
///
/// The syntax errors, where there are any: a text that is not understood is not touched.
pub fn format(text: &str) -> Result<String, Vec<Diagnostic>> {
    let parse = parse(text, 0);
    if !parse.errors().is_empty() {
        return Err(parse.errors().to_vec());
    }
    let source = Source::new(text, &parse);
    let mut writer = Writer::new(&source);
    writer.file();
    Ok(writer.finish())
}
