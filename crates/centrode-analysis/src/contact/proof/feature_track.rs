//! Meetings of two features along a stretch of the cycle.

use centrode_geometry::{CHEBYSHEV_TERMS, chebyshev_roots, chebyshev_series};

use super::{
    features::{Feature, FeatureMeeting, Meeting},
    prover::{HALF_WIDTH, TAIL},
};
use crate::contact::seat::Meshing;

/// Samples of a track: both ends of the stretch, and the roots of the series between them in ascending order.
pub(super) const SAMPLES: usize = CHEBYSHEV_TERMS + 2;

/// Angle by which one meeting must be beyond another to hold the gear instead of it, rad: a quarter of the half width, more
/// than the rounding of flanks.
const SEAT_DIFFERENCE: f64 = 0.25 * HALF_WIDTH;

/// Inverse of the last decimal in the certificate: far below the half width and below any effect of a parameter on a parabola.
const DECIMALS: f64 = 1e13;

/// Minimum distance of a cut from the ends of a stretch, rad. A smaller one leaves stretches that are too short to be
/// proven, a larger one moves the cut away from the change of contact.
const MIN_CUT_DISTANCE: f64 = 1e-7;

/// Halvings after which a driver angle is exact: 60 halvings reach the rounding of any interval.
const HALVINGS: u32 = 60;

/// Direction in which the driven gear is pushed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Side {
    On = 0,
    Back = 1,
}

impl Side {
    /// 1 if pushed forward, -1 if pushed back.
    pub(super) fn sign(self) -> f64 {
        match self {
            Self::On => 1.0,
            Self::Back => -1.0,
        }
    }
}

/// Features at one driver angle, pushed forward and pushed back.
#[derive(Clone, Debug, Default)]
pub(super) struct FeatureSample {
    /// Driver angle, rad.
    pub(super) phi: f64,
    /// Features that hold the driven gear.
    pub(super) holding: [Vec<FeatureMeeting>; 2],
    /// Features near each other.
    pub(super) near: [Vec<FeatureMeeting>; 2],
}

/// Meetings of two features along a stretch.
#[derive(Clone, Debug)]
pub(super) struct FeatureTrack {
    pub(super) feature: Feature,
    /// Driver angles, rad.
    phi: [f64; SAMPLES],
    /// `None` where the features do not meet.
    meetings: [Option<Meeting>; SAMPLES],
}

impl FeatureTrack {
    /// Follows two features to both ends of a stretch from a known meeting at the driver angle `known_phi`; `None` if they do not meet there.
    pub(super) fn new(
        meshing: &Meshing<'_>,
        (from, to): (f64, f64),
        known_phi: f64,
        FeatureMeeting { feature, meeting }: FeatureMeeting,
    ) -> Option<Self> {
        let roots = chebyshev_roots(from, to);
        let phi: [f64; SAMPLES] = std::array::from_fn(|k| match k {
            0 => from,
            k if k == SAMPLES - 1 => to,
            k => roots[CHEBYSHEV_TERMS - k],
        });
        let first = meshing.meeting(&feature, known_phi, meeting)?;
        let mut meetings = [None; SAMPLES];
        let start = phi.partition_point(|&p| p < known_phi);
        let mut last = Some(first);
        for k in start..SAMPLES {
            last = last.and_then(|m| meshing.meeting(&feature, phi[k], m));
            meetings[k] = last;
        }
        last = Some(first);
        for k in (0..start).rev() {
            last = last.and_then(|m| meshing.meeting(&feature, phi[k], m));
            meetings[k] = last;
        }
        Some(Self {
            feature,
            phi,
            meetings,
        })
    }

    /// Whether the meeting at sample `k` is on its parts, and no other track has a meeting on its parts that holds the gear
    /// earlier.
    pub(super) fn holds(&self, k: usize, all: &[Self], side: Side) -> bool {
        self.meetings[k].is_some_and(|m| holds(&m, all.iter().filter_map(|t| t.meetings[k]), side))
    }

    /// Chebyshev coefficients of a figure along the stretch; `None` if the features do not meet all along it or the coefficients do not
    /// decay.
    pub(super) fn series(&self, figure: impl Fn(f64, &Meeting) -> f64) -> Option<Vec<f64>> {
        let mut values = [0.0; CHEBYSHEV_TERMS];
        for (j, value) in values.iter_mut().enumerate() {
            let k = CHEBYSHEV_TERMS - j;
            *value = figure(self.phi[k], self.meetings[k].as_ref()?);
        }
        let series = chebyshev_series(&values);
        let tail = series[CHEBYSHEV_TERMS - 2].abs() + series[CHEBYSHEV_TERMS - 1].abs();
        let series = series.map(rounded);
        let last = series.iter().rposition(|&c| c != 0.0);
        (tail <= TAIL).then(|| series[..=last.unwrap_or(0)].to_vec())
    }

