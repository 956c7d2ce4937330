//! The messages between a page and the engine.
//!
//! Requests are JSON objects with an `id` and a `do`; each is answered by `{"id", "ok"}` or `{"id", "error"}`. Events have no id
//! and are told by `event`. Offsets into texts count UTF-16 code units from the text's start. Pixels and files are binary:
//! see [`pixels_message`] and [`file_message`].

use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;

/// What a page asks for.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(tag = "do", rename_all = "kebab-case")]
pub enum Request {
    /// What there is.
    Hello {},
    /// The files of the folder.
    Files {},
    /// The text of a file.
    Open {
        /// From the folder.
        path: String,
    },
    /// The text of an example.
    Example {
        /// Its name.
        name: String,
    },
    /// A document is open, or has another text.
    Edit {
        /// Its path in the folder, or a name of its own.
        doc: String,
        /// Grows with every edit.
        version: u64,
        /// All of it.
        text: String,
    },
    /// A document is no longer open.
    Close {
        /// Which.
        doc: String,
    },
    /// What is to be shown from now on.
    View(View),
    /// No more of the picture that is coming into being.
    Stop {},
    /// What may be written at a place.
    Complete(At),
    /// What there is to say of what is at a place.
    Hover(At),
    /// Where the name at a place is defined.
    Definition(At),
    /// Where the name at a place is used.
    References(At),
    /// A new name for what is named at a place.
    Rename {
        /// The place.
        #[serde(flatten)]
        at: At,
        /// The new name.
        name: String,
    },
    /// The definitions of a document.
    Symbols(Of),
    /// A document in the common layout.
    Format(Of),
    /// The colours in a document.
    Colors(Of),
    /// How a colour may be written in place of another.
    Present {
        /// The document.
        #[serde(flatten)]
        of: Of,
        /// Where the colour begins that is there.
        from: usize,
        /// Where it ends.
        to: usize,
        /// The new one, as it is displayed: 0 to 1.
        color: [f64; 3],
    },
    /// The numbers in a document that may be dragged.
    Numbers(Of),
    /// Why a pixel has the colour that it has.
    Explain {
        /// The document.
        #[serde(flatten)]
        of: Of,
        /// From the left.
        x: u32,
        /// From the top.
        y: u32,
        /// The moment, in seconds.
        #[serde(default)]
        time: f64,
    },
    /// A picture as a file.
    RenderFile {
        /// The document.
        #[serde(flatten)]
        of: Of,
        /// The moment, in seconds.
        #[serde(default)]
        time: f64,
        /// The name of the format.
        format: String,
    },
    /// What is shown, as a command line.
    Command {
        /// The document.
        doc: String,
        /// The moment, in seconds.
        #[serde(default)]
        time: f64,
        /// Pixels across, where not the scene's own.
        #[serde(default)]
        width: Option<u32>,
        /// Pixels down, where not the scene's own.
        #[serde(default)]
        height: Option<u32>,
    },
    /// Writes a document to its file.
    Save {
        /// Its path in the folder.
        doc: String,
        /// All of it.
        text: String,
        /// What is on the disk as far as the page knows; none where there is no such file.
        disk: Option<String>,
    },
}

/// A document in one of its states.
#[derive(Clone, Debug, Deserialize, PartialEq, Eq)]
pub struct Of {
    /// Its name.
    pub doc: String,
    /// The version that the question is about.
    #[serde(default)]
    pub version: u64,
}

/// A place in a document.
#[derive(Clone, Debug, Deserialize, PartialEq, Eq)]
pub struct At {
    /// The document.
    #[serde(flatten)]
    pub of: Of,
    /// The offset.
    pub at: usize,
}

/// What is shown.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
pub struct View {
    /// The document.
    pub doc: String,
    /// The moment, in seconds.
    #[serde(default)]
    pub time: f64,
    /// Pixels across, where not the scene's own.
    #[serde(default)]
    pub width: Option<u32>,
    /// Pixels down, where not the scene's own.
    #[serde(default)]
    pub height: Option<u32>,
    /// Definitions to replace, by name.
    #[serde(default)]
    pub overrides: BTreeMap<String, String>,
}

/// A request with its number.
#[derive(Clone, Debug, PartialEq)]
pub struct Message {
    /// The number that the answer bears.
    pub id: u64,
    /// What is asked for; or why that cannot be told.
    pub request: Result<Request, Refusal>,
}

impl Message {
    /// Reads a message.
    ///
    /// # Errors
    /// Where it is not even known which answer to give.
    pub fn read(text: &str) -> Result<Self, Refusal> {
        let unreadable =
            |error: serde_json::Error| Refusal::new(format!("the message cannot be read: {error}"));
        let value: Value = serde_json::from_str(text).map_err(unreadable)?;
        let id = value.get("id").and_then(Value::as_u64);
        let id = id.ok_or_else(|| Refusal::new("the message has no number `id`"))?;
        Ok(Self { id, request: serde_json::from_value(value).map_err(unreadable) })
    }
}

/// Why there is no answer.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Refusal {
    /// What is wrong.
    pub message: String,
    /// What to do.
    pub help: Option<String>,
    /// What is on the disk instead of what the page thought there was.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub conflict: Option<OnDisk>,
}

impl Refusal {
    /// With a message alone.
    #[must_use]
    pub fn new(message: impl Into<String>) -> Self {
        Self { message: message.into(), help: None, conflict: None }
    }

    /// With what to do, too.
    #[must_use]
    pub fn with_help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }
}

/// A file as it is on the disk; nothing where there is none.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct OnDisk {
    /// The hash of its bytes.
    pub disk: Option<String>,
    /// Its text.
    pub text: Option<String>,
}

