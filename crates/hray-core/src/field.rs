//! Numbers that may vary over a surface.

use hray_expr::Function;
use std::sync::Arc;

/// A number, or a function of the hit.
#[derive(Clone, Debug, PartialEq)]
pub enum Field {
    /// The same everywhere.
    Constant(f64),
    /// One output: the number.
    Function(Arc<Function>),
}

impl Field {
    /// Whether it is the same everywhere, and 0.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.constant() == Some(0.0)
    }

    /// The number, where it is the same everywhere.
    #[must_use]
    pub const fn constant(&self) -> Option<f64> {
        match self {
            Self::Constant(value) => Some(*value),
            Self::Function(_) => None,
        }
    }
}

impl From<f64> for Field {
    fn from(value: f64) -> Self {
        Self::Constant(value)
    }
}
