//! Where a name is defined, and where it is used.

use super::analysis::{Analysis, FileId, Place};
use super::context::{span_of, token_at};
use super::describe;
use super::outline::{OUTLINE, outline_place};
use crate::diagnostic::Span;
use crate::hry::assets::resolve;
use crate::hry::program::Global;
use crate::hry::syntax::{SyntaxKind, parse};
use crate::hry::types::Target;

impl Analysis {
    /// Where the name at an offset is defined, or the file that an import names.
    #[must_use]
    pub fn definition(&self, offset: usize) -> Option<Place> {
        let (program, _) = self.hry.as_ref()?;
        let root = parse(&self.text, 0).root();
        let token = token_at(&root, offset)?;
        let in_import = token.parent().is_some_and(|parent| parent.kind() == SyntaxKind::Import);
        if in_import && token.kind() == SyntaxKind::Text {
            let path = resolve(&self.path, token.text().trim_matches('"'))?;
            program.modules.iter().find(|module| !module.is_standard && module.path == path)?;
            return Some(Place { file: FileId::Own(path), span: Span::at(0) });
        }
        match self.target(offset)? {
            Target::Global(Global::Native(native)) => outline_place(native.name, None),
            Target::Global(Global::Constructor(constructor)) => outline_place(constructor.name, None),
            Target::Field(constructor, field) => outline_place(constructor.name, Some(field.name)),
            target => self.defined_at(&target),
        }
    }

    /// What the name at an offset refers to. The names in the list of an import refer to what they bring in.
    pub(super) fn target(&self, offset: usize) -> Option<Target> {
        let (program, checked) = self.hry.as_ref()?;
        let root = program.root()?;
        for import in &root.syntax.imports {
            if let crate::hry::ast::ImportNames::Listed(names) = &import.names {
                let listed = names.iter().find(|name| name.span.start <= offset && offset <= name.span.end);
                if let Some(name) = listed {
                    return root.scope.names.get(&name.text).map(|global| Target::Global(*global));
                }
            }
        }
        checked.definition_at(offset)
    }

    /// Where the name of a target is bound.
    pub(super) fn defined_at(&self, target: &Target) -> Option<Place> {
        match target {
            Target::Local(span) => self.place(*span),
            Target::Global(global) => {
                let definition = describe::definition(self, *global)?;
                self.place(definition.target.span)
            }
            Target::Field(..) => None,
        }
    }

    /// Where the name at an offset is used, in this file and what it imports; where it is defined, too, if asked for.
    #[must_use]
    pub fn references(&self, offset: usize, with_definition: bool) -> Vec<Place> {
        let Some(target) = self.target(offset) else { return Vec::new() };
        let defined = self.defined_at(&target);
        let mut found = self.uses(&target);
        found.retain(|place| with_definition || Some(place) != defined.as_ref());
        found
    }

    /// Where a definition of another analysis, or of this one, is used here. `defined` is where its name is bound.
    #[must_use]
    pub fn uses_of(&self, defined: &Place) -> Vec<Place> {
        let Some((_, checked)) = &self.hry else { return Vec::new() };
        let target = self.span(defined).and_then(|span| checked.definition_at(span.start));
        match target {
            Some(target) if self.defined_at(&target).as_ref() == Some(defined) => self.uses(&target),
            _ => Vec::new(),
        }
    }

    /// Every place where a target is named.
    pub(super) fn uses(&self, target: &Target) -> Vec<Place> {
        let Some((program, checked)) = &self.hry else { return Vec::new() };
        let mut found: Vec<Place> =
            checked.references(target).into_iter().filter_map(|span| self.place(span)).collect();
        for module in program.modules.iter().filter(|module| !module.is_standard) {
            for import in &module.syntax.imports {
                let crate::hry::ast::ImportNames::Listed(names) = &import.names else { continue };
                let means = |name: &&crate::hry::ast::Name| {
                    let global = module.scope.names.get(&name.text);
                    global.is_some_and(|global| Target::Global(*global) == *target)
                };
                found.extend(names.iter().filter(means).filter_map(|name| self.place(name.span)));
            }
        }
        // The annotation above a definition names it, too.
        let defined = self.defined_at(target);
        if let Some(annotation) = defined.and_then(|place| self.annotation_of(&place)) {
            found.push(annotation);
        }
        found.sort();
        found.dedup();
        found
    }

    /// The name in the annotation that belongs to the definition whose name is at a place.
    fn annotation_of(&self, place: &Place) -> Option<Place> {
        let (program, _) = self.hry.as_ref()?;
        let span = self.span(place)?;
        let file = program.sources.file(span.start)?;
        let root = parse(&file.text, 0).root();
        let token = token_at(&root, place.span.start)?;
        let definition = token.parent()?.ancestors().find(|node| node.kind() == SyntaxKind::Definition)?;
        let annotation = definition.prev_sibling().filter(|node| node.kind() == SyntaxKind::Annotation)?;
        let name = annotation.first_token().filter(|name| name.text() == token.text())?;
        Some(Place { file: place.file.clone(), span: span_of(name.text_range()) })
    }

    /// Whether the place is in the outline of what is not written in hry.
    #[must_use]
    pub fn is_outline(place: &Place) -> bool {
        place.file == FileId::Library(OUTLINE)
    }
}
