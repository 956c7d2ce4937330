//! Tokens and comments, put on lines.

use super::WIDTH;
use super::source::{Comment, Source};

/// What is to be before the next token.
#[derive(Clone, Copy, Debug)]
pub(super) enum Lead {
    /// Nothing, or a space where the tokens need one.
    Flat,
    /// A new line.
    Line(Line),
}

/// A new line.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    pub(super) indent: usize,
    /// Where comments before the token begin.
    pub(super) comments: usize,
    /// Whether an empty line of the author's is kept.
    pub(super) keeps_empty: bool,
}

impl Lead {
    /// A new line.
    pub(super) const fn line(indent: usize) -> Self {
        Self::Line(Line { indent, comments: indent, keeps_empty: false })
    }

    /// A new line, with an empty one before it where there was one.
    pub(super) const fn item(indent: usize) -> Self {
        Self::Line(Line { indent, comments: indent, keeps_empty: true })
    }

    /// A new line for what closes something whose insides are indented.
    pub(super) const fn closing(indent: usize, inside: usize) -> Self {
        Self::Line(Line { indent, comments: inside, keeps_empty: false })
    }
}

pub(super) struct Writer<'s, 't> {
    pub(super) source: &'s Source<'t>,
    out: String,
    column: usize,
    pub(super) lead: Lead,
    /// Where a line begins that a comment makes necessary.
    pub(super) continuation: usize,
    /// Whether the line is closed by a comment.
    is_closed: bool,
    /// Comments of a comma that was written before them.
    deferred: Vec<Comment<'t>>,
}

impl<'s, 't> Writer<'s, 't> {
    pub(super) fn new(source: &'s Source<'t>) -> Self {
        Self {
            source,
            out: String::new(),
            column: 0,
            lead: Lead::item(0),
            continuation: 2,
            is_closed: false,
            deferred: Vec::new(),
        }
    }

    /// The whole, with the comments after the last token.
    pub(super) fn finish(mut self) -> String {
        let end = self.source.token_count();
        self.lead = Lead::item(0);
        self.comments(end);
        if !self.out.is_empty() {
            self.out.push('\n');
        }
        self.out
    }

    /// How many lines there are so far.
    pub(super) fn length(&self) -> usize {
        self.out.len()
    }

    /// Whether what was written since then has several lines.
    pub(super) fn is_broken_since(&self, length: usize) -> bool {
        self.out.get(length..).is_some_and(|text| text.contains('\n'))
    }

    pub(super) fn ends_with_bracket(&self) -> bool {
        self.out.ends_with([')', ']', '}'])
    }

    /// The column where a token would begin.
    pub(super) fn start_column(&self, token: u32) -> usize {
        match self.lead {
            Lead::Line(line) => line.indent,
            Lead::Flat if self.is_closed => self.continuation,
            Lead::Flat if self.deferred.is_empty() && !self.source.has_comments(token) => {
                self.column + usize::from(self.source.is_spaced(token))
            }
            Lead::Flat => self.column_after_comments(token),
        }
    }

    /// The column where a token would begin after the comments before it.
    fn column_after_comments(&self, token: u32) -> usize {
        let (mut column, mut is_closed) = (self.column, self.is_closed);
        for comment in self.deferred.iter().copied().chain(self.source.comments(token)) {
            let start = if comment.breaks > 0 || is_closed { self.continuation } else { column + 1 };
            column = start + comment.text.chars().count();
            is_closed = comment.closes_line();
        }
        if is_closed { self.continuation } else { column + 1 }
    }

    /// The column of the token that was just written.
    pub(super) fn column_of(&self, token: u32) -> usize {
        self.column.saturating_sub(self.source.token_text(token).chars().count())
    }

    /// Whether some tokens fit on the line, with `rest` characters after them.
    pub(super) fn fits(&self, first: u32, end: u32, rest: usize) -> bool {
        let start = self.start_column(first);
        self.source.flat_width(first, end).is_some_and(|width| start + width + rest <= WIDTH)
    }

    /// Writes a token after what leads to it.
    pub(super) fn token(&mut self, token: u32) {
        let lead = self.lead;
        let had_comment = self.comments(token);
        match lead {
            Lead::Line(line) => {
                let is_empty = line.keeps_empty && self.source.breaks_before(token) > 1;
                self.new_line(line.indent, is_empty);
            }
            Lead::Flat if self.is_closed => self.new_line(self.continuation, false),
            Lead::Flat if had_comment || self.source.is_spaced(token) => self.space(),
            Lead::Flat => {}
        }
        self.text(self.source.token_text(token));
        self.lead = Lead::Flat;
    }

    /// Writes tokens on one line, after what leads to them.
    pub(super) fn tokens(&mut self, first: u32, end: u32) {
        for token in first..end {
            if !self.source.is_last_comma(token) {
                self.token(token);
            } else {
                self.defer(token);
            }
        }
    }

    /// Writes a comma directly after what is there; the comments before `token`, which it is in the text, come later.
    pub(super) fn comma(&mut self, token: Option<u32>) {
        self.text(",");
        if let Some(token) = token {
            self.defer(token);
        }
    }

    fn defer(&mut self, token: u32) {
        self.deferred.extend(self.source.comments(token));
    }

    /// Writes the comments before a token; whether there are any.
    fn comments(&mut self, token: u32) -> bool {
        let mut comments = std::mem::take(&mut self.deferred);
        comments.extend(self.source.comments(token));
        for comment in &comments {
            self.comment(*comment);
        }
        !comments.is_empty()
    }

    fn comment(&mut self, comment: Comment<'t>) {
        let is_apart = comment.breaks > 0 || self.is_closed || self.out.is_empty();
        if is_apart {
            match self.lead {
                Lead::Line(line) => self.new_line(line.comments, line.keeps_empty && comment.breaks > 1),
                Lead::Flat => self.new_line(self.continuation, false),
            }
        } else {
            self.space();
        }
        if comment.text.contains('\r') {
            self.text(&comment.text.replace("\r\n", "\n").replace('\r', " "));
        } else {
            self.text(comment.text);
        }
        self.is_closed = comment.closes_line();
    }

    /// A space that no token asks for.
    pub(super) fn pad(&mut self) {
        self.text(" ");
    }

    fn text(&mut self, text: &str) {
        self.out.push_str(text);
        match text.rfind('\n') {
            Some(at) => self.column = text.get(at + 1..).unwrap_or("").chars().count(),
            None => self.column += text.chars().count(),
        }
    }

    fn space(&mut self) {
        if self.column > 0 && !self.out.ends_with(' ') {
            self.text(" ");
        }
    }

    fn new_line(&mut self, indent: usize, is_empty: bool) {
        if !self.out.is_empty() {
            self.out.truncate(self.out.trim_end_matches(' ').len());
            self.out.push_str(if is_empty { "\n\n" } else { "\n" });
            self.out.extend(std::iter::repeat_n(' ', indent));
            self.column = indent;
        }
        self.is_closed = false;
    }
}
