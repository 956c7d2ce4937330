//! Random programs, written in random ways.

use proptest::prelude::*;

/// An expression, as far as the shape of a text is concerned.
#[derive(Clone, Debug)]
pub(crate) enum Tree {
    Leaf(&'static str),
    Paren(Box<Tree>),
    Vector(Vec<Tree>),
    List(Vec<Tree>),
    Range(Vec<Tree>),
    Comprehension(Box<Tree>, Vec<Part>),
    Record(Vec<Field>),
    Update(Box<Tree>, Vec<Field>),
    Field(Box<Tree>, &'static str),
    Apply(Vec<Tree>),
    Negative(Box<Tree>, Box<Tree>),
    Prefix(&'static str, Box<Tree>),
    Binary(&'static str, Box<Tree>, Box<Tree>),
    If(Box<Tree>, Box<Tree>, Box<Tree>),
    Let(Vec<Binding>, Box<Tree>),
    Lambda(Vec<&'static str>, Box<Tree>),
    Match(Box<Tree>, Vec<(&'static str, Tree)>),
    Typed(Box<Tree>, &'static str),
}

pub(crate) type Field = (&'static str, Option<Tree>);
pub(crate) type Binding = (&'static str, Vec<&'static str>, Tree);

#[derive(Clone, Debug)]
pub(crate) enum Part {
    Generator(&'static str, Tree),
    Guard(Tree),
    Let(Binding),
}

const LEAVES: &[&str] = &[
    "x",
    "y",
    "longerName",
    "palette",
    "1",
    "2.5",
    "50%",
    "30deg",
    "1e-3",
    "#fff",
    "#1d3b53",
    "true",
    "false",
    "\"a text -- with {- things\"",
    "h",
    "anEvenLongerNameThatTakesSpace",
];
const OPERATORS: &[&str] =
    &["|>", ">>", "or", "and", "==", "!=", "<", "<=", ">", ">=", "++", "+", "-", "*", "/", "%", "^"];
const PATTERNS: &[&str] = &["x", "_", "(a, b)", "{ a, b = c }", "(a, (b, c), d)"];
const CASES: &[&str] =
    &["x", "_", "0", "-1", "\"t\"", "true", "[]", "[a]", "[a, .. rest]", "[.. rest]", "(0, y)", "{ a = 1 }"];
const TYPES: &[&str] =
    &["Number", "[a]", "Number -> Number", "{ a : Vec3, b : Color }", "(a -> b) -> [a] -> [b]"];

fn any_of(words: &'static [&'static str]) -> impl Strategy<Value = &'static str> + Clone {
    prop::sample::select(words)
}

pub(crate) fn tree() -> impl Strategy<Value = Tree> {
    any_of(LEAVES).prop_map(Tree::Leaf).prop_recursive(5, 60, 5, |inner| {
        let boxed = inner.clone().prop_map(Box::new);
        let field = (any_of(&["a", "size", "material"]), prop::option::weighted(0.8, inner.clone()));
        let fields = prop::collection::vec(field, 0..5);
        let binding =
            (any_of(&["p", "q", "value"]), prop::collection::vec(any_of(PATTERNS), 0..3), inner.clone());
        let part = prop_oneof![
            (any_of(PATTERNS), inner.clone()).prop_map(|(pattern, list)| Part::Generator(pattern, list)),
            inner.clone().prop_map(Part::Guard),
            binding.clone().prop_map(Part::Let),
        ];
        let several = prop::collection::vec(inner.clone(), 0..5);
        prop_oneof![
            boxed.clone().prop_map(Tree::Paren),
            prop::collection::vec(inner.clone(), 2..4).prop_map(Tree::Vector),
            several.clone().prop_map(Tree::List),
            prop::collection::vec(inner.clone(), 2..4).prop_map(Tree::Range),
            (boxed.clone(), prop::collection::vec(part, 1..4))
                .prop_map(|(body, parts)| Tree::Comprehension(body, parts)),
            fields.clone().prop_map(Tree::Record),
            (boxed.clone(), fields).prop_map(|(record, fields)| Tree::Update(record, fields)),
            (boxed.clone(), any_of(&["x", "color"])).prop_map(|(record, field)| Tree::Field(record, field)),
            prop::collection::vec(inner.clone(), 2..5).prop_map(Tree::Apply),
            (boxed.clone(), boxed.clone())
                .prop_map(|(function, argument)| Tree::Negative(function, argument)),
            (any_of(&["-", "not"]), boxed.clone())
                .prop_map(|(operator, operand)| Tree::Prefix(operator, operand)),
            (any_of(OPERATORS), boxed.clone(), boxed.clone())
                .prop_map(|(operator, a, b)| Tree::Binary(operator, a, b)),
            (boxed.clone(), boxed.clone(), boxed.clone()).prop_map(|(a, b, c)| Tree::If(a, b, c)),
            (prop::collection::vec(binding, 1..4), boxed.clone())
                .prop_map(|(bindings, body)| Tree::Let(bindings, body)),
            (prop::collection::vec(any_of(PATTERNS), 1..3), boxed.clone())
                .prop_map(|(names, body)| Tree::Lambda(names, body)),
            (boxed.clone(), prop::collection::vec((any_of(CASES), inner), 0..4))
                .prop_map(|(a, arms)| Tree::Match(a, arms)),
            (boxed, any_of(TYPES)).prop_map(|(expression, of)| Tree::Typed(expression, of)),
        ]
    })
}

/// Programs as trees, and a number that decides how they are written.
pub(crate) fn program() -> impl Strategy<Value = String> {
    let item = (any_of(&["a", "ring", "scene"]), prop::collection::vec(any_of(PATTERNS), 0..3), tree());
    let items = prop::collection::vec((item, prop::option::weighted(0.3, any_of(TYPES))), 0..4);
    (items, any::<u64>(), 0..3_u64).prop_map(|(items, seed, wildness)| {
        let mut pen = Pen { text: String::new(), seed, wildness, column: 0 };
        for ((name, parameters, body), of) in items {
            pen.between_items();
            if let Some(of) = of {
                pen.text.push_str(&format!("{name} : {of}\n"));
            }
            pen.binding(&(name, parameters, body), 0);
            pen.text.push('\n');
        }
        pen.between_items();
        pen.text
    })
}

/// Writes trees with white space and comments here and there.
struct Pen {
    text: String,
    seed: u64,
    /// 0 where everything is on one line, 2 where there are comments everywhere.
    wildness: u64,
    /// The column of the binding that this is in.
    column: usize,
}

impl Pen {
    fn random(&mut self, below: u64) -> u64 {
        self.seed = self.seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.seed >> 33) % below
    }

    fn new_line(&mut self) {
        let indent = self.column + 1 + self.random(4) as usize;
        self.text.push('\n');
        self.text.push_str(&" ".repeat(indent));
    }

    fn between_items(&mut self) {
        for _ in 0..self.random(4) {
            let choice = self.random(4);
            self.text.push_str(
                ["\n", "-- about it\n", "--| its documentation\n", "{- a\n block -}\n"][choice as usize],
            );
        }
    }

    /// White space where some has to be.
    fn space(&mut self) {
        let choices = [4, 8, 14][self.wildness as usize];
        match self.random(choices) {
            4 | 5 => self.new_line(),
            6 => self.text.push_str(" \t "),
            7 => {
                self.new_line();
                self.text.push('\n');
                self.new_line();
            }
            8 => self.text.push_str(" {- c -} "),
            9 | 10 => {
                self.text.push_str(" -- note");
                self.new_line();
            }
            11 => {
                self.new_line();
                self.text.push_str("-- own line");
                self.new_line();
            }
            12 => {
                self.new_line();
                self.text.push_str("{- over\n lines -}");
                self.new_line();
            }
            _ => self.text.push(' '),
        }
    }

    /// White space where none has to be.
    fn maybe(&mut self) {
        if self.random(3) == 0 {
            self.space();
        }
    }

    fn word(&mut self, word: &str) {
        self.space();
        self.text.push_str(word);
        self.space();
    }

    fn separated<T>(&mut self, items: &[T], may_trail: bool, mut write: impl FnMut(&mut Self, &T)) {
        for (number, item) in items.iter().enumerate() {
            self.maybe();
            write(self, item);
            let is_last = number + 1 == items.len();
            if !is_last || may_trail && self.random(3) == 0 {
                self.maybe();
                self.text.push(',');
                self.text.push(' ');
            }
        }
        self.maybe();
    }

    fn binding(&mut self, (name, parameters, body): &Binding, column: usize) {
        let outer = std::mem::replace(&mut self.column, column);
        self.text.push_str(name);
        for parameter in parameters {
            self.space();
            self.text.push_str(parameter);
        }
        self.word("=");
        self.tree(body);
        self.column = outer;
    }

    fn fields(&mut self, fields: &[Field]) {
        self.separated(fields, true, |pen, (name, value)| {
            pen.text.push_str(name);
            if let Some(value) = value {
                pen.word("=");
                pen.tree(value);
            }
        });
    }

    /// An operand: in parentheses, where it would not be one otherwise.
    fn operand(&mut self, tree: &Tree) {
        let is_one = matches!(
            tree,
            Tree::Leaf(_)
                | Tree::Paren(_)
                | Tree::Vector(_)
                | Tree::List(_)
                | Tree::Record(_)
                | Tree::Field(..)
        );
        if is_one {
            self.tree(tree);
        } else {
            self.text.push('(');
            self.tree(tree);
            self.text.push(')');
        }
    }

    fn tree(&mut self, tree: &Tree) {
        match tree {
            Tree::Leaf(text) => self.text.push_str(text),
            Tree::Paren(inner) => self.bracketed("(", ")", |pen| pen.tree(inner)),
            Tree::Vector(items) => self.bracketed("(", ")", |pen| pen.separated(items, true, Self::tree)),
            Tree::List(items) => self.bracketed("[", "]", |pen| pen.separated(items, true, Self::tree)),
            Tree::Range(items) => self.range(items),
            Tree::Comprehension(body, parts) => self.bracketed("[", "]", |pen| {
                pen.tree(body);
                pen.word("|");
                pen.separated(parts, true, Self::part);
            }),
            Tree::Record(fields) => self.bracketed("{ ", " }", |pen| pen.fields(fields)),
            Tree::Update(record, fields) => self.bracketed("{ ", " }", |pen| {
                pen.operand(record);
                pen.word("|");
                pen.fields(fields);
                if fields.is_empty() {
                    pen.text.push_str("a = 1");
                }
            }),
            Tree::Field(record, field) => {
                self.operand(record);
                self.text.push('.');
                self.text.push_str(field);
            }
            Tree::Apply(items) => {
                self.text.push('f');
                for item in items {
                    self.space();
                    self.operand(item);
                }
            }
            Tree::Negative(function, argument) => {
                self.text.push_str("g ");
                self.operand(function);
                self.space();
                self.text.push_str("-(");
                self.tree(argument);
                self.text.push(')');
            }
            Tree::Prefix(operator, operand) => {
                self.text.push_str(operator);
                self.space();
                self.tree(operand);
            }
            Tree::Binary(operator, a, b) => {
                let plain = self.random(2) == 0;
                if plain {
                    self.tree(a)
                } else {
                    self.operand(a)
                };
                self.word(operator);
                if plain {
                    self.tree(b)
                } else {
                    self.operand(b)
                };
            }
            Tree::If(a, b, c) => {
                self.text.push_str("if");
                self.space();
                self.tree(a);
                self.word("then");
                self.tree(b);
                self.word("else");
                self.tree(c);
            }
            Tree::Let(bindings, body) => self.let_in(bindings, body),
            Tree::Lambda(names, body) => {
                self.text.push('\\');
                for name in names {
                    self.text.push_str(name);
                    self.space();
                }
                self.text.push_str("->");
                self.space();
                self.tree(body);
            }
            Tree::Match(subject, arms) => {
                self.text.push_str("match ");
                self.operand(subject);
                self.space();
                self.bracketed("{ ", " }", |pen| {
                    pen.separated(arms, true, |pen, (case, body)| {
                        pen.text.push_str(case);
                        pen.word("->");
                        pen.tree(body);
                    });
                });
            }
            Tree::Typed(expression, of) => self.bracketed("(", ")", |pen| {
                pen.tree(expression);
                pen.word(":");
                pen.text.push_str(of);
            }),
        }
    }

    fn bracketed(&mut self, open: &str, close: &str, write: impl FnOnce(&mut Self)) {
        self.text.push_str(open);
        self.maybe();
        write(self);
        self.maybe();
        self.text.push_str(close);
    }

    fn range(&mut self, items: &[Tree]) {
        self.bracketed("[", "]", |pen| {
            if let Some((last, first)) = items.split_last() {
                pen.separated(first, false, Self::tree);
                pen.word("..");
                pen.tree(last);
            }
        });
    }

    fn part(&mut self, part: &Part) {
        match part {
            Part::Generator(pattern, list) => {
                self.text.push_str(pattern);
                self.word("<-");
                self.tree(list);
            }
            Part::Guard(guard) => self.tree(guard),
            Part::Let(binding) => {
                self.text.push_str("let ");
                let line = self.text.rsplit('\n').next().unwrap_or("").chars().count();
                self.binding(binding, line);
            }
        }
    }

    fn let_in(&mut self, bindings: &[Binding], body: &Tree) {
        let outer = self.column;
        self.text.push_str("let");
        let column = if bindings.len() == 1 && self.random(2) == 0 {
            self.text.push(' ');
            self.text.rsplit('\n').next().unwrap_or("").chars().count()
        } else {
            self.new_line();
            self.text.rsplit('\n').next().unwrap_or("").chars().count()
        };
        for (number, binding) in bindings.iter().enumerate() {
            if number > 0 {
                self.text.push('\n');
                if self.random(3) == 0 {
                    let comment = ["-- between", "--| what it is"][self.random(2) as usize];
                    self.text.push_str(&format!("{}{comment}\n", " ".repeat(column)));
                }
                self.text.push_str(&" ".repeat(column));
            }
            self.binding(binding, column);
        }
        self.column = outer;
        self.word("in");
        self.tree(body);
    }
}
