//! Words on a machine made from a path, for the command and the page.

use centrode_analysis::{Finding, Goal, SoundTeeth, Unit};
use centrode_gear::design::Addendum;
use centrode_machines::three_arm::design::Direction;
use centrode_synthesis::reverse::{ReversedMachine, Split, SplitKind, TwoBar};

/// Name of a figure, and its words.
pub type Labelled = (String, String);

fn mm(x: f64) -> String {
    Unit::Millimetre.with_unit(x)
}

/// Range of ratios.
#[must_use]
pub fn range(ratios: [f64; 2]) -> String {
    format!("{:.4} to {:.4}", ratios[0], ratios[1])
}

/// Lines on carrier, arm and ratio.
pub fn bars(chain: &TwoBar) -> [(&'static str, String); 3] {
    let sense = match chain.direction() {
        Direction::CounterClockwise => "counter-clockwise",
        Direction::Clockwise => "clockwise",
    };
    let ratios = range(chain.ratios().map(|ratio| ratio.value));
    let factor = chain.unevenness().exp();
    [
        ("carrier", format!("{}, turns {sense}", mm(chain.carrier()))),
        ("arm", mm(chain.arm())),
        (
            "ratio",
            format!("{ratios}, within a factor of {factor:.4} of 1"),
        ),
    ]
}

/// Line on the minimum convex radius of the gears that are written.
pub fn minimum_radius(made: &ReversedMachine) -> (&'static str, String) {
    ("minimum convex radius", mm(made.minimum_radius()))
}

/// Line on the minimum convex radii of a pair's pitch curves.
pub fn minimum_radii(pair: &str, [driver, driven]: [f64; 2]) -> Labelled {
    let words = format!(
        "minimum convex radius {} (driver), {} (driven)",
        mm(driver),
        mm(driven)
    );
    (format!("pair {pair}"), words)
}

/// Line on the distance of the tip from the path.
pub fn tip_error(made: &ReversedMachine) -> (&'static str, String) {
    let error = mm(made.tip_error.value);
    let words = format!("at most {error}, with laws of {} steps", made.steps);
    ("error of the tip", words)
}

/// Line on the clamp.
pub(crate) fn clamp(angle: f64) -> Labelled {
    let words = format!("{} from the arm", Unit::Angle.with_unit(angle));
    ("clamp".to_owned(), words)
}

/// Lines on the clamp and on the error of each pose.
pub fn poses(angle: f64, misses: &[[f64; 2]]) -> Vec<Labelled> {
    let pose = |(index, [off, turned]): (usize, &[f64; 2])| {
        let (off, turned) = (mm(*off), Unit::Angle.with_unit(*turned));
        let name = format!("pose {}", index + 1);
        (name, format!("missed by {off} and {turned}"))
    };
    let poses = misses.iter().enumerate().map(pose);
    std::iter::once(clamp(angle)).chain(poses).collect()
}

/// Lines on the splits other than the chosen one.
pub fn other_splits(chain: &TwoBar, chosen: SplitKind, bend: f64) -> Vec<Labelled> {
    let others = SplitKind::ALL.into_iter().filter(|kind| *kind != chosen);
    let line = |kind: SplitKind| {
        let words = match Split::new(chain, kind, bend) {
            Ok(split) => sharpest(chain, &split),
            Err(error) => error.to_string(),
        };
        (format!("split {}", kind.name()), words)
    };
    others.map(line).collect()
}

/// The minimum convex radius of a split that was not chosen, in words.
fn sharpest(chain: &TwoBar, split: &Split) -> String {
    match ReversedMachine::new(chain, split, 1, None) {
        Ok(made) => {
            let minimum = mm(made.minimum_radius());
            format!("possible, minimum convex radius {minimum}")
        }
        Err(error) => error.to_string(),
    }
}

/// Line on a goal: its figure, what was required, and by how much it is missed.
pub fn goal(goal: &Goal) -> Labelled {
    let show = |x: f64| goal.unit.with_unit(x);
    let value = goal.value.map_or_else(String::new, show);
    let required = match goal.required {
        [Some(minimum), Some(most)] => format!("{} to {}", show(minimum), show(most)),
        [Some(minimum), None] => format!("at least {}", show(minimum)),
        [None, Some(most)] => format!("at most {}", show(most)),
        [None, None] => String::new(),
    };
    let missed = match goal.margin {
        Some(margin) if margin < 0.0 => format!(", missed by {}", show(-margin)),
        _ => String::new(),
    };
    let words = format!("{} {value}, required {required}{missed}", goal.title);
    (format!("goal {}", goal.number), words)
}

/// Line on a finding.
pub fn finding(finding: &Finding) -> Labelled {
    let remedy = finding
        .remedy
        .as_deref()
        .map_or_else(String::new, |remedy| format!("; remedy: {remedy}"));
    (
        finding.rule.to_owned(),
        format!("{}{remedy}", finding.message),
    )
}

/// Line on the teeth of a pair.
pub fn teeth(teeth: &SoundTeeth) -> Labelled {
    let mm = |x: f64| Unit::Millimetre.with_unit(x);
    let (kind, full) = match teeth.addendum {
        Addendum::Full => ("full", String::new()),
        Addendum::Fitted => {
            let words = format!(
                "; full teeth are undercut above module {}",
                mm(teeth.full_module)
            );
            ("fitted", words)
        }
    };
    let words = format!(
        "{} {kind} teeth, module {}{full}",
        teeth.tooth_count,
        mm(teeth.module)
    );
    (format!("teeth of {}", teeth.pair), words)
}
