//! The syntax of hry: properties of the parser and what it says about mistakes.

mod properties;
