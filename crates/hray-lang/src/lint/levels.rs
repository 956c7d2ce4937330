//! Which lints are heard.

use super::LINTS;
use std::fmt;

/// The name of the group of all lints.
pub const ALL_LINTS: &str = "warnings";

/// What a lint does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Level {
    /// Nothing.
    Allow,
    /// It warns.
    #[default]
    Warn,
    /// It makes an error, so that nothing is rendered.
    Deny,
}

/// The level of every lint; [`Level::Warn`] to begin with.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LintLevels([Level; LINTS.len()]);

impl Default for LintLevels {
    fn default() -> Self {
        Self([Level::default(); LINTS.len()])
    }
}

impl LintLevels {
    /// Sets the level of the lint with this code, or of all with [`ALL_LINTS`]. A later call overrides an
    /// earlier one.
    ///
    /// # Errors
    /// [`UnknownLint`] where no lint has this code.
    pub fn set(&mut self, name: &str, level: Level) -> Result<(), UnknownLint> {
        if name == ALL_LINTS {
            self.0 = [level; LINTS.len()];
            return Ok(());
        }
        match self.0.iter_mut().zip(LINTS).find(|(_, lint)| lint.code == name) {
            Some((slot, _)) => {
                *slot = level;
                Ok(())
            }
            None => Err(UnknownLint::new(name)),
        }
    }

    /// The level of the lint with this code; an unknown code is never heard.
    #[must_use]
    pub fn get(&self, code: &str) -> Level {
        self.0.iter().zip(LINTS).find(|(_, lint)| lint.code == code).map_or(Level::Allow, |(level, _)| *level)
    }
}

/// No lint has this name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownLint {
    /// The name.
    pub name: String,
    /// The nearest that exists, where one is near.
    pub nearest: Option<&'static str>,
}

impl UnknownLint {
    fn new(name: &str) -> Self {
        let codes = LINTS.iter().map(|lint| lint.code).chain([ALL_LINTS]);
        let near = codes.map(|code| (strsim::osa_distance(name, code), code)).min();
        let nearest = near.filter(|(distance, _)| *distance <= 3).map(|(_, code)| code);
        Self { name: name.into(), nearest }
    }
}

impl fmt::Display for UnknownLint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "there is no lint `{}`", self.name)?;
        match self.nearest {
            Some(nearest) => write!(f, "; did you mean `{nearest}`?"),
            None => Ok(()),
        }
    }
}

impl std::error::Error for UnknownLint {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn later_levels_override_earlier_ones_and_the_group_means_all() {
        let mut levels = LintLevels::default();
        assert_eq!(levels.get("no-lights"), Level::Warn);
        levels.set(ALL_LINTS, Level::Deny).unwrap();
        levels.set("no-lights", Level::Allow).unwrap();
        assert_eq!(levels.get("no-lights"), Level::Allow);
        assert_eq!(levels.get("many-octaves"), Level::Deny);
        levels.set("warnings", Level::Warn).unwrap();
        assert_eq!(levels, LintLevels::default());
    }

    #[test]
    fn an_unknown_lint_is_refused_with_the_nearest() {
        let error = LintLevels::default().set("no-light", Level::Deny).unwrap_err();
        assert_eq!(error.to_string(), "there is no lint `no-light`; did you mean `no-lights`?");
        assert_eq!(LintLevels::default().set("xyz", Level::Deny).unwrap_err().nearest, None);
    }
}
