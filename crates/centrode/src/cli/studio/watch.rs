use std::convert::Infallible;
use std::sync::Arc;
use std::time::Duration;

use axum::response::sse::{Event, KeepAlive, Sse};
use futures_util::stream::{Stream, unfold};
use serde_json::json;
use tokio::sync::watch::{Receiver, Sender};

use super::StudioState;
use super::document::Disk;

/// Time between two reads of the file.
const PERIOD: Duration = Duration::from_millis(500);

/// Watch over the file: it reports changes on disk without a request of the page.
pub(crate) struct Watch(Sender<Option<Disk>>);

impl Default for Watch {
    fn default() -> Self {
        Self(Sender::new(None))
    }
}

impl Watch {
    /// Events from now on; the first one contains the present state.
    pub(crate) fn events(&self) -> Sse<impl Stream<Item = Result<Event, Infallible>> + use<>> {
        let mut receiver = self.0.subscribe();
        receiver.mark_changed();
        let events = unfold(
            receiver,
            |mut receiver: Receiver<Option<Disk>>| async move {
                receiver.changed().await.ok()?;
                let disk = receiver.borrow_and_update().clone();
                let data = json!(disk).to_string();
                Some((Ok(Event::default().event("disk").data(data)), receiver))
            },
        );
        Sse::new(events).keep_alive(KeepAlive::default())
    }
}

/// Reads the file again and again, and reports its text whenever it has changed.
pub(crate) async fn disk(state: Arc<StudioState>) {
    loop {
        let now = Some(state.document.disk());
        state.watch.0.send_if_modified(|last| {
            let news = *last != now;
            *last = now;
            news
        });
        tokio::time::sleep(PERIOD).await;
    }
}
