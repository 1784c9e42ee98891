use super::document::SaveError;
use super::guard::{self, Guard};
use super::solver::{Depth, Unsolved};
use super::{StudioState, files, meshes};
use crate::cli::export;
use crate::geometry::Cancel;
use crate::page::{self, Edit, Fault, Gesture, composed, edited, response, search};
use crate::{FAMILIES, InternalFault};
use axum::body::{Body, Bytes};
use axum::extract::{Path, State};
use axum::http::{StatusCode, header};
use axum::response::{Html, IntoResponse, Response};
use axum::routing::{delete, get, post};
use axum::{Json, Router};
use centrode_synthesis::optimise::{NotSearched, Strategy};
use futures_util::stream::unfold;
use serde::Deserialize;
use serde_json::json;
use std::convert::Infallible;
use std::sync::Arc;
use std::time::Duration;
use tower_http::limit::RequestBodyLimitLayer;
use tower_http::timeout::RequestBodyTimeoutLayer;

/// Largest body of a request: a design file at its largest, as JSON, and some edits.
const LARGEST: usize = 4 << 20;

/// Maximum time between two parts of a body.
const PATIENCE: Duration = Duration::from_secs(10);

type Shared = State<Arc<StudioState>>;

/// All addresses of the page of a design, relative to the page's own address.
pub(crate) fn design_page(state: Arc<StudioState>) -> Router {
    let page = Router::new()
        .route("/{asset}", get(asset))
        .route("/design", get(design))
        .route(
            "/events",
            get(async |State(state): Shared| state.watch.events()),
        )
        .route("/solve", post(solve))
        .route("/compose", post(compose))
        .route("/table", post(table))
        .route("/progress/{page}", get(progress))
        .route("/fault", post(fault))
        .route("/save", post(save))
        .route("/keep", post(keep).delete(forget))
        .route("/reread", post(reread))
        .route("/export", post(files::answer))
        .route("/choices", post(choices))
        .route("/meshes", post(meshes::answer))
        .route("/search", get(searched).post(searching).delete(unsearched))
        .route("/search/all", delete(forgotten))
        .route("/response", post(respond));
    limited(page).with_state(state)
}

/// Limits the size of a request, and the time in which it must be sent.
pub(crate) fn limited<S: Clone + Send + Sync + 'static>(page: Router<S>) -> Router<S> {
    page.layer(RequestBodyTimeoutLayer::new(PATIENCE))
        .layer(RequestBodyLimitLayer::new(LARGEST))
}

/// A page below its secret address, which returns `index`.
pub(crate) fn guarded(index: &'static str, page: Router, guard: Guard) -> Router {
    let base = guard.base();
    Router::new()
        // `nest` makes no route for the slash at the end of the page's own address.
        .route(&format!("{base}/"), get(async move || Html(index)))
        .nest(&base, page)
        .layer(axum::middleware::from_fn_with_state(guard, guard::pass))
}

/// Answer to a request that is refused.
pub(crate) struct Refused(StatusCode, serde_json::Value);

impl Refused {
    pub(crate) fn because(status: StatusCode, reason: impl ToString) -> Self {
        Self(status, json!({ "message": reason.to_string() }))
    }
}

impl IntoResponse for Refused {
    fn into_response(self) -> Response {
        (self.0, Json(self.1)).into_response()
    }
}

impl From<SaveError> for Refused {
    fn from(error: SaveError) -> Self {
        let message = error.to_string();
        match error {
            SaveError::Changed { .. } | SaveError::Missing { .. } => {
                Self::because(StatusCode::CONFLICT, message)
            }
            SaveError::Bundle(_) => Self::because(StatusCode::INSUFFICIENT_STORAGE, message),
            SaveError::TooLarge { .. } => Self::because(StatusCode::PAYLOAD_TOO_LARGE, message),
        }
    }
}

/// Answer with JSON text that is already written.
pub(crate) fn as_json(text: impl IntoResponse) -> Response {
    ([(header::CONTENT_TYPE, "application/json")], text).into_response()
}

pub(crate) async fn asset(Path(name): Path<String>) -> Response {
    match page::asset(&name) {
        Some(asset) => ([(header::CONTENT_TYPE, asset.media_type)], asset.text).into_response(),
        None => match page::packed(&name) {
            Some(packed) => (
                [
                    (header::CONTENT_TYPE, packed.media_type),
                    (header::CONTENT_ENCODING, "gzip"),
                ],
                packed.gzip,
            )
                .into_response(),
            None => StatusCode::NOT_FOUND.into_response(),
        },
    }
}

async fn design(State(state): Shared) -> Response {
    let document = &state.document;
    Json(json!({
        "file": document.name(),
        "text": document.text(),
        "recovered": document.recovered(),
        "formats": files::formats(),
        "purposes": files::purposes(),
        "methods": Strategy::NAMES.map(|(name, _)| name),
        "unsearched": unsearchable(&document.text()),
        "started": state.started,
    }))
    .into_response()
}

