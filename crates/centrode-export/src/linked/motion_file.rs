use schemars::JsonSchema;
use serde::Serialize;

/// The contents of `motion.json`: how `motion.csv` and the simulator models are read.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub struct MotionFile {
    /// `centrode-motion`.
    pub format: &'static str,
    /// Version of this description: 1.
    pub version: u32,
    /// Name of the table.
    pub table: &'static str,
    /// Names of the simulator models, where they are exported.
    pub models: [String; 2],
    /// The turning shaft that drives the machine.
    pub input: InputWords,
    /// Columns of the table, in order.
    pub columns: Vec<ColumnWords>,
    /// Number of rows: equal steps of the input over one period, its end among them.
    pub rows: usize,
    /// How to read between rows: by cubics through values and rates, or by straight lines.
    pub interpolation: Interpolation,
    /// Joints of the models that move.
    pub joints: Vec<JointWords>,
    /// Points whose positions are in the table.
    pub points: Vec<PointWords>,
    /// Links that touch by their teeth.
    pub meshes: Vec<MeshWords>,
    /// Loops that are open in URDF and closed by constraints in MJCF.
    pub closures: Vec<ClosureWords>,
}

/// The input as `motion.json` has it.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub struct InputWords {
    /// The link or shaft that turns.
    pub name: String,
    /// Its column.
    pub column: String,
    /// Angle after which the table repeats, rad.
    pub period_rad: f64,
    /// Speed of the design, rad/s; 1 if the design gives none.
    pub speed_rad_per_s: f64,
    /// The joint that drives all others.
    pub joint: Option<String>,
}

/// A column as `motion.json` has it.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub struct ColumnWords {
    /// Heading.
    pub name: String,
    /// Unit.
    pub unit: String,
    /// Meaning.
    pub meaning: String,
    /// Growth over one period.
    pub advance: f64,
}

/// How `motion.csv` is read between rows.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub struct Interpolation {
    /// `cubic Hermite`: by the values and rates of two rows.
    pub kind: &'static str,
    /// Maximum deviation of a link from its path if the table is interpolated by straight lines instead, mm.
    pub linear_error_max_mm: f64,
}

/// A joint as `motion.json` has it: position = factor x column + offset, in rad or m, as the models count.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub struct JointWords {
    /// Name in the models.
    pub name: String,
    /// Column of its position.
    pub column: String,
    /// Factor from the column to the joint.
    pub factor: f64,
    /// Offset: the joint is zero where the cycle begins.
    pub offset: f64,
    /// Column of its rate; `None` for a joint that moves evenly.
    pub rate: Option<String>,
    /// Factor from that column to the joint's rate by the input, rad/rad or m/rad.
    pub rate_factor: f64,
    /// The straight line nearest to its law.
    pub linear: LinearWords,
    /// The joint whose position determines the position of this one through a cam or groove; `None` if the input does.
    pub leader: Option<String>,
    /// Column of the torque that resists this joint, N mm; `None` if the table has none.
    pub load: Option<String>,
}

/// The straight line nearest to a joint's law: multiplier x input + offset.
#[derive(Clone, Copy, Debug, JsonSchema, PartialEq, Serialize)]
pub struct LinearWords {
    /// Slope by the input, rad/rad or m/rad.
    pub multiplier: f64,
    /// Offset, rad or m.
    pub offset: f64,
    /// Maximum distance of the law from it, rad or m.
    pub error_max: f64,
}

/// A point as `motion.json` has it.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub struct PointWords {
    /// Name.
    pub name: String,
    /// The link it is fixed to.
    pub link: String,
    /// Position in the link's frame, mm.
    pub at_mm: [f64; 3],
    /// Columns of its position in the frame of the first link, x and y or x, y and z.
    pub columns: Vec<String>,
}

/// A mesh of gears as `motion.json` has it.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub struct MeshWords {
    /// Driving and driven link.
    pub links: [String; 2],
    /// The joint that the teeth move.
    pub joint: String,
    /// Number of the copy of a chain that it belongs to.
    pub copy: usize,
}

/// A loop's closure as `motion.json` has it.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub struct ClosureWords {
    /// The two links that are pinned to each other.
    pub links: [String; 2],
    /// Position of the pin in the first one's frame, mm.
    pub at_mm: [f64; 3],
    /// The joints that it moves.
    pub joints: Vec<String>,
}
