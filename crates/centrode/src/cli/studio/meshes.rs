use std::sync::Arc;

use axum::Json;
use axum::body::Bytes;
use axum::extract::State;
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};

use super::StudioState;
use super::routes::{Refused, Text, computed};
use crate::geometry::Tolerance;
use crate::page;

/// Meshes of a design as `export` writes them by default, and their poses at the picture's inputs.
pub(crate) async fn answer(
    State(state): State<Arc<StudioState>>,
    Json(ask): Json<Text>,
) -> Result<Response, Refused> {
    let made = computed(move || {
        let whole = state.document.with_files(ask.text).whole;
        page::meshes(
            &whole.map_err(|error| error.message())?,
            Tolerance::MICROMETRE,
        )
    });
    let bytes = made
        .await?
        .map_err(|reason| Refused::because(StatusCode::UNPROCESSABLE_ENTITY, reason))?;
    let kind = [(header::CONTENT_TYPE, "application/octet-stream")];
    Ok((kind, Bytes::from(bytes)).into_response())
}