/// Reason why there is no search for designs of this family; null if there is one.
fn unsearchable(text: &str) -> Option<String> {
    let file = FAMILIES.read(text.as_bytes()).ok()?;
    match file.family().problem(file.design()) {
        Err(reason @ NotSearched::Family) => Some(reason.to_string()),
        _ => None,
    }
}

#[derive(Deserialize)]
struct Solve {
    /// Identifier of the open page that made the request: the next request of this page replaces this one.
    #[serde(default)]
    page: String,
    /// Number of requests that the page has made before.
    #[serde(default)]
    turn: u64,
    text: String,
    #[serde(default)]
    edits: Vec<Edit>,
    depth: Depth,
}

async fn solve(State(state): Shared, Json(ask): Json<Solve>) -> Result<Response, Refused> {
    let text = if ask.edits.is_empty() {
        ask.text
    } else {
        // Edits may take long, because a new kind is tested.
        let made = apart(move || edited(&ask.text, &ask.edits)).await?;
        made.map_err(|error| Refused::because(StatusCode::UNPROCESSABLE_ENTITY, error))?
    };
    let shared = Arc::clone(&state);
    let text = apart(move || shared.document.with_files(text)).await?;
    match state
        .solver
        .solve(&ask.page, ask.turn, text, ask.depth)
        .await
    {
        Ok(answer) => {
            let parts = unfold(answer, |mut answer| async move {
                let part: Result<Bytes, Infallible> = Ok(answer.next().await?.into());
                Some((part, answer))
            });
            Ok(as_json(Body::from_stream(parts)))
        }
        // A replaced request is not answered as a failure, because browsers would log it.
        Err(Unsolved::Overtaken) => Ok(Json(json!({ "overtaken": true })).into_response()),
        Err(fault) => Err(Refused::because(StatusCode::INTERNAL_SERVER_ERROR, fault)),
    }
}

#[derive(Deserialize)]
struct Compose {
    text: String,
    /// Input at which the picture is shown, rad.
    input: f64,
    gesture: Gesture,
}

/// Text with a part that was added or changed by clicks; or the reason why it is not, which is no failure of the request.
async fn compose(Json(ask): Json<Compose>) -> Result<Response, Refused> {
    let made = computed(move || composed(&ask.text, ask.input, &ask.gesture)).await?;
    Ok(match made {
        Ok(made) => Json(made).into_response(),
        Err(refusal) => Json(refusal).into_response(),
    })
}

#[derive(Deserialize)]
struct AddTable {
    text: String,
    key: String,
}

/// Text with a table that was not in the design; or the reason why it is not added.
async fn table(Json(ask): Json<AddTable>) -> Result<Response, Refused> {
    let made = computed(move || page::with_table(&ask.text, &ask.key)).await?;
    Ok(Json(match made {
        Ok(text) => json!({ "text": text }),
        Err(reason) => json!({ "refused": reason }),
    })
    .into_response())
}

/// Share of the checks of a page that is done; null while nothing is solved for it.
async fn progress(State(state): Shared, Path(page): Path<String>) -> Response {
    Json(json!({ "share": state.solver.share(&page) })).into_response()
}

#[derive(Deserialize)]
pub(crate) struct Text {
    pub(crate) text: String,
}

/// Reason why a text does not read as a design; null if it does.
async fn fault(State(state): Shared, Json(ask): Json<Text>) -> Result<Response, Refused> {
    let fault = apart(move || {
        let whole = state.document.with_files(ask.text).whole;
        whole.and_then(|text| FAMILIES.read(text.as_bytes())).err()
    });
    let fault = fault.await?;
    Ok(Json(json!({ "fault": fault.as_ref().map(Fault::from) })).into_response())
}

#[derive(Deserialize)]
struct Save {
    text: String,
    /// Text that the page believes to be in the file.
    base: String,
    /// Whether a file with another text is overwritten.
    #[serde(default)]
    over: bool,
}

async fn save(State(state): Shared, Json(ask): Json<Save>) -> Result<Response, Refused> {
    match apart(move || state.document.save(&ask.text, &ask.base, ask.over)).await? {
        Ok(()) => Ok(Json(json!({ "saved": true })).into_response()),
        // The page asks the user in these cases: they are no failures.
        Err(error @ (SaveError::Changed { .. } | SaveError::Missing { .. })) => {
            let gone = matches!(error, SaveError::Missing { .. });
            let message = error.to_string();
            let answer = json!({ "saved": false, "message": message, "gone": gone });
            Ok(Json(answer).into_response())
        }
        Err(error) => Err(error.into()),
    }
}

async fn keep(State(state): Shared, Json(ask): Json<Text>) -> Result<Response, Refused> {
    on_disk(move || state.document.keep(&ask.text)).await
}

