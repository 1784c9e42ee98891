//! Files of a design for the page, packed as one.

use std::sync::Arc;

use axum::Json;
use axum::body::Bytes;
use axum::extract::State;
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse as _, Response};
use clap::{Parser as _, ValueEnum as _};
use serde::Deserialize;

use super::StudioState;
use super::routes::{Refused, computed};
use crate::cli::args::{Arguments, Command, Export, File};
use crate::cli::export;
use crate::formats::Purpose;

/// Word for the page as one file among the kinds of file.
const PAGE: &str = "report";

/// Receivers of files: the word for each, the formats for it and their tolerance, mm.
pub(super) fn purposes() -> Vec<(&'static str, Vec<&'static str>, f64)> {
    let of = |purpose: Purpose| {
        let formats = purpose.formats().iter().map(|format| format.name());
        (purpose.name(), formats.collect(), purpose.tolerance().mm())
    };
    Purpose::ALL.map(of).to_vec()
}

/// Kinds of file that can be exported: the word for each, and its description.
pub(super) fn formats() -> Vec<[String; 2]> {
    let values = File::value_variants()
        .iter()
        .filter(|file| **file != File::All)
        .filter_map(File::to_possible_value);
    values
        .map(|value| {
            let help = value.get_help().map(ToString::to_string);
            [value.get_name().to_owned(), help.unwrap_or_default()]
        })
        .chain([[PAGE, "This page as one HTML file, for reading and sending"].map(str::to_owned)])
        .collect()
}

#[derive(Deserialize)]
pub(super) struct Files {
    text: String,
    /// Kinds of file as on the command line, and [`PAGE`]; empty for the default of the command line.
    formats: Vec<String>,
    tolerance: String,
    dxf: String,
    layers: String,
    /// Width of the cut, mm; empty for that of the design.
    #[serde(default)]
    kerf: String,
    /// Names of parts; empty for all parts.
    #[serde(default)]
    parts: Vec<String>,
}

impl Files {
    /// Whether the page is requested, too.
    fn page(&self) -> bool {
        self.formats.iter().any(|word| word == PAGE)
    }

    /// Export command with these options, if more than the page is requested; the folder is not used.
    fn command(&self) -> Result<Option<Export>, String> {
        let words: Vec<&str> = self.formats.iter().map(String::as_str).collect();
        let kinds: Vec<&str> = words.into_iter().filter(|word| *word != PAGE).collect();
        if kinds.is_empty() && self.page() {
            return Ok(None);
        }
        let (formats, tolerance, dxf, layers) = (
            format!("--format={}", kinds.join(",")),
            format!("--tolerance={}", self.tolerance),
            format!("--dxf={}", self.dxf),
            format!("--layers={}", self.layers),
        );
        let words = ["centrode", "export", "-", "--to=."];
        let mut words: Vec<&str> = words
            .into_iter()
            .chain([&*tolerance, &*dxf, &*layers])
            .collect();
        let kerf = format!("--kerf={}", self.kerf);
        if !self.kerf.is_empty() {
            words.push(&kerf);
        }
        if !kinds.is_empty() {
            words.push(&formats);
        }
        let parts: Vec<String> = self
            .parts
            .iter()
            .map(|part| format!("--part={part}"))
            .collect();
        words.extend(parts.iter().map(String::as_str));
        match Arguments::try_parse_from(words).map(|arguments| arguments.command) {
            Ok(Command::Export(command)) => Ok(Some(command)),
            Ok(_) => Err("this is not an export command".into()),
            Err(error) => {
                let message = error.to_string();
                let first = message.lines().next().unwrap_or_default();
                Err(first.trim_start_matches("error: ").to_owned())
            }
        }
    }
}

pub(super) async fn answer(
    State(state): State<Arc<StudioState>>,
    Json(ask): Json<Files>,
) -> Result<Response, Refused> {
    let unusable = |reason: String| Refused::because(StatusCode::UNPROCESSABLE_ENTITY, reason);
    let command = ask.command().map_err(unusable)?;
    let zip = computed(move || {
        let page = ask.page();
        let whole = state.document.with_files(ask.text).whole;
        let whole = whole.map_err(|error| error.to_string())?;
        export::zip(&whole, command.as_ref(), page).map_err(|failure| failure.to_string())
    });
    let zip = zip.await?.map_err(unusable)?;
    Ok((
        [(header::CONTENT_TYPE, "application/zip")],
        Bytes::from(zip),
    )
        .into_response())
}
