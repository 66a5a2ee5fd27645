use std::fmt;
use std::sync::Arc;

use glassbrick_gpu::{AdapterChoice, GpuDevice};

use crate::Error;
use crate::platform::may_have_a_gpu;

/// What draws.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Backend {
    #[default]
    Cpu,
    Gpu(Gpu),
}

/// An opened GPU, to be shared by all that draws on it.
#[derive(Clone)]
pub struct Gpu(Arc<GpuDevice>);

impl Gpu {
    /// Opens the adapter whose name contains `name`, or else the best: hardware before drivers that compute on the CPU.
    ///
    /// # Errors
    /// When there is none, or it cannot draw volumes.
    pub fn open(name: Option<&str>) -> Result<Self, Error> {
        let choice = name.map_or(AdapterChoice::Best, AdapterChoice::Named);
        Ok(Self(Arc::new(GpuDevice::open(choice)?)))
    }

    /// Opens the best hardware GPU; nothing where there is none that can draw volumes.
    pub fn open_hardware() -> Option<Self> {
        let device = may_have_a_gpu().then(|| GpuDevice::open(AdapterChoice::Hardware));
        device.and_then(Result::ok).map(|device| Self(Arc::new(device)))
    }

    /// The hardware GPU that `open_hardware` would open, by name.
    pub fn hardware() -> Option<String> {
        may_have_a_gpu().then(GpuDevice::hardware).flatten()
    }

    /// Its name, interface and driver.
    pub fn adapter(&self) -> &str {
        &self.0.adapter
    }

    /// Whether it is a driver that computes on the CPU.
    pub fn is_software(&self) -> bool {
        self.0.tier.is_software
    }

    pub(crate) fn device(&self) -> &Arc<GpuDevice> {
        &self.0
    }
}

impl Backend {
    /// A hardware GPU if there is one, the CPU otherwise. A driver that computes on the CPU is never taken: the CPU's own
    /// code is faster.
    pub fn auto() -> Self {
        Gpu::open_hardware().map_or(Self::Cpu, Self::Gpu)
    }
}

/// A device that was opened, and perhaps told to do with less, by `glassbrick-gpu`.
impl From<GpuDevice> for Gpu {
    fn from(device: GpuDevice) -> Self {
        Self(Arc::new(device))
    }
}

impl PartialEq for Gpu {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl fmt::Debug for Gpu {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Gpu").field(&self.adapter()).finish()
    }
}
