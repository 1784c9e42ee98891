use crate::analysis::Report;
use crate::cli::args::{Dxf, Export, File};
use crate::cli::failure::Failure;
use crate::cli::input::Source;
use crate::cli::progress::Progress;
use crate::cli::{Status, output, report, sheet};
use crate::export::{ExportError, Layers, Options, SheetOptions};
use crate::family::{Family, Mechanism, PartName};
use crate::formats::{Bundle, Format, dxf};
use crate::geometry::Tolerance;
use crate::page::words::summary;
use std::{io::Write, sync::Arc};

/// Resolves a design, checks it and writes its files.
pub(crate) fn run(command: &Export, out: &mut impl Write) -> Result<Status, Failure> {
    refuse_useless(command)?;
    let source = Source::open_design(&command.design)?;
    let design = source.design()?;
    let progress = Progress::new(4);
    progress.step("resolving the design");
    let mechanism = cut(
        design.mechanism().map_err(|error| source.blame(error))?,
        command,
    );
    progress.step("checking");
    let found = mechanism.check();
    progress.step("drawing");
    let bundle = bundle(design.family(), mechanism.as_ref(), &found, command)?;
    progress.step("writing");
    let written = output::write(|| bundle.export_to(&command.to, command.force))?;
    drop(progress);
    for path in &written {
        writeln!(out, "{}", path.display())?;
    }
    out.flush()?;
    summarise(&found, written.len(), command);
    Ok(Status::new(found.ok()))
}

/// The files of a design text in one archive: those of a command, and the page as one file.
pub(crate) fn zip(text: &str, command: Option<&Export>, page: bool) -> Result<Vec<u8>, Failure> {
    let source = Source::of_text(text);
    let design = source.design()?;
    let mut files = Bundle::default();
    if let Some(command) = command {
        refuse_useless(command)?;
        let mechanism = cut(
            design.mechanism().map_err(|error| source.blame(error))?,
            command,
        );
        let found = mechanism.check();
        files = bundle(design.family(), mechanism.as_ref(), &found, command)?;
    }
    if page {
        let (html, _) = sheet::page(&source, &design)?;
        files.add("report.html", html.into_bytes())?;
    }
    Ok(files.zip()?)
}

/// Parts of a design whose files can be requested alone: name and description of each.
pub(crate) fn parts(mechanism: &dyn Mechanism, family: &Family) -> Vec<[String; 2]> {
    let mut options = Options::new(Tolerance::MICROMETRE);
    // For an unknown part the exporter makes no file and lists the known parts.
    options.parts = Some(vec![String::new()]);
    let Err(ExportError::UnknownPart { known, .. }) = mechanism.files(&Format::ALL, &options)
    else {
        return Vec::new();
    };
    let about = |name: &str| {
        let part = family.parts.iter().find(|part| part.name == name);
        part.map_or_else(String::new, |part| part.about.to_owned())
    };
    let words = |name: String| [name.clone(), about(&name)];
    known.into_iter().map(words).collect()
}

/// The mechanism with the kerf of the command.
fn cut(mechanism: Arc<dyn Mechanism>, command: &Export) -> Arc<dyn Mechanism> {
    let changed = command.kerf.and_then(|kerf| mechanism.with_kerf(kerf));
    changed.unwrap_or(mechanism)
}

/// The files of a mechanism and its report.
fn bundle(
    family: &Family,
    mechanism: &dyn Mechanism,
    found: &Report,
    command: &Export,
) -> Result<Bundle, Failure> {
    let known: Vec<&str> = family.parts.iter().map(|part| part.name).collect();
    let mut requested = command.part.iter();
    // Unknown parts that the design names are reported when it is drawn.
    if !known.is_empty()
        && let Some(lost) = requested.find(|part| !known.contains(&part.as_str()))
    {
        let (noun, known) = (family.noun, known.join(", "));
        let message = format!("{noun} has no part named {lost}; there are {known}");
        return Err(Failure::Usage(message));
    }
    let (formats, options) = (command.formats(), options(command, found));
    let mut bundle = mechanism.files(&formats, &options)?;
    if command.wants(File::Json) {
        bundle.add(
            "report.json",
            report::json(found, mechanism.design())?.into_bytes(),
        )?;
    }
    if bundle.files().next().is_none() {
        let parts = match &command.part[..] {
            [] => String::new(),
            parts => format!(" of {}", parts.join(", ")),
        };
        let message =
            format!("nothing to write: there are no files{parts} in the requested formats");
        return Err(Failure::Usage(message));
    }
    Ok(bundle)
}

/// Writes a line on standard error: the number of files written, and a summary of the findings.
fn summarise(found: &crate::analysis::Report, files: usize, command: &Export) {
    let mut err = anstream::stderr();
    let summary = summary(found);
    let design = command.design.display();
    // A closed standard error is not a failure.
    let _ = if found.ok() {
        writeln!(err, "{files} files written; {summary}")
    } else {
        writeln!(
            err,
            "{files} files written; the check found {summary}; see centrode check {design}"
        )
    };
}

/// Refuses options that have no effect on any of the files requested.
fn refuse_useless(command: &Export) -> Result<(), Failure> {
    let sheets = command.wants(File::Sheet) || command.wants(File::Pdf);
    let refused = |option: &str, files: &str| {
        let message = format!("{option} is only for {files}, and none is requested");
        Err(Failure::Usage(message))
    };
    if command.sheet.is_some() && !sheets {
        return refused("--sheet", "the formats sheet and pdf");
    }
    if command.projection.is_some() && !sheets {
        return refused("--projection", "the formats sheet and pdf");
    }
    let cut = command.wants(File::Dxf) || command.wants(File::Svg);
    if command.layers == Layers::All && !cut {
        return refused("--layers", "the formats dxf and svg");
    }
    if command.kerf.is_some() && !cut {
        return refused("--kerf", "the formats dxf and svg");
    }
    let drawn = [File::Dxf, File::Svg, File::Sheet, File::Pdf];
    let solid = [File::Stl, File::Step, File::ThreeMf, File::Csv];
    let any = |files: &[File]| files.iter().any(|file| command.wants(*file));
    if command.part.is_empty() || any(&drawn) {
        return Ok(());
    }
    if command.part == [PartName::ASSEMBLY.name] && !command.wants(File::ThreeMf) {
        let files = "drawings and the assembly: dxf, svg, sheet, pdf and 3mf";
        return refused("--part assembly", files);
    }
    if !any(&solid) {
        return refused("--part", "drawings, solids and tables");
    }
    Ok(())
}

fn options(command: &Export, found: &Report) -> Options {
    let mut options = Options::new(command.tolerance());
    match command.dxf {
        Dxf::R2010 => {}
        Dxf::R12 => options.dxf_version = dxf::Version::R12,
        Dxf::Spline => options.dxf_curves = dxf::Curves::Splines,
        Dxf::Chords => options.dxf_curves = dxf::Curves::Chords,
    }
    options.layers = command.layers;
    options.kerf = command.kerf;
    if !command.part.is_empty() {
        options.parts = Some(command.part.clone());
    }
    options.sheet = SheetOptions {
        size: command.sheet,
        projection: command.projection,
        found: crate::sheet_data(found),
    };
    options
}
