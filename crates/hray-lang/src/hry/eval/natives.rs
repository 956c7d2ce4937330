//! What native functions do.

use super::compile::internal;
use super::failure::{Failure, Outcome};
use super::limits::Charge;
use super::machine::{Machine, depends_on_hit, grouped};
use super::scalar::{assemble, parts};
use super::value::{HitValue, Hollow, Kind, RecordValue, Scalar, ShapeNode, ShapeValue, Symbol, Value};
use crate::diagnostic::{Diagnostic, Span};
use crate::hry::ast::BinaryOperator;
use crate::hry::library::Native;
use crate::hry::program::missing_asset;
use hray_core::{CsgOperation, Shape};
use hray_expr::{Binary, Block, NodeId, NoiseKind, Unary};
use std::fmt::Write as _;
use std::sync::Arc;

/// How deep shapes may nest: unions in unions, groups in groups.
const DEEPEST_SHAPE: u32 = 200;
/// The most steps of a loop that depends on a hit.
const LONGEST_LOOP: f64 = 100_000.0;
/// The longest text that `show` makes of one value.
const LONGEST_SHOWN: usize = 1000;

/// How many arguments a native function takes.
pub(super) const fn arity(native: Native) -> usize {
    use Native as N;
    match native {
        N::Whitted | N::Classic2005 | N::Srgb | N::Raw => 0,
        N::Sin
        | N::Cos
        | N::Tan
        | N::Asin
        | N::Acos
        | N::Atan
        | N::Sqrt
        | N::Exp
        | N::Ln
        | N::Abs
        | N::Floor
        | N::Ceil
        | N::Round
        | N::Image
        | N::Aspect
        | N::Count
        | N::Reverse
        | N::Concat
        | N::Show
        | N::Inverse
        | N::Group => 1,
        N::Atan2
        | N::Min
        | N::Max
        | N::Random
        | N::Dot
        | N::Perlin
        | N::Perlin1985
        | N::Cells
        | N::Pixel
        | N::Alpha
        | N::At
        | N::Sort
        | N::Union
        | N::Intersection
        | N::Difference
        | N::Clip
        | N::Paint
        | N::Translate
        | N::Scale
        | N::Stretch
        | N::Matrix => 2,
        N::Rgb | N::Fold | N::Rotate => 3,
        N::Iterate => 4,
    }
}

