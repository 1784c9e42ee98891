mod required;

use std::ffi::OsStr;
use std::path::PathBuf;

use crate::cli::shipped::SHIPPED;
use crate::export::Layers;
use crate::family::{Depth, FAMILIES, PartName};
use crate::formats::{Format, Purpose};
use crate::geometry::Tolerance;
use centrode_spec::{CutSpec, Projection, SheetSize};
use centrode_synthesis::optimise::Strategy;
use clap::builder::{
    NonEmptyStringValueParser, PossibleValue, PossibleValuesParser, TypedValueParser,
};
use clap::{Args, Parser, Subcommand, ValueEnum};

pub(crate) use required::{Drive, Reverse};

/// Finest tolerance that can be requested, mm: the rounding errors of the outlines are below it.
const FINEST: f64 = 1e-7;

/// Design, prove and export non-circular gears.
#[derive(Debug, Parser)]
#[command(
    name = "centrode",
    version,
    after_help = "Exit status: 0 success; 1 a finding of severity error; 2 impossible mechanism, invalid design file or wrong usage."
)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// List the families and shipped designs, or print one as a commented design file
    New(New),
    /// Resolve a design and report its figures and findings
    Check(Check),
    /// Write a design's drawings, solids, tables and simulator model
    Export(Export),
    /// Search for a design that reaches its goals
    Optimise(Optimise),
    /// Vary one parameter and print the results
    Response(Response),
    /// Design a machine whose tip follows a given path
    Reverse(Reverse),
    /// Design the gears that drive a machine's crank so that its output meets its goals
    Drive(Drive),
    /// Design in the browser, on a page that only this computer can open; Ctrl-C ends it
    Studio(Studio),
    /// Write a design's figures, curves and animation as one HTML file
    Report(Report),
    /// Write a certificate of the gear contact at every driver angle, for a separate proof checker
    Prove(Prove),
    /// Print the JSON schema of the design file, or of an exported file
    Schema(Schema),
    /// Print a completion script for a shell
    Completions(Completions),
    /// Print the man page of the program or of a command
    Man(Man),
}

#[derive(Debug, Args)]
#[command(after_help = "Examples: centrode new\n          centrode new gear-pair -o pair.toml")]
pub(crate) struct New {
    /// Family of mechanism, or shipped design [default: list all]
    #[arg(hide_possible_values = true, value_parser = PossibleValuesParser::new(
        FAMILIES.words().into_iter().chain(SHIPPED.map(|(name, _)| name))
    ))]
    pub(crate) name: Option<String>,
    /// Design file to write, instead of standard output; an existing file is not replaced
    #[arg(short, long, value_name = "FILE", requires = "name")]
    pub(crate) output: Option<PathBuf>,
}

#[derive(Debug, Args)]
#[command(
    after_help = "Exit status: 0 success; 1 a finding of severity error; 2 impossible mechanism or invalid design file."
)]
pub(crate) struct Check {
    /// Design file, or - for standard input
    pub(crate) design: PathBuf,
    /// Print the report as JSON
    #[arg(long)]
    pub(crate) json: bool,
    /// Instead of a check, list the figures that the goals of this design can name, with their values or their extremes over the cycle
    #[arg(long)]
    pub(crate) figures: bool,
    /// Print changed designs that fix the findings of the check; for gear pairs, designs with enough teeth that the
    /// flanks alone transmit the motion
    #[arg(long, conflicts_with = "figures")]
    pub(crate) remedy: bool,
}

