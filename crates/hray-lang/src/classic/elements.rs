//! The lists of a scene: objects and lights, one after the other without separators.

use super::grammar::{self, Item};
use super::parser::{Halt, Parser};
use super::sections::Section;
use super::token::{Bracket, Lexeme, Token};
use super::words::nearest;
use crate::diagnostic::Diagnostic;

/// What stands in a list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Element {
    Object,
    Light,
}

impl Element {
    const fn of(section: Section) -> Self {
        match section {
            Section::Lights => Self::Light,
            _ => Self::Object,
        }
    }

    const fn items(self) -> &'static [Item] {
        match self {
            Self::Object => grammar::OBJECT,
            Self::Light => grammar::LIGHT,
        }
    }

    pub(crate) const fn noun(self) -> &'static str {
        match self {
            Self::Object => "object",
            Self::Light => "light",
        }
    }

    /// The words that an element begins with.
    const fn words(self) -> &'static [&'static str] {
        match self {
            Self::Object => &["object"],
            Self::Light => &["pointLight", "ambientLight"],
        }
    }

    fn with_word(word: &str) -> Option<Self> {
        [Self::Object, Self::Light].into_iter().find(|element| element.words().contains(&word))
    }
}

/// What to do next in a list.
enum Next {
    Read(Element),
    End,
    Again,
}

impl Parser<'_> {
    /// Reads the elements of a section, up to the brace that closes it.
    pub(crate) fn elements(&mut self, section: Section) -> Result<(), Halt> {
        let due = Element::of(section);
        loop {
            let element = match self.next_element(due)? {
                Next::Read(element) => element,
                Next::Again => continue,
                Next::End => return Ok(()),
            };
            if element != due && !self.strays {
                self.complain_stray(element, section);
                self.strays = true;
            }
            self.element(element)?;
        }
    }

    /// Reads one element; after a loss, goes to where the next may start.
    fn element(&mut self, element: Element) -> Result<(), Halt> {
        let height = self.open.len();
        let start = self.cursor.now().span;
        let errors = self.diagnostics.len();
        if let Err(halt) = self.sequence(element.items(), follows_element) {
            self.unless_stopped(halt)?;
            self.open.truncate(height);
            if self.cursor.now().span == start {
                self.cursor.bump();
            }
            self.skip_to(Self::at_element_or_end);
            return if self.cursor.now().token == Token::End { Err(Halt::Stop) } else { Ok(()) };
        }
        if self.diagnostics.len() == errors {
            let span = start.to(self.cursor.last().span);
            match element {
                Element::Object => self.build_primitive(span),
                Element::Light => self.build_light(span),
            }
        }
        Ok(())
    }

    fn next_element(&mut self, due: Element) -> Result<Next, Halt> {
        let now = self.cursor.now();
        if self.is_full() {
            return Err(Halt::Stop);
        }
        match now.token {
            Token::Close(Bracket::Curly | Bracket::Square) => return Ok(Next::End),
            Token::Open(Bracket::Round) => return Ok(Next::Read(self.element_here().unwrap_or(due))),
            Token::End => {
                let expected = format!("another {} or `}}` to close this section", due.noun());
                return Err(self.report_unfinished(&expected, true));
            }
            _ if self.at_section() => return Ok(Next::End),
            Token::Open(_) => return Ok(Next::Read(self.element_here().unwrap_or(due))),
            Token::Word if nearest(now.text, due.words().iter().copied()).is_some() => {
                return Ok(Next::Read(due));
            }
            _ => {}
        }
        self.complain_between(due);
        self.skip_to(|parser| parser.at_element_or_end() || matches!(parser.cursor.now().token, Token::Open(_)));
        Ok(Next::Again)
    }

    /// Which element starts here for certain.
    fn element_here(&self) -> Option<Element> {
        let ahead = self.cursor.ahead(2);
        let [Lexeme { token: Token::Open(_), .. }, word] = ahead[..] else { return None };
        Element::with_word(word.text)
    }

    /// Whether an element starts here for certain, or the list ends.
    fn at_element_or_end(&self) -> bool {
        match self.cursor.now().token {
            Token::Open(_) => self.element_here().is_some() || self.at_section(),
            Token::Word => self.at_section(),
            Token::Close(Bracket::Curly) => {
                let ahead = self.cursor.ahead(2);
                ahead.get(1).is_none_or(|next| {
                    matches!(next.token, Token::Open(Bracket::Curly) | Token::Close(Bracket::Square) | Token::End)
                })
            }
            Token::Close(Bracket::Square) => self.cursor.ahead(2).len() < 2 || self.ends_after_this(),
            _ => false,
        }
    }

    fn ends_after_this(&self) -> bool {
        self.cursor.ahead(2).get(1).is_some_and(|next| next.token == Token::End)
    }

    /// Something between the elements of a list.
    fn complain_between(&mut self, due: Element) {
        let now = self.cursor.now();
        let noun = due.noun();
        let label = format!("expected `(` of another {noun}, or `}}` to close this section");
        let message = match now.token {
            Token::Close(_) => format!("one `{}` too many", now.text),
            _ => format!("unexpected {} between {noun}s", now.name()),
        };
        let error = Diagnostic::error("unexpected-token", message, now.span, label);
        let error = match now.token {
            Token::Comma => error.with_note(format!("{noun}s follow each other without commas")),
            _ => error,
        };
        let error = match now.token {
            Token::Comma | Token::Close(_) | Token::Unknown => error.with_suggestion(now.span, "", "remove it"),
            _ => error,
        };
        self.report(error);
        self.cursor.bump();
    }
}

fn follows_element(lexeme: &Lexeme<'_>) -> bool {
    matches!(lexeme.token, Token::Open(Bracket::Round) | Token::Close(Bracket::Curly))
}
