//! From the tree as written to the tree made ready.

use std::path::Path;

use landform_sim::random::RandomStream;

use super::change::{InstancesSolid, RoughSolid, WarpedSolid};
use super::combine::{Blended, BlendedSolid, Meeting};
use super::shapes::{BallSolid, GroundSolid, TubeSolid};
use super::solid::Solid;
use super::{NAME, VolumeNode};
use crate::{SynthError, Terrain};

/// Most levels of a tree.
const DEEPEST: usize = 50;
/// Most nodes, points of tubes and places of instances of a tree.
const MOST_PARTS: usize = 10_000;

/// Checks nodes and makes them ready.
pub(super) struct Builder<'a> {
    pub folder: &'a Path,
    /// Distance of voxels in metres.
    pub spacing: f64,
    pub seed: u64,
    pub parts: usize,
}

type Made = Result<Box<dyn Solid>, SynthError>;

impl Builder<'_> {
    /// Makes the node at `path` ready, `level` levels below the tree itself.
    pub fn build(&mut self, node: &VolumeNode, path: &str, level: usize) -> Made {
        let here = |error: SynthError| error.within(path);
        self.count(node, level).map_err(here)?;
        // Every node has random numbers of its own, whatever its siblings.
        let stream = RandomStream::new(self.seed, path);
        match node {
            VolumeNode::Ball(ball) => {
                ball.check().map_err(here)?;
                Ok(Box::new(BallSolid { ball: *ball, stream }))
            }
            VolumeNode::Tube(tube) => Ok(Box::new(TubeSolid::new(tube).map_err(here)?)),
            VolumeNode::Block(block) => {
                block.check().map_err(here)?;
                Ok(Box::new(*block))
            }
            VolumeNode::Ground(node) => {
                let terrain = Terrain::of_node(node, path, self.folder, self.spacing, self.seed)?;
                Ok(Box::new(GroundSolid(terrain)))
            }
            VolumeNode::Union(blended) => self.blended(Meeting::Union, blended, path, level),
            VolumeNode::Intersection(blended) => {
                self.blended(Meeting::Intersection, blended, path, level)
            }
            VolumeNode::Difference(cut) => {
                let width = checked_width(cut.width_m).map_err(here)?;
                let of = self.build(&cut.of, &format!("{path}.of"), level + 1)?;
                let by = self.build(&cut.by, &format!("{path}.by"), level + 1)?;
                let of = vec![of, by];
                Ok(Box::new(BlendedSolid { meeting: Meeting::Difference, of, width }))
            }
            VolumeNode::Instances(instances) => {
                let of = self.build(&instances.of, &format!("{path}.of"), level + 1)?;
                Ok(Box::new(InstancesSolid::new(of, &instances.at).map_err(here)?))
            }
            VolumeNode::Warp(noised) => {
                noised.by.check(NAME).map_err(|error| error.within("by").within(path))?;
                let of = self.build(&noised.of, &format!("{path}.of"), level + 1)?;
                let axis = |name| RandomStream::new(self.seed, &format!("{path} {name}"));
                let streams = ["east", "north", "up"].map(axis);
                Ok(Box::new(WarpedSolid { of, by: noised.by, streams }))
            }
            VolumeNode::Rough(noised) => {
                noised.by.check(NAME).map_err(|error| error.within("by").within(path))?;
                let of = self.build(&noised.of, &format!("{path}.of"), level + 1)?;
                Ok(Box::new(RoughSolid { of, by: noised.by, stream }))
            }
        }
    }

    fn blended(&mut self, meeting: Meeting, blended: &Blended, path: &str, level: usize) -> Made {
        let here = |error: SynthError| error.within(path);
        let width = checked_width(blended.width_m).map_err(here)?;
        if blended.of.is_empty() {
            let problem = "there is nothing to put together; name one solid or more".to_owned();
            return Err(here(SynthError::Unusable { generator: NAME, parameter: "of", problem }));
        }
        let children = blended.of.iter().enumerate();
        let of: Result<Vec<_>, _> = children
            .map(|(number, child)| self.build(child, &format!("{path}.of[{number}]"), level + 1))
            .collect();
        Ok(Box::new(BlendedSolid { meeting, of: of?, width }))
    }

    /// Counts a node and refuses trees that are too large.
    fn count(&mut self, node: &VolumeNode, level: usize) -> Result<(), SynthError> {
        self.parts += 1 + match node {
            VolumeNode::Tube(tube) => tube.points_m.len(),
            VolumeNode::Instances(instances) => instances.at.len(),
            _ => 0,
        };
        let too_large = |what, most| Err(SynthError::TooLarge { generator: NAME, what, most });
        match (level > DEEPEST, self.parts > MOST_PARTS) {
            (true, _) => too_large("levels", DEEPEST),
            (_, true) => too_large("nodes, points and instances", MOST_PARTS),
            _ => Ok(()),
        }
    }
}

fn checked_width(width: f64) -> Result<f64, SynthError> {
    crate::error::Checks(NAME).range("width_m", width, 0.0..=1e9).map(|()| width)
}
