//! The texts that are open, and what the client has been told of them.

use super::convert;
use super::document::{Document, Home};
use super::library;
use super::position::{Encoding, Lines};
use super::transport::Output;
use super::uri;
use super::worker::{Evaluated, Job};
use hray::ide::{Analysis, FileId, Place};
use hray::{Assets, OpenTexts, WorkFolder};
use lsp_server::{Message, Notification};
use lsp_types::notification::{
    DidChangeTextDocument, DidChangeWatchedFiles, DidChangeWorkspaceFolders, DidCloseTextDocument,
    DidOpenTextDocument, Notification as _, PublishDiagnostics,
};
use lsp_types::{
    DidChangeTextDocumentParams, DidChangeWorkspaceFoldersParams, DidCloseTextDocumentParams,
    DidOpenTextDocumentParams, InitializeParams, Location, PublishDiagnosticsParams, Range, Uri,
};
use serde::de::DeserializeOwned;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::sync::Arc;
use std::sync::mpsc::Sender;

/// What the client can do with what it is sent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Client {
    pub(crate) encoding: Encoding,
    /// Completions with parts to be typed over.
    pub(crate) snippets: bool,
    /// Symbols in symbols.
    pub(crate) nested_symbols: bool,
    /// Edits that name the version of the text they are for.
    pub(crate) versioned_edits: bool,
    /// Images in Markdown; no part of the protocol, so our own clients say it.
    pub(crate) images: bool,
}

/// The state of the conversation.
pub(crate) struct Server {
    pub(super) client: Client,
    /// By the URI that the client gave.
    pub(super) documents: BTreeMap<String, Document>,
    /// The folders that the client works in.
    pub(super) workspace: Vec<PathBuf>,
    /// By their roots; those that were asked for.
    folders: BTreeMap<Option<PathBuf>, Arc<WorkFolder>>,
    output: Output,
    worker: Sender<Job>,
}

impl Server {
    pub(crate) fn new(output: Output, worker: Sender<Job>) -> Self {
        let client = Client {
            encoding: Encoding::Utf16,
            snippets: false,
            nested_symbols: false,
            versioned_edits: false,
            images: false,
        };
        let (documents, workspace, folders) = (BTreeMap::new(), Vec::new(), BTreeMap::new());
        Self { client, documents, workspace, folders, output, worker }
    }

    pub(crate) fn restart_worker(&mut self, worker: Sender<Job>) {
        self.worker = worker;
    }

    /// Takes in what the client can do; what this server can.
    pub(crate) fn initialize(&mut self, params: &serde_json::Value) -> serde_json::Value {
        let params: InitializeParams = serde_json::from_value(params.clone()).unwrap_or_default();
        let capabilities = &params.capabilities;
        let text = capabilities.text_document.as_ref();
        let encodings =
            capabilities.general.as_ref().and_then(|general| general.position_encodings.as_deref());
        let item = text.and_then(|text| text.completion.as_ref()?.completion_item.as_ref()?.snippet_support);
        let nested =
            text.and_then(|text| text.document_symbol.as_ref()?.hierarchical_document_symbol_support);
        let edits = capabilities.workspace.as_ref().and_then(|workspace| workspace.workspace_edit.as_ref());
        let images =
            params.initialization_options.as_ref().and_then(|options| options.get("images")?.as_bool());
        self.client = Client {
            encoding: Encoding::choose(encodings),
            snippets: item.unwrap_or(false),
            nested_symbols: nested.unwrap_or(false),
            versioned_edits: edits.and_then(|edits| edits.document_changes).unwrap_or(false),
            images: images.unwrap_or(false),
        };
        #[allow(deprecated, reason = "older clients have no other way to tell")]
        let root = params.root_uri.as_ref().and_then(|root| uri::to_path(root.as_str()));
        self.workspace = match &params.workspace_folders {
            Some(folders) => folders.iter().filter_map(|folder| uri::to_path(folder.uri.as_str())).collect(),
            None => root.into_iter().collect(),
        };
        convert::capabilities(self.client.encoding)
    }

    pub(crate) fn notification(&mut self, notification: Notification) {
        let params = notification.params;
        match notification.method.as_str() {
            DidOpenTextDocument::METHOD => with(params, |params| self.open(params)),
            DidChangeTextDocument::METHOD => with(params, |params| self.change(params)),
            DidCloseTextDocument::METHOD => with(params, |params| self.close(params)),
            DidChangeWatchedFiles::METHOD => self.files_changed(),
            DidChangeWorkspaceFolders::METHOD => with(params, |params| self.workspace_changed(params)),
            _ => {}
        }
    }

