//! What is accepted does not go wrong by its type: programs put together at random are either refused, or evaluated
//! without the evaluator ever meeting a value that it cannot use.

use crate::common::{Files, checked};
use hray_lang::hry::eval::{Limits, evaluate};
use std::fmt::Write as _;

/// Random choices, the same at every run.
struct Choices(u64);

/// The types that expressions are made of, most of the time as asked for.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Number,
    Bool,
    Text,
    Vec2,
    Vec3,
    Color,
    Numbers,
    Record,
    Function,
    Texture,
    Shape,
    Material,
}

const KINDS: [Kind; 12] = [
    Kind::Number,
    Kind::Bool,
    Kind::Text,
    Kind::Vec2,
    Kind::Vec3,
    Kind::Color,
    Kind::Numbers,
    Kind::Record,
    Kind::Function,
    Kind::Texture,
    Kind::Shape,
    Kind::Material,
];

impl Choices {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(self.0 >> 33).unwrap_or(0) % n
    }

    fn kind(&mut self) -> Kind {
        KINDS[self.below(KINDS.len())]
    }

    fn pick<'t>(&mut self, texts: &[&'t str]) -> &'t str {
        texts[self.below(texts.len())]
    }

    /// An expression; each `@` of a template is one more, of the kind that its letter says.
    fn expr(&mut self, asked: Kind, depth: usize, text: &mut String) {
        let kind = if self.below(40) == 0 { self.kind() } else { asked };
        let template = if depth == 0 { self.leaf(kind) } else { self.template(kind) };
        let mut rest = template.chars();
        while let Some(c) = rest.next() {
            if c != '@' {
                text.push(c);
                continue;
            }
            let inner = match rest.next() {
                Some('n') => Kind::Number,
                Some('b') => Kind::Bool,
                Some('t') => Kind::Text,
                Some('2') => Kind::Vec2,
                Some('v') => Kind::Vec3,
                Some('c') => Kind::Color,
                Some('l') => Kind::Numbers,
                Some('r') => Kind::Record,
                Some('f') => Kind::Function,
                Some('x') => Kind::Texture,
                Some('s') => Kind::Shape,
                Some('m') => Kind::Material,
                Some('s'..='z') | None => self.kind(),
                Some(_) => kind,
            };
            text.push('(');
            self.expr(inner, depth.saturating_sub(1), text);
            text.push(')');
        }
    }

    fn leaf(&mut self, kind: Kind) -> &'static str {
        match kind {
            Kind::Number => self.pick(&["1", "-0.5", "k", "x", "h.p.x", "h.uv.y", "h.time", "turn"]),
            Kind::Bool => self.pick(&["true", "false"]),
            Kind::Text => self.pick(&["\"a\"", "show x"]),
            Kind::Vec2 => self.pick(&["(1, 2)", "h.uv", "up.xy"]),
            Kind::Vec3 => self.pick(&["(1, 2, 3)", "h.p", "h.normal", "up", "x"]),
            Kind::Color => self.pick(&["white", "#102030", "x", "rgb 1 0 0"]),
            Kind::Numbers => self.pick(&["[1, 2]", "[]", "[0 .. 3]"]),
            Kind::Record => self.pick(&["{ a = 1, b = 2 }", "{ a = x, b = k }", "r"]),
            Kind::Function => self.pick(&["sin", "abs", "twice", "\\y -> y", "identity", "add k"]),
            Kind::Texture => self.pick(&["\\h -> h.p.x", "tiles", "\\h -> white", "shade 0.5", "\\h -> x"]),
            Kind::Shape => self.pick(&["sphere {}", "cube { size = 2 }", "ball { radius = 1 }"]),
            Kind::Material => self.pick(&["classic {}", "paper white", "paper tiles", "paper 0.5"]),
        }
    }

    fn template(&mut self, kind: Kind) -> &'static str {
        if self.below(4) == 0 {
            return self.pick(&[
                "if @b then @= else @=",
                "let x = @y in @=",
                "let f y = @= in f @y",
                "match @n { 0 -> @=, _ -> @= }",
                "match @l { [] -> @=, [x, ..] -> @= }",
                "identity @=",
                "(\\x -> @=) @y",
                "let { a, b } = @r in @=",
                "{ z = @=, w = 1 }.z",
                "at 0 [@=, @=]",
                "let (x, k) = @2 in @=",
                "fold (\\a x -> @=) @= @l",
                "iterate 3 (\\i -> @b) (\\i -> @=) @=",
            ]);
        }
        match kind {
            Kind::Number => self.pick(&[
                "@n + @n",
                "@n * @n",
                "@n ^ @n",
                "dot @v @v",
                "@f @n",
                "@r.a",
                "@v.z",
                "add @n @n",
                "length @v",
                "count @l",
                "sum @l",
                "-@n",
                "size @r",
            ]),
            Kind::Bool => self.pick(&["@n < @n", "@b and @b", "not @b", "@y == @y", "@v == @v", "@c != @c"]),
            Kind::Text => self.pick(&["@t ++ @t", "show @y"]),
            Kind::Vec2 => self.pick(&["(@n, @n)", "@2 + @2", "@v.xz", "@2 * @n", "add @2 @n"]),
            Kind::Vec3 => self.pick(&[
                "(@n, @n, @n)",
                "@v + @v",
                "@n * @v",
                "cross @v @v",
                "normalize @v",
                "mix @v @v @n",
                "floor @v",
            ]),
            Kind::Color => {
                self.pick(&["@c * @n", "mix @c @c @n", "rgb @n @n @n", "@x h", "@c + @c", "add @c @n"])
            }
            Kind::Numbers => self.pick(&[
                "[ @n | x <- @l ]",
                "@l ++ @l",
                "map @f @l",
                "[@n .. @n]",
                "[ x | x <- @l, @b ]",
                "reverse @l",
            ]),
            Kind::Record => self.pick(&["{ @r | a = @n }", "{ a = @n, b = @n }"]),
            Kind::Function => self.pick(&["\\x -> @n", "@f >> @f", "add @n", "\\k -> @n"]),
            Kind::Texture => self.pick(&[
                "\\h -> @c",
                "scale 2 @x",
                "translate @v @x",
                "\\h -> @x { h | p = @v }",
                "shade @n",
                "rotate up @n @x",
            ]),
            Kind::Shape => self.pick(&[
                "sphere { radius = @n, material = @m }",
                "union @s @s",
                "inverse @s",
                "clip @s @s",
                "@s |> translate @v",
                "paint @m @s",
                "ball { radius = @n }",
                "sphere @r",
                "group [@s, @s]",
            ]),
            Kind::Material => self.pick(&[
                "classic { color = @x }",
                "classic { color = @c, reflection = @x }",
                "paper @x",
                "paper @c",
                "classic { bump = @x }",
                "scale 3 @m",
            ]),
        }
    }

    /// A whole program.
    fn program(&mut self) -> String {
        let mut text = "\
k = 3
r = { a = 1, b = 2 }
twice y = y + y
add a b = a + b
size s = s.a + s.b
tiles h = if odd (floor h.p.x) then white else black
shade n h = white * (h.normal.y * n)
paper c = classic { color = c }
ball b = sphere b
"
        .to_owned();
        let argument = self.pick(&["1", "(1, 2, 3)", "white", "\"t\"", "sin", "{ a = 1, b = 2 }"]);
        let kind = self.kind();
        let (definition, inner, scene) = match self.below(4) {
            0 => ("", kind, "let used = [@=] in { objects = [] }"),
            1 => ("f x h = ", Kind::Color, "{ objects = [sphere { material = paper (f ARGUMENT) }] }"),
            2 => (
                "g x = \\h -> ",
                kind,
                "{ objects = [sphere { material = classic { color = g ARGUMENT } }] }",
            ),
            _ => ("v x k = ", Kind::Shape, "{ objects = [v ARGUMENT ARGUMENT, @s] }"),
        };
        if !definition.is_empty() {
            text.push_str(definition);
            self.expr(inner, 3, &mut text);
            text.push('\n');
        }
        let mut body = String::new();
        for (i, part) in scene.replace("ARGUMENT", &format!("({argument})")).split('@').enumerate() {
            if i > 0 {
                let inner = if part.starts_with('s') { Kind::Shape } else { kind };
                body.push('(');
                self.expr(inner, 3, &mut body);
                body.push(')');
            }
            body.push_str(if i > 0 { &part[1..] } else { part });
        }
        let _ = writeln!(text, "scene = let {{ h, x }} = {{ h = {argument}, x = {argument} }} in {body}");
        text
    }
}

#[test]
fn accepted_programs_do_not_go_wrong() {
    let limits = Limits { steps: 100_000, depth: 200, list: 10_000, ..Limits::default() };
    let mut choices = Choices(1);
    let (mut accepted, mut rendered) = (0, 0);
    for _ in 0..10_000 {
        let text = choices.program();
        let (program, _, diagnostics) = checked(&text, &Files(&[]));
        if let Some(broken) = diagnostics.iter().find(|diagnostic| diagnostic.code.contains("syntax")) {
            panic!("{text}\n{broken:#?}");
        }
        if diagnostics.iter().any(hray_lang::diagnostic::Diagnostic::is_error) {
            continue;
        }
        accepted += 1;
        let evaluated = evaluate(&program, &Files(&[]), 0.0, &limits);
        let wrong = evaluated.diagnostics.iter().find(|diagnostic| diagnostic.code == "internal");
        assert!(wrong.is_none(), "{text}\n{wrong:#?}");
        rendered += usize::from(evaluated.description.is_some());
    }
    assert!(accepted > 200 && rendered > 100, "{accepted} accepted, {rendered} evaluated");
}
