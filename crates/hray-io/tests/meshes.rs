//! Files of meshes: what is read of each format, and what is said of bad ones.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "tests may fail loudly")]

use hray_core::{Mesh, Model, Rgb};
use hray_io::{Folder, FolderError, decode_model, model_format, read_model};
use proptest::prelude::*;
use std::fs;
use std::path::Path;
use std::sync::Arc;

fn nothing(_: &str) -> Result<Vec<u8>, String> {
    Err("there is no such file".to_owned())
}

fn try_read(name: &str, bytes: &[u8]) -> Result<Model, String> {
    decode_model(bytes, Path::new(name), &nothing).map_err(|error| error.reason())
}

fn read(name: &str, bytes: &[u8]) -> Model {
    try_read(name, bytes).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn mesh(name: &str, bytes: &[u8]) -> Mesh {
    let model = read(name, bytes);
    assert_eq!(model.parts.len(), 1, "{name}");
    Mesh::clone(&model.parts[0].mesh)
}

fn error(name: &str, bytes: &[u8]) -> String {
    try_read(name, bytes).expect_err(name)
}

const PLY: &str = "ply\nformat ascii 1.0\ncomment a square and a triangle\nelement vertex 5\nproperty float x\n\
    property float y\nproperty float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n\
    property float s\nproperty float t\nelement face 2\nproperty uchar flags\n\
    property list uchar int vertex_indices\nelement camera 1\nproperty float fov\nend_header\n\
    0 0 0 255 0 0 0 0\n1 0 0 255 0 0 1 0\n1 1 0 255 0 0 1 1\n0 1 0 255 0 0 0 1\n0 0 1 0 0 255 .5 .5\n\
    7 4 0 1 2 3\n7 3 0 1 4\n40\n";

const STL: &str = "solid a name with solid in it\nfacet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n\
    vertex 0 1 0\n endloop\nendfacet\nfacet normal 0 0 1\n outer loop\n  vertex 1 0 0\n  vertex 1 1 0\n\
    vertex 0 1 -0\n endloop\nendfacet\nendsolid a name\n";

const OBJ: &str = "# a square of two materials\nmtllib a b.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nvt 0.25 0.5\n\
    o first\nusemtl red\nf 1/1/1 2/1/1 \\\n 3/1/1 4/1/1\nusemtl none\nf -4 -3 -2\nusemtl red\nf 1//1 2//1 3//1\n";

const MTL: &[u8] = b"newmtl red\nKd 0.5 0.25 0.125\nmap_Kd red.png\nd 0.75\n\nnewmtl other\nKe 1\n";

const GLTF: &str = r#"{ "asset": { "version": "2.0" }, "scene": 0, "scenes": [ { "nodes": [ 0, 2 ] } ],
  "nodes": [ { "name": "a", "mesh": 0, "translation": [1, 2, 3], "children": [ 1 ] },
             { "name": "b", "mesh": 0, "scale": [2, 2, 2] },
             { "mesh": 0, "rotation": [0, 0, 0.7071067811865476, 0.7071067811865476] } ],
  "meshes": [ { "name": "m", "primitives": [
    { "attributes": { "POSITION": 0, "TEXCOORD_0": 2 }, "indices": 1, "material": 0 } ] } ],
  "materials": [ { "name": "gold", "pbrMetallicRoughness": { "baseColorFactor": [1, 0.5, 0.25, 1] } } ],
  "accessors": [ { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3" },
                 { "bufferView": 1, "componentType": 5121, "count": 3, "type": "SCALAR" },
                 { "bufferView": 2, "componentType": 5121, "normalized": true, "count": 4, "type": "VEC2" } ],
  "bufferViews": [ { "buffer": 0, "byteLength": 48 }, { "buffer": 0, "byteOffset": 48, "byteLength": 3 },
                   { "buffer": 0, "byteOffset": 52, "byteLength": 14, "byteStride": 4 } ],
  "buffers": [ { BUFFER "byteLength": 66 } ] }"#;

fn buffer() -> Vec<u8> {
    let points: [[f32; 3]; 4] = [[0.0; 3], [9.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let mut bytes: Vec<u8> = points.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect();
    bytes.extend([0, 2, 3, 0]);
    bytes.extend([0, 0, 0, 0, 9, 9, 0, 0, 255, 255, 0, 0, 51, 0]);
    bytes
}

fn glb(json: &str, binary: &[u8]) -> Vec<u8> {
    let mut json = json.as_bytes().to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    let length = (12 + 8 + json.len() + 8 + binary.len()) as u32;
    let mut bytes = b"glTF\x02\0\0\0".to_vec();
    bytes.extend(length.to_le_bytes());
    bytes.extend((json.len() as u32).to_le_bytes());
    bytes.extend(b"JSON");
    bytes.extend(json);
    bytes.extend((binary.len() as u32).to_le_bytes());
    bytes.extend(b"BIN\0");
    bytes.extend(binary);
    bytes
}

fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let groups = bytes.chunks(3).map(|three| {
        let bits =
            three.iter().fold(0u32, |bits, byte| bits << 8 | u32::from(*byte)) << (8 * (3 - three.len()));
        let digits = (0..4).map(|place| DIGITS[(bits >> (18 - 6 * place)) as usize & 63] as char);
        digits
            .enumerate()
            .map(|(place, digit)| if place <= three.len() { digit } else { '=' })
            .collect::<String>()
    });
    groups.collect()
}

#[test]
fn a_ply_file_in_text_is_read() {
    let mesh = mesh("a.ply", PLY.as_bytes());
    assert_eq!(mesh.triangles(), [[0, 1, 2], [0, 2, 3], [0, 1, 4]]);
    assert_eq!((mesh.positions()[4], mesh.uvs()[2]), ([0.0, 0.0, 1.0], [1.0, 1.0]));
    assert_eq!((mesh.colors()[4], mesh.normals().len()), ([0.0, 0.0, 1.0], 0));
}

#[test]
fn an_stl_file_in_text_is_read_and_corners_in_one_place_are_one_vertex() {
    for name in ["a.stl", "A.STL"] {
        let mesh = mesh(name, STL.as_bytes());
        assert_eq!(mesh.triangles(), [[0, 1, 2], [1, 3, 2]]);
        assert_eq!((mesh.positions().len(), mesh.normals().len()), (4, 0));
    }
}

#[test]
fn an_obj_file_is_read_by_its_materials() {
    let files = |name: &str| if name == "a b.mtl" { Ok(MTL.to_vec()) } else { Err(name.to_owned()) };
    let model = decode_model(OBJ.as_bytes(), Path::new("a.obj"), &files).unwrap();
    let [red, none] = &model.parts[..] else { panic!("{model:?}") };
    assert_eq!(red.mesh.triangles(), [[0, 1, 2], [0, 2, 3], [4, 5, 6]]);
    // One corner lacks texture coordinates, so all do.
    assert_eq!((red.mesh.normals().len(), red.mesh.uvs().len()), (7, 0));
    let material = red.material.as_ref().unwrap();
    assert_eq!((material.base_color, material.opacity), (Rgb::new(0.5, 0.25, 0.125), 0.75));
    assert_eq!((&red.name[..], none.mesh.triangles().len(), none.material.is_none()), ("first", 1, true));
    assert_eq!(model.notes, ["the images that materials name are not read"]);
    let alone = read("a.obj", OBJ.as_bytes());
    assert_eq!(alone.notes[0], "the materials in \"a\" are not read: there is no such file");
}

#[test]
fn a_gltf_file_is_read_with_its_nodes_and_its_buffers_wherever_they_are() {
    let files = |name: &str| if name == "my data.bin" { Ok(buffer()) } else { Err("not there".to_owned()) };
    let inside = format!(r#""uri": "data:application/octet-stream;base64,{}", "#, base64(&buffer()));
    for (bytes, name) in [
        (GLTF.replace("BUFFER", r#""uri": "my%20data.bin", "#).into_bytes(), "a.gltf"),
        (GLTF.replace("BUFFER", &inside).into_bytes(), "a.gltf"),
        (glb(&GLTF.replace("BUFFER", ""), &buffer()), "a.glb"),
    ] {
        let model = decode_model(&bytes, Path::new(name), &files).unwrap();
        let names: Vec<&str> = model.parts.iter().map(|part| &part.name[..]).collect();
        assert_eq!(names, ["a", "b", "m"]);
        let mesh = &model.parts[0].mesh;
        // The vertex that nothing uses is left out.
        assert_eq!((mesh.positions().len(), mesh.triangles()), (3, &[[0, 1, 2]][..]));
        assert_eq!(mesh.uvs(), [[0.0, 1.0], [1.0, 0.0], [0.2, 1.0]]);
        assert!(model.parts.iter().all(|part| Arc::ptr_eq(&part.mesh, mesh)));
        let material = model.parts[2].material.as_ref().unwrap();
        assert_eq!((&material.name[..], material.base_color), ("gold", Rgb::new(1.0, 0.5, 0.25)));
        let at = |part: usize| model.parts[part].transform.unwrap().transform_point3([1.0, 0.0, 0.0].into());
        assert_eq!((at(0).to_array(), at(1).to_array()), ([2.0, 2.0, 3.0], [3.0, 2.0, 3.0]));
        assert!((at(2) - hray_core::DVec3::Y).length() < 1e-15);
    }
    let missing = error("a.gltf", GLTF.replace("BUFFER", r#""uri": "x.bin", "#).as_bytes());
    assert_eq!(missing, "buffers[0]: cannot read \"x.bin\": there is no such file");
}

#[test]
fn what_a_model_names_is_read_from_its_folder_and_nowhere_else() {
    let folder = tempfile::tempdir().unwrap();
    let inner = folder.path().join("models");
    fs::create_dir(&inner).unwrap();
    fs::write(inner.join("a.obj"), OBJ.replace("a b.mtl", "../a.mtl")).unwrap();
    fs::write(folder.path().join("a.mtl"), MTL).unwrap();
    let wide = Folder::open(folder.path()).unwrap();
    assert!(wide.model("models/a.obj").unwrap().parts[0].material.is_some());
    let narrow = Folder::open(&inner).unwrap().model("a.obj").unwrap();
    assert!(narrow.parts[0].material.is_none());
    assert_eq!(narrow.notes, ["the materials in \"../a.mtl\" are not read: it lies outside the root folder"]);
    assert!(
        read_model(&inner.join("a.obj")).unwrap().notes[0]
            .ends_with("it does not lie in the folder of the model")
    );
    assert!(matches!(wide.model("a.ply"), Err(FolderError::Missing)));
    assert_eq!(model_format(Path::new("x/a.GLB")).map(|format| format.name()), Some("glTF"));
    assert_eq!(
        error("a.txt", b"hello"),
        "it is no model; known are ply, stl, obj, gltf and glb, by their extensions"
    );
}

#[test]
fn bad_files_are_told_where_they_are_bad() {
    let ply = |from: &str, to: &str| error("a.ply", PLY.replacen(from, to, 1).as_bytes());
    assert_eq!(
        ply("3 0 1 4", "3 0 1 5"),
        "line 25: of this face, it names vertex 5, but there are 5 vertices, counted from 0"
    );
    assert_eq!(
        ply("1 0 0 255", "1 NaN 0 255"),
        "line 20: the y of a vertex is \"NaN\", and must be a finite number"
    );
    assert_eq!(ply("1 0 0 255", "1 0 0z 255"), "line 20: the z of a vertex must be a number, and is \"0z\"");
    assert_eq!(
        ply("vertex 5", "vertex 999999999999"),
        "line 19: the header says that 999999999999 of `vertex` follow, but the file has only 117 bytes more"
    );
    assert!(ply("vertex 5", "vertex 6").starts_with("line 27: "), "{}", ply("vertex 5", "vertex 6"));
    assert_eq!(
        ply("float x", "half x"),
        "line 5: the kinds of number are char, uchar, short, ushort, int, uint, float and double, and not \"half\""
    );
    assert_eq!(ply("float z", "float w"), "line 19: the vertices have no properties x, y and z");
    assert_eq!(
        ply("ascii", "binary"),
        "line 2: the format is `ascii`, `binary_little_endian` or `binary_big_endian`, and not \"binary\""
    );
    let stl = |from: &str, to: &str| error("a.stl", STL.replacen(from, to, 1).as_bytes());
    assert_eq!(stl("vertex 1 0 0", "vertex 1 inf 0"), "line 5: y is \"inf\", and must be a finite number");
    assert_eq!(stl("endfacet", "endfact"), "line 8: `endfacet` should be here, and this is \"endfact\"");
    let obj = |line: &str| error("a.obj", format!("v 0 0 0\nv 1 0 0\nv 0 1 0\n{line}\n").as_bytes());
    assert_eq!(obj("f 1 2 4"), "line 4: the face names vertex 4, but there are 1 to 3 so far");
    assert_eq!(obj("f 1 2 0"), "line 4: the face names vertex 0, but there are 1 to 3 so far");
    assert_eq!(obj("f 1/1 2 3"), "line 4: the face names texture coordinate 1, but there is none so far");
    assert_eq!(obj("f 1 2 x"), "line 4: an index must be a whole number, and is \"x\"");
    assert_eq!(obj("v 1 nan 0"), "line 4: a coordinate is \"nan\", and must be a finite number");
    assert_eq!(obj("v 1 0"), "line 4: a vertex has three coordinates, and this has 2");
    let gltf = |from: &str, to: &str| {
        error("a.glb", &glb(&GLTF.replace("BUFFER", "").replacen(from, to, 1), &buffer()))
    };
    assert_eq!(
        gltf("\"mesh\": 0", "\"mesh\": 7"),
        "nodes[0]: it names mesh 7, but there are 1, counted from 0"
    );
    assert_eq!(gltf("[ 1 ]", "[ 0 ]"), "nodes[0]: it is the child of more than one node, or of itself");
    assert_eq!(
        gltf("\"count\": 4", "\"count\": 5000000000"),
        "accessors[0]: 5000000000 elements, 12 bytes apart, from byte 0 on do not fit into bufferViews[0], which has 48 bytes"
    );
    assert_eq!(
        gltf("\"count\": 4", "\"count\": 3"),
        "meshes[0].primitives[0]: index 2 of accessors[1] is 3, but there are 3 vertices"
    );
    assert_eq!(
        gltf("\"2.0\"", "\"1.0\""),
        "asset: the version of the file is \"1.0\", and \"2.0\" is what is read"
    );
    let draco = gltf("{", "{ \"extensionsRequired\": [\"KHR_draco_mesh_compression\"],");
    assert!(draco.contains("KHR_draco_mesh_compression"), "{draco}");
    assert!(error("a.gltf", b"{\n \"asset\": 3 }").starts_with("line 2: "));
}

/// Wherever a file ends, it is read or refused, with a place.
#[test]
fn files_that_are_cut_short_are_refused() {
    let binary_ply = Writer { kind: "binary_little_endian", index: "int" }.ply(&sample());
    let files = [
        ("a.ply", PLY.as_bytes().to_vec()),
        ("b.ply", binary_ply),
        ("a.stl", STL.as_bytes().to_vec()),
        ("b.stl", binary_stl(&sample())),
        ("a.obj", OBJ.as_bytes().to_vec()),
        ("a.gltf", GLTF.replace("BUFFER", "").into_bytes()),
        ("a.glb", glb(&GLTF.replace("BUFFER", ""), &buffer())),
    ];
    for (name, bytes) in files {
        let mut accepted = 0;
        for length in 0..bytes.len() {
            match try_read(name, &bytes[..length]) {
                Ok(_) => accepted += 1,
                Err(reason) => {
                    assert!(reason.contains("line ") || reason.contains("byte "), "{name} {length}: {reason}")
                }
            }
        }
        // In text the last number or word may be cut unseen; an OBJ file may end anywhere, and one without words is empty.
        let most = match name {
            "a.obj" => bytes.len(),
            "a.ply" => 3,
            "a.stl" => 8,
            _ => 0,
        };
        assert!(accepted <= most, "{name}: {accepted}");
        // Any byte may be another.
        for place in 0..bytes.len() {
            for flip in [0x01, 0x80, 0xff] {
                let mut damaged = bytes.clone();
                damaged[place] ^= flip;
                let _ = try_read(name, &damaged);
            }
        }
    }
}

#[test]
fn empty_and_odd_files_are_read() {
    assert_eq!(mesh("a.stl", b"solid\nendsolid\n"), Mesh::default());
    assert_eq!(read("a.obj", b"# nothing\n").parts.len(), 0);
    let points = b"ply\nformat ascii 1.0\nelement vertex 1\nproperty double x\nproperty double y\nproperty double z\nend_header\n1 2 3\n";
    assert_eq!((mesh("a.ply", points).positions().len(), mesh("a.ply", points).triangles().len()), (1, 0));
    // Faces of two corners are edges, and left out.
    let edge = mesh("a.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\nf 1 1 1\n");
    assert_eq!(edge.triangles(), [[0, 0, 0]]);
    // Without indices, and a strip.
    let json = GLTF.replace("BUFFER", "").replace("\"indices\": 1,", "\"mode\": 5,");
    assert_eq!(read("a.glb", &glb(&json, &buffer())).parts[0].mesh.triangles(), [[0, 1, 2], [2, 1, 3]]);
    let strips = b"ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
        element tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0 1 0 0 0 1 0 1 1 0\n8 0 1 2 3 -1 0 1 3\n";
    assert_eq!(mesh("a.ply", strips).triangles(), [[0, 1, 2], [2, 1, 3], [0, 1, 3]]);
}

#[test]
fn the_fuzz_corpus_is_read_or_refused() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus/mesh");
    let mut read = [0, 0];
    for entry in fs::read_dir(folder).unwrap() {
        let bytes = fs::read(entry.unwrap().path()).unwrap();
        let Some((first, rest)) = bytes.split_first() else { continue };
        let names = ["a.ply", "a.stl", "a.obj", "a.gltf", "a.glb"];
        let files = |_: &str| Ok(rest.to_vec());
        match decode_model(rest, Path::new(names[usize::from(*first) % names.len()]), &files) {
            Ok(model) => {
                read[0] += 1;
                for part in &model.parts {
                    let smooth = part.mesh.smoothed(0.75);
                    assert_eq!(smooth.triangles().len(), part.mesh.triangles().len());
                }
            }
            Err(error) => {
                read[1] += 1;
                assert!(!error.reason().is_empty());
            }
        }
    }
    assert!(read[0] >= 9 && read[1] >= 5, "{read:?}");
}

fn sample() -> Mesh {
    let points = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.5]];
    Mesh::new(points, vec![[0, 1, 2], [0, 2, 3]]).unwrap()
}

struct Writer {
    kind: &'static str,
    index: &'static str,
}

impl Writer {
    fn ply(&self, mesh: &Mesh) -> Vec<u8> {
        let Self { kind, index } = self;
        let has_normals = !mesh.normals().is_empty();
        let normals =
            if has_normals { "property float nx\nproperty float ny\nproperty float nz\n" } else { "" };
        let mut bytes = format!(
            "ply\nformat {kind} 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n{normals}\
             element face {}\nproperty list uchar {index} vertex_index\nend_header\n",
            mesh.positions().len(),
            mesh.triangles().len()
        )
        .into_bytes();
        let is_text = *kind == "ascii";
        let is_big = kind.ends_with("big_endian");
        let put = |bytes: &mut Vec<u8>, text: String, mut little: Vec<u8>| {
            if is_text {
                bytes.extend(text.bytes().chain([b' ']));
            } else {
                if is_big {
                    little.reverse();
                }
                bytes.extend(little);
            }
        };
        for (vertex, position) in mesh.positions().iter().enumerate() {
            for x in position.iter().chain(mesh.normals().get(vertex).into_iter().flatten()) {
                put(&mut bytes, x.to_string(), x.to_le_bytes().to_vec());
            }
        }
        for triangle in mesh.triangles() {
            put(&mut bytes, "3".to_owned(), vec![3]);
            for corner in triangle {
                let little = match *index {
                    "ushort" => (*corner as u16).to_le_bytes().to_vec(),
                    _ => corner.to_le_bytes().to_vec(),
                };
                put(&mut bytes, corner.to_string(), little);
            }
        }
        bytes
    }
}

fn corners(mesh: &Mesh) -> Vec<[[f32; 3]; 3]> {
    mesh.triangles().iter().map(|corners| corners.map(|corner| mesh.positions()[corner as usize])).collect()
}

fn binary_stl(mesh: &Mesh) -> Vec<u8> {
    let mut bytes = vec![b's'; 80];
    bytes.extend((mesh.triangles().len() as u32).to_le_bytes());
    for triangle in corners(mesh) {
        bytes.extend([0; 12]);
        bytes.extend(triangle.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

fn text_stl(mesh: &Mesh) -> Vec<u8> {
    let mut text = "solid\n".to_owned();
    for triangle in corners(mesh) {
        let vertices: String = triangle.iter().map(|[x, y, z]| format!("vertex {x} {y} {z}\n")).collect();
        text += &format!("facet normal 0 0 0\nouter loop\n{vertices}endloop\nendfacet\n");
    }
    (text + "endsolid\n").into_bytes()
}

fn meshes() -> impl Strategy<Value = Mesh> {
    let number =
        || prop_oneof![-1e3f32..1e3, Just(0.0f32), any::<f32>().prop_filter("finite", |x| x.is_finite())];
    let vector = move || [number(), number(), number()];
    (prop::collection::vec((vector(), vector()), 1..20), any::<bool>())
        .prop_flat_map(|(vertices, has_normals)| {
            let count = vertices.len() as u32;
            let triangles = prop::collection::vec([0..count, 0..count, 0..count], 0..30);
            (Just(vertices), triangles, Just(has_normals))
        })
        .prop_map(|(vertices, triangles, has_normals)| {
            let (positions, normals): (Vec<_>, Vec<_>) = vertices.into_iter().unzip();
            let mesh = Mesh::new(positions, triangles).unwrap();
            mesh.with_normals(if has_normals { normals } else { Vec::new() }).unwrap()
        })
}

proptest! {
    #[test]
    fn what_is_written_is_read(written in meshes()) {
        for kind in ["ascii", "binary_little_endian", "binary_big_endian"] {
            for index in ["int", "uint", "ushort"] {
                let bytes = Writer { kind, index }.ply(&written);
                prop_assert_eq!(&mesh("a.ply", &bytes), &written);
            }
        }
        for bytes in [binary_stl(&written), text_stl(&written)] {
            prop_assert_eq!(corners(&mesh("a.stl", &bytes)), corners(&written));
        }
    }

    #[test]
    fn any_bytes_are_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        for (name, start) in [("a.ply", &b"ply\nformat ascii 1.0\n"[..]), ("a.stl", b"solid"), ("a.obj", b"f "), ("a.gltf", b"{"), ("a.glb", b"glTF")] {
            let _ = try_read(name, &bytes);
            let _ = try_read(name, &[start, &bytes].concat());
        }
    }
}
