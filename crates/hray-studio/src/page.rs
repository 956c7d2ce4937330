//! The page's files.

use crate::embedded;
use axum::body::Body;
use axum::http::{HeaderName, HeaderValue, Response, StatusCode, header};

/// What the page may do: load what is its own, and talk to this server. Styles of single elements are what the editor sets.
const POLICY: &str = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self' blob:; \
    style-src 'self' 'unsafe-inline'; font-src 'self' data:; img-src 'self' data: blob:; connect-src 'self' ws://127.0.0.1:* \
    ws://localhost:* data: blob:; manifest-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// Shown where the page was not built into the program.
const NO_PAGE: &str = "This hray was built without the page of the studio: crates/hray-studio/dist was empty. \
    crates/hray-studio/page/README.md says how it is built.\n";

/// The answer to a request for a file.
pub(crate) fn file(path: &str) -> Response<Body> {
    let path = match path.trim_start_matches('/') {
        "" => "index.html",
        path => path,
    };
    match embedded::page(path) {
        Some(bytes) => answer(StatusCode::OK, mime(path), Body::from(bytes)),
        None if path == "index.html" => {
            answer(StatusCode::OK, "text/plain; charset=utf-8", Body::from(NO_PAGE))
        }
        None => text(StatusCode::NOT_FOUND, "there is no such file\n"),
    }
}

/// A few words as an answer.
pub(crate) fn text(status: StatusCode, words: &'static str) -> Response<Body> {
    answer(status, "text/plain; charset=utf-8", Body::from(words))
}

/// An answer with the headers that all have.
pub(crate) fn answer(status: StatusCode, mime: &'static str, body: Body) -> Response<Body> {
    let mut response = Response::new(body);
    *response.status_mut() = status;
    let headers = response.headers_mut();
    let all: [(HeaderName, &'static str); 7] = [
        (header::CONTENT_TYPE, mime),
        (header::CACHE_CONTROL, "no-cache"),
        (header::CONTENT_SECURITY_POLICY, POLICY),
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        // The address has the token in it.
        (header::REFERRER_POLICY, "no-referrer"),
        (header::X_FRAME_OPTIONS, "DENY"),
        (HeaderName::from_static("cross-origin-resource-policy"), "same-origin"),
    ];
    for (name, value) in all {
        headers.insert(name, HeaderValue::from_static(value));
    }
    response
}

fn mime(path: &str) -> &'static str {
    match path.rsplit_once('.').map_or("", |(_, ending)| ending) {
        "html" => "text/html; charset=utf-8",
        "js" | "mjs" => "text/javascript; charset=utf-8",
        "css" => "text/css; charset=utf-8",
        "json" | "map" | "webmanifest" => "application/json",
        "svg" => "image/svg+xml",
        "png" => "image/png",
        "jpg" => "image/jpeg",
        "webp" => "image/webp",
        "woff2" => "font/woff2",
        "wasm" => "application/wasm",
        "ico" => "image/x-icon",
        _ => "text/plain; charset=utf-8",
    }
}
