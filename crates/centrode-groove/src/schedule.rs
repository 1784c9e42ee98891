use std::f64::consts::TAU;

use super::Traverse;
use centrode_kinematics::transmission::Transmission;

/// Part of the box's cycle in which a hole is picked.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum Way {
    /// Forward stroke.
    Forward,
    /// Reversal.
    Reversing,
    /// Return stroke.
    Return,
}

centrode_spec::words!(Way {
    Forward = "forward",
    Reversing = "reversing",
    Return = "return",
});

/// One picking.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pick {
    /// Turn of the shaft in the cycle, from 0.
    pub turn: u32,
    /// Angle of the shaft, or of the drive's input, at the middle of the window, rad.
    pub theta: f64,
    /// Part of the box's cycle.
    pub way: Way,
    /// Position of the box, mm.
    pub position: f64,
    /// Number of the nearest hole, from 0.
    pub hole: u32,
    /// Position of the box minus that of the nearest hole, mm.
    pub misplacement: f64,
    /// Distance the box sweeps in the window, mm.
    pub swept: f64,
}

/// Holes picked at each turn over a whole cycle out and back, one pick per turn.
#[derive(Clone, Debug, PartialEq)]
pub struct Schedule {
    /// The picks in order.
    pub picks: Vec<Pick>,
    /// Number of picks of each hole.
    pub visits: Vec<u32>,
}

impl Schedule {
    /// Schedule of picks at `pick + 2 pi k`, each in a window (rad) around that angle.
    ///
    /// The holes are one lead apart. The first is at the box's position at the first pick. With a return offset all holes are
    /// shifted by half of it towards the near end, so that both strokes miss them equally.
    #[must_use]
    pub fn new(traverse: &Traverse, pick: f64, window: f64) -> Self {
        Self::driven(traverse, pick, window, |input| input)
    }

    /// Schedule of a shaft that a drive turns: angles and windows are those of the drive's input. At an input the shaft has
    /// turned to `shaft_turn(input)`; it makes one turn per turn of the input.
    pub(super) fn driven(
        traverse: &Traverse,
        pick: f64,
        window: f64,
        shaft_turn: impl Fn(f64) -> f64,
    ) -> Self {
        let (stroke, turn) = (traverse.stroke(), traverse.reversal());
        let lead = traverse.law().lead();
        let first = traverse.at(shaft_turn(pick)).position - 0.5 * traverse.return_offset();
        let last = traverse.holes() - 1;
        let mut visits = vec![0; traverse.holes() as usize];
        let picks = (0..traverse.turns()).map(|k| {
            let theta = pick + TAU * f64::from(k);
            let inside = traverse.since_start(shaft_turn(theta));
            // The joint itself still belongs to the stroke.
            let slack = 1e-9;
            let way = if inside <= stroke + slack {
                Way::Forward
            } else if inside < stroke + turn - slack {
                Way::Reversing
            } else if inside <= 2.0 * stroke + turn + slack {
                Way::Return
            } else {
                Way::Reversing
            };
            let position = traverse.at(shaft_turn(theta)).position;
            let hole = ((position - first) / lead)
                .round()
                .clamp(0.0, f64::from(last)) as u32;
            visits[hole as usize] += 1;
            Pick {
                turn: k,
                theta,
                way,
                position,
                hole,
                misplacement: position - first - lead * f64::from(hole),
                swept: traverse.swept(
                    shaft_turn(theta - 0.5 * window),
                    shaft_turn(theta + 0.5 * window),
                ),
            }
        });
        Self {
            picks: picks.collect(),
            visits,
        }
    }

    /// The pick during which the box sweeps most.
    #[must_use]
    pub fn widest(&self) -> Option<&Pick> {
        self.picks.iter().max_by(|a, b| a.swept.total_cmp(&b.swept))
    }

    /// The pick that misses its hole most.
    #[must_use]
    pub fn worst(&self) -> Option<&Pick> {
        let size = |pick: &&Pick| pick.misplacement.abs();
        self.picks.iter().max_by(|a, b| size(a).total_cmp(&size(b)))
    }
}