#[derive(Debug, Args)]
#[command(
    after_help = "Example: centrode export pair.toml --to out --format dxf,json\n\nExit status: 0 success; 1 a finding of severity error (the files are still written); 2 impossible mechanism, invalid design file, or the files cannot be written."
)]
pub(crate) struct Export {
    /// Design file, or - for standard input
    pub(crate) design: PathBuf,
    /// Folder for the files, created if it does not exist
    #[arg(short = 'o', long = "to", visible_alias = "output", value_name = "DIR")]
    pub(crate) to: PathBuf,
    /// Also replace files in the folder that are not from an export, or that were changed since
    #[arg(long)]
    pub(crate) force: bool,
    /// File formats, separated by commas [default: dxf, svg, pdf, step, 3mf, json]
    #[arg(long, value_enum, value_delimiter = ',', value_name = "KINDS")]
    pub(crate) format: Vec<File>,
    /// File formats for the receiver of the files, instead of --format
    #[arg(long = "for", value_parser = by_word(Purpose::NAMES, about_purpose), value_name = "RECEIVER", conflicts_with = "format")]
    pub(crate) purpose: Option<Purpose>,
    /// Maximum deviation of the written curves and meshes from the exact ones, mm [default: 0.001; for print 0.01]
    #[arg(long, value_parser = tolerance, allow_negative_numbers = true, value_name = "MM")]
    pub(crate) tolerance: Option<Tolerance>,
    /// Release of the DXF files and type of their curves
    #[arg(long, value_enum, default_value_t = Dxf::R2010)]
    pub(crate) dxf: Dxf,
    /// Layers of the cutting files: only contour and holes, or all; the additional layers do not plot
    #[arg(long, value_parser = by_word(Layers::NAMES, about_layers), default_value = Layers::Cut.name())]
    pub(crate) layers: Layers,
    /// Width of the cut, mm: moves the contours of the cutting files outwards by half of it, and holes inwards [default:
    /// cut.kerf of the design, or 0]
    #[arg(long, value_parser = kerf, allow_negative_numbers = true, value_name = "MM")]
    pub(crate) kerf: Option<f64>,
    /// Parts to write files for, separated by commas: from this list, or as named in the design; default: all
    #[arg(long, value_parser = PartWord, value_delimiter = ',', value_name = "PARTS")]
    pub(crate) part: Vec<String>,
    /// Size of the drawing sheets; default: the design's, or the smallest on which the part fits
    #[arg(long, value_parser = by_word(SheetSize::NAMES, about_size), ignore_case = true, value_name = "SIZE")]
    pub(crate) sheet: Option<SheetSize>,
    /// Projection method of the drawing sheets; default: as in the design
    #[arg(long, value_parser = by_word(Projection::NAMES, about_projection), value_name = "METHOD")]
    pub(crate) projection: Option<Projection>,
}

impl Export {
    /// Whether this kind of file is to be written.
    pub(crate) fn wants(&self, file: File) -> bool {
        let among = |formats: &[Format]| file.format().is_some_and(|one| formats.contains(&one));
        match (self.purpose, &self.format[..]) {
            (Some(purpose), _) => among(purpose.formats()),
            (None, []) => file == File::Json || among(&Format::USUAL),
            (None, named) => named.contains(&File::All) || named.contains(&file),
        }
    }

    /// Formats to be written, in their order.
    pub(crate) fn formats(&self) -> Vec<Format> {
        let files = File::value_variants().iter();
        let files = files.filter(|file| self.wants(**file));
        files.filter_map(|file| file.format()).collect()
    }

    /// Tolerance as given, or else as the receiver needs it.
    pub(crate) fn tolerance(&self) -> Tolerance {
        let needed = self
            .purpose
            .map_or(Tolerance::MICROMETRE, Purpose::tolerance);
        self.tolerance.unwrap_or(needed)
    }
}

/// A kind of file.
#[derive(Clone, Copy, Debug, Eq, PartialEq, ValueEnum)]
pub(crate) enum File {
    /// Cutting files of the parts, and a drawing of the assembly
    Dxf,
    /// Cutting files as SVG pictures
    Svg,
    /// Drawing sheets with dimensions and tables, as DXF and SVG
    Sheet,
    /// Drawing sheets as PDF
    Pdf,
    /// Solids as triangle meshes
    Stl,
    /// Exact solids for CAD
    Step,
    /// Solids as meshes with their unit, for 3D printing
    #[value(name = "3mf")]
    ThreeMf,
    /// Points of the outlines, measures over pins, and the motion
    Csv,
    /// URDF simulator model, with its solids and motion
    Urdf,
    /// Simulator model with one convex contact body per tooth, its solids, its motion and a script
    Mjcf,
    /// Report: every figure and finding
    Json,
    /// All formats
    All,
}

impl File {
    /// The format of a kind of file; `None` if the kind is not a format.
    fn format(self) -> Option<Format> {
        Format::named(self.to_possible_value()?.get_name())
    }
}

/// Parser of the name of a part: a machine may have parts that are not listed.
#[derive(Clone, Copy)]
struct PartWord;

impl TypedValueParser for PartWord {
    type Value = String;

    fn parse_ref(
        &self,
        command: &clap::Command,
        argument: Option<&clap::Arg>,
        value: &OsStr,
    ) -> Result<String, clap::Error> {
        NonEmptyStringValueParser::new().parse_ref(command, argument, value)
    }

