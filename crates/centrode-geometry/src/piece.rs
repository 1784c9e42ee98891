use crate::{Outline, Point, Segment, Tolerance, Vector, poly_segment::NODES};

/// Tangent jump, rad, above which a joint is a corner rather than rounding.
pub(crate) const CORNER: f64 = 1e-6;

/// A part of one segment with proven bounds on its length and curvature.
///
/// With the arc length `s` as parameter `|x''| = |κ|`, so a curve of length `L` whose curvature is at
/// most `K` leaves its chord by at most `L² K / 8`; a tangent jump `δ` inside it adds at most `L δ / 4`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    /// Index of the segment.
    pub(crate) segment: usize,
    /// Parameter of the start.
    pub(crate) u0: f64,
    /// Parameter of the end.
    pub(crate) u1: f64,
    /// Upper bound on the length, mm.
    pub(crate) length: f64,
    /// Upper bound on the curvature, 1/mm; infinite where the speed may vanish.
    pub(crate) curvature: f64,
    /// Upper bound on the speed.
    speed: f64,
    /// Curvature in the middle, 1/mm.
    middle: f64,
}

impl Piece {
    /// The part of `segment` between two parameters.
    pub(crate) fn new(segment: &Segment, index: usize, u0: f64, u1: f64) -> Self {
        let (speed, curvature, middle) = match segment {
            Segment::Line(start, end) => (0.5 * (end - start).norm(), 0.0, 0.0),
            Segment::Arc(arc) => {
                let jet = segment.at(0.0);
                let speed = jet.first.norm();
                let curvature = 0.5 * arc.sweep().abs() / speed;
                (speed, curvature, curvature)
            }
            Segment::Poly(poly) => {
                if u0 == -1.0 && u1 == 1.0 {
                    poly_bounds(poly.coefficients(), 1.0)
                } else {
                    let half = 0.5 * (u1 - u0);
                    let mut c = [Vector::zeros(); NODES];
                    c.copy_from_slice(poly.coefficients());
                    shift(&mut c, 0.5 * (u0 + u1));
                    poly_bounds(&c, half)
                }
            }
        };
        Self {
            segment: index,
            u0,
            u1,
            length: speed * (u1 - u0),
            curvature,
            speed,
            middle,
        }
    }

    /// Upper bound on the distance between a point of the piece and the point of its chord at the same
    /// share of the length.
    pub(crate) fn sagitta(&self) -> f64 {
        // No curve leaves its chord by more than half its length.
        (self.length * self.length * self.curvature / 8.0).min(0.5 * self.length)
    }

    /// Upper bound on the angle through which the tangent turns.
    pub(crate) fn turning(&self) -> f64 {
        if self.length == 0.0 {
            0.0
        } else {
            self.length * self.curvature
        }
    }

    /// The two halves.
    pub(crate) fn halves(&self, segment: &Segment) -> [Self; 2] {
        let middle = 0.5 * (self.u0 + self.u1);
        [
            Self::new(segment, self.segment, self.u0, middle),
            Self::new(segment, self.segment, middle, self.u1),
        ]
    }

    /// Upper bound on the length of the part after `u`.
    fn after(&self, u: f64) -> f64 {
        self.speed * (self.u1 - u)
    }
}

/// Moves the origin of the parameter to `middle`.
fn shift(c: &mut [Vector; NODES], middle: f64) {
    for low in 0..NODES - 1 {
        for k in (low..NODES - 1).rev() {
            let above = c[k + 1];
            c[k] += above * middle;
        }
    }
}

/// Bounds of a polynomial's speed and curvature over `[-half, half]`, and its curvature at zero.
fn poly_bounds(c: &[Vector], half: f64) -> (f64, f64, f64) {
    // velocity = c1 + 2 c2 v + rest, acceleration = 2 c2 + more.
    let (velocity, ramp) = (c[1], 2.0 * c[2] * half);
    let (mut rest, mut more) = (0.0, 0.0);
    let mut power = half;
    for (k, c) in c.iter().enumerate().skip(3) {
        let (size, k) = (c.norm(), k as f64);
        more += k * (k - 1.0) * size * power;
        power *= half;
        rest += k * size * power;
    }
    let at_ends = [(velocity - ramp).norm(), (velocity + ramp).norm()];
    let greatest = at_ends[0].max(at_ends[1]) + rest;
    let along = (-velocity.dot(&ramp) / ramp.norm_squared()).clamp(-1.0, 1.0);
    let nearest = if along.is_finite() {
        (velocity + ramp * along).norm()
    } else {
        velocity.norm()
    };
    let least = nearest - rest;
    let acceleration = 2.0 * c[2].norm() + more;
    let cross = 2.0 * velocity.perp(&c[2]).abs() + greatest * more + rest * acceleration;
    let curvature = if least > 0.0 {
        cross.min(greatest * acceleration) / least.powi(3)
    } else {
        f64::INFINITY
    };
    let middle = 2.0 * velocity.perp(&c[2]).abs() / velocity.norm().powi(3);
    (greatest, curvature, middle)
}

