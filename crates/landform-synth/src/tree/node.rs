//! The nodes of a tree, as scenarios write them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Bell, Curve, Deform, Disc, Onto, Place, Plane, RadialRamp, Squig, Warped, Weigh};
use crate::{FractalNoise, Mask, RasterGround};

/// A node of a construction tree: a landform, or what is made of others. Each is documented, with
/// its equation and its bound of the slope, where its parameters are.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum Node {
    /// A hill or a massif over a disc.
    Disc(Disc),
    /// A river bed, a valley or a ridge along a curve.
    Curve(Curve),
    /// The same along a curve that winds as rivers do.
    Squig(Squig),
    /// A hill with the profile of a bell curve.
    Bell(Bell),
    /// A plane, level or tilted.
    Plane(Plane),
    /// A funnel or a cone without end.
    RadialRamp(RadialRamp),
    /// The values of a mask as heights, of weight 1 everywhere. L is their difference over the
    /// width of the edge, or the largest from pixel to pixel.
    Mask(Mask),
    /// The heights of a raster file, whose cells may be much larger than the spacing.
    Raster(RasterGround),
    /// Octaves of noise everywhere; those below the spacing are left out. L is the sum of what
    /// octaves and their cascade can rise together, 1 + the slope of the warp times that if there
    /// is one; the noise rarely comes near it where octaves are many.
    Noise(FractalNoise),
    /// The mean of several, weighted by their weights: `h = sum(a_i h_i) / sum(a_i)`,
    /// `a = sum(a_i)`. L is the largest of theirs plus M over the least total weight, where M is
    /// the lesser of `sum(D_i A_i)` and `(n - 1) D max(A_i)`, and `D_i` and D are the largest
    /// differences in height from the i-th and between any two; F is that of a total weight of 1.
    Blend(Vec<Node>),
    /// `by` in place of `ground`: `h = (1 - b) h_ground + b h_by`, where b is the weight of `by`,
    /// 1 at most. L is the lesser of max(L, L) and L + F, plus D times A of `by`.
    Replace(Onto),
    /// `by` on top of `ground`: `h = h_ground + b h_by`. L + F + max |h_by| times A of `by`.
    Add(Onto),
    /// `by` cut into `ground`, which it never raises: as `Replace` where `by` is lower.
    Carve(Onto),
    /// `by` heaped on `ground`, which it never lowers: as `Replace` where `by` is higher.
    Raise(Onto),
    /// Another weight.
    Weigh(Weigh),
    /// Moved, turned and scaled: one landform at several places.
    Place(Place),
    /// On bent ground.
    Warp(Warped),
    /// Heights changed: terraces, glaciation, canyonism, any curve.
    Deform(Deform),
}