    /// The parts of every family; a part of several families is listed once, at the end.
    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        let parts = FAMILIES.0.iter().flat_map(|family| family.parts);
        let mut all: Vec<PartName> = Vec::new();
        for part in parts {
            all.retain(|other| other.name != part.name);
            all.push(*part);
        }
        let values = all.into_iter();
        let values = values.map(|part| PossibleValue::new(part.name).help(part.about));
        Some(Box::new(values))
    }
}

/// Parser of a value by its word, with a line of help for each.
fn by_word<T: Copy + Send + Sync + 'static, const N: usize>(
    named: [(&'static str, T); N],
    about: impl Fn(T) -> String,
) -> impl TypedValueParser<Value = T> {
    let values = named.map(|(word, one)| PossibleValue::new(word).help(about(one)));
    PossibleValuesParser::new(values).try_map(move |word| {
        let found = named
            .iter()
            .find(|(own, _)| own.eq_ignore_ascii_case(&word));
        found.map(|(_, one)| *one).ok_or("no such word")
    })
}

/// Width and height of a sheet, ISO 5457.
fn about_size(size: SheetSize) -> String {
    let [across, up] = size.size();
    format!("{across} x {up} mm")
}

fn about_projection(projection: Projection) -> String {
    let angle = match projection {
        Projection::FirstAngle => "First",
        Projection::ThirdAngle => "Third",
    };
    format!("{angle}-angle projection, ISO 5456-2")
}

fn about_layers(layers: Layers) -> String {
    match layers {
        Layers::Cut => "Contour and holes",
        Layers::All => "Also pitch curve, tip and root curves, and centre lines",
    }
    .to_owned()
}

/// Formats for a receiver of files.
fn about_purpose(purpose: Purpose) -> String {
    let formats: Vec<&str> = purpose.formats().iter().map(|one| one.name()).collect();
    formats.join(", ")
}

/// A flavour of DXF.
#[derive(Clone, Copy, Debug, Eq, PartialEq, ValueEnum)]
pub(crate) enum Dxf {
    /// Release 2010, lines and arcs
    R2010,
    /// Release 12, lines and arcs, for old controllers
    R12,
    /// Release 2010, splines
    Spline,
    /// Release 2010, straight lines within the tolerance, for programs that do not read arcs in polylines
    Chords,
}

pub(crate) fn tolerance(word: &str) -> Result<Tolerance, String> {
    let mm: f64 = word
        .parse()
        .map_err(|_| "must be a number in millimetres".to_owned())?;
    let tolerance = Tolerance::new(mm).map_err(|error| error.to_string())?;
    if mm < FINEST {
        return Err(format!("tolerance must be at least {FINEST} mm"));
    }
    Ok(tolerance)
}

fn kerf(word: &str) -> Result<f64, String> {
    let kerf = word
        .parse()
        .map_err(|_| "not a number of millimetres".to_owned())?;
    let checked = CutSpec { kerf }.validate();
    checked.map(|()| kerf).map_err(|error| error.to_string())
}

#[derive(Debug, Args)]
#[command(
    after_help = "Example: centrode optimise arms.toml --method de --seed 1 --evaluations 20000 -o better.toml\n\nA table of the design lists the parameters that may change and their bounds: [optimise] for a three-arm, [bounds] for a feeder, [vary] for every other family. Ctrl-C ends the search and saves the best design found. --resume continues the search stored next to the output. If no design within the bounds reaches the goals, the search prints the closest figures. --widen then writes the design with the minimum widening of the bounds.\n\nExit status: 0 every goal is reached; 1 some are not (the file is still written); 2 no search is possible, the design file is invalid, or the file cannot be written."
)]
pub(crate) struct Optimise {
    /// Design file, or - for standard input
    pub(crate) design: PathBuf,
    /// Search method; default: guided, or that of the resumed search
    #[arg(long, value_parser = PossibleValuesParser::new(Strategy::NAMES.map(|(name, _)| name)))]
    pub(crate) method: Option<String>,
    /// Random seed; one seed gives the same result on any number of cores; default: 1, or that of the resumed search
    #[arg(long)]
    pub(crate) seed: Option<u64>,
    /// Maximum number of evaluations; the current generation is finished; default: 20000, or that of the resumed search
    #[arg(long, value_parser = clap::value_parser!(u64).range(1..))]
    pub(crate) evaluations: Option<u64>,
    /// Points per generation; default: depends on the method and the number of parameters
    #[arg(long)]
    pub(crate) population: Option<usize>,
    /// Continue after the first design that meets everything, to improve the objective of [optimise]; not for guided
    #[arg(long)]
    pub(crate) polish: bool,
    /// File for the improved design: the text of the design file with new numbers, its comments unchanged
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: PathBuf,
    /// Continue the search stored next to the output
    #[arg(long)]
    pub(crate) resume: bool,
    /// Instead of a search, widen the bounds by the minimum with which all goals can be reached, if the family allows it
    #[arg(long, conflicts_with_all = ["method", "seed", "evaluations", "population", "polish", "resume"])]
    pub(crate) widen: bool,
    /// Print the result as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

impl Optimise {
    /// Name of the method of a new search.
    pub(crate) fn method(&self) -> &str {
        self.method.as_deref().unwrap_or("guided")
    }
}

#[derive(Debug, Args)]
#[command(
    after_help = "Example: centrode response arms.toml --parameter r1 --from 15 --to 27 --of trajectory-height"
)]
pub(crate) struct Response {
    /// Design file, or - for standard input
    pub(crate) design: PathBuf,
    /// Key of a number in the design file, such as `arm.tip_distance`, or the name of a parameter, such as r1
    #[arg(long, value_name = "KEY")]
    pub(crate) parameter: String,
    /// First value, in the file's unit
    #[arg(long, allow_negative_numbers = true)]
    pub(crate) from: f64,
    /// Last value
    #[arg(long, allow_negative_numbers = true)]
    pub(crate) to: f64,
    /// Number of values
    #[arg(long, default_value_t = 9, value_parser = clap::value_parser!(u16).range(2..=10_000))]
    pub(crate) count: u16,
    /// Goals or figures to print, separated by commas; default: the goals
    #[arg(long, value_delimiter = ',', value_name = "NAMES")]
    pub(crate) of: Vec<String>,
    /// Depth of the check at every value: motion alone, also teeth as made, or everything; default: the first with the figures
    /// of --of, or with goals or a figure that changes
    #[arg(long, value_parser = PossibleValuesParser::new(Depth::NAMES.map(|(name, _)| name)))]
    pub(crate) depth: Option<String>,
    /// Write every figure at every value to a CSV file, angles in radians
    #[arg(long, value_name = "FILE")]
    pub(crate) csv: Option<PathBuf>,
    /// Print values and figures as JSON
    #[arg(long, conflicts_with = "of")]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Schema {
    /// Family of mechanism, `path` for the file of `reverse`, or an exported file; default: the design file of all families
    #[arg(value_parser = PossibleValuesParser::new(FAMILIES.words().into_iter().chain(crate::cli::schema::FILES)))]
    pub(crate) family: Option<String>,
}

