//! Heat treatment of a part as written on sheets.

/// Heat treatment in words: as stated, or that there is none.
pub(crate) fn treatment(stated: &str) -> &str {
    match stated {
        "" => "none, as the material is supplied",
        stated => stated,
    }
}

/// Note of a sheet on the heat treatment of its part.
pub(crate) fn treatment_note(stated: &str) -> String {
    format!("Heat treatment: {}.", treatment(stated))
}
