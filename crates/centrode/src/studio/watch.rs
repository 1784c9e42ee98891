use std::convert::Infallible;
use std::time::Duration;

use axum::response::sse::{Event, KeepAlive, Sse};
use futures_util::stream::{Stream, unfold};
use serde_json::json;
use tokio::sync::watch::{Receiver, Sender};

use super::Desk;

/// Time between two looks at the file.
const PERIOD: Duration = Duration::from_millis(500);

/// What happens without the page asking: the file changes on disk.
pub(crate) struct Watch(Sender<Option<String>>);

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
            |mut receiver: Receiver<Option<String>>| async move {
                receiver.changed().await.ok()?;
                let text = receiver.borrow_and_update().clone();
                let data = json!({ "text": text }).to_string();
                Some((Ok(Event::default().event("disk").data(data)), receiver))
            },
        );
        Sse::new(events).keep_alive(KeepAlive::default())
    }
}

/// Looks at the file for ever, and tells what it holds when that is not what is known.
pub(crate) async fn disk(desk: &Desk) {
    loop {
        tokio::time::sleep(PERIOD).await;
        let changed = desk.document.changed();
        desk.watch.0.send_if_modified(|told| {
            let news = *told != changed;
            *told = changed;
            news
        });
    }
}
