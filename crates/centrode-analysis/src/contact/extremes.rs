//! Greatest and least figures of a contact, sought between its samples.

use centrode_geometry::{Extreme, bracketed_minimum};
use centrode_mechanism::gear::GearPair;

use super::{Contact, meshing::Meshing};

/// Angle, rad, of which a seat tells no more.
const ROUNDING: f64 = 1e-12;

/// Share of a figure by which no peak is told from another.
const SAME: f64 = 1e-10;

/// Figures of a contact that change steadily along the cycle, where they are greatest and least.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactExtremes {
    /// Greatest size of the transmission error with the driver pushing on, rad.
    pub transmission_error: Extreme,
    /// Greatest size of the transmission error with the driver pushing back, rad.
    pub reverse_transmission_error: Extreme,
    /// Greatest penetration of the gears where there is no room for them, mm.
    pub penetration: Extreme,
    /// Least and greatest angular backlash, rad.
    pub backlash: [Extreme; 2],
    /// Least and greatest normal backlash, mm.
    pub normal_backlash: [Extreme; 2],
}

/// A figure of one sample of a contact.
type Figure = fn(&Contact, usize) -> f64;

impl Contact {
    /// Extremes over one whole cycle: the peaks among samples of it are followed between these.
    ///
    /// The samples ascend in driver angle, as those of [`Contact::of`] do. A figure that has no number somewhere has there
    /// its extreme.
    #[must_use]
    pub fn extremes(&self, pair: &GearPair) -> ContactExtremes {
        let mut search = Search {
            contact: self,
            pair,
            meshing: None,
        };
        let a = pair.center_distance();
        let least = |search: &mut Search<'_>, figure: Figure, rounding: f64| {
            let found = search.greatest(|c, k| -figure(c, k), rounding);
            Extreme {
                value: -found.value,
                ..found
            }
        };
        let error: Figure = |c, k| c.transmission_error[k].abs();
        let reverse: Figure = |c, k| c.reverse_transmission_error[k].abs();
        let penetration: Figure = |c, k| c.penetration[k];
        let backlash: Figure = |c, k| c.backlash[k];
        let normal: Figure = |c, k| c.normal_backlash[k];
        ContactExtremes {
            transmission_error: search.greatest(error, ROUNDING),
            reverse_transmission_error: search.greatest(reverse, ROUNDING),
            penetration: search.greatest(penetration, a * ROUNDING),
            backlash: [
                least(&mut search, backlash, ROUNDING),
                search.greatest(backlash, ROUNDING),
            ],
            normal_backlash: [
                least(&mut search, normal, a * ROUNDING),
                search.greatest(normal, a * ROUNDING),
            ],
        }
    }
}

/// Search between the samples of a contact.
struct Search<'a> {
    contact: &'a Contact,
    pair: &'a GearPair,
    /// Made when it is first needed.
    meshing: Option<Meshing<'a>>,
}

impl Search<'_> {
    /// Greatest value of a figure, where differences of `rounding` tell nothing.
    fn greatest(&mut self, figure: impl Fn(&Contact, usize) -> f64, rounding: f64) -> Extreme {
        let inputs = &self.contact.input;
        let values: Vec<f64> = (0..inputs.len()).map(|k| figure(self.contact, k)).collect();
        let mut best = Extreme {
            input: inputs.first().copied().unwrap_or(0.0),
            value: f64::NEG_INFINITY,
        };
        for (&input, &value) in inputs.iter().zip(&values) {
            if value > best.value {
                best = Extreme { input, value };
            }
        }
        if !best.value.is_finite() {
            return best;
        }
        let mut peaks: Vec<(f64, f64, [f64; 2])> = (0..values.len())
            .filter_map(|k| self.peak(&values, k))
            .collect();
        // Higher ones first: they leave the others nothing to reach.
        peaks.sort_by(|p, q| q.0.total_cmp(&p.0));
        for (value, above, [low, high]) in peaks {
            let least = rounding.max(SAME * best.value.abs());
            if above <= least || value + above <= best.value + least {
                continue;
            }
            let (input, lowest) = bracketed_minimum(|phi| -self.value(&figure, phi), low, high);
            if -lowest > best.value {
                best = Extreme {
                    input: input.rem_euclid(self.pair.cycle()),
                    value: -lowest,
                };
            }
        }
        best
    }

    /// Value of a sample that is a peak, the height above it at most reached beside it, eight times that of a parabola
    /// and twice that of a kink, and the samples beside it.
    fn peak(&self, values: &[f64], k: usize) -> Option<(f64, f64, [f64; 2])> {
        let (count, cycle) = (values.len(), self.pair.cycle());
        let inputs = &self.contact.input;
        let (before, after) = ((k + count - 1) % count, (k + 1) % count);
        let low = inputs[before] - if k == 0 { cycle } else { 0.0 };
        let high = inputs[after] + if after == 0 { cycle } else { 0.0 };
        let (value, beside) = (values[k], [values[before], values[after]]);
        let above = 2.0 * value - beside[0] - beside[1];
        let is_peak = beside.iter().all(|&b| b <= value) && low < inputs[k] && inputs[k] < high;
        (is_peak && above.is_finite()).then_some((value, above, [low, high]))
    }

    /// A figure at a driver angle.
    fn value(&mut self, figure: &impl Fn(&Contact, usize) -> f64, phi: f64) -> f64 {
        let pair = self.pair;
        let meshing = self.meshing.get_or_insert_with(|| Meshing::new(pair));
        let mut out = Contact::default();
        meshing.sample(phi, pair.driven_angle(phi), &mut out);
        figure(&out, 0)
    }
}
