//! The syntax of hry: properties of the parser and the formatter, and what is said about mistakes.

mod formatter;
mod generate;
mod mistakes;
mod parsing;
mod properties;
