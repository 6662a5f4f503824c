//! Image coasts on a graphics processor, through wgpu.

use std::sync::mpsc;

use bytemuck::{Pod, Zeroable};
use thiserror::Error;
use wgpu::util::DeviceExt;

use super::numbers;
use super::settings::Steps;
use super::{ImageCoastError, ImageCoastSettings};
use crate::coast::Weakening;

/// Iterations that are handed over together: the answer is waited for once a batch.
const BATCH: u32 = 50;

/// Pixels along the side of a work group.
const GROUP: u32 = 16;

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

/// A coast as an image on a graphics processor: the same land as
/// [`ImageCoast`](super::ImageCoast), bit for bit.
///
/// wgpu runs it on Vulkan, Metal, DirectX 12 or OpenGL, whatever is found first, devices that
/// exist in software only included.
#[derive(Debug)]
pub struct GpuCoast {
    name: String,
    device: wgpu::Device,
    queue: wgpu::Queue,
    steps: Steps,
    size: [usize; 2],
    measure: wgpu::ComputePipeline,
    erode: wgpu::ComputePipeline,
    layout: wgpu::BindGroupLayout,
    resistance: wgpu::Buffer,
    /// Land before and after an iteration, in turn.
    land: [wgpu::Buffer; 2],
    pieces: wgpu::Buffer,
    fallen: wgpu::Buffer,
    /// What comes back from the device.
    answer: wgpu::Buffer,
}

/// Settings as the shader has them.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct ShaderSettings {
    size: [u32; 2],
    tile: [u32; 2],
    tiles: u32,
    side: u32,
    force: u32,
    attenuation: u32,
    weakening: u32,
    iteration: u32,
}

impl GpuCoast {
    /// Hands a coast to the first device that is found: an image of `size` columns and rows with a
    /// `resistance` of 0 to 1 a pixel.
    ///
    /// # Errors
    /// See [`GpuError`].
    pub fn new(
        size: [usize; 2],
        settings: ImageCoastSettings,
        resistance: &[f64],
    ) -> Result<Self, GpuError> {
        settings.validate(size)?;
        let (expected, found) = (size[0] * size[1], resistance.len());
        if found != expected {
            return Err(ImageCoastError::Length { field: "resistance", expected, found }.into());
        }
        pollster::block_on(Self::open(size, settings.steps(size), resistance))
    }

