//! The work of a device: its programs, its memory, and batches of iterations.

use bytemuck::{Pod, Zeroable};
use wgpu::util::DeviceExt;

use super::super::settings::Steps;
use super::GpuError;
use super::device::Device;
use crate::coast::Weakening;

/// Iterations that can be handed over together. The shader counts with it.
pub(super) const BATCH: usize = 64;

/// Pixels along the side of a work group.
const GROUP: u32 = 16;

/// Bytes from the settings of one iteration to those of the next: what any device can skip.
const STRIDE: usize = 256;

/// An image of land on a device, with the programs that erode it.
#[derive(Debug)]
pub(super) struct Work {
    device: Device,
    size: [usize; 2],
    measure: wgpu::ComputePipeline,
    erode: wgpu::ComputePipeline,
    /// What programs see at iterations of even and of odd number.
    bindings: [wgpu::BindGroup; 2],
    buffers: Buffers,
}

/// The memory of a device.
#[derive(Debug)]
struct Buffers {
    /// Settings of the iterations of a batch, [`STRIDE`] apart.
    settings: wgpu::Buffer,
    /// Land and rock before and after an iteration, in turn.
    cells: [wgpu::Buffer; 2],
    /// Pieces of shore of the tiles, at this iteration and at the next.
    pieces: wgpu::Buffer,
    /// Where the fallen pixels of each iteration of a batch end, and these pixels.
    fallen: wgpu::Buffer,
    /// What the processor can read.
    answer: wgpu::Buffer,
}

/// What fell in a batch of iterations.
#[derive(Debug, Default)]
pub(super) struct Fallen {
    /// Where the pixels of each iteration end.
    pub ends: Vec<u32>,
    /// The pixels, in no order within an iteration.
    pub pixels: Vec<u32>,
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

impl Work {
    /// Bytes of the largest buffer for an image of `size`.
    pub(super) fn bytes(size: [usize; 2]) -> u64 {
        4 * (size[0] * size[1] + BATCH) as u64
    }

    /// Prepares a device for an image.
    pub(super) fn new(device: Device, size: [usize; 2], steps: &Steps) -> Result<Self, GpuError> {
        let (layout, buffers, [measure, erode]) = device.watch(|| {
            let layout = bind_group_layout(&device.device);
            let buffers = Buffers::new(&device, size, steps);
            let programs = programs(&device.device, &layout);
            (layout, buffers, programs)
        })?;
        let bindings = device.watch(|| [0, 1].map(|odd| buffers.bind(&device, &layout, odd)))?;
        Ok(Self { device, size, measure, erode, bindings, buffers })
    }

    /// Name of the device.
    pub(super) fn name(&self) -> &str {
        self.device.name()
    }

    /// Gives the device its land and rock, a word a pixel: the rock in the lower half of its bits,
    /// the land above.
    pub(super) fn put(&self, cells: &[u32]) -> Result<(), GpuError> {
        let Device { queue, .. } = &self.device;
        let cells = bytemuck::cast_slice(cells);
        self.device.watch(|| queue.write_buffer(&self.buffers.cells[0], 0, cells))
    }

    /// Runs some iterations, at most [`BATCH`], and waits for what fell in them.
    pub(super) fn run(&self, iterations: usize) -> Result<Fallen, GpuError> {
        let Buffers { fallen, answer, .. } = &self.buffers;
        self.device.watch(|| {
            self.submit(iterations);
            let ends = self.device.read(fallen, [0, iterations], answer)?;
            let pixels = match ends.last() {
                Some(&all @ 1..) => self.device.read(fallen, [BATCH, all as usize], answer)?,
                _ => Vec::new(),
            };
            Ok(Fallen { ends, pixels })
        })?
    }

