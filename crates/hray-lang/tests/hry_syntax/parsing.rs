//! What texts mean.

use hray_lang::hry::ast::{
    Expr, ExprKind, ImportNames, Module, Pattern, PatternKind, TypeExpr, TypeExprKind,
};
use hray_lang::hry::syntax::parse;

fn module(text: &str) -> Module {
    let parse = parse(text, 0);
    assert!(parse.errors().is_empty(), "{:?}", parse.errors());
    parse.module()
}

/// An expression with all its parentheses, as in Lisp.
fn shown(expr: &Expr) -> String {
    let all = |exprs: &[Expr]| exprs.iter().map(shown).collect::<Vec<_>>().join(" ");
    match &expr.kind {
        ExprKind::Number(number) => number.to_string(),
        ExprKind::Bool(truth) => truth.to_string(),
        ExprKind::Text(text) => format!("{text:?}"),
        ExprKind::Color(color) => format!("{color:02x?}"),
        ExprKind::Name(name) => name.to_string(),
        ExprKind::Vector(items) => format!("(vector {})", all(items)),
        ExprKind::List(items) => format!("(list {})", all(items)),
        ExprKind::Range { first, second, last } => {
            let second = second.as_ref().map_or(String::new(), |second| format!("{} ", shown(second)));
            format!("(range {} {second}{})", shown(first), shown(last))
        }
        ExprKind::Field { record, name } => format!("{}.{}", shown(record), name.text),
        ExprKind::Apply { function, argument } => format!("({} {})", shown(function), shown(argument)),
        ExprKind::Unary { operator, operand } => format!("({operator:?} {})", shown(operand)),
        ExprKind::Binary { operator, left, right, .. } => {
            format!("({operator:?} {} {})", shown(left), shown(right))
        }
        ExprKind::If { condition, then, otherwise } => {
            format!("(if {} {} {})", shown(condition), shown(then), shown(otherwise))
        }
        ExprKind::Let { bindings, body } => {
            let bindings: Vec<String> = bindings.iter().map(|one| shown(&one.body)).collect();
            format!("(let {} {})", bindings.join(" "), shown(body))
        }
        ExprKind::Lambda { parameters, body } => {
            let parameters: Vec<String> = parameters.iter().map(pattern).collect();
            format!("(\\{} {})", parameters.join(" "), shown(body))
        }
        ExprKind::Record(fields) => {
            let fields: Vec<String> =
                fields.iter().map(|one| format!("{}={}", one.name.text, shown(&one.value))).collect();
            format!("{{{}}}", fields.join(" "))
        }
        ExprKind::Match { subject, arms } => {
            let arms: Vec<String> =
                arms.iter().map(|(case, body)| format!("{}: {}", pattern(case), shown(body))).collect();
            format!("(match {} {})", shown(subject), arms.join(" "))
        }
        ExprKind::Annotated { expression, annotation } => {
            format!("({} : {})", shown(expression), of(annotation))
        }
        other => format!("{other:?}"),
    }
}

fn pattern(pattern: &Pattern) -> String {
    let all = |patterns: &[Pattern]| patterns.iter().map(self::pattern).collect::<Vec<_>>().join(" ");
    match &pattern.kind {
        PatternKind::Name(name) => name.to_string(),
        PatternKind::Wildcard => "_".into(),
        PatternKind::Number(number) => number.to_string(),
        PatternKind::Bool(truth) => truth.to_string(),
        PatternKind::Text(text) => format!("{text:?}"),
        PatternKind::Vector(items) => format!("({})", all(items)),
        PatternKind::List { items, rest } => {
            let rest = match rest {
                None => String::new(),
                Some(None) => " ..".into(),
                Some(Some(name)) => format!(" ..{}", name.text),
            };
            format!("[{}{rest}]", all(items))
        }
        PatternKind::Record(fields) => {
            let fields: Vec<String> =
                fields.iter().map(|(name, one)| format!("{}={}", name.text, self::pattern(one))).collect();
            format!("{{{}}}", fields.join(" "))
        }
        PatternKind::Error => "error".into(),
    }
}

fn of(annotation: &TypeExpr) -> String {
    match &annotation.kind {
        TypeExprKind::Name(name) => name.to_string(),
        TypeExprKind::List(inner) => format!("[{}]", of(inner)),
        TypeExprKind::Function(from, to) => format!("({} -> {})", of(from), of(to)),
        TypeExprKind::Record(fields) => {
            let fields: Vec<String> =
                fields.iter().map(|(name, one)| format!("{}:{}", name.text, of(one))).collect();
            format!("{{{}}}", fields.join(" "))
        }
        TypeExprKind::Error => "error".into(),
    }
}

/// Checks what the only definition of a text is.
fn is(text: &str, expected: &str) {
    let module = module(&format!("it = {text}"));
    let bodies: Vec<String> = module.definitions.iter().map(|one| shown(&one.body)).collect();
    assert_eq!(bodies, [expected], "{text}");
}

#[test]
fn operators_by_precedence() {
    is("a |> f >> g or b and not c == d", "(Pipe a (Compose f (Or g (And b (Not (Equal c d))))))".trim());
    is("a + b * c ^ d ^ e", "(Add a (Multiply b (Power c (Power d e))))");
    is("a - b - c", "(Subtract (Subtract a b) c)");
    is("a / b % c", "(Modulo (Divide a b) c)");
    is("a ++ b ++ c", "(Append a (Append b c))");
    is("a |> f |> g", "(Pipe (Pipe a f) g)");
    is("a < b and b < c", "(And (Less a b) (Less b c))");
    is("f x + g y z", "(Add (f x) ((g y) z))");
    is("f x.y (g z).w", "((f x.y) (g z).w)");
    is("f { a = 1, b }", "(f {a=1 b=b})");
}