#[derive(Debug, Args)]
#[command(
    after_help = "Prints the address of the page. The page opens only with this secret address. Only the design file and its autosaves are written; from the start page, also the files opened or created there and their autosaves."
)]
pub(crate) struct Studio {
    /// Design file; default: a start page with all shipped designs, templates, and the files of the current folder
    pub(crate) design: Option<PathBuf>,
    /// Open the page in the browser
    #[arg(long)]
    pub(crate) open: bool,
    /// Port on this computer; 0 for any free port
    #[arg(long, default_value_t = 0)]
    pub(crate) port: u16,
}

#[derive(Debug, Args)]
#[command(
    after_help = "Example: centrode report pair.toml -o pair.html\n\nExit status: 0 success; 1 a finding of severity error (the file is still written); 2 impossible mechanism, invalid design file, or the file cannot be written."
)]
pub(crate) struct Report {
    /// Design file, or - for standard input
    pub(crate) design: PathBuf,
    /// HTML file
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: PathBuf,
}

#[derive(Debug, Args)]
#[command(
    after_help = "Examples: centrode prove pair.toml -o pair.proof\n          centrode prove machine.toml --pair drive -o drive.proof\n\nFor a machine with several pairs, one file per pair is written, with the name of the pair in its file name. A certificate is only a claim: python tools/proof_checker.py pair.proof proves or rejects it, from the contours and the law alone.\n\nExit status: 0 written; 2 invalid design, this mesh cannot be certified, or the file cannot be written."
)]
pub(crate) struct Prove {
    /// Design file, or - for standard input
    pub(crate) design: PathBuf,
    /// Pair of a machine; default: all of its pairs
    #[arg(long, value_name = "NAME")]
    pub(crate) pair: Option<String>,
    /// Certificate, a JSON file
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: PathBuf,
}

#[derive(Debug, Args)]
pub(crate) struct Completions {
    /// Shell for which the script is written
    #[arg(value_enum)]
    pub(crate) shell: clap_complete::Shell,
}

#[derive(Debug, Args)]
pub(crate) struct Man {
    /// Command to describe; default: the program
    pub(crate) command: Option<String>,
}
