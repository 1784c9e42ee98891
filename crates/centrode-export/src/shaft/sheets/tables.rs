//! The tables of a shaft's sheets.

use super::table;
use centrode_formats::drawing::Anchor;
use centrode_formats::sheet::{Table, number};
use centrode_groove::SpiralShaft;

/// Data of the shaft and its motion.
pub(in crate::shaft) fn data(shaft: &SpiralShaft) -> Table {
    let (design, groove) = (shaft.design(), shaft.groove());
    let traverse = groove.traverse();
    let mut data = table(
        "Spiral shaft",
        &[],
        vec![Anchor::Left, Anchor::Left, Anchor::Right],
    );
    let mut row = |name: &str, sign: &str, value: String| {
        data.rows.push(vec![name.into(), sign.into(), value]);
    };
    row("Lead, mm", "p", number(design.lead, 4));
    row("Holes", "", design.holes.to_string());
    row("Law", "", shaft.speed_law().kind().replace('-', " "));
    if let Some(amplitude) = shaft.amplitude() {
        row("Amplitude, mm", "B", number(amplitude, 6));
    }
    let (slow, fast) = shaft.speed_ratio();
    row("Minimum speed / mean", "", number(slow, 6));
    row("Maximum speed / mean", "", number(fast, 6));
    let window = number(design.window.to_degrees(), 3);
    row(
        &format!("Moves in {window}°, mm"),
        "d",
        number(shaft.moved_in_window(), 4),
    );
    let lead = |speed: f64| {
        format!(
            "{}°",
            number((speed / groove.radius()).atan().to_degrees(), 4)
        )
    };
    row("Minimum lead angle", "", lead(shaft.law().slowest().value));
    row("Maximum lead angle", "", lead(shaft.law().fastest().value));
    let reversal = number(traverse.reversal().to_degrees(), 3);
    row("Reversal", "", format!("{reversal}°"));
    row("Turns out and back", "", traverse.turns().to_string());
    let crossings = groove.crossings();
    row("Crossings of the grooves", "", crossings.len().to_string());
    let gap = crossings.iter().map(|c| c.gap).fold(0.0, f64::max);
    row("Longest crossing, mm", "", number(gap, 3));
    row(
        "Minimum bend of the centre line, mm",
        "ρ",
        number(1.0 / groove.tightest().value, 3),
    );
    row("Depth of the groove, mm", "", number(groove.depth(), 3));
    data
}

/// Name of the file of the centre line, with the angles at which the stroke out and both ends begin.
pub(super) fn lead(shaft: &SpiralShaft) -> Table {
    let traverse = shaft.traverse();
    let (stroke, turn) = (traverse.stroke(), traverse.reversal());
    let begin = traverse.start();
    let turns = shaft.design().holes - 1;
    let [out, far, near] =
        [0.0, stroke, 2.0 * stroke + turn].map(|gone| number((begin + gone).to_degrees(), 3));
    let points = super::super::tables::lead(shaft);
    Table {
        notes: vec![
            format!(
                "The stroke out runs through {turns} turns, each {} mm on; the stroke back is its mirror image.",
                number(shaft.law().lead(), 4)
            ),
            format!(
                "The stroke out begins at {out}°, the far end at {far}°, the near end at {near}°."
            ),
        ],
        ..Table::of_file("Lead table", "lead-table.csv", &points)
    }
}