#[derive(Deserialize)]
struct Forget {
    /// Name of an autosave, as in the answer of `design`.
    file: String,
}

async fn forget(State(state): Shared, Json(ask): Json<Forget>) -> Result<Response, Refused> {
    on_disk(move || {
        state.document.forget(&ask.file);
        Ok(())
    })
    .await
}

async fn reread(State(state): Shared) -> Result<Response, Refused> {
    let text = apart(move || state.document.reread()).await??;
    Ok(Json(json!({ "text": text })).into_response())
}

/// Waits for the disk without blocking other requests.
async fn on_disk(
    job: impl FnOnce() -> Result<(), SaveError> + Send + 'static,
) -> Result<Response, Refused> {
    apart(job).await??;
    Ok(Json(json!({})).into_response())
}

pub(crate) async fn apart<T: Send + 'static>(
    job: impl FnOnce() -> T + Send + 'static,
) -> Result<T, Refused> {
    let done = tokio::task::spawn_blocking(job).await;
    done.map_err(|_| Refused::because(StatusCode::INTERNAL_SERVER_ERROR, InternalFault))
}

/// Guard that cancels the work when it is dropped: nobody waits for the answer any more.
#[derive(Default)]
pub(crate) struct Wait(Cancel);

impl Wait {
    pub(crate) fn cancel(&self) -> Cancel {
        self.0.clone()
    }
}

impl Drop for Wait {
    fn drop(&mut self) {
        self.0.cancel();
    }
}

/// Computes without blocking other requests; the work is cancelled once nobody waits for it.
pub(crate) async fn computed<T: Send + 'static>(
    job: impl FnOnce() -> T + Send + 'static,
) -> Result<T, Refused> {
    let wait = Wait::default();
    let cancel = wait.cancel();
    let done = apart(move || cancel.run(job)).await?;
    done.map_err(|cancelled| Refused::because(StatusCode::INTERNAL_SERVER_ERROR, cancelled))
}

/// Starts a search for a better design.
async fn searching(
    State(state): Shared,
    Json(ask): Json<search::Ask>,
) -> Result<Response, Refused> {
    let started = computed(move || {
        let whole = state.document.with_files(ask.text.clone()).whole;
        let whole = whole.map_err(|error| error.message())?;
        state.searching.start(ask, whole)
    });
    let started = started.await?;
    started.map_err(|reason| Refused::because(StatusCode::UNPROCESSABLE_ENTITY, reason))?;
    Ok(Json(json!({})).into_response())
}

/// Progress of the search; null before the first.
async fn searched(State(state): Shared) -> Response {
    Json(state.searching.state()).into_response()
}

async fn unsearched(State(state): Shared) -> Response {
    state.searching.dismiss();
    Json(json!({})).into_response()
}

/// Forgets the search of a design that is no longer shown.
async fn forgotten(State(state): Shared) -> Response {
    state.searching.forget();
    Json(json!({})).into_response()
}

/// Response of the goals to one number.
async fn respond(
    State(state): Shared,
    Json(mut ask): Json<response::Ask>,
) -> Result<Response, Refused> {
    let answers = computed(move || {
        let whole = state.document.with_files(ask.text).whole;
        ask.text = whole.map_err(|error| error.message())?;
        response::answers(&ask)
    });
    let answers = answers.await?;
    let answers =
        answers.map_err(|reason| Refused::because(StatusCode::UNPROCESSABLE_ENTITY, reason))?;
    Ok(Json(answers).into_response())
}

/// Choices that depend on the design: parts that can be exported alone, and the reason if there is no search.
async fn choices(State(state): Shared, Json(ask): Json<Text>) -> Result<Response, Refused> {
    let found = computed(move || {
        let whole = state
            .document
            .with_files(ask.text)
            .whole
            .unwrap_or_default();
        let parts = FAMILIES.read(whole.as_bytes()).and_then(|file| {
            let mechanism = file.mechanism()?;
            Ok(export::parts(mechanism.as_ref(), file.family()))
        });
        json!({
            "parts": parts.unwrap_or_default(),
            "unsearched": unsearchable(&whole),
        })
    });
    Ok(Json(found.await?).into_response())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_in_a_request_is_answered_in_plain_words() {
        let runtime = tokio::runtime::Builder::new_current_thread().build();
        runtime.expect("a runtime").block_on(async {
            let refused = |done: Result<(), Refused>| done.expect_err("refused");
            for Refused(status, body) in [
                refused(apart(|| panic!("index out of bounds")).await),
                refused(computed(|| panic!("min > max")).await),
            ] {
                assert_eq!(status, StatusCode::INTERNAL_SERVER_ERROR);
                assert_eq!(body, json!({ "message": InternalFault.to_string() }));
            }
        });
    }
}
