//! The page that makes a machine from a path: its requests and answers.

mod stream;

use super::routes::{Refused, computed};
use crate::page::path::{self, Answer, Cached, Wish, field};
use crate::page::{self};
use axum::extract::State;
use axum::response::{Html, IntoResponse as _, Response};
use axum::routing::{get, post};
use axum::{Json, Router};
use centrode_spec::Design as _;
use serde::Serialize;
use stream::streamed;

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
        .route("/path/design", post(design))
        .with_state(Cached::default())
}

/// Machine of a path and an axis, or the reason why there is none.
async fn solve(Json(ask): Json<Wish>) -> Result<Response, Refused> {
    answered(move || Answer::new(&ask)).await
}

/// Machine found by a search: for key poses, for the working part of a path, or for a path with further wishes.
async fn find(State(kept): State<Cached>, Json(ask): Json<Wish>) -> Response {
    streamed(move |observe| Answer::found(&ask, &kept, observe))
}

/// Possible axes around a path.
async fn map(Json(ask): Json<field::Ask>) -> Result<Response, Refused> {
    answered(move || stated(field::Field::new(&ask))).await
}

/// The best axis around a path.
async fn axis(Json(ask): Json<field::Best>) -> Result<Response, Refused> {
    answered(move || stated(field::best(&ask))).await
}

/// Points of a file, or the whole design of a design file.
async fn open(Json(ask): Json<super::routes::Text>) -> Result<Response, Refused> {
    answered(move || stated(path::opened(&ask.text))).await
}

/// Design of the machine, with sound teeth.
async fn machine(State(kept): State<Cached>, Json(ask): Json<Wish>) -> Response {
    streamed(move |observe| path::machine(&ask, &kept, observe))
}

/// A wish as a design file that `centrode reverse` reads.
async fn design(Json(ask): Json<Wish>) -> Result<Response, Refused> {
    answered(move || {
        let text = ask.design().map(|design| design.to_toml());
        stated(text.and_then(|text| text.map_err(|error| error.message())))
    })
    .await
}

/// Computes an answer; the work is cancelled once nobody waits for it.
async fn answered<T: Serialize + Send + 'static>(
    job: impl FnOnce() -> T + Send + 'static,
) -> Result<Response, Refused> {
    Ok(Json(computed(job).await?).into_response())
}

/// Answer, or the reason why there is none. The reason is sent with the status of success, because browsers would log a failure.
#[derive(Serialize)]
#[serde(untagged)]
enum FoundOrRefused<T> {
    Found(T),
    Refused { refused: String },
}

fn stated<T>(found: Result<T, String>) -> FoundOrRefused<T> {
    match found {
        Ok(found) => FoundOrRefused::Found(found),
        Err(refused) => FoundOrRefused::Refused { refused },
    }
}
