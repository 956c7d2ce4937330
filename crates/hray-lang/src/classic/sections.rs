//! The structure of a scene file: the header, the four sections, the end.

use super::elements::Element;
use super::grammar::{self, Item};
use super::parser::{Halt, Parser};
use super::repair::{self, WINDOW};
use super::route::Route;
use super::token::{Bracket, Lexeme, Token};
use super::words::{WORDS, nearest};
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

    /// Whether these tokens may follow its word.
    fn may_go_on_with(self, tokens: &[Lexeme<'_>]) -> bool {
        let element = match self {
            Self::Camera | Self::Background => None,
            Self::Objects => Some(Element::Object),
            Self::Lights => Some(Element::Light),
        };
        match tokens {
            [Lexeme { token: Token::Open(Bracket::Round), .. }, next] => {
                element.is_none() || Element::with_word(next.text) == element
            }
            [Lexeme { token: Token::Close(Bracket::Curly), .. }, ..] => element.is_some(),
            _ => false,
        }
    }

    /// What it begins with, enough to tell it from the others.
    const fn beginning(self) -> &'static [Item] {
        match self {
            Self::Camera => grammar::CAMERA,
            Self::Background => grammar::BACKGROUND,
            Self::Objects => grammar::OBJECTS_AHEAD,
            Self::Lights => grammar::LIGHTS_AHEAD,
        }
    }

    pub(crate) fn with_word(word: &str) -> Option<Self> {
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
        self.sections()?;
        self.complain_order();
        if self.headless && self.cursor.now().token == Token::End {
            return Ok(());
        }
        self.sequence(grammar::FOOTER, is_end)?;
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

    fn sections(&mut self) -> Result<(), Halt> {
        while let Some((section, span)) = self.next_section() {
            match self.met.iter().find(|met| met.section == section).copied() {
                Some(first) => self.complain_second(section, span, first.span),
                None => self.met.push(Met { section, span }),
            }
            self.in_last_section = section == Section::Lights && self.due().is_none();
            self.section_start = self.cursor.now().span;
            let height = self.open.len();
            if let Err(halt) = self.section(section) {
                self.unless_stopped(halt)?;
                self.open.truncate(height);
                if self.cursor.now().span == self.section_start {
                    self.cursor.bump();
                }
                self.skip_to(|parser| parser.at_section() || parser.at_scene_end());
                if self.cursor.now().token == Token::End {
                    return Err(Halt::Stop);
                }
            }
        }
        Ok(())
    }

    /// The sections that have not been met, in the order of the grammar.
    pub(crate) fn unmet(&self) -> impl Iterator<Item = Section> {
        let is_met = |section: &Section| self.met.iter().any(|met| met.section == *section);
        Section::ALL.into_iter().filter(move |section| !is_met(section))
    }

    /// The first of them.
    fn due(&self) -> Option<Section> {
        self.unmet().next()
    }

    /// The section to read next, and where its word stands.
    fn next_section(&self) -> Option<(Section, Span)> {
        let now = self.cursor.now();
        match (self.section_here(), self.due()) {
            // A word can be wrong: what follows it counts, too.
            (Some((found, span)), Some(due)) if found != due => {
                let tokens = self.cursor.ahead(2 * WINDOW);
                let misfit = |section: Section| repair::cost(&Route::new(section.beginning()), &tokens);
                Some((if misfit(due) < misfit(found) { due } else { found }, span))
            }
            (None, Some(due)) if !self.at_last_bracket() => Some((due, now.span)),
            (here, _) => here,
        }
    }

    fn section(&mut self, section: Section) -> Result<(), Halt> {
        match section {
            Section::Camera => {
                self.sequence(grammar::CAMERA, is_section_start)?;
                self.build_camera();
            }
            Section::Background => {
                self.sequence(grammar::BACKGROUND, is_section_start)?;
                self.build_background();
            }
            Section::Objects => {
                self.list(
                    section,
                    Element::Object,
                    [grammar::OBJECTS, grammar::OBJECTS_END],
                    is_section_start,
                )?;
            }
            Section::Lights => {
                self.list(section, Element::Light, [grammar::LIGHTS, grammar::LIGHTS_END], is_scene_end)?;
            }
        }
        Ok(())
    }

    fn list(
        &mut self,
        section: Section,
        element: Element,
        [start, end]: [&'static [Item]; 2],
        follows: fn(&Lexeme<'_>) -> bool,
    ) -> Result<(), Halt> {
        self.sequence(start, is_element)?;
        self.note_list_start(section, self.section_start.to(self.cursor.last().span));
        loop {
            self.elements(section, element)?;
            let open = self.open.last().copied();
            self.sequence(end, follows)?;
            if !self.goes_on(element) {
                return Ok(());
            }
            self.complain_closed_early(section, element);
            self.open.extend(open);
        }
    }

    /// Which section starts here, if any, and where its word stands. Behind a brace the word may be
    /// misspelt; without one it counts only where it is due.
    pub(crate) fn section_here(&self) -> Option<(Section, Span)> {
        let now = self.cursor.now();
        match now.token {
            Token::Word => {
                let due = self.due().filter(|section| section.word() == now.text)?;
                due.may_go_on_with(self.cursor.ahead(3).get(1..)?).then_some((due, now.span))
            }
            Token::Open(bracket @ (Bracket::Curly | Bracket::Square)) => {
                let word = self.cursor.after();
                if word.token != Token::Word {
                    return None;
                }
                let exact = Section::with_word(word.text);
                let near = || {
                    let may_be = bracket == Bracket::Curly && !WORDS.contains(&word.text);
                    let known = Section::ALL.iter().map(|section| section.word());
                    nearest(word.text, known).filter(|_| may_be).and_then(Section::with_word)
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
        self.cursor.now().is_word("scene") || self.cursor.after().is_word("scene")
    }

    /// Whether the last bracket of a scene stands here.
    pub(crate) fn at_last_bracket(&self) -> bool {
        self.at_scene_end() && self.cursor.after().token == Token::End
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
