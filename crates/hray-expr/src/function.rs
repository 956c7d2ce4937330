//! A finished function: a graph with outputs.

use crate::{Block, Input, Loop, Node, NodeId, NoiseKind, NoiseTables};
use crate::{cells, classic_noise, improved_noise};

/// A function of a hit with any number of results. Made by [`crate::Builder::finish`]; only what the outputs need
/// is in it.
///
/// Two functions are equal when they are the same nodes in the same order, constants compared by their bits.
#[derive(Clone, Debug, PartialEq)]
pub struct Function {
    nodes: Vec<Node>,
    outputs: Vec<NodeId>,
}

impl Function {
    pub(crate) const fn new(nodes: Vec<Node>, outputs: Vec<NodeId>) -> Self {
        Self { nodes, outputs }
    }

    /// The nodes, each after its operands.
    #[must_use]
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// Where the results are.
    #[must_use]
    pub fn outputs(&self) -> &[NodeId] {
        &self.outputs
    }

    /// What it asks of the hit, in the order of [`Input::ALL`].
    pub fn inputs_used(&self) -> impl Iterator<Item = Input> + use<> {
        let mut used = [false; Input::COUNT];
        mark_inputs(&self.nodes, &mut used);
        Input::ALL.into_iter().zip(used).filter(|(_, used)| *used).map(|(input, _)| input)
    }

    /// The most operations that one evaluation can take: every node counts 1, those of a loop once for every step
    /// that it may make. Saturates.
    #[must_use]
    pub fn cost(&self) -> u64 {
        cost(&self.nodes)
    }

    /// The results at one point: the definition that [`crate::Plan`] is measured by, plain and slow.
    #[must_use]
    pub fn evaluate(&self, tables: &NoiseTables, inputs: &[f64; Input::COUNT]) -> Vec<f64> {
        let values = evaluate(&self.nodes, tables, inputs, &[]);
        self.outputs.iter().map(|id| values[id.index()][0]).collect()
    }
}

fn mark_inputs(nodes: &[Node], used: &mut [bool; Input::COUNT]) {
    for node in nodes {
        match node {
            Node::Input(input) => used[*input as usize] = true,
            Node::Block(Block::Loop(body), _) => mark_inputs(&body.nodes, used),
            _ => {}
        }
    }
}

fn cost(nodes: &[Node]) -> u64 {
    let each = nodes.iter().map(|node| match node {
        Node::Block(Block::Loop(body), _) => cost(&body.nodes).saturating_mul(body.max.into()),
        _ => 1,
    });
    each.fold(0, u64::saturating_add)
}

/// The values of all nodes: one each, several of a block.
fn evaluate(
    nodes: &[Node],
    tables: &NoiseTables,
    inputs: &[f64; Input::COUNT],
    arguments: &[f64],
) -> Vec<Vec<f64>> {
    let mut values: Vec<Vec<f64>> = Vec::with_capacity(nodes.len());
    for node in nodes {
        let at = |id: &NodeId| values[id.index()][0];
        let value = match node {
            Node::Constant(v) => vec![*v],
            Node::Input(input) => vec![inputs[*input as usize]],
            Node::Argument(i) => vec![arguments[*i as usize]],
            Node::Unary(f, a) => vec![f.apply(at(a))],
            Node::Binary(f, a, b) => vec![f.apply(at(a), at(b))],
            Node::Select(condition, a, b) => vec![if at(condition) == 0.0 { at(b) } else { at(a) }],
            Node::Noise(NoiseKind::Improved, seed, p) => vec![improved_noise(*seed, p.each_ref().map(at))],
            Node::Noise(NoiseKind::Classic, seed, p) => {
                vec![classic_noise(tables, *seed, p.each_ref().map(at))]
            }
            Node::Block(block, a) => {
                let a: Vec<f64> = a.iter().map(at).collect();
                match block {
                    Block::Cells { seed } => cells(*seed, [a[0], a[1], a[2]]).to_vec(),
                    Block::Image(image) => image.sample(a[0], a[1]).to_vec(),
                    Block::Loop(body) => repeat(body, tables, inputs, a),
                }
            }
            Node::Result(block, i) => vec![values[block.index()][usize::from(*i)]],
        };
        values.push(value);
    }
    values
}

/// The state after a loop; `arguments` are the initial state and what is captured.
fn repeat(
    body: &Loop,
    tables: &NoiseTables,
    inputs: &[f64; Input::COUNT],
    mut arguments: Vec<f64>,
) -> Vec<f64> {
    for _ in 0..body.max {
        let values = evaluate(&body.nodes, tables, inputs, &arguments);
        if values[body.until.index()][0] != 0.0 {
            break;
        }
        for (state, step) in arguments.iter_mut().zip(&body.step) {
            *state = values[step.index()][0];
        }
    }
    arguments.truncate(body.state);
    arguments
}
