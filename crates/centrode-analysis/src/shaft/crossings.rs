use centrode_groove::{ClearOffset, Crossing, ShaftError, SpiralShaft};

use super::from_turn;
use crate::rounding::exceeds;
use crate::{Finding, Report, Severity, Unit};

pub(super) fn crossings(shaft: &SpiralShaft, report: &mut Report) {
    let groove = shaft.groove();
    let all = groove.crossings();
    let longest = all.iter().map(|c| c.gap).fold(0.0, f64::max);
    let shortest = all.iter().map(|c| c.gap).fold(f64::INFINITY, f64::min);
    report.values.insert("crossing_count", all.len() as f64);
    report.values.insert("crossing_gap_max", longest);
    report.values.insert("crossing_gap_min", shortest);
    let length = shaft.slider().length;
    if !exceeds(length, longest) {
        let open = all.iter().filter(|c| !exceeds(length, c.gap)).count();
        let message = format!(
            "a slider {length} mm long loses both walls at {open} of {} crossings; it must be longer than {longest:.3} mm",
            all.len()
        );
        Finding::new("slider-length", Severity::Error, message)
            .measured(length, longest, Unit::Millimetre)
            .remedy("a longer slider, a narrower groove, or a return_offset")
            .on("slider")
            .add_to(report);
    }
    tilt(shaft, longest, report);
    let design = shaft.design();
    let in_window = |c: &&Crossing| {
        [c.out, c.back]
            .iter()
            .any(|theta| !exceeds(from_turn(theta - design.pick), 0.5 * design.window))
    };
    let picked = all.iter().filter(in_window).count();
    report
        .values
        .insert("crossings_while_picking", picked as f64);
    let Some(first) = all.iter().find(in_window) else {
        return;
    };
    let message = format!(
        "{picked} of {} crossings are passed while a seedling is picked, where the walls are missing over {:.2} mm; {}",
        all.len(),
        first.gap,
        advice(shaft)
    );
    Finding::new("crossing-while-picking", Severity::Warning, message)
        .measured(first.gap, length, Unit::Millimetre)
        .remedy("a slider longer than the gap, or a return_offset")
        .on("shaft")
        .at(first.out)
        .add_to(report);
}

/// Checks a slider that can turn on its pin and is pushed against one wall, at a crossing that interrupts this wall over `gap`
/// mm.
///
/// The load acts at the pin, and the wall supports the slider outside the gap. While the pin passes the gap, the slider must
/// touch the wall before and behind the gap, up to a whole gap away from the pin on either side: it must be twice as long as
/// the gap. A shorter slider, supported on one side of its pin only, turns into the other groove.
fn tilt(shaft: &SpiralShaft, gap: f64, report: &mut Report) {
    let length = shaft.slider().length;
    report.values.insert("slider_length_free_on_pin", 2.0 * gap);
    if !exceeds(2.0 * gap, length) {
        return;
    }
    let message = format!(
        "at crossings the driving wall is missing for {gap:.2} mm: a slider {length} mm long and free on its pin can swing into the other groove; make it {:.2} mm long or fix it",
        2.0 * gap
    );
    Finding::new("slider-tilts", Severity::Warning, message)
        .measured(length, 2.0 * gap, Unit::Millimetre)
        .remedy("a narrower groove, a longer slider, or a pin that does not turn freely")
        .on("slider")
        .add_to(report);
}

/// Text on the shift of the return groove that separates slow points from crossings.
fn advice(shaft: &SpiralShaft) -> String {
    let law = shaft.law();
    let steepest = 2.0 * (law.mean_speed() / shaft.groove().radius()).atan();
    let required = 1.25 * shaft.groove().width() / steepest.sin();
    match offered(shaft, required) {
        Ok(clear) if clear.return_offset == 0.0 => {
            "no offset of the return groove makes this gap shorter; a hole at the same angle on both strokes always gives a crossing there".to_owned()
        }
        Ok(clear) => format!(
            "with return_offset = {:.4} a slider of {:.2} mm bridges the crossings of the strokes and misses each hole by {:.4} mm; a hole at the same angle on both strokes always gives a crossing there",
            clear.return_offset, clear.slider_length, clear.misplacement
        ),
        Err(error) => format!("the return groove cannot be offset: {error}"),
    }
}

fn offered(shaft: &SpiralShaft, length: f64) -> Result<ClearOffset, ShaftError> {
    shaft
        .groove()
        .clear_offset(length, &shaft.design().reversal)
}
