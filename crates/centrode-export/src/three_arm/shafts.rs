//! Shafts and pins of a three-arm mechanism, turned to the heights of what is on them.

use centrode_mechanism::machine::{self, dowel};

use super::Part;
use super::arrangement::links;
use super::machine::{Machine, PRESSED, RUNNING, SLIDING, STEEL};
use crate::gear_pair;
use crate::sheet::fit;
use crate::turned::{Bar, Step, Turned};

/// Diameters of its own that the carrier's shaft goes on behind the gearbox.
const DRIVEN_END: f64 = 3.0;
/// Files of the roller's pin, where no standard pin has its diameter.
const ROLLER_PIN: &str = "pin-roller";

/// A turned part and the part whose links carry its pieces.
pub(super) struct Piece {
    pub(super) part: Turned,
    on: Part,
    size: f64,
}

impl Piece {
    /// How many a machine of so many arms has.
    pub(super) fn quantity(&self, arms: u32) -> usize {
        self.on.quantity(arms) as usize
    }
}

/// All that are turned.
pub(super) fn all(parts: &Machine<'_>) -> Vec<Piece> {
    let mut all = shafts(parts);
    all.extend(pins(parts));
    all
}

/// Shafts through both plates of the carrier; those of the planets go on through the arms.
fn shafts(parts: &Machine<'_>) -> Vec<Piece> {
    let mechanism = parts.mechanism;
    let ([rear, front], play) = (parts.gearbox.spans, mechanism.design().gearbox.play);
    let free = f64::INFINITY;
    let cover = parts
        .of_arm("cover-front")
        .map_or(0.0, |cover| cover.span[1]);
    let beyond = mechanism.arm_level() + cover;
    let of = |part: Part, names: [&str; 2]| {
        let (pair, member) = parts.gear(part)?;
        let body = pair.gear(member).body();
        if body.bore <= 0.0 {
            return None;
        }
        let (span, room) = match part {
            Part::Sun => {
                let behind = rear[0] - DRIVEN_END * body.bore;
                ([behind, front[1]], [0.0, play])
            }
            Part::Planet => ([rear[0], beyond], [free, free]),
            _ => ([rear[0], front[1]], [free, play]),
        };
        let bar = Bar::new(body.bore, &body.shaft_fit, span).held(room);
        let bar = bar.keyed(body.keyway, [0.0, body.width]);
        let mut turned = bar.part(names, (&body.material, body.density));
        if part == Part::Sun {
            turned.notes =
                vec!["Free end for its bearing and the drive, to be cut to length.".into()];
        }
        Some(Piece {
            part: turned,
            on: part,
            size: body.bore,
        })
    };
    [
        of(Part::Sun, ["shaft-carrier", "Shaft of the carrier"]),
        of(
            Part::Intermediate,
            ["shaft-intermediate", "Shaft of an intermediate gear"],
        ),
        of(Part::Planet, ["shaft-planet", "Shaft of a planet gear"]),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// Heights from fork to roller.
fn roller_length(parts: &Machine<'_>) -> f64 {
    let spans = [parts.pusher.fork_span(), parts.pusher.cam_span()];
    let [low, high] = [0, 1].map(|end| spans.map(|span| span[end]));
    high[0].max(high[1]) - low[0].min(low[1])
}

/// Pins of fork, roller and push rod; one that is bought is none.
fn pins(parts: &Machine<'_>) -> Vec<Piece> {
    let spec = parts.pusher.fork_spec();
    let (material, density) = STEEL;
    let wide = |name: &str| {
        let span = parts.of_arm(name).map_or([0.0, 1.0], |part| part.span);
        span[1] - span[0]
    };
    let mut all = Vec::new();
    let mut add = |on: Part, size: f64, part: Turned| {
        if size > 0.0 {
            all.push(Piece { part, on, size });
        }
    };
    let plain = |names: [&str; 2], diameter: f64, class: &str, length: f64| {
        Bar::new(diameter, class, [0.0, length]).part(names, STEEL)
    };
    let mut fork = plain(
        ["pin-fork", "Pin of the fork"],
        spec.pivot_bore,
        RUNNING[1],
        wide("housing"),
    );
    fork.notes = vec!["As long as the housing is thick, between its covers.".into()];
    add(Part::Housing, spec.pivot_bore, fork);
    let length = roller_length(parts);
    if dowel(spec.roller_bore, length).is_none() {
        let names = [ROLLER_PIN, "Pin of the roller"];
        let pin = plain(names, spec.roller_bore, PRESSED[1], length);
        add(Part::Fork, spec.roller_bore, pin);
    }
    let thin = 0.5 * spec.slot_width;
    let fork = parts.pusher.fork_span();
    let steps = vec![
        Step::plain(thin, wide("push-rod"), PRESSED[1]),
        Step::plain(spec.slot_width, fork[1] - fork[0], SLIDING[1]),
    ];
    let rod = Turned {
        name: "pin-rod".into(),
        title: "Pin of the push rod".into(),
        steps,
        keyway: None,
        chamfer: 0.0,
        material: material.into(),
        density,
        notes: vec!["Thin end pressed into the rod; the wide one runs in the fork's slot.".into()],
    };
    add(Part::PushRod, thin, rod);
    all
}

/// Lists all that are turned, with what is bought for them, and the pins that are bought.
pub(super) fn list(parts: &Machine<'_>, machine: &mut machine::Machine) {
    let arms = parts.mechanism.arms();
    for piece in all(parts) {
        let fit = machine.fits.iter().find(|fit| fit.size == piece.size);
        let remark = fit.map(fit::shaft).unwrap_or_default();
        let links = links(piece.on, arms, machine);
        if let Some((pair, member)) = parts.gear(piece.on) {
            let body = pair.gear(member).body();
            gear_pair::list_keys(machine, body, links.clone());
        }
        piece.part.list(machine, &links, remark, None);
    }
    let spec = parts.pusher.fork_spec();
    if let Some(name) = dowel(spec.roller_bore, roller_length(parts)) {
        let links = links(Part::Fork, arms, machine);
        machine.part(machine::Part {
            remark: "of the roller, pressed into the fork".into(),
            ..machine::Part::bought(name, links)
        });
    }
}
