//! The documents that are open, and the answers to questions about them.

use crate::files::{Files, MOST_TEXT, Overlay, inside, on_disk};
use crate::protocol::{At, Example, Of, OnDisk, Refusal, Request, TextEdit, View};
use crate::scene::Work;
use crate::units::Units;
use crate::uses::users;
use hray::ide::{Analysis, FileId, Place, SuggestionKind, Symbol, SymbolKind};
use hray::{Assets, Limits, PictureFormat, Span};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::sync::Arc;

/// The most documents that are open at a time.
pub const MOST_DOCUMENTS: usize = 100;

/// What a session tells of itself.
#[derive(Clone, Debug, Default)]
pub struct About {
    /// The document that the page is to begin with.
    pub start: Option<String>,
    /// What the gallery shows.
    pub examples: Vec<Example>,
    /// Threads that render.
    pub cores: usize,
}

/// A folder and its open documents.
pub struct Session {
    files: Arc<dyn Files>,
    about: Arc<About>,
    limits: Limits,
    documents: BTreeMap<String, Document>,
}

impl std::fmt::Debug for Session {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Session").field("documents", &self.documents.len()).finish_non_exhaustive()
    }
}

/// An open text.
struct Document {
    version: u64,
    text: Arc<str>,
    units: Units,
    /// None where nobody asked yet.
    analysis: Option<Arc<Analysis>>,
    /// What the page knows to be on the disk.
    disk: Option<OnDisk>,
}

impl Session {
    /// A session over files. Evaluations may take as much as `limits` say.
    #[must_use]
    pub fn new(files: Arc<dyn Files>, about: Arc<About>, limits: Limits) -> Self {
        Self { files, about, limits, documents: BTreeMap::new() }
    }

    /// Answers a request. Those that ask for pictures are not for here: see [`Session::work`].
    ///
    /// # Errors
    /// Why there is no answer.
    pub fn answer(&mut self, request: &Request) -> Result<Value, Refusal> {
        match request {
            Request::Hello {} => Ok(self.hello()),
            Request::Files {} => Ok(json!({ "files": self.files.list() })),
            Request::Open { path } => self.open(path),
            Request::Example { name } => self.example(name),
            Request::Edit { doc, version, text } => self.edit(doc, *version, text),
            Request::Close { doc } => {
                self.documents.remove(doc);
                self.forget_importers();
                Ok(json!({}))
            }
            Request::Complete(at) => self.complete(at),
            Request::Hover(at) => self.hover(at),
            Request::Definition(at) => self.definition(at),
            Request::References(at) => self.references(at),
            Request::Rename { at, name } => self.rename(at, name),
            Request::Symbols(of) => self.symbols(of),
            Request::Format(of) => self.format(of),
            Request::Colors(of) => self.colors(of),
            Request::Present { of, from, to, color } => self.present(of, *from, *to, *color),
            Request::Numbers(of) => self.numbers(of),
            Request::Command { doc, time, width, height } => Ok(command(doc, *time, *width, *height)),
            Request::Save { doc, text, disk } => self.save(doc, text, disk.as_deref()),
            Request::View(_) | Request::Stop {} | Request::RenderFile { .. } | Request::Explain { .. } => {
                Err(Refusal::new("this is not to be had here"))
            }
        }
    }

    /// What has to be evaluated to show a document; none where it is not open.
    #[must_use]
    pub fn work(&self, view: &View) -> Option<Work> {
        let document = self.documents.get(&view.doc)?;
        Some(Work {
            doc: view.doc.clone(),
            version: document.version,
            text: document.text.clone(),
            assets: Arc::new(self.overlay()),
            time: view.time,
            overrides: view.overrides.clone(),
            limits: self.limits,
        })
    }

    /// Whether a change of a file may be a change of what documents mean: it is not open itself, and scenes can read it.
    #[must_use]
    pub fn concerns(&self, path: &str) -> bool {
        !self.documents.contains_key(path) && crate::files::is_read(path)
    }

