//! The constructors: what makes the kinds of values that a scene consists of.

use super::fields::{FieldSpec, FieldType as T, Range};

/// A function from a record with named, defaulted, range-checked fields to a scene's own kind of value.
#[derive(Debug)]
pub struct Constructor {
    /// Its name.
    pub name: &'static str,
    /// What it makes.
    pub makes: Makes,
    /// What that is, in one or two sentences.
    pub doc: &'static str,
    /// A small example.
    pub example: &'static str,
    /// Its fields.
    pub fields: &'static [FieldSpec],
}

/// What a constructor makes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Makes {
    /// A shape.
    Shape,
    /// A material.
    Material,
    /// A light.
    Light,
    /// A camera.
    Camera,
    /// The scene itself. It is not called by name: `scene = { ... }` is such a record.
    Scene,
}

impl Constructor {
    /// The field of that name.
    #[must_use]
    pub fn field(&self, name: &str) -> Option<(usize, &'static FieldSpec)> {
        self.fields.iter().enumerate().find(|(_, field)| field.name == name)
    }
}

const fn required(name: &'static str, kind: T, doc: &'static str) -> FieldSpec {
    FieldSpec::required(name, kind, doc)
}

const fn with_default(name: &'static str, kind: T, default: &'static str, doc: &'static str) -> FieldSpec {
    FieldSpec::with_default(name, kind, default, doc)
}

const MATERIAL: FieldSpec = with_default(
    "material",
    T::Material,
    "",
    "What it is made of. Where it is left out, `paint` gives one; where nothing does, it is matte white.",
);
const OPEN: FieldSpec = with_default(
    "open",
    T::Bool,
    "",
    "`true` leaves the discs at both ends away; what is open has no inside, so it cannot be a part of solids.",
);
const UNITS: &str = "scene units";

