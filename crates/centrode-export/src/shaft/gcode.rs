use centrode_geometry::{Point, Tolerance};
use centrode_groove::SpiralShaft;
use std::fmt::Write;

/// Height of the tool above the shaft's surface between passes, mm.
const CLEAR: f64 = 5.0;

/// A program that mills the groove on a machine with a rotary axis, in the dialect of RS-274/NGC.
///
/// X runs along the shaft, A turns it, Z is the tool's height above the shaft's axis; the tool's axis
/// crosses the shaft's. Feed is inverse time (G93), so that the feed along the groove is the design's
/// whatever the radius. A counts on over the turns and is never unwound. The program starts no spindle: it
/// stops (M0) for the operator to do so, clear of the work, before it moves down.
#[must_use]
pub fn program(shaft: &SpiralShaft, tolerance: Tolerance) -> String {
    let groove = shaft.groove();
    let mill = &shaft.design().mill;
    let radius = groove.radius();
    let diameter = mill.diameter.unwrap_or(groove.width());
    let turns = groove.traverse().turns();
    let mut text = format!(
        "(groove of {name}: RS-274/NGC, millimetres, degrees)\n\
         (X along the shaft, zero where the box is at its first hole; A turns the shaft; Z zero on its axis)\n\
         (end mill of {diameter} mm; chords within {tolerance} mm; {turns} turns of A per pass)\n\
         G21 G90 G17 G40 G49\nG94\n",
        name = shaft.design().name,
        tolerance = tolerance.mm(),
    );
    let up = radius + CLEAR;
    let mut stopped = false;
    let ways = mill.ways(groove, tolerance);
    let whole = f64::from(turns) * 360.0;
    let mut turned = 0.0;
    for depth in mill.depths(groove) {
        for way in &ways {
            let degrees = |p: &Point| turned + (p.x / radius).to_degrees();
            let Some((first, rest)) = way.split_first() else {
                continue;
            };
            let _ = writeln!(text, "G0 Z{}", number(up));
            let _ = writeln!(text, "G0 X{} A{}", number(first.y), number(degrees(first)));
            if !stopped {
                text.push_str("M0 (start the spindle)\n");
                stopped = true;
            }
            let _ = writeln!(
                text,
                "G94\nG1 Z{} F{}\nG93",
                number(radius - depth),
                number(0.2 * mill.feed)
            );
            let mut before = first;
            for point in rest {
                let length = (point - before).norm();
                let _ = writeln!(
                    text,
                    "G1 X{} A{} F{}",
                    number(point.y),
                    number(degrees(point)),
                    number(mill.feed / length)
                );
                before = point;
            }
            let _ = writeln!(text, "G94");
            turned += whole;
        }
    }
    let _ = writeln!(text, "G0 Z{}\nM2", number(up));
    text
}

/// Number with five decimals (a hundredth of a micrometre), which every controller accepts.
fn number(value: f64) -> String {
    let text = format!("{value:.5}");
    if text == "-0.00000" {
        "0.00000".into()
    } else {
        text
    }
}
