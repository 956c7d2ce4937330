//! What a type may be: sets of the outermost words of types.

use std::fmt;

/// The outermost word of a type.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u8)]
pub(super) enum Head {
    Number,
    Bool,
    Text,
    Vec2,
    Vec3,
    Color,
    Shape,
    Material,
    Light,
    Camera,
    Image,
    Hit,
    Integrator,
    Encoding,
    // Those above stand alone; those below have parts.
    List,
    Record,
    Function,
}

use Head as H;

impl Head {
    /// Those that stand alone, in the order of their numbers.
    pub(super) const ALONE: [Self; 14] = [
        H::Number,
        H::Bool,
        H::Text,
        H::Vec2,
        H::Vec3,
        H::Color,
        H::Shape,
        H::Material,
        H::Light,
        H::Camera,
        H::Image,
        H::Hit,
        H::Integrator,
        H::Encoding,
    ];

    /// As types are written.
    pub(super) const fn name(self) -> &'static str {
        match self {
            H::Number => "Number",
            H::Bool => "Bool",
            H::Text => "Text",
            H::Vec2 => "Vec2",
            H::Vec3 => "Vec3",
            H::Color => "Color",
            H::Shape => "Shape",
            H::Material => "Material",
            H::Light => "Light",
            H::Camera => "Camera",
            H::Image => "Image",
            H::Hit => "Hit",
            H::Integrator => "Integrator",
            H::Encoding => "Encoding",
            H::List => "a list",
            H::Record => "a record",
            H::Function => "a function",
        }
    }

    /// In words, with an article.
    pub(super) const fn words(self) -> &'static str {
        match self {
            H::Number => "a number",
            H::Bool => "true or false",
            H::Text => "a text",
            H::Vec2 => "a vector of two",
            H::Vec3 => "a vector of three",
            H::Color => "a colour",
            H::Shape => "a shape",
            H::Material => "a material",
            H::Light => "a light",
            H::Camera => "a camera",
            H::Image => "an image",
            H::Hit => "a hit",
            H::Integrator => "an integrator",
            H::Encoding => "an encoding",
            H::List => "a list",
            H::Record => "a record",
            H::Function => "a function",
        }
    }

    /// In words, several of them.
    pub(super) const fn plural(self) -> &'static str {
        match self {
            H::Number => "numbers",
            H::Bool => "truth values",
            H::Text => "texts",
            H::Vec2 => "vectors of two",
            H::Vec3 => "vectors of three",
            H::Color => "colours",
            H::Shape => "shapes",
            H::Material => "materials",
            H::Light => "lights",
            H::Camera => "cameras",
            H::Image => "images",
            H::Hit => "hits",
            H::Integrator => "integrators",
            H::Encoding => "encodings",
            H::List => "lists",
            H::Record => "records",
            H::Function => "functions",
        }
    }
}

/// The types that a variable may stand for: a set of heads, and two demands on what is inside.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct Kind(u32);

const HEADS: u32 = (1 << 17) - 1;
const EQUATABLE_FLAG: u32 = 1 << 30;
const PLACEABLE_FLAG: u32 = 1 << 31;

impl Kind {
    /// Any type.
    pub(super) const ANY: Self = Self(HEADS);
    /// What arithmetic works on.
    pub(super) const NUMERIC: Self = Self::of(&[H::Number, H::Vec2, H::Vec3, H::Color]);
    /// Vectors.
    pub(super) const VECTOR: Self = Self::of(&[H::Vec2, H::Vec3]);
    /// What `++` joins.
    pub(super) const APPENDABLE: Self = Self::of(&[H::List, H::Text]);
    /// What can be moved: the scene's own kinds, and functions, which then must take a hit.
    pub(super) const PLACEABLE: Self =
        Self(Self::of(&[H::Shape, H::Material, H::Light, H::Camera, H::Function]).0 | PLACEABLE_FLAG);
    /// What `==` compares, inside and out.
    pub(super) const EQUATABLE: Self = Self(
        Self::of(&[H::Number, H::Bool, H::Text, H::Vec2, H::Vec3, H::Color, H::List, H::Record]).0
            | EQUATABLE_FLAG,
    );

