use std::ops::ControlFlow;

use centrode_analysis::optimise::Easing;
use centrode_geometry::Point;
use centrode_mechanism::reverse::{DrawnPath, TwoBar};
use pyo3::prelude::{Python, pyfunction};

use crate::array::{Rows, Values};
use crate::error::{Answer, Raised};
use crate::wait::wait;

/// A path eased within bands.
#[derive(Debug)]
pub(super) struct Eased {
    pub(super) bands: Vec<f64>,
    pub(super) wanted: Option<f64>,
    pub(super) points: Vec<Point>,
    /// Module up to which full teeth are surely sound, mm.
    pub(super) module: f64,
}

/// Bands and module that were asked for.
pub(super) fn asked(
    band: Option<Values>,
    module: Option<f64>,
) -> Answer<Option<(Vec<f64>, Option<f64>)>> {
    match (band, module) {
        (Some(band), module) => Ok(Some((band.into_flat(), module))),
        (None, None) => Ok(None),
        (None, Some(_)) => {
            let sentence = "it eases a path: say by how much with band";
            Err(Raised::sentence("module", sentence.into()))
        }
    }
}

impl Eased {
    /// Eases a path; its chain, and what was found.
    pub(super) fn search(
        points: &[Point],
        (bands, wanted): (Vec<f64>, Option<f64>),
        axis: Option<(f64, f64)>,
        bend_deg: f64,
    ) -> Answer<(TwoBar, Self)> {
        let axis = axis.map(|(x, y)| Point::new(x, y));
        let easing = Easing::new(points, &bands, axis, bend_deg.to_radians());
        let found = easing?.search(wanted, &mut |_| ControlFlow::Continue(()))?;
        let eased = Self {
            bands,
            wanted,
            module: found.module.1,
            points: found.points,
        };
        Ok((found.chain, eased))
    }
}

/// Points along the path of an SVG file's bytes.
#[pyfunction]
pub(crate) fn _drawn_path(py: Python<'_>, contents: Vec<u8>, within: f64) -> Answer<Rows<2>> {
    let drawn = wait(py, move || DrawnPath::from_svg(&contents, within))??;
    Ok(Rows::of(&drawn.points))
}
