//! How a scene is loaded: what every command that reads one takes.

use crate::values;
use clap::Args;
use hray::{Limits, LintLevels, LoadOptions};
use std::path::PathBuf;

/// What an hry scene is loaded with.
#[derive(Args, Debug)]
pub(crate) struct SceneArgs {
    /// Replace a definition of an hry scene: NAME is its name, VALUE any expression; can be given several times
    #[arg(long, value_name = "NAME=VALUE", value_parser = values::setting, help_heading = "Scenes in hry")]
    pub set: Vec<(String, String)>,
    /// The folder whose files the scene may import and use, and no others [default: the scene's own]
    #[arg(long, value_name = "FOLDER", help_heading = "Scenes in hry")]
    pub root: Option<PathBuf>,
    #[command(flatten)]
    pub limits: LimitArgs,
}

/// How much an evaluation may take.
#[derive(Args, Debug)]
pub(crate) struct LimitArgs {
    /// The most steps that working out the scene may take [default: 1000000000]
    #[arg(long, value_name = "N", value_parser = values::steps, help_heading = "Scenes in hry")]
    pub eval_steps: Option<u64>,
    /// The most calls inside calls [default: 10000]
    #[arg(long, value_name = "N", value_parser = values::eval_depth, help_heading = "Scenes in hry")]
    pub eval_depth: Option<u32>,
    /// The most elements of a list [default: 10000000]
    #[arg(long, value_name = "N", value_parser = values::list, help_heading = "Scenes in hry")]
    pub eval_list: Option<usize>,
    /// The most memory for lists and texts, in MiB [default: 4096]
    #[arg(long, value_name = "MIB", value_parser = values::memory, help_heading = "Scenes in hry")]
    pub eval_memory: Option<u64>,
    /// The most operations of one function of a hit [default: 1000000]
    #[arg(long, value_name = "N", value_parser = values::nodes, help_heading = "Scenes in hry")]
    pub eval_nodes: Option<usize>,
}

impl LimitArgs {
    fn limits(&self) -> Limits {
        let default = Limits::default();
        Limits {
            steps: self.eval_steps.unwrap_or(default.steps),
            depth: self.eval_depth.unwrap_or(default.depth),
            list: self.eval_list.unwrap_or(default.list),
            memory: self.eval_memory.map_or(default.memory, |mebibytes| mebibytes << 20),
            nodes: self.eval_nodes.unwrap_or(default.nodes),
        }
    }
}

impl SceneArgs {
    /// What to load a scene with, at a moment in seconds.
    pub(crate) fn options(&self, levels: &LintLevels, time: f64) -> LoadOptions {
        LoadOptions {
            levels: levels.clone(),
            root: self.root.clone(),
            set: self.set.clone(),
            time,
            stop: None,
            limits: self.limits.limits(),
            modules: false,
        }
    }
}
