use std::f64::consts::TAU;

use centrode_gear::{GearPair, Member};
use centrode_geometry::checkpoint;
use centrode_kinematics::machine::Piecewise;
use centrode_kinematics::transmission::Transmission;
use centrode_spec::Design;

use super::{
    certificate::{Proof, ProofError, ProofMeeting, ProofStretch, contour},
    feature_track::{self, FeatureSample, FeatureTrack, Side},
    features::{Feature, FeatureCorner, FeatureMeeting, Meeting},
    sectors::sectors,
};
use crate::contact::contour::Pose;
use crate::contact::seat::Meshing;

/// Half of the width of the proven interval of every seat, rad. It must exceed the rounding of contour and seat. Ten
/// times more weakens the statement of the certificate, ten times less fails by rounding.
pub(super) const HALF_WIDTH: f64 = 4e-10;

/// Missing room above which there is no certificate, modules at the centre distance. A smaller one is rounding of the
/// seats.
const OVERLAP: f64 = 1e-4;

/// Stretches per driver pitch at the start; they are cut further if necessary. More stretches make a larger
/// certificate, fewer need more cuts.
const STRETCHES: u32 = 4;

/// Length of a stretch below which it is not cut, rad. Then there is no certificate. Ten times more gives up too early,
/// ten times less comes near the rounding of the driver angle.
pub(super) const SHORTEST: f64 = 1e-8;

/// Sum of the last two coefficients of a series up to which it is exact, in the unit of the series. It must be far
/// below [`HALF_WIDTH`]; a smaller one needs shorter stretches.
pub(super) const TAIL: f64 = 1e-11;

/// Maximum gap of features that get a parabola, modules. A larger one makes the certificate larger, a smaller one
/// leaves more work to the checker.
const NEAR: f64 = 0.05;

/// Maximum gap of features for which a stretch is cut, modules. A checker separates features farther apart by circles around small
/// parts.
const CUT_GAP: f64 = 2e-3;

/// Length of a stretch below which it is not cut for a better parabola, rad. A shorter one makes more stretches, a
/// longer one accepts stretches without a parabola.
const SHORT: f64 = 1e-5;

/// Makes the certificate of a pair's contact, for a checker to prove.
///
/// # Errors
/// [`ProofError`] naming the driver angle at which the gears do not hold each other, or cannot be followed.
pub fn prove(pair: &GearPair) -> Result<Proof, ProofError> {
    let law = Piecewise::fit(pair.rolling());
    let driver = contour(pair.driver(), Member::Driver)?;
    let driven = contour(pair.driven(), Member::Driven)?;
    let sectors = sectors(
        [&driver, &driven],
        &law,
        pair.mean_ratio(),
        pair.center_distance(),
    );
    let mut prover = Prover {
        meshing: Meshing::new(pair),
        law: &law,
        stretches: Vec::new(),
    };
    prover.cover_sector(sectors)?;
    prover.check_continuity()?;
    let stretches = prover.stretches;
    Ok(Proof {
        format: "centrode-proof".to_owned(),
        version: 3,
        design: pair.design().to_toml()?,
        pair: pair.name().to_owned(),
        center_distance: pair.center_distance(),
        cycle: pair.cycle(),
        half_width: HALF_WIDTH,
        driver,
        driven,
        sectors,
        stretches,
        law,
    })
}

/// Search for the certificate of a pair.
pub(super) struct Prover<'a> {
    pub(super) meshing: Meshing<'a>,
    law: &'a Piecewise,
    /// Stretches done, in the order of the driver angle.
    pub(super) stretches: Vec<ProofStretch>,
}

