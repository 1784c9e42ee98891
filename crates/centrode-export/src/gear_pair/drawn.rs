use super::sheet::{self, Contours};
use centrode_formats::drawing::Drawing;
use centrode_formats::dxf::Curves;
use centrode_gear::{GearPair, Member};
use centrode_geometry::Tolerance;
use std::cell::OnceCell;

/// The cutting drawings of a pair, whose contours are made once.
pub(super) struct Drawn<'a> {
    pub(super) pair: &'a GearPair,
    tolerance: Tolerance,
    exact: [OnceCell<Contours>; 2],
    fitted: [OnceCell<Contours>; 2],
}

impl<'a> Drawn<'a> {
    pub(super) fn new(pair: &'a GearPair, tolerance: Tolerance) -> Self {
        Self {
            pair,
            tolerance,
            exact: Default::default(),
            fitted: Default::default(),
        }
    }

    /// Both gears assembled at phi = 0.
    pub(super) fn assembly(&self, curves: Curves) -> Drawing {
        let both = [Member::Driver, Member::Driven];
        sheet::assembly(self.pair, both.map(|member| self.contours(member, curves)))
    }

    /// Contours of a gear, fitted with arcs if `curves` requests arcs.
    pub(super) fn contours(&self, member: Member, curves: Curves) -> &Contours {
        let index = usize::from(member == Member::Driven);
        let exact = || Contours::new(self.pair, member, self.tolerance);
        let exact = || self.exact[index].get_or_init(exact);
        match curves {
            Curves::Splines | Curves::Chords => exact(),
            // Fitting does not change contours that are arcs already.
            Curves::Arcs => {
                self.fitted[index].get_or_init(|| exact().clone().with_arcs(self.tolerance))
            }
        }
    }
}
