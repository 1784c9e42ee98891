use std::borrow::Cow;

use schemars::JsonSchema;
use serde::Serialize;

use crate::{JsonNumber, Unit, figure};
use centrode_geometry::COMPUTED;
use centrode_spec::goals::RequiredRange;

/// Goal of a mechanism: a figure and the range required of it.
///
/// Margin and progress measure how well it is met: both rise as the figure comes nearer to its range, so an optimiser
/// can follow them.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct Goal {
    /// Number in its list, from one; 0 for a constraint of a search next to the goals.
    pub number: u32,
    /// Number in the paper that it is from, where that is another: several figures may share one goal there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub paper: Option<u32>,
    /// Short stable name, such as `pick-angle`.
    pub name: Cow<'static, str>,
    /// The goal in a few words.
    pub title: Cow<'static, str>,
    /// Figure, in `unit`; `None` if it was not checked.
    #[serde(serialize_with = "figure::option")]
    #[schemars(with = "Option<JsonNumber>")]
    pub value: Option<f64>,
    /// Minimum and maximum figure required; `None` for an end without a limit.
    pub required: [Option<f64>; 2],
    /// Unit of the figures.
    pub unit: Unit,
    /// Size of a miss that leaves half the progress, in `unit`.
    pub scale: f64,
    /// Distance of the figure from the nearest end of its range: positive inside, negative outside.
    #[serde(serialize_with = "figure::option")]
    #[schemars(with = "Option<JsonNumber>")]
    pub margin: Option<f64>,
    /// 1 where the goal is reached, falling smoothly to 0 as the figure goes away from it:
    /// 1/(1 + (miss/scale)^2), the scale being the size of what is required.
    pub progress: Option<f64>,
}

impl Goal {
    /// A goal without a range or figure. The methods below add them.
    #[must_use]
    pub fn new(
        number: u32,
        name: impl Into<Cow<'static, str>>,
        title: impl Into<Cow<'static, str>>,
        unit: Unit,
    ) -> Self {
        Self {
            number,
            paper: None,
            name: name.into(),
            title: title.into(),
            value: None,
            required: [None; 2],
            unit,
            scale: 1.0,
            margin: None,
            progress: None,
        }
    }

    /// Goal with a minimum. `scale` is the size of a miss that leaves half the progress: positive, in the goal's unit.
    #[must_use]
    pub fn minimum(self, minimum: f64, scale: f64) -> Self {
        self.range([Some(minimum), None], scale)
    }

    /// Goal with a maximum; `scale` as in [`minimum`](Self::minimum).
    #[must_use]
    pub fn maximum(self, maximum: f64, scale: f64) -> Self {
        self.range([None, Some(maximum)], scale)
    }

    /// Goal with a range; an end that is `None` is open. `scale` as in [`minimum`](Self::minimum).
    #[must_use]
    pub fn range(self, required: [Option<f64>; 2], scale: f64) -> Self {
        Self {
            required,
            scale,
            ..self
        }
    }

    /// Goal with a required range as its file gives it, in the shown unit of the goal; without a scale, the size of the required
    /// figures.
    pub(crate) fn required(self, range: RequiredRange, scale: Option<f64>) -> Self {
        let kept = |shown: f64| shown / self.unit.factor();
        let required = range.ends().map(|end| end.map(kept));
        let ends = required.into_iter().flatten();
        let size = ends.fold(0.0, |size: f64, end| size.max(end.abs()));
        let usual = if size > 0.0 { size } else { kept(1.0) };
        let scale = scale.map_or(usual, kept);
        self.range(required, scale)
    }

    /// The goals of a paper, numbered in the order of the list. A different number in the paper is stored in `paper`.
    pub(crate) fn listed(mut goals: Vec<Self>) -> Vec<Self> {
        for (number, goal) in (1..).zip(&mut goals) {
            goal.paper = (goal.number != number).then_some(goal.number);
            goal.number = number;
        }
        goals
    }

    /// The goal with its figure, or without one if the figure is not known.
    #[must_use]
    pub fn with(self, value: impl Into<Option<f64>>) -> Self {
        let Some(value) = value.into() else {
            return Self {
                value: None,
                margin: None,
                progress: None,
                ..self
            };
        };
        let above = self.required[0].map_or(f64::INFINITY, |minimum| value - minimum);
        let below = self.required[1].map_or(f64::INFINITY, |maximum| maximum - value);
        let margin = match above.min(below) {
            // At the limit within rounding: the goal is met.
            margin if margin.abs() <= COMPUTED * value.abs().min(f64::MAX).max(self.scale) => 0.0,
            margin => margin,
        };
        let miss = (-margin).max(0.0) / self.scale;
        Self {
            value: Some(value),
            margin: Some(margin),
            progress: Some(1.0 / (1.0 + miss * miss)),
            ..self
        }
    }

    /// Whether the goal is met; `None` if it was not checked.
    #[must_use]
    pub fn met(&self) -> Option<bool> {
        self.margin.map(|margin| margin >= 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn goal(value: f64) -> Goal {
        Goal::new(2, "pick-angle", "pick angle", Unit::Count)
            .range([Some(-5.0), Some(15.0)], 20.0)
            .with(value)
    }

    #[test]
    fn margin_and_progress_follow_the_figure() {
        assert_eq!(goal(0.0).margin, Some(5.0));
        assert_eq!(goal(12.0).margin, Some(3.0));
        assert_eq!(goal(18.0).margin, Some(-3.0));
        assert_eq!(goal(15.0).met(), Some(true));
        assert_eq!(goal(15.1).met(), Some(false));
        assert_eq!(goal(35.0).progress, Some(0.5));
        let mut before = 1.0;
        for i in 0..400 {
            let progress = goal(15.0 + f64::from(i)).progress.expect("a figure");
            assert!(progress <= before && progress > 0.0 && (i == 0) == (progress == 1.0));
            before = progress;
        }
    }

    #[test]
    fn a_figure_at_its_limit_but_for_rounding_meets_it() {
        for figure in [
            15.0 + 2e-15,
            15.0 + 1e-10,
            -5.0 - 1e-15,
            -5.0 - 1e-10,
            15.0,
            -5.0,
        ] {
            let goal = goal(figure);
            assert_eq!(
                (goal.margin, goal.met(), goal.progress),
                (Some(0.0), Some(true), Some(1.0))
            );
        }
        for figure in [15.0 + 1e-6, -5.0 - 1e-6, f64::INFINITY, f64::NEG_INFINITY] {
            assert_eq!(goal(figure).met(), Some(false), "{figure}");
        }
    }

    #[test]
    fn progress_is_smooth_where_the_range_ends() {
        let slope = |value: f64| {
            let at = |value: f64| goal(value).progress.expect("a figure");
            (at(value + 1e-6) - at(value - 1e-6)) / 2e-6
        };
        assert!(slope(15.0).abs() < 1e-6 && (slope(15.001) - slope(15.0)).abs() < 1e-4);
    }

    #[test]
    fn what_was_not_looked_at_has_no_figure() {
        let known = Goal::new(1, "arm-clearance", "arms clear", Unit::Millimetre).with(1.0);
        let unknown = known.minimum(0.0, 1.0).with(None);
        assert_eq!(
            (unknown.met(), unknown.margin, unknown.progress),
            (None, None, None)
        );
    }
}
