//! Placeholder until the parser lands.
use super::ast::Module;
use crate::diagnostic::Diagnostic;
/// Parses.
#[must_use]
pub fn parse(_text: &str, _base: usize) -> Parse {
    Parse
}
/// A parse.
#[derive(Debug)]
pub struct Parse;
impl Parse {
    /// The module.
    #[must_use]
    pub fn module(&self) -> Module {
        Module::default()
    }
    /// The errors.
    #[must_use]
    pub fn errors(&self) -> &[Diagnostic] {
        &[]
    }
}
