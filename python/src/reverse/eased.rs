use std::ops::ControlFlow;

use centrode_analysis::{Finding, Goal};
use centrode_geometry::Point;
use centrode_synthesis::optimise::{Easing, EasingSpec};
use centrode_synthesis::reverse::{Aim, AxisRange, DrawnPath, TwoBar, Wishes};
use pyo3::prelude::{Python, pyfunction};

use crate::array::{Rows, Values};
use crate::error::{Answer, Raised};
use crate::wait::wait;

/// Room that a path has.
#[derive(Debug)]
pub(super) struct Request {
    pub(super) bands: Vec<f64>,
    pub(super) module: Option<f64>,
    /// Whether the return from the last point to the first is free.
    pub(super) is_open: bool,
    pub(super) aim: Option<Aim>,
    pub(super) wishes: Wishes,
    /// Corners of the box in which the axis is searched, mm.
    pub(super) axis_box: Option<[[f64; 2]; 2]>,
}

/// A path eased within bands.
#[derive(Debug)]
pub(super) struct Eased {
    pub(super) requested: Request,
    pub(super) points: Vec<Point>,
    /// Module up to which full teeth are surely sound, mm.
    pub(super) module: f64,
    pub(super) goals: Vec<Goal>,
    /// Direction of the clamp less that of the arm, rad.
    pub(super) clamp: Option<f64>,
    pub(super) findings: Vec<Finding>,
}

/// Bands and module that were requested.
pub(super) fn requested(
    band: Option<Values>,
    module: Option<f64>,
    is_open: bool,
    aim: Option<Aim>,
    wishes: Wishes,
    axis_box: Option<[[f64; 2]; 2]>,
) -> Answer<Option<Request>> {
    let is_wished = aim.is_some() || !wishes.is_free();
    let requested = |bands: Vec<f64>| {
        Ok(Some(Request {
            bands,
            module,
            is_open,
            aim,
            wishes,
            axis_box,
        }))
    };
    match (band, module) {
        (Some(band), _) => requested(band.into_flat()),
        (None, _) if is_open => requested(vec![0.0]),
        (None, None) if is_wished => requested(vec![0.0]),
        (None, None) => Ok(None),
        (None, Some(_)) => {
            let sentence = "it limits how far a path is eased: give band";
            Err(Raised::sentence("module", sentence.into()))
        }
    }
}

impl Eased {
    /// Eases a path; its chain, and what was found.
    pub(super) fn search(
        points: &[Point],
        requested: Request,
        axis: Option<(f64, f64)>,
        bend_deg: f64,
    ) -> Answer<(TwoBar, Self)> {
        let axis = axis.map(|(x, y)| Point::new(x, y));
        let spec = EasingSpec {
            axis,
            axes: requested.axis_box.map(AxisRange::between),
            aim: requested.aim.unwrap_or_default(),
            wishes: requested.wishes.clone(),
            ..EasingSpec::new(&requested.bands, bend_deg.to_radians())
        };
        let easing = match requested.is_open {
            true => Easing::with_free_return(points, &spec),
            false => Easing::new(points, &spec),
        };
        let found = easing?.search(requested.module, &mut |_| ControlFlow::Continue(()))?;
        let eased = Self {
            requested,
            module: found.module.1,
            points: found.points,
            goals: found.goals,
            clamp: found.clamp,
            findings: found.findings,
        };
        Ok((found.chain, eased))
    }
}

/// Points along the path of an SVG file, given as bytes.
#[pyfunction]
pub(crate) fn _drawn_path(py: Python<'_>, contents: Vec<u8>, within: f64) -> Answer<Rows<2>> {
    let drawn = wait(py, move || DrawnPath::from_svg(&contents, within))??;
    Ok(Rows::new(&drawn.points))
}
