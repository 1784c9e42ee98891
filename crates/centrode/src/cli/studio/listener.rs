use std::collections::VecDeque;
use std::sync::atomic::Ordering;
use std::time::Duration;

use axum::Router;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use tokio::net::{TcpListener, TcpStream};
use tokio::task::AbortHandle;

use super::guard::Known;

/// Time in which a client must send its request.
const PATIENCE: Duration = Duration::from_secs(5);

/// Maximum number of connections that have not used the secret address yet.
const STRANGERS: usize = 128;

/// Answers connections for ever.
///
/// Only [`STRANGERS`] connections that have not used the secret address stay open; the oldest are closed first. So the page can
/// connect even if there are many slow clients.
pub(crate) async fn serve(listener: TcpListener, page: Router) {
    let mut strangers: VecDeque<(Known, AbortHandle)> = VecDeque::new();
    loop {
        let stream = match listener.accept().await {
            Ok((stream, _)) => stream,
            Err(_) => {
                // There is no room for another connection, or the client has closed it; a retry after a short time can succeed.
                tokio::time::sleep(Duration::from_millis(20)).await;
                continue;
            }
        };
        let known = Known::default();
        let task = tokio::spawn(connection(stream, page.clone(), known.clone()));
        strangers.retain(|(known, task)| !task.is_finished() && !known.0.load(Ordering::Relaxed));
        strangers.push_back((known, task.abort_handle()));
        if strangers.len() > STRANGERS
            && let Some((_, oldest)) = strangers.pop_front()
        {
            oldest.abort();
        }
    }
}

async fn connection(stream: TcpStream, page: Router, known: Known) {
    // Answers are small and requested one by one: waiting for a full packet would only delay them.
    let _ = stream.set_nodelay(true);
    let service = tower_service(page, known);
    let served = hyper::server::conn::http1::Builder::new()
        .timer(TokioTimer::new())
        .header_read_timeout(PATIENCE)
        .max_headers(64)
        .serve_connection(TokioIo::new(stream), service)
        .await;
    // A client may break off at any time.
    drop(served);
}

fn tower_service(page: Router, known: Known) -> TowerToHyperService<Router> {
    TowerToHyperService::new(page.layer(axum::Extension(known)))
}
