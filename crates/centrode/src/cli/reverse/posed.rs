use std::io::Write;
use std::ops::ControlFlow;

use clap::Parser as _;

use crate::analysis::{Goal, Unit};
use centrode_spec::Design as _;
use centrode_synthesis::optimise::three_arm::PosedProblem;
use centrode_synthesis::reverse::{KeyPose, KeyPoses};

use super::{line, lines, words};
use crate::cli::args::{Arguments, Command, Reverse};
use crate::cli::failure::Failure;
use crate::cli::progress::Progress;
use crate::cli::{Status, export, output};

/// Makes a three-arm mechanism from key poses, prints its figures, and writes its design and, if requested, its files.
pub(crate) fn run(command: &Reverse, out: &mut impl Write) -> Result<Status, Failure> {
    let source = super::source(command)?;
    if let Some(output) = &command.output {
        source.keep(output, "the poses")?;
    }
    let progress = Progress::new(2);
    progress.step("trying positions of the arm's axis");
    let required = KeyPose::from_csv(source.bytes()).map_err(|error| source.refused(&error))?;
    let chains = KeyPoses::mildest(&required, PosedProblem::CHAINS)
        .map_err(|error| source.refused(&error))?;
    progress.step("searching for goals and sound teeth");
    let posed = PosedProblem::search(&chains, command.arms.unwrap_or(1), &mut |_, _| {
        ControlFlow::Continue(())
    })
    .map_err(|error| source.refused(&error))?;
    drop(progress);
    let mm = |x: f64| Unit::Millimetre.with_unit(x);
    let (found, design) = (&posed.poses, &posed.design);
    let chain = &found.chain;
    lines(words::poses(found.clamp, &posed.misses), out)?;
    let axis = chain.axis();
    line(
        out,
        "axis of the carrier",
        &format!("{:.4}, {:.4} mm", axis.x, axis.y),
    )?;
    line(out, "carrier", &mm(chain.carrier()))?;
    line(out, "arm", &mm(chain.arm()))?;
    let bend = format!(
        "{}, found in {} evaluations",
        Unit::Angle.with_unit(design.bend),
        posed.evaluations
    );
    line(out, "bend", &bend)?;
    if let Some(count) = design.tooth_count {
        line(
            out,
            "teeth",
            &format!("{count} full-height teeth on every gear"),
        )?;
    }
    for goal in &posed.goals {
        let name = match goal.number {
            0 => "constraint".to_owned(),
            number => format!("goal {number}"),
        };
        line(out, &name, &words(goal))?;
    }
    let Some(output) = &command.output else {
        return Ok(Status::new(posed.is_reached));
    };
    let text = design.to_toml();
    let text = text.map_err(|error| Failure::Files(Box::new(error)))?;
    writeln!(out)?;
    output::write_one(output, text.into_bytes(), out)?;
    match &command.to {
        Some(folder) => {
            let words = ["centrode", "export", "--to"].map(std::ffi::OsString::from);
            let paths = [folder.as_os_str(), output.as_os_str()].map(std::ffi::OsString::from);
            let words = words.into_iter().chain(paths);
            match Arguments::try_parse_from(words).map(|arguments| arguments.command) {
                Ok(Command::Export(command)) => export::run(&command, out),
                Ok(_) => Ok(Status::Good),
                Err(error) => Err(Failure::Usage(error.to_string())),
            }
        }
        None => Ok(Status::new(posed.is_reached)),
    }
}

/// A goal in words, and whether it is reached.
fn words(goal: &Goal) -> String {
    let value = goal.value.map(|value| goal.unit.with_unit(value));
    let met = match goal.met() {
        Some(true) => "met",
        Some(false) => "missed",
        None => "not checked",
    };
    format!(
        "{}{}, {met}",
        goal.title,
        value.map_or_else(String::new, |value| format!(": {value}"))
    )
}
