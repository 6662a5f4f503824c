//! Image coasts on a graphics processor, through wgpu.
//!
//! The device runs batches of iterations ahead of the land and lists the pixels that fall in each
//! of them. So land is brought up to date iteration by iteration, and neither it nor anything else
//! of the size of the image travels back.

mod device;
mod work;

pub use device::GpuError;

use super::{ImageCoastError, ImageCoastSettings, numbers};
use device::Device;
use work::{BATCH, Fallen, Work};

/// A coast as an image on a graphics processor: the same land as
/// [`ImageCoast`](super::ImageCoast), bit for bit.
///
/// wgpu runs it on Vulkan, Metal, DirectX 12 or OpenGL: on a device of its own if there is one, on
/// one that exists in software only if there is no other.
#[derive(Debug)]
pub struct GpuCoast {
    work: Work,
    resistance: Vec<u16>,
    /// The land as it is before the iteration `next`; empty while the device holds none.
    land: Vec<u8>,
    /// What fell in the latest batch.
    ahead: Fallen,
    /// Iterations of the latest batch that the land has seen.
    next: usize,
}

impl GpuCoast {
    /// Whether there is a device for an image of `size` columns and rows.
    ///
    /// # Errors
    /// [`GpuError::NoDevice`] and [`GpuError::TooLarge`].
    pub fn check(size: [usize; 2]) -> Result<(), GpuError> {
        Device::check(Work::bytes(size))
    }

