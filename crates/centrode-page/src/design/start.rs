use centrode_gear::cam::law::{LawSpec, Polynomial};
use centrode_gear::design::{Rack, Shaper, ToolSpec};
use centrode_gear::pitch::{
    Bezier, Bspline, Circle, Conjugate, EccentricCircle, Ellipse, Limacon, LobedEllipse, PitchSpec,
    Polar, Ratio, Transmission,
};
use centrode_geometry::Antiderivative;
use centrode_groove::{RotatedSine, Sine, SpeedFormula, SpeedKnots, SpeedLaw, SpeedTable};
use serde::Serialize;
use serde_json::{Map, Value};
use std::f64::consts::TAU;

/// Dimensions of the design for a table that changes its kind.
pub(super) struct Measures {
    /// Mean radius of the pitch curve, mm.
    radius: f64,
    /// Whether module or diametral pitch, with the tooth count, sets the size of the curve.
    sized: bool,
    /// Turns of driver and driven gear in a cycle.
    ratio: [u32; 2],
    /// Number of times that the curve must repeat per turn.
    repeats: u32,
    /// Lead of the shaft, mm per turn.
    lead: f64,
    /// The table as it is.
    old: Value,
}

impl Measures {
    /// Dimensions for a table of the design, from both as written.
    pub(super) fn new(design: &Value, path: &[&str], old: &Value) -> Self {
        let ratio_in = |table: &Value| {
            let pair = table.get("mean_ratio")?.as_array()?;
            let turns = |i: usize| u32::try_from(pair.get(i)?.as_u64()?).ok();
            Some([turns(0)?, turns(1)?]).filter(|turns| !turns.contains(&0))
        };
        // The tables around it, from the root.
        let mut around = vec![design];
        for name in path.iter().take(path.len().saturating_sub(1)) {
            around.extend(around.last().and_then(|table| table.get(name)));
        }
        let mut ratios = around.iter().map(|table| ratio_in(table).unwrap_or([1, 1]));
        let repeats = ratios.clone().map(|[_, driven]| driven).product();
        let number = |table: &Value, key: &str| table.get(key).and_then(Value::as_f64);
        let sizes = ["module", "diametral_pitch"];
        let sized =
            sizes.iter().any(|key| old.get(key).is_some()) && old.get("tooth_count").is_some();
        Self {
            radius: mean_radius(old).unwrap_or(40.0),
            sized,
            ratio: ratios.next_back().unwrap_or([1, 1]),
            repeats,
            lead: around
                .last()
                .and_then(|table| number(table, "lead"))
                .unwrap_or(20.0),
            old: old.clone(),
        }
    }
}

/// Mean radius of a pitch curve as written, mm.
fn mean_radius(pitch: &Value) -> Option<f64> {
    let spec: PitchSpec = serde_json::from_value(pitch.clone()).ok()?;
    let pitch = spec.resolve().ok()?;
    let mut ends = pitch.curve.breaks();
    ends.retain(|&t| t > 0.0);
    ends.insert(0, 0.0);
    ends.push(pitch.curve.period());
    Some(Antiderivative::new(|t| pitch.curve.at(t).first.norm(), &ends).total() / TAU)
}

/// Tables from which a kind can start, the preferred one first: each holds the keys that it needs in addition to the defaults.
pub(super) fn starts(kind: &str, about: &Measures) -> Vec<Map<String, Value>> {
    // A curve that does not repeat as often as the ratio requires gives no pair unless it is round.
    let swings = [0.2 / (1.0 + f64::from(about.repeats).powi(2)), 0.0];
    let pitches = swings
        .into_iter()
        .filter_map(|swing| table(pitch(kind, about, swing)?));
    // With a plain shaft only elliptic gears change the speed.
    let speeds = [0.4, 0.0]
        .into_iter()
        .filter_map(|swing| table(speed(kind, about.lead, swing)?));
    let others = [tool(kind).and_then(table), law(kind).and_then(table)];
    let others = others.into_iter().flatten();
    pitches.chain(speeds).chain(others).collect()
}

/// Keys of a table as the file holds them, without the keys that have no value.
fn table(written: impl Serialize) -> Option<Map<String, Value>> {
    let written = toml::Table::try_from(written).ok()?;
    match serde_json::to_value(written) {
        Ok(Value::Object(table)) => Some(table),
        _ => None,
    }
}

/// Rounds to a thousandth, so that numbers in the file are readable.
fn short(value: f64) -> f64 {
    (value * 1e3).round() / 1e3
}

