//! Parabolas between two features that meet, and the pieces beyond joints close to them.

use centrode_gear::Member;
use centrode_geometry::SegmentJet;

use super::{
    feature_track::{FeatureTrack, rounded},
    features::{Feature, FeatureCorner, FeatureMeeting, Meeting},
    prover::Prover,
};
use crate::contact::contour::OutlinePart;

/// Curvature margins tried for the separating parabola at a corner, 1/module: first, then fallback. A large margin is
/// easy to check, a small one fits between close contours.
const CORNER_MARGINS: [f64; 2] = [0.25, 0.05];

/// Curvature margins tried between two smooth parts, as a share of the difference of their curvatures: first, then
/// fallback. A large margin is easy to check, a small one fits between close contours.
const MARGINS: [f64; 2] = [0.25, 0.05];

/// Minimum room between the curvatures over a whole stretch, as a share of their difference in its middle. With less
/// room the stretch is cut. A larger value cuts more stretches, a smaller one leaves parabolas that separate too
/// little.
const MIN_ROOM: f64 = 0.4;

/// Magnitude of the parameter (1 is the end) above which the next piece counts too. A larger one can miss its
/// curvature, a smaller one makes the parabolas needlessly narrow.
const JOINT: f64 = 0.8;

impl Prover<'_> {
    /// Coefficients of parabolas between two features along a stretch, 1/mm; empty if none separates them all along it.
    pub(super) fn parabolas(&self, track: &FeatureTrack) -> Option<Vec<f64>> {
        let Feature { parts, corner } = track.feature;
        let (driver, driven) = (
            self.meshing.driver.parts[parts.0].span.segment,
            self.meshing.driven.parts[parts.1].span.segment,
        );
        let curvature = |jet: &SegmentJet| jet.first.perp(&jet.second) / jet.first.norm().powi(3);
        let curvatures =
            |at: (f64, f64)| (curvature(&driver.at(at.0)), -curvature(&driven.at(at.1)));
        // The range of curvatures between the contours over the whole stretch.
        let mut above = f64::INFINITY;
        let mut below = f64::NEG_INFINITY;
        for at in track.parameters() {
            let (first, second) = curvatures(at);
            (above, below) = (above.min(first), below.max(second));
        }
        let at = track.middle()?.at;
        let here = curvatures(at);
        let margins = CORNER_MARGINS.map(|margin| margin / self.meshing.module);
        // Beyond a joint close to the meeting the curvature of the next piece counts.
        let at_joint = |parts: &[OutlinePart<'_>], p: PiecePoint| {
            curvature(&parts[p.piece].span.segment.at(p.u))
        };
        let [first, second] = self.pieces_beyond(parts, at);
        let next = [
            first.map(|p| at_joint(&self.meshing.driver.parts, p)),
            second.map(|p| -at_joint(&self.meshing.driven.parts, p)),
        ];
        let between = |above: Option<f64>, below: Option<f64>| Some(0.5 * (above? + below?));
        let all = match corner {
            // Parabolas would separate the contours on too little of the stretch.
            None if above - below < MIN_ROOM * (here.0 - here.1) => Vec::new(),
            None => {
                let [far, close] = MARGINS.map(|margin| margin * (above - below));
                // As flat as both contours allow: a flat parabola separates them farther from the meeting.
                let flat = 0.0_f64.max(below + far).min(above - far);
                let mut all = vec![flat, below + close, above - close];
                // Next to a sharp bend of one contour the share is too large a margin for the other.
                all.extend(
                    (close > margins[1])
                        .then(|| [below + margins[1], above - margins[1]])
                        .into_iter()
                        .flatten(),
                );
                all.extend(between(Some(above), next[1]));
                all.extend(between(next[0], Some(below)));
                all.extend(between(next[0], next[1]));
                all
            }
            Some(FeatureCorner { member, .. }) => {
                let at_distance = |margin: f64| match member {
                    Member::Driver => 0.0_f64.max(below + margin),
                    Member::Driven => 0.0_f64.min(above - margin),
                };
                let mut all = margins.map(at_distance).to_vec();
                // A corner close to the end of its contact with the adjacent flank: the curvature of that flank counts too.
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

    /// Pieces of driver and driven gear beyond the joints close to a meeting.
    fn pieces_beyond(&self, parts: (usize, usize), at: (f64, f64)) -> [Option<PiecePoint>; 2] {
        let (driver, driven) = (&self.meshing.driver.parts, &self.meshing.driven.parts);
        [
            piece_beyond(driver.len(), parts.0, at.0),
            piece_beyond(driven.len(), parts.1, at.1),
        ]
    }

    /// Meetings of the pieces beyond joints close to a meeting, and of the pieces that end at its corner, all extrapolated a
    /// little beyond their ends.
    pub(super) fn past_joints(&self, track: &FeatureTrack) -> Vec<FeatureMeeting> {
        let Some(meeting) = track.middle() else {
            return Vec::new();
        };
        let (parts, at) = (track.feature.parts, meeting.at);
        let [first, second] = self.pieces_beyond(parts, at);
        let here = (
            PiecePoint {
                piece: parts.0,
                u: at.0,
            },
            PiecePoint {
                piece: parts.1,
                u: at.1,
            },
        );
        let pairs = [
            track.feature.corner.map(|_| here),
            first.map(|first| (first, here.1)),
            second.map(|second| (here.0, second)),
            first.zip(second),
        ];
        pairs
            .into_iter()
            .flatten()
            .map(|(first, second)| FeatureMeeting {
                feature: Feature {
                    parts: (first.piece, second.piece),
                    corner: None,
                },
                meeting: Meeting {
                    at: (first.u, second.u),
                    angle: meeting.angle,
                },
            })
            .collect()
    }
}

/// Point of a piece by its parameter.
#[derive(Clone, Copy)]
struct PiecePoint {
    piece: usize,
    u: f64,
}

/// Joint on the next piece, if a point of a piece is close to it.
fn piece_beyond(count: usize, piece: usize, at: f64) -> Option<PiecePoint> {
    let next = if at > 0.0 {
        piece + 1
    } else {
        piece + count - 1
    };
    (at.abs() > JOINT).then_some(PiecePoint {
        piece: next % count,
        u: -at.signum(),
    })
}
