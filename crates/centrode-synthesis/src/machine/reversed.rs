use std::collections::BTreeMap;
use std::f64::consts::PI;

use centrode_geometry::{Extreme, Point, Vector, maximum};
use thiserror::Error;

use crate::reverse::{KeepOut, Split, SplitKind, TwoBar, leg};
use centrode_gear::design::{Addendum, BodySpec, GearPairDesign};
use centrode_gear::pitch::{PitchSpec, Transmission};
use centrode_gear::{CurvatureRange, GearPairError, PlannedPair, Rolling};
use centrode_kinematics::machine::preferred_size;
use centrode_machines::machine::{
    GearRole, MachineBodySpec, MachineCircleSpec, MachineCopiesSpec, MachineCornerSpec,
    MachineDesign, MachineGearSpec, MachineGoalSpec, MachineLawSpec, MachineMeshSpec,
    MachineObstacleSpec,
};

/// Names of the pairs of a machine: of a single pair that occurs twice, or of two pairs.
const STAGE: &str = "stage";
const FIRST: &str = "first-stage";
const SECOND: &str = "second-stage";
/// Name of the copied chains.
const ARMS: &str = "arms";
/// Backlash along the normal, as a share of the centre distance.
const BACKLASH: f64 = 5e-4;
/// Width of a gear and diameter of its bore, as shares of the centre distance.
const WIDTH: f64 = 0.15;
const BORE: f64 = 0.06;
/// Thickness and width of a plate and diameter of its pins, as shares of the centre distance.
const PLATE: [f64; 3] = [0.07, 0.16, 0.06];
/// Numbers of equal steps of a law's table, tried in order; the last is used if none brings the tip near enough.
const STEPS: [u32; 6] = [90, 180, 360, 720, 1440, 2880];
/// Fewest and most steps of a table.
const RANGE: [u32; 2] = [12, 5000];
/// Accepted distance of the tip from the path, as a share of the maximum distance of the path from the axis.
const NEAR_ENOUGH: f64 = 1e-7;

/// A machine whose tip runs along the required path, as a design of the family `machine`.
#[derive(Clone, Debug)]
pub struct ReversedMachine {
    /// The design; its teeth are fitted, of a count that may be changed.
    pub design: MachineDesign,
    /// Steps of the tables in which its laws are written.
    pub steps: u32,
    /// Maximum distance of its tip from the path, mm, and the path's parameter there.
    pub tip_error: Extreme,
    /// Minimum radii of curvature of the pitch curves where convex, mm: driver and driven gear of each pair.
    pub minimum_radii: Vec<[f64; 2]>,
    /// Whether the pitch curves are convex everywhere: driver and driven gear of each pair.
    pub convex: Vec<[bool; 2]>,
}

/// Reason why there is no machine of a split.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum ReversedMachineError {
    /// A number of arms outside its range.
    #[error("a machine must have 1 to {maximum} arms, not {arms}")]
    Arms {
        /// Number given.
        arms: u32,
        /// Maximum.
        maximum: u32,
    },
    /// A number of steps outside its range.
    #[error("the tables of the laws must have {minimum} to {maximum} steps, not {steps}")]
    Steps {
        /// Number given.
        steps: u32,
        /// Fewest.
        minimum: u32,
        /// Most.
        maximum: u32,
    },
    /// The gears do not exist.
    #[error(transparent)]
    Gears(#[from] GearPairError),
}

/// Maximum number of arms of a machine.
const MAX_ARMS: u32 = 12;

