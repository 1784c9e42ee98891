mod posed;
mod request;

use std::io::Write;
use std::ops::ControlFlow;
use std::path::Path;

use crate::analysis::{Severity, SoundTeeth, Unit};
use centrode_spec::DesignSpec as _;
use centrode_synthesis::optimise::EasingError;
use centrode_synthesis::reverse::{
    AxisMap, KeyPose, PathDesign, RequiredPath, ReversedMachine, Split,
};

use crate::cli::args::Reverse;
use crate::cli::failure::Failure;
use crate::cli::input::Source;
use crate::cli::interrupt::Interrupt;
use crate::cli::progress::Progress;
use crate::cli::{Status, output};

use crate::page::reverse::{Found, NotFound, Toothed, rolled, words};
use request::Request;

/// Width of the names of figures.
const NAME: usize = 24;

/// Makes a machine from a path, prints its figures and writes its design.
pub(crate) fn run(command: &Reverse, out: &mut impl Write) -> Result<Status, Failure> {
    if command.template {
        out.write_all(PathDesign::TEMPLATE.as_bytes())?;
        return Ok(Status::Good);
    }
    if command.three_arm {
        return posed::run(command, out);
    }
    let progress = Progress::new(4);
    // The watch must live to the end, so that a second Ctrl-C ends the steps after the search.
    let (requested, found, _interrupt) = match command.poses {
        true => {
            let source = source(command)?;
            progress.step("trying positions of the arm's axis");
            let poses =
                KeyPose::from_csv(source.bytes()).map_err(|error| source.refused(&error))?;
            let found = Found::by_poses(&poses).map_err(|error| source.refused(&error))?;
            (Request::of_poses(source, command)?, found, None)
        }
        false => {
            let requested = Request::read(command)?;
            let (found, interrupt) = search(command, &requested, &progress)?;
            (requested, found, interrupt)
        }
    };
    if let Some(output) = &command.output {
        requested.source.keep(output, "the path")?;
    }
    let design = &requested.design;
    let (chain, kind, bend) = (&found.chain, design.split, design.bend);
    let bend_deg = requested.bend_deg(command);
    progress.step("splitting the motion");
    let split = Split::new(chain, kind, bend)
        .map_err(|error| requested.blame(command.bend.is_some(), "--bend", "bend_deg", error))?;
    progress.step("computing the pitch curves");
    let made = rolled(design, chain, &split);
    let made = made.map_err(|error| Failure::Files(Box::new(error)))?;
    progress.step("searching for sound teeth");
    let toothed = command.output.as_ref().map(|_| Toothed::new(&made));
    drop(progress);
    if let Some(words) = &requested.drawing {
        line(out, "path", words)?;
    }
    lines(found.stated.clone(), out)?;
    lines(found.goals.iter().map(words::goal), out)?;
    lines(found.findings.iter().map(words::finding), out)?;
    chosen(design.arms, bend_deg, &found, &split, &made, out)?;
    gears(&made, out)?;
    if let Some(map) = map(&requested, &found) {
        possible(&map, out)?;
    }
    lines(words::other_splits(chain, kind, bend), out)?;
    let (Some(output), Some(toothed)) = (&command.output, toothed) else {
        return Ok(Status::new(found.is_reached));
    };
    // The result is reported even if there are no teeth.
    out.flush()?;
    let toothed = toothed.map_err(|error| Failure::Files(Box::new(error)))?;
    teeth(&toothed.teeth, out)?;
    lines(toothed.findings.iter().map(words::finding), out)?;
    let text = toothed.design.to_toml();
    let text = text.map_err(|error| Failure::Files(Box::new(error)))?;
    writeln!(out)?;
    output::write_one(output, text.into_bytes(), out)?;
    let errors = toothed
        .findings
        .iter()
        .filter(|finding| finding.severity == Severity::Error);
    Ok(Status::new(found.is_reached && errors.count() == 0))
}

pub(crate) fn line(out: &mut impl Write, name: &str, words: &str) -> std::io::Result<()> {
    writeln!(out, "{name:NAME$}{words}")
}

/// Prints names and words, one pair per line.
fn lines(
    all: impl IntoIterator<Item = (String, String)>,
    out: &mut impl Write,
) -> std::io::Result<()> {
    let mut all = all.into_iter();
    all.try_for_each(|(name, words)| line(out, &name, &words))
}

