use std::cell::RefCell;

use centrode_gear::{GearPair, Tooth, ToothSide};

use super::facing_points::{self, FacingParts, FacingPoints};
use crate::contact::contour::{
    DividedStretch, GearOutline, PairCache, Pose, PoseTolerance, Stretch,
};

/// Search distance of points that face each other, modules. A larger one takes longer, a smaller one misses clearances.
const NEAR: f64 = 0.3;

/// Initial search distance of flanks, modules. It grows if no contact is within it. A larger one takes longer at every
/// sample, a smaller one must grow more often.
const CLOSE: f64 = 0.05;

/// Pair under analysis, with search distances and results of the previous pose.
#[derive(Debug)]
pub(crate) struct Meshing<'a> {
    pub(in crate::contact) pair: &'a GearPair,
    pub(in crate::contact) driver: GearOutline<'a>,
    pub(in crate::contact) driven: GearOutline<'a>,
    /// Parts of the driven gear as stretches about its axis.
    pub(in crate::contact) stretches: Vec<DividedStretch>,
    pub(in crate::contact) module: f64,
    /// Whether all teeth are complete: not undercut, not cut through and not shortened at the tip.
    pub(super) has_complete_teeth: bool,
    /// Search distance of points that face each other, mm.
    pub(in crate::contact) search_distance: f64,
    /// Search distance of flanks, which touch or nearly do, mm.
    pub(super) flank_distance: f64,
    /// Parts that faced each other at the previous sample.
    pub(super) previous_facing: Vec<FacingParts>,
    /// Parts that are near each other in poses close to the last one.
    pub(super) pair_cache: RefCell<PairCache>,
    pub(in crate::contact) pose_tolerance: PoseTolerance,
}

/// Points at which two flanks face each other, and their parts.
pub(in crate::contact) struct FacingFlanks {
    pub(in crate::contact) parts: (usize, usize),
    pub(in crate::contact) points: FacingPoints,
}

impl<'a> Meshing<'a> {
    pub(in crate::contact) fn new(pair: &'a GearPair) -> Self {
        let near = NEAR * pair.module() + 2.0 * pair.backlash();
        let [driver, driven] = GearOutline::pair(pair.driver(), pair.driven(), near);
        let parts = driven.parts.iter().enumerate();
        Self {
            pair,
            stretches: parts
                .map(|(j, part)| DividedStretch::new(Stretch::from_part(j, part, |p| *p, |v| *v)))
                .collect(),
            pair_cache: RefCell::default(),
            pose_tolerance: PoseTolerance::new(pair, near),
            driver,
            driven,
            module: pair.module(),
            has_complete_teeth: has_complete_teeth(pair),
            search_distance: near,
            flank_distance: CLOSE * pair.module() + 2.0 * pair.backlash(),
            previous_facing: Vec::new(),
        }
    }

    /// Forgets the previous sample.
    pub(in crate::contact) fn forget_previous(&mut self) {
        self.previous_facing.clear();
    }

    /// Points at which two flanks face each other, by Newton's method from known parameters. Searched in this order:
    ///
    /// 1. on the given parts;
    /// 2. on their neighbours of the same flanks;
    /// 3. beyond the ends of the flanks.
    pub(in crate::contact) fn along_flanks(
        &self,
        (i, j): (usize, usize),
        at: (f64, f64),
        pose: &Pose,
    ) -> Option<FacingFlanks> {
        let facing = |i: usize, j: usize, at: (f64, f64)| {
            let (a, b) = (&self.driver.parts[i], &self.driven.parts[j]);
            let points = facing_points::facing_parts(a, b, pose, at)
                .or_else(|| self.facing_sharp_bend((i, j), pose))?;
            Some(FacingFlanks {
                parts: (i, j),
                points,
            })
        };
        facing(i, j, at).or_else(|| {
            let near = [self.driver.along_flank(i), self.driven.along_flank(j)];
            let [first, second] = &near;
            let pairs = first
                .iter()
                .flat_map(|&i| second.iter().map(move |&j| (i, j)));
            let mut neighbours = pairs.filter(|&pair| pair != (i, j));
            neighbours
                .find_map(|(i, j)| facing(i, j, (0.0, 0.0)))
                .or_else(|| {
                    let (a, b) = (&self.driver.parts[i], &self.driven.parts[j]);
                    Some(FacingFlanks {
                        parts: (i, j),
                        points: facing_points::facing_beyond_ends(a, b, pose, at)?,
                    })
                })
        })
    }
}

/// Whether all teeth of both gears are complete: not undercut, not cut through and not shortened at the tip.
pub(in crate::contact) fn has_complete_teeth(pair: &GearPair) -> bool {
    let complete = |side: &ToothSide| side.undercut == 0.0 && side.tip_shortening == 0.0;
    let mut teeth = pair.driver().teeth().iter().chain(pair.driven().teeth());
    teeth.all(|tooth: &Tooth| {
        !tooth.cut_through && complete(&tooth.leading) && complete(&tooth.trailing)
    })
}