    fn open(&mut self, params: DidOpenTextDocumentParams) {
        let document = params.text_document;
        let home = self.home(document.uri.as_str());
        let opened = Document::new(&document.text, document.version, home);
        self.documents.insert(document.uri.as_str().to_owned(), opened);
        self.forget_importers();
    }

    fn change(&mut self, params: DidChangeTextDocumentParams) {
        let encoding = self.client.encoding;
        let Some(document) = self.documents.get_mut(params.text_document.uri.as_str()) else { return };
        document.change(params.content_changes, params.text_document.version, encoding);
        self.forget_importers();
    }

    fn close(&mut self, params: DidCloseTextDocumentParams) {
        let uri = params.text_document.uri;
        if self.documents.remove(uri.as_str()).is_some() {
            self.publish(uri.as_str(), Vec::new(), None);
        }
        self.forget_importers();
    }

    fn files_changed(&mut self) {
        self.folders.clear();
        self.documents.values_mut().for_each(Document::forget);
    }

    fn workspace_changed(&mut self, params: DidChangeWorkspaceFoldersParams) {
        let path = |folder: &lsp_types::WorkspaceFolder| uri::to_path(folder.uri.as_str());
        let removed: Vec<PathBuf> = params.event.removed.iter().filter_map(path).collect();
        self.workspace.retain(|folder| !removed.contains(folder));
        self.workspace.extend(params.event.added.iter().filter_map(path));
        self.folders.clear();
        let open: Vec<String> = self.documents.keys().cloned().collect();
        for uri in open {
            let home = self.home(&uri);
            if let Some(document) = self.documents.get_mut(&uri) {
                document.home = home;
            }
        }
        self.files_changed();
    }

    /// Whatever imports something may read another text now.
    fn forget_importers(&mut self) {
        for document in self.documents.values_mut().filter(|document| document.text.contains("import")) {
            document.forget();
        }
    }

    /// Where a text lies: in the innermost folder of the workspace that holds it, else in its own folder.
    fn home(&mut self, uri: &str) -> Home {
        let nowhere = Home { root: None, path: "scene.hry".into() };
        let Some(file) = uri::to_path(uri) else { return nowhere };
        let around = self.workspace.iter().filter(|folder| file.starts_with(folder));
        let around = around.max_by_key(|folder| folder.components().count()).cloned();
        let own = file.parent().map(Path::to_owned);
        for root in around.into_iter().chain(own) {
            if let Some(path) = self.folder(&Some(root.clone())).path_to(&file) {
                return Home { root: Some(root), path };
            }
        }
        nowhere
    }

    pub(super) fn folder(&mut self, root: &Option<PathBuf>) -> Arc<WorkFolder> {
        if let Some(folder) = self.folders.get(root) {
            return folder.clone();
        }
        let opened = root.as_deref().and_then(|root| WorkFolder::open(root).ok());
        let folder = Arc::new(opened.unwrap_or_else(WorkFolder::nowhere));
        self.folders.insert(root.clone(), folder.clone());
        folder
    }

    /// The open texts of a folder.
    pub(super) fn open_texts(&self, root: &Option<PathBuf>) -> OpenTexts {
        let inside = self.documents.values().filter(|document| root.is_some() && document.home.root == *root);
        inside.map(|document| (document.home.path.clone(), document.text.clone())).collect()
    }

    /// What is known of a document, found out now where it is not.
    pub(super) fn analysis(&mut self, uri: &str) -> Option<Arc<Analysis>> {
        let document = self.documents.get(uri)?;
        if let Some(analysis) = &document.analysis {
            return Some(analysis.clone());
        }
        let (home, text) = (document.home.clone(), document.text.clone());
        let (folder, open) = (self.folder(&home.root), self.open_texts(&home.root));
        let analysis = Arc::new(Analysis::new(&home.path, text, &folder.with(&open)));
        self.documents.get_mut(uri)?.analysis = Some(analysis.clone());
        Some(analysis)
    }