impl Prover<'_> {
    /// Adds the stretches of the first of `sectors` equal parts of the cycle.
    fn cover_sector(&mut self, sectors: u32) -> Result<(), ProofError> {
        let pair = self.meshing.pair;
        let rolling = pair.rolling();
        let teeth = pair.driver().tooth_count() * pair.mean_ratio().0;
        let length = rolling.pitch_length(Member::Driver) * f64::from(pair.mean_ratio().0);
        let count = teeth * STRETCHES;
        let at =
            |i: u32| rolling.angle(rolling.parameter(length * f64::from(i) / f64::from(count)));
        let start = at(0);
        let law_ends: Vec<f64> = (0..pair.mean_ratio().0)
            .flat_map(|turn| {
                self.law
                    .ends()
                    .iter()
                    .map(move |end| end + TAU * f64::from(turn))
            })
            .collect();
        let end = pair.cycle() / f64::from(sectors);
        // A stretch must lie on one piece of the law.
        let is_at_end = |cut: f64| law_ends.iter().any(|end| (cut - end).abs() < SHORTEST);
        let mut cuts: Vec<f64> = (1..count)
            .map(|i| at(i) - start)
            .filter(|&cut| !is_at_end(cut))
            .chain(law_ends.iter().copied())
            .collect();
        cuts.retain(|c| *c > SHORTEST && *c < end - SHORTEST);
        cuts.sort_by(f64::total_cmp);
        cuts.dedup_by(|b, a| *b - *a < SHORTEST);
        cuts.push(end);
        let mut before = self.sample(0.0)?;
        for cut in cuts {
            let after = self.sample(cut)?;
            self.cover(before, after.clone())?;
            before = after;
        }
        Ok(())
    }

    /// Adds the stretches between two samples, cut as often as needed.
    fn cover(&mut self, from: FeatureSample, to: FeatureSample) -> Result<(), ProofError> {
        let mut open = vec![(from, to)];
        while let Some((from, to)) = open.pop() {
            checkpoint();
            let middle = self.sample(0.5 * (from.phi + to.phi))?;
            let sides = [Side::On, Side::Back].map(|side| self.side(side, [&from, &middle, &to]));
            let cut = sides.iter().find_map(|found| match found {
                SideResult::Cut(phi) => Some(*phi),
                SideResult::Held { .. } => None,
            });
            if let Some(phi) = cut {
                if to.phi - from.phi < SHORTEST {
                    return Err(ProofError::Unresolved { phi });
                }
                let between = self.sample(phi)?;
                open.push((between.clone(), to));
                open.push((from, between));
                continue;
            }
            let mut stretch = ProofStretch {
                from: from.phi,
                to: to.phi,
                seats: [Vec::new(), Vec::new()],
                held_by: [0; 2],
                meetings: Vec::new(),
            };
            for (side, found) in sides.into_iter().enumerate() {
                if let SideResult::Held { seat, tracks } = found {
                    stretch.seats[side] = seat;
                    stretch.held_by[side] = stretch.meetings.len();
                    stretch.meetings.extend(tracks);
                }
            }
            self.stretches.push(stretch);
        }
        Ok(())
    }

    /// Features that hold the driven gear on one side over a whole stretch, or the driver angle at which to cut it.
    fn side(&self, side: Side, samples: [&FeatureSample; 3]) -> SideResult {
        let [from, middle, to] = samples.map(|s| s.phi);
        let mut tracks: Vec<FeatureTrack> = Vec::new();
        for sample in samples {
            for known in &sample.holding[side as usize] {
                if !tracks.iter().any(|t| t.feature == known.feature) {
                    let track = FeatureTrack::new(&self.meshing, (from, to), sample.phi, *known);
                    tracks.extend(track);
                }
            }
        }
        let holds = |track: &&FeatureTrack| {
            (0..feature_track::SAMPLES).all(|k| track.holds(k, &tracks, side))
        };
        let Some(holder) = tracks.iter().find(holds) else {
            let cut = feature_track::cut(&self.meshing, &tracks, (from, to), side);
            return SideResult::Cut(cut.unwrap_or(middle));
        };
        let seat = |phi: f64, meeting: &Meeting| meeting.angle - self.law.at(phi).position;
        let Some(seat) = holder.series(seat) else {
            return SideResult::Cut(middle);
        };
        let Some(first) = self.proof_meeting(holder, side) else {
            return SideResult::Cut(middle);
        };
        let is_short = to - from < SHORT;
        if first.bends.is_empty() && !is_short {
            return SideResult::Cut(middle);
        }
        let mut out = vec![first];
        let mut known = vec![holder.feature];
        let mut followed = Vec::new();
        for sample in samples {
            for near in &sample.near[side as usize] {
                if known.contains(&near.feature) {
                    continue;
                }
                known.push(near.feature);
                let track = FeatureTrack::new(&self.meshing, (from, to), sample.phi, *near);
                let Some(track) = track else { continue };
                let is_close = 0.5 * track.backlash(holder) * self.meshing.pair.center_distance()
                    < CUT_GAP * self.meshing.module;
                if is_close && let Some(phi) = track.end_of_part(&self.meshing, (from, to)) {
                    return SideResult::Cut(phi);
                }
                let hint = self.proof_meeting(&track, side);
                // Features that almost touch over the whole stretch need a parabola.
                let lacks_parabola = || hint.as_ref().is_none_or(|hint| hint.bends.is_empty());
                if is_close && !is_short && track.is_on_parts() && lacks_parabola() {
                    return SideResult::Cut(middle);
                }
                out.extend(hint);
                followed.push(track);
            }
        }
        followed.push(holder.clone());
        for track in followed {
            for next in self.past_joints(&track) {
                if known.contains(&next.feature) {
                    continue;
                }
                known.push(next.feature);
                let track = FeatureTrack::new(&self.meshing, (from, to), middle, next);
                out.extend(track.and_then(|track| self.proof_meeting(&track, side)));
            }
        }
        out.retain(|hint| !hint.bends.is_empty());
        SideResult::Held { seat, tracks: out }
    }

    /// The entry of a feature in the certificate; `None` if its series are not exact.
    fn proof_meeting(&self, track: &FeatureTrack, side: Side) -> Option<ProofMeeting> {
        let u = track.series(|_, m| m.at.0)?;
        let v = track.series(|_, m| m.at.1)?;
        let Feature { parts, corner } = track.feature;
        Some(ProofMeeting {
            side: side as usize,
            pieces: [parts.0, parts.1],
            corner: corner.map(|corner| usize::from(corner.member == Member::Driven)),
            parameters: [u, v],
            bends: self.parabolas(track)?,
        })
    }

    /// Features that hold the driven gear at a driver angle, and features near each other there.
    fn sample(&mut self, phi: f64) -> Result<FeatureSample, ProofError> {
        let a = self.meshing.pair.center_distance();
        let law = self.law.at(phi).position;
        let candidates = self.meshing.candidates(&Pose::new(phi, law, a));
        let mut out = FeatureSample {
            phi,
            ..FeatureSample::default()
        };
        let seats = self.meshing.seats(&candidates, phi, law);
        if let [Some(on), Some(back)] = &seats {
            let overlap = on.angle - back.angle;
            if overlap * a > OVERLAP * self.meshing.module {
                return Err(ProofError::NoRoom { phi, overlap });
            }
        }
        for (side, seat) in [Side::On, Side::Back].into_iter().zip(seats) {
            let seat = seat.ok_or(ProofError::Apart { phi })?;
            out.holding[side as usize] = seat.features();
            let pose = Pose::new(phi, seat.angle, a);
            let mut near = self.meshing.candidates(&pose);
            for proximity in self.meshing.proximities(&mut near, &pose) {
                let points = proximity.points;
                let is_far = points.gap.abs() > NEAR * self.meshing.module;
                if points.lever * side.sign() <= 0.0 || is_far {
                    continue;
                }
                let feature = Feature {
                    parts: proximity.parts,
                    corner: proximity
                        .corner
                        .map(|member| FeatureCorner { member, end: -1.0 }),
                };
                let meeting = Meeting {
                    at: points.at,
                    angle: seat.angle - points.gap / points.lever,
                };
                out.near[side as usize].push(FeatureMeeting { feature, meeting });
            }
        }
        Ok(out)
    }
}

/// Outcome of a search along a stretch on one side.
enum SideResult {
    /// The series of the seat, and all meetings, the one that holds the gear first.
    Held {
        seat: Vec<f64>,
        tracks: Vec<ProofMeeting>,
    },
    /// Driver angle at which to cut the stretch, rad.
    Cut(f64),
}
