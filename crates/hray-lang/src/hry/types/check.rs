//! The pass as a whole.

use super::checked::Checked;
use super::infer::Infer;
use super::names::{Names, resolve};
use super::scheme::Types;
use super::unused;
use crate::diagnostic::{Diagnostic, Span};
use crate::hry::library::NATIVES;
use crate::hry::program::{LoadedModule, Program, standard};
use crate::hry::sources::Sources;
use crate::hry::syntax;
use std::sync::{Arc, OnceLock};

/// Finds the meaning of every name and the type of every expression of a program. What is wrong goes to
/// `diagnostics`.
pub fn check(program: &Program, diagnostics: &mut Vec<Diagnostic>) -> Checked {
    let first = standard().modules.len();
    let own = first..program.modules.len();
    let mut names = Names::default();
    let mut found = Vec::new();
    for place in own.clone() {
        if let Some(module) = program.modules.get(place) {
            resolve(&mut names, &mut found, place, module);
        }
    }
    let mut infer = Infer::of_program(program, &names, standard_types().0.clone());
    infer.modules(own);
    if let Some(root) = program.root() {
        let has_scene =
            root.syntax.definitions.iter().any(|d| d.name().is_some_and(|name| &*name.text == "scene"));
        // What is misspelt is not used; that is no news then.
        let is_sound = !diagnostics.iter().chain(&found).any(Diagnostic::is_error);
        if !has_scene {
            infer.no_scene(root);
        } else if is_sound {
            unused::check(program, &names, &mut found);
        }
    }
    infer.finish();
    found.append(&mut infer.diagnostics);
    // Where the scene is something else altogether, all the rest is unused for that reason.
    if found.iter().any(|diagnostic| diagnostic.code == "wrong-scene") {
        found.retain(|diagnostic| !matches!(diagnostic.code, "unused-definition" | "unused-import"));
    }
    // A value that lacks its hit is no function for want of it, so that is not wrong as well.
    let no_functions: Vec<Span> = found
        .iter()
        .filter(|diagnostic| diagnostic.code == "unknown-name")
        .flat_map(|diagnostic| diagnostic.secondary.iter().map(|label| label.span))
        .collect();
    found.retain(|diagnostic| {
        diagnostic.code != "wrong-field" || !no_functions.contains(&diagnostic.primary.span)
    });
    found.sort_by_key(|diagnostic| (diagnostic.primary.span.start, diagnostic.primary.span.end));
    found.dedup();
    // Where the text could not be read, what was made of it says nothing about what was meant.
    let unread: Vec<Span> = diagnostics
        .iter()
        .filter(|diagnostic| diagnostic.is_error())
        .flat_map(|diagnostic| std::iter::once(&diagnostic.primary).chain(&diagnostic.secondary))
        .map(|label| label.span)
        .collect();
    let touches = |span: Span| unread.iter().any(|other| span.start < other.end && other.start < span.end);
    found.retain(|diagnostic| !touches(diagnostic.primary.span));
    diagnostics.extend(found);
    let Infer { types, notes, fields, literals, accesses, locals, .. } = infer;
    Checked::new(program, names, types, locals, notes, fields, literals, accesses)
}

/// The types of the library, and what is wrong with it: nothing, as the tests see to.
pub(super) fn standard_types() -> &'static (Types, Vec<Diagnostic>) {
    static TYPES: OnceLock<(Types, Vec<Diagnostic>)> = OnceLock::new();
    TYPES.get_or_init(|| {
        let library = standard();
        let mut errors = Vec::new();
        let mut types = native_types(&mut errors);
        let mut names = Names::default();
        for (place, module) in library.modules.iter().enumerate() {
            resolve(&mut names, &mut errors, place, module);
        }
        let sources = Sources::default();
        types.definitions.clear();
        let mut infer = Infer::new(&library.modules, &sources, None, &names, types);
        infer.modules(0..library.modules.len());
        infer.finish();
        errors.append(&mut infer.diagnostics);
        (infer.types, errors)
    })
}

/// The types of the native functions, as their table writes them.
fn native_types(errors: &mut Vec<Diagnostic>) -> Types {
    let text: String = NATIVES
        .iter()
        .map(|native| format!("{} : {}\n{} = 0\n", native.name, native.signature, native.name))
        .collect();
    let parsed = syntax::parse(&text, 0);
    errors.extend(parsed.errors().iter().cloned());
    let module = parsed.module();
    let modules: [Arc<LoadedModule>; 0] = [];
    let (sources, names) = (Sources::default(), Names::default());
    let mut infer = Infer::new(&modules, &sources, None, &names, Types::default());
    let schemes = NATIVES.iter().map(|native| {
        let definition =
            module.definitions.iter().find(|d| d.name().is_some_and(|name| &*name.text == native.name));
        match definition.and_then(|definition| definition.annotation.as_ref()) {
            Some(annotation) => infer.declared(annotation),
            None => {
                let message = format!("the signature of `{}` cannot be read", native.name);
                errors.push(Diagnostic::error("library", message, Span::default(), ""));
                infer.declared_error()
            }
        }
    });
    let natives = schemes.map(Arc::new).collect();
    errors.append(&mut infer.diagnostics);
    Types { natives, ..infer.types }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_wrong_with_the_library() {
        let (_, wrong) = standard_types();
        let errors: Vec<_> = wrong.iter().filter(|diagnostic| diagnostic.is_error()).collect();
        assert!(errors.is_empty(), "{errors:#?}");
    }
}