    async fn open(size: [usize; 2], steps: Steps, resistance: &[f64]) -> Result<Self, GpuError> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
        let no_device = |error: &dyn std::error::Error| GpuError::NoDevice(error.to_string());
        let adapter = instance.request_adapter(&wgpu::RequestAdapterOptions::default()).await;
        let adapter = adapter.map_err(|error| no_device(&error))?;
        let info = adapter.get_info();
        let name = format!("{} ({})", info.name, info.backend);
        let bytes = 4 * resistance.len() as u64;
        let limits = adapter.limits();
        let most = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
        if bytes > most {
            return Err(GpuError::TooLarge { device: name, most, needed: bytes });
        }
        let descriptor = wgpu::DeviceDescriptor { required_limits: limits, ..Default::default() };
        let (device, queue) =
            adapter.request_device(&descriptor).await.map_err(|error| no_device(&error))?;
        let rock: Vec<u32> =
            resistance.iter().map(|&u| u32::from(numbers::resistance(u))).collect();
        Ok(Self::on_device(name, device, queue, size, steps, &rock))
    }

    fn on_device(
        name: String,
        device: wgpu::Device,
        queue: wgpu::Queue,
        size: [usize; 2],
        steps: Steps,
        rock: &[u32],
    ) -> Self {
        use wgpu::BufferUsages as Usage;
        let shader = device.create_shader_module(wgpu::include_wgsl!("coast.wgsl"));
        let layout = bind_group_layout(&device);
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            bind_group_layouts: &[Some(&layout)],
            ..Default::default()
        });
        let pipeline = |entry_point| {
            device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(entry_point),
                layout: Some(&pipeline_layout),
                module: &shader,
                entry_point: Some(entry_point),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                cache: None,
            })
        };
        let buffer = |words: usize, usage| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: None,
                size: 4 * words as u64,
                usage,
                mapped_at_creation: false,
            })
        };
        let pixels = rock.len();
        let tiles = (steps.tiles * steps.tiles) as usize;
        let storage = Usage::STORAGE | Usage::COPY_DST | Usage::COPY_SRC;
        Self {
            measure: pipeline("measure"),
            erode: pipeline("erode"),
            resistance: device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: None,
                contents: bytemuck::cast_slice(rock),
                usage: Usage::STORAGE,
            }),
            land: [buffer(pixels, storage), buffer(pixels, storage)],
            pieces: buffer(2 * tiles * BATCH as usize, storage),
            fallen: buffer(BATCH as usize, storage),
            answer: buffer(pixels.max(BATCH as usize), Usage::MAP_READ | Usage::COPY_DST),
            layout,
            name,
            device,
            queue,
            steps,
            size,
        }
    }

    /// The device, with the interface that it is reached by.
    pub fn device(&self) -> &str {
        &self.name
    }

    /// As [`ImageCoast::run`](super::ImageCoast::run).
    ///
    /// # Errors
    /// [`ImageCoastError::Length`] and [`GpuError::Failed`].
    pub fn run(&mut self, land: &mut [u8], most: usize) -> Result<usize, GpuError> {
        let (expected, found) = (self.size[0] * self.size[1], land.len());
        if found != expected {
            return Err(ImageCoastError::Length { field: "land", expected, found }.into());
        }
        let errors = [
            self.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory),
            self.device.push_error_scope(wgpu::ErrorFilter::Validation),
        ];
        let words: Vec<u32> = land.iter().map(|&land| u32::from(land)).collect();
        self.queue.write_buffer(&self.land[0], 0, bytemuck::cast_slice(&words));
        let iterations = self.batches(most);
        for scope in errors.into_iter().rev() {
            if let Some(error) = pollster::block_on(scope.pop()) {
                return Err(self.failure(&error));
            }
        }
        let iterations = iterations?;
        // Batches have an even number of iterations, so the land ends where it began.
        for (land, word) in land.iter_mut().zip(self.read(&self.land[0], expected)?) {
            *land = word as u8;
        }
        Ok(iterations)
    }

    /// Runs batch after batch until nothing falls. Returns the number of iterations in which
    /// something fell.
    fn batches(&self, most: usize) -> Result<usize, GpuError> {
        let mut done = 0;
        while done < most {
            let batch = (most - done).min(BATCH as usize);
            self.submit(batch as u32);
            let fallen = self.read(&self.fallen, batch)?;
            if let Some(rest) = fallen.iter().position(|&fallen| fallen == 0) {
                return Ok(done + rest);
            }
            done += batch;
        }
        Ok(most)
    }

    /// Hands a batch of iterations to the device.
    fn submit(&self, batch: u32) {
        let mut encoder = self.device.create_command_encoder(&Default::default());
        encoder.clear_buffer(&self.pieces, 0, None);
        encoder.clear_buffer(&self.fallen, 0, None);
        let groups = self.size.map(|side| (side as u32).div_ceil(GROUP));
        for iteration in 0..batch {
            let bindings = self.bindings(iteration);
            for pipeline in [&self.measure, &self.erode] {
                let mut pass = encoder.begin_compute_pass(&Default::default());
                pass.set_pipeline(pipeline);
                pass.set_bind_group(0, &bindings, &[]);
                pass.dispatch_workgroups(groups[0], groups[1], 1);
            }
        }
        if batch % 2 == 1 {
            encoder.copy_buffer_to_buffer(&self.land[1], 0, &self.land[0], 0, None);
        }
        self.queue.submit([encoder.finish()]);
    }

    fn bindings(&self, iteration: u32) -> wgpu::BindGroup {
        let steps = &self.steps;
        let settings = ShaderSettings {
            size: self.size.map(|side| side as u32),
            tile: steps.tile,
            tiles: steps.tiles,
            side: steps.side,
            force: steps.force,
            attenuation: steps.attenuation,
            weakening: match steps.weakening {
                Weakening::None => 0,
                Weakening::Share => 1,
                Weakening::Power => 2,
            },
            iteration,
        };
        let settings = self.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: None,
            contents: bytemuck::bytes_of(&settings),
            usage: wgpu::BufferUsages::UNIFORM,
        });
        let [before, after] = match iteration % 2 {
            0 => [&self.land[0], &self.land[1]],
            _ => [&self.land[1], &self.land[0]],
        };
        let buffers = [&settings, &self.resistance, before, after, &self.pieces, &self.fallen];
        let entries: Vec<_> = (0..)
            .zip(buffers)
            .map(|(binding, buffer)| wgpu::BindGroupEntry {
                binding,
                resource: buffer.as_entire_binding(),
            })
            .collect();
        self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &self.layout,
            entries: &entries,
        })
    }

    /// The first words of a buffer.
    fn read(&self, buffer: &wgpu::Buffer, words: usize) -> Result<Vec<u32>, GpuError> {
        let bytes = 4 * words as u64;
        let mut encoder = self.device.create_command_encoder(&Default::default());
        encoder.copy_buffer_to_buffer(buffer, 0, &self.answer, 0, Some(bytes));
        self.queue.submit([encoder.finish()]);
        let (send, receive) = mpsc::channel();
        self.answer.map_async(wgpu::MapMode::Read, 0..bytes, move |mapped| {
            // The receiver waits below; if it is gone, nobody wants to know.
            let _ = send.send(mapped);
        });
        self.device
            .poll(wgpu::PollType::wait_indefinitely())
            .map_err(|error| self.failure(&error))?;
        let mapped = receive.recv().map_err(|error| self.failure(&error))?;
        mapped.map_err(|error| self.failure(&error))?;
        let view = self.answer.get_mapped_range(0..bytes);
        let view = view.map_err(|error| self.failure(&error))?;
        let found = bytemuck::pod_collect_to_vec(&view);
        drop(view);
        self.answer.unmap();
        Ok(found)
    }

    fn failure(&self, error: &dyn std::error::Error) -> GpuError {
        GpuError::Failed { device: self.name.clone(), message: error.to_string() }
    }
}

