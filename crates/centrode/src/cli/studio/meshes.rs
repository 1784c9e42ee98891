use axum::Json;
use axum::body::Bytes;
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};

use super::routes::{Refused, Text, computed};
use crate::geometry::Tolerance;
use crate::page;

/// Meshes of a design as `export` writes them by default, and their poses at the picture's inputs.
pub(crate) async fn answer(Json(ask): Json<Text>) -> Result<Response, Refused> {
    let made = computed(move || page::meshes(&ask.text, Tolerance::MICROMETRE)).await?;
    let bytes =
        made.map_err(|reason| Refused::because(StatusCode::UNPROCESSABLE_ENTITY, reason))?;
    let kind = [(header::CONTENT_TYPE, "application/octet-stream")];
    Ok((kind, Bytes::from(bytes)).into_response())
}
