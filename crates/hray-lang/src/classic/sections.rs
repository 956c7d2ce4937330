//! The structure of a scene file: the header, the four sections, the end.

use super::grammar::{self, Item};
use super::parser::{Halt, Parser};
use super::repair::{self, WINDOW};
use super::route::Route;
use super::token::{Bracket, Lexeme, Token};
use super::words::nearest;
use crate::diagnostic::Span;

/// A section of the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Section {
    Camera,
    Background,
    Objects,
    Lights,
}

impl Section {
    /// All of them, in the order of the grammar.
    pub(crate) const ALL: [Self; 4] = [Self::Camera, Self::Background, Self::Objects, Self::Lights];

    pub(crate) const fn word(self) -> &'static str {
        match self {
            Self::Camera => "camera",
            Self::Background => "background",
            Self::Objects => "objects",
            Self::Lights => "lights",
        }
    }

    pub(crate) const fn example(self) -> &'static str {
        match self {
            Self::Camera => "{ camera (0.0,0.0,150.0) (100,75) }",
            Self::Background => "{ background (0.8,0.8,0.8) }",
            Self::Objects => "{ objects }",
            Self::Lights => "{ lights (pointLight (30.0,50.0,100.0) (0.8,0.8,0.8)) }",
        }
    }

    fn with_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|section| section.word() == word)
    }
}

/// A section that was met, and where.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Met {
    pub(crate) section: Section,
    pub(crate) span: Span,
}

