//! Answers that change texts.

use super::convert;
use super::position::Lines;
use super::requests::Refusal;
use super::server::Server;
use hray::ide::{Analysis, Edit, FileId, Place, rename};
use hray::{Assets, OpenTexts, Span};
use hray_session::{MOST_NEIGHBOURS, difference};
use lsp_types::{
    CodeAction, CodeActionKind, CodeActionOrCommand, CodeActionParams, DocumentChanges,
    DocumentFormattingParams, OneOf, OptionalVersionedTextDocumentIdentifier, PrepareRenameResponse,
    RenameParams, TextDocumentEdit, TextDocumentPositionParams, TextEdit, Uri, WorkspaceEdit,
};
use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;
use std::str::FromStr;
use std::sync::Arc;

impl Server {
    /// Analyses of the open texts of a folder, of files that lie beside a text or a definition it uses, and of those
    /// anywhere below a folder that the client works in: whatever else may use that definition.
    pub(super) fn neighbours(
        &mut self,
        root: &Option<PathBuf>,
        analysis: &Arc<Analysis>,
        defined: &Place,
    ) -> Vec<Arc<Analysis>> {
        let open: Vec<String> = self.documents.keys().cloned().collect();
        let mut found: Vec<Arc<Analysis>> = vec![analysis.clone()];
        for uri in open {
            let same = self.documents.get(&uri).is_some_and(|document| document.home.root == *root);
            if same && root.is_some() {
                found.extend(self.analysis(&uri).filter(|other| other.path() != analysis.path()));
            }
        }
        let (folder, texts) = (self.folder(root), self.open_texts(root));
        let assets = folder.with(&texts);
        let FileId::Own(path) = &defined.file else { return found };
        let beside = [path.as_str(), analysis.path()].into_iter().flat_map(|path| assets.neighbours(path));
        let beside: BTreeSet<String> = beside.filter(|path| path.ends_with(".hry")).collect();
        let in_workspace = root.as_ref().is_some_and(|root| self.workspace.contains(root));
        let below = if in_workspace { folder.scenes(MOST_NEIGHBOURS) } else { Vec::new() };
        let below = below.into_iter().filter(|path| !beside.contains(path));
        let paths = beside.iter().cloned().chain(below).filter(|path| !texts.contains_key(path));
        found.extend(hray_session::users(paths, defined, &assets));
        found
    }

    pub(super) fn prepare_rename(
        &mut self,
        params: TextDocumentPositionParams,
    ) -> Result<Option<PrepareRenameResponse>, Refusal> {
        let Some(at) = self.at(&params) else { return Ok(None) };
        let renaming = at.analysis.renaming(at.offset).map_err(Refusal)?;
        let range =
            self.documents.get(&at.uri).map(|document| document.range(renaming.span, self.client.encoding));
        Ok(range
            .map(|range| PrepareRenameResponse::RangeWithPlaceholder { range, placeholder: renaming.name }))
    }

    pub(super) fn rename(&mut self, params: RenameParams) -> Result<Option<WorkspaceEdit>, Refusal> {
        let Some(at) = self.at(&params.text_document_position) else { return Ok(None) };
        let renaming = at.analysis.renaming(at.offset).map_err(Refusal)?;
        let all = self.neighbours(&at.root, &at.analysis, &renaming.defined);
        let roots: Vec<&Analysis> = all.iter().map(Arc::as_ref).collect();
        let folder = self.folder(&at.root);
        let mut texts: OpenTexts = self.open_texts(&at.root);
        texts.insert(at.analysis.path().to_owned(), at.analysis.text().clone());
        let text_of = |path: &str| folder.with(&texts).text(path).ok();
        let reread = |path: &str, changed: &BTreeMap<String, String>| {
            let mut now = texts.clone();
            now.extend(changed.iter().map(|(path, text)| (path.clone(), Arc::from(text.as_str()))));
            let assets = folder.with(&now);
            Some(Analysis::new(path, assets.text(path).ok()?.into(), &assets))
        };
        let edits = rename(&roots, &renaming, params.new_name.trim(), text_of, reread).map_err(Refusal)?;
        Ok(Some(self.workspace_edit(&at.root, &at.uri, at.analysis.path(), &edits)))
    }

