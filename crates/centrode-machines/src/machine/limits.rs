//! Limits of the numbers and names of a composed machine's file.

use std::collections::BTreeMap;

use super::{Machine, MachineDesign, MachineError};
use centrode_spec::goals::check_varied;
use centrode_spec::rule::in_range;
use centrode_spec::{MechanismError, SpecError, numbers_of};

/// Maximum of lengths and coordinates, mm.
const FAR: f64 = 1e5;
/// Maximum of all other numbers.
const MOST: f64 = 1e9;
/// Words in the keys of lengths.
const LENGTHS: [&str; 19] = [
    "arm_length",
    "base_radius",
    "below",
    "center",
    "circle",
    "corner_radius",
    "face_offset",
    "gap",
    "heights",
    "lengths",
    "lift",
    "offset",
    "outline",
    "points",
    "radius",
    "roller_radius",
    "start",
    "thickness",
    "width",
];
/// Names of files of the whole machine.
const OWN_FILES: [&str; 2] = ["assembly", "sheets"];
/// Names of tables of the whole machine: gears and cams have tables, too.
const OWN_TABLES: [&str; 2] = ["motion", "parts"];
/// Names that Windows reserves for devices.
const DEVICES: [&str; 4] = ["aux", "con", "nul", "prn"];

impl MachineDesign {
    /// Checks that no number exceeds its limit.
    pub(super) fn check_sizes(&self) -> Result<(), SpecError> {
        for (key, number) in numbers_of(self) {
            let mut words = key.split(['.', '[']);
            let is_length = words.any(|word| LENGTHS.contains(&word));
            let (most, unit) = if is_length { (FAR, " mm") } else { (MOST, "") };
            in_range(&key, number, [-most, most], unit)?;
        }
        Ok(())
    }

    /// Checks that every key of `vary` names a number of the machine.
    ///
    /// # Errors
    /// [`MechanismError`] with the key at fault.
    pub fn check_vary(&self) -> Result<(), MechanismError> {
        check_varied(self, &self.vary, &["input.turns"])
    }
}

impl Machine {
    /// Checks that the files of all parts have different names.
    pub(super) fn check_names(&self) -> Result<(), MachineError> {
        let named = |table: &str, name: &String| (format!("{table}.{name}"), name.clone());
        let design = &self.written;
        let mut stems: Vec<(String, String)> = Vec::new();
        stems.extend(design.bodies.keys().map(|name| named("bodies", name)));
        for name in design.gears.keys() {
            let (key, name) = named("gears", name);
            stems.push((key.clone(), format!("{name}-pins")));
            stems.push((key, name));
        }
        for name in design.cams.keys() {
            let (key, name) = named("cams", name);
            stems.push((key.clone(), format!("{name}-assembly")));
            stems.push((key, name));
        }
        if self.has_frame_plates() {
            stems.extend(
                [Self::FRAME_TOP, Self::POSTS].map(|name| ("hardware".to_owned(), name.to_owned())),
            );
        }
        let mut taken: BTreeMap<String, String> = BTreeMap::new();
        for (key, stem) in &stems {
            let refused = |why: String| Err(MachineError::refused(key, why));
            // File systems may treat capital and small letters as equal.
            let small = stem.to_ascii_lowercase();
            let is_tabled = !key.starts_with("bodies.");
            let is_table = is_tabled && OWN_TABLES.contains(&small.as_str());
            if OWN_FILES.contains(&without_sheet(&small)) || is_table {
                return refused(format!(
                    "a file of the whole machine is named {small}: give the part another name"
                ));
            }
            if DEVICES.contains(&small.as_str()) || small.starts_with('-') {
                return refused(
                    "is not allowed as the name of a file: give the part another name".into(),
                );
            }
            if let Some(other) = taken.insert(small, key.clone()) {
                return refused(one_name(key, &other));
            }
        }
        for (key, stem) in stems {
            let small = stem.to_ascii_lowercase();
            let part = without_sheet(&small);
            if let Some(other) = taken.get(part).filter(|_| part != small) {
                return Err(MachineError::refused(&key, one_name(&key, other)));
            }
        }
        Ok(())
    }
}

fn one_name(key: &str, other: &str) -> String {
    format!("the files of {key} and {other} would have the same name: give one of them another")
}

/// The name of the part whose drawing sheet could have this name: `a` for `a-sheet` and `a-sheet-2`.
fn without_sheet(name: &str) -> &str {
    let numbered = name
        .trim_end_matches(|c: char| c.is_ascii_digit())
        .strip_suffix('-');
    let is_sheet = |name: &&str| name.ends_with("-sheet");
    let sheet = numbered.filter(is_sheet).unwrap_or(name);
    sheet.strip_suffix("-sheet").unwrap_or(name)
}
