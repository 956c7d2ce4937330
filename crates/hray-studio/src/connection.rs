//! One page that is open.

use axum::extract::ws::{Message, WebSocket};
use futures_util::{SinkExt, StreamExt};
use hray_session::{Outgoing, Session, Studio};
use std::sync::Arc;
use tokio::sync::{broadcast, mpsc};

/// Messages that wait on their way in, and on their way out. Who sends faster waits.
const WAITING_IN: usize = 32;
const WAITING_OUT: usize = 64;

/// What the page's thread is told.
enum Incoming {
    Message(String),
    /// Files at these paths were touched.
    Touched(Vec<String>),
}

/// Answers a page until it is closed.
pub(crate) async fn serve(
    socket: WebSocket,
    session: Session,
    renderers: usize,
    mut touched: broadcast::Receiver<Arc<[String]>>,
) {
    let (mut sink, mut stream) = socket.split();
    let (incoming, mut inbox) = mpsc::channel(WAITING_IN);
    let (outgoing, mut outbox) = mpsc::channel(WAITING_OUT);
    std::thread::spawn(move || {
        let send = move |message: Outgoing| outgoing.blocking_send(message).is_ok();
        let mut studio = Studio::new(session, renderers, send);
        while let Some(message) = inbox.blocking_recv() {
            let goes_on = match message {
                Incoming::Message(text) => studio.message(&text),
                Incoming::Touched(paths) => studio.refresh(&paths),
            };
            if !goes_on {
                return;
            }
        }
    });
    let from_disk = incoming.clone();
    let disk = tokio::spawn(async move {
        loop {
            let paths = match touched.recv().await {
                Ok(paths) => paths.to_vec(),
                // Some were missed; open files are looked at in any case.
                Err(broadcast::error::RecvError::Lagged(_)) => Vec::new(),
                Err(broadcast::error::RecvError::Closed) => return,
            };
            if from_disk.send(Incoming::Touched(paths)).await.is_err() {
                return;
            }
        }
    });
    let writer = tokio::spawn(async move {
        while let Some(message) = outbox.recv().await {
            let message = match message {
                Outgoing::Text(text) => Message::Text(text.into()),
                Outgoing::Binary(bytes) => Message::Binary(bytes.into()),
            };
            if sink.send(message).await.is_err() {
                return;
            }
        }
    });
    while let Some(Ok(message)) = stream.next().await {
        match message {
            Message::Text(text) => {
                if incoming.send(Incoming::Message(text.as_str().to_owned())).await.is_err() {
                    break;
                }
            }
            Message::Close(_) => break,
            // Pages send texts; pings are answered by the library.
            Message::Binary(_) | Message::Ping(_) | Message::Pong(_) => {}
        }
    }
    // The thread ends when nobody can write to it, and its renders when nobody reads what they send.
    disk.abort();
    writer.abort();
}
