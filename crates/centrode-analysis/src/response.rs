use centrode_geometry::Cancel;
use centrode_mechanism::design::{Design, DesignError};
use centrode_mechanism::mechanism::{Mechanism, MechanismError};
use rayon::prelude::{IntoParallelIterator, ParallelIterator};
use serde::Serialize;

use crate::{Report, check_mechanism, check_motion, figure};

/// How the figures of a mechanism answer one number of its design: the parameter response of Yin et al. 2021, Figure
/// 5, DOI 10.25165/j.ijabe.20211405.6844, for any number of any family.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Response {
    /// Key of the number in the design file.
    pub key: String,
    /// Its values, in the file's unit.
    pub values: Vec<f64>,
    /// The report at each value; none where it gives no mechanism.
    pub reports: Vec<Option<Report>>,
}

/// How much is asked of the design at each value of a [`Response`].
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq)]
pub enum Depth {
    /// What [`check_motion`] tells: all goals.
    #[default]
    Motion,
    /// What [`check_mechanism`] tells.
    Whole,
}

/// A figure at each value of a [`Response`].
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Answer {
    /// Name of the goal or figure.
    pub name: &'static str,
    /// Its unit: `mm`, `rad`, or empty for a plain number or a unit its name tells.
    pub unit: &'static str,
    /// The figure at each value; none where there is none.
    #[serde(serialize_with = "figure::options")]
    pub figures: Vec<Option<f64>>,
}

impl Response {
    /// Checks a design with each of the values, in the file's unit, at a key; all other numbers stay.
    ///
    /// # Errors
    /// [`DesignError`] where the key is no number of the design. A value that gives no mechanism is no error: its report
    /// is missing.
    pub fn of(
        design: &Design,
        key: &str,
        values: &[f64],
        depth: Depth,
    ) -> Result<Self, DesignError> {
        let numbered = design.numbered(key)?;
        let cancel = Cancel::current();
        let report = |&value: &f64| -> Option<Report> {
            let _scope = cancel.enter();
            let design = numbered.with(value).ok()?;
            let found: Result<Mechanism, MechanismError> = Mechanism::resolve(&design);
            let check = match depth {
                Depth::Motion => check_motion,
                Depth::Whole => check_mechanism,
            };
            Some(check(&found.ok()?))
        };
        Ok(Self {
            key: key.to_owned(),
            values: values.to_vec(),
            reports: values.into_par_iter().panic_fuse().map(report).collect(),
        })
    }

    /// The goals' figures, then all others, by name.
    #[must_use]
    pub fn answers(&self) -> Vec<Answer> {
        let mut found: Vec<Answer> = Vec::new();
        let add = |found: &mut Vec<Answer>, name, unit, at: usize, figure| {
            let place = found.iter().position(|answer| answer.name == name);
            let place = place.unwrap_or_else(|| {
                let figures = vec![None; self.values.len()];
                found.push(Answer {
                    name,
                    unit,
                    figures,
                });
                found.len() - 1
            });
            found[place].figures[at] = figure;
        };
        for (at, report) in self.reports.iter().enumerate() {
            for goal in report.iter().flat_map(|report| &report.goals) {
                add(&mut found, goal.name, goal.unit, at, goal.value);
            }
        }
        for (at, report) in self.reports.iter().enumerate() {
            for (name, value) in report.iter().flat_map(|report| &report.values) {
                // A goal's own figure has been told.
                if !found
                    .iter()
                    .any(|a| a.name == *name && a.figures[at].is_some())
                {
                    add(&mut found, name, "", at, Some(*value));
                }
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn template(family: &str) -> Design {
        Design::from_toml(Design::template(family).expect("a family")).expect("a design")
    }

    fn height(radius: f64) -> f64 {
        let text = Design::template("three-arm").expect("a family");
        let text = text.replace("radius = [21,", &format!("radius = [{radius:?},"));
        let design = Design::from_toml(&text).expect("a design");
        let report = check_mechanism(&Mechanism::resolve(&design).expect("a mechanism"));
        let goal = report
            .goals
            .iter()
            .find(|goal| goal.name == "trajectory-height");
        goal.and_then(|goal| goal.value).expect("a height")
    }

    #[test]
    fn each_answer_is_that_of_the_design_with_the_value() {
        let values = [15.0, 21.0, 27.0];
        let response = Response::of(
            &template("three-arm"),
            "pitch.radius[0]",
            &values,
            Depth::Motion,
        );
        let answers = response.expect("a number").answers();
        let of = |name: &str| answers.iter().find(|a| a.name == name).expect("there");
        let found = &of("trajectory-height").figures;
        let wanted: Vec<Option<f64>> = values.iter().map(|&r| Some(height(r))).collect();
        assert_eq!(*found, wanted);
        // "The larger the value of r1, the smaller the trajectory height", section 4.2 of the paper.
        assert!(found[0] > found[1] && found[1] > found[2], "{found:?}");
        assert_eq!(answers.iter().filter(|a| a.name == "module").count(), 1);
    }

    #[test]
    fn values_without_a_mechanism_leave_a_gap() {
        let response = Response::of(
            &template("three-arm"),
            "arm.tip_distance",
            &[-1.0, 145.0],
            Depth::Motion,
        );
        let response = response.expect("a number");
        assert!(response.reports[0].is_none() && response.reports[1].is_some());
        let answers = response.answers();
        assert!(answers.iter().all(|a| a.figures[0].is_none()));
    }

    #[test]
    fn teeth_are_asked_only_for_a_whole_answer() {
        let arms = template("three-arm");
        let of = |depth| {
            let response = Response::of(&arms, "r1", &[21.0], depth);
            let key = Response::of(&arms, &arms.key_of("r1"), &[21.0], depth);
            assert!(response.is_err());
            key.expect("a number").answers()
        };
        let (motion, whole) = (of(Depth::Motion), of(Depth::Whole));
        let has = |answers: &[Answer], name: &str| answers.iter().any(|a| a.name == name);
        assert!(!has(&motion, "mesh_phase_error_max") && has(&whole, "mesh_phase_error_max"));
        for answer in &motion {
            assert!(whole.contains(answer), "{}", answer.name);
        }
    }

    #[test]
    fn other_families_answer_too() {
        let pair = template("gear-pair");
        let response = Response::of(&pair, "teeth.backlash", &[0.02, 0.06], Depth::Motion);
        let answers = response.expect("a number").answers();
        let backlash = answers.iter().find(|a| a.name == "normal_backlash_min");
        let found = &backlash.expect("there").figures;
        assert!(found[1] > found[0], "{found:?}");
        assert!(Response::of(&pair, "teeth.blacklash.x", &[1.0], Depth::Motion).is_err());
    }
}
