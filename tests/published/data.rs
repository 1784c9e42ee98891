use std::path::Path;

use serde::{Deserialize, de::DeserializeOwned};

#[derive(Deserialize)]
struct Cases<T> {
    case: Vec<T>,
}

/// The cases of `data/<name>.toml`.
pub(crate) fn cases<T: DeserializeOwned>(name: &str) -> Vec<T> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("published/data/{name}.toml"));
    let text = std::fs::read_to_string(path).expect("the figures are checked in");
    let cases: Cases<T> = toml::from_str(&text).expect("the oracle writes what this reads");
    assert!(!cases.case.is_empty(), "{name} has no case");
    cases.case
}

/// The 2018 elliptic pair.
#[derive(Deserialize)]
pub(crate) struct EllipticPair {
    pub(crate) eccentricity: f64,
    pub(crate) module: f64,
    pub(crate) tooth_count: u32,
    pub(crate) perimeter: f64,
    pub(crate) center_distance: f64,
    pub(crate) minimum_radius: f64,
    pub(crate) maximum_radius: f64,
    pub(crate) minimum_curvature_radius: f64,
    /// Driver angle, driven angle.
    pub(crate) driven_angle: Vec<[f64; 2]>,
    /// Tooth, side, height, driver angle, driven angle, x and y on the driver, x and y on the driven gear.
    pub(crate) flank: Vec<[f64; 9]>,
    /// Tooth, side, angle of the normal, x and y on the driver.
    pub(crate) fillet: Vec<[f64; 5]>,
}

/// The 2021 transplanter pair in one reading of its control points.
#[derive(Deserialize)]
pub(crate) struct TransplanterPair {
    pub(crate) plane: String,
    pub(crate) degree: u32,
    pub(crate) radius: Vec<f64>,
    pub(crate) angle_deg: Vec<f64>,
    pub(crate) center_distance: f64,
    pub(crate) perimeter: f64,
    /// Driver angle, driver radius, driven angle.
    pub(crate) driven_angle: Vec<[f64; 3]>,
}

/// A pair with a given mean ratio.
#[derive(Deserialize)]
pub(crate) struct LobedPair {
    pub(crate) kind: String,
    pub(crate) eccentricity: f64,
    pub(crate) lobes: u32,
    pub(crate) mean_ratio: [u32; 2],
    pub(crate) module: f64,
    pub(crate) tooth_count: u32,
    pub(crate) parameter: f64,
    pub(crate) perimeter: f64,
    pub(crate) center_distance: f64,
    /// Driver angle, driven angle.
    pub(crate) driven_angle: Vec<[f64; 2]>,
}

/// A circular gear cut by the ISO 53 A rack.
#[derive(Deserialize)]
pub(crate) struct CircularGear {
    pub(crate) tooth_count: u32,
    pub(crate) module: f64,
    pub(crate) tip_radius: f64,
    pub(crate) root_radius: f64,
    pub(crate) undercut: bool,
    pub(crate) area: f64,
    /// Radius, angle from the tooth's center line.
    pub(crate) flank: Vec<[f64; 2]>,
    /// Radius, angle from the tooth's center line.
    pub(crate) fillet: Vec<[f64; 2]>,
}

/// Undercut flanks of the 2021 sun, as the cubic spline in x and y, with its teeth at a phase.
#[derive(Deserialize)]
pub(crate) struct UndercutAtPhase {
    pub(crate) phase: f64,
    pub(crate) undercut: u32,
}

/// The three-arm mechanism of 2021 in one reading of its points.
#[derive(Deserialize)]
pub(crate) struct ThreeArmReading {
    pub(crate) plane: String,
    pub(crate) degree: u32,
    pub(crate) interpolate: bool,
    pub(crate) center_distance: f64,
    pub(crate) perimeter: f64,
    pub(crate) planet_reference_deg: f64,
    pub(crate) pick_angle_deg: f64,
    pub(crate) push_angle_deg: f64,
    pub(crate) picking_tip: [f64; 2],
    pub(crate) planting_tip: [f64; 2],
    pub(crate) height: f64,
}

/// A file by its place from the folder of the tests.
pub(crate) fn file(name: &str) -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

/// Holds the table of a document, between comments of its name, against the computed one; `UPDATE_GOLDEN` writes it.
pub(crate) fn documented(document: &str, name: &str, computed: &str) {
    let path = file(document);
    let (begin, end) = (
        format!("<!-- {name} -->\n"),
        format!("<!-- end of {name} -->\n"),
    );
    let document = std::fs::read_to_string(&path).expect("checked in");
    let (before, rest) = document.split_once(&begin).expect("the table begins");
    let (written, after) = rest.split_once(&end).expect("and ends");
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        let document = format!("{before}{begin}{computed}{end}{after}");
        std::fs::write(&path, document).expect("written");
        return;
    }
    assert_eq!(written, computed, "UPDATE_GOLDEN=1 writes it anew");
}
