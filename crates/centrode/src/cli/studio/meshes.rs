use axum::Json;
use axum::body::Bytes;
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};

use super::routes::{Refused, Text, computed};
use crate::FAMILIES;
use crate::cli::args::{TOLERANCE, tolerance};
use crate::export::machine;

/// Meshes of a design as `export` writes them by default, and where they stand at the picture's inputs.
pub(crate) async fn answer(Json(ask): Json<Text>) -> Result<Response, Refused> {
    let made = computed(move || meshes(&ask.text)).await?;
    let bytes =
        made.map_err(|reason| Refused::because(StatusCode::UNPROCESSABLE_ENTITY, reason))?;
    let kind = [(header::CONTENT_TYPE, "application/octet-stream")];
    Ok((kind, Bytes::from(bytes)).into_response())
}

fn meshes(text: &str) -> Result<Vec<u8>, String> {
    let tolerance = tolerance(TOLERANCE)?;
    let read = FAMILIES.read(text.as_bytes());
    let mechanism = read.and_then(|file| file.mechanism());
    let mechanism = mechanism.map_err(|error| error.message())?;
    let input = mechanism.picture().motion.input;
    let made = mechanism.machine();
    let made = made.and_then(|made| machine::spatial(&made, &input, tolerance));
    made.map_err(|error| error.to_string())
}
