//! `hray lsp`: a language server on the standard input and output.
//!
//! A thin layer: what is said about a text comes from `hray::ide`, in offsets; here it is put into the words of the
//! protocol. Threads: one reads messages, one answers them (this one), one evaluates scenes after a pause in typing.
//!
//! Whatever the client sends, the server goes on: what is not understood is answered with an error, or ignored where it
//! asks for no answer.

mod answers;
mod convert;
mod document;
mod edits;
mod library;
mod position;
mod requests;
mod server;
mod transport;
mod uri;
mod worker;

use crate::failure::Failure;
use lsp_server::{ErrorCode, Message, Notification, Request, Response};
use server::Server;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::thread;
use transport::{Incoming, Output};

/// What the server waits for.
#[derive(Debug)]
pub(crate) enum Event {
    /// Something from the client.
    Incoming(Incoming),
    /// A scene was evaluated.
    Evaluated(worker::Evaluated),
}

/// Answers until the client is done.
pub(crate) fn run() -> Result<(), Failure> {
    let (events, queue) = channel();
    let from_client = events.clone();
    thread::spawn(move || transport::read_all(&mut std::io::stdin().lock(), &from_client));
    Session::new(events).serve(&queue)
}

/// How far the conversation is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Phase {
    New,
    Running,
    ShutDown,
}

struct Session {
    phase: Phase,
    output: Output,
    server: Server,
    events: Sender<Event>,
}

impl Session {
    fn new(events: Sender<Event>) -> Self {
        let output = Output::stdout();
        let server = Server::new(output.clone(), worker::start(events.clone()));
        Self { phase: Phase::New, output, server, events }
    }

    fn serve(&mut self, queue: &Receiver<Event>) -> Result<(), Failure> {
        loop {
            // What changed is looked at when there is nothing else to do, so that a burst of edits is looked at once.
            let event = match queue.try_recv() {
                Ok(event) => event,
                Err(TryRecvError::Empty) => {
                    self.guarded(Server::refresh);
                    let Ok(event) = queue.recv() else { return Ok(()) };
                    event
                }
                Err(TryRecvError::Disconnected) => return Ok(()),
            };
            match event {
                Event::Evaluated(evaluated) => self.guarded(|server| server.evaluated(evaluated)),
                Event::Incoming(Incoming::Malformed(why)) => self.output.malformed(&why),
                Event::Incoming(Incoming::Message(Message::Request(request))) => self.request(request),
                Event::Incoming(Incoming::Message(Message::Response(_))) => {}
                Event::Incoming(Incoming::Message(Message::Notification(notification))) => {
                    if notification.method == "exit" {
                        return self.end();
                    }
                    self.notification(notification);
                }
                Event::Incoming(Incoming::End) => return self.end(),
            }
        }
    }

    /// An end without a shutdown is an error, says the protocol.
    fn end(&self) -> Result<(), Failure> {
        if self.phase == Phase::ShutDown { Ok(()) } else { Err(Failure::Told) }
    }

    fn request(&mut self, request: Request) {
        let id = request.id.clone();
        let refuse = |code: ErrorCode, why: &str| Response::new_err(id.clone(), code as i32, why.to_owned());
        let response = match (self.phase, request.method.as_str()) {
            (Phase::New, "initialize") => {
                self.phase = Phase::Running;
                Response::new_ok(request.id, self.server.initialize(&request.params))
            }
            (Phase::New, _) => refuse(ErrorCode::ServerNotInitialized, "the first request is initialize"),
            (Phase::Running, "initialize") => {
                refuse(ErrorCode::InvalidRequest, "the server is initialized already")
            }
            (Phase::Running, "shutdown") => {
                self.phase = Phase::ShutDown;
                Response::new_ok(request.id, serde_json::Value::Null)
            }
            (Phase::Running, _) => {
                let answer = catch_unwind(AssertUnwindSafe(|| self.server.request(request)));
                answer
                    .unwrap_or_else(|_| refuse(ErrorCode::InternalError, "the request could not be answered"))
            }
            (Phase::ShutDown, _) => refuse(ErrorCode::InvalidRequest, "the server is shut down"),
        };
        self.output.send(Message::Response(response));
    }

    fn notification(&mut self, notification: Notification) {
        if self.phase == Phase::Running {
            self.guarded(|server| server.notification(notification));
        }
    }

    /// A mistake of ours must not take the texts of the client with it.
    fn guarded(&mut self, action: impl FnOnce(&mut Server)) {
        if catch_unwind(AssertUnwindSafe(|| action(&mut self.server))).is_err() {
            self.server.restart_worker(worker::start(self.events.clone()));
        }
    }
}