#[test]
fn the_minus_is_an_operator_a_sign_or_an_argument() {
    is("-x ^ 2", "(Negate (Power x 2))");
    is("-x * y", "(Multiply (Negate x) y)");
    is("a - 1", "(Subtract a 1)");
    is("a-1", "(Subtract a 1)");
    is("a -1", "(a (Negate 1))");
    is("f -1 -x.y", "((f (Negate 1)) (Negate x.y))");
    is("f -1 ^ 2", "(Power (f (Negate 1)) 2)");
    is("a * -b", "(Multiply a (Negate b))");
    is("2 ^ -1", "(Power 2 (Negate 1))");
    is("- -x", "(Negate (Negate x))");
    is("(-1, 2 - 3)", "(vector (Negate 1) (Subtract 2 3))");
}

#[test]
fn the_last_operand_goes_on_as_far_as_it_can() {
    is("a + if b then c else d + e", "(Add a (if b c (Add d e)))");
    is("x |> \\y -> y |> f", "(Pipe x (\\y (Pipe y f)))");
    is("1 + let a = 2 in a * 3", "(Add 1 (let 2 (Multiply a 3)))");
    is("if a then b else if c then d else e", "(if a b (if c d e))");
}

#[test]
fn literals() {
    is("180deg", &std::f64::consts::PI.to_string());
    is("360deg", &std::f64::consts::TAU.to_string());
    is("50%", "0.5");
    is("1_000.5e-1", "100.05");
    is("[50% , 7 % 2]", "(list 0.5 (Modulo 7 2))");
    is("x%2", "(Modulo x 2)");
    is("#1d3b53", "[1d, 3b, 53]");
    is("#f80", "[ff, 88, 00]");
    is(r#""a\n\t\"\\ é""#, r#""a\n\t\"\\ é""#);
}

#[test]
fn brackets() {
    is("[]", "(list )");
    is("[0 .. 3]", "(range 0 3)");
    is("[0..3]", "(range 0 3)");
    is("[0, 0.5 .. 2]", "(range 0 0.5 2)");
    is("(1, 2, 3,)", "(vector 1 2 3)");
    is("(x : [a] -> { b : Vec3, })", "(x : ([a] -> {b:Vec3}))");
    is("{ a = 1, b, }", "{a=1 b=b}");
    is("\\{ a, b = (x, _) } y -> x", "(\\{a=a b=(x _)} y x)");
    is(
        "match f x { [] -> 0, [1, .. rest] -> 1, [..] -> 2, -1 -> 3, \"t\" -> 4, (0, y) -> 5 }",
        "(match (f x) []: 0 [1 ..rest]: 1 [ ..]: 2 -1: 3 \"t\": 4 (0 y): 5)",
    );
}

#[test]
fn a_line_ends_a_binding_where_it_begins_no_further_right() {
    let module =
        module("a = f\n  x\n y\nb =\n  let c = 1\n        + 2\n      d = 3\n  in c\ne = [\n1,\n2\n]\n");
    let bodies: Vec<String> = module.definitions.iter().map(|one| shown(&one.body)).collect();
    assert_eq!(bodies, ["((f x) y)", "(let (Add 1 2) 3 c)", "(list 1 2)"]);
}

#[test]
fn columns_count_characters() {
    let module = module("a = \"äöü\" |> let é = 1\n                 f = 2 in é\n");
    assert_eq!(module.definitions.len(), 1);
    assert_eq!(shown(&module.definitions[0].body), "(Pipe \"äöü\" (let 1 2 é))");
}

#[test]
fn documentation_is_directly_above() {
    let text = "--| Of a,\n--| two lines.\na : Number\na = 1 --| not this\nb = 2\n--| not this\n\nc = 3\n--|Of d.\nd =\n  let\n    --| Of e.\n    e = 4\n  in e\n";
    let module = module(text);
    let docs: Vec<Option<&str>> = module.definitions.iter().map(|one| one.doc.as_deref()).collect();
    assert_eq!(docs, [Some("Of a,\ntwo lines."), None, None, Some("Of d.")]);
    let ExprKind::Let { bindings, .. } = &module.definitions[3].body.kind else { panic!("a let") };
    assert_eq!(bindings[0].doc.as_deref(), Some("Of e."));
    assert!(module.definitions[0].annotation.is_some());
}

#[test]
fn imports() {
    let module = module("import \"a.hry\"\nimport \"b.hry\" (x, y,)\nimport \"c.hry\" as c\nx = c.y\n");
    let [all, listed, qualified] = module.imports.as_slice() else { panic!("three imports") };
    assert_eq!((&*all.path, &all.names), ("a.hry", &ImportNames::All));
    assert!(matches!(&listed.names, ImportNames::Listed(names) if names.len() == 2));
    assert!(matches!(&qualified.names, ImportNames::As(name) if &*name.text == "c"));
}

#[test]
fn spans_are_offsets_from_the_base() {
    let text = "-- é\nab = x + (y)";
    let module = parse(text, 100).module();
    let definition = &module.definitions[0];
    let local = |span: hray_lang::diagnostic::Span| &text[span.start - 100..span.end - 100];
    assert_eq!(local(definition.span), "ab = x + (y)");
    assert_eq!(local(definition.target.span), "ab");
    assert_eq!(local(definition.body.span), "x + (y)");
    let ExprKind::Binary { operator_span, right, .. } = &definition.body.kind else { panic!("a sum") };
    assert_eq!((local(*operator_span), local(right.span)), ("+", "(y)"));
}
