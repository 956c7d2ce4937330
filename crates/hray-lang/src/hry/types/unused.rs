//! What nothing uses.

use super::names::Names;
use crate::diagnostic::{Diagnostic, Span};
use crate::hry::assets::resolve;
use crate::hry::ast::{Definition, Import, ImportNames};
use crate::hry::program::{Global, LoadedModule, Program};
use std::collections::HashSet;

/// Warns about definitions, imports and locals that nothing uses.
pub(super) fn check(program: &Program, names: &Names, found: &mut Vec<Diagnostic>) {
    definitions(program, names, found);
    imports(program, names, found);
    for local in &names.locals {
        if local.is_let && !local.is_used && !local.name.starts_with('_') {
            let message = format!("`{}` is not used", local.name);
            let warning =
                Diagnostic::warning("unused-local", message, local.span, "bound here, used nowhere");
            found.push(warning.with_help(format!("remove it, or name it `_{}`", local.name)));
        }
    }
}

/// Definitions of the scene's file that the scene does not need.
fn definitions(program: &Program, names: &Names, found: &mut Vec<Diagnostic>) {
    let Some(root) = program.root() else { return };
    let all = &root.syntax.definitions;
    let is_scene = |d: &Definition| d.name().is_some_and(|name| &*name.text == "scene");
    let mut open: Vec<(usize, usize)> =
        all.iter().position(is_scene).map(|index| (program.root, index)).into_iter().collect();
    let kept =
        all.iter().enumerate().filter(|(_, d)| d.name().is_some_and(|name| name.text.starts_with('_')));
    open.extend(kept.map(|(index, _)| (program.root, index)));
    let mut reached: HashSet<(usize, usize)> = open.iter().copied().collect();
    while let Some(definition) = open.pop() {
        for needed in names.needs.get(&definition).into_iter().flatten() {
            if reached.insert(*needed) {
                open.push(*needed);
            }
        }
    }
    for (index, definition) in all.iter().enumerate() {
        let Some(name) = definition.name() else { continue };
        // Of two with one name the second means nothing; that was reported.
        let means = root.scope.names.get(&name.text);
        let is_meant = matches!(means, Some(Global::Definition { module, index: i }) if (*module, *i) == (program.root, index));
        if is_meant && !reached.contains(&(program.root, index)) {
            let message = format!("`{}` is not used by the scene", name.text);
            let warning =
                Diagnostic::warning("unused-definition", message, name.span, "defined here, used nowhere");
            found.push(warning.with_help(format!("use it, remove it, or name it `_{}`", name.text)));
        }
    }
}

/// Imports of which nothing is used.
fn imports(program: &Program, names: &Names, found: &mut Vec<Diagnostic>) {
    let own = program.modules.iter().enumerate().filter(|(_, module)| !module.is_standard);
    for (_, module) in own {
        if module.syntax.imports.is_empty() {
            continue;
        }
        let used = used(program, names, module);
        for import in &module.syntax.imports {
            unused_import(program, module, import, &used, found);
        }
    }
}

/// The definitions of other modules that a module uses; not merely names in an import.
fn used(program: &Program, names: &Names, module: &LoadedModule) -> HashSet<(usize, usize)> {
    let place = program.modules.iter().position(|other| other.path == module.path && !other.is_standard);
    let all = place.map(|place| (0..module.syntax.definitions.len()).map(move |index| (place, index)));
    let needs = all.into_iter().flatten().filter_map(|key| names.needs.get(&key));
    needs.flatten().copied().collect()
}

fn unused_import(
    program: &Program,
    module: &LoadedModule,
    import: &Import,
    used: &HashSet<(usize, usize)>,
    found: &mut Vec<Diagnostic>,
) {
    let path = resolve(&module.path, &import.path);
    let imported =
        program.modules.iter().position(|other| !other.is_standard && Some(&other.path) == path.as_ref());
    let Some(imported) = imported else { return };
    let warn = |span: Span, what: &str| {
        let warning = Diagnostic::warning(
            "unused-import",
            format!("{what} is not used"),
            span,
            "imported, used nowhere",
        );
        warning.with_help("remove it")
    };
    let ImportNames::Listed(listed) = &import.names else {
        if !used.iter().any(|(module, _)| *module == imported) {
            found.push(warn(import.span, &format!("the import of {:?}", import.path)));
        }
        return;
    };
    for name in listed {
        if let Some(Global::Definition { module, index }) = module.scope.names.get(&name.text)
            && *module == imported
            && !used.contains(&(*module, *index))
        {
            found.push(warn(name.span, &format!("`{}`", name.text)));
        }
    }
}
