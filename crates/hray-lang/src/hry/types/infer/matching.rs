//! Matches: their arms, and whether these take every value.

use super::{Expected, Infer, Why};
use crate::diagnostic::{Diagnostic, Span};
use crate::hry::ast::{Expr, Pattern, PatternKind};
use crate::hry::types::store::Ty;

impl<'p> Infer<'p> {
    pub(super) fn matching(
        &mut self,
        expr: &'p Expr,
        subject: &'p Expr,
        arms: &'p [(Pattern, Expr)],
        expected: Expected<'p>,
    ) -> Ty {
        let ty = self.expr(subject, None);
        let known = self.telling(expected);
        let mut first: Expected<'p> = known;
        for (pattern, body) in arms {
            self.pattern(pattern, ty, subject.span, true);
            let found = self.expr(body, first);
            if first.is_none() {
                first = Some((found, Why::Arm { first: body.span }));
            }
        }
        self.every_value(expr, subject, arms);
        match (known, first) {
            (Some((ty, _)), _) => ty,
            (None, Some((ty, _))) => self.settle(expr, ty, expected),
            (None, None) => Ty::ERROR,
        }
    }

    /// Reports values that no arm takes, and arms that take nothing.
    fn every_value(&mut self, expr: &Expr, subject: &Expr, arms: &[(Pattern, Expr)]) {
        let all = arms.iter().position(|(pattern, _)| takes_all(pattern));
        if let Some((place, (all, _))) = all.and_then(|place| Some((place, arms.get(place)?))) {
            if let Some((first, _)) = arms.get(place + 1) {
                let warning = Diagnostic::warning(
                    "unreachable-arm",
                    "no value gets to this case",
                    first.span,
                    "never used",
                )
                .with_secondary(all.span, "this case takes everything")
                .with_help("put the case that takes everything last");
                self.report(warning);
            }
            return;
        }
        if arms.is_empty() || arms.iter().any(|(pattern, _)| matches!(pattern.kind, PatternKind::Error)) {
            return;
        }
        let Some(missing) = missing(arms) else { return };
        let word = Span::new(expr.span.start, expr.span.start + "match".len());
        let error = Diagnostic::error(
            "missing-case",
            format!("this match has no case for `{missing}`"),
            word,
            "some values are taken by no case",
        )
        .with_secondary(subject.span, "what is looked at");
        let help = match missing.as_str() {
            "_" => "add a last case for everything else: `_ -> ...`".to_owned(),
            missing => format!("add a case: `{missing} -> ...`, or one for everything else: `_ -> ...`"),
        };
        self.report(error.with_help(help));
    }
}

/// Whether a pattern takes every value of its type.
fn takes_all(pattern: &Pattern) -> bool {
    match &pattern.kind {
        PatternKind::Name(_) | PatternKind::Wildcard => true,
        PatternKind::Vector(parts) => parts.iter().all(takes_all),
        PatternKind::Record(fields) => fields.iter().all(|(_, pattern)| takes_all(pattern)),
        PatternKind::List { items, rest } => items.is_empty() && rest.is_some(),
        _ => false,
    }
}

/// A value that no arm takes. It may also show one that several arms take together in a roundabout way: those
/// are to be followed by a case for everything else.
fn missing(arms: &[(Pattern, Expr)]) -> Option<String> {
    let patterns = || arms.iter().map(|(pattern, _)| &pattern.kind);
    if patterns().any(|pattern| matches!(pattern, PatternKind::Bool(_))) {
        let missing =
            [true, false].into_iter().find(|value| !patterns().any(|p| *p == PatternKind::Bool(*value)));
        return missing.map(|value| value.to_string());
    }
    if patterns().any(|pattern| matches!(pattern, PatternKind::List { .. })) {
        return missing_list(arms);
    }
    Some("_".into())
}

fn missing_list(arms: &[(Pattern, Expr)]) -> Option<String> {
    // Of lists only those arms count that look at nothing but the length.
    let lengths: Vec<(usize, bool)> = arms
        .iter()
        .filter_map(|(pattern, _)| match &pattern.kind {
            PatternKind::List { items, rest } if items.iter().all(takes_all) => {
                Some((items.len(), rest.is_some()))
            }
            _ => None,
        })
        .collect();
    let longest = lengths.iter().map(|(length, _)| length + 1).max().unwrap_or(0);
    let taken = |n: usize| lengths.iter().any(|(length, more)| n == *length || (*more && n > *length));
    let missing = (0..=longest).find(|n| !taken(*n))?;
    let items = vec!["_"; missing.min(8)].join(", ");
    let open = !lengths.iter().any(|(length, _)| *length > missing);
    Some(match (missing, open) {
        (0, true) if longest == 0 => "_".into(),
        (0, _) => "[]".into(),
        (_, true) => format!("[{items}, ..]"),
        (_, false) => format!("[{items}]"),
    })
}