    /// Hands a coast to the best device that is found: an image of `size` columns and rows with a
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
        let device = Device::open(Work::bytes(size))?;
        Ok(Self {
            work: Work::new(device, size, &settings.steps(size))?,
            resistance: resistance.iter().map(|&u| numbers::resistance(u)).collect(),
            land: Vec::new(),
            ahead: Fallen::default(),
            next: 0,
        })
    }

    /// The device, with the interface that it is reached by.
    pub fn device(&self) -> &str {
        self.work.name()
    }

    /// As [`ImageCoast::run`](super::ImageCoast::run).
    ///
    /// # Errors
    /// [`ImageCoastError::Length`] and [`GpuError::Failed`].
    pub fn run(&mut self, land: &mut [u8], most: usize) -> Result<usize, GpuError> {
        self.follow(land)?;
        for iteration in 0..most {
            if self.advance(land)? == 0 {
                return Ok(iteration);
            }
        }
        Ok(most)
    }

    /// As [`ImageCoast::step`](super::ImageCoast::step). Land may change between steps; what the
    /// device did ahead is then void.
    ///
    /// # Errors
    /// [`ImageCoastError::Length`] and [`GpuError::Failed`].
    pub fn step(&mut self, land: &mut [u8]) -> Result<usize, GpuError> {
        self.follow(land)?;
        self.advance(land)
    }

    /// Gives the device the land, unless it is the one that the device works on.
    fn follow(&mut self, land: &[u8]) -> Result<(), GpuError> {
        let (expected, found) = (self.resistance.len(), land.len());
        if found != expected {
            return Err(ImageCoastError::Length { field: "land", expected, found }.into());
        }
        if self.land != land {
            let cell = |(&land, &rock): (&u8, &u16)| u32::from(land > 0) << 16 | u32::from(rock);
            let cells: Vec<u32> = land.iter().zip(&self.resistance).map(cell).collect();
            self.land.clear();
            self.work.put(&cells)?;
            self.land.extend_from_slice(land);
            (self.ahead, self.next) = (Fallen::default(), 0);
        }
        Ok(())
    }

    /// Brings the land, which is that of the device, to the next iteration. Returns the number of
    /// pixels that fell.
    fn advance(&mut self, land: &mut [u8]) -> Result<usize, GpuError> {
        if self.next == self.ahead.ends.len() {
            self.look_ahead()?;
        }
        let end = |iteration: usize| self.ahead.ends[iteration] as usize;
        let start = if self.next == 0 { 0 } else { end(self.next - 1) };
        let fallen = &self.ahead.pixels[start..end(self.next)];
        for &pixel in fallen {
            land[pixel as usize] = 0;
            self.land[pixel as usize] = 0;
        }
        // A coast at rest stays so: its last iteration is that of all times.
        self.next += usize::from(!fallen.is_empty());
        Ok(fallen.len())
    }

    /// Has the device run a batch twice as long as the latest one, up to [`BATCH`]: where somebody
    /// else changes the land, little is done in vain.
    fn look_ahead(&mut self) -> Result<(), GpuError> {
        let batch = (2 * self.ahead.ends.len()).clamp(1, BATCH);
        match self.work.run(batch) {
            Ok(fallen) => (self.ahead, self.next) = (fallen, 0),
            Err(error) => {
                // Nobody knows what the device holds now.
                self.land.clear();
                return Err(error);
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coast::Weakening;
    use crate::image::ImageCoast;
    use crate::image::testing::{device, island};

    /// A coast on a device and on the processor, and its land; `None` without a device.
    fn both(
        size: [usize; 2],
        settings: ImageCoastSettings,
    ) -> Option<(GpuCoast, ImageCoast, Vec<u8>)> {
        device()?;
        let (land, rock) = island(size, 11);
        let there = GpuCoast::new(size, settings, &rock).unwrap();
        Some((there, ImageCoast::new(size, settings, &rock).unwrap(), land))
    }

    #[test]
    fn a_device_gives_the_land_of_the_processor() {
        let weakening = [Weakening::Share, Weakening::Power, Weakening::None];
        let sizes = [([96, 96], 2), ([100, 36], 1), ([64, 32], 4)];
        for ((weakening, force), (size, offset)) in
            weakening.into_iter().zip([0.5, 0.6, 0.7]).zip(sizes)
        {
            let settings =
                ImageCoastSettings { force, weakening, offset, ..ImageCoastSettings::default() };
            // An odd number of iterations, part of a batch, and as many as it takes.
            for most in [7, 1000] {
                let Some((mut there, mut here, land)) = both(size, settings) else { return };
                let mut lands = [land.clone(), land.clone()];
                let iterations = there.run(&mut lands[0], most).unwrap();
                assert_eq!(iterations, here.run(&mut lands[1], most).unwrap());
                assert!(iterations > 4, "{iterations}");
                assert!(lands[0] == lands[1], "{weakening:?}, {most} iterations");
                assert!(lands[0] != land && lands[0].contains(&1));
            }
        }
    }

    #[test]
    fn every_iteration_is_that_of_the_processor_even_if_land_changes_in_between() {
        let settings = ImageCoastSettings { force: 0.55, ..ImageCoastSettings::default() };
        let Some((mut there, mut here, land)) = both([96, 64], settings) else { return };
        let mut lands = [land.clone(), land];
        for iteration in 0..300 {
            // In the midst of a batch, and at rest.
            if [20, 21, 250].contains(&iteration) {
                for land in &mut lands {
                    land[40 * 96 + 20..40 * 96 + 60].fill(u8::from(iteration == 21));
                }
            }
            let fallen = lands.each_mut().map(|land| land.as_mut_slice());
            let [first, second] = fallen;
            assert_eq!(there.step(first).unwrap(), here.step(second).unwrap(), "{iteration}");
            assert!(lands[0] == lands[1], "{iteration}");
        }
    }

    #[test]
    fn fields_of_the_wrong_length_are_refused() {
        let settings = ImageCoastSettings::default();
        let refused = GpuCoast::new([8, 8], settings, &[0.5; 3]).unwrap_err();
        assert!(matches!(refused, GpuError::Coast(ImageCoastError::Length { .. })), "{refused}");
        let Some((mut there, ..)) = both([8, 8], settings) else { return };
        let refused = there.step(&mut [1; 3]).unwrap_err();
        assert!(matches!(refused, GpuError::Coast(ImageCoastError::Length { .. })), "{refused}");
    }

    #[test]
    fn images_beyond_any_device_are_refused() {
        if device().is_none() {
            return;
        }
        let refused = GpuCoast::check([1 << 22, 1 << 22]).unwrap_err();
        assert!(matches!(refused, GpuError::TooLarge { .. }), "{refused}");
    }
}
