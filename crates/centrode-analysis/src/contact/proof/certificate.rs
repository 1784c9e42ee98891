//! The file of a certificate, and the errors.

use centrode_gear::{Gear, Member};
use centrode_geometry::{Point, Segment};
use centrode_kinematics::machine::Piecewise;
use centrode_spec::DesignError;
use schemars::JsonSchema;
use serde::Serialize;

use super::prover::SHORTEST;

/// Certificate of a pair's contact at every driver angle of its cycle: lengths in mm, angles in rad.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub struct Proof {
    /// Always `centrode-proof`.
    pub format: String,
    /// Version of the format.
    pub version: u32,
    /// The design the pair was made from, as a design file.
    pub design: String,
    /// Name of the pair in it.
    pub pair: String,
    /// Centre distance, mm.
    pub center_distance: f64,
    /// Driver angle of a whole cycle, rad.
    pub cycle: f64,
    /// Driven angle by driver angle in pieces: the law to which every error in this file is relative.
    pub law: Piecewise,
    /// Half of the width of the interval in which every seat lies, rad.
    pub half_width: f64,
    /// The driver's contour, counter-clockwise: of each piece the coefficients in u from -1 to 1, constant first, [x, y] in mm.
    pub driver: Vec<Vec<[f64; 2]>>,
    /// The driven gear's contour.
    pub driven: Vec<Vec<[f64; 2]>>,
    /// Number of equal parts of the cycle after which both contours and the law repeat, apart from rounding.
    pub sectors: u32,
    /// Stretches of the first part of the cycle from 0 on, each starting where the one before it ends.
    pub stretches: Vec<ProofStretch>,
}

/// Stretch of the cycle on which the same two features hold the driven gear.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub struct ProofStretch {
    /// First driver angle, rad.
    pub from: f64,
    /// Last driver angle, rad.
    pub to: f64,
    /// Chebyshev coefficients of the seat less the law, rad: pushed forward, pushed back.
    pub seats: [Vec<f64>; 2],
    /// Which of the meetings holds the driven gear: pushed forward, pushed back.
    pub held_by: [usize; 2],
    /// Features that touch or nearly touch.
    pub meetings: Vec<ProofMeeting>,
}

/// Features of the two contours that meet when the driven gear is turned.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub struct ProofMeeting {
    /// 0 if it holds the gear that is pushed forward, 1 if it holds the gear that is pushed back.
    pub side: usize,
    /// Pieces of the driver's and of the driven gear's contour.
    pub pieces: [usize; 2],
    /// The gear that meets the other with a corner, 0 the driver, 1 the driven gear. `None` if both contours are smooth
    /// there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub corner: Option<usize>,
    /// Chebyshev coefficients of the parameters on the two pieces.
    pub parameters: [Vec<f64>; 2],
    /// Coefficients k of parabolas y = k x^2 that part the contours, in axes along their tangent, 1/mm: that which parts them
    /// the farthest first, then those that hold where it does not.
    pub bends: Vec<f64>,
}

impl Proof {
    /// The bytes of the file, identical at every call.
    ///
    /// # Errors
    /// [`serde_json::Error`] for a certificate that cannot be written.
    pub fn file(&self) -> serde_json::Result<Vec<u8>> {
        let mut bytes = serde_json::to_vec(self)?;
        bytes.push(b'\n');
        Ok(bytes)
    }

    /// The JSON schema of the file.
    #[must_use]
    pub fn schema() -> serde_json::Value {
        schemars::schema_for!(Self).to_value()
    }
}

/// Reason why there is no certificate.
#[derive(Debug, thiserror::Error)]
pub enum ProofError {
    /// The design cannot be written.
    #[error(transparent)]
    Design(#[from] DesignError),
    /// Nothing holds the driven gear.
    #[error(
        "the gears lose contact at the driver angle {phi:.6} rad: a mesh without contact cannot be certified"
    )]
    Apart {
        /// Driver angle, rad.
        phi: f64,
    },
    /// The gears have no room for each other.
    #[error(
        "at the driver angle {phi:.6} rad the gears interfere at every angle of the driven gear: {overlap:.3e} rad of backlash is missing; use more backlash, a pitch curve of gentler curvature, or more teeth of a smaller module"
    )]
    NoRoom {
        /// Driver angle, rad.
        phi: f64,
        /// Missing room, rad of the driven gear.
        overlap: f64,
    },
    /// The features that hold the driven gear change too often to be determined.
    #[error(
        "the contact that holds the driven gear at the driver angle {phi:.9} rad cannot be determined, even over only {SHORTEST} rad"
    )]
    Unresolved {
        /// Driver angle, rad.
        phi: f64,
    },
    /// A seat jumps: teeth meet within the backlash.
    #[error(
        "at the driver angle {phi:.6} rad the driven gear, pushed {side}, jumps by {turn:.3e} rad: driver tooth {} hits driven \
        tooth {} within the backlash, at ({:.4}, {:.4}) mm in the driver's axes. Use a less curved pitch curve, or more teeth of a \
        smaller module", .teeth.0, .teeth.1, .point.x, .point.y
    )]
    Step {
        /// Driver angle, rad.
        phi: f64,
        /// Direction in which the driven gear is pushed: `forward` or `back`.
        side: &'static str,
        /// Rotation of the driven gear from its seat to the position in which the teeth meet, rad.
        turn: f64,
        /// Tooth of the driver, tooth of the driven gear.
        teeth: (u32, u32),
        /// Point at which the teeth meet, mm, in the driver's axes.
        point: Point,
    },
    /// A contour has a piece that is not a polynomial.
    #[error("piece {piece} of the {}'s contour is an arc, but the proof supports polynomials only", .member.name())]
    Arc {
        /// The gear.
        member: Member,
        /// Index of the piece, from 0.
        piece: usize,
    },
}

/// Coefficients of a contour's pieces.
pub(super) fn contour(gear: &Gear, member: Member) -> Result<Vec<Vec<[f64; 2]>>, ProofError> {
    let segments = gear.outline().segments().iter().enumerate();
    let coefficients = |(piece, segment): (usize, &Segment)| match segment {
        Segment::Poly(poly) => Ok(poly.coefficients().iter().map(|c| [c.x, c.y]).collect()),
        Segment::Line(start, end) => {
            let middle = nalgebra::center(start, end);
            let half = (end - start) * 0.5;
            Ok(vec![[middle.x, middle.y], [half.x, half.y]])
        }
        Segment::Arc(_) => Err(ProofError::Arc { member, piece }),
    };
    segments.map(coefficients).collect()
}