/// All constructors, in the order of the reference.
pub const CONSTRUCTORS: &[Constructor] = &[
    Constructor {
        name: "scene",
        makes: Makes::Scene,
        doc: "What is rendered: the definition `scene` of the file, a record with these fields or a function from \
              the time in seconds to one.",
        example: "scene = { objects = [ sphere {} ], lights = [ point { position = (3, 4, 5) } ] }",
        fields: &[
            with_default("size", T::Vec2, "(800, 600)", "Width and height of the picture.")
                .range(Range::Whole(1.0, 1_073_741_824.0))
                .unit("pixels"),
            with_default("depth", T::Number, "5", "How often a ray may be reflected or refracted.")
                .range(Range::Whole(-1.0, 10_000.0)),
            with_default("samples", T::Number, "16", "Samples a pixel. More give smoother edges; 1 gives none.")
                .range(Range::Whole(1.0, 65_536.0)),
            with_default(
                "integrator",
                T::Integrator,
                "whitted",
                "How light is followed: `whitted`, or `classic2005` for the pictures of 2005 to the bit.",
            ),
            with_default(
                "encoding",
                T::Encoding,
                "srgb",
                "How colours are written: `srgb` encodes linear light as displays expect it, `raw` passes the \
                 numbers through as in 2005.",
            ),
            with_default(
                "camera",
                T::Camera,
                "perspective { from = (0, 1, 6), to = (0, 0.5, 0) }",
                "Where the picture is taken from.",
            ),
            with_default(
                "background",
                T::Background,
                "black",
                "What a ray sees that hits nothing: a colour, or a function from the direction one looks in (a \
                 unit vector) to a colour.",
            ),
            with_default("lights", T::Lights, "[]", "What shines."),
            with_default(
                "objects",
                T::Shapes,
                "[]",
                "What can be seen. Of two surfaces in the same place, the one written last is seen.",
            ),
        ],
    },
    Constructor {
        name: "sphere",
        makes: Makes::Shape,
        doc: "All points at one distance from a centre.",
        example: "sphere { radius = 0.5, center = (0, 0.5, 0) }",
        fields: &[
            with_default("radius", T::Number, "1", "Distance from the centre to the surface.")
                .range(Range::Radius)
                .unit(UNITS),
            with_default("center", T::Vec3, "(0, 0, 0)", "The centre.").unit(UNITS),
            MATERIAL,
        ],
    },
    Constructor {
        name: "plane",
        makes: Makes::Shape,
        doc: "An infinite flat surface: the points p with dot normal p = offset. Its inside, for CSG, is the side \
              that the normal leads away from.",
        example: "plane { normal = up, offset = -1 }",
        fields: &[
            with_default("normal", T::Vec3, "(0, 1, 0)", "A direction at right angles to it, of any length.")
                .range(Range::Normal),
            with_default(
                "offset",
                T::Number,
                "0",
                "How far it lies from the origin, along the normal and in units of the normal's length: with \
                 `normal = up`, its height.",
            )
            .unit(UNITS),
            MATERIAL,
        ],
    },
    Constructor {
        name: "cube",
        makes: Makes::Shape,
        doc: "A cube with sides along the axes.",
        example: "cube { size = 2 }",
        fields: &[
            with_default("size", T::Number, "1", "Length of a side.").range(Range::Positive).unit(UNITS),
            with_default("center", T::Vec3, "(0, 0, 0)", "The centre.").unit(UNITS),
            MATERIAL,
        ],
    },
    Constructor {
        name: "box",
        makes: Makes::Shape,
        doc: "A box with sides along the axes.",
        example: "box { size = (2, 1, 3), center = (0, 0.5, 0) }",
        fields: &[
            with_default("size", T::Vec3, "(1, 1, 1)", "Lengths of the sides along x, y and z.")
                .range(Range::Positives)
                .unit(UNITS),
            with_default("center", T::Vec3, "(0, 0, 0)", "The centre.").unit(UNITS),
            MATERIAL,
        ],
    },
    Constructor {
        name: "cylinder",
        makes: Makes::Shape,
        doc: "A round rod between two points.",
        example: "cylinder { from = (0, 0, 0), to = (0, 2, 0), radius = 0.5 }",
        fields: &[
            with_default("from", T::Vec3, "(0, 0, 0)", "The middle of one end.").unit(UNITS),
            with_default("to", T::Vec3, "(0, 1, 0)", "The middle of the other end, another point.").unit(UNITS),
            with_default("radius", T::Number, "1", "Distance from the axis to the side.")
                .range(Range::Positive)
                .unit(UNITS),
            OPEN,
            MATERIAL,
        ],
    },
    Constructor {
        name: "cone",
        makes: Makes::Shape,
        doc: "A cone from a round base to a tip, or to a smaller or larger circle.",
        example: "cone { from = (0, 0, 0), to = (0, 1.5, 0), radius = 0.5 }",
        fields: &[
            with_default("from", T::Vec3, "(0, 0, 0)", "The middle of the base.").unit(UNITS),
            with_default("to", T::Vec3, "(0, 1, 0)", "The tip, or the middle of the top; another point.").unit(UNITS),
            with_default("radius", T::Number, "1", "Radius at the base.").range(Range::Positive).unit(UNITS),
            with_default("top", T::Number, "0", "Radius at the top; 0 gives a tip.")
                .range(Range::NonNegative)
                .unit(UNITS),
            OPEN,
            MATERIAL,
        ],
    },
    Constructor {
        name: "disc",
        makes: Makes::Shape,
        doc: "A flat disc, or a ring where it has a hole. It is infinitely thin and has no inside, so it cannot be a part \
              of solids.",
        example: "disc { center = (0, 1, 0), normal = up, radius = 2, hole = 1 }",
        fields: &[
            with_default("center", T::Vec3, "(0, 0, 0)", "The centre.").unit(UNITS),
            with_default("normal", T::Vec3, "(0, 1, 0)", "A direction at right angles to it, of any length.")
                .range(Range::Direction),
            with_default("radius", T::Number, "1", "Distance from the centre to the rim.")
                .range(Range::Positive)
                .unit(UNITS),
            with_default("hole", T::Number, "0", "Radius of the hole; less than `radius`.")
                .range(Range::NonNegative)
                .unit(UNITS),
            MATERIAL,
        ],
    },
    Constructor {
        name: "torus",
        makes: Makes::Shape,
        doc: "A ring: everything at one distance from a circle.",
        example: "torus { radius = 1, tube = 0.25 }",
        fields: &[
            with_default("radius", T::Number, "1", "Radius of the circle in the middle of the ring.")
                .range(Range::Positive)
                .unit(UNITS),
            with_default("tube", T::Number, "0.25", "Half the thickness of the ring; less than `radius`.")
                .range(Range::Positive)
                .unit(UNITS),
            with_default("center", T::Vec3, "(0, 0, 0)", "The centre.").unit(UNITS),
            with_default("axis", T::Vec3, "(0, 1, 0)", "The direction that the hole leads along, of any length.")
                .range(Range::Direction),
            MATERIAL,
        ],
    },
    Constructor {
        name: "quadric",
        makes: Makes::Shape,
        doc: "All points where a polynomial of the second degree is 0: cones, paraboloids, hyperboloids, saddles and more, \
              without end unless something cuts them off. Inside is where the polynomial is negative.",
        example: "quadric { square = (1, 0, 1), linear = (0, -1, 0) }",
        fields: &[
            with_default("square", T::Vec3, "(0, 0, 0)", "What x^2, y^2 and z^2 are multiplied by."),
            with_default("product", T::Vec3, "(0, 0, 0)", "What x y, x z and y z are multiplied by."),
            with_default("linear", T::Vec3, "(0, 0, 0)", "What x, y and z are multiplied by."),
            with_default("constant", T::Number, "0", "What is added to all that."),
            MATERIAL,
        ],
    },
    Constructor {
        name: "implicit",
        makes: Makes::Shape,
        doc: "All points where a function of the point is 0. Inside is where it is less than 0. Any function will do, also one \
              with noise, `min`, `max` and `if`; no bound of its slope has to be known.",
        example: "implicit { function = \\p -> length p - 1 + 0.2 * noise (4 * p) }",
        fields: &[
            required("function", T::Space, "From a point to a number, such as the distance from a surface."),
            with_default(
                "size",
                T::Vec3,
                "",
                "Lengths of the sides of a box along x, y and z. What is inside beyond the box is cut off. Where it is left out, \
                 the surface must have an end, and the box is found.",
            )
            .range(Range::Positives)
            .unit(UNITS),
            with_default(
                "center",
                T::Vec3,
                "(0, 0, 0)",
                "The middle of that box; where `size` is left out, the surface is looked for around it.",
            )
            .unit(UNITS),
            MATERIAL,
        ],
    },
    Constructor {
        name: "mesh",
        makes: Makes::Shape,
        doc: "The triangles in a file: PLY, STL, OBJ, glTF 2.0 or GLB. A file of several parts gives all of them, each in \
              its place, with its own colour where the file says one.",
        example: "mesh { file = \"bunny.ply\", smooth = true }",
        fields: &[
            required("file", T::Text, "The file, written as for `image`: with slashes, from the folder of the scene."),
            with_default(
                "smooth",
                T::Bool,
                "",
                "`true` makes a surface without normals look round, except at edges sharper than 40deg; `false` leaves \
                 normals out, so that every triangle is flat. Where it is left out, the file decides.",
            ),
            with_default(
                "material",
                T::Material,
                "",
                "What it is made of, whatever the file says. Where it is left out, the file's colours are used, and where it \
                 has none, `paint` gives a material.",
            ),
        ],
    },
    Constructor {
        name: "triangles",
        makes: Makes::Shape,
        doc: "A surface of flat faces between points. Seen from outside, the corners of a face go round counterclockwise. \
              Faces of more than three corners are cut into triangles around their first corner.",
        example: "triangles { points = [(-1, 0, 0), (1, 0, 0), (1, 1, 0), (-1, 1, 0)], faces = [[0, 1, 2, 3]] }",
        fields: &[
            required("points", T::Points, "The points, kept in single precision.").unit(UNITS),
            required(
                "faces",
                T::Faces,
                "For each face the numbers of its corners, three or more, by their places in `points`, counted from 0.",
            ),
            with_default(
                "normals",
                T::Points,
                "",
                "For each point a direction at right angles to the surface, of any length; between points they are \
                 blended, so that the surface looks round.",
            ),
            with_default("uvs", T::Pairs, "", "For each point the `uv` that a function of the hit sees there."),
            with_default(
                "smooth",
                T::Bool,
                "",
                "`true` works normals out where none are given; edges sharper than 40deg stay sharp.",
            ),
            MATERIAL,
        ],
    },
    Constructor {
        name: "classic",
        makes: Makes::Material,
        doc: "The material of 2005: a matte colour, a mirror, a highlight and glass, in any mixture. Every field may \
              vary over the surface.",
        example: "classic { color = gold, reflection = 0.4, shine = 60 }",
        fields: &[
            with_default("color", T::Color, "white", "The colour under a white light.").varying(),
            with_default("reflection", T::Number, "0", "Share of mirrored light; 1 is a perfect mirror.")
                .varying()
                .range(Range::Share)
                .unit("share"),
            with_default(
                "shine",
                T::Number,
                "40",
                "Exponent of the highlight: 10 is broad and dull, 200 small and sharp.",
            )
            .varying(),
            with_default(
                "highlight",
                T::Number,
                "",
                "Strength of the highlight; that of `reflection` where it is left out.",
            )
            .varying()
            .range(Range::Share)
            .unit("share"),
            with_default("transparency", T::Number, "0", "Share of light let through; 1 is clear glass.")
                .varying()
                .range(Range::Share)
                .unit("share"),
            with_default(
                "ior",
                T::Number,
                "1.5",
                "Index of refraction of the inside: 1 does not bend light, water 1.33, glass 1.5, diamond 2.42. Used \
                 only where something is transparent.",
            )
            .varying(),
            with_default("glow", T::Color, "", "Light it gives off by itself; none where it is left out.").varying(),
            with_default(
                "bump",
                T::Height,
                "",
                "Bumps: how high the surface stands above the shape, as a function of the hit, in object-space \
                 units. It tilts the surface's normal; the outline stays.",
            ),
        ],
    },
    Constructor {
        name: "point",
        makes: Makes::Light,
        doc: "A light that shines from one point in all directions, equally strong at any distance.",
        example: "point { position = (4, 6, 3), intensity = 0.8 }",
        fields: &[
            required("position", T::Vec3, "Where it is.").unit(UNITS),
            with_default("intensity", T::Color, "1", "How strong it is: a number, or a colour.").range(Range::Light),
        ],
    },
    Constructor {
        name: "ambient",
        makes: Makes::Light,
        doc: "Light from everywhere, which reaches even what lies in shadow.",
        example: "ambient { intensity = 0.1 }",
        fields: &[
            with_default("intensity", T::Color, "0.1", "How strong it is: a number, or a colour.")
                .range(Range::Light),
        ],
    },
    Constructor {
        name: "directional",
        makes: Makes::Light,
        doc: "A light from infinitely far away, such as the sun.",
        example: "directional { direction = (-1, -3, -1), intensity = 0.7 }",
        fields: &[
            required("direction", T::Vec3, "The direction in which its light travels, of any length.")
                .range(Range::Direction),
            with_default("intensity", T::Color, "1", "How strong it is: a number, or a colour.").range(Range::Light),
        ],
    },
    Constructor {
        name: "spotlight",
        makes: Makes::Light,
        doc: "A light that shines from one point into a cone.",
        example: "spotlight { position = (0, 5, 0), target = (0, 0, 0), angle = 40deg }",
        fields: &[
            required("position", T::Vec3, "Where it is.").unit(UNITS),
            required("target", T::Vec3, "A point on the axis of the cone: what it shines at.").unit(UNITS),
            with_default("angle", T::Number, "40deg", "Angle across the whole cone.")
                .range(Range::Between(0.0, std::f64::consts::PI))
                .unit("radians"),
            with_default(
                "softness",
                T::Number,
                "0.2",
                "Share of the cone, from the rim inwards, over which the light falls off.",
            )
            .range(Range::Share)
            .unit("share"),
            with_default("intensity", T::Color, "1", "How strong it is: a number, or a colour.").range(Range::Light),
        ],
    },
    Constructor {
        name: "perspective",
        makes: Makes::Camera,
        doc: "A camera that sees as an eye does: far things are smaller.",
        example: "perspective { from = (0, 3, 7), to = (0, 0.5, 0), fov = 35deg }",
        fields: &[
            required("from", T::Vec3, "Where it is.").unit(UNITS),
            with_default("to", T::Vec3, "(0, 0, 0)", "What is in the middle of the picture.").unit(UNITS),
            with_default("up", T::Vec3, "(0, 1, 0)", "A direction that points up in the picture.")
                .range(Range::Direction),
            with_default("fov", T::Number, "40deg", "Angle from the lower to the upper edge of the picture.")
                .range(Range::Between(0.0, std::f64::consts::PI))
                .unit("radians"),
        ],
    },
    Constructor {
        name: "orthographic",
        makes: Makes::Camera,
        doc: "A camera of parallel rays: far things are as large as near ones.",
        example: "orthographic { from = (4, 4, 4), height = 3 }",
        fields: &[
            required(
                "from",
                T::Vec3,
                "Where it is. What lies behind the plane through it, at right angles to the line of sight, is not \
                 seen.",
            )
            .unit(UNITS),
            with_default("to", T::Vec3, "(0, 0, 0)", "What is in the middle of the picture.").unit(UNITS),
            with_default("up", T::Vec3, "(0, 1, 0)", "A direction that points up in the picture.")
                .range(Range::Direction),
            with_default("height", T::Number, "4", "What the picture shows from its lower to its upper edge.")
                .range(Range::Positive)
                .unit(UNITS),
        ],
    },
    Constructor {
        name: "window",
        makes: Makes::Camera,
        doc: "The camera of 2005: rays start on a window in the plane z = 0, centred on the origin, and lead away from \
              the eye, so only what lies beyond the window is seen.",
        example: "window { eye = (0, 0, 150), size = (100, 75) }",
        fields: &[
            required("eye", T::Vec3, "The eye.").unit(UNITS),
            required("size", T::Vec2, "Width and height of the window.").unit(UNITS),
        ],
    },
];
