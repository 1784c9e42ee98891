//! Designs that the program contains.

use crate::FAMILIES;

macro_rules! designs {
    ($($name:literal),+ $(,)?) => {
        [$(($name, include_str!(concat!("../../designs/", $name, ".toml")))),+]
    };
}

/// Name and text of every shipped design, by family.
pub(crate) const SHIPPED: [(&str, &str); 29] = designs!(
    "circular-pair",
    "cubic-pair",
    "elliptic-pair-2018",
    "law-pair",
    "lobed-pair-2-1",
    "lobed-pair-3-2",
    "lobed-pair-5-2",
    "oval-flow-meter",
    "quintic-pair",
    "shifted-pair",
    "transplanter-pair-2021",
    "three-arm-2021",
    "three-arm-all-goals",
    "three-arm-from-poses",
    "spiral-shaft-2018",
    "moving-box-2018",
    "feeder-2022",
    "feeder-widened",
    "composed-box",
    "composed-feeder",
    "composed-three-arm",
    "disc-cam",
    "index-table",
    "jansen-leg",
    "klann-leg",
    "peaucellier-cell",
    "press",
    "two-arm",
    "two-stage",
);

/// Name and title of each shipped design of a family.
pub(crate) fn shipped_of(family: &str) -> impl Iterator<Item = (&'static str, String)> {
    SHIPPED.iter().filter_map(move |(name, text)| {
        let file = FAMILIES.read(text.as_bytes()).ok()?;
        let title = file.design().title().to_owned();
        (file.family().design.word == family).then_some((*name, title))
    })
}

/// Text of the shipped design with a name.
pub(crate) fn shipped(name: &str) -> Option<&'static str> {
    let (_, text) = SHIPPED.iter().find(|(own, _)| *own == name)?;
    Some(text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;
    use std::fs;
    use std::path::Path;

    /// Text of every design of a folder by its name.
    fn folder(path: &str) -> BTreeMap<String, String> {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
        let files = fs::read_dir(folder).expect("a folder").map(|entry| {
            let path = entry.expect("an entry").path();
            let name = path.file_stem().and_then(|stem| stem.to_str());
            let text = fs::read_to_string(&path).expect("text");
            (name.expect("a name").to_owned(), text)
        });
        files.collect()
    }

    #[test]
    fn the_designs_that_are_tested_are_those_shipped() {
        let own = SHIPPED.map(|(name, text)| (name.to_owned(), text.to_owned()));
        // After a change there: cp tests/designs/*.toml crates/centrode/designs
        assert!(folder("../../tests/designs") == BTreeMap::from(own));
        assert_eq!(folder("designs").len(), SHIPPED.len());
    }
}
