use crate::array::{MeshRows, Rows, mesh};
use crate::body::Body;
use crate::error::{Answer, positive, tolerance as within};
use crate::files::_write;
use crate::made::{Made, Reduced};
use crate::sheet::{drawing, sheet};
use crate::solid::Sides;
use crate::wait::wait;
use crate::{record, tool};
use centrode_export::Options;
use centrode_export::gear_pair::{self, subject_files};
use centrode_formats::Format;
use centrode_gear as mechanism;
use centrode_gear::Member;
use centrode_geometry::{Solid, Tolerance};
use numpy::{IntoPyArray, PyArray1, PyFixedUnicode};
use pyo3::prelude::{Bound, Py, PyAny, PyDictMethods, PyResult, Python, pyclass, pymethods};
use pyo3::types::{PyDict, PyTuple};
use std::path::PathBuf;
use std::sync::Arc;

/// One gear of a pair, in its own frame. Its axes are parallel to those of the machine at phi = 0.
#[pyclass(frozen, eq, module = "centrode")]
#[derive(Debug)]
pub(crate) struct Gear {
    pub(crate) pair: Arc<mechanism::GearPair>,
    pub(crate) member: Member,
    pub(crate) made: Made,
}

impl PartialEq for Gear {
    fn eq(&self, other: &Self) -> bool {
        self.member == other.member && self.pair.design() == other.pair.design()
    }
}

impl Gear {
    fn inner(&self) -> &mechanism::Gear {
        self.pair.gear(self.member)
    }

    fn within(&self, tolerance: f64) -> Answer<Tolerance> {
        within(tolerance, self.pair.accuracy())
    }

    /// Runs a long computation on the gear.
    fn ask<T: Send + 'static>(
        &self,
        py: Python<'_>,
        ask: impl FnOnce(&mechanism::Gear) -> T + Send + 'static,
    ) -> PyResult<T> {
        let (pair, member) = (Arc::clone(&self.pair), self.member);
        wait(py, move || ask(pair.gear(member)))
    }

    /// Makes the gear's file of a format and writes it whole or not at all.
    fn write(
        &self,
        py: Python<'_>,
        path: PathBuf,
        format: Format,
        tolerance: f64,
    ) -> Answer<PathBuf> {
        let (pair, member) = (Arc::clone(&self.pair), self.member);
        let options = Options::new(self.within(tolerance)?);
        let made = wait(py, move || {
            subject_files(&pair, member.into(), &[format], &options)
        })??;
        let mut files = made.into_files().map(|(_, bytes)| bytes);
        _write(py, path, files.next().unwrap_or_default())
    }
}

/// A word in a fixed-width `NumPy` array; every role fits.
fn fixed(word: &str) -> PyFixedUnicode<6> {
    let mut letters = [0; 6];
    for (cell, letter) in letters.iter_mut().zip(word.chars()) {
        *cell = u32::from(letter);
    }
    PyFixedUnicode(letters)
}

