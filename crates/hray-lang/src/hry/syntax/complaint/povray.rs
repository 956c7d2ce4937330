//! POV-Ray's notation, put into hry as far as its numbers stand there.

use super::super::kind::SyntaxKind;
use super::super::parser::Parser;

/// A vector or a number of a statement, as written.
#[derive(Debug)]
enum Value {
    Vector(Vec<String>),
    Number(String),
}

impl Parser<'_> {
    /// How the statement whose name is at a token is written in hry; none where that is not plain.
    pub(super) fn translated(&self, name: usize) -> Option<String> {
        let word = self.text_of(name);
        let values = self.values_after(name + 2);
        let written = match (word, values.as_slice()) {
            ("sphere", [Value::Vector(center), Value::Number(radius), ..]) if center.len() == 3 => {
                format!("sphere {{ center = {}, radius = {radius} }}", vector(center))
            }
            ("box", [Value::Vector(a), Value::Vector(b), ..]) => {
                let (a, b) = (numbers(a)?, numbers(b)?);
                let center: Vec<String> = a.iter().zip(&b).map(|(a, b)| rounded((a + b) / 2.0)).collect();
                let size: Vec<String> = a.iter().zip(&b).map(|(a, b)| rounded((b - a).abs())).collect();
                format!("box {{ center = {}, size = {} }}", vector(&center), vector(&size))
            }
            ("plane", [Value::Vector(normal), Value::Number(offset), ..]) => {
                let normal = match normal.iter().map(String::as_str).collect::<Vec<_>>().as_slice() {
                    ["0", "1", "0"] => "up".to_owned(),
                    _ => vector(normal),
                };
                format!("plane {{ normal = {normal}, offset = {offset} }}")
            }
            ("light_source", [Value::Vector(position), ..]) => {
                format!("point {{ position = {} }}", vector(position))
            }
            ("camera", _) => {
                let from = self.named_vector(name, "location")?;
                let to = self.named_vector(name, "look_at").unwrap_or_else(|| "(0, 0, 0)".into());
                return Some(format!(
                    "write `camera = perspective {{ from = {from}, to = {to} }}` in the scene"
                ));
            }
            _ => return None,
        };
        let place = if word == "light_source" { " in the list `lights` of the scene" } else { "" };
        Some(format!("write `{written}`{place}"))
    }

    /// Vectors and numbers from a token on, separated by commas.
    fn values_after(&self, mut token: usize) -> Vec<Value> {
        let mut values = Vec::new();
        while values.len() < 3 {
            let Some((value, next)) = self.value_at(token) else { break };
            values.push(value);
            token = next;
            if self.kind_of(token) == SyntaxKind::Comma {
                token += 1;
            }
        }
        values
    }

    /// The value at a token, and the token after it.
    fn value_at(&self, token: usize) -> Option<(Value, usize)> {
        match (self.kind_of(token), self.text_of(token)) {
            (SyntaxKind::Less | SyntaxKind::From, _) => {
                self.angles_at(token).map(|(parts, next)| (Value::Vector(parts), next))
            }
            (SyntaxKind::Name, axis @ ("x" | "y" | "z")) => {
                // The z axis points the other way.
                let one = if axis == "z" { "-1" } else { "1" };
                let part = |name: &str| if name == axis { one } else { "0" }.to_owned();
                Some((Value::Vector(vec![part("x"), part("y"), part("z")]), token + 1))
            }
            _ => self.number_at(token).map(|(number, next)| (Value::Number(number), next)),
        }
    }

    /// `<a, b, c>`, put into our axes: z points towards the eye, and in POV-Ray away from it.
    fn angles_at(&self, open: usize) -> Option<(Vec<String>, usize)> {
        let (mut token, mut parts) = (open + 1, Vec::new());
        loop {
            let (number, next) = self.number_at(token)?;
            // In `<-1, 0, 0>` the sign is part of what looks like an arrow.
            let is_negative = token == open + 1 && self.kind_of(open) == SyntaxKind::From;
            let number = if is_negative { format!("-{number}") } else { number };
            parts.push(if parts.len() == 2 { negated(&number) } else { number });
            match self.kind_of(next) {
                SyntaxKind::Comma if parts.len() < 3 => token = next + 1,
                SyntaxKind::Greater => return Some((parts, next + 1)),
                _ => return None,
            }
        }
    }

    fn number_at(&self, token: usize) -> Option<(String, usize)> {
        let sign = usize::from(self.kind_of(token) == SyntaxKind::Minus);
        if self.kind_of(token + sign) != SyntaxKind::Number {
            return None;
        }
        let digits = self.text_of(token + sign);
        let minus = if sign == 1 { "-" } else { "" };
        Some((format!("{minus}{digits}"), token + sign + 1))
    }

    /// `name <a, b, c>` in the braces after a statement's name.
    fn named_vector(&self, statement: usize, name: &str) -> Option<String> {
        let mut tokens = (statement + 2..statement + 60)
            .take_while(|token| self.kind_of(*token) != SyntaxKind::CloseBrace);
        let at = tokens.find(|token| self.text_of(*token) == name)?;
        match self.value_at(at + 1)?.0 {
            Value::Vector(parts) => Some(vector(&parts)),
            Value::Number(_) => None,
        }
    }
}

/// A number as written, with the other sign.
fn negated(number: &str) -> String {
    match number.strip_prefix('-') {
        Some(positive) => positive.to_owned(),
        None if number.parse() == Ok(0.0) => number.to_owned(),
        None => format!("-{number}"),
    }
}

fn vector(parts: &[String]) -> String {
    format!("({})", parts.join(", "))
}

fn numbers(parts: &[String]) -> Option<[f64; 3]> {
    let numbers: Vec<f64> = parts.iter().filter_map(|part| part.parse().ok()).collect();
    numbers.try_into().ok()
}

fn rounded(value: f64) -> String {
    format!("{}", (value * 1e6).round() / 1e6)
}
