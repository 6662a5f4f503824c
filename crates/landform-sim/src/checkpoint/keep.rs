//! What can be kept in a checkpoint.

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::{Damage, Loader, Saver};

/// Something that a checkpoint keeps.
///
/// Every type that derives serde's `Serialize` and `Deserialize` is kept as it is, as text.
/// Types with many numbers implement this trait themselves, without the derives, and keep them
/// as arrays:
///
/// ```
/// use landform_sim::checkpoint::{Checkpoint, Damage, Keep, Loader, Saver};
///
/// #[derive(Debug, PartialEq)]
/// struct Snow { depth_m: Vec<f64>, melted_m3: f64 }
///
/// impl Keep for Snow {
///     fn save<'a>(&'a self, to: &mut Saver<'_, 'a>) {
///         to.array("depth_m", &self.depth_m);
///         to.value("melted_m3", &self.melted_m3);
///     }
///
///     fn restore(from: &Loader<'_>) -> Result<Self, Damage> {
///         let depth_m = from.array("depth_m")?.to_vec();
///         Ok(Self { depth_m, melted_m3: from.value("melted_m3")? })
///     }
/// }
///
/// let snow = Snow { depth_m: vec![0.5, 0.25], melted_m3: 1.5 };
/// let mut checkpoint = Checkpoint::default();
/// checkpoint.saver("state").keep("snow", &snow);
/// assert_eq!(checkpoint.loader("state").keep::<Snow>("snow"), Ok(snow));
/// ```
pub trait Keep: Sized {
    /// Saves everything that later iterations depend on.
    fn save<'a>(&'a self, to: &mut Saver<'_, 'a>);

    /// Makes it anew from what was saved.
    ///
    /// # Errors
    /// What is missing or cannot be used.
    fn restore(from: &Loader<'_>) -> Result<Self, Damage>;
}

impl<T: Serialize + DeserializeOwned> Keep for T {
    fn save<'a>(&'a self, to: &mut Saver<'_, 'a>) {
        to.value("", self);
    }

    fn restore(from: &Loader<'_>) -> Result<Self, Damage> {
        from.value("")
    }
}
