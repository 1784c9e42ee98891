use std::collections::BTreeMap;

/// How many of what a file holds: entities by layer, elements, columns.
pub(crate) fn count(name: &str, bytes: &[u8]) -> BTreeMap<String, usize> {
    let mut counts = BTreeMap::new();
    let mut add = |what: String| *counts.entry(what).or_default() += 1;
    match name.rsplit('.').next() {
        Some("dxf") => dxf(text(bytes), &mut add),
        Some("svg" | "urdf" | "xml") => {
            for element in text(bytes).split('<').skip(1) {
                let word = element
                    .split([' ', '>', '/', '\n'])
                    .next()
                    .unwrap_or_default();
                if word.starts_with(char::is_alphabetic) {
                    add(word.to_owned());
                }
            }
        }
        Some("csv") => {
            let header = text(bytes).lines().next().unwrap_or_default();
            header.split(',').for_each(|column| add(column.to_owned()));
        }
        Some("json") => text(bytes)
            .lines()
            .filter_map(|line| line.trim().strip_prefix('"')?.split_once('"'))
            .for_each(|(key, _)| add(key.to_owned())),
        Some("py") => text(bytes)
            .lines()
            .filter_map(|line| line.trim().strip_prefix("def ")?.split_once('('))
            .for_each(|(name, _)| add(name.to_owned())),
        Some("step") => {
            for line in text(bytes).lines() {
                let entity = line.split(['=', '(']).nth(1).unwrap_or_default();
                if matches!(
                    entity,
                    "ADVANCED_FACE" | "EDGE_CURVE" | "MANIFOLD_SOLID_BREP"
                ) {
                    add(entity.to_owned());
                }
            }
        }
        // How many moves depends on rounding: which words there are is enough.
        Some("ngc") => {
            for word in ["G0", "G1", "G93", "M0", "M2"] {
                if text(bytes)
                    .lines()
                    .any(|line| line.split(' ').next() == Some(word))
                {
                    add(word.to_owned());
                }
            }
        }
        // Triangles depend on rounding: that there are some is enough.
        Some("stl") => {
            if bytes.len() > 84 {
                add("solid".into());
            }
        }
        Some("3mf") => {
            if bytes.starts_with(b"PK") {
                add("package".into());
            }
        }
        _ => add("unknown kind".into()),
    }
    counts
}

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).expect("text")
}

/// Entities by type and layer: pairs of a code line and a value line.
fn dxf(text: &str, add: &mut impl FnMut(String)) {
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    let pairs = lines.chunks_exact(2).map(|pair| (pair[0], pair[1]));
    let mut kind = "";
    let within = pairs
        .skip_while(|pair| *pair != ("2", "ENTITIES"))
        .take_while(|pair| *pair != ("0", "ENDSEC"));
    for (code, value) in within {
        match code {
            "0" => kind = value,
            "8" if !kind.is_empty() => {
                add(format!("{kind} on {value}"));
                kind = "";
            }
            _ => {}
        }
    }
}
