//! A path and what is required of its machine, as a design file.

use centrode_geometry::{Bounds, Point};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::path::{FARTHEST, FARTHEST_AXIS};
use super::{AxisRange, RequiredPath, SplitKind, Wishes};
use centrode_spec::rule::{
    Rule, broken, count_in_range, design_name, finite, in_range, not_negative, positive,
    single_line,
};
use centrode_spec::{DesignSpec, SpecError, degrees};

/// A path required of a tip, and other requirements for the machine.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct PathDesign {
    /// Short name of the machine, used for file names: letters, digits, `-` and `_`.
    #[serde(default = "default_name")]
    pub name: String,
    /// One line for drawings and reports.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub title: String,
    /// Axis of the carrier, mm; default: searched.
    pub axis: Option<[f64; 2]>,
    /// Two opposite corners of the box in which the axis is searched, mm; default: a box around the path with a margin of a
    /// quarter of its size.
    pub axis_box: Option<[[f64; 2]; 2]>,
    /// Angle from the carrier's first leg, to the intermediate gear, to its second, rad (degrees in the file).
    #[serde(default = "default_bend", rename = "bend_deg", with = "degrees")]
    #[schemars(with = "f64")]
    pub bend: f64,
    /// How the two gear stages share the motion.
    #[serde(default)]
    pub split: SplitKind,
    /// Number of arms.
    #[serde(default = "one")]
    pub arms: u32,
    /// Number of steps of the tables for the laws; default: the minimum for the required accuracy of the tip.
    pub steps: Option<u32>,
    /// Objective of the search for what is free; default: the largest teeth if the path is eased or there are wishes, otherwise
    /// the ratio nearest to 1.
    pub aim: Option<Aim>,
    /// The path.
    pub path: PathSpec,
    /// Other requirements.
    #[serde(default, skip_serializing_if = "Wishes::is_free")]
    pub wishes: Wishes,
}

/// Path required of a tip.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct PathSpec {
    /// Points in the order in which the tip passes them, mm.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub points: Vec<[f64; 2]>,
    /// CSV or SVG file that contains the points instead; it must be next to the design file.
    pub file: Option<String>,
    /// Whether the points are the control points of a closed cubic B-spline; the path need not pass through them.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub control: bool,
    /// Maximum distance of the path from each point, mm: the path is eased within it, so that its gears become less curved.
    pub band: Option<f64>,
    /// Maximum distance of the path from each point, mm, one value per point.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub tolerance: Vec<f64>,
    /// Whether the points are only the working part of the path, and the return is searched.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub open: bool,
    /// Whether the path may cross itself.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub crossing: bool,
    /// Module of full teeth at which easing stops, mm.
    pub module: Option<f64>,
}

/// Objective of a search for a machine.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, Hash, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Aim {
    /// The largest module with which full teeth are guaranteed to be sound.
    #[default]
    Module,
    /// The ratio nearest to 1.
    Mild,
    /// The minimum reach of the tip from the carrier's axis.
    Small,
}

centrode_spec::words!(Aim {
    Module = "module",
    Mild = "mild",
    Small = "small",
});

fn default_name() -> String {
    "reversed".into()
}

fn default_bend() -> f64 {
    60.0_f64.to_radians()
}

fn one() -> u32 {
    1
}

impl DesignSpec for PathDesign {
    const FAMILY: &'static str = "path";
    const ABOUT: &'static str = "The path of a tip, and the requirements for the machine that centrode reverse designs for it.";
    const TEMPLATE: &'static str = include_str!("../../design/path.toml");
    const TABLES: &'static [&'static str] = &["path", "wishes"];

    fn words(&self) -> [&str; 2] {
        [&self.name, &self.title]
    }

    fn rules(&self) -> Result<(), SpecError> {
        design_name(&self.name)?;
        single_line("title", &self.title)?;
        let points: Vec<Point> = self.path.points.iter().map(|&p| p.into()).collect();
        self.check_axes(&points)?;
        finite("bend_deg", self.bend)?;
        count_in_range("arms", self.arms, 1, 12)?;
        let count = self.path.validate().map_err(|e| e.inside("path"))?;
        let wishes = self.wishes.validate(count);
        wishes.map_err(|e| e.inside("wishes"))
    }
}

