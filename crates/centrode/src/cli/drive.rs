use std::io::Write;

use crate::analysis::{Unit, with_sound_teeth};
use centrode_spec::Design as _;
use centrode_synthesis::reverse::{GearDrive, GearDriveSpec};

use crate::cli::args::Drive;
use crate::cli::failure::Failure;
use crate::cli::input::Source;
use crate::cli::progress::Progress;
use crate::cli::reverse::{line, minimum_radii, teeth};
use crate::cli::{Status, output};
use crate::page::reverse::words::range;

/// Finds the gears of a drive, prints their figures and writes the design.
pub(crate) fn run(command: &Drive, out: &mut impl Write) -> Result<Status, Failure> {
    let source = Source::open_design(&command.design)?;
    if let Some(output) = &command.output {
        source.keep_from(output)?;
    }
    let design = source.design()?;
    let progress = Progress::new(3);
    progress.step("resolving the design");
    let mechanism = design.mechanism().map_err(|error| source.blame(error))?;
    progress.step("computing the law of the crank");
    let spec = GearDriveSpec {
        body: command.body.clone(),
        center_distance: command.center_distance,
        direction: command.direction.to_radians(),
    };
    let made = mechanism.gear_drive(&spec).ok_or_else(|| {
        let family = mechanism.design().family().word;
        Failure::Usage(format!(
            "a drive can be designed only for family \"machine\", not for {family:?}"
        ))
    })?;
    let made = made.map_err(|error| source.refused(&error))?;
    // The result is reported before teeth are searched, even if there are none.
    found(&made, out)?;
    out.flush()?;
    let Some(output) = &command.output else {
        return Ok(Status::Good);
    };
    progress.step("searching for sound teeth");
    let toothed = with_sound_teeth(&made.design, |pair| pair == GearDrive::PAIR);
    drop(progress);
    let (design, found) = toothed.map_err(|error| Failure::Files(Box::new(error)))?;
    teeth(&found, out)?;
    let text = design.to_toml();
    let text = text.map_err(|error| Failure::Files(Box::new(error)))?;
    // An impossible machine is not written.
    let driven = Source::of_text(&text);
    let machine = driven.design()?.mechanism();
    machine.map_err(|error| driven.blame(error))?;
    writeln!(out)?;
    output::write_one(output, text.into_bytes(), out)?;
    Ok(Status::Good)
}

fn found(made: &GearDrive, out: &mut impl Write) -> std::io::Result<()> {
    let unit = if made.turns {
        Unit::Angle
    } else {
        Unit::Millimetre
    };
    let [minimum, maximum] = made.timing.places().map(|place| unit.with_unit(place));
    line(out, "output", &format!("{minimum} to {maximum}"))?;
    let [low, high] = made.timing.ratios();
    let words = format!(
        "{}, minimum at {}, maximum at {} of the input",
        range([low.value, high.value]),
        Unit::Angle.with_unit(low.input),
        Unit::Angle.with_unit(high.input)
    );
    line(out, "ratio", &words)?;
    minimum_radii(out, GearDrive::PAIR, made.minimum_radii)?;
    let words = format!(
        "at most {}, with a law of {} steps",
        unit.with_unit(made.miss.value),
        made.steps
    );
    line(out, "deviation from law", &words)?;
    if !made.left_alone.is_empty() {
        line(out, "goals not considered", &made.left_alone.join(", "))?;
    }
    Ok(())
}
