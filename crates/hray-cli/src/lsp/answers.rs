//! Answers that show something.

use super::convert;
use super::requests::Refusal;
use super::server::Server;
use hray::ide::{Analysis, FileId, Symbol};
use lsp_types::{
    Color, ColorInformation, ColorPresentation, ColorPresentationParams, CompletionParams,
    CompletionResponse, DocumentColorParams, DocumentHighlight, DocumentHighlightParams, DocumentSymbol,
    DocumentSymbolParams, DocumentSymbolResponse, GotoDefinitionParams, GotoDefinitionResponse, Hover,
    HoverParams, Location, ReferenceParams, SymbolInformation, TextDocumentPositionParams, TextEdit, Uri,
};
use std::path::PathBuf;
use std::sync::Arc;

/// A place in a document that is open.
pub(super) struct At {
    pub(super) uri: String,
    pub(super) root: Option<PathBuf>,
    pub(super) analysis: Arc<Analysis>,
    pub(super) offset: usize,
}

impl Server {
    /// The place that a request is about; none where the document is not open.
    pub(super) fn at(&mut self, params: &TextDocumentPositionParams) -> Option<At> {
        let uri = params.text_document.uri.as_str().to_owned();
        let analysis = self.analysis(&uri)?;
        let document = self.documents.get(&uri)?;
        let (root, offset) =
            (document.home.root.clone(), document.offset(params.position, self.client.encoding));
        Some(At { uri, root, analysis, offset })
    }

    pub(super) fn hover(&mut self, params: HoverParams) -> Result<Option<Hover>, Refusal> {
        let Some(at) = self.at(&params.text_document_position_params) else { return Ok(None) };
        let Some(hover) = at.analysis.hover(at.offset) else { return Ok(None) };
        let range =
            self.documents.get(&at.uri).map(|document| document.range(hover.span, self.client.encoding));
        Ok(range.map(|range| convert::hover(&hover, range, self.client.images)))
    }

    pub(super) fn completion(
        &mut self,
        params: CompletionParams,
    ) -> Result<Option<CompletionResponse>, Refusal> {
        let Some(at) = self.at(&params.text_document_position) else { return Ok(None) };
        let (folder, open) = (self.folder(&at.root), self.open_texts(&at.root));
        let found = at.analysis.completions(at.offset, &folder.with(&open));
        let Some(document) = self.documents.get(&at.uri) else { return Ok(None) };
        let item = |suggestion: &hray::ide::Suggestion| {
            let range = document.range(suggestion.span, self.client.encoding);
            convert::completion(suggestion, range, self.client.snippets)
        };
        Ok(Some(CompletionResponse::Array(found.iter().map(item).collect())))
    }

    pub(super) fn definition(
        &mut self,
        params: GotoDefinitionParams,
    ) -> Result<Option<GotoDefinitionResponse>, Refusal> {
        let Some(at) = self.at(&params.text_document_position_params) else { return Ok(None) };
        let place = at.analysis.definition(at.offset);
        let location = place.and_then(|place| self.location(&at.root, &place));
        Ok(location.map(GotoDefinitionResponse::Scalar))
    }

    pub(super) fn references(&mut self, params: ReferenceParams) -> Result<Option<Vec<Location>>, Refusal> {
        let Some(at) = self.at(&params.text_document_position) else { return Ok(None) };
        let with_definition = params.context.include_declaration;
        let mut places = at.analysis.references(at.offset, with_definition);
        let defined = at.analysis.definition(at.offset);
        if let Some(defined) = defined.filter(|place| matches!(place.file, FileId::Own(_))) {
            for other in self.neighbours(&at.root, &at.analysis, &defined) {
                let more = other.uses_of(&defined).into_iter();
                places.extend(more.filter(|place| with_definition || *place != defined));
            }
        }
        places.sort();
        places.dedup();
        Ok(Some(places.iter().filter_map(|place| self.location(&at.root, place)).collect()))
    }

