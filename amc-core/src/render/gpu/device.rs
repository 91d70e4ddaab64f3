//! A graphics device without a window.

use std::sync::Arc;

use crate::{Error, Result};

/// Which graphics interface to use.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Backend {
    /// Vulkan where there is an adapter for it, else OpenGL.
    #[default]
    Auto,
    /// Vulkan only.
    Vulkan,
    /// OpenGL (ES) only.
    Gl,
}

/// A graphics device and its queue.
#[derive(Debug, Clone)]
pub struct Gpu {
    /// The device.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
}

impl Gpu {
    /// A device that needs no window. Adapters in software are accepted. Its limits are those of WebGL 2, but for the
    /// sizes of textures and buffers, which are the adapter's.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Device`]: there is no adapter, or it gives no device.
    pub fn headless(backend: Backend) -> Result<Self> {
        match backend {
            Backend::Vulkan => open(adapter(wgpu::Backends::VULKAN)?),
            Backend::Gl => open(adapter(wgpu::Backends::GL)?),
            Backend::Auto => open(best_adapter()?),
        }
    }

    /// The adapter's name, interface and driver, for people.
    pub fn name(&self) -> String {
        let info = self.device.adapter_info();
        format!("{} ({}, {} {})", info.name, info.backend, info.driver, info.driver_info)
    }
}

/// Vulkan before OpenGL, but a real device before one in software.
fn best_adapter() -> Result<wgpu::Adapter> {
    let in_software = |adapter: &wgpu::Adapter| adapter.get_info().device_type == wgpu::DeviceType::Cpu;
    let vulkan = adapter(wgpu::Backends::VULKAN);
    if vulkan.as_ref().is_ok_and(|found| !in_software(found)) {
        return vulkan;
    }
    match (vulkan, adapter(wgpu::Backends::GL)) {
        (Ok(_), Ok(gl)) if !in_software(&gl) => Ok(gl),
        (Ok(found), _) | (Err(_), Ok(found)) => Ok(found),
        (Err(vulkan), Err(gl)) => Err(Error::device(format!("{vulkan}; {gl}"))),
    }
}

fn adapter(backends: wgpu::Backends) -> Result<wgpu::Adapter> {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = backends;
    let instance = wgpu::Instance::new(descriptor);
    pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default())).map_err(|error| {
        let interface = if backends == wgpu::Backends::VULKAN { "Vulkan" } else { "OpenGL" };
        Error::device(format!(
            "there is no {interface} adapter; install a graphics driver (in software: Mesa)"
        ))
        .because(error)
    })
}

fn open(adapter: wgpu::Adapter) -> Result<Gpu> {
    let limits = wgpu::Limits {
        max_buffer_size: adapter.limits().max_buffer_size,
        ..wgpu::Limits::downlevel_webgl2_defaults().using_resolution(adapter.limits())
    };
    let descriptor = wgpu::DeviceDescriptor {
        label: Some("amc"),
        required_limits: limits,
        ..wgpu::DeviceDescriptor::default()
    };
    let (device, queue) = pollster::block_on(adapter.request_device(&descriptor)).map_err(|error| {
        let info = adapter.get_info();
        Error::device(format!("{} ({}) gives no device: {error}", info.name, info.backend)).because(error)
    })?;
    // The default is a panic. What is checked here is checked in error scopes; this is for the rest.
    device.on_uncaptured_error(Arc::new(|error| log::error!("graphics device: {error}")));
    Ok(Gpu { device, queue })
}

/// What `make` gives, unless the device finds fault with it.
///
/// # Errors
/// [`crate::ErrorKind::Device`]: too little memory for `what`, or a fault in its making.
pub fn checked<T>(device: &wgpu::Device, what: &str, make: impl FnOnce() -> T) -> Result<T> {
    let memory = device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
    let validation = device.push_error_scope(wgpu::ErrorFilter::Validation);
    let made = make();
    let validation = pollster::block_on(validation.pop());
    let memory = pollster::block_on(memory.pop());
    match validation.or(memory) {
        None => Ok(made),
        Some(error @ wgpu::Error::OutOfMemory { .. }) => {
            Err(Error::device(format!("not enough graphics memory for {what}")).because(error))
        }
        Some(error) => Err(Error::device(format!("{what}: {error}"))),
    }
}
