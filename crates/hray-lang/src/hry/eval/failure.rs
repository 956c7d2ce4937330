//! Why an evaluation ended without a value.

use crate::diagnostic::{Diagnostic, Span};
use std::sync::Arc;

/// Calls that are shown of a trail.
const SHOWN: usize = 6;

/// An error while evaluating, and the calls that led to it.
#[derive(Debug)]
pub(super) struct Failure {
    pub(super) diagnostic: Diagnostic,
    /// The functions that were running, the innermost first, each with the place of its call.
    trail: Vec<(Arc<str>, Span)>,
    /// Calls beyond those kept.
    more: usize,
}

pub(super) type Outcome<T> = Result<T, Box<Failure>>;

impl Failure {
    pub(super) fn new(diagnostic: Diagnostic) -> Box<Self> {
        Box::new(Self { diagnostic, trail: Vec::new(), more: 0 })
    }

    /// Notes that the error happened inside a call.
    pub(super) fn in_call(&mut self, name: Option<&Arc<str>>, span: Span) {
        let Some(name) = name else { return };
        if self.trail.len() < SHOWN {
            self.trail.push((name.clone(), span));
        } else {
            self.more += 1;
        }
    }

    /// The diagnostic with the trail as notes; `place` says where a call is.
    pub(super) fn into_diagnostic(mut self, place: impl Fn(Span) -> String) -> Diagnostic {
        for (name, span) in &self.trail {
            self.diagnostic.notes.push(format!("in `{name}`, called at {}", place(*span)));
        }
        if self.more > 0 {
            self.diagnostic.notes.push(format!("and {} more calls", self.more));
        }
        self.diagnostic
    }
}

impl From<Box<Diagnostic>> for Box<Failure> {
    fn from(diagnostic: Box<Diagnostic>) -> Self {
        Failure::new(*diagnostic)
    }
}
