//! Meshes, from files and from lists.

use crate::common::{Files, errors, errors_with, run_with, scene, shown};
use hray_core::{Mesh, Primitive, Rgb, Shape, Texture};
use hray_lang::hry::eval::Limits;
use std::sync::Arc;

fn objects(objects: &str) -> Vec<Primitive> {
    scene(&format!("scene = {{ objects = [{objects}] }}")).scene.primitives
}

fn mesh(primitive: &Primitive) -> &Arc<Mesh> {
    match &primitive.shape {
        Shape::Mesh(mesh) => mesh,
        other => panic!("{other:?}"),
    }
}

fn color(primitive: &Primitive) -> Rgb {
    match primitive.material.texture {
        Texture::Solid(color) => color,
        ref other => panic!("{other:?}"),
    }
}

#[test]
fn a_file_gives_its_parts_with_their_colours() {
    let parts = objects("mesh { file = \"a.glb\" }");
    assert_eq!(parts.len(), 2);
    assert!(Arc::ptr_eq(mesh(&parts[0]), mesh(&parts[1])));
    assert_eq!((color(&parts[0]), color(&parts[1])), (Rgb::new(1.0, 1.0, 1.0), Rgb::new(0.5, 0.0, 0.0)));
    assert_eq!(parts[1].transform.as_ref().unwrap().translation.x, 2.0);
    let painted =
        objects("translate (1, 0, 0) (mesh { file = \"a.glb\", material = classic { color = rgb 0 1 0 } })");
    assert!(painted.iter().all(|part| color(part) == Rgb::new(0.0, 1.0, 0.0)));
    assert_eq!(painted[1].transform.as_ref().unwrap().translation.x, 3.0);
}

#[test]
fn a_file_that_is_used_twice_is_one_mesh() {
    let three = objects(
        "mesh { file = \"a.ply\" }, mesh { file = \"a.ply\" }, mesh { file = \"a.ply\", smooth = true }",
    );
    assert!(Arc::ptr_eq(mesh(&three[0]), mesh(&three[1])));
    assert_eq!((mesh(&three[0]).normals().len(), mesh(&three[2]).normals().len()), (0, 4));
    assert_eq!(mesh(&three[2]).normals()[3], [0.0, 0.0, 1.0]);
}

#[test]
fn what_a_file_has_besides_is_a_warning() {
    let text = "scene = { objects = [mesh { file = \"a.obj\" }] }";
    let (program, evaluated) = run_with(text, &Files::default(), 0.0, &Limits::default());
    assert!(evaluated.description.is_some());
    let warnings = shown(&program, &evaluated.diagnostics);
    assert!(warnings.contains("warning[not-read]: \"a.obj\": curves are not read"), "{warnings}");
}

#[test]
fn lists_make_a_mesh() {
    let points = "points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], faces = [[0, 1, 2, 3], [1, 0, 2]]";
    let plain = objects(&format!("triangles {{ {points} }}"));
    assert_eq!(mesh(&plain[0]).triangles(), [[0, 1, 2], [0, 2, 3], [1, 0, 2]]);
    assert_eq!(mesh(&plain[0]).positions()[2], [1.0, 1.0, 0.0]);
    let more = "normals = [up, up, up, up], uvs = [(0, 0), (1, 0), (1, 1), (0, 1)]";
    let full = objects(&format!("triangles {{ {points}, {more} }}"));
    assert_eq!((mesh(&full[0]).normals()[3], mesh(&full[0]).uvs()[2]), ([0.0, 1.0, 0.0], [1.0, 1.0]));
    assert!(!mesh(&objects(&format!("triangles {{ {points}, smooth = true }}"))[0]).normals().is_empty());
    assert!(
        mesh(&objects(&format!("triangles {{ {points}, {more}, smooth = false }}"))[0]).normals().is_empty()
    );
}

#[test]
fn what_makes_no_mesh_is_told() {
    let told = |objects: &str, expected: &str| {
        let errors = errors(&format!("scene = {{ objects = [{objects}] }}"));
        assert!(errors.contains(expected), "{errors}");
    };
    let triangles =
        |fields: &str| format!("triangles {{ points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)], {fields} }}");
    told(
        &triangles("faces = [[0, 1, 2], [0, 1, 3]]"),
        "corner 2 of face 1 is point 3, but there are 3 points, counted from 0",
    );
    told(&triangles("faces = [[0, 1, 0.5]]"), "corner 2 of face 0 is point 0.5");
    told(&triangles("faces = [[0, 1, 2], [0, 1]]"), "face 1 has 2 corners, and a face has three or more");
    told(&triangles("faces = [[0, 1, 2]], normals = [up]"), "there are 1 normals for 3 vertices");
    told(&triangles("faces = [0, 1, 2]"), "faces");
    told("triangles { points = [(0, 1e300, 0)], faces = [] }", "number 0 of `points`");
    told("mesh { file = \"none.xyz\" }", "there is no file \"none.xyz\" in the root folder");
    told("mesh { file = \"../a.ply\" }", "leads out of the root folder");
    told("mesh { file = \"a.stl\" }", "\"a.stl\" cannot be read: line 3: it is damaged");
    told("mesh { file = 3 }", "file");
    told("mesh {}", "file");
}

#[test]
fn a_mesh_is_a_part_of_solids_where_it_is_closed() {
    let tetrahedron = |faces: &str| {
        let points = "points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]";
        format!("difference (sphere {{}}) (group [cube {{}}, triangles {{ {points}, faces = [{faces}] }}])")
    };
    let whole = objects(&tetrahedron("[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]"));
    assert!(whole[0].leaves().any(|leaf| matches!(leaf.shape, Shape::Mesh(_))));
    let refused = |object: &str, expected: &str| {
        let errors = errors(&format!("scene = {{ objects = [{object}] }}"));
        assert!(errors.contains("cannot be part of a solid") && errors.contains(expected), "{errors}");
    };
    refused(&tetrahedron("[0, 2, 1], [0, 1, 3], [1, 2, 3]"), "3 of its edges are open");
    refused(&tetrahedron(""), "is empty");
    refused("union (translate up (mesh { file = \"a.ply\" })) (sphere {})", "of its edges are open");
}

#[test]
fn meshes_count_as_memory() {
    let text = "scene = { objects = [mesh { file = \"a.ply\" }] }";
    let limits = Limits { memory: 50, ..Limits::default() };
    assert!(errors_with(text, &limits).contains("too-much-memory"));
    let text = "scene = { objects = [triangles { points = [(0, 0, 0)], faces = [[0 | i <- [1 .. 1000]] | j <- [1 .. 1000]] }] }";
    let text = text.replace("[0 | i <- [1 .. 1000]]", "corners") + "\ncorners = [0 | i <- [1 .. 1000]]";
    let limits = Limits { memory: 2_000_000, ..Limits::default() };
    assert!(errors_with(&text, &limits).contains("too-much-memory"));
}