impl Machine<'_> {
    /// Calls a native function with all of its arguments.
    pub(super) fn native(&mut self, native: Native, arguments: &[Value], span: Span) -> Outcome<Value> {
        use Native as N;
        self.step(span)?;
        match (native, arguments) {
            (N::Sin, [a]) => self.each(Unary::Sin, a, span),
            (N::Cos, [a]) => self.each(Unary::Cos, a, span),
            (N::Tan, [a]) => self.each(Unary::Tan, a, span),
            (N::Asin, [a]) => self.each(Unary::Asin, a, span),
            (N::Acos, [a]) => self.each(Unary::Acos, a, span),
            (N::Atan, [a]) => self.each(Unary::Atan, a, span),
            (N::Sqrt, [a]) => self.each(Unary::Sqrt, a, span),
            (N::Exp, [a]) => self.each(Unary::Exp, a, span),
            (N::Ln, [a]) => self.each(Unary::Ln, a, span),
            (N::Abs, [a]) => self.each(Unary::Abs, a, span),
            (N::Floor, [a]) => self.each(Unary::Floor, a, span),
            (N::Ceil, [a]) => self.each(Unary::Ceil, a, span),
            (N::Round, [a]) => self.each(Unary::Round, a, span),
            (N::Atan2, [a, b]) => self.each_pair(Binary::Atan2, a, b, span),
            (N::Min, [a, b]) => self.each_pair(Binary::Min, a, b, span),
            (N::Max, [a, b]) => self.each_pair(Binary::Max, a, b, span),
            (N::Random, [Value::Number(a), Value::Number(b)]) => Ok(Value::Number(hray_expr::random(*a, *b))),
            (N::Random, [a, b]) => self.each_pair(Binary::Random, a, b, span),
            (N::Dot, [a, b]) => self.dot(a, b, span),
            (N::Rgb, [r, g, b]) => {
                let number = |v| Self::scalar_of(v, span);
                Ok(assemble(Kind::Color, [number(r)?, number(g)?, number(b)?]))
            }
            (N::Perlin, [seed, p]) => self.noise(NoiseKind::Improved, seed, p, span),
            (N::Perlin1985, [seed, p]) => self.noise(NoiseKind::Classic, seed, p, span),
            (N::Cells, [seed, p]) => self.cells(seed, p, span),
            (N::Image, [Value::Text(path)]) => {
                let path = path.text.clone();
                self.image(&path, span)
            }
            (N::Pixel | N::Alpha, [Value::Image(image), uv]) => {
                let (_, [u, v, _]) =
                    parts(uv).ok_or_else(|| internal(span, "an image looked up by something else"))?;
                let results = self.block(Block::Image(image.clone()), &[u, v], span)?;
                Ok(match (native, &results[..]) {
                    (N::Pixel, [r, g, b, ..]) => assemble(Kind::Color, [*r, *g, *b]),
                    (_, [.., alpha]) => assemble(Kind::Number, [*alpha; 3]),
                    _ => return Err(internal(span, "an image without colours").into()),
                })
            }
            (N::Aspect, [Value::Image(image)]) => {
                Ok(Value::Number(f64::from(image.width()) / f64::from(image.height())))
            }
            (N::Fold, [step, start, Value::List(list)]) => {
                let mut value = start.clone();
                for item in &list.items {
                    self.step(span)?;
                    value = self.apply_value(step, &[value, item.clone()], span)?;
                }
                Ok(value)
            }
            (N::Count, [Value::List(list)]) => Ok(Value::Number(list.items.len() as f64)),
            (N::At, [index, Value::List(list)]) => {
                let index = self.known(index, "which element of a list this is", span)?;
                let place = (index >= 0.0 && index.fract() == 0.0).then_some(index as usize);
                place
                    .and_then(|place| list.items.get(place))
                    .cloned()
                    .ok_or_else(|| no_element(index, list.items.len(), span))
            }
            (N::Sort, [key, Value::List(list)]) => self.sort(key, &list.items, span),
            (N::Reverse, [Value::List(list)]) => self.list(list.items.iter().rev().cloned().collect(), span),
            (N::Concat, [Value::List(list)]) => {
                let mut all = Vec::new();
                for inner in &list.items {
                    let Value::List(inner) = inner else {
                        return Err(internal(span, "a list of something else than lists").into());
                    };
                    self.check_length(all.len() + inner.items.len(), span)?;
                    self.step(span)?;
                    all.extend_from_slice(&inner.items);
                }
                self.list(all, span)
            }
            (N::Show, [value]) => {
                let text = self.show(value, LONGEST_SHOWN);
                self.text(text, span)
            }
            (N::Iterate, [max, until, step, start]) => self.iterate(max, until, step, start, span),
            (N::Union, [a, b]) => self.csg(CsgOperation::Union, a, b, span),
            (N::Intersection, [a, b]) => self.csg(CsgOperation::Intersection, a, b, span),
            (N::Difference, [a, b]) => self.csg(CsgOperation::Difference, a, b, span),
            (N::Inverse, [Value::Shape(solid)]) => {
                if let Some(hollow) = solid.hollow() {
                    return Err(not_a_solid(&hollow, "in it", span));
                }
                let origin = self.origin(span);
                Self::shape(ShapeNode::Inverse { solid: solid.clone(), origin }, solid.nesting + 1, span)
            }
            (N::Clip, [Value::Shape(within), Value::Shape(shape)]) => {
                if let Some(hollow) = within.hollow() {
                    return Err(not_a_solid(&hollow, "in what it is clipped by", span));
                }
                let nesting = within.nesting.max(shape.nesting) + 1;
                let (within, shape, origin) = (within.clone(), shape.clone(), self.origin(span));
                Self::shape(ShapeNode::Clip { within, shape, origin }, nesting, span)
            }
            (N::Group, [Value::List(list)]) => {
                let nesting = list.items.iter().map(|item| match item {
                    Value::Shape(shape) => shape.nesting,
                    _ => 0,
                });
                let nesting = nesting.max().unwrap_or(0) + 1;
                Self::shape(ShapeNode::Group(list.clone()), nesting, span)
            }
            (N::Paint, [Value::Material(material), Value::Shape(shape)]) => {
                // Whatever is painted already has a material everywhere.
                if matches!(shape.node, ShapeNode::Painted { .. }) {
                    return Ok(Value::Shape(shape.clone()));
                }
                let node = ShapeNode::Painted { material: material.clone(), shape: shape.clone() };
                Self::shape(node, shape.nesting, span)
            }
            (N::Translate | N::Rotate | N::Scale | N::Stretch | N::Matrix, _) => {
                self.transform(native, arguments, span)
            }
            _ => Err(internal(span, "a native function with arguments that it does not take").into()),
        }
    }

    pub(super) fn scalar_of(value: &Value, span: Span) -> Outcome<Scalar> {
        match parts(value) {
            Some((kind, [scalar, ..])) if kind.len() == 1 => Ok(scalar),
            _ => Err(internal(span, &format!("{} where a number is needed", value.describe())).into()),
        }
    }

    /// A number that does not depend on the hit.
    pub(super) fn known(&self, value: &Value, what: &str, span: Span) -> Outcome<f64> {
        match Self::scalar_of(value, span)? {
            Scalar::Known(value) => Ok(value),
            Scalar::Node(_) => Err(depends_on_hit(what, span)),
        }
    }

    fn dot(&mut self, a: &Value, b: &Value, span: Span) -> Outcome<Value> {
        let (Some((kind, a)), Some((_, b))) = (parts(a), parts(b)) else {
            return Err(internal(span, "a product of something else than vectors").into());
        };
        let mut sum = self.binary(Binary::Mul, a[0], b[0], span)?;
        for i in 1..kind.len() {
            let product = self.binary(Binary::Mul, a[i], b[i], span)?;
            sum = self.binary(Binary::Add, sum, product, span)?;
        }
        Ok(assemble(Kind::Number, [sum; 3]))
    }

    fn seed(&self, seed: &Value, span: Span) -> Outcome<u64> {
        let seed = self.known(seed, "the seed of a noise", span)?;
        if seed.fract() != 0.0 || seed.abs() > 9e15 {
            let message = format!("a seed is a whole number, and {seed} is none");
            return Err(Failure::new(Diagnostic::error("seed", message, span, "in this call")));
        }
        Ok(seed as i64 as u64)
    }

    fn point(p: &Value, span: Span) -> Outcome<[Scalar; 3]> {
        match parts(p) {
            Some((Kind::Vec3, p)) => Ok(p),
            _ => Err(internal(span, "noise at something else than a point").into()),
        }
    }

    fn noise(&mut self, kind: NoiseKind, seed: &Value, p: &Value, span: Span) -> Outcome<Value> {
        let seed = self.seed(seed, span)?;
        let p = Self::point(p, span)?;
        if let (NoiseKind::Improved, [Scalar::Known(x), Scalar::Known(y), Scalar::Known(z)]) = (kind, p) {
            return Ok(Value::Number(hray_expr::improved_noise(seed, [x, y, z])));
        }
        if self.graph.is_none() {
            // The tables belong to the render, which may use others than hray's own.
            let message = "the noise of 1985 has no value outside of a function of a hit";
            return Err(Failure::new(
                Diagnostic::error(
                    "no-tables",
                    message,
                    span,
                    "its tables are those of the render, and not known here",
                )
                .with_help("use `perlin` for shapes and placements; `perlin1985` is for textures"),
            ));
        }
        let p = [self.node(p[0], span)?, self.node(p[1], span)?, self.node(p[2], span)?];
        let node = self.build(span, |graph| graph.noise(kind, seed, p))?;
        let value = self.scalar(node);
        Ok(assemble(Kind::Number, [value; 3]))
    }

    fn cells(&mut self, seed: &Value, p: &Value, span: Span) -> Outcome<Value> {
        let seed = self.seed(seed, span)?;
        let p = Self::point(p, span)?;
        let results = match p {
            [Scalar::Known(x), Scalar::Known(y), Scalar::Known(z)] => {
                hray_expr::cells(seed, [x, y, z]).map(Scalar::Known).to_vec()
            }
            p => self.block(Block::Cells { seed }, &p, span)?,
        };
        let [nearest, second, id, x, y, z] = results[..] else {
            return Err(internal(span, "cells without all of their results").into());
        };
        let names: Arc<[Symbol]> =
            ["nearest", "second", "id", "toward"].map(|name| self.symbols.number(name)).into();
        let number = |scalar| assemble(Kind::Number, [scalar; 3]);
        let values = vec![number(nearest), number(second), number(id), assemble(Kind::Vec3, [x, y, z])];
        Ok(Value::Record(Arc::new(RecordValue { names, values })))
    }

    /// The results of a block; known where its arguments are.
    fn block(&mut self, block: Block, arguments: &[Scalar], span: Span) -> Outcome<Vec<Scalar>> {
        if let (Block::Image(image), [Scalar::Known(u), Scalar::Known(v)]) = (&block, arguments) {
            return Ok(image.sample(*u, *v).map(Scalar::Known).to_vec());
        }
        let nodes: Vec<NodeId> = arguments.iter().map(|a| self.node(*a, span)).collect::<Outcome<_>>()?;
        let results = self.build(span, |graph| graph.block(block, &nodes))?;
        Ok(results.into_iter().map(|node| self.scalar(node)).collect())
    }

    /// The path from the root that a text means at a place.
    pub(super) fn asset_path(&self, written: &str, span: Span) -> Outcome<String> {
        // The folder is that of the file in which the call stands.
        let from = self.program.sources.file(span.start).map_or("", |file| &file.path);
        crate::hry::assets::resolve(from, written).ok_or_else(|| {
            let message = format!("{written:?} leads out of the root folder");
            Failure::new(
                Diagnostic::error("import-outside", message, span, "not inside the root folder").with_help(
                    "paths are written with slashes from the folder of the file; `--root FOLDER` widens the root",
                ),
            )
        })
    }

    fn image(&mut self, written: &str, span: Span) -> Outcome<Value> {
        let path = self.asset_path(written, span)?;
        if let Some(image) = self.images.get(&path) {
            return Ok(Value::Image(image.clone()));
        }
        match self.assets.image(&path) {
            Ok(image) => {
                self.images.insert(path, image.clone());
                Ok(Value::Image(image))
            }
            Err(error) => Err(Failure::new(missing_asset(self.assets, &path, span, &error))),
        }
    }

    fn sort(&mut self, key: &Value, items: &[Value], span: Span) -> Outcome<Value> {
        let mut keyed = Vec::with_capacity(items.len());
        for item in items {
            self.step(span)?;
            let value = self.apply_value(key, std::slice::from_ref(item), span)?;
            keyed.push((self.known(&value, "the order of a list", span)?, item.clone()));
        }
        keyed.sort_by(|a, b| a.0.total_cmp(&b.0));
        self.list(keyed.into_iter().map(|(_, item)| item).collect(), span)
    }

    /// `iterate max until step start`.
    fn iterate(
        &mut self,
        max: &Value,
        until: &Value,
        step: &Value,
        start: &Value,
        span: Span,
    ) -> Outcome<Value> {
        let max = self.known(max, "how often a loop goes round at most", span)?;
        if max.fract() != 0.0 || !(0.0..=9e15).contains(&max) {
            let message = format!("`iterate` goes round a whole number of times, and {max} is none");
            return Err(Failure::new(Diagnostic::error("iterate-max", message, span, "in this call")));
        }
        let (mut state, mut left) = (start.clone(), max);
        while left > 0.0 {
            self.step(span)?;
            let done = self.apply_value(until, std::slice::from_ref(&state), span)?;
            match Self::scalar_of(&done, span)? {
                Scalar::Known(0.0) => {}
                Scalar::Known(_) => return Ok(state),
                Scalar::Node(_) => return self.loop_on_hit(left, until, step, &state, span),
            }
            state = self.apply_value(step, std::slice::from_ref(&state), span)?;
            left -= 1.0;
        }
        Ok(state)
    }

    /// The rest of a loop, from where its end depends on the hit.
    fn loop_on_hit(
        &mut self,
        max: f64,
        until: &Value,
        step: &Value,
        start: &Value,
        span: Span,
    ) -> Outcome<Value> {
        if max > LONGEST_LOOP {
            let message =
                format!("a loop whose end depends on the hit may go round {LONGEST_LOOP} times at most");
            return Err(Failure::new(Diagnostic::error("iterate-max", message, span, "in this call")));
        }
        let mut initial = Vec::new();
        flatten(start, &mut initial).ok_or_else(|| not_a_state(start, span))?;
        let initial: Vec<NodeId> = initial.into_iter().map(|s| self.node(s, span)).collect::<Outcome<_>>()?;
        let arguments = self.build(span, |graph| graph.begin_loop(initial.len()))?;
        let body = self.loop_body(until, step, start, &arguments, span);
        let (until, next) = match body {
            Ok(body) => body,
            Err(error) => {
                if let Some(graph) = &mut self.graph {
                    graph.cancel_loop();
                }
                return Err(error);
            }
        };
        let results = self.build(span, |graph| graph.end_loop(max as u32, &initial, until, &next))?;
        let mut results = results.into_iter().map(|node| self.scalar(node)).collect::<Vec<_>>().into_iter();
        self.rebuild(start, &mut results)
            .ok_or_else(|| internal(span, "a loop without all of its results").into())
    }

    fn loop_body(
        &mut self,
        until: &Value,
        step: &Value,
        start: &Value,
        arguments: &[NodeId],
        span: Span,
    ) -> Outcome<(NodeId, Vec<NodeId>)> {
        let mut scalars = arguments.iter().map(|node| Scalar::Node(*node));
        let state =
            self.rebuild(start, &mut scalars).ok_or_else(|| internal(span, "a loop without a state"))?;
        let done = self.apply_value(until, std::slice::from_ref(&state), span)?;
        let done = Self::scalar_of(&done, span)?;
        let done = self.node(done, span)?;
        let next = self.apply_value(step, &[state], span)?;
        let mut flat = Vec::new();
        flatten(&next, &mut flat).ok_or_else(|| not_a_state(&next, span))?;
        if flat.len() != arguments.len() {
            let message = "the state of this loop changes its size";
            return Err(Failure::new(Diagnostic::error(
                "loop-state",
                message,
                span,
                "the step gives a list of another length than it gets",
            )));
        }
        let next = flat.into_iter().map(|s| self.node(s, span)).collect::<Outcome<_>>()?;
        Ok((done, next))
    }

    /// A value like `like`, of the next scalars.
    fn rebuild(&mut self, like: &Value, scalars: &mut impl Iterator<Item = Scalar>) -> Option<Value> {
        if let Some((kind, _)) = parts(like) {
            let mut parts = [Scalar::Known(0.0); 3];
            for part in parts.iter_mut().take(kind.len()) {
                *part = scalars.next()?;
            }
            return Some(assemble(kind, parts));
        }
        match like {
            Value::Record(record) => {
                let values =
                    record.values.iter().map(|value| self.rebuild(value, scalars)).collect::<Option<_>>()?;
                Some(Value::Record(Arc::new(RecordValue { names: record.names.clone(), values })))
            }
            Value::List(list) => {
                let items =
                    list.items.iter().map(|value| self.rebuild(value, scalars)).collect::<Option<_>>()?;
                self.list(items, Span::at(0)).ok()
            }
            _ => None,
        }
    }

    fn csg(&mut self, operation: CsgOperation, a: &Value, b: &Value, span: Span) -> Outcome<Value> {
        let (Value::Shape(a), Value::Shape(b)) = (a, b) else {
            return Err(internal(span, "a solid of something else than shapes").into());
        };
        if let Some(hollow) = a.hollow().or_else(|| b.hollow()) {
            return Err(not_a_solid(&hollow, "in one of the two", span));
        }
        let nesting = a.nesting.max(b.nesting) + 1;
        let origin = self.origin(span);
        let operands = [a.clone(), b.clone()];
        Self::shape(ShapeNode::Csg { operation, operands, origin }, nesting, span)
    }

    pub(super) fn shape(node: ShapeNode, nesting: u32, span: Span) -> Outcome<Value> {
        Self::charged_shape(node, nesting, None, span)
    }

    /// A shape that holds so many bytes of its own.
    pub(super) fn charged_shape(
        node: ShapeNode,
        nesting: u32,
        charge: Option<Charge>,
        span: Span,
    ) -> Outcome<Value> {
        if nesting > DEEPEST_SHAPE {
            let message = format!("shapes are nested more than {DEEPEST_SHAPE} deep");
            return Err(Failure::new(
                Diagnostic::error("nested-too-deeply", message, span, "one too many here").with_help(
                    "join pairs of shapes, then pairs of these, and so on, instead of adding one at a time",
                ),
            ));
        }
        Ok(Value::Shape(Arc::new(ShapeValue { node, nesting, _charge: charge })))
    }

    /// A hit as a moved function sees it: taken back by the inverse of the move.
    pub(super) fn moved(
        &mut self,
        hit: &HitValue,
        inverse: &glam::DAffine3,
        span: Span,
    ) -> Outcome<HitValue> {
        let columns =
            [inverse.matrix3.x_axis, inverse.matrix3.y_axis, inverse.matrix3.z_axis].map(|c| c.to_array());
        let origin = inverse.translation.to_array();
        let mut point = |p: [Scalar; 3]| -> Outcome<[Scalar; 3]> {
            let mut result = [Scalar::Known(0.0); 3];
            for (row, result) in result.iter_mut().enumerate() {
                let weights = columns.map(|column| column[row]);
                *result = self.weighted(p, weights, origin[row], span)?;
            }
            Ok(result)
        };
        let (p, world) = (point(hit.p)?, point(hit.world)?);
        // Normals go with the transposed inverse; the inverse of the inverse is the move itself.
        let forward = inverse.matrix3.inverse();
        let rows = [forward.x_axis, forward.y_axis, forward.z_axis].map(|column| column.to_array());
        let mut normal = [Scalar::Known(0.0); 3];
        for (row, result) in rows.into_iter().zip(&mut normal) {
            *result = self.weighted(hit.normal, row, 0.0, span)?;
        }
        let [x, y, z] = normal;
        let normal = Value::Symbolic(Arc::new(super::value::Symbolic { kind: Kind::Vec3, parts: [x, y, z] }));
        let squared = self.dot(&normal, &normal, span)?;
        let length = self.each(Unary::Sqrt, &squared, span)?;
        let unit = self.arithmetic(BinaryOperator::Divide, &normal, &length, span)?;
        let (_, normal) = parts(&unit).ok_or_else(|| internal(span, "a normal that is none"))?;
        Ok(HitValue { p, world, normal, ..*hit })
    }

    /// The sum of products with known weights, and a constant; weights of 0 and 1 cost nothing.
    fn weighted(&mut self, p: [Scalar; 3], weights: [f64; 3], constant: f64, span: Span) -> Outcome<Scalar> {
        let mut sum: Option<Scalar> = None;
        for (component, weight) in p.into_iter().zip(weights) {
            if weight == 0.0 {
                continue;
            }
            let term = if weight == 1.0 {
                component
            } else {
                self.binary(Binary::Mul, component, Scalar::Known(weight), span)?
            };
            sum = Some(match sum {
                None => term,
                Some(sum) => self.binary(Binary::Add, sum, term, span)?,
            });
        }
        match sum {
            None => Ok(Scalar::Known(constant)),
            Some(sum) if constant == 0.0 => Ok(sum),
            Some(sum) => self.binary(Binary::Add, sum, Scalar::Known(constant), span),
        }
    }

    /// A value as text, cut where it gets long.
    pub(super) fn show(&self, value: &Value, longest: usize) -> String {
        let mut text = String::new();
        self.write(value, longest, &mut text);
        if text.len() > longest {
            text.truncate(text.floor_char_boundary(longest));
            text.push_str("...");
        }
        text
    }

    fn write(&self, value: &Value, longest: usize, text: &mut String) {
        if text.len() > longest {
            return;
        }
        let result = match value {
            Value::Number(n) => write!(text, "{n}"),
            Value::Bool(b) => write!(text, "{b}"),
            Value::Vec2([x, y]) => write!(text, "({x}, {y})"),
            Value::Vec3([x, y, z]) => write!(text, "({x}, {y}, {z})"),
            Value::Color([r, g, b]) => write!(text, "rgb {r} {g} {b}"),
            Value::Text(t) => {
                text.push_str(&t.text);
                Ok(())
            }
            Value::List(list) => {
                text.push('[');
                for (i, item) in list.items.iter().enumerate() {
                    if i > 0 {
                        text.push_str(", ");
                    }
                    self.write(item, longest, text);
                    if text.len() > longest {
                        break;
                    }
                }
                text.push(']');
                Ok(())
            }
            Value::Record(record) => {
                text.push_str("{ ");
                for (i, (name, item)) in record.names.iter().zip(&record.values).enumerate() {
                    let _ = write!(text, "{}{} = ", if i > 0 { ", " } else { "" }, self.symbols.name(*name));
                    self.write(item, longest, text);
                }
                text.push_str(" }");
                Ok(())
            }
            other => write!(text, "<{}>", other.describe()),
        };
        // Writing to a text does not fail.
        let _ = result;
    }
}

