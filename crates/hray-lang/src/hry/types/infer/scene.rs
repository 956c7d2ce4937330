//! The definition `scene`: what is rendered.

use super::group::Place;
use super::{Infer, Why};
use crate::diagnostic::{Diagnostic, Span};
use crate::hry::ast::{Definition, Expr, ExprKind, FieldValue};
use crate::hry::library::{Constructor, constructor};
use crate::hry::program::nearest;
use crate::hry::types::scheme::Demand;
use crate::hry::types::store::{Node, Ty};

impl<'p> Infer<'p> {
    /// Whether a definition is what is rendered.
    pub(super) fn is_scene(&self, place: Place, definition: &Definition) -> bool {
        let root = matches!(place, Place::Top { module, .. } if Some(module) == self.root);
        root && definition.name().is_some_and(|name| &*name.text == "scene")
    }

    /// The body of `scene`, checked against the fields that a scene has.
    pub(super) fn scene(&mut self, definition: &'p Definition, ty: Ty, annotation: Option<Span>) {
        let Some(scene) = constructor("scene") else { return };
        if let Some(second) = definition.parameters.get(1) {
            let message = "`scene` is a record, or a function of one parameter: the time in seconds";
            let error = Diagnostic::error("wrong-scene", message, second.span, "one parameter too many");
            self.report(error.with_help("`scene t = { ... }`; a still picture takes t = 0"));
        }
        let mut expected = ty;
        for (index, parameter) in definition.parameters.iter().enumerate() {
            let Some((from, to)) = self.function_parts(expected) else {
                self.pattern(parameter, Ty::NUMBER, parameter.span, false);
                continue;
            };
            if index == 0 {
                let _ = self.unify(from, Ty::NUMBER);
            }
            self.pattern(parameter, from, parameter.span, false);
            expected = to;
        }
        let mut body = &definition.body;
        if let (true, ExprKind::Lambda { parameters, body: inner }) =
            (definition.parameters.is_empty(), &body.kind)
            && let [parameter] = parameters.as_slice()
        {
            self.pattern(parameter, Ty::NUMBER, parameter.span, false);
            let to = self.fresh();
            let function = self.types.store.function(Ty::NUMBER, to);
            let why = annotation.map_or(Why::Recursion(definition.target.span), Why::Annotation);
            expected = self.settle(body, function, Some((expected, why)));
            expected = self.function_parts(expected).map_or(to, |(_, to)| to);
            body = inner;
        }
        let found = self.scene_body(body, scene);
        let why = annotation.map_or(Why::Recursion(definition.target.span), Why::Annotation);
        self.settle(body, found, Some((expected, why)));
    }

    /// What a scene is made of, through `let`s. The type that it has as a record.
    fn scene_body(&mut self, body: &'p Expr, scene: &'static Constructor) -> Ty {
        let ty = match &body.kind {
            ExprKind::Let { bindings, body } => {
                self.bindings(bindings);
                self.scene_body(body, scene)
            }
            ExprKind::Record(fields) => self.scene_record(body, fields, scene),
            _ => {
                let ty = self.expr(body, None);
                self.scene_value(body, ty, scene);
                return ty;
            }
        };
        self.note(body.span, ty);
        ty
    }

    /// A scene that is not written as a record: what its type says.
    fn scene_value(&mut self, body: &'p Expr, ty: Ty, scene: &'static Constructor) {
        let record = match self.types.store.get(ty) {
            Node::Function(from, to) => {
                let (from, to) = (*from, *to);
                if self.unify(from, Ty::NUMBER).is_err() { ty } else { to }
            }
            _ => ty,
        };
        if self.types.store.is_variable(record) || matches!(self.types.store.get(record), Node::Record(_)) {
            self.demand(Demand::Construct { record, constructor: scene }, super::solve::at(body.span));
        } else if !self.types.store.is_error(record) {
            let error = self.wrong_scene(body, ty);
            self.report(error);
        }
    }

    fn scene_record(&mut self, body: &'p Expr, fields: &'p [FieldValue], scene: &'static Constructor) -> Ty {
        let typed = self.constructor_fields(scene, body.span, fields);
        self.types.store.record(typed)
    }

    /// The complaint about a file without a scene.
    pub(in crate::hry::types) fn no_scene(&mut self, root: &crate::hry::program::LoadedModule) {
        let definitions = &root.syntax.definitions;
        let names: Vec<_> = definitions.iter().filter_map(Definition::name).collect();
        let start = self.sources.files().first().map_or(0, |file| file.base);
        let near = nearest("scene", names.iter().map(|name| &*name.text)).map(str::to_owned);
        let near = near.or_else(|| {
            let usual = ["Scene", "main", "world", "image", "picture", "render"];
            names.iter().map(|name| &*name.text).find(|name| usual.contains(name)).map(str::to_owned)
        });
        let span = near.as_ref().and_then(|near| names.iter().find(|name| &*name.text == near.as_str()));
        let message = "nothing says what to render: there is no definition `scene`";
        let error = match span {
            Some(name) => {
                let error = Diagnostic::error("no-scene", message, name.span, "was this meant to be the scene?");
                error.with_suggestion(name.span, "scene", "what is rendered is called `scene`")
            }
            None => Diagnostic::error("no-scene", message, Span::at(start), "this file has no `scene`").with_help(
                "the smallest scene:\nscene = {\n  lights  = [ point { position = (3, 4, 5) } ],\n  objects = [ sphere {} ],\n}",
            ),
        };
        self.report(error);
    }
}
