//! hray studio without a server: the engine as WebAssembly, for the same page.
//!
//! One [`Engine`] lives in each worker of the page, and none knows of the others. One of them answers the questions about the
//! text; all are given the same documents and views, and the page deals the tiles of a picture out among them. Messages are
//! those of `hray_session::protocol`.

use hray_session::protocol::{Event, Message, Refusal, Request, View, answer, file_message, pixels_message};
use hray_session::{About, Description, Frame, Limits, MemoryFiles, Session, Work};
use hray_session::{Control, MeshTrees, Tracer};
use serde_json::{Value, json};
use std::sync::Arc;
use wasm_bindgen::prelude::wasm_bindgen;

/// How much an evaluation may take here, where nothing can stop it but the end of its worker: some seconds, and a part of the
/// four GiB that there are at most.
const LIMITS: Limits =
    Limits { steps: 50_000_000, depth: 2000, list: 2_000_000, memory: 1 << 30, nodes: 200_000 };

/// The engine of one worker.
#[wasm_bindgen]
pub struct Engine {
    files: Arc<MemoryFiles>,
    session: Session,
    meshes: MeshTrees,
    tracer: Tracer,
    control: Control,
    shown: Option<Shown>,
}

impl std::fmt::Debug for Engine {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Engine").field("session", &self.session).finish_non_exhaustive()
    }
}

impl Default for Engine {
    fn default() -> Self {
        Self::new(1, LIMITS.depth)
    }
}

/// A picture that can be rendered.
struct Shown {
    number: u32,
    frame: Frame,
    tiles: Vec<Vec<hray_session::Tile>>,
}

#[wasm_bindgen]
impl Engine {
    /// An engine with the examples and nothing else; `cores` is how many workers there are, as the page is told.
    ///
    /// Calls inside calls of a scene may go `depth` deep, and at most 2000. They are on the browser's own stack, whose size
    /// nobody says; where it ends, the browser throws a `RangeError`, after which this engine is of no more use, and another
    /// one with a smaller `depth` can tell which call it was.
    #[wasm_bindgen(constructor)]
    #[must_use]
    pub fn new(cores: usize, depth: u32) -> Self {
        let files = Arc::new(MemoryFiles::default());
        for (path, text) in hray_session::companions() {
            // Their names are paths.
            let _ = files.put(&path, Some(text.as_bytes().to_vec()));
        }
        let about = About { start: None, examples: hray_session::examples(|_| true), cores };
        let session =
            Session::new(files.clone(), Arc::new(about), Limits { depth: depth.min(LIMITS.depth), ..LIMITS });
        let (meshes, tracer, control) = (MeshTrees::default(), Tracer::new(), Control::new());
        Self { files, session, meshes, tracer, control, shown: None }
    }

    /// Answers a request; an empty text where it is one for [`Engine::file`].
    pub fn request(&mut self, message: &str) -> String {
        let (id, request) = match Message::read(message) {
            Ok(Message { id, request }) => (id, request),
            Err(refusal) => return json!({ "event": "unreadable", "message": refusal.message }).to_string(),
        };
        let answered = match request {
            // What is shown is up to the page.
            Ok(Request::View(_) | Request::Stop {}) => Ok(json!({})),
            Ok(Request::RenderFile { .. }) => return String::new(),
            Ok(Request::Explain { of, x, y, time }) => {
                let work = self.session.work(&View { doc: of.doc.clone(), time, ..View::default() });
                let work = work.ok_or_else(|| Refusal::new(format!("{:?} is not open", of.doc)));
                work.and_then(|work| work.explain(x, y, &self.control))
            }
            Ok(request) => self.session.answer(&request),
            Err(refusal) => Err(refusal),
        };
        answer(id, &answered)
    }

    /// A file that scenes may read, or none in its place.
    ///
    /// # Errors
    /// Where the path is none.
    pub fn put(&mut self, path: &str, bytes: Option<Vec<u8>>) -> Result<(), String> {
        self.files.put(path, bytes).map_err(|refusal| refusal.message)
    }

