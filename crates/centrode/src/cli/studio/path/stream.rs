//! Answers that take long: lines with the number of evaluations come first, and the answer last.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use axum::body::{Body, Bytes};
use axum::http::header;
use axum::response::{IntoResponse as _, Response};
use futures_util::stream::unfold;
use serde::Serialize;
use serde_json::json;
use tokio::sync::mpsc::unbounded_channel;

use crate::InternalFault;

use super::super::routes::Wait;
use super::stated;

/// Interval at which progress is reported.
const EVERY: Duration = Duration::from_millis(200);

/// Does a job until it ends or the client closes the connection. The response is lines of JSON: progress as
/// `{"evaluations": 300}`, and at the end the answer as `{"answer": ...}`.
pub(super) fn streamed<T: Serialize>(
    job: impl FnOnce(&mut dyn FnMut(u64) -> ControlFlow<()>) -> Result<T, String> + Send + 'static,
) -> Response {
    let wait = Wait::default();
    let cancel = wait.cancel();
    let (reported, news) = unbounded_channel::<String>();
    tokio::task::spawn_blocking(move || {
        let mut next = Instant::now() + EVERY;
        let mut observe = |evaluations: u64| {
            if Instant::now() >= next {
                next = Instant::now() + EVERY;
                let line = json!({ "evaluations": evaluations }).to_string();
                if reported.send(line).is_err() {
                    return ControlFlow::Break(());
                }
            }
            ControlFlow::Continue(())
        };
        let answer = InternalFault::catch(|| cancel.run(|| stated(job(&mut observe))));
        let line = match answer {
            Ok(Ok(answer)) => json!({ "answer": answer }),
            Ok(Err(cancelled)) => json!({ "answer": { "refused": cancelled.to_string() } }),
            Err(fault) => json!({ "answer": { "refused": fault.to_string() } }),
        };
        // The client may have closed the connection.
        let _ = reported.send(line.to_string());
    });
    let lines = unfold((news, wait), |(mut news, wait)| async move {
        let line = news.recv().await?;
        let line: Result<Bytes, std::convert::Infallible> = Ok(Bytes::from(line + "\n"));
        Some((line, (news, wait)))
    });
    let kind = [(header::CONTENT_TYPE, "application/x-ndjson")];
    (kind, Body::from_stream(lines)).into_response()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_ends_the_lines_with_an_answer_in_plain_words() {
        let runtime = tokio::runtime::Builder::new_current_thread().build();
        runtime.expect("a runtime").block_on(async {
            let response = streamed::<u32>(|_| panic!("min > max"));
            let body = axum::body::to_bytes(response.into_body(), 10_000).await;
            let line = serde_json::from_slice::<serde_json::Value>(&body.expect("a line"));
            let refused = json!({ "answer": { "refused": InternalFault.to_string() } });
            assert_eq!(line.expect("JSON"), refused);
        });
    }
}
