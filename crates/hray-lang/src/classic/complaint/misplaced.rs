//! Something is wrong with the file as a whole, or with its sections.

use crate::classic::elements::Element;
use crate::classic::parser::Parser;
use crate::classic::sections::Section;
use crate::classic::token::{Lexeme, Token, quoted};
use crate::diagnostic::{Diagnostic, Span};

/// The smallest scene that shows something.
const MINIMAL: &str = "\
a small scene looks like this:
renderDescr ( resolution (400,300) ) 3 [
scene { camera (0.0,0.0,150.0) (100,75) }
      { background (0.8,0.8,0.8) }
      { objects (object ( sphere 40.0 (0.0,0.0,-150.0) )
                        ( texture ( diff solid (0.8,0.2,0.2) ) 0.3 60 0.0 0.0 )) }
      { lights (pointLight (100.0,100.0,100.0) (0.8,0.8,0.8)) } ]";

const ORDER: &str = "the sections of a scene are camera, background, objects and lights, in this order";

impl Parser<'_> {
    pub(crate) fn complain_empty(&mut self) {
        let span = Span::at(self.cursor.now().span.end);
        let error =
            Diagnostic::error("empty-file", "the file contains no scene", span, "expected `renderDescr`");
        self.report(error.with_note(MINIMAL));
    }

    pub(crate) fn complain_no_scene(&mut self) {
        let now = self.cursor.now();
        let rest = self.source.get(now.span.start..).unwrap_or_default();
        let found = quoted(rest.split_whitespace().next().unwrap_or_default());
        let label = format!("a scene begins with `renderDescr`, not with {found}");
        let error = Diagnostic::error("no-scene", "this is not a scene", now.span, label);
        self.report(error.with_note(MINIMAL));
    }

    /// `count` tokens stand before the start of the scene.
    pub(crate) fn complain_leading(&mut self, count: usize) {
        let first = self.cursor.now().span;
        for _ in 0..count {
            self.cursor.bump();
        }
        let span = first.to(self.cursor.last().span);
        let error = Diagnostic::error(
            "text-before-scene",
            "text before the scene",
            span,
            "a scene begins with `renderDescr`",
        );
        self.report(error.with_suggestion(span, "", "remove it"));
    }

    /// The scene begins with its sections.
    pub(crate) fn complain_headless(&mut self) {
        let now = self.cursor.now();
        let label = "expected the resolution and the recursion depth before this";
        let error = Diagnostic::error("missing-header", "the scene has no header", now.span, label);
        self.report(
            error.with_help("a scene is written `renderDescr ( resolution (400,300) ) 3 [ scene ... ]`"),
        );
        self.headless = true;
    }

    pub(crate) fn complain_second(&mut self, section: Section, span: Span, first: Span) {
        let message = format!("a second {} section", section.word());
        let error = Diagnostic::error("second-section", message, span, "a scene has one of each section");
        self.report(error.with_secondary(first, "the first one is here"));
    }

    /// Sections that are missing or in another order.
    pub(crate) fn complain_order(&mut self) {
        for section in self.unmet().collect::<Vec<_>>() {
            // Lights among the objects have been reported; there need not be others.
            if section != Section::Lights || !self.strays {
                self.complain_missing_section(section);
            }
        }
        let late = self.met.windows(2).find_map(|pair| match pair {
            [before, late] if late.section < before.section => Some(*late),
            _ => None,
        });
        if let Some(late) = late
            && let Some(earlier) = self.met.iter().find(|met| met.section > late.section)
        {
            let (word, other) = (late.section.word(), earlier.section.word());
            let message = format!("the {word} section comes too late");
            let label = format!("{word} belongs before {other}");
            let error = Diagnostic::error("section-order", message, late.span, label);
            self.report(error.with_secondary(earlier.span, format!("{other} is here")).with_note(ORDER));
        }
    }

    /// The place is where the section belongs.
    fn complain_missing_section(&mut self, section: Section) {
        let word = section.word();
        let next = self.met.iter().find(|met| met.section > section);
        let span = next.map_or(self.cursor.now().span, |next| next.span);
        let message = format!("the scene has no {word} section");
        let label = format!("expected the {word} section before this");
        let error = Diagnostic::error("missing-section", message, span, label).with_note(ORDER);
        self.report(error.with_help(format!("write, for example, `{}`", section.example())));
    }

    pub(crate) fn complain_trailing(&mut self) {
        let now = self.cursor.now();
        let label = "nothing may follow the `]` that closes the scene";
        let message = format!("unexpected {} after the end of the scene", now.name());
        let error = Diagnostic::error("text-after-scene", message, now.span, label);
        self.report(error.with_secondary(self.cursor.last().span, "the scene ends here"));
    }

    /// An element follows the brace that closes its section.
    pub(crate) fn complain_closed_early(&mut self, section: Section, element: Element) {
        let (now, brace) = (self.cursor.now(), self.cursor.last());
        let (word, noun) = (section.word(), element.noun());
        let message = format!("{word} after the end of the {word} section");
        let label = format!("this {noun} is outside of the section");
        let error = Diagnostic::error("closed-early", message, now.span, label)
            .with_secondary(brace.span, format!("this closes the {word} section"));
        self.report(error.with_suggestion(brace.span, "", "remove the bracket"));
    }

    /// The word of the section once more.
    pub(crate) fn complain_doubled(&mut self, now: &Lexeme<'_>) {
        let message = format!("unexpected {}", now.name());
        let label = "this section has begun already";
        let error = Diagnostic::error("unexpected-token", message, now.span, label);
        self.report(error.with_suggestion(now.span, "", "remove it"));
        self.cursor.bump();
    }

    /// Something between the elements of a list.
    pub(crate) fn complain_between(&mut self, due: Element) {
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
            Token::Comma | Token::Close(_) | Token::Unknown => {
                error.with_suggestion(now.span, "", "remove it")
            }
            _ => error,
        };
        self.report(error);
        self.cursor.bump();
    }

    /// An element of the other list.
    pub(crate) fn complain_stray(&mut self, element: Element, section: Section) {
        let word = self.cursor.after();
        let noun = element.noun();
        let message = format!("a {noun} among the {}", section.word());
        let message = if noun == "object" { message.replacen("a ", "an ", 1) } else { message };
        let label = format!("{} belongs in the section `{{ {noun}s ... }}`", quoted(word.text));
        let error = Diagnostic::error("stray-element", message, word.span, label);
        let help = match element {
            Element::Light => "put `} { lights` before the first light, or move the lights to their section",
            Element::Object => "move the objects to their section",
        };
        self.report(error.with_help(help));
    }
}
