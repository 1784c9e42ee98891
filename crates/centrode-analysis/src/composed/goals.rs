use centrode_geometry::{Tolerance, extremes};
use centrode_mechanism::composed::{Composed, ComposedFigure, ComposedGoalSpec, Over, PointPart};

use super::{ends, within};
use crate::interference::between_links;
use crate::{Goal, Table, Unit};

/// Accuracy of a clearance, as a share of a plate's width.
const ACCURACY: f64 = 1e-5;

/// A goal with the input at which its figure is found.
pub(super) struct Found {
    pub(super) goal: Goal,
    pub(super) input: Option<f64>,
}

/// Every goal of a machine with its figure, in the order of their names.
pub(super) fn goals(composed: &Composed) -> Vec<Found> {
    let ends = ends(composed);
    let specs = composed.design().goals.iter().zip(composed.figures());
    (1..)
        .zip(specs)
        .map(|(number, ((name, spec), figure))| {
            let (value, input) = value(composed, figure, spec, &ends);
            let title = if spec.title.is_empty() {
                format!("{name}: {}", spec.words())
            } else {
                spec.title.clone()
            };
            let unit = unit(figure);
            let kept = |shown: f64| shown / unit.factor();
            let wanted = spec.wanted().map(|end| end.map(kept));
            let size = wanted
                .into_iter()
                .flatten()
                .fold(0.0, |size: f64, w| size.max(w.abs()));
            let usual = if size > 0.0 { size } else { kept(1.0) };
            let scale = spec.scale.map_or(usual, kept);
            let about = (number, name.clone(), title);
            let goal = Goal::new(about, value, wanted, unit, scale);
            Found { goal, input }
        })
        .collect()
}

/// Unit of a figure.
fn unit(figure: &ComposedFigure) -> Unit {
    match figure {
        ComposedFigure::Point { part, .. } => match part {
            PointPart::X | PointPart::Y => Unit::Millimetre,
            PointPart::Speed => Unit::MillimetrePerSecond,
            PointPart::Acceleration => Unit::MetrePerSecondSquared,
        },
        ComposedFigure::AngularSpeed(_) => Unit::RadianPerSecond,
        ComposedFigure::Angle(_) | ComposedFigure::Swing(_) | ComposedFigure::Transmission(_) => {
            Unit::Angle
        }
        _ => Unit::Millimetre,
    }
}

/// Least and greatest value over the cycle of each figure that a goal can name by one word, a table a unit.
#[must_use]
pub fn composed_figures(composed: &Composed) -> Vec<Table> {
    let ends = ends(composed);
    let mut tables: Vec<Table> = Vec::new();
    for words in composed.figure_words() {
        let Ok(figure) = composed.figure("", &words) else {
            continue;
        };
        let unit = unit(&figure);
        let at = |input: f64| composed.value(&figure, input).unwrap_or(f64::NAN);
        let row = (words, extremes(at, &ends).map(|end| end.value).to_vec());
        match tables.iter_mut().find(|table| table.unit == unit) {
            Some(table) => table.rows.push(row),
            None => tables.push(Table {
                name: "figures",
                title: "Figure",
                unit,
                columns: ["least", "greatest"].map(String::from).into(),
                rows: vec![row],
            }),
        }
    }
    tables
}

/// A figure as a goal takes it, and the input at which it is found.
fn value(
    composed: &Composed,
    figure: &ComposedFigure,
    spec: &ComposedGoalSpec,
    ends: &[f64],
) -> (Option<f64>, Option<f64>) {
    if let ComposedFigure::Clearance(bodies) = figure {
        return clearance(composed, *bodies);
    }
    let at = |input: f64| composed.value(figure, input).unwrap_or(f64::NAN);
    let Some(over) = spec.over else {
        let input = spec.at.unwrap_or(0.0);
        return (Some(at(input)), Some(input));
    };
    let [least, greatest] = match spec.within[..] {
        [from, to] => extremes(at, &within(composed, from, to)),
        _ => extremes(at, ends),
    };
    match over {
        Over::Least => (Some(least.value), Some(least.input)),
        Over::Greatest => (Some(greatest.value), Some(greatest.input)),
        Over::Span => (Some(greatest.value - least.value), None),
    }
}

/// Least clearance of two bodies; infinite where their plates lie apart along the shafts.
fn clearance(composed: &Composed, bodies: [usize; 2]) -> (Option<f64>, Option<f64>) {
    let (Ok(machine), Ok(tolerance)) = (
        composed.machine(),
        Tolerance::new(ACCURACY * composed.design().plates.width),
    ) else {
        return (None, None);
    };
    match between_links(&machine, bodies, tolerance) {
        Ok(Some(found)) => (Some(found.least), Some(found.input)),
        Ok(None) => (Some(f64::INFINITY), None),
        Err(_) => (None, None),
    }
}
