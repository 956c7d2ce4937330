//! The way through a sequence of the grammar: which token is due, and which after it.

use super::grammar::{Choice, Form, Item, Number, NumberKind, Tuple};
use super::token::{Bracket, Lexeme, Token};

/// What is due at one place: exactly one token.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Step {
    /// A fixed word.
    Word(&'static str),
    /// An opening bracket: what it opens, and the tuple where it opens one.
    Open(Bracket, &'static str, Option<&'static Tuple>),
    /// A closing bracket: what it closes, and the tuple where it closes one.
    Close(Bracket, &'static str, Option<&'static Tuple>),
    /// The comma after the component with this index.
    Comma(&'static Tuple, usize),
    /// A number.
    Number(Slot),
    /// The word of one of several forms.
    Choice(&'static Choice),
}

/// The position of a number.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Slot {
    /// It stands alone.
    Single(&'static Number),
    /// It is the component of a tuple with this index.
    Component(&'static Tuple, usize),
}

impl Slot {
    pub(crate) const fn kind(self) -> NumberKind {
        match self {
            Self::Single(number) => number.kind,
            Self::Component(tuple, _) => tuple.kind,
        }
    }

    /// "the sphere's radius", "the x of the sphere's centre".
    pub(crate) fn what(self) -> String {
        match self {
            Self::Single(number) => number.what.into(),
            Self::Component(tuple, index) => {
                let component = tuple.components.get(index).copied().unwrap_or("next component");
                format!("the {component} of {}", tuple.what)
            }
        }
    }

    /// A number that could stand here.
    pub(crate) fn example(self) -> &'static str {
        match self {
            Self::Single(number) => number.example,
            Self::Component(tuple, index) => {
                let inside = tuple.example.trim_matches(['(', ')']);
                inside.split(',').nth(index).unwrap_or(inside)
            }
        }
    }
}

impl Step {
    /// Whether a token is what is due.
    pub(crate) fn accepts(self, lexeme: &Lexeme<'_>) -> bool {
        match (self, lexeme.token) {
            (Self::Word(word), Token::Word) => lexeme.text == word,
            (Self::Open(due, ..), Token::Open(bracket)) | (Self::Close(due, ..), Token::Close(bracket)) => {
                due == bracket
            }
            (Self::Comma(..), Token::Comma) => true,
            (Self::Number(slot), Token::Integer) => slot.kind() == NumberKind::Integer,
            (Self::Number(slot), Token::Real) => slot.kind() == NumberKind::Real,
            (Self::Choice(choice), Token::Word) => choice.form(lexeme.text).is_some(),
            _ => false,
        }
    }
}

impl Choice {
    pub(crate) fn form(&self, word: &str) -> Option<&'static Form> {
        self.forms.iter().find(|form| form.word == word)
    }

    /// Whether there are too many forms to tell from what follows which was meant.
    pub(crate) const fn is_wide(&self) -> bool {
        self.forms.len() > 2
    }
}

/// A place in nested sequences.
#[derive(Clone, Debug)]
pub(crate) struct Route {
    /// The sequences that are not done, innermost last.
    places: Vec<Place>,
}

/// A place in one sequence.
#[derive(Clone, Copy, Debug)]
struct Place {
    items: &'static [Item],
    /// The item that is due.
    index: usize,
    /// The token of it that is due, where it is a tuple.
    part: usize,
    /// The form that the sequence belongs to, if any.
    form: Option<&'static Form>,
}

impl Place {
    fn item(&self) -> Option<&'static Item> {
        self.items.get(self.index)
    }
}

impl Route {
    pub(crate) fn new(items: &'static [Item]) -> Self {
        Self { places: vec![Place { items, index: 0, part: 0, form: None }] }
    }

    /// What is due; none at the end.
    pub(crate) fn step(&self) -> Option<Step> {
        let place = self.places.last()?;
        Some(match *place.item()? {
            Item::Word(word) => Step::Word(word),
            Item::Open(bracket, what) => Step::Open(bracket, what, None),
            Item::Close(bracket, what) => Step::Close(bracket, what, None),
            Item::Number(number) => Step::Number(Slot::Single(number)),
            Item::Choice(choice) => Step::Choice(choice),
            Item::Tuple(tuple) => tuple_step(tuple, place.part),
        })
    }

    /// Goes past what is due.
    pub(crate) fn advance(&mut self) {
        let Some(place) = self.places.last_mut() else { return };
        if let Some(Item::Tuple(tuple)) = place.item()
            && place.part < 2 * tuple.components.len()
        {
            place.part += 1;
            return;
        }
        self.skip_item();
    }

    /// Goes past the whole item that is due, be it a tuple or a choice.
    pub(crate) fn skip_item(&mut self) {
        if let Some(place) = self.places.last_mut() {
            place.index += 1;
            place.part = 0;
        }
        self.leave_finished();
    }

    /// Goes past the word of a choice into the items of its form.
    pub(crate) fn choose(&mut self, form: &'static Form) {
        if let Some(place) = self.places.last_mut() {
            place.index += 1;
        }
        self.places.push(Place { items: form.items, index: 0, part: 0, form: Some(form) });
        self.leave_finished();
    }

    fn leave_finished(&mut self) {
        while self.places.last().is_some_and(|place| place.item().is_none()) {
            self.places.pop();
        }
    }

    /// The form whose items are being read.
    pub(crate) fn form(&self) -> Option<&'static Form> {
        self.places.last()?.form
    }

    /// The single numbers that stand side by side here, or just before this place.
    pub(crate) fn numbers_here(&self) -> Vec<&'static Number> {
        let Some(place) = self.places.last() else { return Vec::new() };
        let (before, after) = place.items.split_at(place.index.min(place.items.len()));
        let number = |item: &'static Item| match item {
            Item::Number(number) => Some(*number),
            _ => None,
        };
        let mut numbers: Vec<&'static Number> = before.iter().rev().map_while(number).collect();
        numbers.reverse();
        numbers.extend(after.iter().map_while(number));
        numbers
    }
}

/// The bracket, component or comma that is part `part` of a tuple.
fn tuple_step(tuple: &'static Tuple, part: usize) -> Step {
    if part == 0 {
        Step::Open(Bracket::Round, tuple.what, Some(tuple))
    } else if part == 2 * tuple.components.len() {
        Step::Close(Bracket::Round, tuple.what, Some(tuple))
    } else if part % 2 == 1 {
        Step::Number(Slot::Component(tuple, part / 2))
    } else {
        Step::Comma(tuple, part / 2 - 1)
    }
}
