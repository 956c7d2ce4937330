//! What was read in one sequence, in the order of the source.

use crate::diagnostic::Span;
use glam::DVec3;
use hray_core::Rgb;

/// The words that chose a form, and the numbers, of one sequence. `build` takes them out again in order.
#[derive(Debug, Default)]
pub(crate) struct Values {
    forms: Vec<&'static str>,
    reals: Vec<f64>,
    integers: Vec<(i64, Span)>,
}

impl Values {
    pub(crate) fn clear(&mut self) {
        self.forms.clear();
        self.reals.clear();
        self.integers.clear();
    }

    pub(crate) fn push_form(&mut self, word: &'static str) {
        self.forms.push(word);
    }

    pub(crate) fn push_real(&mut self, value: f64) {
        self.reals.push(value);
    }

    pub(crate) fn push_integer(&mut self, value: i64, span: Span) {
        self.integers.push((value, span));
    }

    pub(crate) fn reader(&self) -> Reader<'_> {
        Reader { forms: &self.forms, reals: &self.reals, integers: &self.integers }
    }
}

/// Takes values out in order. Where there is none left it gives zero, which happens only after an error.
#[derive(Debug)]
pub(crate) struct Reader<'v> {
    forms: &'v [&'static str],
    reals: &'v [f64],
    integers: &'v [(i64, Span)],
}

impl Reader<'_> {
    /// The word of the next form.
    pub(crate) fn form(&mut self) -> &'static str {
        self.forms.split_off_first().copied().unwrap_or("")
    }

    pub(crate) fn real(&mut self) -> f64 {
        self.reals.split_off_first().copied().unwrap_or(0.0)
    }

    /// The next integer, and where it stands.
    pub(crate) fn integer(&mut self) -> (i64, Span) {
        self.integers.split_off_first().copied().unwrap_or((0, Span::at(0)))
    }

    pub(crate) fn vector(&mut self) -> DVec3 {
        DVec3::new(self.real(), self.real(), self.real())
    }

    pub(crate) fn color(&mut self) -> Rgb {
        Rgb::new(self.real(), self.real(), self.real())
    }
}