    /// Looks at the disk again: what is different now of the files that are open.
    pub fn refresh(&mut self) -> Vec<(String, OnDisk)> {
        let mut changed = Vec::new();
        for (path, document) in &mut self.documents {
            let (Some(before), Ok(now)) = (&document.disk, on_disk(&*self.files, path)) else { continue };
            if before.disk != now.disk {
                document.disk = Some(OnDisk { disk: now.disk.clone(), text: None });
                changed.push((path.clone(), now));
            }
        }
        // What documents import may be other than before.
        self.documents.values_mut().for_each(|document| document.analysis = None);
        changed
    }

    /// The files of the folder.
    #[must_use]
    pub fn list(&self) -> Vec<crate::protocol::FileEntry> {
        self.files.list()
    }

    /// The names of the documents that are open.
    pub fn documents(&self) -> impl Iterator<Item = &str> {
        self.documents.keys().map(String::as_str)
    }

    fn hello(&self) -> Value {
        let About { start, examples, cores } = &*self.about;
        let formats = PictureFormat::ALL.map(|format| {
            json!({ "name": format.name(), "about": format.description(), "extension": extension(format) })
        });
        json!({
            "version": env!("CARGO_PKG_VERSION"),
            "root": self.files.root(),
            "files": self.files.list(),
            "start": start,
            "canSave": self.files.can_save(),
            "examples": examples,
            "formats": formats,
            "cores": cores,
        })
    }

    fn open(&mut self, path: &str) -> Result<Value, Refusal> {
        let path = inside(path)?;
        let now = on_disk(&*self.files, path)?;
        let Some(text) = &now.text else {
            let help = "the list of files shows what there is";
            return Err(Refusal::new(format!("there is no file {path:?} in the folder")).with_help(help));
        };
        let answer = json!({ "path": path, "text": text, "disk": now.disk });
        if let Some(document) = self.documents.get_mut(path) {
            document.disk = Some(OnDisk { disk: now.disk, text: None });
        } else {
            let text = Arc::from(text.as_str());
            let disk = Some(OnDisk { disk: now.disk, text: None });
            self.insert(path, Document { version: 0, units: Units::new(&text), text, analysis: None, disk })?;
        }
        Ok(answer)
    }

    fn example(&self, name: &str) -> Result<Value, Refusal> {
        let found = self.about.examples.iter().find(|example| example.name == name);
        let found = found.ok_or_else(|| Refusal::new(format!("there is no example {name:?}")))?;
        Ok(json!({ "name": found.name, "text": found.text }))
    }

    fn edit(&mut self, doc: &str, version: u64, text: &str) -> Result<Value, Refusal> {
        let doc = inside(doc)?;
        if text.len() > MOST_TEXT {
            return Err(Refusal::new(format!("a text may have {} MiB at most", MOST_TEXT >> 20)));
        }
        let text: Arc<str> = Arc::from(text);
        let units = Units::new(&text);
        match self.documents.get_mut(doc) {
            Some(document) => {
                (document.version, document.text, document.units) = (version, text, units);
                document.analysis = None;
            }
            None => self.insert(doc, Document { version, text, units, analysis: None, disk: None })?,
        }
        self.forget_importers();
        Ok(json!({}))
    }

    fn insert(&mut self, doc: &str, document: Document) -> Result<(), Refusal> {
        if self.documents.len() >= MOST_DOCUMENTS {
            let help = "close some of them";
            return Err(Refusal::new(format!("{MOST_DOCUMENTS} documents are open already")).with_help(help));
        }
        self.documents.insert(doc.to_owned(), document);
        Ok(())
    }

    /// What is known of a document may be other where a document that it imports has changed.
    fn forget_importers(&mut self) {
        let alone = |document: &Document| {
            document.analysis.as_ref().is_none_or(|analysis| analysis.files().len() == 1)
        };
        self.documents.values_mut().filter(|document| !alone(document)).for_each(|document| {
            document.analysis = None;
        });
    }

