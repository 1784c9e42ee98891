use std::sync::Arc;

use centrode_geometry::Tolerance;
use centrode_mechanism::gear as mechanism;
use centrode_mechanism::gear::Member;
use centrode_mechanism::gear::design::{Addendum, GearPairDesign, Phase, TeethSpec};
use numpy::{PyArray2, PyArrayDyn};
use pyo3::FromPyObject;
use pyo3::prelude::{Bound, PyRef, PyResult, Python, pyclass, pymethods};

use crate::array::{Values, each, points};
use crate::error::{DesignError, of_pair};
use crate::pitch::Pitch;
use crate::tool::Tool;

/// A non-circular gear pair: exact pitch curves, finished teeth.
#[pyclass(frozen, module = "centrode")]
#[derive(Debug)]
pub(crate) struct GearPair {
    pair: Arc<mechanism::GearPair>,
}

/// One gear of a pair, in its own frame.
#[pyclass(frozen, module = "centrode")]
#[derive(Debug)]
pub(crate) struct Gear {
    pair: Arc<mechanism::GearPair>,
    member: Member,
}

/// Where the teeth sit: a word, or pitches from the polar angle zero to the middle of a tooth.
#[derive(FromPyObject)]
pub(crate) enum Place {
    /// Pitches.
    Pitches(f64),
    /// A word.
    Word(String),
}

impl Place {
    fn phase(self) -> PyResult<Phase> {
        match self {
            Self::Pitches(pitches) => Ok(Phase::Pitches(pitches)),
            Self::Word(word) => match word.as_str() {
                "auto" => Ok(Phase::Auto),
                "tooth" => Ok(Phase::Tooth),
                "space" => Ok(Phase::Space),
                "congruent" => Ok(Phase::Congruent),
                _ => Err(DesignError::new_err(format!(
                    "phase must be \"auto\", \"tooth\", \"space\", \"congruent\" or a number of pitches, not \"{word}\""
                ))),
            },
        }
    }
}

fn addendum(word: &str) -> PyResult<Addendum> {
    match word {
        "full" => Ok(Addendum::Full),
        "fitted" => Ok(Addendum::Fitted),
        _ => Err(DesignError::new_err(format!(
            "addendum must be \"full\" or \"fitted\", not \"{word}\""
        ))),
    }
}

#[pymethods]
impl GearPair {
    #[new]
    #[pyo3(signature = (pitch, *, mean_ratio=(1, 1), tooth_count=None, center_distance=None, tool=None, addendum="full", phase=None, backlash=0.0, backlash_angle=None, thickness_split=0.5, least_tip_width_coefficient=0.2, name="gear-pair", title=""))]
    #[expect(clippy::too_many_arguments, reason = "keyword arguments")]
    fn new(
        py: Python<'_>,
        pitch: PyRef<'_, Pitch>,
        mean_ratio: (u32, u32),
        tooth_count: Option<u32>,
        center_distance: Option<f64>,
        tool: Option<Tool<'_>>,
        addendum: &str,
        phase: Option<Place>,
        backlash: f64,
        backlash_angle: Option<f64>,
        thickness_split: f64,
        least_tip_width_coefficient: f64,
        name: &str,
        title: &str,
    ) -> PyResult<Self> {
        let mut design = GearPairDesign::new(pitch.spec.clone());
        design.name = name.into();
        design.title = title.into();
        design.mean_ratio = mean_ratio.into();
        design.tooth_count = tooth_count;
        design.center_distance = center_distance;
        design.tool = tool.map(|t| t.spec()).unwrap_or_default();
        design.teeth = TeethSpec {
            addendum: self::addendum(addendum)?,
            phase: phase.map_or(Ok(Phase::Auto), Place::phase)?,
            backlash,
            backlash_angle,
            thickness_split,
            least_tip_width_coefficient,
        };
        let pair = py
            .detach(|| mechanism::GearPair::resolve(&design))
            .map_err(|e| of_pair(&e))?;
        Ok(Self {
            pair: Arc::new(pair),
        })
    }