/// The answer to a request.
#[must_use]
pub fn answer(id: u64, answer: &Result<Value, Refusal>) -> String {
    match answer {
        Ok(value) => serde_json::json!({ "id": id, "ok": value }),
        Err(refusal) => serde_json::json!({ "id": id, "error": refusal }),
    }
    .to_string()
}

/// What the engine tells of its own accord.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "event", rename_all = "kebab-case")]
pub enum Event {
    /// All that is wrong with a version of a document.
    Problems {
        /// The document.
        doc: String,
        /// Its version.
        version: u64,
        /// In the order in which they are to be shown.
        items: Vec<Problem>,
    },
    /// What a version of a document means.
    Scene {
        /// The document.
        doc: String,
        /// Its version.
        version: u64,
        /// Whether there is something to see.
        ok: bool,
        /// What `hray info --json` says of it.
        summary: Option<Value>,
        /// Whether it is a function of the time.
        animated: bool,
        /// How many definitions there are, where it is a file without a scene that is there to be imported.
        module: Option<usize>,
    },
    /// A picture begins; what is still to come of older ones is not to be shown.
    Frame {
        /// Its number.
        frame: u32,
        /// Of which document.
        doc: String,
        /// In which version.
        version: u64,
        /// The moment.
        time: f64,
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// How many times it is gone over, finer each time.
        passes: usize,
    },
    /// How far a picture is.
    Progress {
        /// Its number.
        frame: u32,
        /// Which pass, from 0.
        pass: usize,
        /// How much of all is done, from 0 to 1.
        done: f64,
        /// Since it began.
        seconds: f64,
    },
    /// A picture is complete.
    Done {
        /// Its number.
        frame: u32,
        /// How long it took.
        seconds: f64,
        /// Rays that were traced, in all passes.
        rays: u64,
        /// SHA-256 of the picture as a file in the format PPM (P6); none of very large pictures.
        hash: Option<String>,
    },
    /// There will be no picture.
    Failed {
        /// The number that it would have had.
        frame: u32,
        /// Of which document.
        doc: String,
        /// Why.
        message: String,
    },
    /// A file that is open changed on the disk.
    Disk {
        /// Its path.
        path: String,
        /// What is there now.
        #[serde(flatten)]
        now: OnDisk,
    },
    /// There are other files than before.
    Files {
        /// All of them.
        files: Vec<FileEntry>,
    },
}

impl Event {
    /// As a message.
    #[must_use]
    pub fn message(&self) -> String {
        serde_json::to_string(self).unwrap_or_default()
    }
}

/// A file of the folder.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct FileEntry {
    /// From the folder.
    pub path: String,
    /// What it is.
    pub kind: FileKind,
}

/// The kinds of files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum FileKind {
    /// A scene in hry, or what scenes import.
    Scene,
    /// A scene in the grammar of 2005.
    Classic,
    /// Images and meshes.
    Other,
}

/// An example.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Example {
    /// Its name.
    pub name: String,
    /// What it is called.
    pub title: String,
    /// A sentence or two.
    pub about: String,
    /// Whether it is a function of the time.
    pub time: bool,
    /// The address of its picture.
    pub picture: Option<String>,
    /// Its text.
    #[serde(skip)]
    pub text: String,
}

/// Something that is wrong.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Problem {
    /// The path of the file it is about.
    pub file: String,
    /// Where it begins.
    pub from: usize,
    /// Where it ends.
    pub to: usize,
    /// `error` or `warning`.
    pub severity: &'static str,
    /// The stable name of its kind.
    pub code: &'static str,
    /// What is wrong, in one sentence without a full stop.
    pub message: String,
    /// What is said of the place itself; may be empty.
    pub label: String,
    /// Other places that explain it.
    pub related: Vec<Related>,
    /// What else is good to know.
    pub notes: Vec<String>,
    /// What to do.
    pub help: Option<String>,
    /// All of it as the command line shows it.
    pub rendered: String,
    /// What would mend it.
    pub fixes: Vec<Fix>,
    /// Whether the text there could be removed.
    pub unnecessary: bool,
}

/// A place with a remark.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Related {
    /// The path of the file.
    pub file: String,
    /// Where it begins.
    pub from: usize,
    /// Where it ends.
    pub to: usize,
    /// The remark.
    pub text: String,
}

/// A way to mend something.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Fix {
    /// In words.
    pub title: String,
    /// What to replace.
    pub edits: Vec<TextEdit>,
}

/// A replacement of text.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct TextEdit {
    /// Where it begins.
    pub from: usize,
    /// Where it ends.
    pub to: usize,
    /// What is there then.
    pub text: String,
}

/// Some samples of a picture as a binary message: seven numbers of 32 bits, little endian (1, the number of the picture, x, y,
/// samples across, samples down, the step), then four bytes a sample. Each sample stands for a square of `step` by `step` pixels.
#[must_use]
pub fn pixels_message(frame: u32, place: [u32; 5], rgba: &[u8]) -> Vec<u8> {
    let [x, y, width, height, step] = place;
    let mut bytes = Vec::with_capacity(28 + rgba.len());
    for number in [1, frame, x, y, width, height, step] {
        bytes.extend_from_slice(&number.to_le_bytes());
    }
    bytes.extend_from_slice(rgba);
    bytes
}

/// A file as a binary message: two numbers of 32 bits (2, the number of the request), then its bytes.
#[must_use]
pub fn file_message(request: u64, bytes: &[u8]) -> Vec<u8> {
    let mut message = Vec::with_capacity(8 + bytes.len());
    message.extend_from_slice(&2u32.to_le_bytes());
    message.extend_from_slice(&(request as u32).to_le_bytes());
    message.extend_from_slice(bytes);
    message
}
