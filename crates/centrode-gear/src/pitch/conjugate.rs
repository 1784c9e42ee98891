use centrode_geometry::{Curve, Jet, Point};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::plane::ScalableCurve;
use super::size::{OwnSize, Size};
use super::{Draft, PitchError, PitchSpec};
use crate::{ConjugateCurve, Rolling};

/// Maximum depth of conjugates of conjugates: limits the time of an evaluation.
const DEEPEST: usize = 4;

/// Curve that rolls on another: the driven curve of one pair as the driver of the next.
///
/// Its point in mesh at phi = 0 lies on the x axis; the conjugate of this curve, at the mean ratio
/// turned round, is `of`.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Conjugate {
    /// Turns of `of` and of this curve in one whole cycle.
    #[serde(default = "one_to_one")]
    pub mean_ratio: [u32; 2],
    /// Module, mm, with `tooth_count`: scales the curve.
    pub module: Option<f64>,
    /// Diametral pitch, 1/in, instead of the module: 25.4 mm over the module.
    pub diametral_pitch: Option<f64>,
    /// Number of teeth; alone, the module follows from the size of the curve.
    pub tooth_count: Option<u32>,
    /// The curve it rolls on.
    pub of: Box<PitchSpec>,
}

fn one_to_one() -> [u32; 2] {
    [1, 1]
}

impl Conjugate {
    pub(crate) fn draft(&self) -> Result<Draft, PitchError> {
        let size = Size::new(
            self.module,
            self.diametral_pitch,
            self.tooth_count,
            OwnSize::Written,
        );
        size.check()?;
        if self.depth() > DEEPEST {
            let (key, rule) = ("of", "nests conjugates more than four deep");
            return Err(PitchError::Key { key, rule });
        }
        let of = self.of.resolve().map_err(|e| PitchError::Of(Box::new(e)))?;
        let [n1, n2] = self.mean_ratio;
        let rolling = Rolling::new(of.curve, (n1, n2))
            .map_err(|reason| PitchError::NoConjugate(Box::new(reason)))?;
        let definition = format!("conjugate, {n1}:{n2}, of {}", of.definition);
        let curve = Rolled {
            curve: ConjugateCurve::new(rolling),
            scale: 1.0,
        };
        Draft::new("of", curve, size, definition)
    }

    fn depth(&self) -> usize {
        let mut depth = 1;
        let mut of = self.of.as_ref();
        while let PitchSpec::Conjugate(inner) = of {
            depth += 1;
            of = inner.of.as_ref();
        }
        depth
    }
}

/// Driven curve whose size can still be changed.
#[derive(Debug)]
struct Rolled {
    curve: ConjugateCurve,
    scale: f64,
}

impl Curve for Rolled {
    fn period(&self) -> f64 {
        self.curve.period()
    }

    fn breaks(&self) -> Vec<f64> {
        self.curve.breaks()
    }

    fn at(&self, t: f64) -> Jet {
        let jet = self.curve.at(t);
        Jet {
            point: Point::from(jet.point.coords * self.scale),
            first: jet.first * self.scale,
            second: jet.second * self.scale,
            third: jet.third * self.scale,
        }
    }
}

impl ScalableCurve for Rolled {
    fn rescale(&mut self, factor: f64) {
        self.scale *= factor;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pitch::{Ellipse, Polar};

    fn of(spec: PitchSpec, mean_ratio: [u32; 2]) -> PitchSpec {
        PitchSpec::Conjugate(Conjugate {
            mean_ratio,
            module: None,
            diametral_pitch: None,
            tooth_count: None,
            of: Box::new(spec),
        })
    }

    #[test]
    fn the_conjugate_of_the_conjugate_is_the_original() {
        let lobed = PitchSpec::Polar(Polar::expression("20 + cos(2*phi) + sin(4*phi)"));
        for ratio in [[1, 1], [2, 1], [3, 2], [1, 2]] {
            let back = of(of(lobed.clone(), ratio), [ratio[1], ratio[0]]);
            let curve = back.resolve().expect("a curve").curve;
            let original = lobed.resolve().expect("a curve").curve;
            for i in 0..200 {
                let point = curve.at(curve.period() * f64::from(i) / 200.0).point;
                let angle = point.y.atan2(point.x);
                let radius = original.at(angle).point.coords.norm();
                assert!((point.coords.norm() - radius).abs() < 1e-10, "{ratio:?}");
            }
        }
    }

    #[test]
    fn a_seam_on_the_axis_is_the_start_whatever_the_rounding() {
        for amplitude in [0.0, 0.09375, 0.1, -0.2] {
            for length in [1.0, 9.0, 17.3] {
                for ratio in [[1, 1], [2, 1], [1, 2], [3, 2]] {
                    let text = format!("{length}*(1 + {amplitude}*cos(2*phi))");
                    let spec = PitchSpec::Polar(Polar::expression(text));
                    let start = spec.resolve().expect("a curve").curve.at(0.0).point;
                    let back = of(of(spec, ratio), [ratio[1], ratio[0]]);
                    let curve = back.resolve().expect("a curve").curve;
                    assert!((curve.at(0.0).point - start).norm() < 1e-12 * length);
                }
            }
        }
    }

    #[test]
    fn module_and_tooth_count_set_its_size() {
        let spec = PitchSpec::Conjugate(Conjugate {
            mean_ratio: [2, 1],
            module: Some(1.5),
            diametral_pitch: None,
            tooth_count: Some(40),
            of: Box::new(PitchSpec::Polar(Polar::expression("1 + 0.1*cos(phi)"))),
        });
        let pitch = spec.resolve().expect("a curve");
        let length = crate::pitch::perimeter(pitch.curve.as_ref());
        assert!((length / (60.0 * std::f64::consts::PI) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn faults_name_the_curve_within_or_the_ratio() {
        let ellipse = |eccentricity| {
            PitchSpec::Ellipse(Ellipse {
                eccentricity,
                semi_major_axis: Some(20.0),
                ..Ellipse::default()
            })
        };
        let key = |spec: PitchSpec| spec.resolve().expect_err("no curve").key();
        assert_eq!(key(of(ellipse(1.5), [1, 1])), "of");
        assert_eq!(key(of(ellipse(0.5), [1, 2])), "mean_ratio");
        assert_eq!(key(of(ellipse(0.5), [0, 1])), "mean_ratio");
        let mut deep = ellipse(0.1);
        for _ in 0..5 {
            deep = of(deep, [1, 1]);
        }
        assert_eq!(key(deep), "of");
    }
}
