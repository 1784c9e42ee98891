use centrode_geometry::{Antiderivative, bracketed_root};

use centrode_kinematics::transmission::MotionJet;

/// Maximum size of the bow: beyond it a law is too abrupt, with a ratio that changes by a factor of e to this power.
const MOST: f64 = 7.0;

/// Motion between two others: u = ln of the speed is the sum of a polynomial that joins both motions with two derivatives, and of
/// a hump that adjusts the distance between them.
#[derive(Clone, Debug)]
pub(super) struct Free {
    shape: LogSpeed,
    way: Antiderivative,
}

/// The logarithm of the speed over an interval.
#[derive(Clone, Copy, Debug)]
struct LogSpeed {
    from: f64,
    span: f64,
    /// Coefficients of a polynomial in the share of the span.
    coefficients: [f64; 6],
    /// Factors of the hump (4 x (1 - x))³, which is 1 in the middle, and of the hump times 2 x - 1.
    bow: f64,
    skew: f64,
}

impl Free {
    /// The motion over an interval between jets at both ends, faster in the second half by a skew; `None` if it would be too
    /// abrupt.
    pub(super) fn between([from, to]: [f64; 2], ends: &[MotionJet; 2], skew: f64) -> Option<Self> {
        let span = to - from;
        let way = ends[1].position - ends[0].position;
        // Logarithm of the speed and two derivatives by the share of the span.
        let [[u0, d0, s0], [u1, d1, s1]] = [&ends[0], &ends[1]].map(|end| {
            let slope = end.acceleration / end.velocity;
            let bend = end.jerk / end.velocity - slope * slope;
            [end.velocity.ln(), slope * span, bend * span * span]
        });
        let [d, e, f] = [u1 - u0 - d0 - 0.5 * s0, d1 - d0 - s0, s1 - s0];
        let coefficients = [
            u0,
            d0,
            0.5 * s0,
            10.0 * d - 4.0 * e + 0.5 * f,
            -15.0 * d + 7.0 * e - f,
            6.0 * d - 3.0 * e + 0.5 * f,
        ];
        let with = |bow: f64| LogSpeed {
            from,
            span,
            coefficients,
            bow,
            skew,
        };
        // The larger the bow, the longer the distance.
        let miss = |bow: f64| with(bow).way().total().ln() - way.ln();
        let [low, high] = [-MOST, MOST].map(miss);
        let is_between = low < 0.0 && high > 0.0;
        if !is_between {
            return None;
        }
        let shape = with(bracketed_root(miss, -MOST, MOST, low, high));
        Some(Self {
            shape,
            way: shape.way(),
        })
    }

    /// Logarithm of the speed at a share of the interval, with two derivatives by the input.
    pub(super) fn speed(&self, share: f64) -> [f64; 3] {
        self.shape.at(self.shape.from + share * self.shape.span)
    }

    /// The motion at an input, with the position at the start of the interval.
    pub(super) fn at(&self, start: f64, input: f64) -> MotionJet {
        let [u, slope, bend] = self.shape.at(input);
        let speed = u.exp();
        MotionJet {
            position: start + self.way.at(input),
            velocity: speed,
            acceleration: slope * speed,
            jerk: (bend + slope * slope) * speed,
        }
    }
}

impl LogSpeed {
    /// Logarithm of the speed and two derivatives by the input.
    fn at(&self, input: f64) -> [f64; 3] {
        let x = (input - self.from) / self.span;
        let [mut u, mut slope, mut bend] = [0.0; 3];
        for c in self.coefficients.into_iter().rev() {
            bend = bend * x + 2.0 * slope;
            slope = slope * x + u;
            u = u * x + c;
        }
        let (w, w1) = (4.0 * x * (1.0 - x), 4.0 - 8.0 * x);
        let hump = [
            w * w * w,
            3.0 * w * w * w1,
            6.0 * w * w1 * w1 - 24.0 * w * w,
        ];
        let factor = self.bow + self.skew * (2.0 * x - 1.0);
        u += factor * hump[0];
        slope += factor * hump[1] + 2.0 * self.skew * hump[0];
        bend += factor * hump[2] + 4.0 * self.skew * hump[1];
        [u, slope / self.span, bend / (self.span * self.span)]
    }

    fn way(self) -> Antiderivative {
        let ends = [self.from, self.from + self.span];
        Antiderivative::new(|input| self.at(input)[0].exp(), &ends)
    }
}
