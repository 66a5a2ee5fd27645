use std::collections::BTreeSet;

use wgpu::DeviceType;

use crate::GpuError;

/// Which of a machine's adapters is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AdapterChoice<'a> {
    /// The best there is: hardware before software.
    Best,
    /// The best hardware; never a driver that computes on the CPU.
    Hardware,
    /// The first whose name contains this, in upper or lower case.
    Named(&'a str),
}

/// The adapter of a choice. OpenGL is looked at last, and only when a GPU is asked for: starting it is slow, and its
/// drivers print what nobody asked for.
pub fn choose(flags: wgpu::InstanceFlags, choice: AdapterChoice) -> Result<wgpu::Adapter, GpuError> {
    let mut there = adapters(flags, wgpu::Backends::PRIMARY);
    let mut found = best(&there, choice);
    if found.is_none() && choice != AdapterChoice::Hardware {
        there.extend(adapters(flags, wgpu::Backends::GL));
        found = best(&there, choice);
    }
    match (found, choice) {
        (Some(found), _) => Ok(there.swap_remove(found)),
        (None, AdapterChoice::Named(name)) => {
            Err(GpuError::NoAdapterOfThatName { name: name.to_owned(), there: names(&there) })
        }
        (None, AdapterChoice::Best | AdapterChoice::Hardware) => Err(GpuError::NoAdapter),
    }
}

/// All adapters of some interfaces, the best first.
fn adapters(flags: wgpu::InstanceFlags, backends: wgpu::Backends) -> Vec<wgpu::Adapter> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends,
        flags,
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    });
    let mut adapters = pollster::block_on(instance.enumerate_adapters(backends));
    adapters.sort_by_key(|adapter| rank(&adapter.get_info()));
    adapters
}

/// Which of the adapters, ordered from the best on, a choice means.
fn best(adapters: &[wgpu::Adapter], choice: AdapterChoice) -> Option<usize> {
    adapters.iter().position(|adapter| {
        let info = adapter.get_info();
        match choice {
            AdapterChoice::Best => true,
            AdapterChoice::Hardware => is_hardware(&info),
            AdapterChoice::Named(name) => info.name.to_lowercase().contains(&name.to_lowercase()),
        }
    })
}

/// Whether an adapter is a device of its own, and no driver that computes on the CPU.
pub fn is_hardware(info: &wgpu::AdapterInfo) -> bool {
    info.device_type != DeviceType::Cpu
}

/// An adapter as reports name it.
pub fn described(info: &wgpu::AdapterInfo) -> String {
    let driver = [info.driver.as_str(), info.driver_info.as_str()]
        .into_iter()
        .filter(|part| !part.is_empty())
        .collect::<Vec<_>>()
        .join(" ");
    let driver = if driver.is_empty() { driver } else { format!(", {driver}") };
    format!("{}, {}{driver}", info.name, info.backend)
}

fn names(adapters: &[wgpu::Adapter]) -> String {
    // One device may be there by several interfaces.
    let names: BTreeSet<String> = adapters.iter().map(|adapter| adapter.get_info().name).collect();
    if names.is_empty() { "none".to_owned() } else { names.into_iter().collect::<Vec<_>>().join(", ") }
}

/// What is faster comes first; of one device, the interface that can do more.
fn rank(info: &wgpu::AdapterInfo) -> (u32, u32) {
    let device = match info.device_type {
        DeviceType::DiscreteGpu => 0,
        DeviceType::IntegratedGpu => 1,
        DeviceType::VirtualGpu => 2,
        DeviceType::Other => 3,
        DeviceType::Cpu => 4,
    };
    let interface = match info.backend {
        wgpu::Backend::Vulkan | wgpu::Backend::Metal => 0,
        wgpu::Backend::Dx12 => 1,
        wgpu::Backend::BrowserWebGpu => 2,
        wgpu::Backend::Gl => 3,
        wgpu::Backend::Noop => 4,
    };
    (device, interface)
}
