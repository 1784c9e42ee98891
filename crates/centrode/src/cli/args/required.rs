//! Commands that start from what is required.

use std::path::PathBuf;

use clap::Args;
use clap::builder::PossibleValuesParser;

use centrode_synthesis::reverse::{Aim, SplitKind};

#[derive(Debug, Args)]
#[command(
    after_help = "Example: centrode reverse path.csv --axis 260,160 --bend 40 --arms 3 -o arms.toml\n\nThe path is a closed curve: one point per line, x and y in mm, in the order in which the tip passes them. A design file of family path also contains the other requirements: bounds on the bar lengths, directions, shapes not to enter (centrode reverse --template prints one).\n\nExample with key poses: centrode reverse poses.csv --poses -o arms.toml\n\nExit status: 0 success; 1 a requirement is not met, or the machine has an error; 2 impossible machine, invalid path, or the file cannot be written."
)]
pub(crate) struct Reverse {
    /// File of the path: CSV (x, y in mm), SVG (its one path) or a design file of family path; or - for standard input
    #[arg(required_unless_present = "template")]
    pub(crate) path: Option<PathBuf>,
    /// Print a commented design file of family path, to start from
    #[arg(long, exclusive = true)]
    pub(crate) template: bool,
    /// For an SVG file: maximum distance of the machine's path from the drawn one, mm; default: 0.01
    #[arg(long, allow_negative_numbers = true, value_name = "MM")]
    pub(crate) within: Option<f64>,
    /// Objective for what is free: the largest teeth, the ratio nearest to 1, or the minimum reach of the tip; default: the
    /// largest teeth if the path is eased (see --band) or has other requirements, otherwise the ratio nearest to 1
    #[arg(long, conflicts_with = "poses", value_parser = PossibleValuesParser::new(Aim::ALL.map(Aim::name)))]
    pub(crate) aim: Option<String>,
    /// Axis of the carrier, mm; default: the axis on or around the path that is best for --aim
    #[arg(long, value_parser = place, allow_hyphen_values = true, value_name = "X,Y")]
    pub(crate) axis: Option<[f64; 2]>,
    /// Two opposite corners of the box in which the axis is searched, mm; default: a box around the path with a margin of a
    /// quarter of the path's size
    #[arg(long, value_parser = corners, allow_hyphen_values = true, value_name = "X,Y,X,Y", conflicts_with_all = ["axis", "poses"])]
    pub(crate) axis_box: Option<[[f64; 2]; 2]>,
    /// Ease the path: change it within this distance of its points, mm, so that the curvature of its gears becomes minimum; a
    /// column headed `tolerance` in the file gives each point its own distance
    #[arg(
        long,
        allow_negative_numbers = true,
        value_name = "MM",
        conflicts_with = "poses"
    )]
    pub(crate) band: Option<f64>,
    /// The points are the control points of a closed cubic B-spline; the path need not pass through them
    #[arg(long, conflicts_with_all = ["poses", "open"])]
    pub(crate) control: bool,
    /// The points are only the working part of the path; the return from the last to the first is free, and is searched for
    /// gently curved gears
    #[arg(long, conflicts_with = "poses")]
    pub(crate) open: bool,
    /// Ease the path no more than full-height teeth of this module need
    #[arg(
        long,
        allow_negative_numbers = true,
        value_name = "MM",
        conflicts_with = "poses"
    )]
    pub(crate) module: Option<f64>,
    /// The file contains 3 to 7 key poses, x and y in mm and the clamp's direction in degrees, through which the arm passes in
    /// order; the path between them is free
    #[arg(long, conflicts_with_all = ["axis", "crossing", "within"])]
    pub(crate) poses: bool,
    /// Make a three-arm transplanting mechanism that passes through the key poses, picks in the first, plants in the last and
    /// reaches its goals with sound full-height teeth; the bend and the law of its gears are searched
    #[arg(long, requires = "poses", conflicts_with_all = ["split", "bend", "steps"])]
    pub(crate) three_arm: bool,
    /// Folder for the files of the three-arm mechanism, as `centrode export` writes them
    #[arg(long, requires_all = ["three_arm", "output"], value_name = "DIR")]
    pub(crate) to: Option<PathBuf>,
    /// How the two gear stages share the motion; default: powers
    #[arg(long, value_parser = PossibleValuesParser::new(SplitKind::ALL.map(SplitKind::name)))]
    pub(crate) split: Option<String>,
    /// Angle from the carrier's first leg, to the intermediate gear, to its second, degrees; default: 60
    #[arg(long, allow_negative_numbers = true, value_name = "DEG")]
    pub(crate) bend: Option<f64>,
    /// Number of arms; default: 1
    #[arg(long, allow_negative_numbers = true, value_parser = clap::value_parser!(u32).range(1..=12))]
    pub(crate) arms: Option<u32>,
    /// Number of steps of the tables for the laws of the gears; default: the minimum with which the error of the tip is within
    /// 1e-7 of its maximum distance from the axis
    #[arg(long, allow_negative_numbers = true, value_name = "N")]
    pub(crate) steps: Option<u32>,
    /// Also accept a path that crosses itself
    #[arg(long)]
    pub(crate) crossing: bool,
    /// Design file to write; default: nothing is written and no teeth are searched
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
}

#[derive(Debug, Args)]
#[command(
    after_help = "Example: centrode drive slider.toml --body crank --center-distance 130 -o press.toml\n\nThe design must be of family machine, with a crank that turns by law = { ratio = 1 }. Goals with over = \"deviation\" and uniform define where the output moves uniformly. Goals with over = \"span\" and maximum define where it rests.\n\nExit status: 0 success; 2 no gears found, invalid design, or the file cannot be written."
)]
pub(crate) struct Drive {
    /// Design file, or - for standard input
    pub(crate) design: PathBuf,
    /// Name of the crank, the body that turns uniformly
    #[arg(long, value_name = "NAME", default_value = "crank")]
    pub(crate) body: String,
    /// Distance of the new shaft from the crank's axis, mm
    #[arg(long, allow_negative_numbers = true, value_name = "MM")]
    pub(crate) center_distance: f64,
    /// Direction from the crank's axis to the new shaft, degrees
    #[arg(
        long,
        default_value_t = 180.0,
        allow_negative_numbers = true,
        value_name = "DEG"
    )]
    pub(crate) direction: f64,
    /// Design file to write; default: nothing is written and no teeth are searched
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
}

/// Reads a position in the plane.
fn place(word: &str) -> Result<[f64; 2], String> {
    match numbers(word)[..] {
        [Some(x), Some(y)] => Ok([x, y]),
        _ => Err("must be two numbers in millimetres, such as 260,160".into()),
    }
}

/// Reads two corners of a box.
fn corners(word: &str) -> Result<[[f64; 2]; 2], String> {
    match numbers(word)[..] {
        [Some(x), Some(y), Some(u), Some(v)] if x != u && y != v => Ok([[x, y], [u, v]]),
        _ => Err(
            "must be x and y of two corners that differ in both, in millimetres, such as -100,-50,350,400"
                .into(),
        ),
    }
}

fn numbers(word: &str) -> Vec<Option<f64>> {
    let number = |word: &str| word.trim().parse::<f64>().ok().filter(|x| x.is_finite());
    word.split(',').map(number).collect()
}