impl ReversedMachine {
    /// The machine of a split: the sun on the frame, an intermediate gear, or two on one body, and a planet with the arm. At
    /// input zero the arm's point `tip` is at the start of the path. There is one such chain per arm.
    ///
    /// Laws are written as tables of driven angles with `steps` steps per turn; default: the smallest of 90, 180 and so on up to
    /// 2,880 that brings the tip within 1e-7 of the maximum distance from the carrier's axis. The path's derivatives of third
    /// order jump where its pieces join, so the error falls with the third power of the steps.
    ///
    /// # Errors
    /// [`ReversedMachineError`] for a number of arms or steps out of range, and if the pitch curves do not roll.
    pub fn new(
        chain: &TwoBar,
        split: &Split,
        arms: u32,
        steps: Option<u32>,
    ) -> Result<Self, ReversedMachineError> {
        let maximum = MAX_ARMS;
        if !(1..=maximum).contains(&arms) {
            return Err(ReversedMachineError::Arms { arms, maximum });
        }
        if let Some(steps) = steps {
            let [minimum, maximum] = RANGE;
            if !(minimum..=maximum).contains(&steps) {
                return Err(ReversedMachineError::Steps {
                    steps,
                    minimum,
                    maximum,
                });
            }
            return Self::of_steps(chain, split, arms, steps);
        }
        let enough = NEAR_ENOUGH * (chain.carrier() + chain.arm());
        let of_steps = |steps| Self::of_steps(chain, split, arms, steps);
        fewest_steps(of_steps, |made| made.tip_error.value <= enough)
    }

    /// Adds obstacles to the machine, and the clearances of its bodies from them as goals.
    #[must_use]
    pub fn with_obstacles(mut self, keep_out: &BTreeMap<String, KeepOut>) -> Self {
        for (name, shape) in keep_out {
            self.design.obstacles.insert(name.clone(), shape.into());
            for body in KeepOut::BODIES {
                let goal = MachineGoalSpec::clearance([body, name], shape.clearance);
                self.design.goals.insert(format!("{body}-{name}"), goal);
            }
        }
        self
    }

    /// Width of the plates, mm, for a length of the carrier, mm, and a bend, rad.
    #[must_use]
    pub fn plate_width(carrier: f64, bend: f64) -> f64 {
        preferred_size(PLATE[1] * leg(carrier, bend))
    }

    /// Minimum radius of curvature of its pitch curves where they are convex, mm.
    #[must_use]
    pub fn minimum_radius(&self) -> f64 {
        let radii = self.minimum_radii.iter().flatten();
        radii.fold(f64::INFINITY, |minimum, radius| minimum.min(*radius))
    }

    fn of_steps(
        chain: &TwoBar,
        split: &Split,
        arms: u32,
        steps: u32,
    ) -> Result<Self, ReversedMachineError> {
        let tables = split.tables(steps);
        let pairs = pairs(chain, split, tables);
        let rolled = pairs.iter().map(|(_, pair)| Ok(PlannedPair::roll(pair)?.1));
        let rolled = rolled.collect::<Result<Vec<Rolling>, GearPairError>>()?;
        let train = Train::new(split, &rolled);
        let ranges: Vec<_> = rolled.iter().map(Rolling::curvature_ranges).collect();
        let off = |t: f64| {
            let tip = train.tip(chain, chain.at(t).carrier[0]);
            chain.path().distance_near(tip, t)
        };
        let tip_error = maximum(off, &chain.path().parts(chain.stretched()));
        Ok(Self {
            design: design(chain, split, pairs, arms),
            steps,
            tip_error,
            minimum_radii: ranges
                .iter()
                .map(|both| both.map(minimum_convex_radius))
                .collect(),
            convex: ranges
                .iter()
                .map(|both| both.map(|range| range.minimum.1 >= 0.0))
                .collect(),
        })
    }
}

/// Makes a result with the smallest number of table steps that is enough, or with the largest if none is.
pub(super) fn fewest_steps<T, E>(
    make: impl Fn(u32) -> Result<T, E>,
    is_enough: impl Fn(&T) -> bool,
) -> Result<T, E> {
    let [coarse @ .., last] = STEPS;
    // Some coarse tables are no valid laws.
    let mut found = coarse.into_iter().filter_map(|steps| make(steps).ok());
    match found.find(is_enough) {
        Some(made) => Ok(made),
        None => make(last),
    }
}

