//! Functions and values that are not written in hry.

/// A native function or value.
#[derive(Debug)]
pub struct NativeSpec {
    /// Its name.
    pub name: &'static str,
    /// Its type, as hry writes it.
    pub signature: &'static str,
    /// What it does, in one or two sentences.
    pub doc: &'static str,
    /// The heading of the reference that it stands under.
    pub group: &'static str,
    /// Which it is.
    pub native: Native,
}

macro_rules! natives {
    ($($group:literal { $($variant:ident $name:literal : $signature:literal, $doc:literal;)+ })+) => {
        /// Which native function or value.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        #[allow(missing_docs, reason = "each has its documentation in the table below")]
        pub enum Native { $($($variant,)+)+ }

        /// All of them, in the order of the reference.
        pub const NATIVES: &[NativeSpec] = &[$($(NativeSpec {
            name: $name,
            signature: $signature,
            doc: $doc,
            group: $group,
            native: Native::$variant,
        },)+)+];
    };
}

natives! {
    "Numbers" {
        Sin "sin": "Number -> Number", "Sine of an angle in radians.";
        Cos "cos": "Number -> Number", "Cosine of an angle in radians.";
        Tan "tan": "Number -> Number", "Tangent of an angle in radians.";
        Asin "asin": "Number -> Number", "The angle, in radians, whose sine this is.";
        Acos "acos": "Number -> Number", "The angle, in radians, whose cosine this is.";
        Atan "atan": "Number -> Number", "The angle, in radians, whose tangent this is.";
        Atan2 "atan2": "Number -> Number -> Number",
            "`atan2 y x` is the angle of the point (x, y), in radians from the x axis, between -turn/2 and turn/2.";
        Sqrt "sqrt": "Number -> Number", "Square root.";
        Exp "exp": "Number -> Number", "e to that power.";
        Ln "ln": "Number -> Number", "Natural logarithm.";
        Abs "abs": "numeric -> numeric", "Without its sign; of each component.";
        Floor "floor": "numeric -> numeric", "The largest whole number that is not above it; of each component.";
        Ceil "ceil": "numeric -> numeric", "The smallest whole number that is not below it; of each component.";
        Round "round": "numeric -> numeric", "The nearest whole number, halves away from 0; of each component.";
        Min "min": "numeric -> numeric -> numeric", "The smaller of two; of each component.";
        Max "max": "numeric -> numeric -> numeric", "The larger of two; of each component.";
        Random "random": "Number -> Number -> Number",
            "`random seed i` is a number in [0, 1) that looks random and depends on the two alone.";
    }
    "Vectors" {
        Dot "dot": "vector -> vector -> Number",
            "The sum of the products of the components: the product of the lengths and the cosine of the angle \
             between them.";
    }
    "Colours" {
        Rgb "rgb": "Number -> Number -> Number -> Color", "A colour from red, green and blue as linear light, 0 to 1.";
    }
    "Noise" {
        Perlin "perlin": "Number -> Vec3 -> Number",
            "`perlin seed p` is the improved gradient noise of Perlin (2002): smooth, about -1 to 1, one feature a unit, \
             0 wherever all coordinates are whole. The seed is a whole number that does not depend on the hit.";
        Perlin1985 "perlin1985": "Number -> Vec3 -> Number",
            "`perlin1985 seed p` is the gradient noise of Perlin (1985) with the tables of the render (`--noise-tables`). \
             Seeds 0, 1 and 2 are the three tables as loaded; any other shuffles the first.";
        Cells "cells": "Number -> Vec3 -> { nearest : Number, second : Number, id : Number, toward : Vec3 }",
            "`cells seed p` scatters one point into every unit cell (Worley, 1996): the distances to the nearest and the \
             second nearest of them, a random number in [0, 1) that belongs to the nearest, and the vector to it.";
    }
    "Images" {
        Image "image": "Text -> Image",
            "An image file beside the scene (PNG, JPEG, ...). The path is looked up from the folder of the file that \
             names it, with slashes.";
        Pixel "pixel": "Image -> Vec2 -> Color",
            "The colour of an image at (u, v): u from 0 at its left to 1 at its right, v from 0 at its bottom to 1 at its \
             top, repeated beyond. Blended between pixels.";
        Alpha "alpha": "Image -> Vec2 -> Number", "How opaque an image is at (u, v), 0 to 1.";
        Aspect "aspect": "Image -> Number", "Width of an image divided by its height.";
    }
    "Lists" {
        Fold "fold": "(b -> a -> b) -> b -> [a] -> b",
            "`fold step start list` goes through a list from the left: the step takes what there is so far and an \
             element.";
        Count "count": "[a] -> Number", "How many elements a list has.";
        At "at": "Number -> [a] -> a", "`at i list` is element i, counted from 0.";
        Sort "sortBy": "(a -> Number) -> [a] -> [a]", "The elements in ascending order of a number that belongs to each.";
        Reverse "reverse": "[a] -> [a]", "The elements from the last to the first.";
        Concat "concat": "[[a]] -> [a]", "The elements of all lists in one.";
    }
    "Texts" {
        Show "show": "a -> Text", "A value as text.";
    }
    "Loops" {
        Iterate "iterate": "Number -> (a -> Bool) -> (a -> a) -> a -> a",
            "`iterate max until step start`: while `until` is false and it has been done fewer than `max` times, step is \
             applied. The one loop that may depend on a hit; `max` may not.";
    }
    "Shapes" {
        Union "union": "Shape -> Shape -> Shape", "What is inside either of two solids.";
        Intersection "intersection": "Shape -> Shape -> Shape", "What is inside both of two solids.";
        Difference "difference": "Shape -> Shape -> Shape",
            "`difference a b` is a without what is inside b. Where b cuts, its surface is seen, with its material.";
        Inverse "inverse": "Shape -> Shape",
            "All that is not inside a solid: `inverse hole` is a block without end around a hole. Its surface is turned \
             inside out.";
        Clip "clip": "Shape -> Shape -> Shape",
            "`shape |> clip solid` leaves of a shape the surface that is inside the solid. The cut is not closed: one looks \
             in, where `intersection` would show the solid's own surface. Shapes without an inside can be clipped as well; \
             of a group each is clipped by itself.";
        Group "group": "[Shape] -> Shape", "Several shapes as one, to be moved or painted together.";
        Paint "paint": "Material -> Shape -> Shape", "Gives a material to whatever in a shape has none.";
    }
    "Transforms" {
        Translate "translate": "Vec3 -> placeable -> placeable",
            "Moves a shape, a texture, a material, a light or a camera.";
        Rotate "rotate": "Vec3 -> Number -> placeable -> placeable",
            "`rotate axis angle` turns about an axis through the origin; counter-clockwise, seen against the axis.";
        Scale "scale": "Number -> placeable -> placeable", "Makes larger or smaller, from the origin.";
        Stretch "stretch": "Vec3 -> placeable -> placeable",
            "Makes larger or smaller along x, y and z, from the origin; a negative number mirrors.";
        Matrix "matrix": "{ x : Vec3, y : Vec3, z : Vec3, origin : Vec3 } -> placeable -> placeable",
            "Any affine transform, by where it takes the unit vectors along x, y and z, and the origin.";
    }
    "Scene" {
        Whitted "whitted": "Integrator",
            "The classic integrator without its absolute constants: matte surfaces, mirrors, glass, hard shadows.";
        Classic2005 "classic2005": "Integrator", "The integrator of 2005 to the bit, its constants and quirks included.";
        Srgb "srgb": "Encoding", "Colours are linear light, encoded for displays.";
        Raw "raw": "Encoding", "The numbers of colours are written as they are, as in 2005.";
    }
}
