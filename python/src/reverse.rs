mod eased;
mod given;
mod tables;
mod wished;

use std::ops::ControlFlow;
use std::sync::{Arc, OnceLock};

use centrode_analysis::{machine_collisions, with_sound_teeth};
use centrode_kinematics::machine::Piecewise;
use centrode_kinematics::transmission::Transmission as _;
use centrode_spec::Design as _;
use centrode_synthesis::optimise::three_arm::PosedProblem;
use centrode_synthesis::reverse::{
    Aim, AxisMap, KeyPoses, PathDesign, RequiredPath, ReversedMachine, Split, SplitKind, TwoBar,
};
use pyo3::prelude::{Bound, Py, PyAny, PyResult, Python, pyclass, pymethods};
use pyo3::types::PyTuple;

use crate::array::{Course, Rows, Values};
use crate::design::{Class, object, read};
use crate::error::{Answer, Raised};
use crate::machine::Machine;
use crate::made::{Reduced, by};
use crate::record::{self, Keywords};
use crate::wait::wait;
use crate::word::Word;

use eased::Eased;
use given::Given;
use tables::{axis_map, split_figures};

pub(crate) use eased::_drawn_path;
pub(crate) use given::{reverse, reverse_poses};

/// Bytes read of a path's file: one more than it may have.
pub(crate) const LARGEST: usize = RequiredPath::LARGEST + 1;

/// A machine designed from the path of its tip, by `reverse`, or from key poses, by `reverse_poses`.
///
/// A carrier turns about `axis` and supports an arm. A gear train with a fixed sun turns the arm by one turn relative to
/// the carrier for each turn of the carrier.
#[pyclass(frozen, module = "centrode")]
#[derive(Debug)]
pub(crate) struct Reversed {
    given: Given,
    bend_deg: f64,
    arms: u32,
    chain: TwoBar,
    law: Arc<Piecewise>,
    split: Split,
    made: ReversedMachine,
    axes: OnceLock<AxisMap>,
}

impl Reversed {
    fn eased_path(&self) -> Option<&Eased> {
        match &self.given {
            Given::Path { eased, .. } => eased.as_deref(),
            Given::Poses { .. } => None,
        }
    }

    fn new(
        given: Given,
        chain: TwoBar,
        axes: OnceLock<AxisMap>,
        (kind, bend_deg, arms): (SplitKind, f64, u32),
    ) -> Answer<Self> {
        let split = Split::new(&chain, kind, bend_deg.to_radians())?;
        let mut made = ReversedMachine::new(&chain, &split, arms, None)?;
        if let Given::Path {
            eased: Some(eased), ..
        } = &given
        {
            made = made.with_obstacles(&eased.requested.wishes.keep_out);
        }
        let law = chain
            .law()
            .map_err(centrode_synthesis::reverse::SplitError::from)?;
        Ok(Self {
            given,
            bend_deg,
            arms,
            chain,
            law: Arc::new(law),
            split,
            made,
            axes,
        })
    }
}

#[pymethods]
impl Reversed {
    /// Axis of the carrier, mm.
    #[getter]
    fn axis(&self) -> (f64, f64) {
        (self.chain.axis().x, self.chain.axis().y)
    }

    /// Length of the carrier, from its axis to the axis of the arm, mm.
    #[getter]
    fn carrier(&self) -> f64 {
        self.chain.carrier()
    }

    /// Length of the arm, from its axis to the tip, mm.
    #[getter]
    fn arm(&self) -> f64 {
        self.chain.arm()
    }

