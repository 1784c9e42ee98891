use std::collections::VecDeque;
use std::sync::atomic::Ordering;
use std::time::Duration;

use axum::Router;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use tokio::net::{TcpListener, TcpStream};
use tokio::task::AbortHandle;

use super::guard::Known;

/// Time a client has to send its request.
const PATIENCE: Duration = Duration::from_secs(5);

/// Maximum number of connections that have not shown the secret yet.
const STRANGERS: usize = 128;

/// Answers connections for ever.
///
/// Of those that have not shown the secret only so many are stored, the oldest go first: however many slow
/// clients there are, the page gets in.
pub(crate) async fn serve(listener: TcpListener, page: Router) {
    let mut strangers: VecDeque<(Known, AbortHandle)> = VecDeque::new();
    loop {
        let stream = match listener.accept().await {
            Ok((stream, _)) => stream,
            Err(_) => {
                // No room for another connection, or it has gone again; room comes back with time.
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
    // Answers are small and requested one by one: waiting to fill a packet only costs time.
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
