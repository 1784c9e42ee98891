use serde::Deserialize;

use crate::geometry::Point;
use crate::mechanism::reverse::{MachineError, PathError, SplitKind, WantedPath};

/// Most arms of a machine.
const MOST_ARMS: u32 = 12;

/// Path, axis and choices of the page.
#[derive(Clone, Debug, Deserialize)]
pub(super) struct Wish {
    /// Points of the path, mm.
    pub(super) points: Vec<[f64; 2]>,
    /// Axis of the carrier, mm.
    pub(super) axis: [f64; 2],
    #[serde(flatten)]
    pub(super) choices: Choices,
    /// Whether the hand rests: what takes longer is told, too.
    #[serde(default)]
    pub(super) rest: bool,
    /// Whether the other splits are told, too.
    #[serde(default)]
    pub(super) others: bool,
}

/// Choices of the gears.
#[derive(Clone, Debug, Deserialize)]
pub(super) struct Choices {
    bend_deg: f64,
    pub(super) arms: u32,
    /// Word of the split.
    split: String,
}

impl Wish {
    pub(super) fn path(&self) -> Result<WantedPath, PathError> {
        path(&self.points)
    }

    pub(super) fn axis(&self) -> Point {
        self.axis.into()
    }
}

impl Choices {
    /// Angle from the carrier's first leg to its second, rad.
    pub(super) fn bend(&self) -> f64 {
        self.bend_deg.to_radians()
    }

    /// Checks the number of arms before as many are drawn.
    pub(super) fn check_arms(&self) -> Result<(), String> {
        let (arms, greatest) = (self.arms, MOST_ARMS);
        let error = MachineError::Arms { arms, greatest };
        let is_number = (1..=greatest).contains(&arms);
        is_number.then_some(()).ok_or_else(|| error.to_string())
    }

    pub(super) fn kind(&self) -> Result<SplitKind, String> {
        let mut kinds = SplitKind::NAMES.iter();
        let kind = kinds.find(|(name, _)| *name == self.split);
        let kind = kind.map(|(_, kind)| *kind);
        kind.ok_or_else(|| format!("there is no split {:?}", self.split))
    }
}

pub(super) fn points(rows: &[[f64; 2]]) -> Vec<Point> {
    rows.iter().copied().map(Point::from).collect()
}

/// Path through the points of the page.
pub(super) fn path(rows: &[[f64; 2]]) -> Result<WantedPath, PathError> {
    WantedPath::through(&points(rows))
}
