//! What is known while a source is read: the place, the brackets that are open, the errors so far.

use super::build::Built;
use super::cursor::Cursor;
use super::sections::Met;
use super::token::{Bracket, Token};
use super::values::Values;
use crate::diagnostic::{Diagnostic, Span};

/// After this many errors the rest of the source is not read.
pub(crate) const MOST_ERRORS: usize = 20;
/// After this many errors in one sequence the rest of it is passed over.
pub(crate) const MOST_ERRORS_IN_SEQUENCE: usize = 8;

/// Why reading did not go on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Halt {
    /// What follows fits nothing; reading goes on further down.
    Lost,
    /// The file is at its end, or there are too many errors.
    Stop,
}

/// A bracket that waits for its partner.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OpenBracket {
    /// Its place; none where it is missing in the source and was added in thought.
    pub(crate) span: Option<Span>,
    pub(crate) bracket: Bracket,
    /// What it opens.
    pub(crate) what: &'static str,
}

/// The state of reading.
pub(crate) struct Parser<'s> {
    pub(crate) source: &'s str,
    pub(crate) cursor: Cursor<'s>,
    pub(crate) diagnostics: Vec<Diagnostic>,
    /// The brackets that wait for their partner, innermost last.
    pub(crate) open: Vec<OpenBracket>,
    /// The numbers and words of the sequence that is being read.
    pub(crate) values: Values,
    /// Up to where in the source numbers of the other kind have been reported.
    pub(crate) kinds_reported: usize,
    /// Up to where in the source missing commas have been reported.
    pub(crate) commas_reported: usize,
    /// The sections that were met, in the order of the source.
    pub(crate) met: Vec<Met>,
    /// Whether only the end of the lights section and of the scene are to come.
    pub(crate) in_last_section: bool,
    /// Whether the header is missing, and the last bracket may be with it.
    pub(crate) headless: bool,
    /// Whether lights stand among the objects, and the lights section may be missing for that reason.
    pub(crate) strays: bool,
    /// Where the section that is being read starts.
    pub(crate) section_start: Span,
    /// What has been built.
    pub(crate) built: Built,
}

impl<'s> Parser<'s> {
    pub(crate) fn new(source: &'s str) -> Self {
        Self {
            source,
            cursor: Cursor::new(source),
            diagnostics: Vec::new(),
            open: Vec::new(),
            values: Values::default(),
            kinds_reported: 0,
            commas_reported: 0,
            met: Vec::new(),
            in_last_section: false,
            headless: false,
            strays: false,
            section_start: Span::at(0),
            built: Built::default(),
        }
    }

    /// Whether nothing is wrong so far.
    pub(crate) fn is_clean(&self) -> bool {
        self.diagnostics.is_empty()
    }

    /// Whether no more errors are to be reported.
    pub(crate) fn is_full(&self) -> bool {
        self.diagnostics.len() >= MOST_ERRORS
    }

    /// Adds an error, up to the limit.
    pub(crate) fn report(&mut self, diagnostic: Diagnostic) {
        if !self.is_full() {
            self.diagnostics.push(diagnostic);
        }
    }

    /// The place just after the token before this one.
    pub(crate) fn gap(&self) -> Span {
        Span::at(self.cursor.last().span.end)
    }

    /// Passes tokens up to one for which `stop` holds.
    pub(crate) fn skip_to(&mut self, stop: impl Fn(&Self) -> bool) {
        while self.cursor.now().token != Token::End && !stop(self) {
            self.cursor.bump();
        }
    }
}
