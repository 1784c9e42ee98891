//! Certificate of a pair's contact at every real driver angle, for another program to check.
//!
//! The cycle is cut into stretches. On each the seat of the driven gear, pushed on and pushed back, is a Chebyshev
//! series, and so are the parameters of every two features of the contours that meet or nearly do. Where two features
//! meet a parabola parts the two contours; a checker proves that either contour stays on its own side of it while the
//! driven gear is half a width beyond the seat, and that the contours cross when it is half a width before it. All
//! that comes from the contours and the law alone: nothing said here has to be believed.

mod meeting;
mod track;

use std::f64::consts::TAU;

use centrode_geometry::{Segment, chebyshev_series, checkpoint};
use centrode_mechanism::design::{Design, DesignError};
use centrode_mechanism::gear::{Gear, GearPair, Member};
use centrode_mechanism::machine::Piecewise;
use centrode_mechanism::transmission::Transmission;
use schemars::JsonSchema;
use serde::Serialize;

use super::{meshing::Meshing, touch::Pose};
pub(super) use meeting::{Feature, Meeting};
use track::{Sample, Side, Track};

/// Half of the width of every proven seat, rad.
const HALF_WIDTH: f64 = 4e-10;

/// Stretches a driver pitch to begin with.
const STRETCHES: u32 = 4;

/// Shortest stretch, rad.
const SHORTEST: f64 = 1e-8;

/// Last coefficients of a series, in the series' own unit, below which it is exact.
const TAIL: f64 = 1e-11;

/// Greatest gap, in modules, of features that get a parabola of their own.
const NEAR: f64 = 0.05;

/// Curvature, by the module, by which a parabola keeps from the flank that a corner meets.
const APART: f64 = 0.25;

/// Share of the difference of two curvatures by which a parabola keeps from either.
const MARGIN: f64 = 0.25;

/// Certificate of a pair's contact at every driver angle of its cycle: lengths in mm, angles in rad.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub struct Proof {
    /// Always `centrode-proof`.
    pub format: String,
    /// Version of the format.
    pub version: u32,
    /// The design the pair was made from, as a design file.
    pub design: String,
    /// Centre distance, mm.
    pub center_distance: f64,
    /// Module, mm.
    pub module: f64,
    /// Driver angle of a whole cycle, rad.
    pub cycle: f64,
    /// Driven angle by driver angle in pieces.
    pub law: Piecewise,
    /// Greatest distance of these pieces from the law, rad, as measured between the places where they agree.
    pub law_rounding: f64,
    /// Half of the width of the interval in which every seat lies, rad.
    pub half_width: f64,
    /// The driver's contour, counter-clockwise: of each piece the coefficients in u from -1 to 1, constant first, [x, y] in mm.
    pub driver: Vec<Vec<[f64; 2]>>,
    /// The driven gear's contour.
    pub driven: Vec<Vec<[f64; 2]>>,
    /// Stretches of the cycle from 0 on, each starting where the one before it ends.
    pub stretches: Vec<ProofStretch>,
}

/// Stretch of the cycle on which the same two features hold the driven gear.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub struct ProofStretch {
    /// First driver angle, rad.
    pub from: f64,
    /// Last driver angle, rad.
    pub to: f64,
    /// Chebyshev coefficients of the seat less the law, rad: pushed on, pushed back.
    pub seats: [Vec<f64>; 2],
    /// Which of the meetings holds the driven gear: pushed on, pushed back.
    pub held_by: [usize; 2],
    /// Features that meet or nearly do.
    pub meetings: Vec<ProofMeeting>,
}

/// Features of the two contours that meet when the driven gear is turned.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub struct ProofMeeting {
    /// 0 where it holds the gear pushed on, 1 pushed back.
    pub side: usize,
    /// Pieces of the driver's and of the driven gear's contour.
    pub pieces: [usize; 2],
    /// The gear that meets the other with a corner, 0 the driver, 1 the driven gear; neither where it is left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub corner: Option<usize>,
    /// Chebyshev coefficients of the parameters on the two pieces.
    pub parameters: [Vec<f64>; 2],
    /// Coefficient k of the parabola y = k x^2 that parts the contours, in axes along their tangent, 1/mm.
    pub bend: f64,
}

impl Proof {
    /// The file, the same bytes every time.
    ///
    /// # Errors
    /// [`serde_json::Error`] for a certificate that cannot be written.
    pub fn file(&self) -> serde_json::Result<Vec<u8>> {
        let mut bytes = serde_json::to_vec(self)?;
        bytes.push(b'\n');
        Ok(bytes)
    }

    /// The JSON schema of the file.
    #[must_use]
    pub fn schema() -> serde_json::Value {
        schemars::schema_for!(Self).to_value()
    }
}

