use std::convert::Infallible;
use std::time::Duration;

use axum::response::sse::{Event, KeepAlive, Sse};
use futures_util::stream::{Stream, unfold};
use serde_json::json;
use tokio::sync::watch::{Receiver, Sender};

use super::Desk;
use super::document::Disk;

/// Time between two looks at the file.
const PERIOD: Duration = Duration::from_millis(500);

/// What happens without the page asking: the file changes on disk.
pub(crate) struct Watch(Sender<Option<Disk>>);

impl Default for Watch {
    fn default() -> Self {
        Self(Sender::new(None))
    }
}

impl Watch {
    /// The events from now on; the first says how things stand.
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

/// Looks at the file for ever, and tells what it holds whenever that is something else.
pub(crate) async fn disk(desk: &Desk) {
    loop {
        let now = Some(desk.document.disk());
        desk.watch.0.send_if_modified(|told| {
            let news = *told != now;
            *told = now;
            news
        });
        tokio::time::sleep(PERIOD).await;
    }
}