    /// Hands iterations to the device. Land begins and ends in the first of the two buffers.
    fn submit(&self, iterations: usize) {
        let Self { device: Device { device, queue, .. }, buffers, .. } = self;
        let mut encoder = device.create_command_encoder(&Default::default());
        encoder.clear_buffer(&buffers.pieces, 0, None);
        encoder.clear_buffer(&buffers.fallen, 0, Some(4 * BATCH as u64));
        let [columns, rows] = self.size.map(|side| (side as u32).div_ceil(GROUP));
        let mut pass = encoder.begin_compute_pass(&Default::default());
        for iteration in 0..iterations {
            let settings = [(iteration * STRIDE) as u32];
            for program in [&self.measure, &self.erode] {
                pass.set_pipeline(program);
                pass.set_bind_group(0, &self.bindings[iteration % 2], &settings);
                pass.dispatch_workgroups(columns, rows, 1);
            }
        }
        drop(pass);
        if iterations % 2 == 1 {
            encoder.copy_buffer_to_buffer(&buffers.cells[1], 0, &buffers.cells[0], 0, None);
        }
        queue.submit([encoder.finish()]);
    }
}

impl Buffers {
    fn new(device: &Device, size: [usize; 2], steps: &Steps) -> Self {
        use wgpu::BufferUsages as Usage;
        let pixels = size[0] * size[1];
        let tiles = (steps.tiles * steps.tiles) as usize;
        let storage = Usage::STORAGE | Usage::COPY_DST | Usage::COPY_SRC;
        let settings = wgpu::util::BufferInitDescriptor {
            label: None,
            contents: &ShaderSettings::of_a_batch(size, steps),
            usage: Usage::UNIFORM,
        };
        Self {
            settings: device.device.create_buffer_init(&settings),
            cells: [(); 2].map(|()| device.buffer(pixels, storage)),
            pieces: device.buffer(4 * tiles, storage),
            fallen: device.buffer(BATCH + pixels, storage),
            answer: device.buffer(BATCH + pixels, Usage::MAP_READ | Usage::COPY_DST),
        }
    }

    /// What programs see at iterations of even number, or of `odd` number.
    fn bind(&self, device: &Device, layout: &wgpu::BindGroupLayout, odd: usize) -> wgpu::BindGroup {
        let settings = wgpu::BufferBinding {
            buffer: &self.settings,
            offset: 0,
            size: wgpu::BufferSize::new(size_of::<ShaderSettings>() as u64),
        };
        let buffers = [&self.cells[odd], &self.cells[1 - odd], &self.pieces, &self.fallen];
        let buffers = buffers.map(wgpu::Buffer::as_entire_binding);
        let all = [wgpu::BindingResource::Buffer(settings)].into_iter().chain(buffers);
        let entries: Vec<_> = (0..)
            .zip(all)
            .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource })
            .collect();
        device.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout,
            entries: &entries,
        })
    }
}

impl ShaderSettings {
    /// The settings of all iterations of a batch, [`STRIDE`] bytes apart.
    fn of_a_batch(size: [usize; 2], steps: &Steps) -> Vec<u8> {
        let mut bytes = vec![0; BATCH * STRIDE];
        for (iteration, place) in (0..).zip(bytes.chunks_exact_mut(STRIDE)) {
            let settings = Self {
                size: size.map(|side| side as u32),
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
            place[..size_of::<Self>()].copy_from_slice(bytemuck::bytes_of(&settings));
        }
        bytes
    }
}

/// The programs that measure the shore and that erode it.
fn programs(device: &wgpu::Device, layout: &wgpu::BindGroupLayout) -> [wgpu::ComputePipeline; 2] {
    let shader = device.create_shader_module(wgpu::include_wgsl!("coast.wgsl"));
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        bind_group_layouts: &[Some(layout)],
        ..Default::default()
    });
    ["measure", "erode"].map(|entry_point| {
        device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(entry_point),
            layout: Some(&layout),
            module: &shader,
            entry_point: Some(entry_point),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        })
    })
}

/// The settings, what is read, and what is written.
fn bind_group_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    use wgpu::BufferBindingType as Kind;
    let read = Kind::Storage { read_only: true };
    let write = Kind::Storage { read_only: false };
    let kinds = [Kind::Uniform, read, write, write, write];
    let entries: Vec<_> = (0..)
        .zip(kinds)
        .map(|(binding, ty)| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty: wgpu::BindingType::Buffer {
                ty,
                has_dynamic_offset: ty == Kind::Uniform,
                min_binding_size: None,
            },
            count: None,
        })
        .collect();
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: None,
        entries: &entries,
    })
}
