//! Designs that the program brings with it.

/// Name and text of every shipped design, by family.
pub(crate) const SHIPPED: [(&str, &str); 26] = [
    (
        "circular-pair",
        include_str!("../../../designs/circular-pair.toml"),
    ),
    (
        "cubic-pair",
        include_str!("../../../designs/cubic-pair.toml"),
    ),
    (
        "elliptic-pair-2018",
        include_str!("../../../designs/elliptic-pair-2018.toml"),
    ),
    ("law-pair", include_str!("../../../designs/law-pair.toml")),
    (
        "lobed-pair-2-1",
        include_str!("../../../designs/lobed-pair-2-1.toml"),
    ),
    (
        "lobed-pair-3-2",
        include_str!("../../../designs/lobed-pair-3-2.toml"),
    ),
    (
        "lobed-pair-5-2",
        include_str!("../../../designs/lobed-pair-5-2.toml"),
    ),
    (
        "quintic-pair",
        include_str!("../../../designs/quintic-pair.toml"),
    ),
    (
        "shifted-pair",
        include_str!("../../../designs/shifted-pair.toml"),
    ),
    (
        "transplanter-pair-2021",
        include_str!("../../../designs/transplanter-pair-2021.toml"),
    ),
    (
        "three-arm-2021",
        include_str!("../../../designs/three-arm-2021.toml"),
    ),
    (
        "three-arm-all-goals",
        include_str!("../../../designs/three-arm-all-goals.toml"),
    ),
    (
        "three-arm-from-poses",
        include_str!("../../../designs/three-arm-from-poses.toml"),
    ),
    (
        "spiral-shaft-2018",
        include_str!("../../../designs/spiral-shaft-2018.toml"),
    ),
    (
        "moving-box-2018",
        include_str!("../../../designs/moving-box-2018.toml"),
    ),
    (
        "feeder-2022",
        include_str!("../../../designs/feeder-2022.toml"),
    ),
    (
        "feeder-widened",
        include_str!("../../../designs/feeder-widened.toml"),
    ),
    (
        "composed-box",
        include_str!("../../../designs/composed-box.toml"),
    ),
    (
        "composed-feeder",
        include_str!("../../../designs/composed-feeder.toml"),
    ),
    (
        "composed-three-arm",
        include_str!("../../../designs/composed-three-arm.toml"),
    ),
    (
        "index-table",
        include_str!("../../../designs/index-table.toml"),
    ),
    (
        "jansen-leg",
        include_str!("../../../designs/jansen-leg.toml"),
    ),
    (
        "peaucellier-cell",
        include_str!("../../../designs/peaucellier-cell.toml"),
    ),
    ("press", include_str!("../../../designs/press.toml")),
    ("two-arm", include_str!("../../../designs/two-arm.toml")),
    ("two-stage", include_str!("../../../designs/two-stage.toml")),
];

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
