use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use glassbrick_shaders::{Pass, wgsl};

use crate::adapter::{choose, described, is_hardware};
use crate::error::one_line;
use crate::filter_probe::filters_exactly;
use crate::tier::Tier;
use crate::{AdapterChoice, GpuError};

/// An opened GPU.
pub struct GpuDevice {
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
    pub tier: Tier,
    /// As reports name it.
    pub adapter: String,
    trouble: Arc<Mutex<Trouble>>,
    pipelines: Mutex<Pipelines>,
}

/// Pipelines that were made, by pass and, for those that draw, by what they draw into.
#[derive(Default)]
struct Pipelines {
    compute: HashMap<Pass, wgpu::ComputePipeline>,
    render: HashMap<(Pass, Option<wgpu::TextureFormat>), wgpu::RenderPipeline>,
}

/// What a driver said that no call returned.
#[derive(Default)]
struct Trouble {
    lost: Option<String>,
    /// How many errors there were, and the last one.
    errors: usize,
    last: Option<String>,
}

impl GpuDevice {
    /// Opens an adapter.
    ///
    /// # Errors
    /// When there is none, or it cannot draw volumes.
    pub fn open(choice: AdapterChoice) -> Result<Self, GpuError> {
        let adapter = choose(flags(), choice)?;
        let info = adapter.get_info();
        let name = described(&info);
        Tier::check(&adapter, &name)?;
        let request = adapter.request_device(&wgpu::DeviceDescriptor {
            label: Some("glassbrick"),
            required_features: Tier::features(&adapter),
            required_limits: adapter.limits(),
            experimental_features: wgpu::ExperimentalFeatures::disabled(),
            memory_hints: wgpu::MemoryHints::Performance,
            trace: wgpu::Trace::Off,
        });
        let (device, queue) = pollster::block_on(request).map_err(|error| GpuError::NoDevice {
            adapter: name.clone(),
            what: one_line(&error.to_string()),
        })?;
        let trouble = watch(&device);
        let tier = Tier::new(&adapter, &device, |format| filters_exactly(&device, &queue, format));
        Ok(Self { device, queue, tier, adapter: name, trouble, pipelines: Mutex::default() })
    }

    /// Whether this machine has a GPU of its own, and which; no device is opened.
    pub fn hardware() -> Option<String> {
        let adapter = choose(flags(), AdapterChoice::Hardware).ok()?;
        let info = adapter.get_info();
        let name = described(&info);
        (is_hardware(&info) && Tier::check(&adapter, &name).is_ok()).then_some(name)
    }

    /// A pass that computes. Layouts of bindings follow from the pass and the device alone.
    pub fn compute_pipeline(
        &self,
        pass: Pass,
        groups: &[Option<&wgpu::BindGroupLayout>],
    ) -> wgpu::ComputePipeline {
        let make = || {
            let layout = self.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some(pass.name()),
                bind_group_layouts: groups,
                immediate_size: 0,
            });
            self.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(pass.name()),
                layout: Some(&layout),
                module: &self.module(pass),
                entry_point: None,
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                cache: None,
            })
        };
        self.pipelines().compute.entry(pass).or_insert_with(make).clone()
    }

    /// A pass that draws into a format, as `make` makes it.
    pub fn render_pipeline(
        &self,
        pass: Pass,
        format: Option<wgpu::TextureFormat>,
        make: impl FnOnce() -> wgpu::RenderPipeline,
    ) -> wgpu::RenderPipeline {
        self.pipelines().render.entry((pass, format)).or_insert_with(make).clone()
    }

    /// The shader of a pass.
    pub fn module(&self, pass: Pass) -> wgpu::ShaderModule {
        self.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(pass.name()),
            source: wgpu::ShaderSource::Wgsl(wgsl(pass).into()),
        })
    }

    /// Bytes from one part of a uniform buffer to the next, for parts of `bytes`.
    pub fn uniform_stride(&self, bytes: usize) -> u32 {
        (bytes as u32).next_multiple_of(self.device.limits().min_uniform_buffer_offset_alignment)
    }

    fn pipelines(&self) -> MutexGuard<'_, Pipelines> {
        self.pipelines.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits until the device has done all that it was given.
    ///
    /// # Errors
    /// When the device is lost, or what it was given was wrong.
    pub fn wait(&self) -> Result<(), GpuError> {
        loop {
            match self.device.poll(wgpu::PollType::wait_indefinitely()) {
                // OpenGL's driver gives up after two seconds; the work goes on.
                Err(wgpu::PollError::Timeout) => self.check()?,
                Err(error) => return Err(GpuError::driver(&error)),
                Ok(_) => return self.check(),
            }
        }
    }

    /// Whether the device is still there.
    ///
    /// # Errors
    /// When it is lost.
    fn check(&self) -> Result<(), GpuError> {
        match &self.trouble().lost {
            Some(what) => Err(GpuError::Lost { what: what.clone() }),
            None => Ok(()),
        }
    }

    /// What ended a frame: that the device is lost, if it is, whatever was noticed of that first.
    pub fn lost_or(&self, error: GpuError) -> GpuError {
        // Only who asks a device is told of its loss.
        let _ = self.device.poll(wgpu::PollType::Poll);
        self.check().err().unwrap_or(error)
    }

    /// How many errors the driver told of so far.
    pub fn troubles(&self) -> usize {
        self.trouble().errors
    }

    /// Whether the device did well since it had told of so many errors. What several frames at a time were told at once
    /// ends them all: it cannot be known whose error it was.
    ///
    /// # Errors
    /// When it is lost, or something that it was given was wrong.
    pub fn check_since(&self, troubles: usize) -> Result<(), GpuError> {
        self.check()?;
        let trouble = self.trouble();
        match &trouble.last {
            Some(what) if trouble.errors > troubles => Err(GpuError::Driver { what: what.clone() }),
            _ => Ok(()),
        }
    }

    fn trouble(&self) -> MutexGuard<'_, Trouble> {
        self.trouble.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// What wgpu checks: everything where our own code is checked too.
fn flags() -> wgpu::InstanceFlags {
    wgpu::InstanceFlags::from_build_config().with_env()
}

/// Keeps what the driver says.
fn watch(device: &wgpu::Device) -> Arc<Mutex<Trouble>> {
    let trouble = Arc::new(Mutex::new(Trouble::default()));
    let for_errors = Arc::clone(&trouble);
    device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
        let mut trouble = for_errors.lock().unwrap_or_else(PoisonError::into_inner);
        trouble.errors += 1;
        trouble.last = Some(one_line(&error.to_string()));
    }));
    let for_loss = Arc::clone(&trouble);
    device.set_device_lost_callback(move |_, message| {
        let mut trouble = for_loss.lock().unwrap_or_else(PoisonError::into_inner);
        trouble.lost.get_or_insert_with(|| one_line(&message));
    });
    trouble
}
