//! Parabolas between two features that meet, and the pieces beyond joints nearby.

use centrode_gear::Member;
use centrode_geometry::SegmentJet;

use super::{
    feature_track::{FeatureTrack, rounded},
    features::{Feature, Meeting},
    prover::Prover,
};

/// Curvatures, by the module, by which a parabola keeps from a flank beside a corner, at first and where that does not do.
const CORNER_MARGINS: [f64; 2] = [0.25, 0.05];

/// Shares of the difference of two curvatures by which a parabola keeps from either, at first and where that does not do.
const MARGINS: [f64; 2] = [0.25, 0.05];

/// Share of the difference of two curvatures in the middle of a stretch that has to lie between them all along it.
const MIN_ROOM: f64 = 0.4;

/// Parameter from which on the piece beyond the end counts, too.
const JOINT: f64 = 0.8;

impl Prover<'_> {
    /// Coefficients of parabolas between two features followed along a stretch; empty where none parts them all along it.
    pub(super) fn parabolas(&self, track: &FeatureTrack) -> Option<Vec<f64>> {
        let Feature { parts, corner } = track.feature;
        let (driver, driven) = (
            self.meshing.driver.parts[parts.0].segment,
            self.meshing.driven.parts[parts.1].segment,
        );
        let bend = |jet: &SegmentJet| jet.first.perp(&jet.second) / jet.first.norm().powi(3);
        let curvatures = |at: (f64, f64)| (bend(&driver.at(at.0)), -bend(&driven.at(at.1)));
        // What lies between the contours all along the stretch.
        let mut above = f64::INFINITY;
        let mut below = f64::NEG_INFINITY;
        for at in track.parameters() {
            let (first, second) = curvatures(at);
            (above, below) = (above.min(first), below.max(second));
        }
        let at = track.middle()?.at;
        let here = curvatures(at);
        let apart = CORNER_MARGINS.map(|apart| apart / self.meshing.module);
        // Past a joint nearby it is the curvature of the next piece that counts.
        let next = self.pieces_beyond(parts, at);
        let next = [
            next.0
                .map(|(i, end)| bend(&self.meshing.driver.parts[i].segment.at(end))),
            next.1
                .map(|(i, end)| -bend(&self.meshing.driven.parts[i].segment.at(end))),
        ];
        let between = |above: Option<f64>, below: Option<f64>| Some(0.5 * (above? + below?));
        let all = match corner {
            // They part too little of the stretch.
            None if above - below < MIN_ROOM * (here.0 - here.1) => Vec::new(),
            None => {
                let [far, close] = MARGINS.map(|margin| margin * (above - below));
                // As flat as both contours allow: it parts them the farther from where they meet.
                let flat = 0.0_f64.max(below + far).min(above - far);
                let mut all = vec![flat, below + close, above - close];
                // Beside a sharp bend of the one contour the share is large for the other.
                all.extend(
                    (close > apart[1])
                        .then(|| [below + apart[1], above - apart[1]])
                        .into_iter()
                        .flatten(),
                );
                all.extend(between(Some(above), next[1]));
                all.extend(between(next[0], Some(below)));
                all.extend(between(next[0], next[1]));
                all
            }
            Some((member, _)) => {
                let at_distance = |apart: f64| match member {
                    Member::Driver => 0.0_f64.max(below + apart),
                    Member::Driven => 0.0_f64.min(above - apart),
                };
                let mut all = apart.map(at_distance).to_vec();
                // A corner that has hardly left the flank beside it: that flank's curvature counts, too.
                let close = MARGINS[1] * (above - below);
                if close > 0.0 {
                    all.extend([0.5 * (above + below), below + close, above - close]);
                }
                match member {
                    Member::Driver => all.extend(between(next[0], Some(below))),
                    Member::Driven => all.extend(between(Some(above), next[1])),
                }
                all
            }
        };
        Some(all.into_iter().map(|c| rounded(0.5 * c)).collect())
    }

    /// Pieces beyond the joints that a place of driver and driven gear is near, with the joint's parameter on each.
    fn pieces_beyond(
        &self,
        parts: (usize, usize),
        at: (f64, f64),
    ) -> (Option<PieceEnd>, Option<PieceEnd>) {
        let (driver, driven) = (&self.meshing.driver.parts, &self.meshing.driven.parts);
        (
            piece_beyond(driver.len(), parts.0, at.0),
            piece_beyond(driven.len(), parts.1, at.1),
        )
    }

    /// Pieces beyond joints near a meeting, and those that end at its corner: continued, they meet a little beyond their ends.
    pub(super) fn past_joints(&self, track: &FeatureTrack) -> Vec<(Feature, Meeting)> {
        let Some(meeting) = track.middle() else {
            return Vec::new();
        };
        let (parts, at) = (track.feature.parts, meeting.at);
        let next = self.pieces_beyond(parts, at);
        let here = ((parts.0, at.0), (parts.1, at.1));
        let pairs = [
            track.feature.corner.map(|_| here),
            next.0.map(|first| (first, here.1)),
            next.1.map(|second| (here.0, second)),
            next.0.zip(next.1),
        ];
        pairs
            .into_iter()
            .flatten()
            .map(|((i, u), (j, v))| {
                let feature = Feature {
                    parts: (i, j),
                    corner: None,
                };
                let meeting = Meeting {
                    at: (u, v),
                    angle: meeting.angle,
                };
                (feature, meeting)
            })
            .collect()
    }
}

/// A piece, and the parameter of one of its ends.
type PieceEnd = (usize, f64);

/// Piece beyond the joint near a place of a piece, and the joint's parameter on it.
fn piece_beyond(count: usize, piece: usize, at: f64) -> Option<PieceEnd> {
    let next = if at > 0.0 {
        piece + 1
    } else {
        piece + count - 1
    };
    (at.abs() > JOINT).then_some((next % count, -at.signum()))
}
