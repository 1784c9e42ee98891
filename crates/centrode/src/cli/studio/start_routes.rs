use std::path::PathBuf;
use std::sync::Arc;

use axum::body::Body;
use axum::extract::{Path, Request, State};
use axum::http::{StatusCode, Uri};
use axum::response::{Html, IntoResponse, Response};
use axum::routing::{any, get, post};
use axum::{Json, Router};
use hyper::service::Service as _;
use hyper_util::service::TowerToHyperService;
use serde::Deserialize;
use serde_json::json;

use super::routes::{Refused, apart, as_json, asset, computed, limited};
use super::start::{OpenError, Pattern, StartPage};
use crate::page;
use crate::page::drawn;

type Shared = State<Arc<StartPage>>;

/// All addresses of the start page, and of the design pages opened from it.
pub(crate) fn start_page(state: Arc<StartPage>) -> Router {
    let page = Router::new()
        .route("/{asset}", get(asset))
        .route("/start", get(offer))
        .route("/pictures/{kind}/{name}", get(picture))
        .route("/open", post(open))
        .route("/new", post(make))
        .route("/designs/{number}/", any(design))
        .route("/designs/{number}/{*rest}", any(design))
        .merge(super::path::routes());
    limited(page).with_state(state)
}

async fn offer(State(state): Shared) -> Result<Response, Refused> {
    let offer = apart(move || state.offer()).await?;
    Ok(Json(offer).into_response())
}

/// Picture of a shipped design or of a template, as the design page draws it first.
async fn picture(Path((kind, name)): Path<(String, String)>) -> Result<Response, Refused> {
    let pattern = match kind.as_str() {
        "shipped" => Pattern::Shipped(name),
        _ => Pattern::New(name),
    };
    let picture = computed(move || pattern.text().map(drawn)).await?;
    let picture =
        picture.ok_or_else(|| Refused::because(StatusCode::NOT_FOUND, OpenError::Pattern))?;
    let picture =
        picture.map_err(|reason| Refused::because(StatusCode::INTERNAL_SERVER_ERROR, reason))?;
    Ok(as_json(picture))
}

#[derive(Deserialize)]
struct Open {
    path: PathBuf,
}

async fn open(State(state): Shared, Json(ask): Json<Open>) -> Result<Response, Refused> {
    Ok(answer(apart(move || state.open(&ask.path)).await?))
}

#[derive(Deserialize)]
struct Make {
    from: Pattern,
    path: PathBuf,
}

async fn make(State(state): Shared, Json(ask): Json<Make>) -> Result<Response, Refused> {
    Ok(answer(
        apart(move || state.make(&ask.from, &ask.path)).await?,
    ))
}

/// Address of a design page, relative to that of the start page. A bad path is not answered as a failure, because browsers would
/// log it.
fn answer(opened: Result<usize, OpenError>) -> Response {
    let answer = match opened {
        Ok(number) => json!({ "page": format!("designs/{number}/") }),
        Err(error) => json!({ "refused": error.to_string() }),
    };
    Json(answer).into_response()
}

/// Passes a request on to the page of a design.
async fn design(State(state): Shared, request: Request) -> Response {
    let path = request.uri().path().to_owned();
    let mut steps = path.splitn(4, '/').skip(2);
    let page = steps
        .next()
        .and_then(|number| state.page(number.parse().ok()?));
    let rest = steps.next().unwrap_or_default();
    let (Some(page), Ok(uri)) = (page, format!("/{rest}").parse::<Uri>()) else {
        return StatusCode::NOT_FOUND.into_response();
    };
    if rest.is_empty() {
        return Html(page::INDEX).into_response();
    }
    // The new request has none of the extensions that the outer routes have added.
    let (parts, body) = request.into_parts();
    let mut own = Request::new(Body::new(body));
    *own.method_mut() = parts.method;
    *own.uri_mut() = uri;
    *own.headers_mut() = parts.headers;
    match TowerToHyperService::new(page).call(own).await {
        Ok(response) => response,
        Err(never) => match never {},
    }
}
