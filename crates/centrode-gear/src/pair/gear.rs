use centrode_geometry::{Outline, Point, PolySegment, Segment, Tolerance, bracketed_minimum};

use super::GearPairError;
use crate::design::BodySpec;
use crate::profile::{Profile, ProfileError, Role, Tooth};
use crate::rolling::{Member, Rolling};

/// One gear of a pair, in its own frame: axes parallel to the world's at phi = 0.
#[derive(Clone, Debug)]
pub struct Gear {
    member: Member,
    tooth_count: u32,
    pitch_length: f64,
    outline: Outline,
    roles: Vec<Role>,
    owners: Vec<u32>,
    /// Minimum and maximum distance of the outline from the axis, mm.
    radii: (f64, f64),
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
            radii: radii(&outline),
            outline,
            roles,
            owners,
            pitch_curve: pitch_curve(rolling, member, tolerance)?,
            teeth,
            body,
        };
        if !gear.outline.contains(Point::origin()) {
            let away = gear.radii.0;
            return Err(ProfileError::AxisOutside { member, away }.into());
        }
        gear.clears_bore()?;
        Ok(gear)
    }

    /// The gear with another outline of the same teeth.
    pub(super) fn with_outline(
        &self,
        outline: Outline,
        roles: Vec<Role>,
        owners: Vec<u32>,
    ) -> Self {
        Self {
            radii: radii(&outline),
            outline,
            roles,
            owners,
            ..self.clone()
        }
    }

    pub(super) fn clears_bore(&self) -> Result<(), GearPairError> {
        let reach = self.body.bore_reach();
        let (root, _) = self.radii;
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

    /// Minimum and maximum distance of the outline from the axis, mm.
    #[must_use]
    pub fn radii(&self) -> (f64, f64) {
        self.radii
    }

    /// The bore with its keyway, counter-clockwise; `None` for a gear without one.
    #[must_use]
    pub fn bore(&self) -> Option<Outline> {
        self.body.bore_outline()
    }
}

/// Number of steps of a segment between which extremes of its distance from the axis are searched. Fewer can miss an
/// extreme, more take longer.
const STEPS: usize = 8;

/// Minimum and maximum distance of an outline from the axis, mm.
fn radii(outline: &Outline) -> (f64, f64) {
    let starts = outline.segments().iter().map(|s| s.start().coords.norm());
    let (mut minimum, mut maximum) = starts.fold((f64::INFINITY, 0.0_f64), |(low, high), r| {
        (low.min(r), high.max(r))
    });
    let place = |i: usize| -1.0 + 2.0 * i as f64 / STEPS as f64;
    for segment in outline.segments() {
        let (near, far) = around(segment);
        if near > minimum && far < maximum {
            continue;
        }
        let radius = |u: f64| segment.at(u).point.coords.norm();
        let samples: [f64; STEPS + 1] = std::array::from_fn(|i| radius(place(i)));
        minimum = nearest(&samples, place, radius, minimum);
        maximum = -nearest(&samples.map(|r| -r), place, |u| -radius(u), -maximum);
    }
    (minimum, maximum)
}

/// Bounds of a segment's distance from the axis, mm.
fn around(segment: &Segment) -> (f64, f64) {
    match segment {
        Segment::Poly(poly) => {
            let sizes: f64 = poly.coefficients()[1..].iter().map(|c| c.norm()).sum();
            let middle = poly.coefficients()[0].norm();
            (middle - sizes, middle + sizes)
        }
        Segment::Line(..) | Segment::Arc(..) => (0.0, f64::INFINITY),
    }
}

/// Minimum of a known value and of a function with these samples; refined only where it may be below the known value.
fn nearest(
    samples: &[f64; STEPS + 1],
    place: impl Fn(usize) -> f64,
    f: impl Fn(f64) -> f64,
    known: f64,
) -> f64 {
    let mut minimum = samples.iter().copied().fold(known, f64::min);
    for i in 1..STEPS {
        let (value, beside) = (samples[i], [samples[i - 1], samples[i + 1]]);
        // A parabola through the three reaches at most an eighth of this below the middle one.
        let below = beside[0] + beside[1] - 2.0 * value;
        if value <= beside[0].min(beside[1]) && value - below < minimum {
            minimum = minimum.min(bracketed_minimum(&f, place(i - 1), place(i + 1)).1);
        }
    }
    minimum
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