/// Reason why there is no certificate.
#[derive(Debug, thiserror::Error)]
pub enum ProofError {
    /// The design cannot be written.
    #[error(transparent)]
    Design(#[from] DesignError),
    /// Nothing holds the driven gear.
    #[error(
        "the gears do not hold each other at the driver angle {phi:.6} rad: nothing can be proved of a mesh that has come apart"
    )]
    Apart {
        /// Driver angle, rad.
        phi: f64,
    },
    /// What holds the gear changes too often.
    #[error(
        "what holds the driven gear at the driver angle {phi:.9} rad cannot be told within {SHORTEST} rad"
    )]
    Unresolved {
        /// Driver angle, rad.
        phi: f64,
    },
    /// A contour has a piece that is no polynomial.
    #[error("piece {piece} of the {}'s contour is an arc, the proof knows polynomials alone", .member.name())]
    Arc {
        /// Which gear.
        member: Member,
        /// Which piece, from 0.
        piece: usize,
    },
}

/// Makes the certificate of a pair's contact, for a checker to prove.
///
/// # Errors
/// [`ProofError`] naming the driver angle at which the gears do not hold each other, or cannot be followed.
pub fn prove(pair: &GearPair) -> Result<Proof, ProofError> {
    let law = Piecewise::fit(pair.rolling());
    let mut prover = Prover {
        meshing: Meshing::new(pair),
        law: &law,
        out: Vec::new(),
    };
    prover.cycle()?;
    let stretches = prover.out;
    Ok(Proof {
        format: "centrode-proof".to_owned(),
        version: 1,
        design: pair.design().to_toml()?,
        center_distance: pair.center_distance(),
        module: pair.module(),
        cycle: pair.cycle(),
        law_rounding: rounding(&law, pair),
        half_width: HALF_WIDTH,
        driver: contour(pair.driver(), Member::Driver)?,
        driven: contour(pair.driven(), Member::Driven)?,
        stretches,
        law,
    })
}

/// Coefficients of a contour's pieces.
fn contour(gear: &Gear, member: Member) -> Result<Vec<Vec<[f64; 2]>>, ProofError> {
    let segments = gear.outline().segments().iter().enumerate();
    let coefficients = |(piece, segment): (usize, &Segment)| match segment {
        Segment::Poly(poly) => Ok(poly.coefficients().iter().map(|c| [c.x, c.y]).collect()),
        Segment::Line(start, end) => {
            let middle = nalgebra::center(start, end);
            let half = (end - start) * 0.5;
            Ok(vec![[middle.x, middle.y], [half.x, half.y]])
        }
        Segment::Arc(_) => Err(ProofError::Arc { member, piece }),
    };
    segments.map(coefficients).collect()
}

/// Greatest distance of the pieces from the law where they are farthest from agreeing: between their nodes.
fn rounding(law: &Piecewise, pair: &GearPair) -> f64 {
    let off = |phi: f64| (law.at(phi).position - pair.driven_angle(phi)).abs();
    let between = |ends: &[f64]| {
        let (from, to) = (ends[0], ends[1]);
        (0..=16).map(move |i| from + (to - from) * f64::from(i) / 16.0)
    };
    law.ends()
        .windows(2)
        .flat_map(between)
        .map(off)
        .fold(0.0, f64::max)
}

/// Pair on the way to its certificate.
struct Prover<'a> {
    meshing: Meshing<'a>,
    law: &'a Piecewise,
    out: Vec<ProofStretch>,
}

