//! The driven angle at which two features of the contours meet, as a function of the driver angle.

use centrode_gear::Member;
use centrode_geometry::Vector;
use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};

use crate::contact::contour::Pose;
use crate::contact::seat::{AngularContact, Meshing, SeatedPose};

/// Sine of the angle between the tangents above which a corner touches, not a smooth part. A smaller one takes rounding
/// for corners, a larger one misses blunt corners.
const SMOOTH: f64 = 1e-4;

/// Parameter step below which Newton's method ends: the next error, its square, is below rounding.
const SETTLED: f64 = 1e-9;

/// Parameter beyond an end up to which a meeting counts as on its part. Two pairs that reach their ends at almost the same angle then
/// need no stretch between them.
const OVERHANG: f64 = 1e-6;

/// Parameter beyond an end up to which a corner counts as on its part. It is smaller than [`OVERHANG`], because the
/// seat has a kink there.
const CORNER_OVERHANG: f64 = 1e-8;

/// Parameter beyond an end up to which a part is extrapolated during the iteration. A smaller value rejects good
/// starts, a larger one follows a polynomial far outside its part.
const CONTINUED: f64 = 0.3;

/// Two features that meet: two smooth parts with a common tangent, or a corner at an end of one part and the other part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Feature {
    /// Parts of driver and driven gear.
    pub(super) parts: (usize, usize),
    /// The corner; `None` if both are smooth.
    pub(super) corner: Option<FeatureCorner>,
}

/// Corner of a gear that meets the other gear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct FeatureCorner {
    pub(super) member: Member,
    /// Parameter of the corner on its part: -1 or 1.
    pub(super) end: f64,
}

/// Two features and their meeting at one driver angle.
#[derive(Clone, Copy, Debug)]
pub(super) struct FeatureMeeting {
    pub(super) feature: Feature,
    pub(super) meeting: Meeting,
}

/// Point and driven angle at which two features meet.
#[derive(Clone, Copy, Debug)]
pub(super) struct Meeting {
    /// Parameters on the two parts.
    pub(super) at: (f64, f64),
    /// Driven angle, rad.
    pub(super) angle: f64,
}

impl Meeting {
    /// Whether the meeting is on both parts, or so little beyond an end that the seat differs by rounding only.
    pub(super) fn is_on_parts(&self) -> bool {
        let at = [self.at.0.abs(), self.at.1.abs()];
        let overhang = if at.contains(&1.0) {
            CORNER_OVERHANG
        } else {
            OVERHANG
        };
        at[0].max(at[1]) <= 1.0 + overhang
    }
}

impl AngularContact {
    /// Features that meet in the contact, for a driven gear that turns from the angle `from`, rad.
    ///
    /// Where a contact changes from a smooth part to the corner at its end, both are listed: rounding hides which of them touches.
    fn features(&self, from: f64) -> impl Iterator<Item = FeatureMeeting> {
        let at = self.parameters();
        let [first, second] = self.tangents();
        let slant = first.perp(&second).abs() / (first.norm() * second.norm());
        let corner = match at {
            (end, _) if end.abs() == 1.0 => Some((Member::Driver, end)),
            (_, end) if end.abs() == 1.0 => Some((Member::Driven, end)),
            _ => None,
        };
        let corner = corner.map(|(member, end)| FeatureCorner { member, end });
        let smooth = (slant < SMOOTH || corner.is_none()).then_some(None);
        let angle = from + self.turn;
        let parts = self.parts;
        let kinds = smooth.into_iter().chain(corner.map(Some));
        kinds.map(move |corner| FeatureMeeting {
            feature: Feature { parts, corner },
            meeting: Meeting { at, angle },
        })
    }
}

impl SeatedPose {
    /// Features that meet in the contacts of the seat.
    pub(super) fn features(&self) -> Vec<FeatureMeeting> {
        self.angular_contacts
            .iter()
            .flat_map(|contact| contact.features(self.search_angle))
            .collect()
    }
}

impl Meshing<'_> {
    /// Meeting of two features at a driver angle, by Newton's method from a meeting close to it.
    pub(super) fn meeting(&self, feature: &Feature, phi: f64, near: Meeting) -> Option<Meeting> {
        let a = self.pair.center_distance();
        let (first, second) = (
            &self.driver.parts[feature.parts.0],
            &self.driven.parts[feature.parts.1],
        );
        let Meeting {
            at: (mut u, mut v),
            mut angle,
        } = near;
        if let Some(FeatureCorner { member, end }) = feature.corner {
            match member {
                Member::Driver => u = end,
                Member::Driven => v = end,
            }
        }
        for _ in 0..20 {
            let pose = Pose::new(phi, angle, a);
            let (p, q) = (
                first.span.segment.at(u),
                pose.jet_to_driver(&second.span.segment.at(v)),
            );
            let apart = q.point - p.point;
            let arm = q.point - pose.axis;
            let tangential = Vector::new(-arm.y, arm.x);
            let [du, dv, turn] = match feature.corner {
                None => {
                    let slant = p.first.perp(&q.first);
                    let rates = [
                        p.second.perp(&q.first),
                        p.first.perp(&q.second),
                        p.first.dot(&q.first),
                    ];
                    let system = Matrix3::new(
                        -p.first.x,
                        q.first.x,
                        tangential.x,
                        -p.first.y,
                        q.first.y,
                        tangential.y,
                        rates[0],
                        rates[1],
                        rates[2],
                    );
                    let step = system
                        .lu()
                        .solve(&Vector3::new(-apart.x, -apart.y, -slant))?;
                    [step.x, step.y, step.z]
                }
                Some(FeatureCorner { member, .. }) => {
                    let along = if member == Member::Driver {
                        q.first
                    } else {
                        -p.first
                    };
                    let system = Matrix2::new(along.x, tangential.x, along.y, tangential.y);
                    let step = system.lu().solve(&Vector2::new(-apart.x, -apart.y))?;
                    if member == Member::Driver {
                        [0.0, step.x, step.y]
                    } else {
                        [step.x, 0.0, step.y]
                    }
                }
            };
            (u, v, angle) = (u + du, v + dv, angle + turn);
            if !(u.abs() <= 1.0 + CONTINUED && v.abs() <= 1.0 + CONTINUED && angle.is_finite()) {
                return None;
            }
            if du.abs() < SETTLED && dv.abs() < SETTLED {
                return Some(Meeting { at: (u, v), angle });
            }
        }
        None
    }
}
