//! Parts list, masses and general arrangement of the machine of every shipped design.

use centrode::export::Options;
use centrode::export::linked::{arrangement, parts_list};
use centrode::formats::drawing::EntityShape;
use centrode::formats::sheet::{Sheet, overlaps};
use centrode::geometry::Tolerance;
use centrode_kinematics::machine::LinkedMachine;

use super::machines;

/// Words and numbers of a sheet in order, and how many lines of each layer there are next to them.
fn printed(sheet: &Sheet) -> (Vec<&str>, Vec<(&str, usize)>) {
    let mut words = Vec::new();
    let mut lines: Vec<(&str, usize)> = Vec::new();
    for entity in sheet.drawing.plain() {
        if let EntityShape::Text(text) = &entity.shape {
            words.push(text.words.as_str());
            continue;
        }
        match lines.iter_mut().find(|(layer, _)| *layer == entity.layer) {
            Some((_, count)) => *count += 1,
            None => lines.push((&entity.layer, 1)),
        }
    }
    (words, lines)
}

/// Compares parts list and general arrangement with those of another machine, and with the required texts.
pub(super) fn assert_alike(
    machine: &LinkedMachine,
    again: &LinkedMachine,
    name: &str,
    tolerance: Tolerance,
) {
    let list = parts_list(machine);
    assert_eq!(list, parts_list(again), "{name}");
    assert!(!list.rows.is_empty(), "{name}: {list:?}");
    let sheets = |machine: &LinkedMachine| {
        let sheets = arrangement(machine, &Options::new(tolerance).sheet, tolerance);
        sheets.unwrap_or_else(|e| panic!("{name}: {e}"))
    };
    let (one, other) = (sheets(machine), sheets(again));
    assert_eq!(one.len(), other.len(), "{name}");
    for (a, b) in one.iter().zip(&other) {
        assert_eq!(a.size, b.size, "{name}");
        assert_eq!(printed(a), printed(b), "{name}");
        assert_eq!(overlaps(a), [], "{name}");
    }
    let words: Vec<&str> = one.iter().flat_map(|sheet| printed(sheet).0).collect();
    for part in &machine.parts {
        assert!(words.contains(&part.name.as_str()), "{name}: {}", part.name);
    }
    let balloons = |item: usize| {
        let item = item.to_string();
        words
            .iter()
            .any(|words| words.split(", ").any(|word| word == item))
    };
    for (index, part) in machine.parts.iter().enumerate() {
        assert!(
            part.place.is_none() || balloons(index + 1),
            "{name}: {}",
            part.name
        );
    }
}

#[test]
fn the_arrangement_of_a_linkage_tells_its_bars_its_shafts_and_the_travel_of_its_tip() {
    let (_, machine) = machines()
        .into_iter()
        .find(|(name, _)| name == "feeder-2022")
        .expect("shipped");
    let tolerance = Tolerance::new(1e-3).expect("positive");
    let sheets = arrangement(&machine, &Options::new(tolerance).sheet, tolerance).expect("room");
    let (words, _) = printed(&sheets[0]);
    // As in the design file; shafts by the letters of its joints.
    for [link, between, length] in [
        ["frame", "A to D", "105"],
        ["crank", "A to B", "77"],
        ["coupler", "B to C", "147"],
        ["rocker", "D to C", "127"],
        ["effector", "F to E", "200"],
    ] {
        let row = [link, between, length];
        assert!(
            words.windows(3).any(|words| words == row),
            "{row:?} in {words:?}"
        );
    }
    for dimension in ["105", "106.83", "67.05"] {
        assert!(words.contains(&dimension), "{dimension}");
    }
    // The tip's circle about F, from its two places of rest.
    let period = machine.input.period;
    let at = |i: u32| machine.point(0, period * f64::from(i) / 2e5).position;
    let widths = (0..200_000).map(|i| at(i).x);
    let (low, high) = widths.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
        (low.min(x), high.max(x))
    });
    let stated = words.iter().filter_map(|words| words.parse::<f64>().ok());
    let nearest = stated
        .map(|stated| (stated - (high - low)).abs())
        .fold(f64::INFINITY, f64::min);
    assert!(nearest < 1e-3, "{nearest}");
}

#[test]
fn a_link_weighs_as_much_as_the_parts_that_belong_to_it() {
    let mut held = 0;
    for (name, machine) in machines() {
        for (index, link) in machine.links.iter().enumerate() {
            let pieces = machine.mass_of_pieces(index);
            if pieces == 0.0 {
                continue;
            }
            let mass = link.mass.expect("a body").mass;
            let off = (mass - pieces).abs();
            assert!(
                off < 1e-9 * mass,
                "{name} {}: {mass} and {pieces}",
                link.name
            );
            held += 1;
        }
        let whole = machine.mass_properties(0.0).expect("bodies").mass;
        let pieces: f64 = (0..machine.links.len())
            .map(|link| machine.mass_of_pieces(link))
            .sum();
        assert!(
            (whole - pieces).abs() < 1e-9 * whole,
            "{name}: {whole} and {pieces}"
        );
    }
    assert!(held > 40, "{held} links");
}
