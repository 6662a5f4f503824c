//! From the tree as written to the tree made ready.

use std::path::Path;

use landform_sim::random::RandomStream;

use super::blend::BlendSurface;
use super::curve::CurveSurface;
use super::disc::DiscSurface;
use super::onto::{Meeting, OntoSurface};
use super::place::PlaceSurface;
use super::plane::PlaneSurface;
use super::surface::Surface;
use super::vertical::DeformSurface;
use super::warp::WarpSurface;
use super::weigh::WeighSurface;
use super::{NAME, Node, Onto};
use crate::fractal::{Frame, NoiseSurface};
use crate::mask::{MOST_PIXELS, MaskSurface};
use crate::{Mask, SynthError};

/// Most levels of a tree.
const DEEPEST: usize = 50;
/// Most nodes of a tree.
const MOST_NODES: usize = 10_000;
/// Most points of all curves and masks of a tree.
const MOST_POINTS: usize = 100_000;

/// Checks nodes and makes them ready.
pub(super) struct Builder<'a> {
    frame: Frame,
    folder: &'a Path,
    seed: u64,
    nodes: usize,
    points: usize,
    pixels: usize,
}

impl<'a> Builder<'a> {
    /// A builder for noise with this seed and files relative to this folder.
    pub fn new(frame: Frame, folder: &'a Path, seed: u64) -> Self {
        Self { frame, folder, seed, nodes: 0, points: 0, pixels: 0 }
    }

    /// Makes the node at `path` ready, `level` levels below the tree itself.
    pub fn build(
        &mut self,
        node: &Node,
        path: &str,
        level: usize,
    ) -> Result<Box<dyn Surface>, SynthError> {
        self.count(node, level).map_err(|error| error.within(path))?;
        // Every node has random numbers of its own, whatever its siblings.
        let seed = {
            let [low, high, ..] = RandomStream::new(self.seed, path).block(0, 0, 0);
            u64::from(low) | u64::from(high) << 32
        };
        let mut below =
            |child: &Node, name: &str| self.build(child, &format!("{path}{name}"), level + 1);
        let made: Result<Box<dyn Surface>, SynthError> = match node {
            Node::Disc(disc) => boxed(DiscSurface::new(disc, &self.frame, seed)),
            Node::Curve(curve) => boxed(CurveSurface::new(curve)),
            Node::Squig(squig) => {
                let curve = squig.curve(seed).map_err(|error| error.within(path))?;
                self.count_points(curve.points_m.len()).map_err(|error| error.within(path))?;
                boxed(CurveSurface::new(&curve))
            }
            Node::Bell(bell) => boxed(bell.check().map(|()| *bell)),
            Node::Plane(plane) => boxed(PlaneSurface::new(plane)),
            Node::RadialRamp(ramp) => boxed(ramp.check().map(|()| *ramp)),
            Node::Mask(mask) => boxed(self.mask(mask)),
            Node::Raster(raster) => {
                let read = raster.surface(self.folder, self.frame.spacing);
                boxed(read.and_then(|ground| self.counted(ground)))
            }
            Node::Noise(noise) => boxed(NoiseSurface::new(*noise, &self.frame, seed)),
            Node::Blend(children) => {
                let children = children.iter().enumerate();
                let children = children.map(|(number, child)| below(child, &format!("[{number}]")));
                return Ok(Box::new(BlendSurface {
                    children: children.collect::<Result<_, _>>()?,
                }));
            }
            Node::Replace(onto) => return self.onto(Meeting::Replace, onto, path, level),
            Node::Add(onto) => return self.onto(Meeting::Add, onto, path, level),
            Node::Carve(onto) => return self.onto(Meeting::Carve, onto, path, level),
            Node::Raise(onto) => return self.onto(Meeting::Raise, onto, path, level),
            Node::Weigh(weigh) => {
                let of = below(&weigh.of, ".of")?;
                let mask = weigh.mask.as_ref().map(|mask| self.mask(mask)).transpose();
                let mask = mask.map_err(|error| error.within("mask").within(path))?;
                boxed(WeighSurface::new(weigh.weight, mask, of))
            }
            Node::Place(place) => boxed(PlaceSurface::new(place, below(&place.of, ".of")?)),
            Node::Warp(warped) => {
                let of = below(&warped.of, ".of")?;
                boxed(WarpSurface::new(warped.by, of, &self.frame, seed))
            }
            Node::Deform(deform) => {
                let of = below(&deform.of, ".of")?;
                let by = deform.by.clone();
                boxed(by.check().map(|()| DeformSurface { of, by }))
            }
        };
        made.map_err(|error| error.within(path))
    }

    fn onto(
        &mut self,
        meeting: Meeting,
        onto: &Onto,
        path: &str,
        level: usize,
    ) -> Result<Box<dyn Surface>, SynthError> {
        let ground = self.build(&onto.ground, &format!("{path}.ground"), level + 1)?;
        let by = self.build(&onto.by, &format!("{path}.by"), level + 1)?;
        Ok(Box::new(OntoSurface { meeting, ground, by }))
    }

    /// Reads a mask.
    fn mask(&mut self, mask: &Mask) -> Result<MaskSurface, SynthError> {
        self.counted(MaskSurface::new(mask, self.folder, self.frame.spacing)?)
    }

    /// Counts the parts of a mask or a raster.
    fn counted(&mut self, mask: MaskSurface) -> Result<MaskSurface, SynthError> {
        let [points, pixels] = mask.parts();
        self.pixels += pixels;
        within(self.pixels, MOST_PIXELS, "pixels of masks")?;
        self.count_points(points)?;
        Ok(mask)
    }

    fn count_points(&mut self, points: usize) -> Result<(), SynthError> {
        self.points += points;
        within(self.points, MOST_POINTS, "points of curves and masks")
    }

    /// Counts a node and refuses trees that are too large.
    fn count(&mut self, node: &Node, level: usize) -> Result<(), SynthError> {
        self.nodes += 1;
        within(level, DEEPEST, "levels")?;
        within(self.nodes, MOST_NODES, "nodes")?;
        match node {
            Node::Curve(curve) => self.count_points(curve.points_m.len()),
            Node::Blend(children) if children.is_empty() => Err(SynthError::Unusable {
                generator: NAME,
                parameter: "",
                problem: "Blend([]) blends nothing; name one node or more".to_owned(),
            }),
            _ => Ok(()),
        }
    }
}

/// Refuses more than `most` of something.
fn within(count: usize, most: usize, what: &'static str) -> Result<(), SynthError> {
    if count > most {
        return Err(SynthError::TooLarge { generator: NAME, what, most });
    }
    Ok(())
}

fn boxed<S: Surface + 'static>(
    surface: Result<S, SynthError>,
) -> Result<Box<dyn Surface>, SynthError> {
    surface.map(|surface| Box::new(surface) as Box<dyn Surface>)
}
