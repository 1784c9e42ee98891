//! The picking six-bar's dimensions: Ye et al. 2022, DOI 10.6041/j.issn.1000-1298.2022.05.010,
//! objective (14) and constraints (15) to (18).

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use centrode_geometry::Point;
use centrode_kinematics::linkage::{Branch, FourBar, SixBar};

use centrode_optimise::{Evaluation, Problem};

/// Bounds of crank, coupler, rocker and frame, mm.
pub type Lengths = [(f64, f64); 4];

/// The published bounds (18), mm.
pub const PUBLISHED_BOUNDS: Lengths =
    [(77.0, 81.0), (136.0, 147.0), (127.0, 138.0), (100.0, 106.0)];

fn four_bar(point: &[f64], branch: Branch) -> Option<FourBar> {
    let &[crank, coupler, rocker, frame, ..] = point else {
        return None;
    };
    FourBar::new(crank, coupler, rocker, frame, branch).ok()
}

/// Violation of the crank-rocker condition, as a share of the frame length; zero or less if the condition holds.
fn not_crank_rocker(point: &[f64]) -> f64 {
    let &[crank, coupler, rocker, frame, ..] = point else {
        return f64::INFINITY;
    };
    let longest = coupler.max(rocker).max(frame);
    let others = coupler + rocker + frame - longest;
    // A linkage at a change point is not a crank-rocker.
    (crank + longest - others) / frame + 1e-9
}

/// Problem of lengths that swing the effector by a required angle about a fixed pivot, with a required minimum
/// transmission angle: variables are crank, coupler, rocker and frame, mm.
#[derive(Clone, Debug)]
pub struct RequiredSwing {
    /// Bounds of the lengths, mm.
    pub bounds: Lengths,
    /// The effector's pivot, mm. It must not be a variable: with the pivot on the chord between the slider's dead centres any
    /// lengths swing the effector by half a turn, so that the objective has no meaning.
    pub pivot: Point,
    /// Assembly branch of the four-bar.
    pub branch: Branch,
    /// Required swing, rad.
    pub swing: f64,
    /// Required minimum transmission angle, rad; `None` omits constraint (16).
    pub minimum_transmission_angle: Option<f64>,
}

impl RequiredSwing {
    /// Evaluation of lengths about a pivot, and the six-bar, if there is one.
    pub fn evaluated(&self, lengths: &[f64], pivot: Point) -> (Evaluation, Option<SixBar>) {
        let mut constraints = vec![not_crank_rocker(lengths)];
        let six_bar = four_bar(lengths, self.branch).and_then(|f| SixBar::new(f, pivot, 1.0).ok());
        let Some(bar) = six_bar else {
            // Lengths that are a crank-rocker fail only with the pivot on the slider's path.
            constraints[0] = 1.0 + constraints[0].max(0.0);
            let nothing = Evaluation {
                // Greater than any deviation of a swing; a finite number, so that a search can be stored.
                objective: TAU,
                constraints,
            };
            return (nothing, None);
        };
        if let Some(required) = self.minimum_transmission_angle {
            constraints.push(required - bar.four_bar().minimum_transmission_angle());
        }
        let evaluation = Evaluation {
            objective: (bar.swing() - self.swing).abs(),
            constraints,
        };
        (evaluation, six_bar)
    }
}

impl Problem for RequiredSwing {
    fn bounds(&self) -> Vec<(f64, f64)> {
        self.bounds.to_vec()
    }

    /// Evaluates a point: the objective is the swing's distance from the required one, rad.
    fn evaluate(&self, point: &[f64]) -> Evaluation {
        self.evaluated(point, self.pivot).0
    }

    fn is_costly(&self) -> bool {
        false
    }
}

/// Problem of the crank-rocker with the largest minimum transmission angle: variables are crank, coupler,
/// rocker and frame, mm.
///
/// This angle is always below 90 degrees minus half the rocker's swing.
#[derive(Clone, Debug)]
pub struct BestTransmissionAngle {
    /// Bounds of the lengths, mm.
    pub bounds: Lengths,
}

impl Problem for BestTransmissionAngle {
    fn bounds(&self) -> Vec<(f64, f64)> {
        self.bounds.to_vec()
    }

    /// Evaluates a point: the objective is a right angle minus the minimum transmission angle, rad.
    fn evaluate(&self, point: &[f64]) -> Evaluation {
        let minimum =
            four_bar(point, Branch::Upper).map_or(0.0, |f| f.minimum_transmission_angle());
        Evaluation {
            objective: FRAC_PI_2 - minimum,
            constraints: vec![not_crank_rocker(point)],
        }
    }

    fn is_costly(&self) -> bool {
        false
    }
}

/// Problem of the smallest common widening of all bounds with which they contain a crank-rocker with a required minimum
/// transmission angle: variables are the widening and each length's position within its widened bounds, from 0 to 1.
#[derive(Clone, Debug)]
pub struct MinimumWidening {
    /// Bounds to be widened, mm.
    pub bounds: Lengths,
    /// Required minimum transmission angle, rad.
    pub minimum_transmission_angle: f64,
}

impl MinimumWidening {
    /// Bounds with every minimum reduced and every maximum increased by a share.
    #[must_use]
    pub fn widened(&self, share: f64) -> Lengths {
        self.bounds
            .map(|(low, high)| (low * (1.0 - share), high * (1.0 + share)))
    }

    /// The lengths of a point, mm.
    #[must_use]
    pub fn lengths(&self, point: &[f64]) -> Vec<f64> {
        let Some((&share, places)) = point.split_first() else {
            return Vec::new();
        };
        let bounds = self.widened(share).into_iter().zip(places);
        bounds
            .map(|((low, high), place)| low + (high - low) * place)
            .collect()
    }
}

impl Problem for MinimumWidening {
    fn bounds(&self) -> Vec<(f64, f64)> {
        let mut bounds = vec![(0.0, 0.9)];
        bounds.extend([(0.0, 1.0); 4]);
        bounds
    }

    /// Evaluates a point: the objective is the widening, a share.
    fn evaluate(&self, point: &[f64]) -> Evaluation {
        let lengths = self.lengths(point);
        let minimum =
            four_bar(&lengths, Branch::Upper).map_or(0.0, |f| f.minimum_transmission_angle());
        Evaluation {
            objective: point.first().copied().unwrap_or(f64::INFINITY),
            constraints: vec![
                not_crank_rocker(&lengths),
                (self.minimum_transmission_angle - minimum) / PI,
            ],
        }
    }

    fn is_costly(&self) -> bool {
        false
    }
}