impl Segment {
    /// Whether the segment is shorter than the rounding of its end points, so its tangent is undefined.
    pub(crate) fn is_null(&self) -> bool {
        let start = self.start();
        let rounding = 4096.0 * f64::EPSILON * start.coords.amax();
        (self.end() - start).amax() <= rounding && self.length() <= rounding
    }

    /// Whether the part between two parameters stays nearer to a point than a distance, mm, at nine places of it.
    pub(crate) fn keeps_near(&self, point: Point, distance: f64, from: f64, to: f64) -> bool {
        let share = |i: u32| from + (to - from) * 0.125 * f64::from(i);
        (0..=8).all(|i| (point - self.at(share(i)).point).norm() < distance)
    }

    /// Unit tangent at `u`, the limit from inside where the speed vanishes at an end.
    #[must_use]
    pub fn tangent(&self, u: f64) -> Vector {
        let jet = self.at(u);
        let speed = jet.first.norm();
        if speed > 1e-9 * jet.second.norm() {
            jet.first / speed
        } else {
            let inside = if u < 0.0 { jet.second } else { -jet.second };
            inside.try_normalize(0.0).unwrap_or_else(|| {
                (self.end() - self.start())
                    .try_normalize(0.0)
                    .unwrap_or(Vector::x())
            })
        }
    }
}

/// Point of an outline, by a segment and the parameter on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    pub(crate) segment: usize,
    pub(crate) u: f64,
}

impl Outline {
    /// Point at a place, exact at the ends of a segment.
    pub(crate) fn point(&self, place: Place) -> Point {
        let segment = &self.segments()[place.segment];
        if place.u <= -1.0 {
            segment.start()
        } else if place.u >= 1.0 {
            segment.end()
        } else {
            segment.at(place.u).point
        }
    }

    /// Unsigned tangent jump at the start of each segment, rad. A segment without length is skipped and has none.
    pub(crate) fn jumps(&self) -> Vec<f64> {
        let last = self.segments().iter().rev().find(|s| !s.is_null());
        let mut before = last.map_or(Vector::x(), |s| s.tangent(1.0));
        self.segments()
            .iter()
            .map(|segment| {
                if segment.is_null() {
                    return 0.0;
                }
                let after = segment.tangent(-1.0);
                let jump = before.perp(&after).atan2(before.dot(&after)).abs();
                before = segment.tangent(1.0);
                jump
            })
            .collect()
    }

    /// The segments cut where their bounds are loose and it matters at this tolerance.
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
                // A cusp's bound stays loose, and true: it is stepped over in chords no longer than the tolerance.
                if depth < 40 && matters && piece.curvature > 1.4 * piece.middle {
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

    /// Places whose chords stay within the tolerance of the outline: every corner, and between corners
    /// the longest steps the bounds allow.
    pub(crate) fn places(&self, tolerance: Tolerance) -> Vec<Place> {
        self.steps(tolerance, true)
    }

    /// Places of [`places`](Self::places) with the start of every segment among them.
    pub(crate) fn places_by_segment(&self, tolerance: Tolerance) -> Vec<Place> {
        self.steps(tolerance, false)
    }

    fn steps(&self, tolerance: Tolerance, over_joints: bool) -> Vec<Place> {
        let pieces = self.pieces(tolerance);
        let jumps = self.jumps();
        let mut out = Vec::with_capacity(pieces.len());
        let (mut i, mut u) = (0, -1.0);
        while let Some(piece) = pieces.get(i) {
            crate::checkpoint();
            out.push(Place {
                segment: piece.segment,
                u,
            });
            let rest = piece.after(u);
            let own = reach(piece.curvature, 0.0, tolerance);
            if rest > own * (1.0 + 1e-9) {
                u += (piece.u1 - u) / (rest / own).ceil();
                continue;
            }
            (i, u) = if over_joints {
                self.stretch(&pieces, &jumps, i, rest, tolerance)
            } else {
                (i + 1, pieces.get(i + 1).map_or(1.0, |next| next.u0))
            };
        }
        out
    }

    /// Extends a step begun with `length` at the end of piece `i` over the following pieces.
    fn stretch(
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
            // Ends of lines and arcs are kept: they are features of the drawing.
            if jump > CORNER || !is_poly(piece) || !is_poly(&pieces[next - 1]) {
                break;
            }
            curvature = piece.curvature.max(curvature);
            turned += jump;
            let room = reach(curvature, turned, tolerance) - length;
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

/// Longest curve of the given greatest curvature and tangent jump that stays within the tolerance of
/// its chord, and turns by less than a quarter turn.
fn reach(curvature: f64, jump: f64, tolerance: Tolerance) -> f64 {
    let tol = tolerance.mm();
    // L² K / 8 + L δ / 4 = tol, in the form that does not cancel.
    let chord = 8.0 * tol / (jump + (jump * jump + 8.0 * curvature * tol).sqrt());
    chord
        .min(std::f64::consts::FRAC_PI_2 / curvature)
        .max(2.0 * tol)
}
