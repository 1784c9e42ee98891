use std::collections::BTreeMap;

use centrode_gear::cam::law as mechanism;
use pyo3::prelude::{PyResult, Python, pyclass, pyfunction, pymethods};
use pyo3::types::PyTuple;

use crate::array::{Numbers, Rows, list, row};
use crate::error::{Answer, Raised};
use crate::made::{Reduced, by, native};
use crate::record::Keywords;

/// A normalised motion law: it goes from 0 to 1 while its input goes from 0 to 1.
///
/// Made by ``centrode.cam.law`` and ``centrode.cam.polynomial``.
///
/// >>> import centrode as ct
/// >>> ct.cam.law("cycloidal")
/// Law('cycloidal')
#[pyclass(frozen, eq, module = "centrode.cam")]
#[derive(Debug)]
pub(crate) struct Law {
    pub(crate) spec: mechanism::LawSpec,
    law: mechanism::Law,
}

impl PartialEq for Law {
    fn eq(&self, other: &Self) -> bool {
        self.spec == other.spec
    }
}

impl Law {
    pub(super) fn resolve(spec: mechanism::LawSpec) -> Answer<Self> {
        let law = spec.resolve()?;
        Ok(Self { spec, law })
    }
}

/// The motion law with this name, as in VDI 2143: "constant-velocity", "parabolic", "harmonic", "cycloidal",
/// "modified-sine", "modified-trapezoid", "polynomial-345" or "polynomial-4567".
///
/// >>> import centrode as ct
/// >>> round(ct.cam.law("modified-sine").characteristic_values["acceleration"], 4)
/// 5.528
#[pyfunction]
#[pyo3(signature = (name, /))]
pub(crate) fn law(name: &str) -> Answer<Law> {
    let known = mechanism::LawSpec::NAMED.map(|(name, _)| name);
    let spec = mechanism::LawSpec::named(name);
    Law::resolve(spec.ok_or_else(|| Raised::word("law.kind", name, &known))?)
}

/// The polynomial of lowest degree from 0 to 1 with the given derivatives at both ends: velocity, acceleration and so on,
/// per unit of the law's normalised input and lift.
///
/// >>> import centrode as ct
/// >>> ct.cam.polynomial(start=[0, 0], end=[2, 0]).at([1])
/// array([[  1.,   2.,   0., -12.]])
#[pyfunction]
#[pyo3(name = "polynomial", signature = (*, start=None, end=None))]
pub(crate) fn law_of_polynomial(start: Option<Numbers>, end: Option<Numbers>) -> Answer<Law> {
    Law::resolve(mechanism::LawSpec::Polynomial(mechanism::Polynomial {
        start: list(start),
        end: list(end),
    }))
}

#[pymethods]
impl Law {
    /// Name of the kind, as in a design file.
    #[getter]
    fn name(&self) -> &'static str {
        self.law.name()
    }

    /// The law and its first three derivatives at inputs from 0 to 1, (N, 4).
    ///
    /// >>> import centrode as ct
    /// >>> ct.cam.law("parabolic").at([0.25])
    /// array([[0.125, 1.   , 4.   , 0.   ]])
    fn at(&self, x: Numbers) -> Rows<4> {
        let inputs = x.into_vec().into_iter();
        Rows(inputs.map(|x| row(&self.law.at(x))).collect())
    }

    /// Characteristic values between two dwells, as in VDI 2143: "velocity" Cv, "acceleration" Ca, "jerk" Cj, and
    /// "torque" CM, the peak of velocity times acceleration.
    ///
    /// If a derivative jumps, inside the law or at an end, the peak of the next derivative is infinite. "velocity_jump"
    /// and "acceleration_jump" are the maximum jumps, 0 if there are none; "acceleration_inside" and "jerk_inside" are
    /// the peaks between the jumps. The ends of a polynomial have the given derivatives instead of a dwell.
    ///
    /// >>> import centrode as ct
    /// >>> peaks = ct.cam.law("harmonic").characteristic_values
    /// >>> [round(peaks[key], 4) for key in ["jerk", "jerk_inside", "acceleration_jump"]]
    /// [inf, 15.5031, 4.9348]
    #[getter]
    fn characteristic_values(&self) -> BTreeMap<&'static str, f64> {
        let values = self.law.characteristic_values();
        BTreeMap::from([
            ("velocity", values.velocity),
            ("acceleration", values.acceleration),
            ("jerk", values.jerk),
            ("torque", values.torque),
            ("acceleration_inside", values.acceleration_inside),
            ("jerk_inside", values.jerk_inside),
            ("velocity_jump", values.velocity_jump),
            ("acceleration_jump", values.acceleration_jump),
        ])
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        match &self.spec {
            mechanism::LawSpec::Polynomial(p) => {
                let ends = Keywords::new(py).with("start", &p.start)?;
                by("polynomial", ends.with("end", &p.end)?)
            }
            _ => Ok((native(py, "law")?, PyTuple::new(py, [self.name()])?)),
        }
    }

    fn __repr__(&self) -> String {
        match &self.spec {
            mechanism::LawSpec::Polynomial(p) => {
                format!("Law('polynomial', start={:?}, end={:?})", p.start, p.end)
            }
            _ => format!("Law('{}')", self.law.name()),
        }
    }
}