    /// Driver angle at which the meeting reaches an end of one of its parts, rad.
    pub(super) fn end_of_part(&self, meshing: &Meshing<'_>, ends: (f64, f64)) -> Option<f64> {
        let mut found = None;
        for k in 1..SAMPLES {
            // From a sample with a meeting towards one that may have none.
            let ((from, first), (to, next)) = match (self.meetings[k - 1], self.meetings[k]) {
                (Some(first), next) => ((k - 1, first), (k, next)),
                (None, Some(first)) => ((k, first), (k - 1, None)),
                (None, None) => continue,
            };
            let beyond: [fn(&Meeting) -> bool; 2] =
                [|m| m.at.0.abs() > 1.0, |m| m.at.1.abs() > 1.0];
            for is_beyond in beyond {
                let was = is_beyond(&first);
                if next.map_or(was, |next| is_beyond(&next) == was) {
                    continue;
                }
                let here = |phi: f64, near: Meeting| {
                    let here = meshing.meeting(&self.feature, phi, near)?;
                    (is_beyond(&here) == was).then_some(here)
                };
                let last = last_angle(here, (self.phi[from], self.phi[to]), first);
                found = nearer_to_middle(found, last, ends);
            }
        }
        found
    }

    /// Whether the meeting is on its parts all along the stretch.
    pub(super) fn is_on_parts(&self) -> bool {
        self.meetings
            .iter()
            .all(|m| m.is_some_and(|m| m.is_on_parts()))
    }

    /// Minimum difference of the driven angle from that of another track along the stretch, rad.
    pub(super) fn backlash(&self, other: &Self) -> f64 {
        let both = self.meetings.iter().zip(&other.meetings);
        both.filter_map(|(a, b)| Some((a.as_ref()?.angle - b.as_ref()?.angle).abs()))
            .fold(f64::INFINITY, f64::min)
    }

    /// Parameters of all meetings along the stretch.
    pub(super) fn parameters(&self) -> impl Iterator<Item = (f64, f64)> {
        self.meetings.iter().flatten().map(|m| m.at)
    }

    /// The meeting in the middle of the stretch, if there is one.
    pub(super) fn middle(&self) -> Option<Meeting> {
        self.meetings[SAMPLES / 2]
    }
}

/// A number rounded to the decimals of the certificate.
pub(super) fn rounded(value: f64) -> f64 {
    (value * DECIMALS).round() / DECIMALS
}

/// Last driver angle from `good` towards `bad` at which `here` still has a meeting, rad.
fn last_angle(
    here: impl Fn(f64, Meeting) -> Option<Meeting>,
    (mut good, mut bad): (f64, f64),
    mut meeting: Meeting,
) -> f64 {
    for _ in 0..HALVINGS {
        let phi = 0.5 * (good + bad);
        match here(phi, meeting) {
            Some(m) => (good, meeting) = (phi, m),
            None => bad = phi,
        }
    }
    good
}

/// Of two driver angles at which to cut a stretch, the one nearer to its middle. An angle close to an end is skipped.
fn nearer_to_middle(found: Option<f64>, phi: f64, (from, to): (f64, f64)) -> Option<f64> {
    let margin = MIN_CUT_DISTANCE.max(1e-3 * (to - from));
    let inside = phi > from + margin && phi < to - margin;
    let off = |phi: f64| (phi - 0.5 * (from + to)).abs();
    if inside && found.is_none_or(|f| off(phi) < off(f)) {
        Some(phi)
    } else {
        found
    }
}

/// Whether a meeting is on its parts, and no other meeting on its parts holds the gear earlier.
fn holds(meeting: &Meeting, mut others: impl Iterator<Item = Meeting>, side: Side) -> bool {
    let beaten = |other: Meeting| {
        other.is_on_parts() && side.sign() * (other.angle - meeting.angle) > SEAT_DIFFERENCE
    };
    meeting.is_on_parts() && !others.any(beaten)
}

/// Driver angle at which the features that hold the gear at one end of a stretch stop holding it, rad.
pub(super) fn cut(
    meshing: &Meshing<'_>,
    tracks: &[FeatureTrack],
    (from, to): (f64, f64),
    side: Side,
) -> Option<f64> {
    let ascending: Vec<usize> = (0..SAMPLES).collect();
    let descending: Vec<usize> = (0..SAMPLES).rev().collect();
    let mut found: Option<f64> = None;
    for indices in [ascending, descending] {
        for track in tracks.iter().filter(|t| t.holds(indices[0], tracks, side)) {
            let Some(step) = indices
                .windows(2)
                .find(|w| !track.holds(w[1], tracks, side))
            else {
                continue;
            };
            let Some(first) = track.meetings[step[0]] else {
                continue;
            };
            let here = |phi: f64, near: Meeting| {
                let here = meshing.meeting(&track.feature, phi, near)?;
                let others = tracks.iter().filter_map(|t| {
                    let near = t.meetings[step[0]].or(t.meetings[step[1]])?;
                    meshing.meeting(&t.feature, phi, near)
                });
                holds(&here, others, side).then_some(here)
            };
            let last = last_angle(here, (track.phi[step[0]], track.phi[step[1]]), first);
            found = nearer_to_middle(found, last, (from, to));
        }
    }
    found
}