    /// Evaluates a document and prepares its picture under a number. The answer is an object with `events` (problems, scene,
    /// frame or failed) and, where there is a picture, `tiles`: how many each pass has.
    pub fn show(&mut self, number: u32, view: &str) -> String {
        self.shown = None;
        let mut events = Vec::new();
        let made = self.prepare(number, view, &mut events);
        let tiles: Vec<usize> = match made {
            Ok(()) => self.shown.iter().flat_map(|shown| shown.tiles.iter().map(Vec::len)).collect(),
            Err((doc, refusal)) => {
                let message = match refusal.help {
                    Some(help) => format!("{}; {help}", refusal.message),
                    None => refusal.message,
                };
                events.push(Event::Failed { frame: number, doc, message });
                Vec::new()
            }
        };
        json!({ "events": events, "tiles": tiles }).to_string()
    }

    /// A tile of the picture that was prepared last, as the binary message of the protocol; nothing where there is no such tile.
    pub fn tile(&mut self, pass: usize, index: usize) -> Vec<u8> {
        let Some(shown) = &self.shown else { return Vec::new() };
        let Some(tile) = shown.tiles.get(pass).and_then(|tiles| tiles.get(index)) else { return Vec::new() };
        match shown.frame.render(tile, &mut self.tracer, &self.control) {
            Ok(pixels) => pixels_message(shown.number, pixels.place, &pixels.rgba),
            Err(_) => Vec::new(),
        }
    }

    /// Rays that this engine has traced so far.
    #[must_use]
    pub fn rays(&self) -> f64 {
        self.tracer.rays().total() as f64
    }

    /// Answers a request for a file: the answer, and where that is good the binary message.
    pub fn file(&mut self, message: &str) -> File {
        let (id, made) = match Message::read(message) {
            Ok(Message { id, request: Ok(Request::RenderFile { of, time, format }) }) => {
                let view = View { doc: of.doc, time, ..View::default() };
                let work = self.session.work(&view);
                let work = work.ok_or_else(|| Refusal::new(format!("{:?} is not open", view.doc)));
                (id, work.and_then(|work| work.file(&format, &self.control)))
            }
            Ok(Message { id, .. }) => (id, Err(Refusal::new("this is no request for a file"))),
            Err(refusal) => (0, Err(refusal)),
        };
        match made {
            Ok(file) => File {
                answer: answer(id, &Ok(json!({ "name": file.name, "mime": file.mime }))),
                bytes: file_message(id, &file.bytes),
            },
            Err(refusal) => File { answer: answer(id, &Err(refusal)), bytes: Vec::new() },
        }
    }
}

impl Engine {
    fn prepare(&mut self, number: u32, view: &str, events: &mut Vec<Event>) -> Result<(), (String, Refusal)> {
        let view: View = serde_json::from_str(view)
            .map_err(|error| (String::new(), Refusal::new(format!("the view cannot be read: {error}"))))?;
        let doc = view.doc.clone();
        let with_doc = |refusal| (doc.clone(), refusal);
        let work: Work =
            self.session.work(&view).ok_or_else(|| with_doc(Refusal::new(format!("{doc:?} is not open"))))?;
        // Nobody sets the flag that would stop it.
        let Some(evaluated) = work.evaluate(&Arc::default()) else { return Ok(()) };
        events.extend([evaluated.problems, evaluated.scene]);
        let Some(description) = evaluated.description else { return Ok(()) };
        self.picture(number, &view, &work, &description, events).map_err(with_doc)
    }

    fn picture(
        &mut self,
        number: u32,
        view: &View,
        work: &Work,
        description: &Description,
        events: &mut Vec<Event>,
    ) -> Result<(), Refusal> {
        let frame = Frame::new(description, view.size()?, &mut self.meshes)?;
        events.push(frame.event(number, work));
        let tiles = (0..frame.passes().len()).map(|pass| frame.tiles(pass)).collect();
        self.shown = Some(Shown { number, frame, tiles });
        Ok(())
    }
}

/// A file, and what is said of it.
#[wasm_bindgen]
#[derive(Debug)]
pub struct File {
    answer: String,
    bytes: Vec<u8>,
}

#[wasm_bindgen]
impl File {
    /// The answer to the request.
    #[must_use]
    pub fn answer(&self) -> String {
        self.answer.clone()
    }

    /// The binary message; empty where there is no file.
    #[must_use]
    pub fn bytes(&self) -> Vec<u8> {
        self.bytes.clone()
    }
}

/// The version of hray.
#[wasm_bindgen]
#[must_use]
pub fn version() -> String {
    Value::from(env!("CARGO_PKG_VERSION")).as_str().unwrap_or("").to_owned()
}
