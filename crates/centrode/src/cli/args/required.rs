//! Commands that start from what is required.

use std::path::PathBuf;

use clap::Args;
use clap::builder::PossibleValuesParser;

use centrode_synthesis::reverse::{Aim, SplitKind};

#[derive(Debug, Args)]
#[command(
    after_help = "Example: centrode reverse path.csv --axis 260,160 --bend 40 --arms 3 -o arms.toml\n\nThe path is closed: a point a line, x and y in mm, in the order in which the tip passes them. A design file of family path holds it with all other requirements: bounds on the bars, directions, shapes not to enter (centrode reverse --template prints one). With --poses: centrode reverse poses.csv --poses -o arms.toml\n\nExit status: 0 good; 1 a requirement is out of reach; 2 no machine, a bad path, or the file cannot be written."
)]
pub(crate) struct Reverse {
    /// File of the path: CSV (x, y in mm), SVG (its one path) or a design file of family path; or - for standard input
    #[arg(required_unless_present = "template")]
    pub(crate) path: Option<PathBuf>,
    /// Print a commented design file of family path, to start from
    #[arg(long, exclusive = true)]
    pub(crate) template: bool,
    /// Maximum distance of the machine's path from a drawn one, of an SVG file, mm; default: 0.01
    #[arg(long, allow_negative_numbers = true, value_name = "MM")]
    pub(crate) within: Option<f64>,
    /// Where something is free, make the most of it: the largest teeth, the ratio nearest to 1, or the minimum reach of the
    /// tip; default: the largest teeth where the path is eased or more is required of the machine, else the gentlest ratio
    #[arg(long, conflicts_with = "poses", value_parser = PossibleValuesParser::new(Aim::ALL.map(Aim::name)))]
    pub(crate) aim: Option<String>,
    /// Axis of the carrier, mm; by default it is searched on and about the path: the gentlest, or the best by --aim
    #[arg(long, value_parser = place, allow_hyphen_values = true, value_name = "X,Y")]
    pub(crate) axis: Option<[f64; 2]>,
    /// Box in which the axis is searched, by two corners, mm; default: the path's box with a quarter of its size round it
    #[arg(long, value_parser = corners, allow_hyphen_values = true, value_name = "X,Y,X,Y", conflicts_with_all = ["axis", "poses"])]
    pub(crate) axis_box: Option<[[f64; 2]; 2]>,
    /// Let the path pass within this distance of its points, mm, and ease it there until its gears are as blunt as can be; a column headed
    /// `tolerance` in the file gives each point its own
    #[arg(
        long,
        allow_negative_numbers = true,
        value_name = "MM",
        conflicts_with = "poses"
    )]
    pub(crate) band: Option<f64>,
    /// The points are the control points of a closed cubic B-spline, which need not pass them
    #[arg(long, conflicts_with_all = ["poses", "open"])]
    pub(crate) control: bool,
    /// The points are the working part alone: the return from the last to the first is free, and searched for blunt gears
    #[arg(long, conflicts_with = "poses")]
    pub(crate) open: bool,
    /// Ease the path no more than full teeth of this module need
    #[arg(
        long,
        allow_negative_numbers = true,
        value_name = "MM",
        conflicts_with = "poses"
    )]
    pub(crate) module: Option<f64>,
    /// The file holds 3 to 7 key poses, x and y in mm and the clamp's direction in degrees, that the arm meets in order; the path
    /// between them is free
    #[arg(long, conflicts_with_all = ["axis", "crossing", "within"])]
    pub(crate) poses: bool,
    /// Make a three-arm transplanting mechanism that takes the key poses, picks in the first, plants in the last and reaches
    /// its goals with sound full teeth: bend and law of its gears are searched
    #[arg(long, requires = "poses", conflicts_with_all = ["split", "bend", "steps"])]
    pub(crate) three_arm: bool,
    /// Folder for the files of the three-arm mechanism, as `centrode export` writes them
    #[arg(long, requires_all = ["three_arm", "output"], value_name = "DIR")]
    pub(crate) to: Option<PathBuf>,
    /// How two stages of gears share the motion; default: powers
    #[arg(long, value_parser = PossibleValuesParser::new(SplitKind::ALL.map(SplitKind::name)))]
    pub(crate) split: Option<String>,
    /// Angle from the carrier's first leg, to the intermediate gear, to its second, degrees; default: 60
    #[arg(long, allow_negative_numbers = true, value_name = "DEG")]
    pub(crate) bend: Option<f64>,
    /// Number of arms; default: 1
    #[arg(long, allow_negative_numbers = true, value_parser = clap::value_parser!(u32).range(1..=12))]
    pub(crate) arms: Option<u32>,
    /// Steps of the tables in which the laws of the gears are written; default: as few as bring the tip within 1e-7 of its
    /// maximum distance from the axis
    #[arg(long, allow_negative_numbers = true, value_name = "N")]
    pub(crate) steps: Option<u32>,
    /// Take a path that crosses itself, too
    #[arg(long)]
    pub(crate) crossing: bool,
    /// Design file to write; default: nothing is written and no teeth are searched
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
}

#[derive(Debug, Args)]
#[command(
    after_help = "Example: centrode drive slider.toml --body crank --center-distance 130 -o press.toml\n\nThe design is of family machine, its crank turned by law = { ratio = 1 }. Goals over = \"deviation\" with uniform say where the output goes evenly, goals over = \"span\" with maximum where it rests.\n\nExit status: 0 good; 2 no gears, a bad design, or the file cannot be written."
)]
pub(crate) struct Drive {
    /// Design file, or - for standard input
    pub(crate) design: PathBuf,
    /// Body that turns evenly: the crank
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
        _ => Err("not two numbers of millimetres, as in 260,160".into()),
    }
}

/// Reads two corners of a box.
fn corners(word: &str) -> Result<[[f64; 2]; 2], String> {
    match numbers(word)[..] {
        [Some(x), Some(y), Some(u), Some(v)] if x != u && y != v => Ok([[x, y], [u, v]]),
        _ => Err(
            "not x and y of two corners that differ in both, in millimetres, as in -100,-50,350,400"
                .into(),
        ),
    }
}

fn numbers(word: &str) -> Vec<Option<f64>> {
    let number = |word: &str| word.trim().parse::<f64>().ok().filter(|x| x.is_finite());
    word.split(',').map(number).collect()
}
