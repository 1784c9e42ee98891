use centrode_synthesis::reverse::{AxisFault, AxisMap, PossibleAxis, ReversedMachine};
use numpy::{IntoPyArray, PyArrayMethods};
use pyo3::prelude::{Bound, PyAny, PyResult, Python};
use pyo3::types::PyTuple;

use crate::record::record;

/// Possible axes of a carrier; minimum radii for a bend, rad.
pub(super) fn axis_map<'py>(
    py: Python<'py>,
    map: &AxisMap,
    bend: f64,
) -> PyResult<Bound<'py, PyAny>> {
    let [columns, rows] = map.range().count;
    let shape = [rows as usize, columns as usize];
    let place = |i: u32, j: u32| map.range().axis(i, j);
    let figure = |of: &dyn Fn(&PossibleAxis) -> f64| {
        let figures = map.found().iter();
        let figures = figures.map(|found| found.as_ref().map_or(f64::NAN, of));
        figures
            .collect::<Vec<f64>>()
            .into_pyarray(py)
            .reshape(shape)
    };
    let ratios = map.found().iter();
    let ratios = ratios.flat_map(|found| found.as_ref().map_or([f64::NAN; 2], |axis| axis.ratios));
    let ratios = ratios.collect::<Vec<f64>>().into_pyarray(py);
    let possible = map.found().iter().map(Result::is_ok);
    let faults = map.found().chunks(columns as usize);
    let faults = faults.map(|row| {
        let names = row
            .iter()
            .map(|found| found.as_ref().err().map(AxisFault::name));
        PyTuple::new(py, names.collect::<Vec<_>>())
    });
    record!(py, "centrode._axes" "AxisMap", () => []
        x: (0..columns).map(|i| place(i, 0).x).collect::<Vec<f64>>().into_pyarray(py),
        y: (0..rows).map(|j| place(0, j).y).collect::<Vec<f64>>().into_pyarray(py),
        possible: possible.collect::<Vec<bool>>().into_pyarray(py).reshape(shape)?,
        fault: PyTuple::new(py, faults.collect::<PyResult<Vec<_>>>()?)?,
        carrier: figure(&|axis| axis.carrier)?,
        arm: figure(&|axis| axis.arm)?,
        ratios: ratios.reshape([rows as usize, columns as usize, 2])?,
        minimum_radius: figure(&|axis| axis.minimum_radius(bend))?,
        shaft_distance: figure(&|axis| axis.shaft_distance)?,
    )
}

/// Figures of a split of a motion over two stages of gears, or why there is none.
pub(super) fn split_figures<'py>(
    py: Python<'py>,
    name: &str,
    made: &Result<ReversedMachine, String>,
) -> PyResult<Bound<'py, PyAny>> {
    let (radii, convex, tip_error) = match made {
        Ok(made) => (
            &made.minimum_radii[..],
            &made.convex[..],
            made.tip_error.value,
        ),
        Err(_) => (&[][..], &[][..], f64::NAN),
    };
    record!(py, "centrode._axes" "SplitFigures", () => []
        name: name,
        minimum_radii: PyTuple::new(py, radii.iter().map(|pair| (pair[0], pair[1])))?,
        convex: PyTuple::new(py, convex.iter().map(|pair| (pair[0], pair[1])))?,
        tip_error: tip_error,
        refusal: made.as_ref().err(),
    )
}