    /// Those heads.
    pub(super) const fn of(heads: &[Head]) -> Self {
        let (mut set, mut i) = (0, 0);
        while i < heads.len() {
            set |= 1 << heads[i] as u32;
            i += 1;
        }
        Self(set)
    }

    /// The kind that a variable of this name has in a type: by its name without digits.
    pub(super) fn named(variable: &str) -> Self {
        match variable.trim_end_matches(|c: char| c.is_ascii_digit()) {
            "numeric" => Self::NUMERIC,
            "vector" => Self::VECTOR,
            "placeable" => Self::PLACEABLE,
            "appendable" => Self::APPENDABLE,
            _ => Self::ANY,
        }
    }

    /// The name that variables of this kind have in types, where there is one.
    pub(super) fn name(self) -> Option<&'static str> {
        match self {
            Self::NUMERIC => Some("numeric"),
            Self::VECTOR => Some("vector"),
            Self::PLACEABLE => Some("placeable"),
            Self::APPENDABLE => Some("appendable"),
            _ if self == Self::NUMERIC.meet(Self::EQUATABLE) => Some("numeric"),
            _ if self == Self::VECTOR.meet(Self::EQUATABLE) => Some("vector"),
            _ => None,
        }
    }

    /// What both allow.
    pub(super) const fn meet(self, other: Self) -> Self {
        Self((self.0 & other.0 & HEADS) | ((self.0 | other.0) & !HEADS))
    }

    /// These and more heads.
    pub(super) const fn or(self, head: Head) -> Self {
        Self(self.0 | 1 << head as u32)
    }

    pub(super) const fn has(self, head: Head) -> bool {
        self.0 & (1 << head as u32) != 0
    }

    /// Whether nothing is allowed.
    pub(super) const fn is_empty(self) -> bool {
        self.0 & HEADS == 0
    }

    /// Whether every head of it is one of the other's.
    pub(super) const fn within(self, other: Self) -> bool {
        self.0 & HEADS & !other.0 == 0
    }

    /// Whether it allows every head.
    pub(super) const fn is_any(self) -> bool {
        self.0 & HEADS == HEADS
    }

    /// Whether what is inside must be equatable, too.
    pub(super) const fn is_equatable(self) -> bool {
        self.0 & EQUATABLE_FLAG != 0
    }

    /// Whether a function must take a hit.
    pub(super) const fn is_placeable(self) -> bool {
        self.0 & PLACEABLE_FLAG != 0
    }

    /// The one head that is left, where it stands alone.
    pub(super) fn only(self) -> Option<Head> {
        let heads = self.0 & HEADS;
        if heads.count_ones() != 1 {
            return None;
        }
        Head::ALONE.get(heads.trailing_zeros() as usize).copied()
    }

    /// All heads, in order.
    pub(super) fn heads(self) -> impl Iterator<Item = Head> {
        let parts = [H::List, H::Record, H::Function];
        Head::ALONE.into_iter().chain(parts).filter(move |head| self.has(*head))
    }

    /// In words: `a number, a vector or a colour`.
    pub(super) fn words(self) -> String {
        match self {
            Self::NUMERIC => "a number, a vector or a colour".into(),
            Self::VECTOR => "a vector".into(),
            Self::PLACEABLE => "a shape, a material, a light, a camera or a function of a hit".into(),
            Self::APPENDABLE => "a list or a text".into(),
            _ if self.is_any() => "anything".into(),
            _ => {
                let words: Vec<&str> = self.heads().map(Head::words).collect();
                match words.split_last() {
                    None => "nothing".into(),
                    Some((last, [])) => (*last).into(),
                    Some((last, first)) => format!("{} or {last}", first.join(", ")),
                }
            }
        }
    }
}

impl fmt::Debug for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_set().entries(self.heads()).finish()
    }
}
