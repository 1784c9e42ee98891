//! Seats that jump: a tooth comes between the teeth that hold the driven gear, without touching where it was held before.

use centrode_gear::GearPair;

use super::{Contact, meshing::Meshing, seat::Seat, touch::Pose};

/// Difference between neighbouring samples, rad, below which no jump is sought.
const LEAST: f64 = 1e-6;

/// Driver angle, rad, within which a seat that changes by more than the least cannot be steady.
const SETTLED: f64 = 1e-9;

/// How many times its neighbours a difference must be to hold a jump.
const OUTSTANDING: f64 = 2.0;

/// A jump of the driven angle at which the driver holds the driven gear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeatJump {
    /// Driver angle, rad.
    pub input: f64,
    /// Size of the jump, rad of the driven gear.
    pub turn: f64,
    /// Whether it is the driven gear pushed back that jumps, not the one pushed on.
    pub is_reverse: bool,
    /// Teeth of driver and driven gear that come between, counted from 0.
    pub teeth: (u32, u32),
}

impl Contact {
    /// Places at which the driven angle jumps, greatest first, with the driver pushing on or back.
    ///
    /// From there on the driven gear has two ranges to stand in, one on either side of a tooth. Sought between those samples
    /// whose difference stands out, so a jump beside an equally great one may be missed. None where there is no play, and none of
    /// gears that are not followed ([`Self::is_followed`]).
    #[must_use]
    pub fn seat_jumps(&self, pair: &GearPair) -> Vec<SeatJump> {
        if self.carries() || !self.is_followed(pair) {
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
                let beside = differences[(k + count - 1) % count].max(differences[(k + 1) % count]);
                let stands_out = differences[k] > LEAST.max(OUTSTANDING * beside);
                let in_play = self.backlash[k].max(self.backlash[(k + 1) % count]) > 0.0;
                if !(stands_out && in_play && differences[k].is_finite()) {
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

/// The jump between two driver angles, if the seat is not steady there.
fn jump(meshing: &mut Meshing<'_>, (from, to): (f64, f64), is_reverse: bool) -> Option<SeatJump> {
    let mut ends = [
        (from, seat(meshing, from, is_reverse)?),
        (to, seat(meshing, to, is_reverse)?),
    ];
    while ends[1].0 - ends[0].0 > SETTLED {
        let phi = 0.5 * (ends[0].0 + ends[1].0);
        let middle = seat(meshing, phi, is_reverse)?;
        let [before, after] = [0, 1].map(|k| (middle.0 - ends[k].1.0).abs());
        ends[usize::from(before >= after)] = (phi, middle);
    }
    let [(_, before), (input, after)] = ends;
    let turn = after.0 - before.0;
    // Pushed on, the driven gear is held by what lies farthest on.
    let is_entering = (turn > 0.0) != is_reverse;
    let (_, teeth) = if is_entering { after } else { before };
    (turn.abs() > LEAST).then_some(SeatJump {
        input: input.rem_euclid(meshing.pair.cycle()),
        turn: turn.abs(),
        is_reverse,
        teeth,
    })
}

/// How far off its law the driven gear is held at a driver angle, rad, and the teeth that hold it.
fn seat(meshing: &mut Meshing<'_>, phi: f64, is_reverse: bool) -> Option<(f64, (u32, u32))> {
    let law = meshing.pair.driven_angle(phi);
    let pose = Pose::new(phi, law, meshing.pair.center_distance());
    let candidates = meshing.candidates(&pose);
    let [on, back] = meshing.seats(&candidates, phi, law);
    let seat: Seat = if is_reverse { back? } else { on? };
    let (i, j) = seat.hits.first()?.parts;
    let teeth = (meshing.driver.parts[i].owner, meshing.driven.parts[j].owner);
    Some((seat.angle - law, teeth))
}
