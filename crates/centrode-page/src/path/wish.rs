use centrode_geometry::Point;
use centrode_spec::{Design as _, DesignSpec as _};
use centrode_synthesis::reverse::{KeyPose, PathDesign, PathError, RequiredPath};
use serde::Deserialize;

/// Wish of the page: the design that `centrode reverse` reads, or key poses with its choices.
#[derive(Clone, Debug, Deserialize)]
pub struct Wish {
    /// The design; with key poses only its bend, split and arms are used.
    design: PathDesign,
    /// Key poses instead of a path: points of the tip, mm, and directions of the clamp, degrees.
    #[serde(default)]
    poses: Vec<[f64; 3]>,
    /// Whether the user pauses while dragging: slower figures are then reported, too.
    #[serde(default)]
    pub(super) rest: bool,
    /// Whether the other splits are reported, too.
    #[serde(default)]
    pub(super) others: bool,
}

impl Wish {
    /// The design as the command reads it from its file, or the key and the rule that it breaks.
    ///
    /// # Errors
    /// The key and the rule that it breaks.
    pub fn design(&self) -> Result<PathDesign, String> {
        let mut design = self.design.clone();
        if !self.poses.is_empty() {
            design.path.points = self.poses.iter().map(|[x, y, _]| [*x, *y]).collect();
        }
        if let Some(file) = &design.path.file {
            return Err(format!(
                "path.file: the points are in {file}, which the page cannot read: open that file"
            ));
        }
        // Points that do not make a path are reported later, by the error of the path.
        let text = design.to_toml().map_err(|error| error.message())?;
        PathDesign::from_toml(&text).map_err(|error| error.message())
    }

    /// Key poses; `None` if a path is given.
    pub(super) fn poses(&self) -> Option<Vec<KeyPose>> {
        let pose = |[x, y, direction]: &[f64; 3]| KeyPose {
            point: Point::new(*x, *y),
            direction: direction.to_radians(),
        };
        (!self.poses.is_empty()).then(|| self.poses.iter().map(pose).collect())
    }

    /// Text that distinguishes this wish from others.
    pub(super) fn key(&self) -> String {
        let poses = &self.poses;
        let text = self.design.to_toml();
        text.map_or_else(|_| String::new(), |text| format!("{text}{poses:?}"))
    }
}

/// Points that the path of a design passes.
pub(super) fn points(design: &PathDesign) -> Vec<Point> {
    let rows = self::rows(&design.path.points);
    match design.path.control {
        true => RequiredPath::knots(&rows),
        false => rows,
    }
}

pub(super) fn rows(rows: &[[f64; 2]]) -> Vec<Point> {
    rows.iter().copied().map(Point::from).collect()
}

/// Path through the points of the page.
pub(super) fn path(rows: &[[f64; 2]]) -> Result<RequiredPath, PathError> {
    RequiredPath::through(&self::rows(rows))
}
