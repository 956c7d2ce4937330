//! The lists of a scene: objects and lights, one after the other without separators.

use super::grammar::{self, Item};
use super::parser::{Halt, Parser};
use super::sections::Section;
use super::token::{Bracket, Lexeme, Token};
use super::words::nearest;

/// What stands in a list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Element {
    Object,
    Light,
}

impl Element {
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

    pub(crate) fn with_word(word: &str) -> Option<Self> {
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
    pub(crate) fn elements(&mut self, section: Section, due: Element) -> Result<(), Halt> {
        loop {
            let element = match self.next_element(section, due)? {
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

    fn next_element(&mut self, section: Section, due: Element) -> Result<Next, Halt> {
        let now = self.cursor.now();
        if self.is_full() {
            return Err(Halt::Stop);
        }
        match now.token {
            Token::Close(Bracket::Curly | Bracket::Square) => return Ok(Next::End),
            Token::Open(Bracket::Round) if !self.is_before_section() => {
                return Ok(Next::Read(self.element_here().unwrap_or(due)));
            }
            Token::End => {
                let expected = format!("another {} or `}}` to close this section", due.noun());
                return Err(self.report_unfinished(&expected, true));
            }
            Token::Word if now.text == section.word() => {
                self.complain_doubled(&now);
                return Ok(Next::Again);
            }
            _ if self.at_section() => return Ok(Next::End),
            Token::Open(Bracket::Curly | Bracket::Square) => {
                return Ok(Next::Read(self.element_here().unwrap_or(due)));
            }
            Token::Word if self.is_bare_element(due) => return Ok(Next::Read(due)),
            _ => {}
        }
        self.complain_between(due);
        self.skip_to(|parser| {
            let now = parser.cursor.now();
            let starts = matches!(now.token, Token::Open(_)) || Element::with_word(now.text).is_some();
            starts || parser.at_element_or_end()
        });
        Ok(Next::Again)
    }

    /// Whether an element starts here but for its bracket.
    fn is_bare_element(&self, due: Element) -> bool {
        self.cursor.after().token == Token::Open(Bracket::Round)
            && nearest(self.cursor.now().text, due.words().iter().copied()).is_some()
    }

    /// Whether another element stands here, after the brace that closes its section.
    pub(crate) fn goes_on(&self, element: Element) -> bool {
        match self.cursor.now().token {
            Token::Open(Bracket::Round) => self.element_here() == Some(element),
            Token::Word => self.is_bare_element(element),
            _ => false,
        }
    }

    /// Whether a section starts after the bracket here.
    fn is_before_section(&self) -> bool {
        self.cursor.after().token == Token::Open(Bracket::Curly)
            && self.cursor.ahead(3).get(2).is_some_and(|word| Section::with_word(word.text).is_some())
    }

    /// Which element starts here for certain.
    fn element_here(&self) -> Option<Element> {
        match self.cursor.now().token {
            Token::Open(_) => Element::with_word(self.cursor.after().text),
            _ => None,
        }
    }

    /// Whether an element starts here for certain, or the list ends.
    fn at_element_or_end(&self) -> bool {
        match self.cursor.now().token {
            Token::Open(_) => self.element_here().is_some() || self.at_section(),
            Token::Word => self.at_section(),
            Token::Close(Bracket::Curly) => matches!(
                self.cursor.after().token,
                Token::Open(Bracket::Curly) | Token::Close(Bracket::Square) | Token::End
            ),
            _ => self.at_last_bracket(),
        }
    }
}

fn follows_element(lexeme: &Lexeme<'_>) -> bool {
    matches!(lexeme.token, Token::Open(Bracket::Round) | Token::Close(Bracket::Curly))
}