    /// Looks at what changed, and tells.
    pub(crate) fn refresh(&mut self) {
        let changed = self.documents.iter().filter(|(_, document)| !document.is_told);
        let changed: Vec<String> = changed.map(|(uri, _)| uri.clone()).collect();
        for uri in changed {
            let Some(analysis) = self.analysis(&uri) else { continue };
            if let Some(document) = self.documents.get_mut(&uri) {
                document.is_told = true;
            }
            self.tell(&uri);
            self.evaluate(uri, analysis);
        }
    }

    fn evaluate(&mut self, uri: String, analysis: Arc<Analysis>) {
        if analysis.is_classic() || analysis.has_errors() {
            return;
        }
        let Some(root) = self.documents.get(&uri).map(|document| document.home.root.clone()) else { return };
        let (folder, open) = (self.folder(&root), Arc::new(self.open_texts(&root)));
        let _ = self.worker.send(Job { uri, analysis, folder, open });
    }

    /// Takes in what evaluation found, unless the text is another by now.
    pub(crate) fn evaluated(&mut self, evaluated: Evaluated) {
        let Some(document) = self.documents.get_mut(&evaluated.uri) else { return };
        let is_current =
            document.analysis.as_ref().is_some_and(|analysis| Arc::ptr_eq(analysis, &evaluated.analysis));
        if is_current && document.evaluated != evaluated.remarks {
            document.evaluated = evaluated.remarks;
            self.tell(&evaluated.uri);
        }
    }

    /// Tells what is wrong with a document.
    fn tell(&mut self, uri: &str) {
        let Some(analysis) = self.analysis(uri) else { return };
        let Some(document) = self.documents.get(uri) else { return };
        // What lists the library is not a scene.
        let is_library = uri::to_path(uri).is_some_and(|path| path.starts_with(library::folder()));
        let mut remarks = if is_library { Vec::new() } else { analysis.remarks() };
        remarks.extend(document.evaluated.iter().cloned());
        let (version, root) = (document.version, document.home.root.clone());
        let mut diagnostics = Vec::with_capacity(remarks.len());
        for remark in &remarks {
            let related = remark.related.iter();
            let related =
                related.filter_map(|(place, text)| Some((self.location(&root, place)?, text.clone())));
            let related = related.collect();
            let Some(document) = self.documents.get(uri) else { return };
            let range = document.range(remark.span, self.client.encoding);
            diagnostics.push(convert::diagnostic(remark, range, related));
        }
        self.publish(uri, diagnostics, Some(version));
    }

    fn publish(&self, uri: &str, diagnostics: Vec<lsp_types::Diagnostic>, version: Option<i32>) {
        let Ok(uri) = Uri::from_str(uri) else { return };
        let params = PublishDiagnosticsParams { uri, diagnostics, version };
        let notification = Notification::new(PublishDiagnostics::METHOD.to_owned(), params);
        self.output.send(Message::Notification(notification));
    }

    /// The document at a path in a folder, where it is open.
    pub(super) fn open_at(&self, root: &Option<PathBuf>, path: &str) -> Option<(&String, &Document)> {
        self.documents.iter().find(|(_, document)| document.home.root == *root && document.home.path == path)
    }

    /// The URI and the text of a file.
    pub(super) fn file(&mut self, root: &Option<PathBuf>, file: &FileId) -> Option<(String, Arc<str>)> {
        match file {
            FileId::Library(name) => {
                let path = library::file(name)?;
                Some((uri::from_path(&path), hray::ide::library_text(name)?.into()))
            }
            FileId::Own(path) => {
                if let Some((uri, document)) = self.open_at(root, path) {
                    return Some((uri.clone(), document.text.clone()));
                }
                let nothing = OpenTexts::new();
                let text = self.folder(root).with(&nothing).text(path).ok()?;
                Some((uri::from_path(&root.as_ref()?.join(path)), text.into()))
            }
        }
    }

    /// A place as the protocol has it.
    pub(super) fn location(&mut self, root: &Option<PathBuf>, place: &Place) -> Option<Location> {
        let (uri, text) = self.file(root, &place.file)?;
        let range: Range = Lines::new(&text).range(&text, place.span, self.client.encoding);
        Some(Location { uri: Uri::from_str(&uri).ok()?, range })
    }
}

/// Does something with parameters that can be read; nobody can be told of others.
fn with<T: DeserializeOwned>(params: serde_json::Value, action: impl FnOnce(T)) {
    if let Ok(params) = serde_json::from_value(params) {
        action(params);
    }
}
