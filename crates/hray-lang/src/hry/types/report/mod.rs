//! Errors in words: what was found, what was expected, and why.

mod arguments;
mod constructors;
mod demands;
mod fields;
mod hints;
mod literals;
mod mismatch;
mod operands;
mod ranges;

use super::infer::Infer;
use super::print::Printer;
use super::store::Ty;
use crate::diagnostic::Span;

/// Source text that is longer is not repeated in a suggestion.
const LONGEST_QUOTED: usize = 120;

impl<'p> Infer<'p> {
    /// A type as it is written.
    pub(super) fn show(&self, ty: Ty) -> String {
        Printer::new(&self.types.store).show(ty)
    }

    /// A type in words, with an article.
    pub(super) fn words(&self, ty: Ty) -> String {
        Printer::new(&self.types.store).words(ty)
    }

    /// A type in words, several of it.
    pub(super) fn words_of_several(&self, ty: Ty) -> String {
        Printer::new(&self.types.store).several(ty)
    }

    /// The text at a place.
    pub(super) fn text(&self, span: Span) -> &'p str {
        self.sources.text(span)
    }

    /// The text at a place, where it is short and on one line.
    pub(super) fn quoted(&self, span: Span) -> Option<&'p str> {
        let text = self.text(span);
        (!text.is_empty() && text.len() <= LONGEST_QUOTED && !text.contains('\n')).then_some(text)
    }
}