impl Parser<'_> {
    /// Reads the whole file. Nothing is left to read afterwards, or nothing worth reading.
    pub(crate) fn file(&mut self) -> Result<(), Halt> {
        if self.cursor.now().token == Token::End {
            self.complain_empty();
            return Err(Halt::Stop);
        }
        self.header()?;
        let mut met = Vec::new();
        self.sections(&mut met)?;
        self.complain_order(&met);
        if self.headless && self.cursor.now().token == Token::End {
            return Ok(());
        }
        self.sequence(grammar::FOOTER, is_end).or_else(|halt| self.unless_stopped(halt))?;
        if self.cursor.now().token != Token::End {
            self.complain_trailing();
        }
        Ok(())
    }

    fn header(&mut self) -> Result<(), Halt> {
        let tokens = self.cursor.ahead(WINDOW);
        let starts_well = tokens.first().is_some_and(|first| {
            first.token == Token::Word && nearest(first.text, std::iter::once("renderDescr")).is_some()
        });
        if !starts_well {
            let fits = repair::matches(&Route::new(grammar::HEADER), &tokens);
            let inside = tokens.iter().position(|lexeme| lexeme.is_word("renderDescr"));
            if let Some(before) = inside {
                self.complain_leading(before);
            } else if self.at_section() || self.at_scene() {
                self.complain_headless();
                self.skip_to(Self::at_section);
                return Ok(());
            } else if fits < 3 {
                self.complain_no_scene();
                return Err(Halt::Stop);
            }
        }
        let result = self.sequence(grammar::HEADER, is_section_start);
        match result {
            Ok(()) => {
                self.build_header();
                Ok(())
            }
            Err(halt) => {
                self.unless_stopped(halt)?;
                self.skip_to(Self::at_section);
                if self.cursor.now().token == Token::End { Err(Halt::Stop) } else { Ok(()) }
            }
        }
    }

    fn sections(&mut self, met: &mut Vec<Met>) -> Result<(), Halt> {
        loop {
            let due = Section::ALL.into_iter().find(|section| !met.iter().any(|met| met.section == *section));
            let now = self.cursor.now();
            let section = match (self.section_here(), due) {
                (Some((section, _)), _) => section,
                (None, Some(due)) if now.token != Token::Close(Bracket::Square) => due,
                _ => return Ok(()),
            };
            let span = self.section_here().map_or(now.span, |(_, span)| span);
            if let Some(first) = met.iter().find(|met| met.section == section) {
                self.complain_second(section, span, first.span);
            } else {
                met.push(Met { section, span });
            }
            self.in_last_section = section == Section::Lights && due.is_none_or(|due| due == section);
            self.section_start = now.span;
            let height = self.open.len();
            if let Err(halt) = self.section(section) {
                self.unless_stopped(halt)?;
                self.open.truncate(height);
                if self.cursor.now().span == now.span {
                    self.cursor.bump();
                }
                self.skip_to(|parser| parser.at_section() || parser.at_scene_end());
                if self.cursor.now().token == Token::End {
                    return Err(Halt::Stop);
                }
            }
        }
    }

    fn section(&mut self, section: Section) -> Result<(), Halt> {
        let fixed: fn(&mut Self, &'static [Item]) -> Result<(), Halt> =
            |parser, items| parser.sequence(items, is_section_start);
        match section {
            Section::Camera => {
                fixed(self, grammar::CAMERA)?;
                self.build_camera();
            }
            Section::Background => {
                fixed(self, grammar::BACKGROUND)?;
                self.build_background();
            }
            Section::Objects => {
                let start = self.cursor.now().span;
                self.sequence(grammar::OBJECTS, is_element)?;
                self.note_list_start(section, start);
                self.elements(section)?;
                self.sequence(grammar::OBJECTS_END, is_section_start)?;
            }
            Section::Lights => {
                let start = self.cursor.now().span;
                self.sequence(grammar::LIGHTS, is_element)?;
                self.note_list_start(section, start);
                self.elements(section)?;
                self.sequence(grammar::LIGHTS_END, is_scene_end)?;
            }
        }
        Ok(())
    }

    /// Which section starts here, if any, and where its word stands. Behind a bracket the word may be
    /// misspelt.
    pub(crate) fn section_here(&self) -> Option<(Section, Span)> {
        let now = self.cursor.now();
        match now.token {
            Token::Word => Section::with_word(now.text).map(|section| (section, now.span)),
            Token::Open(_) => {
                let ahead = self.cursor.ahead(2);
                let word = ahead.get(1).filter(|lexeme| lexeme.token == Token::Word)?;
                let known = Section::ALL.iter().map(|section| section.word());
                let exact = Section::with_word(word.text);
                let near = || {
                    let curly = now.token == Token::Open(Bracket::Curly);
                    nearest(word.text, known).filter(|_| curly).and_then(Section::with_word)
                };
                exact.or_else(near).map(|section| (section, word.span))
            }
            _ => None,
        }
    }

    /// Whether a section starts here.
    pub(crate) fn at_section(&self) -> bool {
        self.section_here().is_some()
    }

    /// Whether the word `scene` stands here, or behind a bracket.
    fn at_scene(&self) -> bool {
        self.cursor.ahead(2).iter().any(|lexeme| lexeme.is_word("scene"))
    }

    /// Whether the last bracket of a scene may stand here.
    fn at_scene_end(&self) -> bool {
        self.cursor.now().token == Token::Close(Bracket::Square)
    }

    /// Goes on after a loss, unless there is nothing to go on with.
    pub(crate) fn unless_stopped(&self, halt: Halt) -> Result<(), Halt> {
        if halt == Halt::Stop || self.is_full() { Err(Halt::Stop) } else { Ok(()) }
    }
}

fn is_section_start(lexeme: &Lexeme<'_>) -> bool {
    lexeme.token == Token::Open(Bracket::Curly)
}

fn is_element(lexeme: &Lexeme<'_>) -> bool {
    matches!(lexeme.token, Token::Open(Bracket::Round) | Token::Close(Bracket::Curly))
}

fn is_scene_end(lexeme: &Lexeme<'_>) -> bool {
    lexeme.token == Token::Close(Bracket::Square)
}

fn is_end(lexeme: &Lexeme<'_>) -> bool {
    lexeme.token == Token::End
}
