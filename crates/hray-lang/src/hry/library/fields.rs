//! The fields of constructors.

/// A field of a constructor.
#[derive(Clone, Copy, Debug)]
pub struct FieldSpec {
    /// Its name.
    pub name: &'static str,
    /// What it takes.
    pub kind: FieldType,
    /// Whether it may vary over a surface, and so takes a function of a hit, too.
    pub varies: bool,
    /// Its default as hry text; none where the field must be given; empty where it may be left out and then means
    /// what `doc` says.
    pub default: Option<&'static str>,
    /// Which values are allowed.
    pub range: Range,
    /// The unit of a number: "scene units", "radians", "pixels", "share" (of 1), or empty.
    pub unit: &'static str,
    /// What it means, in one or two sentences.
    pub doc: &'static str,
}

/// What a field takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FieldType {
    /// A number.
    Number,
    /// A truth value.
    Bool,
    /// A text.
    Text,
    /// A vector of two.
    Vec2,
    /// A vector of three.
    Vec3,
    /// A colour, or a number for a grey.
    Color,
    /// A material.
    Material,
    /// A camera.
    Camera,
    /// A list of lights.
    Lights,
    /// A list of shapes.
    Shapes,
    /// A list of vectors of three.
    Points,
    /// A list of vectors of two.
    Pairs,
    /// A list of lists of numbers.
    Faces,
    /// How light is followed.
    Integrator,
    /// How colours are written to a picture.
    Encoding,
    /// A colour, a number for a grey, or a function from a direction (a unit vector) to a colour.
    Background,
    /// A function from a hit to a number.
    Height,
    /// A function from a point to a number.
    Space,
}

/// The values that a field allows. Numbers must be finite everywhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Range {
    /// Any.
    Any,
    /// Greater than 0.
    Positive,
    /// 0 or greater.
    NonNegative,
    /// From 0 to 1, where others are legal but surely not meant: a warning.
    Share,
    /// Between the two, both excluded.
    Between(f64, f64),
    /// A whole number from the first to the second.
    Whole(f64, f64),
    /// A vector that is not zero.
    Direction,
    /// 0 or greater in every component, where others are legal but surely not meant: a warning.
    Light,
    /// Greater than 0 in every component.
    Positives,
    /// A radius: greater than 0, where others are legal, as in classic scenes, but surely not meant: a warning.
    Radius,
    /// A normal: not zero, where zero is legal, as in classic scenes, but surely not meant: a warning.
    Normal,
}

impl FieldSpec {
    /// A field that must be given.
    pub(super) const fn required(name: &'static str, kind: FieldType, doc: &'static str) -> Self {
        Self { name, kind, varies: false, default: None, range: Range::Any, unit: "", doc }
    }

    /// A field with a default.
    pub(super) const fn with_default(
        name: &'static str,
        kind: FieldType,
        default: &'static str,
        doc: &'static str,
    ) -> Self {
        Self { name, kind, varies: false, default: Some(default), range: Range::Any, unit: "", doc }
    }

    /// The same, where it may vary over a surface.
    pub(super) const fn varying(mut self) -> Self {
        self.varies = true;
        self
    }

    /// The same with a range.
    pub(super) const fn range(mut self, range: Range) -> Self {
        self.range = range;
        self
    }

    /// The same with a unit.
    pub(super) const fn unit(mut self, unit: &'static str) -> Self {
        self.unit = unit;
        self
    }
}
