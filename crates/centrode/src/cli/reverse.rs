pub(crate) mod asked;
mod found;
mod posed;
pub(crate) mod words;

use std::io::Write;
use std::path::Path;

use crate::analysis::{SoundTeeth, Unit, with_sound_teeth};
use crate::mechanism::design::{Design as _, DesignSpec as _};
use crate::mechanism::gear::design::Addendum;
use crate::mechanism::reverse::{
    AxisMap, PathDesign, ReversedMachine, Split, SplitKind, TwoBar, WantedPath,
};

use crate::cli::Status;
use crate::cli::args::Reverse;
use crate::cli::failure::Failure;
use crate::cli::input::Source;
use crate::cli::output;
use crate::cli::progress::Progress;

use asked::Asked;
use found::Found;

/// Width of the names of figures.
const NAME: usize = 24;

/// Makes a machine from a path, prints what was chosen and writes its design.
pub(crate) fn run(command: &Reverse, out: &mut impl Write) -> Result<Status, Failure> {
    if command.template {
        out.write_all(PathDesign::TEMPLATE.as_bytes())?;
        return Ok(Status::Good);
    }
    if command.three_arm {
        return posed::run(command, out);
    }
    let progress = Progress::new(4);
    let (asked, found) = match command.poses {
        true => {
            let source = source(command)?;
            let found = Found::by_poses(&source, &progress)?;
            (Asked::of_poses(source, command)?, found)
        }
        false => {
            let asked = Asked::read(command)?;
            let found = Found::by_path(command, &asked, &progress)?;
            (asked, found)
        }
    };
    if let Some(output) = &command.output {
        asked.source.keep(output, "the path")?;
    }
    let design = &asked.design;
    let (chain, kind, bend) = (&found.chain, design.split, design.bend);
    let bend_deg = asked.bend_deg(command);
    progress.step("splitting the motion");
    let split = Split::new(chain, kind, bend)
        .map_err(|error| Failure::Usage(format!("--bend {bend_deg}: {error}")))?;
    progress.step("rolling the pitch curves");
    let made = ReversedMachine::new(chain, &split, design.arms, design.steps);
    let made = made.map_err(|error| Failure::Files(Box::new(error)))?;
    let mut made = made.with_obstacles(&design.wishes.keep_out);
    made.design.name.clone_from(&design.name);
    if !design.title.is_empty() {
        made.design.title.clone_from(&design.title);
    }
    progress.step("looking for sound teeth");
    let toothed = command
        .output
        .as_ref()
        .map(|_| with_sound_teeth(&made.design, |_| true));
    drop(progress);
    for (name, words) in &found.told {
        line(out, name, words)?;
    }
    chosen((design.arms, bend_deg), &found, &split, out)?;
    gears(&made, out)?;
    if let Some(map) = &found.map {
        possible(map, out)?;
    }
    others(chain, kind, bend, out)?;
    let (Some(output), Some(toothed)) = (&command.output, toothed) else {
        return Ok(Status::new(found.is_reached));
    };
    // What was found is told even where there are no teeth.
    out.flush()?;
    let (design, sound) = toothed.map_err(|error| Failure::Files(Box::new(error)))?;
    teeth(&sound, out)?;
    let text = design.to_toml();
    let text = text.map_err(|error| Failure::Files(Box::new(error)))?;
    writeln!(out)?;
    output::write_one(output, text.into_bytes(), out)?;
    Ok(Status::new(found.is_reached))
}

pub(crate) fn line(out: &mut impl Write, name: &str, words: &str) -> std::io::Result<()> {
    writeln!(out, "{name:NAME$}{words}")
}

/// Source of the path or the poses.
fn source(command: &Reverse) -> Result<Source, Failure> {
    let path = command.path.as_deref().unwrap_or(Path::new("-"));
    Source::open_up_to(path, WantedPath::LARGEST)
}

fn chosen(
    (arms, bend): (u32, f64),
    found: &Found,
    split: &Split,
    out: &mut impl Write,
) -> std::io::Result<()> {
    let (chain, why) = (&found.chain, &found.why);
    let axis = chain.axis();
    let at = format!("{:.4}, {:.4} mm, {why}", axis.x, axis.y);
    line(out, "axis of the carrier", &at)?;
    for (name, words) in words::bars(chain) {
        line(out, name, &words)?;
    }
    let (name, words) = words::least_radius(chain, split.bend());
    line(out, name, &words)?;
    let shaft = Unit::Millimetre.tell(chain.shaft_distance());
    line(out, "tip passes the shaft at", &shaft)?;
    let words = format!(
        "{}, bend {bend} deg, {arms} {}",
        split.kind().name(),
        if arms == 1 { "arm" } else { "arms" }
    );
    line(out, "split", &words)
}

fn gears(made: &ReversedMachine, out: &mut impl Write) -> std::io::Result<()> {
    for (name, radii) in made.design.pairs.keys().zip(&made.least_radii) {
        least_radii(out, name, *radii)?;
    }
    let (name, words) = words::tip_error(made);
    line(out, name, &words)
}

/// Prints the least convex radii of a pair's pitch curves.
pub(crate) fn least_radii(
    out: &mut impl Write,
    pair: &str,
    radii: [f64; 2],
) -> std::io::Result<()> {
    let (name, words) = words::least_radii(pair, radii);
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

/// Prints what the splits that were not chosen would be.
fn others(chain: &TwoBar, kind: SplitKind, bend: f64, out: &mut impl Write) -> std::io::Result<()> {
    for (name, other) in SplitKind::NAMES {
        if other == kind {
            continue;
        }
        let words = match Split::new(chain, other, bend) {
            Ok(split) => sharpest(chain, &split),
            Err(error) => error.to_string(),
        };
        line(out, &format!("split {name}"), &words)?;
    }
    Ok(())
}

/// The sharpest pitch curve of a split that was not chosen.
pub(crate) fn sharpest(chain: &TwoBar, split: &Split) -> String {
    match ReversedMachine::new(chain, split, 1, None) {
        Ok(made) => {
            let radii = made.least_radii.iter().flatten();
            let least = radii.fold(f64::INFINITY, |least, radius| least.min(*radius));
            format!(
                "possible, least convex radius {}",
                Unit::Millimetre.tell(least)
            )
        }
        Err(error) => error.to_string(),
    }
}

pub(crate) fn teeth(found: &[SoundTeeth], out: &mut impl Write) -> std::io::Result<()> {
    for teeth in found {
        let kind = match teeth.addendum {
            Addendum::Full => "full",
            Addendum::Fitted => "fitted",
        };
        let full = match teeth.addendum {
            Addendum::Full => String::new(),
            Addendum::Fitted => {
                let module = Unit::Millimetre.tell(teeth.full_module);
                format!("; full ones are undercut above {module}")
            }
        };
        let words = format!(
            "{} {kind} teeth, module {}{full}",
            teeth.tooth_count,
            Unit::Millimetre.tell(teeth.module)
        );
        line(out, &format!("teeth of {}", teeth.pair), &words)?;
    }
    Ok(())
}