/// Minimum radii of curvature where convex, mm: of driver and driven gear.
pub(super) fn minimum_convex_radii(rolling: &Rolling) -> [f64; 2] {
    rolling.curvature_ranges().map(minimum_convex_radius)
}

fn minimum_convex_radius(range: CurvatureRange) -> f64 {
    1.0 / range.maximum.1.max(0.0)
}

/// Angle from the axes of the planet's gear to those of the arm, rad.
fn turned(split: &Split) -> f64 {
    split.planet_offset() - 0.5 * split.bend() - PI
}

/// Angle of the intermediate's second gear on its body, rad, such that both laws begin at zero.
fn idler_mount(split: &Split) -> f64 {
    match split.kind() {
        SplitKind::OnePair => 0.0,
        SplitKind::Powers | SplitKind::Mildest => {
            split.idler_offset() + split.first(0.0) - split.second(0.0)
        }
    }
}

/// Pairs of the machine by name.
fn pairs(
    chain: &TwoBar,
    split: &Split,
    [first, second]: [Vec<f64>; 2],
) -> Vec<(&'static str, GearPairDesign)> {
    let leg = chain.center_distance(split.bend());
    let pair = |table: Vec<f64>| table_pair(table, leg);
    match split.kind() {
        SplitKind::OnePair => vec![(STAGE, pair(first))],
        SplitKind::Powers | SplitKind::Mildest => {
            vec![(FIRST, pair(first)), (SECOND, pair(second))]
        }
    }
}

/// Gear pair with a law given as a table; its tooth count is found later.
pub(super) fn table_pair(table: Vec<f64>, distance: f64) -> GearPairDesign {
    let law = Transmission {
        driven_angle: table,
        center_distance: Some(distance),
        tooth_count: Some(FIRST_COUNT),
        ..Transmission::default()
    };
    let mut pair = GearPairDesign::new(PitchSpec::Transmission(law));
    pair.teeth.addendum = Addendum::Fitted;
    pair.teeth.backlash = free_backlash(distance);
    pair.driver = free_body(distance).keyed(0.0).into();
    pair.driven = pair.driver.clone();
    pair
}

/// Default backlash of gears, mm, for a centre distance, mm.
pub(crate) fn free_backlash(distance: f64) -> f64 {
    preferred_size(BACKLASH * distance)
}

/// Default body of gears for a centre distance, mm.
pub(crate) fn free_body(distance: f64) -> BodySpec {
    BodySpec {
        width: preferred_size(WIDTH * distance),
        bore: preferred_size(BORE * distance),
        ..BodySpec::default()
    }
}

/// Tooth count before the search for another one.
const FIRST_COUNT: u32 = 60;

