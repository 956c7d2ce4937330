//! A page, as far as the studio can tell.

use hray_studio::{Options, Server};
use serde_json::{Value, json};
use std::collections::VecDeque;
use std::fs;
use std::io::{Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::time::{Duration, Instant};
use tempfile::TempDir;
use tungstenite::client::IntoClientRequest;
use tungstenite::{Message, WebSocket};

/// How long anything may take before a test gives up.
pub(crate) const PATIENCE: Duration = Duration::from_secs(60);

/// A small scene in hry.
pub(crate) const BALL: &str = "scene = {\n  size = (64, 48),\n  objects = [ sphere { center = (0, 1, 0) } ],\n  lights = [ point { position = (3, 4, 5) } ],\n}\n";

/// A studio over a folder of its own.
pub(crate) struct Studio {
    pub(crate) folder: TempDir,
    pub(crate) server: Server,
}

impl Studio {
    /// With these files.
    pub(crate) fn with(files: &[(&str, &str)]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join("open")).unwrap();
        for (path, text) in files {
            let path = folder.path().join("open").join(path);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        }
        let server = serve(&folder.path().join("open"));
        Self { folder, server }
    }

    /// The path of a file in the folder that is open.
    pub(crate) fn path(&self, path: &str) -> std::path::PathBuf {
        self.folder.path().join("open").join(path)
    }

    pub(crate) fn page(&self) -> Page {
        Page::open(&self.server)
    }

    /// The names of all files and folders, in order.
    pub(crate) fn names(&self) -> Vec<String> {
        let mut names: Vec<String> = fs::read_dir(self.folder.path().join("open"))
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }
}

/// Serves a folder at a port that the system chooses... which has to be found first, as 0 is none.
pub(crate) fn serve(folder: &Path) -> Server {
    Server::start(&Options { target: Some(folder.to_owned()), port: Some(free_port()) }).unwrap()
}

pub(crate) fn free_port() -> u16 {
    std::net::TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port()
}

/// Host, port and query of the address of a server.
pub(crate) fn parts(server: &Server) -> (String, String) {
    let rest = server.address().strip_prefix("http://").unwrap();
    let (host, query) = rest.split_once("/?").unwrap();
    (host.to_owned(), query.to_owned())
}

/// Sends a request as it is, and gives the answer.
pub(crate) fn http(server: &Server, request: &str) -> String {
    let (host, _) = parts(server);
    let mut stream = TcpStream::connect(host).unwrap();
    stream.set_read_timeout(Some(PATIENCE)).unwrap();
    stream.write_all(request.as_bytes()).unwrap();
    let mut answer = Vec::new();
    let mut buffer = [0; 4096];
    // Until the head is there; what follows is of no interest where the connection stays open.
    loop {
        let read = stream.read(&mut buffer).unwrap_or(0);
        answer.extend_from_slice(&buffer[..read]);
        if read == 0 || answer.windows(4).any(|end| end == b"\r\n\r\n") && read < buffer.len() {
            return String::from_utf8_lossy(&answer).into_owned();
        }
    }
}

/// The page's side of a connection.
pub(crate) struct Page {
    socket: WebSocket<TcpStream>,
    next: u64,
    events: VecDeque<Value>,
    /// Binary messages.
    pub(crate) binary: VecDeque<Vec<u8>>,
}

impl Page {
    pub(crate) fn open(server: &Server) -> Self {
        let (host, query) = parts(server);
        let stream = TcpStream::connect(&host).unwrap();
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        let mut request = format!("ws://{host}/ws?{query}").into_client_request().unwrap();
        request.headers_mut().insert("Origin", format!("http://{host}").parse().unwrap());
        let (socket, _) = tungstenite::client(request, stream).unwrap();
        Self { socket, next: 0, events: VecDeque::new(), binary: VecDeque::new() }
    }

    /// Asks, and does not wait; the number of the question.
    pub(crate) fn send(&mut self, mut request: Value) -> u64 {
        self.next += 1;
        request["id"] = self.next.into();
        self.socket.send(Message::Text(request.to_string().into())).unwrap();
        self.next
    }

    /// Sends a text as it is.
    pub(crate) fn send_raw(&mut self, text: String) -> Result<(), tungstenite::Error> {
        self.socket.send(Message::Text(text.into()))
    }

    /// Asks; the answer, or the error.
    pub(crate) fn ask(&mut self, request: Value) -> Result<Value, Value> {
        let id = self.send(request);
        let start = Instant::now();
        while start.elapsed() < PATIENCE {
            let Some(value) = self.read().unwrap() else { continue };
            if value.get("id").and_then(Value::as_u64) == Some(id) {
                return match value.get("error") {
                    Some(error) => Err(error.clone()),
                    None => Ok(value["ok"].clone()),
                };
            }
            if value.get("event").is_some() {
                self.events.push_back(value);
            }
        }
        panic!("no answer")
    }

    /// One message; none where it was a binary one.
    pub(crate) fn read(&mut self) -> Result<Option<Value>, tungstenite::Error> {
        match self.socket.read()? {
            Message::Text(text) => Ok(Some(serde_json::from_str(text.as_str()).unwrap())),
            Message::Binary(bytes) => {
                self.binary.push_back(bytes.to_vec());
                Ok(None)
            }
            _ => Ok(None),
        }
    }

    /// The next event for which something holds; those before it are passed over.
    pub(crate) fn event(&mut self, wanted: impl Fn(&Value) -> bool) -> Value {
        let start = Instant::now();
        while start.elapsed() < PATIENCE {
            if let Some(event) = self.events.pop_front() {
                if wanted(&event) {
                    return event;
                }
                continue;
            }
            if let Some(value) = self.read().unwrap()
                && value.get("event").is_some()
            {
                self.events.push_back(value);
            }
        }
        panic!("no such event")
    }

    pub(crate) fn event_named(&mut self, name: &str) -> Value {
        self.event(|event| event["event"] == name)
    }

    pub(crate) fn edit(&mut self, doc: &str, version: u64, text: &str) -> Result<Value, Value> {
        self.ask(json!({ "do": "edit", "doc": doc, "version": version, "text": text }))
    }

    pub(crate) fn view(&mut self, doc: &str) {
        self.ask(
            json!({ "do": "view", "doc": doc, "time": 0, "width": null, "height": null, "overrides": {} }),
        )
        .unwrap();
    }

    pub(crate) fn close(mut self) {
        let _ = self.socket.close(None);
    }
}