    fn overlay(&self) -> Overlay {
        let open = self.documents.iter().map(|(path, document)| (path.clone(), document.text.clone()));
        Overlay { files: self.files.clone(), open: open.collect() }
    }

    /// A document, read and checked.
    fn analysis(&mut self, of: &Of) -> Result<(Arc<Analysis>, &Document), Refusal> {
        let unknown = || Refusal::new(format!("{:?} is not open", of.doc));
        let document = self.documents.get(&of.doc).ok_or_else(unknown)?;
        if of.version != 0 && document.version != 0 && of.version != document.version {
            let message = format!("{:?} has version {} by now", of.doc, document.version);
            return Err(Refusal::new(message));
        }
        if document.analysis.is_none() {
            let analysis = Arc::new(Analysis::new(&of.doc, document.text.clone(), &self.overlay()));
            if let Some(document) = self.documents.get_mut(&of.doc) {
                document.analysis = Some(analysis);
            }
        }
        let document = self.documents.get(&of.doc).ok_or_else(unknown)?;
        let analysis = document.analysis.clone().ok_or_else(unknown)?;
        Ok((analysis, document))
    }

    fn complete(&mut self, at: &At) -> Result<Value, Refusal> {
        let overlay = self.overlay();
        let (analysis, document) = self.analysis(&at.of)?;
        let offset = document.units.to_byte(&document.text, at.at);
        let found = analysis.completions(offset, &overlay);
        let [from, to] = found.first().map_or([at.at, at.at], |first| document.units.span(first.span));
        let item = |item: &hray::ide::Suggestion| {
            let kind = match item.kind {
                SuggestionKind::Function => "function",
                SuggestionKind::Constructor => "constructor",
                SuggestionKind::Value => "value",
                SuggestionKind::Local => "local",
                SuggestionKind::Field => "field",
                SuggestionKind::Keyword => "keyword",
                SuggestionKind::Type => "type",
                SuggestionKind::File => "file",
                SuggestionKind::Folder => "folder",
                SuggestionKind::Module => "module",
            };
            json!({
                "label": item.label, "kind": kind, "detail": item.detail, "documentation": item.documentation,
                "insert": item.text, "snippet": item.snippet, "rank": item.rank,
            })
        };
        Ok(json!({ "from": from, "to": to, "items": found.iter().map(item).collect::<Vec<_>>() }))
    }

    fn hover(&mut self, at: &At) -> Result<Value, Refusal> {
        let (analysis, document) = self.analysis(&at.of)?;
        let Some(hover) = analysis.hover(document.units.to_byte(&document.text, at.at)) else {
            return Ok(Value::Null);
        };
        let [from, to] = document.units.span(hover.span);
        Ok(json!({ "from": from, "to": to, "code": hover.code, "text": hover.text, "color": hover.color }))
    }

    fn definition(&mut self, at: &At) -> Result<Value, Refusal> {
        let (analysis, document) = self.analysis(&at.of)?;
        let place = analysis.definition(document.units.to_byte(&document.text, at.at));
        Ok(place.and_then(|place| self.located(&place)).unwrap_or(Value::Null))
    }

    /// A place with the text that it is in, where that is not open.
    fn located(&self, place: &Place) -> Option<Value> {
        match &place.file {
            FileId::Own(path) => {
                if let Some(document) = self.documents.get(path) {
                    let [from, to] = document.units.span(place.span);
                    return Some(json!({ "doc": path, "name": path, "text": null, "from": from, "to": to }));
                }
                let text = self.files.text(path).ok()?;
                let [from, to] = Units::new(&text).span(place.span);
                Some(json!({ "doc": path, "name": path, "text": text, "from": from, "to": to }))
            }
            FileId::Library(name) => {
                let text = hray::ide::library_text(name)?;
                let [from, to] = Units::new(text).span(place.span);
                Some(json!({ "doc": null, "name": name, "text": text, "from": from, "to": to }))
            }
        }
    }

