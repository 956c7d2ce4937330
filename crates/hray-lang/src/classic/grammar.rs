//! The grammar of thesis appendix A.5 as data, every position with a description in the words of the user.
//!
//! There is no recursion in it: a scene is a header, four sections, and two of these hold a list. Each of
//! those pieces is a sequence of [`Item`]s, read by `sequence`; `build` turns what was read into values.
//! Each item is one line of the grammar, so that a reader can hold the two side by side.

use super::token::Bracket::{self, Curly, Round, Square};
use NumberKind::{Integer, Real};

/// A part of a sequence.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Item {
    /// A fixed word.
    Word(&'static str),
    /// An opening bracket, and what it opens.
    Open(Bracket, &'static str),
    /// A closing bracket, and what it closes.
    Close(Bracket, &'static str),
    /// A number.
    Number(&'static Number),
    /// Numbers between round brackets, separated by commas.
    Tuple(&'static Tuple),
    /// One of several forms, told apart by their first words.
    Choice(&'static Choice),
}

/// Which numbers a position takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NumberKind {
    /// No point.
    Integer,
    /// A point with digits on both sides.
    Real,
}

/// The position of a single number.
#[derive(Debug)]
pub(crate) struct Number {
    pub(crate) kind: NumberKind,
    pub(crate) what: &'static str,
    pub(crate) example: &'static str,
}

/// The position of a tuple.
#[derive(Debug)]
pub(crate) struct Tuple {
    pub(crate) kind: NumberKind,
    pub(crate) what: &'static str,
    pub(crate) components: &'static [&'static str],
    pub(crate) example: &'static str,
}

/// A position where one of several forms stands.
#[derive(Debug)]
pub(crate) struct Choice {
    /// What each form is, without an article: "shape".
    pub(crate) what: &'static str,
    pub(crate) forms: &'static [Form],
}

/// A word and what follows it.
#[derive(Debug)]
pub(crate) struct Form {
    pub(crate) word: &'static str,
    pub(crate) items: &'static [Item],
}

const fn real(what: &'static str, example: &'static str) -> Number {
    Number { kind: Real, what, example }
}

const fn integer(what: &'static str, example: &'static str) -> Number {
    Number { kind: Integer, what, example }
}

const fn point(what: &'static str, example: &'static str) -> Tuple {
    Tuple { kind: Real, what, components: &["x", "y", "z"], example }
}

const fn color(what: &'static str) -> Tuple {
    Tuple { kind: Real, what, components: &["red", "green", "blue"], example: "(0.8,0.8,0.8)" }
}

const fn size(what: &'static str, example: &'static str) -> Tuple {
    Tuple { kind: Integer, what, components: &["width", "height"], example }
}

use Item::{Choice as OneOf, Close, Number as Num, Open, Tuple as Tup, Word};

/// `RenderDescr`, up to the sections of `Scene`.
pub(crate) static HEADER: &[Item] = &[
    Word("renderDescr"),
    Open(Round, "the group `( resolution ... )`"),
    Word("resolution"),
    Tup(&size("the resolution", "(800,600)")),
    Close(Round, "the group `( resolution ... )`"),
    Num(&integer("the recursion depth", "3")),
    Open(Square, "the scene"),
    Word("scene"),
];

/// What ends `RenderDescr`.
pub(crate) static FOOTER: &[Item] = &[Close(Square, "the scene")];

/// `Camera`, with its braces.
pub(crate) static CAMERA: &[Item] = &[
    Open(Curly, "the camera section"),
    Word("camera"),
    Tup(&point("the camera's eye", "(0.0,0.0,150.0)")),
    Tup(&size("the camera's window", "(100,75)")),
    Close(Curly, "the camera section"),
];

/// `Background`, with its braces.
pub(crate) static BACKGROUND: &[Item] = &[
    Open(Curly, "the background section"),
    Word("background"),
    Tup(&color("the background colour")),
    Close(Curly, "the background section"),
];

/// The start of `Objects`; `TexturedObject`s follow.
pub(crate) static OBJECTS: &[Item] = &[Open(Curly, "the objects section"), Word("objects")];

/// The start of `Objects` up to the first shape.
pub(crate) static OBJECTS_AHEAD: &[Item] = &[
    Open(Curly, "the objects section"),
    Word("objects"),
    Open(Round, "the object"),
    Word("object"),
    Open(Round, "the shape"),
    OneOf(&SHAPE),
];

/// The end of `Objects`.
pub(crate) static OBJECTS_END: &[Item] = &[Close(Curly, "the objects section")];

/// The start of `Lights`; `Light`s follow.
pub(crate) static LIGHTS: &[Item] = &[Open(Curly, "the lights section"), Word("lights")];

/// The start of `Lights` up to the end of the first light.
pub(crate) static LIGHTS_AHEAD: &[Item] = &[
    Open(Curly, "the lights section"),
    Word("lights"),
    Open(Round, "the light"),
    OneOf(&LIGHT_KIND),
    Close(Round, "the light"),
];

/// The end of `Lights`.
pub(crate) static LIGHTS_END: &[Item] = &[Close(Curly, "the lights section")];

/// `TexturedObject`, with its `Texture`.
pub(crate) static OBJECT: &[Item] = &[
    Open(Round, "the object"),
    Word("object"),
    Open(Round, "the shape"),
    OneOf(&SHAPE),
    Close(Round, "the shape"),
    Open(Round, "the texture"),
    Word("texture"),
    Open(Round, "the diffuse colour"),
    Word("diff"),
    OneOf(&DIFF),
    Close(Round, "the diffuse colour"),
    Num(&real("the reflection coefficient", "0.5")),
    Num(&integer("the highlight exponent", "60")),
    Num(&real("the transparency coefficient", "0.0")),
    Num(&real("the refraction index", "1.5")),
    Close(Round, "the texture"),
    Close(Round, "the object"),
];

/// `Light`.
pub(crate) static LIGHT: &[Item] = &[Open(Round, "the light"), OneOf(&LIGHT_KIND), Close(Round, "the light")];

/// The two kinds of `Light`.
pub(crate) static LIGHT_KIND: Choice = Choice {
    what: "light",
    forms: &[
        Form {
            word: "pointLight",
            items: &[
                Tup(&point("the light's position", "(30.0,0.0,100.0)")),
                Tup(&color("the light's intensity")),
            ],
        },
        Form { word: "ambientLight", items: &[Tup(&color("the light's intensity"))] },
    ],
};

/// `Object`.
static SHAPE: Choice = Choice {
    what: "shape",
    forms: &[
        Form {
            word: "sphere",
            items: &[
                Num(&real("the sphere's radius", "40.0")),
                Tup(&point("the sphere's centre", "(0.0,0.0,-150.0)")),
            ],
        },
        Form {
            word: "plane",
            items: &[Tup(&Tuple {
                kind: Real,
                what: "the plane's equation",
                components: &["a", "b", "c", "d"],
                example: "(0.0,1.0,0.0,50.0)",
            })],
        },
    ],
};

/// `Diff`.
static DIFF: Choice = Choice {
    what: "diffuse colour",
    forms: &[
        Form { word: "solid", items: &[Tup(&color("the solid colour"))] },
        Form { word: "perlin", items: &[Open(Round, "the noise"), OneOf(&NOISE), Close(Round, "the noise")] },
    ],
};

static BASE: Tuple = color("the base colour");
static ADDED: Tuple = color("the added colour");
static OCTAVES: Number = integer("the number of octaves", "10");
static GRID: Number = real("the noise grid", "16.0");
static DIRECTION: Tuple = point("the marble's direction", "(0.4,0.0,0.0)");
static MARBLE_POWER: Number = real("the marble's turbulence", "30.0");

/// `NoiseF`.
static NOISE: Choice = Choice {
    what: "noise function",
    forms: &[
        Form { word: "perlinSolid", items: &[Tup(&BASE), Num(&GRID)] },
        Form { word: "perlinSemiTurb", items: &[Tup(&BASE), Num(&OCTAVES), Num(&GRID)] },
        Form { word: "perlinTurb", items: &[Tup(&BASE), Num(&OCTAVES), Num(&GRID)] },
        Form { word: "perlinFire", items: &[Tup(&ADDED), Tup(&BASE), Num(&OCTAVES), Num(&GRID)] },
        Form { word: "perlinPlasma", items: &[Num(&GRID)] },
        Form {
            word: "perlinMarble",
            items: &[Tup(&BASE), Num(&OCTAVES), Num(&GRID), Tup(&DIRECTION), Num(&MARBLE_POWER)],
        },
        Form {
            word: "perlinMarbleBase",
            items: &[Tup(&BASE), Tup(&ADDED), Num(&OCTAVES), Num(&GRID), Tup(&DIRECTION), Num(&MARBLE_POWER)],
        },
        Form {
            word: "perlinWood",
            items: &[
                Tup(&BASE),
                Num(&OCTAVES),
                Num(&GRID),
                Num(&real("the density of the wood's rings", "1.0")),
                Num(&real("the wood's turbulence", "2.0")),
            ],
        },
    ],
};