impl Prover<'_> {
    /// Covers the whole cycle, stretch by stretch.
    fn cycle(&mut self) -> Result<(), ProofError> {
        let pair = self.meshing.pair;
        let rolling = pair.rolling();
        let teeth = pair.driver().tooth_count() * pair.mean_ratio().0;
        let length = rolling.pitch_length(Member::Driver) * f64::from(pair.mean_ratio().0);
        let count = teeth * STRETCHES;
        let at =
            |i: u32| rolling.angle(rolling.parameter(length * f64::from(i) / f64::from(count)));
        let start = at(0);
        let mut cuts: Vec<f64> = (1..count).map(|i| at(i) - start).collect();
        // No stretch lies on two pieces of the law.
        for turn in 0..pair.mean_ratio().0 {
            cuts.extend(
                self.law
                    .ends()
                    .iter()
                    .map(|end| end + TAU * f64::from(turn)),
            );
        }
        cuts.retain(|c| *c > SHORTEST && *c < pair.cycle() - SHORTEST);
        cuts.sort_by(f64::total_cmp);
        cuts.dedup_by(|b, a| *b - *a < SHORTEST);
        cuts.push(pair.cycle());
        let mut before = self.sample(0.0)?;
        for cut in cuts {
            let after = self.sample(cut)?;
            self.cover(before, after.clone())?;
            before = after;
        }
        Ok(())
    }

    /// Covers a stretch, in as many parts as it takes.
    fn cover(&mut self, from: Sample, to: Sample) -> Result<(), ProofError> {
        let mut open = vec![(from, to)];
        while let Some((from, to)) = open.pop() {
            checkpoint();
            let middle = self.sample(0.5 * (from.phi + to.phi))?;
            let sides = [Side::On, Side::Back].map(|side| self.side(side, [&from, &middle, &to]));
            let cut = sides.iter().find_map(|found| match found {
                Found::Cut(phi) => Some(*phi),
                Found::Held { .. } => None,
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
                if let Found::Held { seat, tracks } = found {
                    stretch.seats[side] = seat;
                    stretch.held_by[side] = stretch.meetings.len();
                    stretch.meetings.extend(tracks);
                }
            }
            self.out.push(stretch);
        }
        Ok(())
    }

    /// What holds the driven gear on one side all along a stretch, or where to cut the stretch.
    fn side(&self, side: Side, samples: [&Sample; 3]) -> Found {
        let [from, middle, to] = samples.map(|s| s.phi);
        let mut tracks: Vec<Track> = Vec::new();
        for sample in samples {
            for (feature, meeting) in &sample.held[side as usize] {
                if !tracks.iter().any(|t| t.feature == *feature) {
                    tracks.extend(Track::new(
                        &self.meshing,
                        *feature,
                        (from, to),
                        (sample.phi, *meeting),
                    ));
                }
            }
        }
        let holds = |track: &&Track| (0..track::PLACES).all(|k| track.holds(k, &tracks, side));
        let Some(holder) = tracks.iter().find(holds) else {
            let cut = track::cut(&self.meshing, &tracks, (from, to), side);
            return Found::Cut(cut.unwrap_or(middle));
        };
        let seat = |phi: f64, meeting: &Meeting| meeting.angle - self.law.at(phi).position;
        let Some(seat) = holder.series(seat) else {
            return Found::Cut(middle);
        };
        let Some(first) = self.meeting_of(holder, side) else {
            return Found::Cut(middle);
        };
        let mut out = vec![first];
        let mut known = vec![holder.feature];
        for sample in samples {
            for (feature, meeting) in &sample.near[side as usize] {
                if known.contains(feature) {
                    continue;
                }
                known.push(*feature);
                let track = Track::new(&self.meshing, *feature, (from, to), (sample.phi, *meeting));
                let Some(track) = track else { continue };
                if let Some(phi) = track.leaves(&self.meshing, (from, to)) {
                    return Found::Cut(phi);
                }
                out.extend(self.meeting_of(&track, side));
            }
        }
        Found::Held { seat, tracks: out }
    }

    /// A followed feature as it stands in the certificate, if its series are exact.
    fn meeting_of(&self, track: &Track, side: Side) -> Option<ProofMeeting> {
        let u = track.series(|_, m| m.at.0)?;
        let v = track.series(|_, m| m.at.1)?;
        let Feature { parts, corner } = track.feature;
        let (driver, driven) = (
            self.meshing.driver.parts[parts.0].segment,
            self.meshing.driven.parts[parts.1].segment,
        );
        let at = track.middle().at;
        let bend = |jet: &centrode_geometry::SegmentJet| {
            jet.first.perp(&jet.second) / jet.first.norm().powi(3)
        };
        let (p, q) = (driver.at(at.0), driven.at(at.1));
        // As flat as both contours allow: it parts them the farther from where they meet.
        let (above, below) = (bend(&p), -bend(&q));
        let apart = APART / self.meshing.module;
        let curvature = match corner {
            None => {
                let margin = MARGIN * (above - below);
                0.0_f64.max(below + margin).min(above - margin)
            }
            Some((Member::Driver, _)) => 0.0_f64.max(below + apart),
            Some((Member::Driven, _)) => 0.0_f64.min(above - apart),
        };
        Some(ProofMeeting {
            side: side as usize,
            pieces: [parts.0, parts.1],
            corner: corner.map(|(member, _)| usize::from(member == Member::Driven)),
            parameters: [u, v],
            bend: 0.5 * curvature,
        })
    }

    /// What holds the driven gear at a driver angle, and what is near it.
    fn sample(&mut self, phi: f64) -> Result<Sample, ProofError> {
        let a = self.meshing.pair.center_distance();
        let law = self.law.at(phi).position;
        let candidates = self.meshing.candidates(&Pose::new(phi, law, a));
        let mut out = Sample {
            phi,
            ..Sample::default()
        };
        let seats = self.meshing.seats(&candidates, phi, law);
        for (side, seat) in [Side::On, Side::Back].into_iter().zip(seats) {
            let seat = seat.ok_or(ProofError::Apart { phi })?;
            out.held[side as usize] = seat.features();
            let pose = Pose::new(phi, seat.angle, a);
            let mut near = self.meshing.candidates(&pose);
            for place in self.meshing.places(&mut near, &pose) {
                let touch = place.touch;
                if touch.lever * side.sign() <= 0.0 || touch.gap.abs() > NEAR * self.meshing.module
                {
                    continue;
                }
                let feature = Feature {
                    parts: place.parts,
                    corner: place.corner.map(|member| (member, -1.0)),
                };
                let meeting = Meeting {
                    at: touch.at,
                    angle: seat.angle - touch.gap / touch.lever,
                };
                out.near[side as usize].push((feature, meeting));
            }
        }
        Ok(out)
    }
}

/// What a search along a stretch found on one side.
enum Found {
    /// The seat's series and all meetings, that which holds the gear first.
    Held {
        seat: Vec<f64>,
        tracks: Vec<ProofMeeting>,
    },
    /// Where to cut the stretch, rad.
    Cut(f64),
}