    fn references(&mut self, at: &At) -> Result<Value, Refusal> {
        let (analysis, document) = self.analysis(&at.of)?;
        let offset = document.units.to_byte(&document.text, at.at);
        let mut places = analysis.references(offset, true);
        if let Some(defined) =
            analysis.definition(offset).filter(|place| matches!(place.file, FileId::Own(_)))
        {
            places.extend(self.users(&analysis, &defined).iter().flat_map(|other| other.uses_of(&defined)));
        }
        places.sort();
        places.dedup();
        let place = |place: &Place| {
            let FileId::Own(path) = &place.file else { return None };
            let [from, to] = self.span_in(path, place.span)?;
            Some(json!({ "doc": path, "from": from, "to": to }))
        };
        Ok(places.iter().filter_map(place).collect())
    }

    /// A span of a file in UTF-16.
    fn span_in(&self, path: &str, span: Span) -> Option<[usize; 2]> {
        match self.documents.get(path) {
            Some(document) => Some(document.units.span(span)),
            None => Some(Units::new(&self.files.text(path).ok()?).span(span)),
        }
    }

    /// The other documents and scenes of the folder that may use what is defined at a place.
    fn users(&self, analysis: &Analysis, defined: &Place) -> Vec<Arc<Analysis>> {
        let listed =
            self.files.list().into_iter().map(|entry| entry.path).filter(|path| path.ends_with(".hry"));
        let mut paths: Vec<String> = self.documents.keys().cloned().chain(listed).collect();
        paths.retain(|path| path != analysis.path());
        paths.sort();
        paths.dedup();
        users(paths, defined, &self.overlay())
    }

    fn rename(&mut self, at: &At, name: &str) -> Result<Value, Refusal> {
        let (analysis, document) = self.analysis(&at.of)?;
        let offset = document.units.to_byte(&document.text, at.at);
        let renaming = analysis.renaming(offset).map_err(Refusal::new)?;
        let mut all = self.users(&analysis, &renaming.defined);
        all.insert(0, analysis);
        let roots: Vec<&Analysis> = all.iter().map(Arc::as_ref).collect();
        let overlay = self.overlay();
        let reread = |path: &str, changed: &BTreeMap<String, String>| {
            let mut overlay = self.overlay();
            overlay.open.extend(changed.iter().map(|(path, text)| (path.clone(), Arc::from(text.as_str()))));
            let text = overlay.text(path).ok()?;
            Some(Analysis::new(path, text.into(), &overlay))
        };
        let text_of = |path: &str| overlay.text(path).ok();
        let edits =
            hray::ide::rename(&roots, &renaming, name.trim(), text_of, reread).map_err(Refusal::new)?;
        let mut by_file: BTreeMap<&str, Vec<TextEdit>> = BTreeMap::new();
        for edit in &edits {
            let Some([from, to]) = self.span_in(&edit.path, edit.span) else { continue };
            by_file.entry(&edit.path).or_default().push(TextEdit { from, to, text: edit.text.clone() });
        }
        let files = by_file.into_iter().map(|(doc, edits)| json!({ "doc": doc, "edits": edits }));
        Ok(json!({ "files": files.collect::<Vec<_>>() }))
    }

    fn symbols(&mut self, of: &Of) -> Result<Value, Refusal> {
        fn value(symbol: &Symbol, units: &Units) -> Value {
            let kind = match symbol.kind {
                SymbolKind::Scene => "scene",
                SymbolKind::Function => "function",
                SymbolKind::Value => "value",
            };
            let ([from, to], [name_from, name_to]) = (units.span(symbol.span), units.span(symbol.name_span));
            let children: Vec<Value> = symbol.children.iter().map(|child| value(child, units)).collect();
            json!({
                "name": symbol.name, "detail": symbol.detail, "kind": kind, "from": from, "to": to,
                "nameFrom": name_from, "nameTo": name_to, "children": children,
            })
        }
        let (analysis, document) = self.analysis(of)?;
        Ok(analysis.symbols().iter().map(|symbol| value(symbol, &document.units)).collect())
    }

