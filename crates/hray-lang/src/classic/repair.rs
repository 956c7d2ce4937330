//! The least change that makes the tokens ahead fit the grammar again.
//!
//! Where a token is not what is due, there are three ways to go on: something is missing before it, it is
//! superfluous, or it stands for what is due. Which of them was meant shows in the tokens that follow. So a
//! few tokens are read ahead, and of all ways to align them with the grammar the cheapest is taken (G. Lyon,
//! "Syntax-directed least-errors analysis for context-free languages", CACM 17(1), 1974, cut to a window).
//! The work is bounded by a constant, whatever the tokens are.

use super::grammar::{Choice, Form};
use super::route::{Route, Slot, Step};
use super::token::{Lexeme, Token};
use super::words::{WORDS, nearest};

/// How many tokens are read ahead.
pub(crate) const WINDOW: usize = 9;
/// The highest cost of an alignment: beyond it, the text is not taken for a slip.
const CEILING: usize = 12;
/// How many states are tried at most.
const MOST_STATES: usize = 4_000;

/// One change of the text.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Edit {
    /// What is due is missing: one token.
    Insert(Step),
    /// A tuple is missing as a whole.
    InsertTuple(Step),
    /// The word of a form is missing, not the rest of it.
    InsertForm(&'static Choice, &'static Form),
    /// A token is superfluous.
    Delete,
    /// A token stands for what is due.
    Replace(Step),
    /// A single number stands for a tuple.
    ReplaceTuple(Step),
    /// Something stands for the word of a form.
    ReplaceForm(&'static Choice, &'static Form),
    /// Something stands where a form is due, and nobody knows which: everything up to the closing bracket
    /// of the group is passed over.
    SkipForm(&'static Choice),
}

