//! Jumps of the driven gear: a tooth enters the backlash without a touch at the previous seat, and moves the seat by a finite angle.

use centrode_gear::GearPair;

use super::Contact;
use crate::contact::contour::Pose;
use crate::contact::seat::Meshing;

/// Minimum jump that is reported, and minimum difference of neighbouring samples at which one is searched, rad. Ten
/// times less reports changes of contact as jumps, ten times more hides small jumps.
const MIN_JUMP: f64 = 1e-6;

/// Interval of the driver angle to which a jump is bisected, rad. Its size limits the accuracy of the reported angle.
const SETTLED: f64 = 1e-9;

/// Minimum ratio of a difference to its neighbours at which a jump is searched. A larger ratio misses jumps next to
/// other jumps, a smaller one searches smooth motion.
const JUMP_RATIO: f64 = 2.0;

/// A jump of the driven angle while the driver holds the driven gear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeatJump {
    /// Driver angle, rad.
    pub input: f64,
    /// Size of the jump, rad of the driven gear.
    pub turn: f64,
    /// Whether the driven gear is pushed back when it jumps, not pushed forward.
    pub is_reverse: bool,
    /// Teeth of driver and driven gear that meet within the backlash, counted from 0.
    pub teeth: (u32, u32),
}

impl Contact {
    /// Driver angles at which the driven angle jumps, with the driver pushing forward or back, the largest jump first.
    ///
    /// From there on the driven gear has two ranges of positions, one on either side of a tooth. Jumps are searched
    /// between samples whose difference is more than twice each neighbouring difference, so a jump next to another
    /// large one may be missed. The list is empty if the pair has no backlash, if the flanks alone transmit the motion, and for gears
    /// that are not followed ([`Self::is_followed`]).
    #[must_use]
    pub fn seat_jumps(&self, pair: &GearPair) -> Vec<SeatJump> {
        if self.flanks_transmit() || !self.is_followed(pair) {
            return Vec::new();
        }
        let mut meshing = Meshing::new(pair);
        let mut all = Vec::new();
        for is_reverse in [false, true] {
            let seats = match is_reverse {
                false => &self.driven_angle,
                true => &self.reverse_driven_angle,
            };
            let off: Vec<f64> = seats
                .iter()
                .zip(&self.law)
                .map(|(s, law)| s - law)
                .collect();
            let count = off.len();
            let differences: Vec<f64> = (0..count)
                .map(|k| (off[(k + 1) % count] - off[k]).abs())
                .collect();
            for k in 0..count {
                let neighbours =
                    differences[(k + count - 1) % count].max(differences[(k + 1) % count]);
                let is_outstanding = differences[k] > MIN_JUMP.max(JUMP_RATIO * neighbours);
                let has_backlash = self.backlash[k].max(self.backlash[(k + 1) % count]) > 0.0;
                if !(is_outstanding && has_backlash && differences[k].is_finite()) {
                    continue;
                }
                let end = match k + 1 {
                    next if next == count => self.input[0] + pair.cycle(),
                    next => self.input[next],
                };
                all.extend(jump(&mut meshing, (self.input[k], end), is_reverse));
            }
        }
        all.sort_by(|a: &SeatJump, b| b.turn.total_cmp(&a.turn));
        all
    }
}

/// Seat of the driven gear at one driver angle.
#[derive(Clone, Copy)]
struct Seat {
    /// Driver angle, rad.
    input: f64,
    /// Deviation of the driven angle from the law, rad.
    deviation: f64,
    /// Teeth of driver and driven gear in contact.
    teeth: (u32, u32),
}

/// The jump between two driver angles, if there is one.
fn jump(meshing: &mut Meshing<'_>, (from, to): (f64, f64), is_reverse: bool) -> Option<SeatJump> {
    let mut ends = [
        seat(meshing, from, is_reverse)?,
        seat(meshing, to, is_reverse)?,
    ];
    while ends[1].input - ends[0].input > SETTLED {
        let phi = 0.5 * (ends[0].input + ends[1].input);
        let middle = seat(meshing, phi, is_reverse)?;
        let [before, after] = ends.map(|end| (middle.deviation - end.deviation).abs());
        ends[usize::from(before >= after)] = middle;
    }
    let [before, after] = ends;
    let turn = after.deviation - before.deviation;
    // A tooth that enters the backlash moves the driven gear further in the direction in which it is pushed.
    let is_entering = (turn > 0.0) != is_reverse;
    let teeth = if is_entering { after } else { before }.teeth;
    (turn.abs() > MIN_JUMP).then_some(SeatJump {
        input: after.input.rem_euclid(meshing.pair.cycle()),
        turn: turn.abs(),
        is_reverse,
        teeth,
    })
}

/// The seat at a driver angle, rad; `None` if the gears are out of mesh.
fn seat(meshing: &mut Meshing<'_>, phi: f64, is_reverse: bool) -> Option<Seat> {
    let law = meshing.pair.driven_angle(phi);
    let pose = Pose::new(phi, law, meshing.pair.center_distance());
    let candidates = meshing.candidates(&pose);
    let [on, back] = meshing.seats(&candidates, phi, law);
    let seat = if is_reverse { back? } else { on? };
    let (i, j) = seat.angular_contacts.first()?.parts;
    Some(Seat {
        input: phi,
        deviation: seat.angle - law,
        teeth: (meshing.driver.parts[i].tooth, meshing.driven.parts[j].tooth),
    })
}
