//! One function a kind of pitch curve: keywords as in the design file, angles in radians.

use centrode_gear::pitch as spec;
use centrode_spec::Column;
use pyo3::prelude::{Borrowed, Bound, FromPyObject, PyAny, PyErr, PyRef, PyResult, pyfunction};
use pyo3::types::PyDict;

use super::Pitch;
use crate::array::Numbers;
use crate::count::Count;
use crate::error::Answer;
use crate::keywords::{Call, build, fill};

/// A function of one angle: a formula in `phi`, or values at equal steps of it.
#[derive(Debug)]
pub(crate) enum Law {
    /// A formula.
    Formula(String),
    /// Sampled values.
    Samples(Numbers),
}

impl<'a, 'py> FromPyObject<'a, 'py> for Law {
    type Error = PyErr;

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        match object.extract() {
            Ok(text) => Ok(Self::Formula(text)),
            Err(_) => Ok(Self::Samples(object.extract()?)),
        }
    }
}

impl Law {
    /// Formula and samples: one of them empty.
    fn parts(law: Option<Self>) -> (Option<String>, Vec<f64>) {
        match law {
            None => (None, Vec::new()),
            Some(Self::Formula(text)) => (Some(text), Vec::new()),
            Some(Self::Samples(values)) => (None, values.into_vec()),
        }
    }
}

/// File and column of samples that are arrays.
const NO_FILE: (Option<String>, Option<Column>) = (None, None);

/// Resolves the curve of a kind from keys that are known and those from keywords; without the former all may be absent.
macro_rules! curve {
    ($of:literal, $keywords:expr, $kind:ident { $($known:ident),* }: $($field:ident),*) => {{
        let curve = build!($of, $keywords, spec::$kind { $($known),* }, "pitch.": $($field),*);
        Pitch::resolve(spec::PitchSpec::$kind(curve))
    }};
    ($of:literal, $keywords:expr, $kind:ident: $($field:ident),*) => {{
        let (call, mut curve) = (Call::new($of, $keywords), spec::$kind::default());
        fill!(call, curve, "pitch.": $($field),*);
        call.end()?;
        Pitch::resolve(spec::PitchSpec::$kind(curve))
    }};
}

/// A circle around the shaft axis, for an ordinary gear. Give `radius`, or `module` and `tooth_count`.
///
/// >>> import centrode as ct
/// >>> round(ct.pitch.circle(radius=20, tooth_count=20).module, 12)
/// 2.0
#[pyfunction]
#[pyo3(signature = (**keywords), text_signature = "(*, radius=None, module=None, tooth_count=None, diametral_pitch=None)")]
pub(crate) fn circle(keywords: Option<Bound<'_, PyDict>>) -> Answer<Pitch> {
    curve!("circle", keywords, Circle: radius, module, tooth_count, diametral_pitch)
}

/// A circle with its shaft axis off centre; `eccentricity` is this distance divided by the radius.
///
/// >>> import centrode as ct
/// >>> ct.pitch.eccentric_circle(eccentricity=0.2, radius=20).points([0.0])
/// array([[24.,  0.]])
#[pyfunction]
#[pyo3(signature = (*, eccentricity, **keywords), text_signature = "(*, eccentricity, radius=None, module=None, tooth_count=None, diametral_pitch=None)")]
pub(crate) fn eccentric_circle(
    eccentricity: f64,
    keywords: Option<Bound<'_, PyDict>>,
) -> Answer<Pitch> {
    curve!("eccentric_circle", keywords, EccentricCircle { eccentricity }: radius, module, tooth_count, diametral_pitch)
}

/// An ellipse that turns about a focus; its farthest point is at the polar angle zero: r = A (1 - k^2) / (1 - k cos phi).
///
/// Give `semi_major_axis` A, or `module` and `tooth_count`; k is `eccentricity`.
///
/// >>> import centrode as ct
/// >>> ct.pitch.ellipse(eccentricity=0.25, semi_major_axis=20).points([0.0])
/// array([[25.,  0.]])
#[pyfunction]
#[pyo3(signature = (*, eccentricity, **keywords), text_signature = "(*, eccentricity, semi_major_axis=None, module=None, tooth_count=None, diametral_pitch=None)")]
pub(crate) fn ellipse(eccentricity: f64, keywords: Option<Bound<'_, PyDict>>) -> Answer<Pitch> {
    curve!("ellipse", keywords, Ellipse { eccentricity }: semi_major_axis, module, tooth_count, diametral_pitch)
}

/// A focal ellipse whose polar angle is compressed so that it repeats `lobes` times in one turn.
///
/// >>> import centrode as ct
/// >>> ct.pitch.lobed_ellipse(lobes=2, eccentricity=0.1, module=2, tooth_count=30).tooth_count
/// 30
#[pyfunction]
#[pyo3(signature = (*, lobes, eccentricity, **keywords), text_signature = "(*, lobes, eccentricity, semi_major_axis=None, module=None, tooth_count=None, diametral_pitch=None)")]
pub(crate) fn lobed_ellipse(
    lobes: Count,
    eccentricity: f64,
    keywords: Option<Bound<'_, PyDict>>,
) -> Answer<Pitch> {
    let lobes = lobes.of("pitch.lobes")?;
    curve!("lobed_ellipse", keywords, LobedEllipse { lobes, eccentricity }:
        semi_major_axis, module, tooth_count, diametral_pitch)
}