    /// Name, as written in the design.
    #[getter]
    fn name(&self) -> &str {
        self.pair.name()
    }

    /// Distance between the shafts, mm.
    #[getter]
    fn center_distance(&self) -> f64 {
        self.pair.center_distance()
    }

    /// Module, mm.
    #[getter]
    fn module(&self) -> f64 {
        self.pair.module()
    }

    /// Turns of driver : turns of driven gear.
    #[getter]
    fn mean_ratio(&self) -> (u32, u32) {
        self.pair.mean_ratio()
    }

    /// Pitches from the polar angle zero to the middle of the driver's first tooth.
    #[getter]
    fn phase(&self) -> f64 {
        self.pair.phase()
    }

    /// Whether both gears are the same part.
    #[getter]
    fn congruent(&self) -> bool {
        self.pair.congruent()
    }

    /// Driver angle after which both gears stand as they did, rad.
    #[getter]
    fn cycle(&self) -> f64 {
        self.pair.cycle()
    }

    /// The gear that is turned.
    #[getter]
    fn driver(&self) -> Gear {
        self.gear(Member::Driver)
    }

    /// The gear that is driven.
    #[getter]
    fn driven(&self) -> Gear {
        self.gear(Member::Driven)
    }

    /// Driven angle at each driver angle, rad.
    fn driven_angle<'py>(&self, py: Python<'py>, phi: Values<'py>) -> Bound<'py, PyArrayDyn<f64>> {
        each(py, &phi, |phi| self.pair.driven_angle(phi))
    }

    /// Driven turn per driver turn at each driver angle.
    fn ratio<'py>(&self, py: Python<'py>, phi: Values<'py>) -> Bound<'py, PyArrayDyn<f64>> {
        each(py, &phi, |phi| self.pair.ratio(phi))
    }

    /// Change of the ratio per radian at each driver angle.
    fn ratio_slope<'py>(&self, py: Python<'py>, phi: Values<'py>) -> Bound<'py, PyArrayDyn<f64>> {
        each(py, &phi, |phi| self.pair.ratio_slope(phi))
    }

    fn __repr__(&self) -> String {
        format!("GearPair({})", self.pair.definition())
    }
}

impl GearPair {
    fn gear(&self, member: Member) -> Gear {
        Gear {
            pair: Arc::clone(&self.pair),
            member,
        }
    }
}

impl Gear {
    fn inner(&self) -> &mechanism::Gear {
        self.pair.gear(self.member)
    }
}

#[pymethods]
impl Gear {
    /// Number of teeth.
    #[getter]
    fn tooth_count(&self) -> u32 {
        self.inner().tooth_count()
    }

    /// Length of the pitch curve, mm.
    #[getter]
    fn pitch_length(&self) -> f64 {
        self.inner().pitch_length()
    }

    /// Area inside the outline, mm^2.
    #[getter]
    fn area(&self) -> f64 {
        self.inner().outline().area()
    }

    /// The toothed contour within a tolerance, (N, 2), counter-clockwise; the last point joins the first.
    #[pyo3(signature = (*, tolerance))]
    fn outline<'py>(&self, py: Python<'py>, tolerance: f64) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let tolerance = within(tolerance)?;
        points(py, &self.inner().outline().flatten(tolerance))
    }

    /// The pitch curve within a tolerance, (N, 2), counter-clockwise.
    #[pyo3(signature = (*, tolerance))]
    fn pitch_curve<'py>(
        &self,
        py: Python<'py>,
        tolerance: f64,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let tolerance = within(tolerance)?;
        points(py, &self.inner().pitch_curve().flatten(tolerance))
    }

    fn __repr__(&self) -> String {
        format!(
            "Gear({}, {} teeth)",
            self.member.name(),
            self.inner().tooth_count()
        )
    }
}

fn within(tolerance: f64) -> PyResult<Tolerance> {
    Tolerance::new(tolerance).map_err(|e| DesignError::new_err(e.to_string()))
}
