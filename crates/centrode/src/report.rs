mod figures;
mod findings;
mod goals;
mod groups;
mod unit;

use std::io::Write;

use centrode::analysis::Report;
use centrode::mechanism::mechanism::Mechanism;
use centrode::mechanism::shaft::{Scheme, SpiralShaft};
use serde::Serialize;

pub(crate) use figures::{Section, sections};
pub(crate) use findings::{Words, summary, words};
pub(crate) use goals::{GoalWords, goal_words};

/// The report as other programs read it.
#[derive(Serialize)]
struct Json<'a> {
    ok: bool,
    #[serde(flatten)]
    report: &'a Report,
}

/// The report as JSON with every digit; an infinite figure is the string "Infinity". Ends with a newline.
pub(crate) fn json(report: &Report) -> std::io::Result<String> {
    let json = Json {
        ok: report.ok(),
        report,
    };
    let mut text = serde_json::to_string_pretty(&json)?;
    text.push('\n');
    Ok(text)
}

/// The report as a person reads it: findings first, then goals, tables and the figures in groups.
pub(crate) fn write(
    mechanism: &Mechanism,
    report: &Report,
    out: &mut impl Write,
) -> std::io::Result<()> {
    let name = [mechanism.name(), mechanism.title()].map(str::trim);
    let name: Vec<&str> = name.into_iter().filter(|part| !part.is_empty()).collect();
    writeln!(out, "{}", name.join(": "))?;
    writeln!(out, "{}", definition(mechanism))?;
    writeln!(out)?;
    findings::write(report, out)?;
    goals::write(report, out)?;
    figures::write(report, out)
}

/// What the mechanism is, in one line.
pub(crate) fn definition(mechanism: &Mechanism) -> String {
    match mechanism {
        Mechanism::GearPair(pair) => {
            let (driver, driven) = pair.mean_ratio();
            format!("{}; mean ratio {driver}:{driven}", pair.definition())
        }
        Mechanism::ThreeArm(arms) => format!(
            "{} arms; sun: {}; centre distance {:.6} mm",
            arms.arms(),
            arms.definition(),
            arms.center_distance()
        ),
        Mechanism::SpiralShaft(shaft) => shaft_in_words(shaft),
        Mechanism::MovingBox(machine) => {
            let scheme = match machine.design().scheme {
                Scheme::Shaft => "driven evenly",
                Scheme::EllipticGear | Scheme::Both => "driven by elliptic gears",
            };
            format!("{}, {scheme}", shaft_in_words(machine.shaft()))
        }
        Mechanism::Feeder(feeder) => {
            let [crank, coupler, rocker, frame] = feeder.six_bar().four_bar().lengths();
            format!(
                "crank {crank}, coupler {coupler}, rocker {rocker}, frame {frame} mm; {:.4} cycles a minute",
                feeder.cycles_per_minute()
            )
        }
    }
}

fn shaft_in_words(shaft: &SpiralShaft) -> String {
    let design = shaft.design();
    format!(
        "{} holes, {} mm a turn, {} turns out and back on a shaft of radius {} mm",
        design.holes,
        design.lead,
        shaft.traverse().turns(),
        design.radius
    )
}