    fn format(&mut self, of: &Of) -> Result<Value, Refusal> {
        let (analysis, _) = self.analysis(of)?;
        if analysis.is_classic() {
            let help = "`hray convert` makes an hry scene of it";
            return Err(Refusal::new("a scene in the grammar of 2005 keeps its layout").with_help(help));
        }
        let text = analysis.formatted();
        let text = text.ok_or_else(|| Refusal::new("a text with errors cannot be laid out"));
        text.map(|text| json!({ "text": text })).map_err(|refusal| refusal.with_help("mend the errors first"))
    }

    fn colors(&mut self, of: &Of) -> Result<Value, Refusal> {
        let (analysis, document) = self.analysis(of)?;
        let color = |place: &hray::ide::ColorPlace| {
            let [from, to] = document.units.span(place.span);
            json!({ "from": from, "to": to, "color": place.color })
        };
        Ok(analysis.colors().iter().map(color).collect())
    }

    fn present(&mut self, of: &Of, from: usize, to: usize, color: [f64; 3]) -> Result<Value, Refusal> {
        let (analysis, document) = self.analysis(of)?;
        let [from, to] = [from, to].map(|unit| document.units.to_byte(&document.text, unit));
        let ways = analysis.presentations(Span::new(from, to.max(from)), color);
        Ok(ways.into_iter().map(|way| way.text).collect())
    }

    fn numbers(&mut self, of: &Of) -> Result<Value, Refusal> {
        let (analysis, document) = self.analysis(of)?;
        let number = |number: &hray::ide::NumberPlace| {
            let [from, to] = document.units.span(number.span);
            json!({
                "from": from, "to": to, "value": number.value, "unit": number.unit, "step": number.step,
                "min": number.least, "max": number.most,
            })
        };
        Ok(analysis.numbers().iter().map(number).collect())
    }

    fn save(&mut self, doc: &str, text: &str, disk: Option<&str>) -> Result<Value, Refusal> {
        let path = inside(doc)?;
        if !path.ends_with(".hry") {
            let help = "give it a name that ends in `.hry`";
            return Err(Refusal::new(format!("{path:?} is not the name of a scene")).with_help(help));
        }
        if text.len() > MOST_TEXT {
            return Err(Refusal::new(format!("a text may have {} MiB at most", MOST_TEXT >> 20)));
        }
        let now = on_disk(&*self.files, path)?;
        if now.disk.as_deref() != disk {
            let message = match &now.disk {
                Some(_) if disk.is_none() => format!("there is a file {path:?} already"),
                Some(_) => format!("{path:?} was changed by another program since it was opened"),
                None => format!("{path:?} is no longer there"),
            };
            return Err(Refusal { conflict: Some(now), ..Refusal::new(message) });
        }
        self.files.write(path, text)?;
        let disk = crate::files::hash(text.as_bytes());
        if let Some(document) = self.documents.get_mut(path) {
            document.disk = Some(OnDisk { disk: Some(disk.clone()), text: None });
        }
        Ok(json!({ "disk": disk }))
    }
}

/// The extension of a format's files.
fn extension(format: PictureFormat) -> &'static str {
    format.extensions().first().unwrap_or(&"ppm")
}

/// A view as a command line.
fn command(doc: &str, time: f64, width: Option<u32>, height: Option<u32>) -> Value {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./+".contains(c);
    let is_plain = !doc.starts_with('-') && doc.chars().all(plain);
    let path = if is_plain { doc.to_owned() } else { format!("'{}'", doc.replace('\'', r"'\''")) };
    let path = if doc.starts_with('-') { format!("./{path}") } else { path };
    let mut command = format!("hray render {path}");
    // What it imports may lie beside its folder; the command is run in the one that is open.
    if doc.contains('/') {
        command.push_str(" --root .");
    }
    if let (Some(width), Some(height)) = (width, height) {
        command.push_str(&format!(" --size {width}x{height}"));
    }
    if time != 0.0 {
        command.push_str(&format!(" --time {time}"));
    }
    json!({ "command": command })
}
