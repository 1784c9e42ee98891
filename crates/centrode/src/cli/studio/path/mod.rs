//! The page on which a machine is made from a path: what it asks for, and the answers.

mod answer;
mod drawing;
mod field;
mod made;
mod opened;
mod sought;
mod stages;
mod wish;

use axum::response::{Html, IntoResponse as _, Response};
use axum::routing::{get, post};
use axum::{Json, Router};
use serde::Serialize;

use super::routes::{Refused, computed};
use crate::export::page;

/// Every address of the page, below that of the start page.
pub(crate) fn routes<S: Clone + Send + Sync + 'static>() -> Router<S> {
    Router::new()
        .route("/path", get(async || Html(page::PATH)))
        .route("/path/solve", post(solve))
        .route("/path/find", post(find))
        .route("/path/map", post(map))
        .route("/path/axis", post(axis))
        .route("/path/open", post(open))
        .route("/path/machine", post(machine))
}

/// Machine of a path and an axis, or why there is none.
async fn solve(Json(ask): Json<wish::Wish>) -> Result<Response, Refused> {
    answered(move || answer::Answer::new(&ask)).await
}

/// Machine of key poses, or of the working part of a path.
async fn find(Json(ask): Json<sought::Sought>) -> Result<Response, Refused> {
    answered(move || told(answer::Answer::found(&ask))).await
}

/// Possible axes about a path.
async fn map(Json(ask): Json<field::Ask>) -> Result<Response, Refused> {
    answered(move || told(field::Field::new(&ask))).await
}

/// The best axis about a path.
async fn axis(Json(ask): Json<field::Best>) -> Result<Response, Refused> {
    answered(move || told(field::best(&ask))).await
}

/// Points of a file.
async fn open(Json(ask): Json<super::routes::Text>) -> Result<Response, Refused> {
    answered(move || told(opened::points(&ask.text))).await
}

/// Design of the machine, with sound teeth.
async fn machine(Json(ask): Json<made::Ask>) -> Result<Response, Refused> {
    answered(move || told(made::machine(&ask))).await
}

/// Computes an answer for as long as somebody waits for it.
async fn answered<T: Serialize + Send + 'static>(
    job: impl FnOnce() -> T + Send + 'static,
) -> Result<Response, Refused> {
    Ok(Json(computed(job).await?).into_response())
}

/// Answer, or the reason why there is none. That is no failure: browsers would log it as one.
#[derive(Serialize)]
#[serde(untagged)]
enum Told<T> {
    Found(T),
    Refused { refused: String },
}

fn told<T>(found: Result<T, String>) -> Told<T> {
    match found {
        Ok(found) => Told::Found(found),
        Err(refused) => Told::Refused { refused },
    }
}
