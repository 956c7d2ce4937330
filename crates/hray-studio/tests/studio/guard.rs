//! Who may come in.

use crate::page::{Page, Studio, http, parts};
use serde_json::json;

#[test]
fn only_this_machine_is_answered() {
    let studio = Studio::with(&[]);
    assert!(studio.server.address().starts_with("http://127.0.0.1:"));
    let (host, query) = parts(&studio.server);
    assert_eq!(query.len(), "token=".len() + 32);
    // No other address of this machine leads to it.
    let port = host.rsplit_once(':').unwrap().1;
    let all = std::net::TcpListener::bind(format!("127.0.0.2:{port}"));
    assert!(all.is_ok(), "it listens everywhere");
}

#[test]
fn other_hosts_and_other_origins_are_refused() {
    let studio = Studio::with(&[]);
    let (host, query) = parts(&studio.server);
    let port = host.rsplit_once(':').unwrap().1;
    let status = |head: &str| {
        let answer =
            http(&studio.server, &format!("GET /alive?{query} HTTP/1.1\r\n{head}Connection: close\r\n\r\n"));
        answer.split_whitespace().nth(1).unwrap_or("none").to_owned()
    };
    assert_eq!(status(&format!("Host: {host}\r\n")), "200");
    assert_eq!(status(&format!("Host: localhost:{port}\r\nOrigin: http://localhost:{port}\r\n")), "200");
    for head in [
        // A name server of somebody else's may lead to 127.0.0.1.
        format!("Host: evil.example:{port}\r\n"),
        "Host: 127.0.0.1\r\n".to_owned(),
        "Host: \r\n".to_owned(),
        format!("Host: {host}\r\nHost: evil.example\r\n"),
        format!("Host: {host}\r\nOrigin: http://evil.example\r\n"),
        format!("Host: {host}\r\nOrigin: null\r\n"),
        format!("Host: {host}\r\nOrigin: https://{host}\r\n"),
        format!("Host: {host}\r\nOrigin: http://{host}.evil.example\r\n"),
        format!("Host: {host}\r\nOrigin: http://127.0.0.1:1\r\n"),
    ] {
        assert_eq!(status(&head), "403", "{head}");
    }
}

#[test]
fn a_page_needs_the_token() {
    let studio = Studio::with(&[("secret.hry", "gold = 1\n")]);
    let (host, query) = parts(&studio.server);
    let upgrade = |query: &str, origin: &str| {
        let head = format!(
            "GET /ws{query} HTTP/1.1\r\nHost: {host}\r\nOrigin: {origin}\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n\
             Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"
        );
        http(&studio.server, &head).split_whitespace().nth(1).unwrap_or("none").to_owned()
    };
    let own = format!("http://{host}");
    assert_eq!(upgrade(&format!("?{query}"), &own), "101");
    assert_eq!(upgrade(&format!("?{query}"), "http://evil.example"), "403");
    let wrong = format!("?token={}", "0".repeat(32));
    for query in
        ["", "?token=", "?token", &wrong, &format!("?{query}0"), &format!("?{}", &query[..query.len() - 1])]
    {
        assert_eq!(upgrade(query, &own), "403", "{query}");
    }
}

#[test]
fn a_page_can_tell_whether_it_is_the_same_studio() {
    let studio = Studio::with(&[]);
    let (host, query) = parts(&studio.server);
    let alive = |query: &str| {
        http(
            &studio.server,
            &format!("GET /alive{query} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n"),
        )
    };
    assert!(alive(&format!("?{query}")).ends_with(r#"{"alive":true,"token":true}"#));
    assert!(alive("?token=other").ends_with(r#"{"alive":true,"token":false}"#));
}

#[test]
fn the_page_may_load_nothing_from_elsewhere() {
    let studio = Studio::with(&[]);
    let (host, _) = parts(&studio.server);
    let get = |method: &str, path: &str| {
        http(
            &studio.server,
            &format!("{method} {path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n"),
        )
        .to_lowercase()
    };
    let page = get("GET", "/");
    for header in [
        "http/1.1 200",
        "content-security-policy: default-src 'none'; script-src 'self'",
        "frame-ancestors 'none'",
        "x-content-type-options: nosniff",
        "referrer-policy: no-referrer",
    ] {
        assert!(page.contains(header), "{header}: {page}");
    }
    for path in ["/none", "/../Cargo.toml", "/%2e%2e/Cargo.toml", "//etc/hostname"] {
        assert!(get("GET", path).starts_with("http/1.1 404"), "{path}");
    }
    assert!(get("POST", "/").starts_with("http/1.1 405"));
    assert!(get("PUT", "/x").starts_with("http/1.1 405"));
    assert!(get("GET", "/ws").starts_with("http/1.1 403"));
}

#[test]
fn so_many_pages_and_no_more() {
    let studio = Studio::with(&[]);
    let mut pages: Vec<Page> = (0..16).map(|_| studio.page()).collect();
    let (host, query) = parts(&studio.server);
    let head = format!(
        "GET /ws?{query} HTTP/1.1\r\nHost: {host}\r\nConnection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n\
         Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"
    );
    assert!(http(&studio.server, &head).contains("503"));
    for page in &mut pages {
        assert!(page.ask(json!({ "do": "hello" })).is_ok());
    }
    pages.pop().unwrap().close();
    let again = (0..200).any(|_| {
        std::thread::sleep(std::time::Duration::from_millis(20));
        http(&studio.server, &head).contains(" 101 ")
    });
    assert!(again);
}