    /// Direction in which the carrier turns, "clockwise" or "counter-clockwise".
    #[getter]
    fn direction(&self) -> &'static str {
        self.chain.direction().word()
    }

    /// Minimum and maximum ratio of the total law.
    #[getter]
    fn ratios(&self) -> (f64, f64) {
        let [minimum, maximum] = self.chain.ratios();
        (minimum.value, maximum.value)
    }

    /// Minimum convex radius of curvature of the pitch curves, mm, for the gears as written in the design.
    #[getter]
    fn minimum_radius(&self) -> f64 {
        self.made.minimum_radius()
    }

    /// Minimum distance of the tip from the carrier's axis, mm.
    #[getter]
    fn shaft_distance(&self) -> f64 {
        self.chain.shaft_distance()
    }

    /// Method by which the two gear stages share the motion.
    #[getter]
    fn split(&self) -> &'static str {
        self.split.kind().name()
    }

    /// Points of the eased path, mm, an array (N, 2), with those of the free return; a closed spline of degree five
    /// passes through them. None unless `band` or `open` was given.
    #[getter]
    fn eased(&self) -> Option<Rows<2>> {
        Some(Rows::new(&self.eased_path()?.points))
    }

    /// Module up to which full teeth on the eased path are guaranteed to be sound, mm. None unless `band` or `open` was
    /// given.
    #[getter]
    fn full_module(&self) -> Option<f64> {
        Some(self.eased_path()?.module)
    }

    /// The requirements of `wishes` as goals, each with its figure and its progress.
    #[getter]
    fn goals<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        record::goals(py, self.eased_path().map_or(&[], |eased| &eased.goals))
    }

    /// Findings about the machine: `axis-at-border` if the axis found is at the border of its box; for several arms also
    /// `plates-collide` and `gears-collide` as in the check of `machine()`, the deepest collision first.
    ///
    /// For several arms, this computes the teeth of `machine()`, which takes longer.
    #[getter]
    fn findings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let mut found = match &self.given {
            Given::Path { findings, .. } => findings.clone(),
            Given::Poses { .. } => Vec::new(),
        };
        if self.arms > 1 {
            let design = self.made.design.clone();
            // Without sound teeth there is no machine.
            let collisions = move || match with_sound_teeth(&design, |_| true) {
                Ok((design, _)) => machine_collisions(&design),
                Err(_) => Vec::new(),
            };
            found.extend(wait(py, collisions)?);
        }
        record::findings(py, &found)
    }

    /// Maximum distance of the tip from the path, mm, with the laws of the gears as written in the design.
    #[getter]
    fn tip_error(&self) -> f64 {
        self.made.tip_error.value
    }

    /// Angle from the arm to the clamp, degrees; None for a path without directions.
    #[getter]
    fn clamp_deg(&self) -> Option<f64> {
        match &self.given {
            Given::Path { eased, .. } => Some(eased.as_ref()?.clamp?.to_degrees()),
            Given::Poses { found, .. } => Some(found.clamp.to_degrees()),
        }
    }

    /// Errors at the key poses: distance of the path, mm, and direction error of the clamp, degrees; an array (N, 2).
    /// None for a path.
    #[getter]
    fn misses(&self) -> Option<Rows<2>> {
        match &self.given {
            Given::Path { .. } => None,
            Given::Poses { found, .. } => {
                let stated = |[off, turned]: &[f64; 2]| [*off, turned.to_degrees()];
                Some(Rows(found.misses.iter().map(stated).collect()))
            }
        }
    }

    /// Total law: angle of the planet relative to the carrier as a function of the carrier's direction, rad; zero where
    /// the bars are stretched. For an array, an array of the same shape.
    fn law(&self, direction: Values) -> Course {
        let law = Arc::clone(&self.law);
        Course::each(direction, move |psi| law.at(psi).position)
    }

    /// Figures for each method by which the two gear stages can share this motion, or the reason why it is not possible.
    ///
    /// >>> import centrode as ct
    /// >>> path = [(0, 0), (60, 70), (150, 150), (230, 215), (262, 262), (235, 300), (170, 330),
    /// ...         (100, 330), (40, 300), (-5, 250), (-30, 190), (-38, 130), (-30, 60)]
    /// >>> powers, mildest, one_pair = ct.reverse(path, (260, 160), bend_deg=40).splits
    /// >>> mildest.name, mildest.minimum_radius > 1.2 * powers.minimum_radius
    /// ('mildest', True)
    #[getter]
    fn splits<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let (chain, bend) = (self.chain.clone(), self.bend_deg.to_radians());
        let found = wait(py, move || {
            SplitKind::ALL.map(|kind| {
                let split = Split::new(&chain, kind, bend).map_err(|error| error.to_string());
                let made = |split| ReversedMachine::new(&chain, &split, 1, None);
                (
                    kind.name(),
                    split.and_then(|split| made(split).map_err(|error| error.to_string())),
                )
            })
        })?;
        let found = found
            .iter()
            .map(|(name, made)| split_figures(py, name, made));
        record::tuple(py, found)
    }

    /// Map of the possible axes of the carrier on and around the path.
    ///
    /// >>> import centrode as ct
    /// >>> import math
    /// >>> path = [(math.cos(t) * (3 + math.cos(t)), 2 * math.sin(t)) for t in (0.2 * k for k in range(31))]
    /// >>> axes = ct.reverse(path).axes
    /// >>> axes.possible.shape == (len(axes.y), len(axes.x))
    /// True
    #[getter]
    fn axes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        if self.axes.get().is_none() {
            let path = self.chain.path().clone();
            let axis_box = match &self.given {
                Given::Path { axis_box, .. } => *axis_box,
                Given::Poses { .. } => None,
            };
            let design = PathDesign {
                axis_box,
                ..PathDesign::default()
            };
            let map = wait(py, move || AxisMap::new(&path, design.axes(&path)))?;
            // Another thread may have been quicker, with the same map.
            let _ = self.axes.set(map);
        }
        let Some(map) = self.axes.get() else {
            return Ok(py.None().into_bound(py));
        };
        axis_map(py, map, self.bend_deg.to_radians())
    }

    /// The machine with the largest teeth whose flanks alone transmit the motion.
    ///
    /// Raises:
    ///     MechanismError: There are no such teeth, or a part cannot be made.
    fn machine(&self, py: Python<'_>) -> Answer<Py<Machine>> {
        let design = self.made.design.clone();
        let composed = wait(py, move || {
            let (design, _) = with_sound_teeth(&design, |_| true)?;
            Ok::<_, Raised>(
                <Machine as Class>::Machine::resolve(&design)
                    .map_err(centrode_spec::MechanismError::from)?,
            )
        })??;
        Machine::object(py, composed)
    }

    /// The three-arm transplanting mechanism that passes through the key poses, picks in the first and plants in the
    /// last.
    ///
    /// The bend and the law of its gears are searched so that it reaches its goals with sound full teeth; `split` and
    /// `bend_deg` are not used. If no mechanism reaches all goals, the closest one is returned, and its goals show the
    /// misses.
    ///
    /// Raises:
    ///     MechanismError: A path was given, the clamp points back towards the arm's axis, or no law moves the arm
    ///         through the poses.
    fn three_arm<'py>(&self, py: Python<'py>) -> Answer<Bound<'py, PyAny>> {
        let Given::Poses { found, .. } = &self.given else {
            let sentence =
                "a path does not define the clamp: use key poses for a three-arm mechanism";
            return Err(Raised::no_mechanism("three_arm", sentence.into()));
        };
        let (poses, arms) = (found.poses.clone(), self.arms);
        let text = wait(py, move || {
            let chains = KeyPoses::mildest(&poses, PosedProblem::CHAINS)?;
            let found = PosedProblem::search(&chains, arms, &mut |_, _| ControlFlow::Continue(()))?;
            Ok::<_, Raised>(found.design.to_toml()?)
        })??;
        object(py, &read(py, text.as_bytes())?)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        let keywords = Keywords::new(py);
        let (name, keywords) = match &self.given {
            Given::Path {
                points,
                axis,
                axis_box,
                eased,
                ..
            } => {
                let keywords = keywords.with("path", Rows::new(points))?;
                let keywords = keywords.with("axis", *axis)?.with("axis_box", *axis_box)?;
                let requested = eased.as_ref().map(|eased| &eased.requested);
                let keywords =
                    keywords.with("band", requested.map(|requested| requested.bands.clone()))?;
                let keywords =
                    keywords.with("open", requested.is_some_and(|requested| requested.is_open))?;
                let module = requested.and_then(|requested| requested.module);
                let keywords = keywords.with("module", module)?;
                let aim = requested.and_then(|requested| requested.aim.map(Aim::name));
                let wishes = requested.filter(|requested| !requested.wishes.is_free());
                let wishes = wishes.map(|requested| wished::keywords(py, &requested.wishes));
                let keywords = keywords.with("aim", aim)?;
                ("reverse", keywords.with("wishes", wishes.transpose()?)?)
            }
            Given::Poses { rows, .. } => ("reverse_poses", keywords.with("poses", rows.clone())?),
        };
        let keywords = keywords
            .with("split", self.split())?
            .with("bend_deg", self.bend_deg)?
            .with("arms", self.arms)?;
        by(name, keywords)
    }

    fn __repr__(&self) -> String {
        let (x, y) = self.axis();
        format!(
            "<Reversed: axis ({x:.4}, {y:.4}), carrier {:.4}, arm {:.4}, split {}>",
            self.carrier(),
            self.arm(),
            self.split()
        )
    }
}
