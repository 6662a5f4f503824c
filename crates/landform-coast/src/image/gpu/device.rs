//! A graphics processor: found, opened, and asked for answers.

use std::sync::mpsc;

use thiserror::Error;

use super::super::ImageCoastError;

/// Why a coast could not be simulated on a graphics processor.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum GpuError {
    /// Settings or fields are wrong.
    #[error(transparent)]
    Coast(#[from] ImageCoastError),
    /// There is no device.
    #[error(
        "no graphics processor was found ({0}); install a driver for Vulkan, Metal, DirectX 12 or \
         OpenGL (a software one will do), or run on the processor"
    )]
    NoDevice(String),
    /// The image does not fit the device.
    #[error("{device} holds fields of at most {most} bytes; the image needs {needed}")]
    TooLarge {
        /// Name of the device.
        device: String,
        /// Bytes that a field can have.
        most: u64,
        /// Bytes that the image needs.
        needed: u64,
    },
    /// The device failed.
    #[error("{device} failed: {message}")]
    Failed {
        /// Name of the device.
        device: String,
        /// What it said.
        message: String,
    },
}

/// A device that is open.
#[derive(Debug)]
pub(super) struct Device {
    name: String,
    pub(super) device: wgpu::Device,
    pub(super) queue: wgpu::Queue,
}

/// The best device that Vulkan, Metal, DirectX 12 or OpenGL offers, and its name, when it can hold
/// fields of `bytes`. Devices of their own come before those of a processor, and software last.
fn find(bytes: u64) -> Result<(wgpu::Adapter, String), GpuError> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let best = wgpu::RequestAdapterOptions {
        power_preference: wgpu::PowerPreference::HighPerformance,
        ..Default::default()
    };
    let adapter = pollster::block_on(instance.request_adapter(&best));
    let adapter = adapter.map_err(|error| GpuError::NoDevice(error.to_string()))?;
    let (info, limits) = (adapter.get_info(), adapter.limits());
    let name = format!("{} ({})", info.name, info.backend);
    let most = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
    match bytes > most {
        true => Err(GpuError::TooLarge { device: name, most, needed: bytes }),
        false => Ok((adapter, name)),
    }
}

impl Device {
    /// Whether there is a device for fields of `bytes`; it is not opened.
    pub(super) fn check(bytes: u64) -> Result<(), GpuError> {
        find(bytes).map(|_| ())
    }

    /// Opens a device for fields of `bytes`.
    pub(super) fn open(bytes: u64) -> Result<Self, GpuError> {
        let (adapter, name) = find(bytes)?;
        let limits = adapter.limits();
        let descriptor = wgpu::DeviceDescriptor { required_limits: limits, ..Default::default() };
        match pollster::block_on(adapter.request_device(&descriptor)) {
            Ok((device, queue)) => Ok(Self { name, device, queue }),
            Err(error) => Err(GpuError::Failed { device: name, message: error.to_string() }),
        }
    }

    /// Name of the device, with the interface that it is reached by.
    pub(super) fn name(&self) -> &str {
        &self.name
    }

    /// A buffer of so many words of 32 bits.
    pub(super) fn buffer(&self, words: usize, usage: wgpu::BufferUsages) -> wgpu::Buffer {
        self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: 4 * words as u64,
            usage,
            mapped_at_creation: false,
        })
    }

    /// Does some work and says how the device failed in it: without this, wgpu panics.
    pub(super) fn watch<T>(&self, work: impl FnOnce() -> T) -> Result<T, GpuError> {
        use wgpu::ErrorFilter::{Internal, OutOfMemory, Validation};
        let scopes = [OutOfMemory, Internal, Validation];
        let scopes = scopes.map(|filter| self.device.push_error_scope(filter));
        let done = work();
        // All of them are closed, the latest first, whichever has something to say.
        let errors = scopes.into_iter().rev().map(|scope| pollster::block_on(scope.pop()));
        match errors.collect::<Vec<_>>().into_iter().flatten().next() {
            Some(error) => Err(self.failure(&error)),
            None => Ok(done),
        }
    }

    /// The words of `buffer` from `start` on, by way of `answer`, which the processor can read.
    pub(super) fn read(
        &self,
        buffer: &wgpu::Buffer,
        [start, words]: [usize; 2],
        answer: &wgpu::Buffer,
    ) -> Result<Vec<u32>, GpuError> {
        let [start, bytes] = [start, words].map(|words| 4 * words as u64);
        let mut encoder = self.device.create_command_encoder(&Default::default());
        encoder.copy_buffer_to_buffer(buffer, start, answer, 0, Some(bytes));
        self.queue.submit([encoder.finish()]);
        let (send, receive) = mpsc::channel();
        answer.map_async(wgpu::MapMode::Read, 0..bytes, move |mapped| {
            // The receiver waits below; if it is gone, nobody wants to know.
            let _ = send.send(mapped);
        });
        let done = self.device.poll(wgpu::PollType::wait_indefinitely());
        done.map_err(|error| self.failure(&error))?;
        let mapped = receive.recv().map_err(|error| self.failure(&error))?;
        mapped.map_err(|error| self.failure(&error))?;
        let view = answer.get_mapped_range(0..bytes);
        let found = bytemuck::pod_collect_to_vec(&view.map_err(|error| self.failure(&error))?);
        answer.unmap();
        Ok(found)
    }

    fn failure(&self, error: &dyn std::error::Error) -> GpuError {
        GpuError::Failed { device: self.name.clone(), message: error.to_string() }
    }
}