impl Default for PathDesign {
    fn default() -> Self {
        Self {
            name: default_name(),
            title: String::new(),
            axis: None,
            axis_box: None,
            bend: default_bend(),
            split: SplitKind::default(),
            arms: one(),
            steps: None,
            aim: None,
            path: PathSpec::default(),
            wishes: Wishes::default(),
        }
    }
}

impl PathDesign {
    /// Checks axis and box; if the points are in a file, `points` may be empty until the file is read.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault: both are given, a number is not finite, the box is empty, or it reaches beyond the
    /// path by more than 1000 times the path's size.
    pub fn check_axes(&self, points: &[Point]) -> Result<(), SpecError> {
        for x in self.axis.iter().flatten() {
            finite("axis", *x)?;
        }
        if let Some(corners) = self.axis_box {
            if self.axis.is_some() {
                return broken("axis_box", Rule::Excludes("axis"));
            }
            let bounds: Bounds = points.iter().copied().collect();
            let room = FARTHEST_AXIS * bounds.diagonal();
            for (k, x) in corners.iter().flat_map(|corner| corner.iter().enumerate()) {
                in_range("axis_box", *x, [-FARTHEST, FARTHEST], " mm")?;
                if room.is_finite() && room > 0.0 {
                    let limits = [bounds.min[k] - room, bounds.max[k] + room];
                    in_range("axis_box", *x, limits.map(f64::round), " mm")?;
                }
            }
            let [[x, y], [u, v]] = corners;
            if x == u || y == v {
                let words = "as two corners that differ in x and in y";
                return broken("axis_box", Rule::Needed(words));
            }
        }
        Ok(())
    }

    /// Axes among which one is searched for a path: within the given box, or around the path.
    #[must_use]
    pub fn axes(&self, path: &RequiredPath) -> AxisRange {
        let about = AxisRange::about(path);
        match self.axis_box {
            Some(corners) => AxisRange {
                count: about.count,
                ..AxisRange::between(corners)
            },
            None => about,
        }
    }

    /// Distances within which the path may pass its points, mm, one for all or one for each; `None` if the path must be followed
    /// exactly and nothing else is required.
    #[must_use]
    pub fn bands(&self) -> Option<Vec<f64>> {
        let path = &self.path;
        let is_wished = !self.wishes.is_free() || self.aim.is_some();
        match path.band {
            Some(band) => Some(vec![band]),
            None if !path.tolerance.is_empty() => Some(path.tolerance.clone()),
            None => (path.open || is_wished).then(|| vec![0.0]),
        }
    }
}

impl PathSpec {
    /// Checks the rules; returns the maximum number of points.
    fn validate(&self) -> Result<usize, SpecError> {
        match (&self.file, self.points.is_empty()) {
            (Some(_), false) => return broken("file", Rule::Excludes("points")),
            (None, true) => return broken("points", Rule::NeedsOneOf("points and file")),
            _ => {}
        }
        for x in self.points.iter().flatten() {
            finite("points", *x)?;
        }
        if self.control && self.open {
            return broken("control", Rule::Excludes("open"));
        }
        if self.band.is_some() && !self.tolerance.is_empty() {
            return broken("band", Rule::Excludes("tolerance"));
        }
        not_negative("band", self.band.unwrap_or(0.0))?;
        for band in &self.tolerance {
            not_negative("tolerance", *band)?;
        }
        if let Some(module) = self.module {
            positive("module", module)?;
            if self.band.is_none() && self.tolerance.is_empty() && !self.open && self.file.is_none()
            {
                return broken("band", Rule::Needed("with module, which eases the path"));
            }
        }
        // The number of points in a file is not known before it is read.
        Ok(match self.file {
            Some(_) => usize::MAX,
            None => self.points.len(),
        })
    }
}