/// A closed uniform B-spline, from control points or (`interpolate=True`) through the points.
///
/// Points are `radius` (mm) and `angle` (rad) in the polar plane, `x` and `y` (mm) in the cartesian one. The points
/// determine the size of the curve. `module` with `tooth_count` scales it; with `tooth_count` alone, the module follows
/// from the size.
///
/// >>> import centrode as ct
/// >>> square = ct.pitch.bspline(x=[10, -10, -10, 10], y=[10, 10, -10, -10], plane="cartesian", degree=2)
/// >>> square.period
/// 4.0
#[pyfunction]
#[pyo3(signature = (**keywords), text_signature = "(*, radius=None, angle=None, x=None, y=None, degree=3, plane='polar', interpolate=False, module=None, tooth_count=None, diametral_pitch=None)")]
pub(crate) fn bspline(keywords: Option<Bound<'_, PyDict>>) -> Answer<Pitch> {
    curve!("bspline", keywords, Bspline:
        radius, angle, x, y, degree, plane, interpolate, module, tooth_count, diametral_pitch)
}

/// A closed chain of Bezier arcs. For each arc, give all control points except the last, which is the first of the next
/// arc.
///
/// >>> import centrode as ct
/// >>> x, y = [10, 0, -10, -10, -10, 0, 10, 10], [10, 10, 10, 0, -10, -10, -10, 0]
/// >>> ct.pitch.bezier(x=x, y=y, plane="cartesian", degree=2).points([0.0])
/// array([[10., 10.]])
#[pyfunction]
#[pyo3(signature = (**keywords), text_signature = "(*, radius=None, angle=None, x=None, y=None, degree=3, plane='polar', module=None, tooth_count=None, diametral_pitch=None)")]
pub(crate) fn bezier(keywords: Option<Bound<'_, PyDict>>) -> Answer<Pitch> {
    curve!("bezier", keywords, Bezier: radius, angle, x, y, degree, plane, module, tooth_count, diametral_pitch)
}

/// A limacon of Pascal: r = b + c cos(N phi), with `mean_radius` b, `amplitude` c and `lobes` N.
///
/// >>> import centrode as ct
/// >>> ct.pitch.limacon(mean_radius=20, amplitude=2).points([0.0])
/// array([[22.,  0.]])
#[pyfunction]
#[pyo3(signature = (*, mean_radius, amplitude, lobes=Count::Fits(1), **keywords), text_signature = "(*, mean_radius, amplitude, lobes=1, module=None, tooth_count=None, diametral_pitch=None)")]
pub(crate) fn limacon(
    mean_radius: f64,
    amplitude: f64,
    lobes: Count,
    keywords: Option<Bound<'_, PyDict>>,
) -> Answer<Pitch> {
    let lobes = lobes.of("pitch.lobes")?;
    curve!("limacon", keywords, Limacon { mean_radius, amplitude, lobes }: module, tooth_count, diametral_pitch)
}

/// Radius as a function of the polar angle: a formula in ``phi``, radii, or a Fourier series.
///
/// Args:
///     radius: A formula, or radii, mm, at equal steps from the angle zero, or at the angles `angle`.
///     angle: Polar angles of the radii, rad, increasing within one turn.
///     interpolation: Interpolation between the radii: "quintic" for equal steps, "cubic" for others, or "trigonometric".
///     smooth: Smoothing of the radii by a Fourier series: ``{"harmonics": 12}``, the highest one, or ``{"tolerance": 0.1}``,
///         the maximum distance from the radii, mm.
///     mean: Mean radius of a Fourier series, mm.
///     cos: Cosine coefficients from the first harmonic, mm.
///     sin: Sine coefficients from the first harmonic, mm.
///     module: Module, mm; with `tooth_count`, it scales the curve.
///     tooth_count: Number of teeth; if given alone, the module follows from the size of the curve.
///     diametral_pitch: Diametral pitch, 1/in, instead of the module.
///
/// >>> import centrode as ct
/// >>> ct.pitch.polar("20 + 2*cos(2*phi)").points([0.0])
/// array([[22.,  0.]])
/// >>> ct.pitch.polar(mean=20, cos=[0, 2]).points([0.0])
/// array([[22.,  0.]])
#[pyfunction]
#[pyo3(signature = (radius=None, **keywords), text_signature = "(radius=None, *, angle=None, interpolation=None, smooth=None, mean=None, cos=None, sin=None, module=None, tooth_count=None, diametral_pitch=None)")]
pub(crate) fn polar(radius: Option<Law>, keywords: Option<Bound<'_, PyDict>>) -> Answer<Pitch> {
    let (expression, radius) = Law::parts(radius);
    let (file, column) = NO_FILE;
    curve!("polar", keywords, Polar { expression, radius, file, column }:
        angle, interpolation, smooth, mean, cos, sin, module, tooth_count, diametral_pitch)
}