    /// Edits by file. `own` is the URI of the file at `own_path`, which may be in no folder.
    fn workspace_edit(
        &mut self,
        root: &Option<PathBuf>,
        own: &str,
        own_path: &str,
        edits: &[Edit],
    ) -> WorkspaceEdit {
        let mut by_file: BTreeMap<String, (Option<i32>, Vec<TextEdit>)> = BTreeMap::new();
        for edit in edits {
            let file = if edit.path == own_path {
                self.documents.get(own).map(|document| (own.to_owned(), document.text.clone()))
            } else {
                self.file(root, &FileId::Own(edit.path.clone()))
            };
            let Some((uri, text)) = file else { continue };
            let range = Lines::new(&text).range(&text, edit.span, self.client.encoding);
            let version = self.documents.get(&uri).map(|document| document.version);
            let entry = by_file.entry(uri).or_insert((version, Vec::new()));
            entry.1.push(TextEdit { range, new_text: edit.text.clone() });
        }
        self.edit_of(by_file)
    }

    /// With versions where the client knows them, so that an edit is not made to a text that has changed since.
    fn edit_of(&self, by_file: BTreeMap<String, (Option<i32>, Vec<TextEdit>)>) -> WorkspaceEdit {
        let files = by_file.into_iter().filter_map(|(uri, edits)| Some((Uri::from_str(&uri).ok()?, edits)));
        if self.client.versioned_edits {
            let edits = files.map(|(uri, (version, edits))| TextDocumentEdit {
                text_document: OptionalVersionedTextDocumentIdentifier { uri, version },
                edits: edits.into_iter().map(OneOf::Left).collect(),
            });
            let changes = Some(DocumentChanges::Edits(edits.collect()));
            return WorkspaceEdit { document_changes: changes, ..WorkspaceEdit::default() };
        }
        #[allow(
            clippy::mutable_key_type,
            reason = "the protocol's types have it so; nobody changes the keys"
        )]
        let changes = files.map(|(uri, (_, edits))| (uri, edits)).collect();
        WorkspaceEdit { changes: Some(changes), ..WorkspaceEdit::default() }
    }

    /// The common layout, as one edit of what differs. Nothing for classic files and for texts with errors.
    pub(super) fn formatting(
        &mut self,
        params: DocumentFormattingParams,
    ) -> Result<Option<Vec<TextEdit>>, Refusal> {
        let uri = params.text_document.uri.as_str();
        let (Some(analysis), Some(document)) = (self.analysis(uri), self.documents.get(uri)) else {
            return Ok(None);
        };
        let Some(new) = analysis.formatted() else { return Ok(None) };
        let edit = difference(&document.text, &new).map(|(span, new_text)| {
            let range = document.range(span, self.client.encoding);
            TextEdit { range, new_text: new_text.to_owned() }
        });
        Ok(Some(edit.into_iter().collect()))
    }

    /// The replacements that diagnostics propose.
    pub(super) fn code_actions(
        &mut self,
        params: CodeActionParams,
    ) -> Result<Vec<CodeActionOrCommand>, Refusal> {
        let uri = params.text_document.uri.as_str();
        let (Some(analysis), Some(document)) = (self.analysis(uri), self.documents.get(uri)) else {
            return Ok(Vec::new());
        };
        let asked = document.lines.span(&document.text, params.range, self.client.encoding);
        let touches = |span: Span| span.start <= asked.end && asked.start <= span.end;
        let mut found = Vec::new();
        for remark in analysis.remarks().iter().chain(&document.evaluated) {
            let Some(fix) = remark.fix.as_ref().filter(|fix| touches(remark.span) || touches(fix.span))
            else {
                continue;
            };
            let range = document.range(fix.span, self.client.encoding);
            let edit = TextEdit { range, new_text: fix.replacement.clone() };
            let by_file = BTreeMap::from([(uri.to_owned(), (Some(document.version), vec![edit]))]);
            let shown = document.range(remark.span, self.client.encoding);
            found.push(CodeActionOrCommand::CodeAction(CodeAction {
                title: fix.title.clone(),
                kind: Some(CodeActionKind::QUICKFIX),
                diagnostics: Some(vec![convert::diagnostic(remark, shown, Vec::new())]),
                edit: Some(self.edit_of(by_file)),
                is_preferred: Some(true),
                ..CodeAction::default()
            }));
        }
        Ok(found)
    }
}
