//! Which request is answered by what.

use super::server::Server;
use lsp_server::{ErrorCode, Request, Response};
use lsp_types::request::{
    CodeActionRequest, ColorPresentationRequest, Completion, DocumentColor, DocumentHighlightRequest,
    DocumentSymbolRequest, Formatting, GotoDefinition, HoverRequest, PrepareRenameRequest, References,
    Rename, Request as _,
};
use serde::Serialize;
use serde::de::DeserializeOwned;

/// Why there is no answer.
#[derive(Debug)]
pub(super) struct Refusal(pub(super) String);

impl Server {
    pub(crate) fn request(&mut self, request: Request) -> Response {
        match request.method.as_str() {
            HoverRequest::METHOD => self.answer(request, Self::hover),
            Completion::METHOD => self.answer(request, Self::completion),
            GotoDefinition::METHOD => self.answer(request, Self::definition),
            References::METHOD => self.answer(request, Self::references),
            DocumentHighlightRequest::METHOD => self.answer(request, Self::highlights),
            DocumentSymbolRequest::METHOD => self.answer(request, Self::symbols),
            DocumentColor::METHOD => self.answer(request, Self::colors),
            ColorPresentationRequest::METHOD => self.answer(request, Self::presentations),
            PrepareRenameRequest::METHOD => self.answer(request, Self::prepare_rename),
            Rename::METHOD => self.answer(request, Self::rename),
            Formatting::METHOD => self.answer(request, Self::formatting),
            CodeActionRequest::METHOD => self.answer(request, Self::code_actions),
            method => {
                let why = format!("{method} is not something this server does");
                Response::new_err(request.id, ErrorCode::MethodNotFound as i32, why)
            }
        }
    }

    fn answer<P: DeserializeOwned, R: Serialize>(
        &mut self,
        request: Request,
        answer: impl FnOnce(&mut Self, P) -> Result<R, Refusal>,
    ) -> Response {
        let refuse = |code: ErrorCode, why: String| Response::new_err(request.id.clone(), code as i32, why);
        let params = match serde_json::from_value(request.params) {
            Ok(params) => params,
            Err(error) => return refuse(ErrorCode::InvalidParams, error.to_string()),
        };
        match answer(self, params) {
            Ok(result) => match serde_json::to_value(result) {
                Ok(value) => Response::new_ok(request.id, value),
                Err(error) => refuse(ErrorCode::InternalError, error.to_string()),
            },
            Err(Refusal(why)) => refuse(ErrorCode::RequestFailed, why),
        }
    }
}
