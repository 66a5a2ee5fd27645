//! The same frame with memories of several sizes, and with several α and β.

use glassbrick::{NearlyEmpty, RenderRequest, Renderer, Volume, VolumeDesc};

use crate::difference::difference;
use crate::measure::{Measurement, residency, stages, times_again};
use crate::{BenchError, BudgetPoint, Executor, NearlyEmptyPoint, Spread};

/// Decoded bricks that the CPU may keep.
pub const CPU_BUDGETS_BYTES: [u64; 6] = [512 << 20, 256 << 20, 128 << 20, 64 << 20, 32 << 20, 16 << 20];

/// Atlas textures that a GPU may make.
pub const TEXTURE_COUNTS: [u32; 4] = [8, 4, 2, 1];

/// α and β: the exact picture first, with which the others are compared.
pub const NEARLY_EMPTY: [NearlyEmpty; 11] = [
    NearlyEmpty::KEEP,
    alpha(0.001),
    alpha(0.01),
    alpha(0.05),
    alpha(0.1),
    alpha(0.2),
    beta(0.9999),
    beta(0.999),
    beta(0.995),
    beta(0.99),
    beta(0.95),
];

const fn alpha(alpha: f64) -> NearlyEmpty {
    NearlyEmpty { alpha, beta: 1.0 }
}

const fn beta(beta: f64) -> NearlyEmpty {
    NearlyEmpty { alpha: 0.0, beta }
}

/// Voxels along an edge of an atlas texture.
const TEXTURE_EDGE: u64 = 256;

/// Bytes of an atlas texture: voxels of more than two bytes are kept in four.
pub fn texture_bytes(desc: &VolumeDesc) -> u64 {
    TEXTURE_EDGE.pow(3) * desc.stored_type.bytes().min(4) as u64
}

impl Measurement<'_> {
    /// Draws the first view with the largest memory first; `tell` hears of each.
    ///
    /// # Errors
    /// As of [`Measurement::views`].
    pub fn budgets(
        &self,
        request: &RenderRequest,
        texture_bytes: u64,
        mut tell: impl FnMut(BudgetPoint) -> Result<(), BenchError>,
    ) -> Result<(), BenchError> {
        let data_set = &self.plan.data_sets[self.task.data_set];
        let is_cpu = self.task.executor == Executor::Cpu;
        let budgets: Vec<(u64, Option<u32>)> = if is_cpu {
            CPU_BUDGETS_BYTES.map(|bytes| (bytes, None)).to_vec()
        } else {
            TEXTURE_COUNTS.map(|count| (u64::from(count) * texture_bytes, Some(count))).to_vec()
        };
        let mut in_most_memory = None;
        for (budget_bytes, textures) in budgets {
            let volume = data_set.open(&self.places.scratch, is_cpu.then_some(budget_bytes))?;
            let gpu_memory_bytes = if is_cpu { request.gpu_memory_bytes } else { budget_bytes };
            let renderer = Renderer::new(&volume, RenderRequest { gpu_memory_bytes, ..request.clone() })?;
            let camera = self.plan.views[0].camera(volume.desc());
            let first = renderer.draw(&camera, 1)?;
            let again = renderer.draw(&camera, 1)?;
            let mut times_ms = vec![again.report.time_ms.render];
            times_ms.extend(times_again(&renderer, &camera, self.plan.repeat)?);
            let pixels = first.frame.rgba;
            let compared_with = in_most_memory.get_or_insert_with(|| pixels.clone());
            tell(BudgetPoint {
                data_set: data_set.name.clone(),
                tf: self.tf.to_owned(),
                executor: self.task.executor.name().to_owned(),
                view: self.plan.views[0].name.clone(),
                budget_bytes,
                textures,
                render_ms: Spread::of(&times_ms),
                first: residency(&first.report.residency),
                again: residency(&again.report.residency),
                difference: difference(&pixels, compared_with),
            })?;
        }
        Ok(())
    }

    /// Draws the first view with every α and β; `tell` hears of each.
    ///
    /// # Errors
    /// As of [`Measurement::views`].
    pub fn nearly_empty(
        &self,
        volume: &Volume,
        request: &RenderRequest,
        mut tell: impl FnMut(NearlyEmptyPoint) -> Result<(), BenchError>,
    ) -> Result<(), BenchError> {
        let data_set = &self.plan.data_sets[self.task.data_set];
        let camera = self.plan.views[0].camera(volume.desc());
        let mut exact = None;
        for nearly_empty in NEARLY_EMPTY {
            let renderer = Renderer::new(volume, RenderRequest { nearly_empty, ..request.clone() })?;
            let first = renderer.draw(&camera, 1)?;
            let times_ms = times_again(&renderer, &camera, self.plan.repeat)?;
            let bricks = stages(&first.report.bricks);
            let pixels = first.frame.rgba;
            let compared_with = exact.get_or_insert_with(|| pixels.clone());
            tell(NearlyEmptyPoint {
                data_set: data_set.name.clone(),
                tf: self.tf.to_owned(),
                executor: self.task.executor.name().to_owned(),
                view: self.plan.views[0].name.clone(),
                alpha: nearly_empty.alpha,
                beta: nearly_empty.beta,
                bricks,
                fractions: bricks.fractions(),
                render_ms: Spread::of(&times_ms),
                difference: difference(&pixels, compared_with),
            })?;
        }
        Ok(())
    }
}
