//! A finished function: a graph with outputs.

use crate::{Block, Input, Loop, Node, NodeId, NoiseKind, NoiseTables, cells, classic_noise, improved_noise};

/// A function of a hit with any number of results. Made by [`crate::Builder::finish`]; only what the outputs need
/// is in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Function {
    nodes: Vec<Node>,
    outputs: Vec<NodeId>,
}

impl Function {
    pub(crate) const fn new(nodes: Vec<Node>, outputs: Vec<NodeId>) -> Self {
        Self { nodes, outputs }
    }

    /// Its steps, arguments before what is made of them.
    #[must_use]
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// Its results, among the nodes.
    #[must_use]
    pub fn outputs(&self) -> &[NodeId] {
        &self.outputs
    }

    /// The results at one point: the definition, step by step.
    #[must_use]
    pub fn evaluate(&self, tables: &NoiseTables, inputs: &[f64; Input::COUNT]) -> Vec<f64> {
        let values = run(&self.nodes, tables, inputs, &[]);
        self.outputs.iter().map(|id| values[id.0 as usize][0]).collect()
    }
}

/// The results of every node.
fn run(
    nodes: &[Node],
    tables: &NoiseTables,
    inputs: &[f64; Input::COUNT],
    arguments: &[f64],
) -> Vec<Vec<f64>> {
    let mut values: Vec<Vec<f64>> = Vec::with_capacity(nodes.len());
    for node in nodes {
        let value = |id: &NodeId| values[id.0 as usize][0];
        let all = match node {
            Node::Constant(c) => vec![*c],
            Node::Input(input) => vec![inputs[*input as usize]],
            Node::Argument(i) => vec![arguments[*i as usize]],
            Node::Unary(f, a) => vec![f.apply(value(a))],
            Node::Binary(f, a, b) => vec![f.apply(value(a), value(b))],
            Node::Select(c, a, b) => vec![if value(c) != 0.0 { value(a) } else { value(b) }],
            Node::Noise(kind, seed, p) => {
                let p = [value(&p[0]), value(&p[1]), value(&p[2])];
                vec![match kind {
                    NoiseKind::Improved => improved_noise(*seed, p),
                    NoiseKind::Classic => classic_noise(tables, *seed, p),
                }]
            }
            Node::Block(block, arguments) => {
                let arguments: Vec<f64> = arguments.iter().map(value).collect();
                match block {
                    Block::Cells { seed } => {
                        cells(*seed, [arguments[0], arguments[1], arguments[2]]).to_vec()
                    }
                    Block::Image(image) => image.sample(arguments[0], arguments[1]).to_vec(),
                    Block::Loop(body) => run_loop(body, tables, inputs, &arguments),
                }
            }
            Node::Result(block, i) => vec![values[block.0 as usize][usize::from(*i)]],
        };
        values.push(all);
    }
    values
}

fn run_loop(body: &Loop, tables: &NoiseTables, inputs: &[f64; Input::COUNT], arguments: &[f64]) -> Vec<f64> {
    let (mut state, captured) = (arguments[..body.state].to_vec(), &arguments[body.state..]);
    for _ in 0..body.max {
        let all: Vec<f64> = state.iter().chain(captured).copied().collect();
        let values = run(&body.nodes, tables, inputs, &all);
        if values[body.until.0 as usize][0] != 0.0 {
            break;
        }
        state = body.step.iter().map(|id| values[id.0 as usize][0]).collect();
    }
    state
}
