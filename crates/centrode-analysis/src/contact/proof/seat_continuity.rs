//! Check that the seats do not jump: a tooth can enter the backlash of the driven gear without a touch at the previous seat.

use super::{
    certificate::{ProofError, ProofStretch},
    feature_track::Side,
    prover::{HALF_WIDTH, Prover},
};

impl Prover<'_> {
    /// Checks that each seat is continuous from stretch to stretch, and from the end of the cycle to its start.
    pub(super) fn check_continuity(&self) -> Result<(), ProofError> {
        let after = self.stretches.iter().cycle().skip(1);
        for (before, after) in self.stretches.iter().zip(after) {
            for side in [Side::On, Side::Back] {
                let seat = |stretch: &ProofStretch, end| at_end(&stretch.seats[side as usize], end);
                let turn = seat(after, -1.0) - seat(before, 1.0);
                if turn.abs() > HALF_WIDTH {
                    let is_later = turn * side.sign() > 0.0;
                    let (stretch, end) = if is_later {
                        (after, -1.0)
                    } else {
                        (before, 1.0)
                    };
                    return Err(self.jump_error(side, before.to, turn.abs(), stretch, end));
                }
            }
        }
        Ok(())
    }

    /// The error that names the teeth that meet at one end of a stretch.
    fn jump_error(
        &self,
        side: Side,
        phi: f64,
        turn: f64,
        stretch: &ProofStretch,
        end: f64,
    ) -> ProofError {
        let meeting = &stretch.meetings[stretch.held_by[side as usize]];
        let [driver, driven] = meeting.pieces;
        let part = &self.meshing.driver.parts[driver];
        let at = at_end(&meeting.parameters[0], end);
        ProofError::Step {
            phi,
            side: match side {
                Side::On => "forward",
                Side::Back => "back",
            },
            turn,
            teeth: (part.tooth, self.meshing.driven.parts[driven].tooth),
            point: part.span.segment.at(at).point,
        }
    }
}

/// Value of a Chebyshev series at one end, -1 or 1.
fn at_end(series: &[f64], end: f64) -> f64 {
    series.iter().rev().fold(0.0, |sum, c| c + end * sum)
}
