//! The vocabulary of hray: what a scene is made of, as plain data.
//!
//! Nothing here does input or output, starts a thread, or traces a ray. The front ends of the language
//! build a [`Description`]; the renderer reads it. Names are the field's; the thesis' names live in
//! `hray-model`, and ARCHITECTURE.md has the glossary between the two.
//!
//! Conventions: lengths are in the scene's own unit, the y axis points up, and the classic camera looks
//! through a window in the plane z = 0. Everything is `f64`.

mod camera;
mod color;
mod description;
mod field;
mod implicit;
mod leaves;
mod light;
mod material;
mod mesh;
mod mesh_normals;
mod model;
mod round;
mod scene;
mod shape;
mod texture;

pub use camera::{Camera, OrthographicCamera, PerspectiveCamera, WindowCamera};
pub use color::Rgb;
pub use description::{
    Description, DescriptionError, Encoding, Integrator, MAX_DEPTH, MAX_PIXELS, MIN_DEPTH, Resolution,
};
pub use field::Field;
pub use glam::{DAffine3, DMat3, DVec2, DVec3};
pub use hray_expr::{Function, Image, NoiseTables, NoiseTablesError};
pub use implicit::Implicit;
pub use leaves::Leaves;
pub use light::Light;
pub use material::Material;
pub use mesh::{Mesh, MeshError};
pub use model::{Model, ModelFormat, ModelMaterial, ModelPart};
pub use round::{Disc, Frustum, Torus};
pub use scene::{Background, Primitive, Scene};
pub use shape::{Clip, Csg, CsgOperation, Cuboid, Plane, Quadric, Shape, Sphere};
pub use texture::{NoiseTexture, Texture};
