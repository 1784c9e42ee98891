use crate::{
    curve::{Piece, Segment},
    numeric::{COMPUTED, Tolerance},
    region::{CORNER, Outline, Position},
};

impl Outline {
    /// The segments, cut where their bounds are loose enough to matter at this tolerance.
    fn pieces(&self, tolerance: Tolerance) -> Vec<Piece> {
        let mut out = Vec::with_capacity(self.segments().len());
        let mut stack = Vec::new();
        for (index, segment) in self.segments().iter().enumerate() {
            if segment.is_null() {
                continue;
            }
            stack.push((Piece::new(segment, index, -1.0, 1.0), 0));
            while let Some((piece, depth)) = stack.pop() {
                crate::checkpoint();
                let matters = piece.sagitta() > tolerance.mm();
                // The bound at a cusp stays loose, but valid: the chords there are no longer than the tolerance.
                if depth < 40 && matters && piece.curvature > 1.4 * piece.middle_curvature {
                    let [first, second] = piece.halves(segment);
                    stack.push((second, depth + 1));
                    stack.push((first, depth + 1));
                } else {
                    out.push(piece);
                }
            }
        }
        out
    }

    /// Positions whose chords stay within the tolerance of the outline: every corner, and between corners the longest steps
    /// that the bounds allow.
    pub(crate) fn positions(&self, tolerance: Tolerance) -> Vec<Position> {
        self.steps(tolerance, true)
    }

    /// Like [`positions`](Self::positions), with the start of every segment.
    pub(crate) fn positions_by_segment(&self, tolerance: Tolerance) -> Vec<Position> {
        self.steps(tolerance, false)
    }

    /// Positions within the tolerance; `over_joints` allows a step to pass smooth joints of polynomials.
    fn steps(&self, tolerance: Tolerance, over_joints: bool) -> Vec<Position> {
        let pieces = self.pieces(tolerance);
        let jumps = self.tangent_jumps();
        let mut out = Vec::with_capacity(pieces.len());
        let (mut i, mut u) = (0, -1.0);
        while let Some(piece) = pieces.get(i) {
            crate::checkpoint();
            out.push(Position {
                segment: piece.segment,
                u,
            });
            let rest = piece.after(u);
            let own = max_length(piece.curvature, 0.0, tolerance);
            if rest > own * (1.0 + COMPUTED) {
                u += (piece.u1 - u) / (rest / own).ceil();
                continue;
            }
            (i, u) = if over_joints {
                self.extend(&pieces, &jumps, i, rest, tolerance)
            } else {
                (i + 1, pieces.get(i + 1).map_or(1.0, |next| next.u0))
            };
        }
        out
    }

    /// Extends a step of `length` up to the end of piece `i` over the following pieces: piece and parameter of its end.
    fn extend(
        &self,
        pieces: &[Piece],
        jumps: &[f64],
        i: usize,
        mut length: f64,
        tolerance: Tolerance,
    ) -> (usize, f64) {
        let is_poly = |p: &Piece| matches!(self.segments()[p.segment], Segment::Poly(_));
        let (mut curvature, mut turned) = (pieces[i].curvature, 0.0);
        let mut next = i + 1;
        while let Some(piece) = pieces.get(next) {
            let jump = if piece.u0 == -1.0 {
                jumps[piece.segment]
            } else {
                0.0
            };
            // Ends of lines and arcs are features of the drawing and stay.
            if jump > CORNER || !is_poly(piece) || !is_poly(&pieces[next - 1]) {
                break;
            }
            curvature = piece.curvature.max(curvature);
            turned += jump;
            let room = max_length(curvature, turned, tolerance) - length;
            if room >= piece.length {
                length += piece.length;
                next += 1;
            } else if room > 0.1 * piece.length {
                return (next, piece.u0 + (piece.u1 - piece.u0) * room / piece.length);
            } else {
                break;
            }
        }
        (next, pieces.get(next).map_or(1.0, |piece| piece.u0))
    }
}

/// Length, mm, of the longest curve with such a maximum curvature and tangent jump that stays within the tolerance of its
/// chord and turns by less than a quarter turn.
fn max_length(curvature: f64, jump: f64, tolerance: Tolerance) -> f64 {
    let tol = tolerance.mm();
    // L² K / 8 + L δ / 4 = tol, solved without cancellation.
    let chord = 8.0 * tol / (jump + (jump * jump + 8.0 * curvature * tol).sqrt());
    chord
        .min(std::f64::consts::FRAC_PI_2 / curvature)
        .max(2.0 * tol)
}
