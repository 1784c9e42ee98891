use std::io::Write;
use std::process::ExitCode;

use centrode::export::dxf;
use centrode::export::gear_pair::{self, Format, Options};

use crate::args::{Dxf, Export, File};
use crate::failure::Failure;
use crate::input::Source;
use crate::progress::Progress;
use crate::report;

/// Resolves a design, checks it and writes its files.
pub(crate) fn run(command: &Export, out: &mut impl Write) -> Result<ExitCode, Failure> {
    let source = Source::open(&command.design)?;
    let design = source.design()?;
    let progress = Progress::new(4);
    progress.step("cutting the teeth");
    let pair = design.gear_pair().map_err(|error| source.blame(error))?;
    progress.step("running the gears together");
    let found = centrode::analysis::check(&pair);
    progress.step("drawing");
    let mut bundle = gear_pair::files(&pair, &formats(command), &options(command))?;
    if command.wants(File::Json) {
        bundle.add("report.json", report::json(&found)?.into_bytes())?;
    }
    progress.step("writing");
    let written = bundle.write_to(&command.to)?;
    drop(progress);
    for path in &written {
        writeln!(out, "{}", path.display())?;
    }
    out.flush()?;
    tell(&found, written.len(), command);
    Ok(ExitCode::from(u8::from(!found.ok())))
}

/// A line on standard error: what was found, and that the files are there all the same.
fn tell(found: &centrode::analysis::Report, files: usize, command: &Export) {
    let mut err = anstream::stderr();
    let summary = report::summary(found);
    let design = command.design.display();
    // Nobody is left to tell when standard error is closed.
    let _ = if found.ok() {
        writeln!(err, "{files} files written; {summary}")
    } else {
        writeln!(
            err,
            "{files} files written, but the gears do not do their job: {summary}; see centrode check {design}"
        )
    };
}

fn formats(command: &Export) -> Vec<Format> {
    let pairs = [
        (File::Dxf, Format::Dxf),
        (File::Svg, Format::Svg),
        (File::Stl, Format::Stl),
        (File::Step, Format::Step),
        (File::ThreeMf, Format::ThreeMf),
        (File::Csv, Format::Csv),
        (File::Urdf, Format::Urdf),
        (File::Mjcf, Format::Mjcf),
    ];
    let wanted = pairs.into_iter().filter(|(file, _)| command.wants(*file));
    wanted.map(|(_, format)| format).collect()
}

fn options(command: &Export) -> Options {
    let mut options = Options::new(command.tolerance);
    match command.dxf {
        Dxf::R2010 => {}
        Dxf::R12 => options.dxf_version = dxf::Version::R12,
        Dxf::Spline => options.dxf_curves = dxf::Curves::Splines,
    }
    options
}
