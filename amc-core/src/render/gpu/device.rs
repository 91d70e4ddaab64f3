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
            Backend::Vulkan => Self::open(wgpu::Backends::VULKAN),
            Backend::Gl => Self::open(wgpu::Backends::GL),
            Backend::Auto => Self::open(wgpu::Backends::VULKAN).or_else(|vulkan| {
                Self::open(wgpu::Backends::GL).map_err(|opengl| Error::device(format!("{vulkan}; {opengl}")))
            }),
        }
    }

    /// The adapter's name, interface and driver, for people.
    pub fn name(&self) -> String {
        let info = self.device.adapter_info();
        format!("{} ({}, {} {})", info.name, info.backend, info.driver, info.driver_info)
    }

    fn open(backends: wgpu::Backends) -> Result<Self> {
        let interface = if backends == wgpu::Backends::VULKAN { "Vulkan" } else { "OpenGL" };
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
        descriptor.backends = backends;
        let instance = wgpu::Instance::new(descriptor);
        let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()))
            .map_err(|error| {
            Error::device(format!(
                "there is no {interface} adapter; install a graphics driver (in software: Mesa)"
            ))
            .because(error)
        })?;
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
            Error::device(format!("the {interface} adapter gives no device: {error}")).because(error)
        })?;
        // The default is a panic. What is checked here is checked in error scopes; this is for the rest.
        device.on_uncaptured_error(Arc::new(|error| log::error!("graphics device: {error}")));
        Ok(Self { device, queue })
    }
}

/// What `make` gives, unless the device finds fault with it.
pub(super) fn checked<T>(device: &wgpu::Device, what: &str, make: impl FnOnce() -> T) -> Result<T> {
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