/// The scalars of a value that is made of numbers.
fn flatten(value: &Value, into: &mut Vec<Scalar>) -> Option<()> {
    if let Some((kind, parts)) = parts(value) {
        into.extend_from_slice(parts.get(..kind.len())?);
        return Some(());
    }
    match value {
        Value::Record(record) => record.values.iter().try_for_each(|value| flatten(value, into)),
        Value::List(list) => list.items.iter().try_for_each(|value| flatten(value, into)),
        _ => None,
    }
}

fn not_a_state(value: &Value, span: Span) -> Box<Failure> {
    let message =
        format!("the state of a loop whose end depends on the hit cannot hold {}", value.describe());
    Failure::new(
        Diagnostic::error("loop-state", message, span, "in this loop")
            .with_help("it may hold numbers, truth values, vectors, colours, and records and lists of these"),
    )
}

fn no_element(index: f64, count: usize, span: Span) -> Box<Failure> {
    let message = match count {
        0 => format!("there is no element {index} in an empty list"),
        1 => format!("there is no element {index} in a list of one; its only element is number 0"),
        _ => format!(
            "there is no element {index} in a list of {count}; they are counted from 0 to {}",
            count - 1
        ),
    };
    Failure::new(Diagnostic::error("no-element", message, span, "asked for here"))
}

