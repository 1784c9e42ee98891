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

/// A machine made from the path required of its tip, by `reverse`, or from key poses, by `reverse_poses`.
///
/// A carrier turns about `axis` and supports an arm; a train of gears whose sun is fixed turns the arm once against it while
/// it turns once.
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

    /// Length of the carrier, from its axis to the arm's, mm.
    #[getter]
    fn carrier(&self) -> f64 {
        self.chain.carrier()
    }

    /// Length of the arm, from its axis to the tip, mm.
    #[getter]
    fn arm(&self) -> f64 {
        self.chain.arm()
    }

    /// Sense in which the carrier turns, "clockwise" or "counter-clockwise".
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

    /// Minimum radius of curvature of the pitch curves where they are convex, mm, of the gears as they are written.
    #[getter]
    fn minimum_radius(&self) -> f64 {
        self.made.minimum_radius()
    }

    /// Minimum distance of the tip from the carrier's axis, mm.
    #[getter]
    fn shaft_distance(&self) -> f64 {
        self.chain.shaft_distance()
    }

    /// Method by which two stages of gears share the motion.
    #[getter]
    fn split(&self) -> &'static str {
        self.split.kind().name()
    }

    /// Points of the path that was eased, mm, an array (N, 2), where `band` was given or `open`, with those of the free return: a
    /// closed spline of degree five runs through them.
    #[getter]
    fn eased(&self) -> Option<Rows<2>> {
        Some(Rows::new(&self.eased_path()?.points))
    }

    /// Module up to which full teeth are surely sound on the eased path, mm, where `band` was given or `open`.
    #[getter]
    fn full_module(&self) -> Option<f64> {
        Some(self.eased_path()?.module)
    }

    /// Further wishes as goals, with how far they are reached.
    #[getter]
    fn goals<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        record::goals(py, self.eased_path().map_or(&[], |eased| &eased.goals))
    }

    /// Findings on the machine: that the axis found is at the border of its box, `axis-at-border`, and of several
    /// arms whose plates or gears collide, `plates-collide` and `gears-collide`, as the check of `machine()` reports it, the deepest
    /// first. Several arms cost the teeth of `machine()`.
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

    /// Maximum distance of the tip from the path, mm, with the laws of the gears as the design holds them.
    #[getter]
    fn tip_error(&self) -> f64 {
        self.made.tip_error.value
    }

    /// Direction of the clamp less that of the arm, degrees; None where a path was given and no directions along it.
    #[getter]
    fn clamp_deg(&self) -> Option<f64> {
        match &self.given {
            Given::Path { eased, .. } => Some(eased.as_ref()?.clamp?.to_degrees()),
            Given::Poses { found, .. } => Some(found.clamp.to_degrees()),
        }
    }

    /// How far the path is from each key pose, mm, and the clamp there from its direction, degrees: an array (N, 2); None where
    /// a path was given.
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

    /// Turn of the planet against the carrier by the carrier's direction, rad, zero where the bars are stretched: of an array,
    /// an array of the same shape.
    fn law(&self, direction: Values) -> Course {
        let law = Arc::clone(&self.law);
        Course::each(direction, move |psi| law.at(psi).position)
    }

    /// Figures of every way in which two stages of gears may share the motion here, or why there are none.
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

    /// Possible axes of the carrier on and about the path.
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

    /// The machine with the largest teeth whose flanks carry the motion alone.
    ///
    /// Raises:
    ///     MechanismError: There are no such teeth, or its parts cannot be made.
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

    /// The three-arm transplanting mechanism that takes the key poses, picks in the first and plants in the last.
    ///
    /// Bend and law of its gears are searched so that it reaches its goals with sound full teeth; of `split` and `bend_deg` nothing
    /// is taken. Where none is found that reaches all, the nearest is given: its goals show the misses.
    ///
    /// Raises:
    ///     MechanismError: A path was given, the clamp points back at the arm's axis, or no law brings the arm through the poses.
    fn three_arm<'py>(&self, py: Python<'py>) -> Answer<Bound<'py, PyAny>> {
        let Given::Poses { found, .. } = &self.given else {
            let sentence =
                "a path says nothing of the clamp: a three-arm mechanism is made from key poses";
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