fn design(
    chain: &TwoBar,
    split: &Split,
    mut pairs: Vec<(&'static str, GearPairDesign)>,
    arms: u32,
) -> MachineDesign {
    let leg = chain.center_distance(split.bend());
    let named = |name: &str| name.to_owned();
    let (first, second) = match pairs.len() {
        1 => (STAGE, STAGE),
        _ => (FIRST, SECOND),
    };
    let mut design = MachineDesign {
        name: named("reversed"),
        title: named("Machine made from the path of its tip"),
        ..MachineDesign::default()
    };
    let axis = [chain.axis().x, chain.axis().y];
    design.frame.points.insert(named("O"), axis);
    let start = chain.at(0.0).carrier[0] - 0.5 * split.bend();
    let carrier = MachineBodySpec {
        on: Some(named("frame.O")),
        law: Some(MachineLawSpec {
            ratio: Some(chain.sense()),
            start_angle: Some(start),
            ..MachineLawSpec::default()
        }),
        ..MachineBodySpec::default()
    };
    let meshed = |gear: &str, with: &str, direction: f64| MachineBodySpec {
        on: Some(named("carrier")),
        mesh: Some(MachineMeshSpec {
            gear: named(gear),
            with: named(with),
            direction,
        }),
        ..MachineBodySpec::default()
    };
    let is_one = split.kind() == SplitKind::OnePair;
    let second_idler = if is_one {
        "idler-gear"
    } else {
        "idler-second-gear"
    };
    let arm = MachineBodySpec {
        fixed_to: Some(named("planet")),
        turned: Some(turned(split)),
        points: [(named("tip"), [chain.arm(), 0.0])].into(),
        ..MachineBodySpec::default()
    };
    design.bodies = [
        (named("carrier"), carrier),
        (named("idler"), meshed("idler-gear", "sun", 0.0)),
        (
            named("planet"),
            meshed("planet-gear", second_idler, split.bend()),
        ),
        (named("arm"), arm),
    ]
    .into();
    let gear = |pair: &str, role: GearRole, on: &str, mount: f64| MachineGearSpec {
        pair: named(pair),
        role,
        on: named(on),
        mount,
    };
    let sun = gear(first, GearRole::Driver, "frame.O", -0.5 * split.bend());
    design.gears = [
        (named("sun"), sun),
        (
            named("idler-gear"),
            gear(first, GearRole::Driven, "idler", 0.0),
        ),
        (
            named("planet-gear"),
            gear(second, GearRole::Driver, "planet", 0.0),
        ),
    ]
    .into();
    if !is_one {
        let mount = idler_mount(split);
        pairs[1].1.driven = free_body(leg).keyed(mount).into();
        let second = gear(second, GearRole::Driven, "idler", mount);
        design.gears.insert(named(second_idler), second);
    }
    design.pairs = pairs
        .into_iter()
        .map(|(name, pair)| (named(name), pair))
        .collect();
    if arms > 1 {
        let copies = MachineCopiesSpec {
            bodies: ["idler", "planet", "arm"].map(named).into(),
            count: arms,
            about: named("carrier"),
        };
        design.copies.insert(named(ARMS), copies);
    }
    let [thickness, width, pin] = PLATE.map(|share| preferred_size(share * leg));
    design.plates.thickness = Some(thickness);
    design.plates.width = Some(width);
    design.plates.pin_diameter = Some(pin);
    design
}

/// Forward motion of the gear train, computed from its pitch curves alone.
struct Train<'a> {
    first: &'a Rolling,
    second: &'a Rolling,
    bend: f64,
    mount: f64,
    turned: f64,
}

impl<'a> Train<'a> {
    fn new(split: &Split, rolled: &'a [Rolling]) -> Self {
        Self {
            first: &rolled[0],
            second: &rolled[rolled.len() - 1],
            bend: split.bend(),
            mount: idler_mount(split),
            turned: turned(split),
        }
    }

    /// Position of the tip for a direction from the carrier's axis to the planet's, rad.
    ///
    /// With lambda the direction from a driver's axis to the driven gear's and f the driven angle of the pair, the driven gear
    /// is at lambda + f(lambda - angle of the driver).
    fn tip(&self, chain: &TwoBar, direction: f64) -> Point {
        let leg = direction - 0.5 * self.bend;
        let idler = leg + self.first.driven_angle(direction);
        let back = leg + self.bend + PI;
        let polar = self.second.driver_jet(idler + self.mount - back).position;
        let bar = |length: f64, angle: f64| Vector::new(angle.cos(), angle.sin()) * length;
        chain.axis()
            + bar(self.first.center_distance(), leg)
            + bar(self.second.center_distance(), leg + self.bend)
            + bar(chain.arm(), back - polar + self.turned)
    }
}
impl From<&KeepOut> for MachineObstacleSpec {
    fn from(shape: &KeepOut) -> Self {
        let corner = |at: &[f64; 2]| MachineCornerSpec {
            at: *at,
            bulge: 0.0,
        };
        let circle = shape.center.zip(shape.radius);
        Self {
            outline: shape.corners.iter().map(corner).collect(),
            circle: circle.map(|(center, radius)| MachineCircleSpec { center, radius }),
            below: shape.below,
            ..Self::default()
        }
    }
}
