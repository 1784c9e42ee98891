//! Pins of a composed machine, turned to the heights of the plates on them.

use centrode_geometry::Point;
use centrode_mechanism::composed::Composed;
use centrode_mechanism::machine::{Fit, Machine};

use super::plates;
use crate::sheet::{fit, number};
use crate::turned::{Bar, Turned};

/// Shares of the period at which plates on one pin have their holes on one axis.
const SHARES: [f64; 4] = [0.0, 0.137, 0.411, 0.732];
/// Distance, as a share of the pin's diameter, within which axes are one.
const ONE: f64 = 1e-6;

/// Pins of one length, and the bodies that carry them.
pub(super) struct Pins {
    pub(super) part: Turned,
    /// A body of each pin: the one nearest to the frame.
    pub(super) bodies: Vec<usize>,
}

/// Holes on one axis.
struct Axis {
    places: Vec<Point>,
    /// The bodies with a hole there.
    bodies: Vec<usize>,
    /// From the lowest face to the highest, mm.
    span: [f64; 2],
}

/// The pins of a machine, those of one length together, the shortest first.
pub(super) fn all(composed: &Composed, machine: &Machine) -> Vec<Pins> {
    let spec = &composed.design().plates;
    let gap = spec.gap;
    let mut bars: Vec<(Bar, f64, Vec<usize>)> = Vec::new();
    let mut axes = axes(composed, machine);
    let length = |axis: &Axis| axis.span[1] - axis.span[0];
    axes.sort_by(|a, b| length(a).total_cmp(&length(b)));
    // A single plate turns on a pin of what is around the machine.
    for axis in axes.into_iter().filter(|axis| axis.bodies.len() > 1) {
        let long = length(&axis);
        let own = axis.bodies.iter().copied().min().unwrap_or(0);
        match bars
            .last_mut()
            .filter(|(_, known, _)| long - *known < ONE * spec.pin_diameter)
        {
            Some((.., bodies)) => bodies.push(own),
            None => {
                let bar = Bar::new(spec.pin_diameter, &spec.pin_fit, [0.0, long]);
                bars.push((bar.held([gap; 2]), long, vec![own]));
            }
        }
    }
    let alone = bars.len() == 1;
    bars.into_iter()
        .enumerate()
        .map(|(index, (bar, long, bodies))| {
            let name = match alone {
                true => "pin".to_owned(),
                false => format!("pin-{}", index + 1),
            };
            let title = format!("Pin through {} mm", number(long, 3));
            Pins {
                part: bar.part([&name, &title], (&spec.material, spec.density)),
                bodies,
            }
        })
        .collect()
}

fn axes(composed: &Composed, machine: &Machine) -> Vec<Axis> {
    let near = ONE * composed.design().plates.pin_diameter;
    let mut axes: Vec<Axis> = Vec::new();
    for body in 0..composed.bodies().len() {
        let Some(plate) = plates(machine, body).first() else {
            continue;
        };
        for hole in composed.pin_holes(body).into_iter().flatten() {
            let place = |share: f64| composed.place(body, hole.at, share * composed.period());
            let places: Vec<Point> = SHARES.into_iter().map(place).collect();
            let is_one = |axis: &&mut Axis| {
                let mut both = axis.places.iter().zip(&places);
                both.all(|(a, b)| (a - b).norm() < near)
            };
            let [bottom, top] = [plate.bottom(), plate.top()];
            match axes.iter_mut().find(is_one) {
                Some(axis) => {
                    axis.span = [axis.span[0].min(bottom), axis.span[1].max(top)];
                    axis.bodies.push(body);
                }
                None => axes.push(Axis {
                    places,
                    bodies: vec![body],
                    span: [bottom, top],
                }),
            }
        }
    }
    axes
}

/// Lists the pins with what is bought for them.
pub(super) fn list(composed: &Composed, machine: &mut Machine) {
    let spec = &composed.design().plates;
    let fit = Fit::new("", spec.pin_diameter, [&spec.hole_fit, &spec.pin_fit]);
    for pins in all(composed, machine) {
        let links: Vec<usize> = pins
            .bodies
            .iter()
            .map(|&body| {
                machine
                    .link_named(&composed.bodies()[body].name)
                    .unwrap_or(0)
            })
            .collect();
        pins.part.list(machine, &links, fit::shaft(&fit), None);
    }
}