/// Searches for the machine of a path; shows progress, and Ctrl-C ends the search with the best found.
fn search(
    command: &Reverse,
    requested: &Request,
    progress: &Progress,
) -> Result<(Found, Option<Interrupt>), Failure> {
    let is_searched = requested.design.bands().is_some();
    progress.step(match is_searched {
        true => "searching for the path",
        false => "trying axes",
    });
    let interrupt = is_searched.then(Interrupt::watch);
    let came = || interrupt.as_ref().is_some_and(Interrupt::came);
    let mut evaluations = 0;
    let found = Found::by_path(&requested.design, &requested.points, &mut |done| {
        evaluations = done;
        progress.report(format!("searching for the path, {done} evaluations,"));
        match came() {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    });
    let mut found = found.map_err(|error| refused(command, requested, error))?;
    if came() {
        let words = format!("stopped after {evaluations} evaluations; this is the best so far");
        found.stated.push(("search".into(), words));
    }
    Ok((found, interrupt))
}

fn refused(command: &Reverse, requested: &Request, error: NotFound) -> Failure {
    match error {
        NotFound::Crossing(error) => {
            let name = requested.source.name();
            Failure::Usage(format!(
                "{name}: {error} To accept such a path, use {}.",
                requested.spelled("--crossing", "path.crossing = true")
            ))
        }
        NotFound::Axis { fault, .. } => {
            requested.blame(command.axis.is_some(), "--axis", "axis", fault)
        }
        NotFound::Easing(EasingError::Module { .. }) => {
            let module = command.module.unwrap_or_default();
            Failure::Usage(format!(
                "--module must be greater than zero, in mm, not {module:?}"
            ))
        }
        error @ NotFound::NoAxis { .. } => Failure::Usage(error.to_string()),
        error => requested.source.refused(&error),
    }
}

/// Axes tried for a path that is followed exactly.
fn map(requested: &Request, found: &Found) -> Option<AxisMap> {
    let is_as_given = !requested.points.is_empty() && requested.design.bands().is_none();
    is_as_given.then(|| {
        let path = found.chain.path();
        let tried = || AxisMap::new(path, requested.design.axes(path));
        found.map.clone().unwrap_or_else(tried)
    })
}

/// Source of the path or the poses.
fn source(command: &Reverse) -> Result<Source, Failure> {
    let path = command.path.as_deref().unwrap_or(Path::new("-"));
    Source::open_up_to(path, RequiredPath::LARGEST)
}

fn chosen(
    arms: u32,
    bend: f64,
    found: &Found,
    split: &Split,
    made: &ReversedMachine,
    out: &mut impl Write,
) -> std::io::Result<()> {
    let (chain, why) = (&found.chain, &found.why);
    let axis = chain.axis();
    let at = format!("{:.4}, {:.4} mm, {why}", axis.x, axis.y);
    line(out, "axis of the carrier", &at)?;
    for (name, words) in words::bars(chain) {
        line(out, name, &words)?;
    }
    let (name, words) = words::minimum_radius(made);
    line(out, name, &words)?;
    let shaft = Unit::Millimetre.with_unit(chain.shaft_distance());
    line(out, "tip to shaft, minimum", &shaft)?;
    let words = format!(
        "{}, bend {bend} deg, {arms} {}",
        split.kind().name(),
        if arms == 1 { "arm" } else { "arms" }
    );
    line(out, "split", &words)
}

fn gears(made: &ReversedMachine, out: &mut impl Write) -> std::io::Result<()> {
    for (name, radii) in made.design.pairs.keys().zip(&made.minimum_radii) {
        minimum_radii(out, name, *radii)?;
    }
    let (name, words) = words::tip_error(made);
    line(out, name, &words)
}

/// Prints the minimum convex radii of a pair's pitch curves.
pub(crate) fn minimum_radii(
    out: &mut impl Write,
    pair: &str,
    radii: [f64; 2],
) -> std::io::Result<()> {
    let (name, words) = words::minimum_radii(pair, radii);
    line(out, &name, &words)
}

/// Prints how many of the axes tried are possible.
fn possible(map: &AxisMap, out: &mut impl Write) -> std::io::Result<()> {
    let (all, possible) = (map.found().len(), map.possible());
    let inside = map.found().iter().flatten();
    let inside = inside.filter(|axis| axis.carrier > axis.arm).count();
    let words = format!(
        "{possible} of {all} tried: {inside} inside the path, {} outside",
        possible - inside
    );
    line(out, "possible axes", &words)
}

pub(crate) fn teeth(found: &[SoundTeeth], out: &mut impl Write) -> std::io::Result<()> {
    lines(found.iter().map(words::teeth), out)
}