    pub(super) fn highlights(
        &mut self,
        params: DocumentHighlightParams,
    ) -> Result<Option<Vec<DocumentHighlight>>, Refusal> {
        let Some(at) = self.at(&params.text_document_position_params) else { return Ok(None) };
        let here = FileId::Own(at.analysis.path().to_owned());
        let places = at.analysis.references(at.offset, true).into_iter().filter(|place| place.file == here);
        let Some(document) = self.documents.get(&at.uri) else { return Ok(None) };
        let range = |span| document.range(span, self.client.encoding);
        Ok(Some(places.map(|place| DocumentHighlight { range: range(place.span), kind: None }).collect()))
    }

    pub(super) fn symbols(
        &mut self,
        params: DocumentSymbolParams,
    ) -> Result<Option<DocumentSymbolResponse>, Refusal> {
        let uri = params.text_document.uri;
        let Some(analysis) = self.analysis(uri.as_str()) else { return Ok(None) };
        let symbols = analysis.symbols();
        if self.client.nested_symbols {
            let nested = symbols.iter().filter_map(|symbol| self.nested(&uri, symbol)).collect();
            return Ok(Some(DocumentSymbolResponse::Nested(nested)));
        }
        let mut flat = Vec::new();
        self.flat(&uri, &symbols, None, &mut flat);
        Ok(Some(DocumentSymbolResponse::Flat(flat)))
    }

    #[allow(deprecated, reason = "a field that must be given, if only as nothing")]
    fn nested(&self, uri: &Uri, symbol: &Symbol) -> Option<DocumentSymbol> {
        let document = self.documents.get(uri.as_str())?;
        let children: Vec<_> = symbol.children.iter().filter_map(|child| self.nested(uri, child)).collect();
        Some(DocumentSymbol {
            name: symbol.name.clone(),
            detail: symbol.detail.clone(),
            kind: convert::symbol_kind(symbol),
            tags: None,
            deprecated: None,
            range: document.range(symbol.span, self.client.encoding),
            selection_range: document.range(symbol.name_span, self.client.encoding),
            children: (!children.is_empty()).then_some(children),
        })
    }

    #[allow(deprecated, reason = "a field that must be given, if only as nothing")]
    fn flat(
        &self,
        uri: &Uri,
        symbols: &[Symbol],
        container: Option<&str>,
        into: &mut Vec<SymbolInformation>,
    ) {
        let Some(document) = self.documents.get(uri.as_str()) else { return };
        for symbol in symbols {
            into.push(SymbolInformation {
                name: symbol.name.clone(),
                kind: convert::symbol_kind(symbol),
                tags: None,
                deprecated: None,
                location: Location {
                    uri: uri.clone(),
                    range: document.range(symbol.span, self.client.encoding),
                },
                container_name: container.map(str::to_owned),
            });
            self.flat(uri, &symbol.children, Some(&symbol.name), into);
        }
    }

    pub(super) fn colors(&mut self, params: DocumentColorParams) -> Result<Vec<ColorInformation>, Refusal> {
        let uri = params.text_document.uri.as_str();
        let (Some(analysis), Some(document)) = (self.analysis(uri), self.documents.get(uri)) else {
            return Ok(Vec::new());
        };
        let colors = analysis.colors().into_iter();
        let colors = colors.map(|place| {
            let [red, green, blue] = place.color.map(|part| part as f32);
            let range = document.range(place.span, self.client.encoding);
            ColorInformation { range, color: Color { red, green, blue, alpha: 1.0 } }
        });
        Ok(colors.collect())
    }

    pub(super) fn presentations(
        &mut self,
        params: ColorPresentationParams,
    ) -> Result<Vec<ColorPresentation>, Refusal> {
        let uri = params.text_document.uri.as_str();
        let (Some(analysis), Some(document)) = (self.analysis(uri), self.documents.get(uri)) else {
            return Ok(Vec::new());
        };
        let span = document.lines.span(&document.text, params.range, self.client.encoding);
        let color = [params.color.red, params.color.green, params.color.blue].map(f64::from);
        let ways = analysis.presentations(span, color).into_iter();
        let ways = ways.map(|way| ColorPresentation {
            label: way.label,
            text_edit: Some(TextEdit { range: params.range, new_text: way.text }),
            additional_text_edits: None,
        });
        Ok(ways.collect())
    }
}
