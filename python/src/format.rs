use centrode_export::dxf::{Curves, Version};
use centrode_export::{Format, Options};
use centrode_geometry::Tolerance;
use centrode_mechanism::gear::GearPair;
use pyo3::prelude::PyResult;

use crate::error::{tolerance as exact, unknown_word};

/// Formats by their names, all if none are named, and how they are written.
pub(crate) fn options(
    pair: &GearPair,
    formats: Option<Vec<String>>,
    tolerance: f64,
    dxf_version: &str,
    dxf_curves: &str,
) -> PyResult<(Vec<Format>, Options)> {
    within(exact(tolerance, pair)?, formats, dxf_version, dxf_curves)
}

/// Options within a tolerance that has been checked.
pub(crate) fn within(
    tolerance: Tolerance,
    formats: Option<Vec<String>>,
    dxf_version: &str,
    dxf_curves: &str,
) -> PyResult<(Vec<Format>, Options)> {
    let formats = match formats {
        None => Format::ALL.to_vec(),
        Some(words) => words
            .iter()
            .map(|word| {
                word.parse()
                    .map_err(|_| unknown_word("formats", word, &Format::ALL.map(Format::name)))
            })
            .collect::<PyResult<_>>()?,
    };
    let mut options = Options::new(tolerance);
    options.dxf_version = match dxf_version {
        "R2010" => Version::R2010,
        "R12" => Version::R12,
        _ => {
            return Err(unknown_word("dxf_version", dxf_version, &["R2010", "R12"]));
        }
    };
    options.dxf_curves = match dxf_curves {
        "arcs" => Curves::Arcs,
        "splines" => Curves::Splines,
        _ => {
            return Err(unknown_word("dxf_curves", dxf_curves, &["arcs", "splines"]));
        }
    };
    Ok((formats, options))
}
