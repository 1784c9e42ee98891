//! Teeth and spaces that are images of others.

use std::ops::Range;

use centrode_geometry::Outline;
use nalgebra::Isometry2;

use super::{Profile, ProfileError, Role, Tooth, ToothCurve, ToothPlan, ToothSide};
use crate::pattern::{Image, Mating};

/// Appends copies of the pieces of one tooth or space, as the pieces of its image.
pub(super) fn copy(of: Range<usize>, image: &Image, tooth: u32, pieces: &mut Vec<ToothCurve>) {
    let last = of.start + of.end;
    for k in of {
        let piece = if image.mirrored {
            pieces[last - 1 - k].mirrored()
        } else {
            pieces[k].clone()
        };
        pieces.push(ToothCurve {
            poly: piece.poly.turned(&image.turn),
            tooth,
            image: Some(*image),
            ..piece
        });
    }
}

impl ToothCurve {
    /// The mirror image about the x axis, reversed, so that it has the direction of contours.
    fn mirrored(&self) -> Self {
        Self {
            poly: self.poly.mirrored().reversed(),
            span: (self.span.1, self.span.0),
            side: self.side.other(),
            ..*self
        }
    }
}

impl Tooth {
    /// The image of this tooth; `plan` is the plan of the image.
    pub(super) fn image(&self, image: &Image, plan: &ToothPlan) -> Self {
        let (leading, trailing) = if image.mirrored {
            (self.trailing, self.leading)
        } else {
            (self.leading, self.trailing)
        };
        let at = |crossing: f64, side: ToothSide| ToothSide { crossing, ..side };
        Self {
            leading: at(plan.leading.crossing, leading),
            trailing: at(plan.trailing.crossing, trailing),
            ..*self
        }
    }
}

impl Profile {
    /// The driven gear's profile, if it has the form of the driver's, turned.
    pub(crate) fn mated(&self, mating: &Mating, plans: &[ToothPlan]) -> Result<Self, ProfileError> {
        let teeth = (0u32..).zip(plans).map(|(k, plan)| {
            let (other, turns) = mating.other(k);
            let tooth = self.teeth[other as usize];
            let side = |side: ToothSide, crossing: f64| ToothSide {
                crossing,
                active: side
                    .active
                    .map(|(low, high)| (mating.arc(high, turns), mating.arc(low, turns))),
                ..side
            };
            Tooth {
                leading: side(tooth.trailing, plan.leading.crossing),
                trailing: side(tooth.leading, plan.trailing.crossing),
                ..tooth
            }
        });
        // A space belongs to the tooth before it, in the order the teeth mesh: on the other gear, to the tooth after it.
        let owner = |(role, &owner): (&Role, &u32)| match role {
            Role::Root => mating.other(owner + 1).0,
            _ => mating.other(owner).0,
        };
        let owners: Vec<u32> = self.roles.iter().zip(&self.owners).map(owner).collect();
        let outline = self.outline.transformed(&Isometry2::rotation(mating.turn));
        let last = plans.len() as u32 - 1;
        let count = owners.len();
        // Starts at the space after the last tooth, like a contour that is cut.
        let is_start = |i: &usize| owners[*i] == last && owners[(i + count - 1) % count] != last;
        let start = (0..count).find(is_start).unwrap_or(0);
        let turned = |i: usize| (start + i) % count;
        let segments = outline.segments();
        Ok(Self {
            outline: Outline::new((0..count).map(|i| segments[turned(i)]).collect())?,
            roles: (0..count).map(|i| self.roles[turned(i)]).collect(),
            owners: (0..count).map(|i| owners[turned(i)]).collect(),
            teeth: teeth.collect(),
        })
    }
}
