//! Measuring pins in the spaces of the intermittent gears as they are cut.

use centrode_gear::{IntermittentPair, Member, OverPins, Pin, PinFault};
use centrode_geometry::{Point, bracketed_root, checkpoint};
use nalgebra::Rotation2;

/// Maximum distance of a resting pin from a flank, relative to the pin's radius.
const OFF: f64 = 1e-6;

/// Pins in the spaces of a gear, in the axes of its sheet; a space without both flanks in the finished contour has a fault. The
/// driver's teeth are thinner than those of the complete gear by the backlash. The driver has turned by `turned` (rad). All teeth
/// are thinner by a further length `thinner` (mm along the pitch circle): their flanks lie behind those of the contour.
pub(super) fn pins(
    gears: &IntermittentPair,
    member: Member,
    turned: f64,
    thinner: f64,
) -> OverPins {
    let pair = gears.pair();
    let (finished, turned) = match member {
        Member::Driver => (gears.driver(), turned),
        Member::Driven => (gears.driven(), 0.0),
    };
    let turn = Rotation2::new(turned);
    let corners = finished.flatten(gears.accuracy());
    let mut over = pair.gear(member).over_pins(pair.pin_diameter(member));
    let radius = 0.5 * over.diameter;
    // Each flank takes half of `thinner`, measured normal to the flank.
    let behind = 0.5 * thinner * pair.pressure_angle().cos();
    for pin in &mut over.pins {
        checkpoint();
        let start = pin.as_ref().ok().map(|pin| turn * pin.center);
        if let Some(start) = start {
            let rests = rest(&corners, start, radius - behind).ok_or(PinFault::NoFlank);
            *pin = rests.map(|pin| Pin {
                radial: pin.center.coords.norm() + radius,
                ..pin
            });
        }
    }
    over
}

/// Pin of a radius on both flanks of a space of a closed contour, near `start`.
fn rest(corners: &[Point], start: Point, radius: f64) -> Option<Pin> {
    let next = corners.iter().cycle().skip(1);
    let far = 4.0 * radius;
    let sides: Vec<[Point; 2]> = corners
        .iter()
        .zip(next)
        .map(|(a, b)| [*a, *b])
        .filter(|side| side.iter().any(|end| (end - start).norm() < far))
        .collect();
    let (middle, polar) = (start.coords.norm(), start.y.atan2(start.x));
    let place = |angle: f64, reach: f64| Rotation2::new(angle) * Point::new(reach, 0.0);
    // Farther out a pin is farther from the nearer flank.
    let seat = |angle: f64| {
        let reach = root([middle - radius, middle + radius], |reach| {
            let [left, right] = gaps(&sides, place(angle, reach)).map(|(gap, _)| gap);
            Some(left.min(right) - radius)
        })?;
        Some(place(angle, reach))
    };
    let aside = 0.15 * radius / middle;
    // A pin that turns counter-clockwise gets nearer to the flank on that side.
    let angle = root([polar - aside, polar + aside], |angle| {
        let [left, right] = seat(angle).map(|at| gaps(&sides, at).map(|(gap, _)| gap))?;
        Some(right - left)
    })?;
    let center = seat(angle)?;
    let found = gaps(&sides, center);
    let across = center.coords.normalize();
    let rests = found.iter().all(|(gap, foot)| {
        let aside = across.perp(&(foot - center)).abs();
        (gap - radius).abs() < OFF * radius && aside > 0.5 * radius
    });
    rests.then(|| Pin {
        center,
        contacts: [found[1].1, found[0].1],
        radial: center.coords.norm() + radius,
    })
}

/// Root of a rising function; `None` if its sign does not change.
fn root([low, high]: [f64; 2], f: impl Fn(f64) -> Option<f64>) -> Option<f64> {
    let (below, above) = (f(low)?, f(high)?);
    // A value that cannot be computed becomes NaN; `rest` checks the resulting pin.
    let stated = |x: f64| f(x).unwrap_or(f64::NAN);
    (below <= 0.0 && above >= 0.0).then(|| bracketed_root(stated, low, high, below, above))
}

/// Nearest points of line segments to a point, with their distances: first counter-clockwise of the ray from the origin through
/// the point, then clockwise.
fn gaps(sides: &[[Point; 2]], center: Point) -> [(f64, Point); 2] {
    let mut gaps = [(f64::INFINITY, center); 2];
    for [a, b] in sides {
        let side = b - a;
        let along = (center - a).dot(&side) / side.norm_squared();
        let foot = a + side * along.clamp(0.0, 1.0);
        let gap = (foot - center).norm();
        let own = &mut gaps[usize::from(center.coords.perp(&foot.coords) <= 0.0)];
        if gap < own.0 {
            *own = (gap, foot);
        }
    }
    gaps
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pin_rests_on_both_walls_of_a_groove() {
        // A groove at the distance 10 with walls of 30 deg about the ray at 0.2 rad: the centre lies the radius over the
        // sine of the half angle from where they meet.
        let turn = Rotation2::new(0.2);
        let corners = [
            (0.0, -20.0),
            (10.0 + 4.0, -4.0 * 30_f64.to_radians().tan()),
            (10.0, 0.0),
            (10.0 + 4.0, 4.0 * 30_f64.to_radians().tan()),
            (0.0, 20.0),
        ]
        .map(|(x, y)| turn * Point::new(x, y));
        let pin = rest(&corners, turn * Point::new(11.9, 0.05), 1.0).expect("rests");
        assert!((pin.radial - 13.0).abs() < 1e-8, "{}", pin.radial);
        assert!((pin.center - turn * Point::new(12.0, 0.0)).norm() < 1e-8);
        // Nothing holds it on a plain side.
        let corners = [(10.0, -20.0), (10.0, 20.0), (-10.0, 0.0)].map(|(x, y)| Point::new(x, y));
        assert_eq!(rest(&corners, Point::new(11.0, 0.0), 1.0), None);
    }
}
