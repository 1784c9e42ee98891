use std::collections::BTreeMap;
use std::io::Write;
use std::process::ExitCode;

use centrode::analysis::Report;
use centrode::mechanism::gear::{Gear, GearPair};

use crate::args::Check;
use crate::failure::Failure;
use crate::input::Source;

/// Resolves a design and prints its report.
pub(crate) fn run(command: &Check, out: &mut impl Write) -> Result<ExitCode, Failure> {
    let source = Source::open(&command.design)?;
    let design = source.design()?;
    let pair = design.gear_pair().map_err(|error| source.blame(error))?;
    let report = report(&pair);
    if command.json {
        let json = serde_json::to_string_pretty(&report).map_err(std::io::Error::from)?;
        writeln!(out, "{json}")?;
    } else {
        print(&pair, &report, out)?;
    }
    Ok(ExitCode::from(u8::from(!report.ok())))
}

/// The figures every pair has.
fn report(pair: &GearPair) -> Report {
    let mut values = BTreeMap::from([
        ("center_distance", pair.center_distance()),
        ("module", pair.module()),
        ("pitch_length_driver", pair.driver().pitch_length()),
        ("pitch_length_driven", pair.driven().pitch_length()),
    ]);
    let mut gear = |keys: [&'static str; 3], gear: &Gear| {
        let (root, tip) = gear.radii();
        values.insert(keys[0], f64::from(gear.tooth_count()));
        values.insert(keys[1], root);
        values.insert(keys[2], tip);
    };
    gear(
        [
            "tooth_count_driver",
            "radius_min_driver",
            "radius_max_driver",
        ],
        pair.driver(),
    );
    gear(
        [
            "tooth_count_driven",
            "radius_min_driven",
            "radius_max_driven",
        ],
        pair.driven(),
    );
    Report {
        findings: Vec::new(),
        values,
    }
}

fn print(pair: &GearPair, report: &Report, out: &mut impl Write) -> std::io::Result<()> {
    let (driver, driven) = pair.mean_ratio();
    writeln!(out, "{}  {}", pair.name(), pair.title())?;
    writeln!(out, "pitch curve: {}", pair.definition())?;
    writeln!(out, "mean ratio {driver}:{driven}")?;
    let width = report.values.keys().map(|k| k.len()).max().unwrap_or(0);
    for (name, value) in &report.values {
        writeln!(out, "  {name:width$}  {value:.6}")?;
    }
    for finding in &report.findings {
        writeln!(out, "{:?}: {}", finding.severity, finding.message)?;
    }
    Ok(())
}