/// A curve whose radius varies about the mean radius by a share of it; a circle if the share is 0.
fn pitch(kind: &str, about: &Measures, swing: f64) -> Option<PitchSpec> {
    let Measures { ratio, repeats, .. } = *about;
    let [n1, n2] = ratio;
    let mean = short(about.radius);
    let own = (!about.sized).then_some(mean);
    let center_distance = own.map(|r| short(r * (1.0 + f64::from(n1) / f64::from(n2))));
    let amplitude = short(swing * mean);
    // Curves of one lobe must be round if the ratio requires several lobes.
    let single = if repeats == 1 { swing } else { 0.0 };
    let share = f64::from(n2) / f64::from(n1);
    let (quotient, driven) = if n1 == n2 {
        ("1".to_owned(), "phi".to_owned())
    } else {
        (format!("{n2}/{n1}"), format!("{n2}/{n1}*phi"))
    };
    let wave = |sign: char, size: f64, function: &str| match (short(size), repeats) {
        (0.0, _) => String::new(),
        (size, 1) => format!(" {sign} {size}*{function}(phi)"),
        (size, _) => format!(" {sign} {size}*{function}({repeats}*phi)"),
    };
    Some(match kind {
        "circle" => PitchSpec::Circle(Circle {
            radius: own,
            ..Circle::default()
        }),
        "eccentric-circle" => PitchSpec::EccentricCircle(EccentricCircle {
            eccentricity: single,
            radius: own,
            ..EccentricCircle::default()
        }),
        "ellipse" => PitchSpec::Ellipse(Ellipse {
            eccentricity: single,
            semi_major_axis: own,
            ..Ellipse::default()
        }),
        "lobed-ellipse" => PitchSpec::LobedEllipse(LobedEllipse {
            lobes: if repeats == 1 { 2 } else { repeats },
            eccentricity: short(0.4 * swing),
            semi_major_axis: own,
            ..LobedEllipse::default()
        }),
        "limacon" => PitchSpec::Limacon(Limacon {
            mean_radius: mean,
            amplitude,
            lobes: repeats,
            ..Limacon::default()
        }),
        "bspline" => {
            let count = 6 * repeats.max(2);
            let angle: Vec<f64> = (0..count).map(|i| turn(i, count)).collect();
            PitchSpec::Bspline(Bspline {
                radius: angle
                    .iter()
                    .map(|phi| short(mean * (1.0 + swing * (f64::from(repeats) * phi).cos())))
                    .collect(),
                angle,
                ..Bspline::default()
            })
        }
        "bezier" => {
            // Arcs from crest to trough: level at both ends, so the chain is smooth.
            let (crest, trough) = (mean + amplitude, mean - amplitude);
            let count = 6 * repeats;
            PitchSpec::Bezier(Bezier {
                angle: (0..count).map(|i| turn(i, count)).collect(),
                radius: (0..repeats)
                    .flat_map(|_| [crest, crest, trough, trough, trough, crest])
                    .collect(),
                ..Bezier::default()
            })
        }
        "polar" => {
            let formula = format!("{mean}{}", wave('+', amplitude, "cos"));
            PitchSpec::Polar(Polar::expression(formula))
        }
        "transmission" => {
            let wave = wave('-', 2.0 * swing * share / f64::from(repeats), "sin");
            PitchSpec::Transmission(Transmission {
                center_distance,
                ..Transmission::expression(driven + &wave)
            })
        }
        "ratio" => {
            let wave = wave('-', 2.0 * swing * share, "cos");
            PitchSpec::Ratio(Ratio {
                center_distance,
                ..Ratio::expression(quotient + &wave)
            })
        }
        "conjugate" => {
            let of = serde_json::from_value(about.old.clone()).ok();
            let round = || {
                PitchSpec::Circle(Circle {
                    radius: Some(mean),
                    ..Circle::default()
                })
            };
            PitchSpec::Conjugate(Conjugate {
                mean_ratio: [1, 1],
                module: None,
                diametral_pitch: None,
                tooth_count: None,
                of: Box::new(of.filter(|_| swing > 0.0).unwrap_or_else(round)),
            })
        }
        _ => return None,
    })
}

/// Part `i` of `count` of a turn, rad.
fn turn(i: u32, count: u32) -> f64 {
    (360.0 * f64::from(i) / f64::from(count)).to_radians()
}

fn tool(kind: &str) -> Option<ToolSpec> {
    match kind {
        "rack" => Some(ToolSpec::Rack(Rack::default())),
        "shaper" => Some(ToolSpec::Shaper(Shaper::default())),
        _ => None,
    }
}

/// A law with one slow point per turn, at the angle zero, whose speed varies by a share of its mean.
fn speed(kind: &str, lead: f64, swing: f64) -> Option<SpeedLaw> {
    let amplitude = short(swing * lead / TAU);
    let (slow, fast) = (short(1.0 - swing), short(1.0 + swing));
    Some(match kind {
        "sine" => SpeedLaw::Sine(Sine {
            amplitude,
            ..Sine::default()
        }),
        "rotated-sine" => SpeedLaw::RotatedSine(RotatedSine {
            amplitude,
            ..RotatedSine::default()
        }),
        "knots" => SpeedLaw::Knots(SpeedKnots {
            angle: [30.0, 150.0, 210.0, 330.0].map(f64::to_radians).into(),
            speed: [slow, fast, fast, slow].into(),
            law: LawSpec::default(),
        }),
        "table" => SpeedLaw::Table(SpeedTable {
            speed: (0..12)
                .map(|i| short(1.0 - swing * turn(i, 12).cos()))
                .collect(),
            interpolation: None,
        }),
        "formula" => SpeedLaw::Formula(SpeedFormula {
            expression: if swing > 0.0 {
                format!("1 - {swing}*cos(phi)")
            } else {
                "1".into()
            },
        }),
        _ => return None,
    })
}

/// The 3-4-5 polynomial, to be edited; the other laws have no coefficients.
fn law(kind: &str) -> Option<LawSpec> {
    match kind {
        "polynomial" => Some(LawSpec::Polynomial(Polynomial {
            start: vec![0.0, 0.0],
            end: vec![0.0, 0.0],
        })),
        _ => LawSpec::named(kind),
    }
}
