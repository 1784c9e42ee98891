//! Teeth and spaces that are images of others.

use std::ops::Range;

use super::{Side, Tooth, ToothCurve, ToothPlan, ToothSide};
use crate::gear::pattern::Image;

/// Copies pieces of one place to the end of them, as those of its image.
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
    /// The mirror image about the x axis, travelled as contours are.
    fn mirrored(&self) -> Self {
        Self {
            poly: self.poly.mirrored().reversed(),
            span: (self.span.1, self.span.0),
            side: match self.side {
                Side::Leading => Side::Trailing,
                Side::Trailing => Side::Leading,
            },
            ..*self
        }
    }
}

impl Tooth {
    /// The image of this tooth, whose plan is given.
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