/// The changes to make before the next token that is as it should be; none where no cheap change helps.
/// `tokens` are those ahead, the first not what is due; `follows` says which tokens may come after the route.
pub(crate) fn plan(
    route: &Route,
    tokens: &[Lexeme<'_>],
    follows: fn(&Lexeme<'_>) -> bool,
) -> Option<Vec<Edit>> {
    search(route, tokens, follows).map(|(_, state)| state.edits)
}

/// How many of the tokens stand where the cheapest alignment with the route wants them.
pub(crate) fn matches(route: &Route, tokens: &[Lexeme<'_>]) -> usize {
    search(route, tokens, |_| true).map_or(0, |(_, state)| state.matched)
}

/// What the cheapest alignment of the tokens with the route costs.
pub(crate) fn cost(route: &Route, tokens: &[Lexeme<'_>]) -> usize {
    search(route, tokens, |_| true).map_or(CEILING + 1, |(cost, _)| cost)
}

/// A partial alignment.
#[derive(Clone, Debug)]
struct State {
    route: Route,
    /// How many tokens are used up.
    at: usize,
    /// The changes before the first token that fits.
    edits: Vec<Edit>,
    /// Whether a token fitted, so that later changes are not recorded.
    settled: bool,
    /// How many tokens fitted.
    matched: usize,
}

/// The cheapest alignment, and its cost.
fn search(route: &Route, tokens: &[Lexeme<'_>], follows: fn(&Lexeme<'_>) -> bool) -> Option<(usize, State)> {
    let mut queue = Queue { buckets: vec![Vec::new(); CEILING + 1] };
    let route = route.clone();
    queue.push(0, State { route, at: 0, edits: Vec::new(), settled: false, matched: 0 });
    let mut tried = 0;
    let mut cost = 0;
    while cost <= CEILING {
        let mut index = 0;
        while let Some(state) = queue.buckets.get(cost).and_then(|bucket| bucket.get(index)).cloned() {
            index += 1;
            tried += 1;
            if tried > MOST_STATES {
                return None;
            }
            let state = match_on(state, tokens);
            match (tokens.get(state.at), state.route.step()) {
                (None, _) => return Some((cost, state)),
                (Some(lexeme), None) if follows(lexeme) => return Some((cost, state)),
                (Some(_), None) => queue.push(cost + 3, State { at: tokens.len(), ..state }),
                (Some(lexeme), Some(step)) => queue.branch(cost, &state, step, lexeme, tokens),
            }
        }
        cost += 1;
    }
    None
}

/// Goes on as far as the tokens fit.
fn match_on(mut state: State, tokens: &[Lexeme<'_>]) -> State {
    while let (Some(lexeme), Some(step)) = (tokens.get(state.at), state.route.step())
        && step.accepts(lexeme)
    {
        match step {
            Step::Choice(choice) => {
                if let Some(form) = choice.form(lexeme.text) {
                    state.route.choose(form);
                }
            }
            _ => state.route.advance(),
        }
        state.at += 1;
        state.matched += 1;
        state.settled = true;
    }
    state
}

/// States by cost.
struct Queue {
    buckets: Vec<Vec<State>>,
}

impl Queue {
    fn push(&mut self, cost: usize, state: State) {
        if let Some(bucket) = self.buckets.get_mut(cost) {
            bucket.push(state);
        }
    }

    fn push_edit(&mut self, cost: usize, state: &State, edit: Edit, go_on: impl FnOnce(&mut State)) {
        if cost <= CEILING {
            let mut next = state.clone();
            if !next.settled {
                next.edits.push(edit);
            }
            go_on(&mut next);
            self.push(cost, next);
        }
    }

    /// All ways to go on at a token that is not what is due.
    fn branch(&mut self, cost: usize, state: &State, step: Step, lexeme: &Lexeme<'_>, tokens: &[Lexeme<'_>]) {
        if lexeme.token == Token::End {
            // Nothing can be learnt from what follows.
            return self.push(cost + 1, State { at: tokens.len(), ..state.clone() });
        }
        match step {
            Step::Choice(choice) => self.branch_at_choice(cost, state, choice, lexeme, tokens),
            _ => {
                self.push_edit(cost + insertion_cost(step), state, Edit::Insert(step), |next| {
                    next.route.advance()
                });
                let price = replacement_cost(step, lexeme);
                self.push_edit(cost + price, state, Edit::Replace(step), |next| {
                    next.route.advance();
                    next.at += 1;
                });
            }
        }
        if let Step::Open(_, _, Some(_)) = step {
            self.push_edit(cost + 4, state, Edit::InsertTuple(step), |next| next.route.skip_item());
            if matches!(lexeme.token, Token::Integer | Token::Real | Token::OddNumber) {
                self.push_edit(cost + 5, state, Edit::ReplaceTuple(step), |next| {
                    next.route.skip_item();
                    next.at += 1;
                });
            }
        }
        self.push_edit(cost + deletion_cost(lexeme), state, Edit::Delete, |next| next.at += 1);
    }

    fn branch_at_choice(
        &mut self,
        cost: usize,
        state: &State,
        choice: &'static Choice,
        lexeme: &Lexeme<'_>,
        tokens: &[Lexeme<'_>],
    ) {
        let meant = match lexeme.token {
            Token::Word => nearest(lexeme.text, choice.forms.iter().map(|form| form.word)),
            _ => None,
        };
        if let Some(form) = meant.and_then(|word| choice.form(word)) {
            let price = if WORDS.contains(&lexeme.text) { 3 } else { 2 };
            self.replace_form(cost + price, state, choice, form);
            return;
        }
        let is_word = lexeme.token == Token::Word;
        if is_word || choice.is_wide() {
            let price = if WORDS.contains(&lexeme.text) { 7 } else { 5 };
            self.push_edit(cost + price, state, Edit::SkipForm(choice), |next| {
                next.route.skip_item();
                next.at += group_length(tokens.get(next.at..).unwrap_or_default());
            });
        }
        if !choice.is_wide() {
            for form in choice.forms {
                self.push_edit(cost + 4, state, Edit::InsertForm(choice, form), |next| {
                    next.route.choose(form)
                });
                if !is_word {
                    self.replace_form(cost + 6, state, choice, form);
                }
            }
        }
    }

    fn replace_form(&mut self, cost: usize, state: &State, choice: &'static Choice, form: &'static Form) {
        self.push_edit(cost, state, Edit::ReplaceForm(choice, form), |next| {
            next.route.choose(form);
            next.at += 1;
        });
    }
}

/// How many tokens there are before the bracket that closes the group they are in.
pub(crate) fn group_length(tokens: &[Lexeme<'_>]) -> usize {
    let mut depth = 0_usize;
    for (index, lexeme) in tokens.iter().enumerate() {
        match lexeme.token {
            Token::Open(_) => depth += 1,
            Token::Close(_) if depth == 0 => return index,
            Token::Close(_) => depth -= 1,
            _ => {}
        }
    }
    tokens.len()
}

/// What it costs to add what is due: least for what carries no meaning.
const fn insertion_cost(step: Step) -> usize {
    match step {
        Step::Comma(..) | Step::Open(..) | Step::Close(..) => 2,
        // The comma before it has been paid for.
        Step::Number(Slot::Component(_, 1..)) => 1,
        Step::Word(_) | Step::Number(_) | Step::Choice(_) => 3,
    }
}

/// What it costs to leave out a token. The words of the grammar are the last to go.
fn deletion_cost(lexeme: &Lexeme<'_>) -> usize {
    match lexeme.token {
        Token::Unknown => 1,
        Token::Comma => 2,
        Token::OddNumber if !has_digits(lexeme) => 2,
        Token::Word if WORDS.contains(&lexeme.text) => 5,
        _ => 3,
    }
}

/// What it costs to read a token as what is due: little where that is easily confused, else a little less
/// than to leave it out and to add what is due.
fn replacement_cost(step: Step, lexeme: &Lexeme<'_>) -> usize {
    match (step, lexeme.token) {
        (Step::Number(_), Token::Integer | Token::Real | Token::OddNumber) => 2,
        (Step::Word(word), Token::Word) if nearest(lexeme.text, std::iter::once(word)).is_some() => {
            if WORDS.contains(&lexeme.text) { 3 } else { 2 }
        }
        (Step::Open(..), Token::Open(_)) | (Step::Close(..), Token::Close(_)) => 2,
        (Step::Comma(..), Token::Unknown) => 2,
        _ => deletion_cost(lexeme) + insertion_cost(step) - 1,
    }
}

fn has_digits(lexeme: &Lexeme<'_>) -> bool {
    lexeme.text.bytes().any(|byte| byte.is_ascii_digit())
}
