use centrode_geometry::{Tolerance, extremes, maxima, rounding};
use centrode_machines::machine::{
    ClearanceEnd, Machine, MachineFigure, MachineGoalSpec, Over, PointPart,
};

use super::clearance::machine_clearance;
use super::{Made, ends, forces, within};
use crate::forces::Forces;
use crate::side_by_side::each;
use crate::{Goal, Table, Unit};

/// Accuracy of a clearance, as a share of a plate's width. A coarser one makes goals less exact, a finer one takes
/// longer.
const ACCURACY: f64 = 1e-5;

/// A goal with the input at which its figure is found.
pub(super) struct Found {
    pub(super) goal: Goal,
    pub(super) input: Option<f64>,
}

/// Every goal of a machine with its figure, in the order of their names.
pub(super) fn goals(made: &Made<'_>) -> Vec<Found> {
    let composed = made.composed;
    let ends = ends(composed);
    let specs = composed.design().goals.iter().zip(composed.figures());
    let specs: Vec<_> = (1..).zip(specs).collect();
    each(&specs, |(number, ((name, spec), figure))| {
        let (number, unit) = (*number, unit(made, figure));
        let (value, input) = value(made, figure, spec, &ends, unit);
        let title = if spec.title.is_empty() {
            format!("{name}: {}", spec.words())
        } else {
            spec.title.clone()
        };
        let goal = Goal::new(number, String::clone(name), title, unit);
        let goal = goal.required(spec.range(), spec.scale).with(value);
        Found { goal, input }
    })
}

/// Unit of a figure.
fn unit(made: &Made<'_>, figure: &MachineFigure) -> Unit {
    match figure {
        MachineFigure::OfPair { pair, figure } => {
            let unit = made.pairs().get(*pair).and_then(|own| own.unit(figure));
            unit.unwrap_or(Unit::Number)
        }
        MachineFigure::Point(_, part) => match part {
            PointPart::X | PointPart::Y => Unit::Millimetre,
            PointPart::Speed => Unit::MillimetrePerSecond,
            PointPart::Acceleration => Unit::MetrePerSecondSquared,
        },
        MachineFigure::AngularSpeed(_) => Unit::RadianPerSecond,
        MachineFigure::Angle(_) | MachineFigure::Swing(_) | MachineFigure::Transmission(_) => {
            Unit::Angle
        }
        MachineFigure::InputTorque => Unit::NewtonMillimetre,
        figure if figure.is_of_forces() => Unit::Newton,
        _ => Unit::Millimetre,
    }
}

/// Minimum and maximum over the cycle of each figure that a goal can name by one word, one table per unit. Figures that are
/// not determined are omitted.
#[must_use]
pub fn machine_figures(composed: &Machine) -> Vec<Table> {
    let made = Made::new(composed);
    let loaded = made.loaded().and_then(|loaded| loaded.as_ref().ok());
    let words = composed.figure_words().into_iter();
    let mut words: Vec<String> = words.collect();
    words.sort_by_cached_key(|words| composed.place_in_file(words));
    let (words, figures): (Vec<String>, Vec<MachineFigure>) = words
        .into_iter()
        .filter_map(|words| {
            let figure = composed.figure("", &words).ok()?;
            Some((words, figure))
        })
        .unzip();
    let value = |figure: &MachineFigure, forces: Option<&Forces>, input: f64| {
        let moving = composed.value(figure, input);
        moving.or_else(|| forces::part(forces?, figure))
    };
    let both = |value: Option<f64>| {
        let value = value.unwrap_or(f64::NAN);
        [-value, value]
    };
    let all = |input: f64, values: &mut Vec<f64>| {
        let forces = loaded.and_then(|loaded| loaded.at(input));
        let of = |figure| both(value(figure, forces.as_ref(), input));
        values.extend(figures.iter().flat_map(of));
    };
    let one = |k: usize, input: f64| {
        let figure = &figures[k / 2];
        let loaded = loaded.filter(|_| figure.is_of_forces());
        let forces = loaded.and_then(|loaded| loaded.at(input));
        both(value(figure, forces.as_ref(), input))[k % 2]
    };
    let count = 2 * figures.len();
    let found = maxima(count, all, one, |_, v| rounding(v), &ends(composed));
    let rows = words.into_iter().zip(&figures).zip(found.chunks(2));
    let rows = rows.map(|((words, figure), found)| {
        let ends = vec![-found[0].value, found[1].value];
        (unit(&made, figure), words, ends)
    });
    let known = rows.filter(|(.., ends)| ends.iter().all(|end| end.is_finite()));
    Table::of_figures(["minimum", "maximum"], known)
}

