//! The functions of a scene, evaluated over the hits of a frame, or over the directions of rays that hit nothing.

use super::Integrator;
use super::frame::{Columns, Frame};
use super::uv::direction_uv;
use hray_core::DVec3;
use hray_expr::{Input, PlanScratch};

/// What one thread needs to evaluate functions.
pub(super) struct Scratch {
    plan: PlanScratch,
    /// The same moment for every point.
    time: Vec<f64>,
    direction: Columns<3>,
    uv: Columns<2>,
    colors: Columns<3>,
    rays: Vec<u32>,
}

impl Scratch {
    pub(super) fn new() -> Self {
        Self {
            plan: PlanScratch::default(),
            time: Vec::new(),
            direction: Columns::new(),
            uv: Columns::new(),
            colors: Columns::new(),
            rays: Vec::new(),
        }
    }
}

impl Integrator {
    /// Fills the fields of all hits that are of a varying material.
    pub(super) fn evaluate_fields(&self, frame: &mut Frame, scratch: &mut Scratch) {
        for group in &frame.groups {
            let (start, end) = (group.start, group.start + group.len);
            let material = self.material(group.leaf);
            if material.varying.is_empty() {
                continue;
            }
            let time = self.moments(&mut scratch.time, group.len);
            let [px, py, pz] = frame.hit_object.get();
            let [wx, wy, wz] = frame.hit_point.get();
            let [nx, ny, nz] = frame.hit_normal.get();
            let [u, v] = frame.hit_uv.get();
            let hits = |column: &'_ [f64]| -> std::ops::Range<usize> {
                if column.is_empty() { 0..0 } else { start..end }
            };
            let inputs = [px, py, pz, wx, wy, wz, nx, ny, nz, u, v].map(|column| &column[hits(column)]);
            let [px, py, pz, wx, wy, wz, nx, ny, nz, u, v] = inputs;
            let inputs = [px, py, pz, wx, wy, wz, nx, ny, nz, u, v, time];
            for varying in &material.varying {
                let columns = frame.fields.get_mut().into_iter().skip(varying.first.into());
                let outputs = columns.take(varying.count.into()).map(|column| &mut column[start..end]);
                self.plans.evaluate(self.level, varying.plan, &inputs, group.len, &mut scratch.plan, outputs);
            }
        }
    }

    /// The colours of a function background for those rays of a frame that `wanted` says, by their number.
    pub(super) fn evaluate_background(
        &self,
        plan: u32,
        frame: &Frame,
        scratch: &mut Scratch,
        wanted: impl Fn(usize) -> bool,
        mut put: impl FnMut(usize, [f64; 3]),
    ) {
        let Scratch { plan: plan_scratch, time, direction, uv, colors, rays } = scratch;
        rays.clear();
        rays.extend((0..frame.len).filter(|&ray| wanted(ray)).map(|ray| ray as u32));
        let len = rays.len();
        direction.reserve(len);
        uv.reserve(len);
        colors.reserve(len);
        for (to, from) in direction.get_mut().into_iter().zip(frame.direction.get()) {
            to.iter_mut().zip(rays.iter()).for_each(|(to, &ray)| *to = from[ray as usize]);
        }
        let [x, y, z] = direction.get().map(|column| &column[..len]);
        if self.plans.uses_uv(plan) {
            let [us, vs] = uv.get_mut();
            for i in 0..len {
                [us[i], vs[i]] = direction_uv(DVec3::new(x[i], y[i], z[i]));
            }
        }
        let time = self.moments(time, len);
        let [u, v] = uv.get().map(|column| &column[..len]);
        let inputs: [&[f64]; Input::COUNT] = [x, y, z, x, y, z, x, y, z, u, v, time];
        let outputs = colors.get_mut().into_iter().map(|column| &mut column[..len]);
        self.plans.evaluate(self.level, plan, &inputs, len, plan_scratch, outputs);
        let colors = colors.get();
        for (i, &ray) in rays.iter().enumerate() {
            put(ray as usize, colors.map(|column| column[i]));
        }
    }

    fn moments<'t>(&self, time: &'t mut Vec<f64>, len: usize) -> &'t [f64] {
        if time.len() < len {
            time.resize(len, self.time);
        }
        &time[..len]
    }
}
