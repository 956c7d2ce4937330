//! Operators and their operands, by precedence, without recursion.

use super::super::kind::SyntaxKind;
use super::{Around, Done, LONGEST_CHAIN, Mark, Parser};

/// An operator that waits for its right operand to be complete.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Operator {
    precedence: u8,
    is_prefix: bool,
    /// Where its left operand begins, or itself where it has none.
    start: Mark,
    /// How deep its left operand is.
    height: u32,
    token: u32,
}

/// Which of two operators of the same precedence comes first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Left,
    Right,
    /// Neither: the two do not go together.
    None,
}

const NOT: u8 = 5;
const NEGATE: u8 = 10;

fn infix(kind: SyntaxKind) -> Option<(u8, Side)> {
    use SyntaxKind as S;
    Some(match kind {
        S::Pipe => (1, Side::Left),
        S::Compose => (2, Side::Left),
        S::OrKeyword => (3, Side::Left),
        S::AndKeyword => (4, Side::Left),
        S::Equal | S::NotEqual | S::Less | S::LessEqual | S::Greater | S::GreaterEqual => (6, Side::None),
        S::Append => (7, Side::Right),
        S::Plus | S::Minus => (8, Side::Left),
        S::Star | S::Slash | S::Percent => (9, Side::Left),
        S::Caret => (11, Side::Right),
        _ => return None,
    })
}

impl Parser<'_> {
    /// Operands and operators up to something else.
    pub(in super::super) fn operation(&mut self) -> Done {
        let (bottom, chain) = (self.operators.len(), self.chain);
        loop {
            self.prefixes();
            let mut operand = self.operand();
            let Some((precedence, side)) = self.infix_here() else {
                while self.operators.len() > bottom {
                    operand = self.reduce(operand);
                }
                self.chain = chain;
                return operand;
            };
            while let Some(top) = self.operators.get(bottom..).and_then(<[Operator]>::last).copied() {
                let goes_first =
                    top.precedence > precedence || top.precedence == precedence && side != Side::Right;
                if !goes_first {
                    break;
                }
                if top.precedence == precedence && side == Side::None {
                    self.chained_comparison(top.token as usize);
                }
                operand = self.reduce(operand);
            }
            if operand.height >= LONGEST_CHAIN || self.chain >= LONGEST_CHAIN {
                operand = self.abandon(operand);
                while self.operators.len() > bottom {
                    operand = self.reduce(operand);
                }
                self.chain = chain;
                return operand;
            }
            self.push(precedence, false, operand.start, operand.height);
        }
    }

    /// The operator here, where there is one.
    fn infix_here(&mut self) -> Option<(u8, Side)> {
        if self.is(SyntaxKind::Define) && matches!(self.around, Around::Condition | Around::Test) {
            self.single_equals();
            return Some((6, Side::None));
        }
        infix(self.current)
    }

    /// `-` and `not` before an operand.
    fn prefixes(&mut self) {
        loop {
            let precedence = match self.current {
                SyntaxKind::Minus => NEGATE,
                SyntaxKind::NotKeyword => NOT,
                SyntaxKind::Bang => {
                    self.bang();
                    NOT
                }
                _ => return,
            };
            if self.chain >= LONGEST_CHAIN {
                return self.too_deep();
            }
            let start = self.mark();
            self.push(precedence, true, start, 0);
        }
    }

    fn push(&mut self, precedence: u8, is_prefix: bool, start: Mark, height: u32) {
        self.operators.push(Operator { precedence, is_prefix, start, height, token: self.at as u32 });
        self.chain += 1;
        self.bump();
    }

    /// Gives the last operator its right operand.
    fn reduce(&mut self, operand: Done) -> Done {
        let Some(operator) = self.operators.pop() else { return operand };
        self.chain = self.chain.saturating_sub(1);
        let kind = if operator.is_prefix { SyntaxKind::UnaryExpr } else { SyntaxKind::BinaryExpr };
        self.expr_node(kind, operator.start, operator.height.max(operand.height))
    }

    /// What operators combine: a function with its arguments, or something that goes on as far as it can.
    fn operand(&mut self) -> Done {
        match self.current {
            SyntaxKind::Backslash => self.lambda(),
            SyntaxKind::LetKeyword => self.let_in(),
            SyntaxKind::IfKeyword => self.if_then_else(),
            _ => self.application(),
        }
    }
}
