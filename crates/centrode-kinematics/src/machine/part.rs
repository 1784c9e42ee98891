use centrode_geometry::MassProperties;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Blank, LinkedMachine, Place};

/// Part that a shop makes or buys: a line of the parts list.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Part {
    /// Name.
    pub name: String,
    /// Indices of the links that the pieces belong to: one per piece in the machine.
    pub links: Vec<usize>,
    /// Material; empty if the design gives none.
    pub material: String,
    /// Stock that a piece is made from; `None` if it is bought, or not known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub blank: Option<Blank>,
    /// Mass of one piece, kg; `None` if it is not known.
    pub mass: Option<f64>,
    /// Where it comes from.
    #[serde(default, skip_serializing_if = "Supply::is_made")]
    pub supply: Supply,
    /// First part of the names of its drawings, sheets and solids; empty for a part without files.
    pub file: String,
    /// Remark.
    pub remark: String,
    /// Point of a piece to which its number points in the general arrangement; `None` if it is not visible.
    pub place: Option<Place>,
}

/// Where a part comes from.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Supply {
    /// Made from its sheet.
    #[default]
    Made,
    /// Bought by its name.
    Bought,
    /// Part of the surrounding machine: the design defines only its interface.
    Given,
}

centrode_spec::words!(Supply {
    Made = "made",
    Bought = "bought",
    Given = "given",
});

impl Supply {
    fn is_made(&self) -> bool {
        *self == Self::Made
    }
}

impl Part {
    /// A part that is bought by its name, with its pieces.
    #[must_use]
    pub fn bought(name: String, links: Vec<usize>) -> Self {
        Self {
            name,
            links,
            supply: Supply::Bought,
            ..Self::default()
        }
    }

    /// A part that comes from the customer, with its pieces. The remark states what it must fit.
    #[must_use]
    pub fn given(name: &str, links: Vec<usize>, remark: String) -> Self {
        Self {
            name: name.into(),
            links,
            supply: Supply::Given,
            remark,
            ..Self::default()
        }
    }

    /// Number of pieces in a machine.
    #[must_use]
    pub fn quantity(&self) -> usize {
        self.links.len()
    }
}

impl LinkedMachine {
    /// Adds a part with its pieces. A listed part of the same name and supply gets the pieces instead, if it has the same files
    /// or, for one that is not made, the same remark.
    pub fn part(&mut self, part: Part) -> usize {
        let alike = |known: &Part| {
            let same = known.supply == part.supply && known.name == part.name;
            let shares_files = !part.file.is_empty() && known.file == part.file;
            same && (shares_files || (known.supply != Supply::Made && known.remark == part.remark))
        };
        if let Some(index) = self.parts.iter().position(alike) {
            self.parts[index].links.extend(part.links);
            return index;
        }
        self.parts.push(part);
        self.parts.len() - 1
    }

    /// Mass of the pieces that belong to a link, kg; a piece of unknown mass adds none.
    #[must_use]
    pub fn mass_of_pieces(&self, link: usize) -> f64 {
        let pieces = |part: &Part| part.links.iter().filter(|own| **own == link).count();
        let mass = |part: &Part| part.mass.unwrap_or_default() * pieces(part) as f64;
        self.parts.iter().map(mass).sum()
    }

    /// Mass, center of mass and inertia at an input, in the first link's frame, of all links that a part belongs to: scenery does
    /// not count. `None` if no such link has a mass.
    #[must_use]
    pub fn mass_properties(&self, input: f64) -> Option<MassProperties> {
        let own = |link: &usize| self.parts.iter().any(|part| part.links.contains(link));
        let required = vec![true; self.links.len()];
        let places = self.places(input, &required);
        let placed = (0..self.links.len()).filter(own).filter_map(|link| {
            let place = places[link].as_ref()?;
            Some(self.links[link].mass?.placed(place))
        });
        MassProperties::combined(&placed.collect::<Vec<_>>())
    }
}
