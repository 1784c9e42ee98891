use std::f64::consts::TAU;

use centrode_geometry::bracketed_root;

use super::{Groove, Reversal, ShaftError, Traverse};
use centrode_kinematics::transmission::Transmission;

/// Point where the groove crosses itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Shaft angle at which the slider passes it on the outward stroke, rad.
    pub out: f64,
    /// Shaft angle at which it passes on the return stroke, rad.
    pub back: f64,
    /// Position along the shaft, mm.
    pub position: f64,
    /// Angle between both strokes, rad: the sum of their lead angles.
    pub angle: f64,
    /// Length without walls, mm: a slider guided through must be longer. `w / sin(angle)`.
    pub gap: f64,
    /// Whether the slider passes it on both strokes, not in a reversal.
    pub of_strokes: bool,
}

/// A shift of the return stroke with which the slow points are off the crossings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClearOffset {
    /// `return_offset`, mm.
    pub return_offset: f64,
    /// Minimum length of a slider that bridges every crossing of the strokes then, mm.
    pub slider_length: f64,
    /// Distance, mm, by which each pick then misses its hole: half of the offset.
    pub misplacement: f64,
}

/// Number of offsets tried before one is refined.
const TRIED: u32 = 64;

impl Groove {
    /// Crossings of the groove with itself, in the order the slider passes them on its outward stroke.
    ///
    /// Their number is that of the turns of the cycle minus one: the slider takes every position once outwards and once back, and
    /// for each whole number of turns between the two there is exactly one crossing.
    #[must_use]
    pub fn crossings(&self) -> Vec<Crossing> {
        let traverse = self.traverse();
        let (period, stroke) = (traverse.period(), traverse.stroke());
        let [far, near] = traverse.tips();
        let place = |theta: f64| traverse.at(theta).position;
        let mut crossings: Vec<Crossing> = (1..traverse.turns())
            .map(|turns| {
                let later = TAU * f64::from(turns);
                let apart = |out: f64| place(out + later) - place(out);
                // Between these ends one motion is outwards and the other back: the distance falls from end to end.
                let low = (near - period).max(far - later);
                let high = far.min(near - later);
                let out = bracketed_root(apart, low, high, apart(low), apart(high));
                let back = out + later;
                let angle = self.lead_angle(out) - self.lead_angle(back);
                let slack = 1e-9 * period;
                // The slider passes a crossing first outwards, then back, within one cycle from a near tip.
                let [gone, come] = [out, back].map(|theta| theta - traverse.start());
                Crossing {
                    out,
                    back,
                    position: place(out),
                    angle,
                    gap: self.width() / angle.sin(),
                    of_strokes: gone >= -slack
                        && gone <= stroke + slack
                        && come >= stroke + traverse.reversal() - slack
                        && come <= 2.0 * stroke + traverse.reversal() + slack,
                }
            })
            .collect();
        crossings.sort_by(|a, b| a.out.total_cmp(&b.out));
        crossings
    }

    /// Minimum length of a slider that bridges every crossing, mm.
    #[must_use]
    pub fn minimum_slider_length(&self) -> f64 {
        longest(&self.crossings(), false)
    }

    /// Minimum shift of the return stroke with which a slider of this length (mm) bridges every crossing of the two strokes. If
    /// no shift is sufficient, the one that needs the shortest slider.
    ///
    /// If both strokes pick the same hole at the same angle of the shaft, there is a crossing, whatever the law. The slow point
    /// leaves this crossing only if each stroke misses the hole a little, by half of the offset. The crossings next to the
    /// reversals cannot be moved so.
    ///
    /// # Errors
    /// [`ShaftError`] where the shifted groove does not exist.
    pub fn clear_offset(
        &self,
        slider_length: f64,
        reversal: &Reversal,
    ) -> Result<ClearOffset, ShaftError> {
        let ours = self.traverse();
        let needed = |offset: f64| -> Result<f64, ShaftError> {
            let (start, law) = (ours.start(), ours.law().clone());
            let traverse = Traverse::starting_at(start, law, ours.holes(), reversal, offset)?;
            let groove = Self::new(traverse, self.radius(), self.width(), self.depth())?;
            Ok(longest(&groove.crossings(), true))
        };
        let clear = |offset: f64, length: f64| ClearOffset {
            return_offset: offset,
            slider_length: length,
            misplacement: 0.5 * offset,
        };
        let step = 0.5 * ours.law().lead() / f64::from(TRIED);
        let mut best = clear(0.0, needed(0.0)?);
        for i in 1..=TRIED {
            let (mut low, mut high) = (step * f64::from(i - 1), step * f64::from(i));
            let length = needed(high)?;
            if best.slider_length <= slider_length {
                break;
            }
            if length <= slider_length {
                while high - low > 1e-9 * step {
                    let middle = 0.5 * (low + high);
                    if needed(middle)? <= slider_length {
                        high = middle;
                    } else {
                        low = middle;
                    }
                }
                return Ok(clear(high, needed(high)?));
            }
            if length < best.slider_length {
                best = clear(high, length);
            }
        }
        Ok(best)
    }
}

fn longest(crossings: &[Crossing], of_strokes: bool) -> f64 {
    let counted = crossings.iter().filter(|c| c.of_strokes || !of_strokes);
    counted.map(|c| c.gap).fold(0.0, f64::max)
}
