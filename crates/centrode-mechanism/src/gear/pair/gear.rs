use centrode_geometry::{Outline, PolySegment, Segment, Tolerance, bracketed_minimum};

use super::GearPairError;
use crate::bore;
use crate::gear::design::BodySpec;
use crate::gear::profile::{Profile, ProfileError, Role, Tooth};
use crate::gear::rolling::{Member, Rolling};

/// One gear of a pair, in its own frame: axes parallel to the world's at phi = 0.
#[derive(Clone, Debug)]
pub struct Gear {
    member: Member,
    tooth_count: u32,
    pitch_length: f64,
    outline: Outline,
    roles: Vec<Role>,
    owners: Vec<u32>,
    pitch_curve: Outline,
    teeth: Vec<Tooth>,
    pub(super) body: BodySpec,
}

impl Gear {
    pub(super) fn new(
        rolling: &Rolling,
        member: Member,
        profile: Profile,
        body: BodySpec,
        tolerance: Tolerance,
    ) -> Result<Self, GearPairError> {
        let Profile {
            outline,
            roles,
            owners,
            teeth,
        } = profile;
        let gear = Self {
            member,
            tooth_count: teeth.len() as u32,
            pitch_length: rolling.pitch_length(member),
            outline,
            roles,
            owners,
            pitch_curve: pitch_curve(rolling, member, tolerance)?,
            teeth,
            body,
        };
        gear.clears_bore()?;
        Ok(gear)
    }

    pub(super) fn clears_bore(&self) -> Result<(), GearPairError> {
        let reach = bore::reach(&self.body);
        let (root, _) = self.radii();
        if reach >= root {
            return Err(GearPairError::Bore {
                member: self.member,
                reach,
                root,
            });
        }
        Ok(())
    }

    /// Driver or driven.
    #[must_use]
    pub fn member(&self) -> Member {
        self.member
    }

    /// Number of teeth.
    #[must_use]
    pub fn tooth_count(&self) -> u32 {
        self.tooth_count
    }

    /// Length of the pitch curve, mm.
    #[must_use]
    pub fn pitch_length(&self) -> f64 {
        self.pitch_length
    }

    /// The toothed contour, counter-clockwise.
    #[must_use]
    pub fn outline(&self) -> &Outline {
        &self.outline
    }

    /// Role of each segment of the outline.
    #[must_use]
    pub fn roles(&self) -> &[Role] {
        &self.roles
    }

    /// Tooth that each segment of the outline belongs to; a space belongs to the tooth before it.
    #[must_use]
    pub fn owners(&self) -> &[u32] {
        &self.owners
    }

    /// The pitch curve, counter-clockwise.
    #[must_use]
    pub fn pitch_curve(&self) -> &Outline {
        &self.pitch_curve
    }

    /// The teeth in the order they mesh.
    #[must_use]
    pub fn teeth(&self) -> &[Tooth] {
        &self.teeth
    }

    /// Width, bore and material.
    #[must_use]
    pub fn body(&self) -> &BodySpec {
        &self.body
    }

    /// Least and greatest distance of the outline from the axis, mm.
    #[must_use]
    pub fn radii(&self) -> (f64, f64) {
        (self.nearest(1.0), -self.nearest(-1.0))
    }

    /// Least distance of the outline from the axis times a sign, mm.
    fn nearest(&self, sign: f64) -> f64 {
        const STEPS: usize = 8;
        let at = |i: usize| -1.0 + 2.0 * i as f64 / STEPS as f64;
        let segments = self.outline.segments();
        let radius = |segment: &Segment, u: f64| sign * segment.at(u).point.coords.norm();
        let sampled: Vec<[f64; STEPS + 1]> = segments
            .iter()
            .map(|segment| std::array::from_fn(|i| radius(segment, at(i))))
            .collect();
        let known = sampled
            .iter()
            .flatten()
            .copied()
            .fold(f64::INFINITY, f64::min);
        let mut least = known;
        for (segment, samples) in segments.iter().zip(&sampled) {
            for i in 1..STEPS {
                let (value, beside) = (samples[i], [samples[i - 1], samples[i + 1]]);
                // A parabola through the three reaches an eighth of this below the middle one.
                let below = beside[0] + beside[1] - 2.0 * value;
                if value <= beside[0].min(beside[1]) && value - below < least {
                    let along = |u: f64| radius(segment, u);
                    least = least.min(bracketed_minimum(along, at(i - 1), at(i + 1)).1);
                }
            }
        }
        least
    }

    /// The bore with its keyway, counter-clockwise; `None` for a gear without one.
    #[must_use]
    pub fn bore(&self) -> Option<Outline> {
        bore::outline(&self.body)
    }
}

fn pitch_curve(
    rolling: &Rolling,
    member: Member,
    tolerance: Tolerance,
) -> Result<Outline, GearPairError> {
    let (from, to) = (
        rolling.parameter(0.0),
        rolling.parameter(rolling.pitch_length(member)),
    );
    let mut ends = vec![from];
    ends.extend(rolling.breaks_between(from, to));
    ends.push(to);
    let mut polys: Vec<PolySegment> = Vec::new();
    for pair in ends.windows(2) {
        polys.extend(PolySegment::fit(
            |t| rolling.frame(member, t).point,
            pair[0],
            pair[1],
            tolerance,
        ));
    }
    for i in 0..polys.len() {
        let end = polys[i].end();
        let next = (i + 1) % polys.len();
        polys[next] = polys[next].pinned(end, polys[next].end());
    }
    let mut segments: Vec<Segment> = polys.into_iter().map(Segment::Poly).collect();
    if member == Member::Driven {
        segments = segments.iter().rev().map(Segment::reversed).collect();
    }
    Ok(Outline::new(segments).map_err(ProfileError::from)?)
}