/// The value of a figure for a goal, and the input at which it occurs.
fn value(
    made: &Made<'_>,
    figure: &MachineFigure,
    spec: &MachineGoalSpec,
    ends: &[f64],
    unit: Unit,
) -> (Option<f64>, Option<f64>) {
    if let MachineFigure::Clearance(ends) = figure {
        return clearance(made, *ends, spec);
    }
    if let MachineFigure::OfPair { pair, figure } = figure {
        let own = made.pairs().get(*pair);
        let value = own.and_then(|own| own.values.get(figure).copied());
        return (value.filter(|value| value.is_finite()), None);
    }
    if figure.is_of_forces() {
        return match made.loaded() {
            Some(Ok(loaded)) => of(
                made.composed,
                spec,
                |input| loaded.value(figure, input),
                ends,
                unit,
            ),
            _ => (None, None),
        };
    }
    let at = |input: f64| made.composed.value(figure, input).unwrap_or(f64::NAN);
    of(made.composed, spec, at, ends, unit)
}

/// The value of a function of the input for a goal, and the input at which it occurs; `None` if there is none.
fn of(
    composed: &Machine,
    spec: &MachineGoalSpec,
    at: impl Fn(f64) -> f64,
    ends: &[f64],
    unit: Unit,
) -> (Option<f64>, Option<f64>) {
    let finite = |value: f64| value.is_finite().then_some(value);
    let Some(over) = spec.over else {
        let input = spec.at.unwrap_or(0.0);
        return (finite(at(input)), Some(input));
    };
    let [minimum, maximum] = match spec.within[..] {
        [from, to] => {
            let [first, last] = spec
                .uniform
                .unwrap_or_default()
                .map(|end| end / unit.factor());
            let rate = (last - first) / (to - from);
            // Without a required uniform motion this line is zero everywhere.
            let at = |input: f64| at(input) - (first + rate * (input - from));
            extremes(at, &within(composed, from, to))
        }
        _ => extremes(at, ends),
    };
    match over {
        Over::Deviation if -minimum.value > maximum.value => {
            (finite(-minimum.value), Some(minimum.input))
        }
        Over::Deviation => (finite(maximum.value), Some(maximum.input)),
        Over::Minimum => (finite(minimum.value), Some(minimum.input)),
        Over::Maximum => (finite(maximum.value), Some(maximum.input)),
        Over::Span => (finite(maximum.value - minimum.value), None),
    }
}

/// Minimum clearance of two bodies; infinite if they do not overlap along the shafts.
fn clearance(
    made: &Made<'_>,
    ends: [ClearanceEnd; 2],
    spec: &MachineGoalSpec,
) -> (Option<f64>, Option<f64>) {
    let width = made.composed.plates().width;
    let (Some(machine), Ok(tolerance)) = (made.outlined(), Tolerance::new(ACCURACY * width)) else {
        return (None, None);
    };
    let inputs = match spec.within[..] {
        [from, to] => [from, to],
        _ => [0.0, made.composed.period()],
    };
    match machine_clearance(made.composed, machine, ends, tolerance) {
        Ok(None) => (Some(f64::INFINITY), None),
        Ok(Some(pair)) => match pair.over(inputs) {
            Ok(found) => (Some(found.minimum), Some(found.input)),
            Err(_) => (None, None),
        },
        Err(_) => (None, None),
    }
}
