//! Who may come in.

use axum::http::{HeaderMap, header};

/// What requests have to show.
#[derive(Clone, Debug)]
pub(crate) struct Guard {
    port: u16,
    token: String,
}

impl Guard {
    /// With a new token.
    pub(crate) fn new(port: u16) -> Result<Self, getrandom::Error> {
        let mut bytes = [0; 16];
        getrandom::fill(&mut bytes)?;
        Ok(Self { port, token: bytes.iter().map(|byte| format!("{byte:02x}")).collect() })
    }

    pub(crate) fn token(&self) -> &str {
        &self.token
    }

    /// Whether a request was sent to this server, under a name that only this machine has, and, where a page sent it, by a page
    /// of this server: any other may be one that a name server leads here.
    pub(crate) fn admits(&self, headers: &HeaderMap) -> bool {
        let hosts = [format!("127.0.0.1:{}", self.port), format!("localhost:{}", self.port)];
        let mut host = headers.get_all(header::HOST).iter();
        let known =
            host.next().is_some_and(|host| hosts.iter().any(|known| host.as_bytes() == known.as_bytes()));
        let origins = hosts.each_ref().map(|host| format!("http://{host}"));
        let own = |origin: &[u8]| origins.iter().any(|known| origin == known.as_bytes());
        known
            && host.next().is_none()
            && headers.get_all(header::ORIGIN).iter().all(|origin| own(origin.as_bytes()))
    }

    /// Whether a query has the token.
    pub(crate) fn knows(&self, query: Option<&str>) -> bool {
        let given = query.unwrap_or("").split('&').find_map(|pair| pair.strip_prefix("token="));
        let given = given.unwrap_or("").as_bytes();
        let token = self.token.as_bytes();
        // As long for a good guess as for a bad one.
        given.len() == token.len() && given.iter().zip(token).fold(0, |differ, (a, b)| differ | (a ^ b)) == 0
    }
}
