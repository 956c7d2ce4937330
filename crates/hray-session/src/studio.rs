//! A session with threads beside it: messages are answered while scenes are evaluated and pictures rendered, and what is no longer
//! wanted is stopped.

mod film;
mod worker;

use crate::protocol::{Event, Message, Refusal, Request, View, answer, file_message};
use crate::scene::Work;
use crate::session::Session;
use serde_json::json;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::thread::{self, JoinHandle};
use worker::{Desk, Job};

/// What goes to the page.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outgoing {
    /// A message in JSON.
    Text(String),
    /// A binary message.
    Binary(Vec<u8>),
}

/// Where messages to the page go. It may take its time, which holds the renders back; false where the page is gone.
pub(crate) type Sink = Arc<dyn Fn(Outgoing) -> bool + Send + Sync>;

/// A session that answers one page.
pub struct Studio {
    session: Session,
    view: Option<View>,
    desk: Arc<Desk>,
    threads: Vec<JoinHandle<()>>,
    send: Sink,
}

impl std::fmt::Debug for Studio {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Studio").field("session", &self.session).finish_non_exhaustive()
    }
}

impl Studio {
    /// Starts the threads, `renderers` of which render. They end with the value.
    #[must_use]
    pub fn new(
        session: Session,
        renderers: usize,
        send: impl Fn(Outgoing) -> bool + Send + Sync + 'static,
    ) -> Self {
        let (desk, send): (_, Sink) = (Arc::new(Desk::default()), Arc::new(send));
        let renders = (desk.clone(), send.clone());
        let watches = desk.clone();
        let threads = vec![
            thread::spawn(move || worker::work(&renders.0, renderers.max(1), &renders.1)),
            thread::spawn(move || watches.watch()),
        ];
        Self { session, view: None, desk, threads, send }
    }

    /// Takes a message in and answers it. False where the page is gone.
    pub fn message(&mut self, text: &str) -> bool {
        let message = match Message::read(text) {
            Ok(message) => message,
            Err(refusal) => {
                return self.tell(json!({ "event": "unreadable", "message": refusal.message }).to_string());
            }
        };
        let id = message.id;
        let answered = match message.request {
            Err(refusal) => Err(refusal),
            Ok(request) => {
                // A mistake of ours must not take the texts of the page with it.
                let answered = catch_unwind(AssertUnwindSafe(|| self.request(id, request)));
                answered.unwrap_or_else(|_| Err(Refusal::new("the engine made a mistake with this request")))
            }
        };
        match answered {
            Ok(None) => true,
            Ok(Some(value)) => self.tell(answer(id, &Ok(value))),
            Err(refusal) => self.tell(answer(id, &Err(refusal))),
        }
    }

    /// Looks at the disk again, where files at `paths` were touched, and tells what changed.
    pub fn refresh(&mut self, paths: &[String]) -> bool {
        let files = Event::Files { files: self.session.list() };
        let changed = self.session.refresh();
        if paths.iter().any(|path| self.session.concerns(path)) {
            self.show();
        }
        let disk = changed.into_iter().map(|(path, now)| Event::Disk { path, now });
        std::iter::once(files).chain(disk).all(|event| self.tell(event.message()))
    }

    fn tell(&self, text: String) -> bool {
        (self.send)(Outgoing::Text(text))
    }

    /// The answer; none where another thread gives it.
    fn request(&mut self, id: u64, request: Request) -> Result<Option<serde_json::Value>, Refusal> {
        match request {
            Request::View(view) => {
                self.view = Some(view);
                self.show();
                Ok(Some(json!({})))
            }
            Request::Stop {} => {
                self.desk.stop();
                Ok(Some(json!({})))
            }
            Request::RenderFile { of, time, format } => {
                let work = self.work_at(&of.doc, time)?;
                worker::aside(id, self.desk.clone(), self.send.clone(), move |control| {
                    let file = work.file(&format, control)?;
                    Ok((json!({ "name": file.name, "mime": file.mime }), Some(file_message(id, &file.bytes))))
                })?;
                Ok(None)
            }
            Request::Explain { of, x, y, time } => {
                let work = self.work_at(&of.doc, time)?;
                worker::aside(id, self.desk.clone(), self.send.clone(), move |control| {
                    Ok((work.explain(x, y, control)?, None))
                })?;
                Ok(None)
            }
            Request::Edit { ref doc, .. } => {
                let doc = doc.clone();
                let answered = self.session.answer(&request)?;
                let shown = self.view.as_ref().is_some_and(|view| view.doc == doc);
                if shown {
                    self.show();
                } else {
                    self.check(&doc);
                }
                Ok(Some(answered))
            }
            Request::Close { ref doc } => {
                if self.view.as_ref().is_some_and(|view| view.doc == *doc) {
                    self.view = None;
                    self.desk.stop();
                }
                self.session.answer(&request).map(Some)
            }
            request => self.session.answer(&request).map(Some),
        }
    }

    /// A document at a moment, with the definitions replaced that are replaced in what is shown.
    fn work_at(&self, doc: &str, time: f64) -> Result<Work, Refusal> {
        let view = self.view.as_ref().filter(|view| view.doc == doc);
        let overrides = view.map(|view| view.overrides.clone()).unwrap_or_default();
        let view = View { doc: doc.to_owned(), time, overrides, ..View::default() };
        self.session.work(&view).ok_or_else(|| Refusal::new(format!("{doc:?} is not open")))
    }

    /// Evaluates and renders what is to be shown.
    fn show(&self) {
        let Some(view) = &self.view else { return };
        if let Some(work) = self.session.work(view) {
            self.desk.post(Job { work, size: view.size(), render: true });
        }
    }

    /// Evaluates a document that is not shown, to tell what is wrong with it. Where something is shown that may depend on it,
    /// that is shown anew, too.
    fn check(&self, doc: &str) {
        let view = View { doc: doc.to_owned(), ..View::default() };
        if let Some(work) = self.session.work(&view) {
            self.desk.post_check(Job { work, size: Ok(None), render: false });
        }
        self.show();
    }
}

impl Drop for Studio {
    fn drop(&mut self) {
        self.desk.close();
        for thread in self.threads.drain(..) {
            // It holds nothing that is needed any more, whether it ended well or not.
            let _ = thread.join();
        }
    }
}