#[pymethods]
impl Gear {
    /// "driver" or "driven".
    #[getter]
    fn member(&self) -> &'static str {
        self.member.name()
    }

    /// Number of teeth.
    #[getter]
    fn tooth_count(&self) -> u32 {
        self.inner().tooth_count()
    }

    /// Profile shift coefficient, in modules.
    ///
    /// >>> import centrode as ct
    /// >>> pitch = ct.pitch.circle(module=2, tooth_count=12)
    /// >>> ct.GearPair(pitch, mean_ratio=(2, 1), driver_shift=0.3).driven.shift
    /// -0.3
    #[getter]
    fn shift(&self) -> f64 {
        self.pair.shift(self.member)
    }

    /// Tool that cuts the gear.
    #[getter]
    fn tool(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        tool::object(py, self.pair.settled_design().tool_of(self.member))
    }

    /// Length of the pitch curve, mm.
    #[getter]
    fn pitch_length(&self) -> f64 {
        self.inner().pitch_length()
    }

    /// Area inside the outline, mm^2; the bore is not subtracted.
    #[getter]
    fn area(&self) -> f64 {
        self.inner().outline().area()
    }

    /// Minimum and maximum distance of the outline from the shaft axis, mm.
    #[getter]
    fn radii(&self) -> (f64, f64) {
        self.inner().radii()
    }

    /// Width, bore and material.
    #[getter]
    fn body(&self) -> Body {
        Body(self.inner().body().clone())
    }

    /// The teeth in the order they mesh.
    #[getter]
    fn teeth<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        record::teeth(py, self.inner().teeth())
    }

    /// Measurement with a pin in every space. Default diameter (mm): that of the design, otherwise chosen to fit.
    ///
    /// >>> import centrode as ct
    /// >>> pair = ct.GearPair(ct.pitch.circle(module=2, tooth_count=24))
    /// >>> over = pair.driver.over_pins(diameter=3.5)
    /// >>> print(f"{over.across[0]:.4f}")
    /// 52.9513
    #[pyo3(signature = (diameter=None))]
    fn over_pins<'py>(&self, py: Python<'py>, diameter: Option<f64>) -> Answer<Bound<'py, PyAny>> {
        let given = diameter.map(|d| positive("diameter", d)).transpose()?;
        let diameter = given.unwrap_or_else(|| self.pair.pin_diameter(self.member));
        let over = self.ask(py, move |gear| gear.over_pins(diameter))?;
        Ok(record::over_pins(py, &over)?)
    }

    /// Base tangent length of a circular gear: number of teeth measured over, and the length, mm.
    ///
    /// Raises `MechanismError` with the reason if this length cannot be measured.
    ///
    /// >>> import centrode as ct
    /// >>> pair = ct.GearPair(ct.pitch.circle(module=3, tooth_count=24), driver_shift=0.4)
    /// >>> teeth, length = pair.driver.base_tangent()
    /// >>> print(teeth, f"{length:.4f}")
    /// 4 32.8266
    fn base_tangent(&self) -> Answer<(u32, f64)> {
        let found = self.pair.base_tangent(self.member)?;
        Ok((found.teeth, found.length))
    }

    /// Pin measurements for the maximum and the minimum allowed tooth thickness. The limits are `thickness_deviations` of
    /// the pair or, by default, those of DIN 3967 for the accuracy class. None if neither gives limits.
    ///
    /// >>> import centrode as ct
    /// >>> pitch = ct.pitch.circle(module=2, tooth_count=24)
    /// >>> pair = ct.GearPair(pitch, thickness_deviations=(-0.03, -0.06))
    /// >>> high, low = pair.driver.pin_limits()
    /// >>> print(f"{high.across[0]:.4f} {low.across[0]:.4f}")
    /// 51.9968 51.9222
    fn pin_limits<'py>(&self, py: Python<'py>) -> Answer<Option<Vec<Bound<'py, PyAny>>>> {
        let (pair, member) = (self.pair.clone(), self.member);
        let limits = wait(py, move || pair.pin_limits(member))?;
        let Some(limits) = limits else {
            return Ok(None);
        };
        let records = limits.iter().map(|over| record::over_pins(py, over));
        Ok(Some(records.collect::<PyResult<_>>()?))
    }

    /// The toothed contour, (N, 2), mm: corners of a closed polygon, counter-clockwise.
    ///
    /// The first point is not repeated at the end. The distance from the exact contour is at most `tolerance` (mm).
    ///
    /// >>> import centrode as ct
    /// >>> pair = ct.GearPair(ct.pitch.circle(module=2, tooth_count=20))
    /// >>> pair.driver.outline(tolerance=0.01).shape[1]
    /// 2
    #[pyo3(signature = (tolerance=1e-3))]
    fn outline(&self, py: Python<'_>, tolerance: f64) -> Answer<Rows<2>> {
        let tolerance = self.within(tolerance)?;
        let along = self.ask(py, move |gear| gear.outline().flatten(tolerance))?;
        Ok(Rows::new(&along))
    }

    /// The pitch curve, (N, 2), mm: closed and counter-clockwise as `outline`.
    #[pyo3(signature = (tolerance=1e-3))]
    fn pitch_curve(&self, py: Python<'_>, tolerance: f64) -> Answer<Rows<2>> {
        let tolerance = self.within(tolerance)?;
        let along = self.ask(py, move |gear| gear.pitch_curve().flatten(tolerance))?;
        Ok(Rows::new(&along))
    }

    /// The bore with its keyway, (N, 2), mm, counter-clockwise; None for a gear without one.
    #[pyo3(signature = (tolerance=1e-3))]
    fn bore(&self, tolerance: f64) -> Answer<Option<Rows<2>>> {
        let tolerance = self.within(tolerance)?;
        let bore = self.inner().bore();
        Ok(bore.map(|bore| Rows::new(&bore.flatten(tolerance))))
    }

    /// The points of `outline` with their properties, as a dictionary of arrays.
    ///
    /// "points" and outward unit "normals" (N, 2); "curvature" (N,), 1/mm, positive where the gear is convex; "role"
    /// (N,): "tip", "flank", "fillet" or "root"; "tooth" (N,): the tooth to which the point belongs; a space belongs to
    /// the tooth before it. At a corner, the values are those of the part that begins there.
    ///
    /// >>> import centrode as ct
    /// >>> gear = ct.GearPair(ct.pitch.circle(module=2, tooth_count=20)).driver
    /// >>> samples = gear.samples()
    /// >>> tips = samples["points"][samples["role"] == "tip"]
    /// >>> round(float((tips ** 2).sum(axis=1).max() ** 0.5), 9)  # half of m (z + 2)
    /// 22.0
    #[pyo3(signature = (tolerance=1e-3))]
    fn samples<'py>(&self, py: Python<'py>, tolerance: f64) -> Answer<Bound<'py, PyDict>> {
        let tolerance = self.within(tolerance)?;
        let samples = self.ask(py, move |gear| gear.outline().samples(tolerance))?;
        let gear = self.inner();
        let owned = samples.iter().map(|s| gear.owners()[s.segment]);
        let roles = samples
            .iter()
            .map(|s| fixed(gear.roles()[s.segment].name()));
        let dictionary = PyDict::new(py);
        let along = samples.iter().map(|s| [s.point.x, s.point.y]);
        dictionary.set_item("points", Rows(along.collect()))?;
        let along = samples.iter().map(|s| [s.normal.x, s.normal.y]);
        dictionary.set_item("normals", Rows(along.collect()))?;
        let along: Vec<f64> = samples.iter().map(|s| s.curvature).collect();
        dictionary.set_item("curvature", along.into_pyarray(py))?;
        let roles: Bound<'py, PyArray1<_>> = roles.collect::<Vec<_>>().into_pyarray(py);
        dictionary.set_item("role", roles)?;
        let owned = owned.collect::<Vec<u32>>();
        dictionary.set_item("tooth", owned.into_pyarray(py))?;
        Ok(dictionary)
    }

    /// The gear as a closed triangle mesh, from z = 0 to its width: vertices (V, 3), mm, and faces (F, 3).
    ///
    /// Faces list their vertices counter-clockwise seen from outside. `width` (mm) replaces the width of the body.
    ///
    /// >>> import centrode as ct
    /// >>> gear = ct.GearPair(ct.pitch.circle(module=2, tooth_count=20)).driver
    /// >>> vertices, faces = gear.mesh(tolerance=0.01, width=5)
    /// >>> float(vertices[:, 2].max())
    /// 5.0
    #[pyo3(signature = (tolerance=1e-3, width=None))]
    fn mesh(&self, py: Python<'_>, tolerance: f64, width: Option<f64>) -> Answer<MeshRows> {
        let tolerance = self.within(tolerance)?;
        let gear = self.inner();
        let holes = gear.bore().into_iter().collect();
        let width = width.unwrap_or(gear.body().width);
        let solid = Solid::new(gear.outline().clone(), holes, 0.0, width)?;
        Ok(mesh(wait(py, move || solid.mesh(tolerance))??))
    }

    /// Solid of the gear with its bore, from z = 0 to its width, with exact edges, for CAD kernels.
    ///
    /// Sides shorter than `tolerance` (mm) are removed, because a kernel treats them as points.
    ///
    /// >>> import centrode as ct
    /// >>> gear = ct.GearPair(ct.pitch.circle(module=2, tooth_count=20)).driver
    /// >>> solid = gear.solid()
    /// >>> abs(solid.volume - gear.area * gear.body.width) < 1e-9
    /// True
    #[pyo3(signature = (tolerance=1e-6))]
    fn solid<'py>(&self, py: Python<'py>, tolerance: f64) -> Answer<Bound<'py, PyAny>> {
        let shortest = self.within(tolerance)?;
        let solid = gear_pair::solid(&self.pair, self.member)?;
        Ok(Sides::new(self.member.name(), solid, shortest)?.record(py)?)
    }

    /// Writes the gear as an exact STEP solid (AP214, mm) with its name; returns the path.
    ///
    /// The file is written completely or not at all, as by `GearPair.export`. `GearPair.files` returns the bytes instead.
    ///
    /// >>> import centrode as ct, pathlib, tempfile
    /// >>> gear = ct.GearPair(ct.pitch.circle(module=2, tooth_count=20)).driver
    /// >>> with tempfile.TemporaryDirectory() as directory:
    /// ...     gear.step(pathlib.Path(directory, "pinion.step")).read_text()[:13]
    /// 'ISO-10303-21;'
    fn step(&self, py: Python<'_>, path: PathBuf) -> Answer<PathBuf> {
        // An exact solid is the same at every tolerance.
        self.write(py, path, Format::Step, self.pair.accuracy())
    }

    /// Writes the gear as a binary STL mesh, mm; returns the path.
    ///
    /// The file is written completely or not at all. The distance of the mesh from the exact solid is at most `tolerance`
    /// (mm).
    #[pyo3(signature = (path, tolerance=1e-3))]
    fn stl(&self, py: Python<'_>, path: PathBuf, tolerance: f64) -> Answer<PathBuf> {
        self.write(py, path, Format::Stl, tolerance)
    }

    /// Writes the gear as a 3MF package: the mesh of `stl` with its unit and name; returns the path.
    #[pyo3(signature = (path, tolerance=1e-3))]
    fn threemf(&self, py: Python<'_>, path: PathBuf, tolerance: f64) -> Answer<PathBuf> {
        self.write(py, path, Format::ThreeMf, tolerance)
    }

    /// The cutting drawing of the gear, in its own frame.
    #[pyo3(signature = (tolerance=1e-3))]
    fn drawing<'py>(&self, py: Python<'py>, tolerance: f64) -> Answer<Bound<'py, PyAny>> {
        drawing(py, &self.pair, self.member, tolerance)
    }

    /// The drawing sheets of the gear: views, dimensions, gear data, measures over pins, profile.
    ///
    /// Args:
    ///     size: "A4" to "A0"; default: the design's, or the smallest on which the gear fits.
    ///     projection: "first-angle" or "third-angle"; default: the design's.
    ///     tolerance: Maximum distance of a drawn line from the exact one on the part, mm.
    ///
    /// Raises:
    ///     ExportError: The gear does not fit on that size.
    ///
    /// >>> import centrode as ct
    /// >>> ct.GearPair(ct.pitch.circle(module=2, tooth_count=20)).driver.sheet()
    /// Sheets(2 of A3)
    #[pyo3(signature = (size=None, *, projection=None, tolerance=1e-3))]
    fn sheet<'py>(
        &self,
        py: Python<'py>,
        size: Option<&str>,
        projection: Option<&str>,
        tolerance: f64,
    ) -> Answer<Bound<'py, PyAny>> {
        let layout = [size, projection];
        sheet(py, &self.pair, self.member.into(), layout, tolerance)
    }

    fn __repr__(&self) -> String {
        let gear = self.inner();
        format!(
            "Gear({}, {} teeth, pitch_length={:?})",
            self.member.name(),
            gear.tooth_count(),
            gear.pitch_length()
        )
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> Reduced<'py> {
        self.made.reduced(py)
    }
}
