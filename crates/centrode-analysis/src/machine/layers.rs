//! Orders of the plates without collisions, for a machine whose plates or pins collide.

use std::collections::BTreeMap;

use centrode_machines::machine::{Hardware, LayerOrders, Machine, MachineDesign};

use super::{Made, collisions, ends as ends_of};
use crate::{Finding, Report, Severity};

/// Findings that another order of the plates may remove.
const RULES: [&str; 3] = ["plates-collide", "pins-collide", "parts-collide"];

/// Outcome of a search for layers.
enum Layers {
    /// Layers by body without collisions.
    Free(BTreeMap<String, i32>),
    /// Pairs of a pin and a plate: in every order at least one of these pairs collides.
    Blocked(Vec<String>),
    /// Number of orders that were tried; each has a collision.
    Tried(usize),
    /// Number of plates without a layer, which is too large.
    Many(usize),
}

/// Layers in which no plates and pins collide, as text, and the design with these layers.
///
/// Bodies with a `layer` keep it. `None` if nothing collides, or no order was found: the finding `layer-order` of the check has
/// the reason.
#[must_use]
pub fn machine_layers(composed: &Machine) -> Option<(String, MachineDesign)> {
    let mut report = Report::default();
    let ends = ends_of(composed);
    collisions::collisions(&Made::new(composed), &ends, &mut report);
    match searched(composed, &ends, &report)? {
        Layers::Free(layers) => Some((
            words(&layers),
            composed.with_layers(&layers).design().clone(),
        )),
        _ => None,
    }
}

/// Adds a note with an order of the plates that is free of collisions, or why there is none, if plates or pins collide.
pub(super) fn layers(composed: &Machine, ends: &[f64], report: &mut Report) {
    let Some(found) = searched(composed, ends, report) else {
        return;
    };
    let (message, remedy) = match found {
        Layers::Free(layers) => (
            format!("with {} there are no collisions", words(&layers)),
            "check --remedy prints the design with these layers",
        ),
        Layers::Blocked(pairs) => (
            format!(
                "no order of the plates is free of collisions: in each order at least one of these pins hits a plate: {}",
                pairs.join("; ")
            ),
            "other points for one of these pins, or an outline of the plate that is clear of it",
        ),
        Layers::Tried(count) => (
            format!(
                "no order of the plates without collisions was found: the {count} orders in which no pin hits a plate have other collisions"
            ),
            "narrower plates, thinner pins, or other layers",
        ),
        Layers::Many(count) => (
            format!("{count} plates have no layer: an order is searched only for 12 or fewer"),
            "a layer for some of the bodies",
        ),
    };
    report
        .findings
        .push(Finding::new("layer-order", Severity::Note, message).remedy(remedy));
}

/// Layers for a machine whose plates or pins collide; `None` if they do not.
fn searched(composed: &Machine, ends: &[f64], report: &Report) -> Option<Layers> {
    let has_plates = composed.design().hardware() != Hardware::None;
    if !has_plates || !collides(report) {
        return None;
    }
    let orders = match composed.layer_orders() {
        LayerOrders::Free(orders) => orders,
        LayerOrders::Blocked(pairs) => return Some(Layers::Blocked(pairs)),
        LayerOrders::Many(count) => return Some(Layers::Many(count)),
    };
    let count = orders.len();
    let is_free = |layers: &BTreeMap<String, i32>| {
        let trial = composed.with_layers(layers);
        let mut report = Report::default();
        collisions::collisions(&Made::new(&trial), ends, &mut report);
        !collides(&report)
    };
    let found = orders.into_iter().find(is_free);
    Some(found.map_or(Layers::Tried(count), Layers::Free))
}

fn collides(report: &Report) -> bool {
    let mut findings = report.findings.iter();
    findings.any(|finding| RULES.contains(&finding.rule))
}

fn words(layers: &BTreeMap<String, i32>) -> String {
    let mut all: Vec<(&String, &i32)> = layers.iter().collect();
    all.sort_by_key(|(_, layer)| **layer);
    let all = all
        .into_iter()
        .map(|(body, layer)| format!("{body} {layer}"));
    format!("layers {}", all.collect::<Vec<_>>().join(", "))
}
