//! What a primitive is made of in the end.

use crate::{Primitive, Shape};

/// The primitives of other shapes that a solid is made of, from the first operand to the last. See
/// [`Primitive::leaves`].
#[derive(Clone, Debug)]
pub struct Leaves<'a> {
    left: Vec<&'a Primitive>,
}

impl Primitive {
    /// The primitive itself, or, where its shape is a [`Shape::Csg`], what that is made of.
    ///
    /// Solids that use one solid twice have its leaves twice. There can be far more leaves than memory: whoever
    /// collects them has to set a limit.
    #[must_use]
    pub fn leaves(&self) -> Leaves<'_> {
        Leaves { left: vec![self] }
    }
}

impl<'a> Iterator for Leaves<'a> {
    type Item = &'a Primitive;

    fn next(&mut self) -> Option<&'a Primitive> {
        loop {
            let primitive = self.left.pop()?;
            let Shape::Csg(csg) = &primitive.shape else { return Some(primitive) };
            let [first, second] = &csg.operands;
            self.left.extend([second, first]);
        }
    }
}