/// Why a shape without an inside cannot be a part of solids.
fn not_a_solid(hollow: &Hollow<'_>, place: &str, span: Span) -> Box<Failure> {
    let message = "what has no inside cannot be part of a solid";
    let error = |label: String| Diagnostic::error("not-a-solid", message, span, label);
    let group = "`group` puts shapes together without joining them";
    Failure::new(match hollow {
        Hollow::Shape(Shape::Mesh(mesh)) if mesh.triangles().is_empty() => {
            error(format!("a mesh {place} is empty")).with_help(group)
        }
        Hollow::Shape(Shape::Mesh(mesh)) => error(match mesh.open_edges() {
            1 => format!("a mesh {place} is not closed: at an edge something is missing"),
            count => {
                format!("a mesh {place} is not closed: {} of its edges are open", grouped(count as u64))
            }
        })
        .with_help(format!(
            "close its holes in the program that made it, and let all triangles go round the same way; or {group}"
        )),
        Hollow::Shape(_) => error(format!("a disc or something open is {place}")).with_help(format!(
            "{group}; spheres, planes, boxes, cylinders, cones, tori, closed meshes and what is made of them have an inside"
        )),
        Hollow::Clipped => error(format!("something that is clipped is {place}")).with_help(
            "what is clipped is open where it was cut; `intersection` cuts and leaves a solid, and `clip` can come last",
        ),
    })
}
