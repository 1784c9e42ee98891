//! Names of copies and their originals, in a design with its copies written out.

use std::collections::BTreeMap;

use crate::machine::body::points::Reference;

/// Names of a design with its copies written out.
#[derive(Clone, Debug, Default)]
pub(in crate::machine) struct Expansion {
    /// Names of the originals of bodies, dyads, gears, cams and meshes, by the names of their copies.
    pub(in crate::machine) originals: BTreeMap<String, String>,
    /// Names of pins, by the points (`body.point`) that stand for them on the body about which copies are spaced.
    pub(in crate::machine) pins: BTreeMap<String, String>,
    /// Inputs by which laws and loads of copies run ahead of the originals, by `body` and `loads.load`, rad.
    pub(in crate::machine) ahead: BTreeMap<String, f64>,
}

impl Expansion {
    /// Name of the pin of a body at a point.
    pub(in crate::machine) fn pin(&self, on: &Reference) -> String {
        let point = on.point.as_deref().unwrap_or_default();
        let pin = self.pins.get(&format!("{}.{point}", on.body));
        pin.map_or(point, String::as_str).to_owned()
    }

    /// Name of the original of a body, dyad, gear, cam or mesh; the name itself if it is not a copy.
    pub(in crate::machine) fn original<'a>(&'a self, name: &'a str) -> &'a str {
        self.originals.get(name).map_or(name, String::as_str)
    }

    /// Key with the name of the original instead of that of a copy.
    pub(in crate::machine) fn written(&self, key: &str) -> String {
        let parts = key.split('.').enumerate();
        let parts = parts.map(|(i, part)| if i == 1 { self.original(part) } else { part });
        parts.collect::<Vec<_>>().join(".")
    }
}
