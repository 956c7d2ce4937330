//! What a primitive is made of in the end.

use crate::Primitive;

/// The primitives by themselves that one is made of, from the first operand to the last. See [`Primitive::leaves`].
#[derive(Clone, Debug)]
pub struct Leaves<'a> {
    left: Vec<&'a Primitive>,
}

impl Primitive {
    /// The primitive itself, or what it is made of, where its shape has [operands](crate::Shape::operands).
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
            let [first, second] = primitive.shape.operands();
            if first.is_none() {
                return Some(primitive);
            }
            self.left.extend([second, first].into_iter().flatten());
        }
    }
}
