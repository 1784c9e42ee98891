use std::ops::ControlFlow;

use serde::Deserialize;

use super::wish::{Choices, points};
use crate::analysis::Unit;
use crate::analysis::optimise::{EasedPath, Easing, EasingError, EasingSpec};
use crate::cli::reverse::words;
use crate::geometry::Point;
use crate::mechanism::reverse::{KeyPose, KeyPoses, TwoBar};

/// Wish whose machine is sought, with choices of the page.
#[derive(Debug, Deserialize)]
#[serde(untagged)]
pub(super) enum Sought {
    /// Key poses.
    Poses {
        /// Places of the tip, mm, and directions of the clamp, degrees.
        poses: Vec<[f64; 3]>,
        #[serde(flatten)]
        choices: Choices,
    },
    /// Working part of a path, with the return free.
    Stroke {
        /// Points of the working part, mm.
        stroke: Vec<[f64; 2]>,
        /// Distance within which the path may pass them, mm.
        band: f64,
        #[serde(flatten)]
        choices: Choices,
    },
}

/// Chain that was found, with names and words of what there is to tell of it.
pub(super) struct Found {
    pub(super) chain: TwoBar,
    pub(super) told: Vec<(String, String)>,
}

impl Sought {
    pub(super) fn choices(&self) -> &Choices {
        match self {
            Self::Poses { choices, .. } | Self::Stroke { choices, .. } => choices,
        }
    }

    /// Seeks the mildest chain that takes the poses in order, or the return with the bluntest gears.
    pub(super) fn found(&self) -> Result<Found, String> {
        match self {
            Self::Poses { poses, .. } => by_poses(poses),
            Self::Stroke {
                stroke,
                band,
                choices,
            } => {
                let points = points(stroke);
                let spec = EasingSpec::new(&[*band], choices.bend());
                let easing = Easing::with_free_return(&points, &spec);
                let eased = searched(easing)?;
                let free = eased.points.len() - points.len();
                let words = format!(
                    "through {free} points, in {} evaluations",
                    eased.evaluations
                );
                let mut told = vec![("free return".to_owned(), words)];
                if *band > 0.0 {
                    told.push(moved(&eased));
                }
                let chain = eased.chain;
                Ok(Found { chain, told })
            }
        }
    }
}

fn by_poses(poses: &[[f64; 3]]) -> Result<Found, String> {
    let pose = |[x, y, direction]: &[f64; 3]| KeyPose {
        point: Point::new(*x, *y),
        direction: direction.to_radians(),
    };
    let poses: Vec<KeyPose> = poses.iter().map(pose).collect();
    let found = KeyPoses::new(&poses).map_err(|error| error.to_string())?;
    let told = words::poses(found.clamp, &found.misses);
    let chain = found.chain;
    Ok(Found { chain, told })
}

/// Searches for the bluntest gears, and checks that the path found does not cross itself.
pub(super) fn searched(easing: Result<Easing, EasingError>) -> Result<EasedPath, String> {
    let eased = easing
        .and_then(|easing| easing.search(None, &mut |_| ControlFlow::Continue(())))
        .map_err(|error| error.to_string())?;
    let simple = eased.chain.path().check_simple();
    simple.map_err(|error| error.to_string())?;
    Ok(eased)
}

/// How far the points were moved, in words.
pub(super) fn moved(eased: &EasedPath) -> (String, String) {
    let most = eased.moved.iter().copied().fold(0.0, f64::max);
    let words = format!("by {} at most", Unit::Millimetre.tell(most));
    ("path eased".to_owned(), words)
}