/// The settings, what is read, and what is written.
fn bind_group_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    use wgpu::BufferBindingType as Kind;
    let read = Kind::Storage { read_only: true };
    let write = Kind::Storage { read_only: false };
    let kinds = [Kind::Uniform, read, read, write, write, write];
    let entries: Vec<_> = (0..)
        .zip(kinds)
        .map(|(binding, ty)| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty: wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None },
            count: None,
        })
        .collect();
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: None,
        entries: &entries,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::ImageCoast;
    use crate::image::testing::island;

    /// The coast on the device and that on the processor; `None`, and a word, without a device.
    fn both(settings: ImageCoastSettings, side: usize, most: usize) -> Option<[Vec<u8>; 2]> {
        let size = [side, side];
        let (land, rock) = island(size, 11);
        let mut coast = match GpuCoast::new(size, settings, &rock) {
            Err(GpuError::NoDevice(error)) => {
                eprintln!("not tested: no graphics processor ({error})");
                return None;
            }
            coast => coast.unwrap(),
        };
        eprintln!("tested on {}", coast.device());
        let [mut there, mut here] = [land.clone(), land];
        let iterations = coast.run(&mut there, most).unwrap();
        let mut coast = ImageCoast::new(size, settings, &rock).unwrap();
        assert_eq!(iterations, coast.run(&mut here, most).unwrap());
        Some([there, here])
    }

    #[test]
    fn a_device_gives_the_land_of_the_processor() {
        let weakening = [Weakening::Share, Weakening::Power, Weakening::None];
        for (weakening, force) in weakening.into_iter().zip([0.5, 0.6, 0.7]) {
            let settings = ImageCoastSettings { force, weakening, ..Default::default() };
            // An odd number of iterations, part of a batch, and as many as it takes.
            for most in [7, 1000] {
                let Some([there, here]) = both(settings, 96, most) else { return };
                assert!(there == here, "{weakening:?}, {most} iterations");
                assert!(here.contains(&0) && here.contains(&1));
            }
        }
    }

    #[test]
    fn fields_of_the_wrong_length_are_refused() {
        let settings = ImageCoastSettings::default();
        let refused = GpuCoast::new([8, 8], settings, &[0.5; 3]).unwrap_err();
        assert!(matches!(refused, GpuError::Coast(ImageCoastError::Length { .. })), "{refused}");
    }
}