/// The curve that turns the driven gear by a given law, which is a formula in ``phi`` or samples over one driver turn.
///
/// Args:
///     driven_angle: Driven angle, rad, as a formula in the driver angle ``phi`` (rad), or as samples at equal steps of
///         one driver turn, with or without the end of the turn.
///     angle: Driver angles of the samples, rad, increasing within one turn.
///     interpolation: Interpolation between the samples; default: "quintic" for equal steps, "cubic" for others.
///     smooth: Smoothing of the samples by a Fourier series: ``{"harmonics": 12}``, the highest one, or
///         ``{"tolerance": 0.001}``, the maximum distance from the samples, rad.
///     center_distance: Centre distance, mm; or give `module` and `tooth_count`.
///     module: Module, mm.
///     tooth_count: Number of teeth.
///     diametral_pitch: Diametral pitch, 1/in, instead of the module.
///
/// >>> import centrode as ct
/// >>> pitch = ct.pitch.from_transmission("phi/2 - 0.05*sin(2*phi)", center_distance=60)
/// >>> pitch.implied_ratio
/// (2, 1)
#[pyfunction]
#[pyo3(signature = (driven_angle, **keywords), text_signature = "(driven_angle, *, angle=None, interpolation=None, smooth=None, center_distance=None, module=None, tooth_count=None, diametral_pitch=None)")]
pub(crate) fn from_transmission(
    driven_angle: Law,
    keywords: Option<Bound<'_, PyDict>>,
) -> Answer<Pitch> {
    let (expression, driven_angle) = Law::parts(Some(driven_angle));
    let (file, column) = NO_FILE;
    curve!("from_transmission", keywords, Transmission { expression, driven_angle, file, column }:
        angle, interpolation, smooth, center_distance, module, tooth_count, diametral_pitch)
}

/// The curve with a given ratio d driven / d driver, which is a formula in ``phi`` or samples over one driver turn.
///
/// Args:
///     ratio: A formula, or samples at equal steps of one driver turn, or at the angles `angle`. The last one may repeat the
///         first, a turn later. A mean near the mean ratio is scaled to it.
///     angle: Driver angles of the samples, rad, increasing within one turn.
///     interpolation: Interpolation between the samples; default: "quintic" for equal steps, "cubic" for others.
///     smooth: Smoothing of the samples by a Fourier series: ``{"harmonics": 12}``, the highest one, or
///         ``{"tolerance": 0.01}``, the maximum distance from the samples.
///     center_distance: Centre distance, mm; or give `module` and `tooth_count`.
///     module: Module, mm.
///     tooth_count: Number of teeth.
///     diametral_pitch: Diametral pitch, 1/in, instead of the module.
///
/// >>> import centrode as ct
/// >>> pitch = ct.pitch.from_ratio("1 - 0.16*cos(2*phi)", center_distance=60)
/// >>> pitch.implied_ratio
/// (1, 1)
#[pyfunction]
#[pyo3(signature = (ratio, **keywords), text_signature = "(ratio, *, angle=None, interpolation=None, smooth=None, center_distance=None, module=None, tooth_count=None, diametral_pitch=None)")]
pub(crate) fn from_ratio(ratio: Law, keywords: Option<Bound<'_, PyDict>>) -> Answer<Pitch> {
    let (expression, ratio) = Law::parts(Some(ratio));
    let (file, column) = NO_FILE;
    curve!("from_ratio", keywords, Ratio { expression, ratio, file, column }:
        angle, interpolation, smooth, center_distance, module, tooth_count, diametral_pitch)
}

/// The curve that rolls on another curve: the driven curve of one pair, to be the driver of the next pair.
///
/// The conjugate of the conjugate, with the inverse mean ratio, is the original curve.
///
/// Args:
///     of: The curve on which it rolls.
///     mean_ratio: Turns of `of` : turns of this curve.
///     module: Module, mm; with `tooth_count`, it scales the curve.
///     tooth_count: Number of teeth; if given alone, the module follows from the size of the curve.
///     diametral_pitch: Diametral pitch, 1/in, instead of the module.
///
/// >>> import centrode as ct
/// >>> wheel = ct.pitch.conjugate(ct.pitch.circle(radius=10), mean_ratio=(2, 1))
/// >>> wheel.points([0.0]).round(12)
/// array([[20.,  0.]])
#[pyfunction]
#[pyo3(signature = (of, *, mean_ratio=[Count::Fits(1), Count::Fits(1)], **keywords), text_signature = "(of, *, mean_ratio=(1, 1), module=None, tooth_count=None, diametral_pitch=None)")]
pub(crate) fn conjugate(
    of: PyRef<'_, Pitch>,
    mean_ratio: [Count; 2],
    keywords: Option<Bound<'_, PyDict>>,
) -> Answer<Pitch> {
    let [driver, driven] = mean_ratio;
    let mean_ratio = [
        driver.of("pitch.mean_ratio")?,
        driven.of("pitch.mean_ratio")?,
    ];
    let of = Box::new(of.spec.clone());
    curve!("conjugate", keywords, Conjugate { mean_ratio, of }: module, tooth_count, diametral_pitch)
}
