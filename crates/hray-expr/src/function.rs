//! A finished function: a graph with outputs.

use crate::{Node, NodeId};

/// A function of a hit with any number of results. Made by [`crate::Builder::finish`]; only what the outputs need
/// is in it.
#[derive(Clone, Debug)]
pub struct Function {
    nodes: Vec<Node>,
    outputs: Vec<NodeId>,
}

impl PartialEq for Function {
    fn eq(&self, _other: &Self) -> bool {
        todo!("structural, constants by their bits")
    }
}
