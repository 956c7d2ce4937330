//! From our words to those of the protocol.

use super::position::Encoding;
use hray::Severity;
use hray::ide::{Hover, Remark, Suggestion, SuggestionKind, Symbol, SymbolKind};
use lsp_types::{
    CodeActionKind, CodeActionOptions, CodeActionProviderCapability, ColorProviderCapability, CompletionItem,
    CompletionItemKind, CompletionOptions, CompletionTextEdit, DiagnosticRelatedInformation,
    DiagnosticSeverity, DiagnosticTag, Documentation, HoverContents, HoverProviderCapability,
    InitializeResult, InsertTextFormat, Location, MarkupContent, MarkupKind, NumberOrString, OneOf, Range,
    RenameOptions, ServerCapabilities, ServerInfo, TextDocumentSyncCapability, TextDocumentSyncKind,
    TextEdit, WorkspaceFoldersServerCapabilities, WorkspaceServerCapabilities,
};

/// What this server can do.
pub(crate) fn capabilities(encoding: Encoding) -> serde_json::Value {
    let characters = |list: &[&str]| Some(list.iter().map(|c| (*c).to_owned()).collect());
    let capabilities = ServerCapabilities {
        position_encoding: Some(encoding.kind()),
        text_document_sync: Some(TextDocumentSyncCapability::Kind(TextDocumentSyncKind::INCREMENTAL)),
        hover_provider: Some(HoverProviderCapability::Simple(true)),
        completion_provider: Some(CompletionOptions {
            trigger_characters: characters(&[".", "{", "\"", "/"]),
            ..CompletionOptions::default()
        }),
        definition_provider: Some(OneOf::Left(true)),
        references_provider: Some(OneOf::Left(true)),
        document_highlight_provider: Some(OneOf::Left(true)),
        document_symbol_provider: Some(OneOf::Left(true)),
        document_formatting_provider: Some(OneOf::Left(true)),
        rename_provider: Some(OneOf::Right(RenameOptions {
            prepare_provider: Some(true),
            work_done_progress_options: lsp_types::WorkDoneProgressOptions::default(),
        })),
        color_provider: Some(ColorProviderCapability::Simple(true)),
        code_action_provider: Some(CodeActionProviderCapability::Options(CodeActionOptions {
            code_action_kinds: Some(vec![CodeActionKind::QUICKFIX]),
            ..CodeActionOptions::default()
        })),
        workspace: Some(WorkspaceServerCapabilities {
            workspace_folders: Some(WorkspaceFoldersServerCapabilities {
                supported: Some(true),
                change_notifications: Some(OneOf::Left(true)),
            }),
            file_operations: None,
        }),
        ..ServerCapabilities::default()
    };
    let info = ServerInfo { name: "hray".into(), version: Some(env!("CARGO_PKG_VERSION").into()) };
    serde_json::to_value(InitializeResult { capabilities, server_info: Some(info) }).unwrap_or_default()
}

pub(crate) fn diagnostic(
    remark: &Remark,
    range: Range,
    related: Vec<(Location, String)>,
) -> lsp_types::Diagnostic {
    let related = related.into_iter();
    let related: Vec<_> = related
        .map(|(location, message)| DiagnosticRelatedInformation { location, message })
        .filter(|related| !related.message.is_empty())
        .collect();
    lsp_types::Diagnostic {
        range,
        severity: Some(match remark.severity {
            Severity::Error => DiagnosticSeverity::ERROR,
            Severity::Warning => DiagnosticSeverity::WARNING,
        }),
        code: Some(NumberOrString::String(remark.code.to_owned())),
        source: Some("hray".into()),
        message: remark.message.clone(),
        related_information: (!related.is_empty()).then_some(related),
        tags: remark.is_unnecessary.then(|| vec![DiagnosticTag::UNNECESSARY]),
        ..lsp_types::Diagnostic::default()
    }
}

pub(crate) fn hover(hover: &Hover, range: Range, images: bool) -> lsp_types::Hover {
    let mut parts = Vec::new();
    if !hover.code.is_empty() {
        parts.push(format!("```hry\n{}\n```", hover.code));
    }
    if let Some(color) = hover.color {
        let [r, g, b] = color.map(|part| (part.clamp(0.0, 1.0) * 255.0).round() as u8);
        let hex = format!("{r:02x}{g:02x}{b:02x}");
        let swatch = if images {
            // A square of the colour.
            format!(
                "![#{hex}](data:image/svg+xml,%3Csvg%20xmlns='http://www.w3.org/2000/svg'%20width='48'%20height='16'%3E\
                 %3Crect%20width='48'%20height='16'%20fill='%23{hex}'/%3E%3C/svg%3E) "
            )
        } else {
            String::new()
        };
        parts.push(format!("{swatch}`#{hex}`"));
    }
    if !hover.text.is_empty() {
        parts.push(hover.text.clone());
    }
    let value = parts.join("\n\n");
    lsp_types::Hover {
        contents: HoverContents::Markup(MarkupContent { kind: MarkupKind::Markdown, value }),
        range: Some(range),
    }
}

pub(crate) fn completion(suggestion: &Suggestion, range: Range, snippets: bool) -> CompletionItem {
    let snippet = suggestion.snippet.as_ref().filter(|_| snippets);
    let new_text = snippet.unwrap_or(&suggestion.text).clone();
    let documentation = (!suggestion.documentation.is_empty()).then(|| {
        let value = suggestion.documentation.clone();
        Documentation::MarkupContent(MarkupContent { kind: MarkupKind::Markdown, value })
    });
    CompletionItem {
        label: suggestion.label.clone(),
        kind: Some(match suggestion.kind {
            SuggestionKind::Function => CompletionItemKind::FUNCTION,
            SuggestionKind::Constructor => CompletionItemKind::CONSTRUCTOR,
            SuggestionKind::Value => CompletionItemKind::CONSTANT,
            SuggestionKind::Local => CompletionItemKind::VARIABLE,
            SuggestionKind::Field => CompletionItemKind::FIELD,
            SuggestionKind::Keyword => CompletionItemKind::KEYWORD,
            SuggestionKind::Type => CompletionItemKind::CLASS,
            SuggestionKind::File => CompletionItemKind::FILE,
            SuggestionKind::Folder => CompletionItemKind::FOLDER,
            SuggestionKind::Module => CompletionItemKind::MODULE,
        }),
        detail: (!suggestion.detail.is_empty()).then(|| suggestion.detail.clone()),
        documentation,
        sort_text: Some(format!("{:04}{}", suggestion.rank, suggestion.label)),
        filter_text: Some(suggestion.label.clone()),
        insert_text_format: Some(if snippet.is_some() {
            InsertTextFormat::SNIPPET
        } else {
            InsertTextFormat::PLAIN_TEXT
        }),
        text_edit: Some(CompletionTextEdit::Edit(TextEdit { range, new_text })),
        ..CompletionItem::default()
    }
}

pub(crate) fn symbol_kind(symbol: &Symbol) -> lsp_types::SymbolKind {
    match symbol.kind {
        SymbolKind::Scene => lsp_types::SymbolKind::MODULE,
        SymbolKind::Function => lsp_types::SymbolKind::FUNCTION,
        SymbolKind::Value => lsp_types::SymbolKind::CONSTANT,
    }
}
