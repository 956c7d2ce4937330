//! Programs from text.

use hray_core::{Description, Field, Function, Material, Texture};
use hray_lang::diagnostic::Diagnostic;
use hray_lang::hry::assets::{AssetError, Assets};
use hray_lang::hry::eval::{Evaluated, Limits, evaluate};
use hray_lang::hry::{Program, types};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Files in memory.
#[derive(Default)]
pub(crate) struct Files(pub(crate) BTreeMap<&'static str, &'static str>);

impl Assets for Files {
    fn text(&self, path: &str) -> Result<String, AssetError> {
        self.0.get(path).map(|text| (*text).to_owned()).ok_or(AssetError::NotFound)
    }

    fn image(&self, path: &str) -> Result<Arc<hray_core::Image>, AssetError> {
        let image = hray_core::Image::new(2, 1, vec![[1.0, 0.0, 0.0, 1.0], [0.0, 0.0, 1.0, 1.0]]);
        image.filter(|_| path.ends_with(".png")).map(Arc::new).ok_or(AssetError::NotFound)
    }

    /// Two parts of one triangle each; a third part has none.
    fn model(&self, path: &str) -> Result<Arc<hray_core::Model>, AssetError> {
        use hray_core::{DAffine3, DVec3, Mesh, Model, ModelFormat, ModelMaterial, ModelPart, Rgb};
        if path.ends_with(".stl") {
            return Err(AssetError::Unreadable("line 3: it is damaged".to_owned()));
        }
        let points = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
        let mesh = Arc::new(Mesh::new(points, vec![[0, 1, 2], [1, 3, 2]]).unwrap());
        let part = |mesh: &Arc<Mesh>, x: f64| ModelPart {
            name: String::new(),
            mesh: mesh.clone(),
            transform: (x != 0.0).then(|| DAffine3::from_translation(DVec3::new(x, 0.0, 0.0))),
            material: (x != 0.0)
                .then(|| Arc::new(ModelMaterial::new("red".to_owned(), Rgb::new(0.5, 0.0, 0.0)))),
        };
        let parts = vec![part(&mesh, 0.0), part(&mesh, 2.0), part(&Arc::default(), 3.0)];
        let parts = if path.ends_with(".ply") { parts.into_iter().take(1).collect() } else { parts };
        let notes = if path.ends_with(".obj") { vec!["curves are not read".to_owned()] } else { Vec::new() };
        match path.rsplit_once('.') {
            Some((_, "ply" | "obj" | "glb")) => {
                Ok(Arc::new(Model { format: ModelFormat::Obj, parts, notes }))
            }
            _ => Err(AssetError::NotFound),
        }
    }

    fn neighbours(&self, _path: &str) -> Vec<String> {
        self.0.keys().map(|name| (*name).to_owned()).collect()
    }
}

/// What a text comes to, at a time, within limits.
pub(crate) fn run_with(text: &str, files: &Files, time: f64, limits: &Limits) -> (Program, Evaluated) {
    let mut diagnostics = Vec::new();
    let program = Program::load("scene.hry", "scene.hry", text.into(), &[], files, &mut diagnostics);
    types::check(&program, &mut diagnostics);
    if diagnostics.iter().any(Diagnostic::is_error) {
        return (program, Evaluated { diagnostics, ..Evaluated::default() });
    }
    let evaluated = evaluate(&program, files, time, limits);
    (program, evaluated)
}

/// The scene that a text describes.
pub(crate) fn scene(text: &str) -> Description {
    let (program, evaluated) = run_with(text, &Files::default(), 0.0, &Limits::default());
    evaluated.description.unwrap_or_else(|| panic!("{}", shown(&program, &evaluated.diagnostics)))
}

/// The errors of a text, as a user sees them.
pub(crate) fn errors(text: &str) -> String {
    errors_with(text, &Limits::default())
}

/// The errors of a text within limits.
pub(crate) fn errors_with(text: &str, limits: &Limits) -> String {
    let (program, evaluated) = run_with(text, &Files::default(), 0.0, limits);
    assert!(evaluated.description.is_none(), "there are no errors");
    shown(&program, &evaluated.diagnostics)
}

/// Diagnostics as text.
pub(crate) fn shown(program: &Program, diagnostics: &[Diagnostic]) -> String {
    hray_lang::diagnostic::render_sources(diagnostics, &program.sources, false)
}

/// The value of a number, by way of a sphere's radius.
pub(crate) fn number(definitions: &str, expression: &str) -> f64 {
    let text = format!("{definitions}\nscene = {{ objects = [sphere {{ center = ({expression}, 0, 0) }}] }}");
    match &scene(&text).scene.primitives[0].shape {
        hray_core::Shape::Sphere(sphere) => sphere.center.x,
        other => panic!("{other:?}"),
    }
}

/// The material of a sphere whose `classic` has these fields.
pub(crate) fn material(definitions: &str, fields: &str) -> Arc<Material> {
    let text =
        format!("{definitions}\nscene = {{ objects = [sphere {{ material = classic {{ {fields} }} }}] }}");
    scene(&text).scene.primitives[0].material.clone()
}

/// The function that a colour is compiled to.
pub(crate) fn color_function(definitions: &str, color: &str) -> Arc<Function> {
    match &material(definitions, &format!("color = {color}")).texture {
        Texture::Function(function) => function.clone(),
        other => panic!("{other:?}"),
    }
}

/// The function that a number is compiled to.
pub(crate) fn number_function(definitions: &str, number: &str) -> Arc<Function> {
    match &material(definitions, &format!("reflection = {number}")).reflection {
        Field::Function(function) => function.clone(),
        other => panic!("{other:?}"),
    }
}
