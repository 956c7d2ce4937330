//! Messages as bytes: a header with a length, then JSON.

use super::Event;
use lsp_server::{ErrorCode, Message};
use std::io::{self, BufRead, Read, Write};
use std::sync::mpsc::Sender;
use std::sync::{Arc, Mutex, PoisonError};

/// The longest message that is read, in bytes.
const MOST_BYTES: u64 = 512 << 20;
/// The longest line of a header.
const MOST_HEADER: u64 = 8 << 10;

/// What comes from the client.
#[derive(Debug)]
pub(crate) enum Incoming {
    /// A message.
    Message(Message),
    /// Something that is none, and why.
    Malformed(String),
    /// There is no more.
    End,
}

/// Reads until there is no more.
pub(crate) fn read_all(input: &mut impl BufRead, events: &Sender<Event>) {
    loop {
        let incoming = read(input).unwrap_or(Incoming::End);
        let is_end = matches!(incoming, Incoming::End);
        if events.send(Event::Incoming(incoming)).is_err() || is_end {
            return;
        }
    }
}

/// Reads one message. After a malformed one, reading goes on at what follows it, or, where its length is not known, at the
/// next line that is a header.
fn read(input: &mut impl BufRead) -> io::Result<Incoming> {
    let length = match read_header(input)? {
        Header::End => return Ok(Incoming::End),
        Header::Malformed(why) => return Ok(Incoming::Malformed(why)),
        Header::Length(length) => length,
    };
    if length > MOST_BYTES {
        io::copy(&mut input.by_ref().take(length), &mut io::sink())?;
        return Ok(Incoming::Malformed(format!("a message of {length} bytes is too long")));
    }
    let mut body = Vec::new();
    // Memory is taken as bytes come in, whatever the header claims.
    input.by_ref().take(length).read_to_end(&mut body)?;
    if (body.len() as u64) < length {
        return Ok(Incoming::End);
    }
    Ok(match serde_json::from_slice(&body) {
        Ok(message) => Incoming::Message(message),
        Err(error) => Incoming::Malformed(error.to_string()),
    })
}

enum Header {
    Length(u64),
    Malformed(String),
    End,
}

fn read_header(input: &mut impl BufRead) -> io::Result<Header> {
    let mut length = None;
    loop {
        let mut line = Vec::new();
        if input.by_ref().take(MOST_HEADER).read_until(b'\n', &mut line)? == 0 {
            return Ok(Header::End);
        }
        let line = String::from_utf8_lossy(&line);
        let line = line.trim_end();
        if line.is_empty() {
            match length {
                Some(length) => return Ok(Header::Length(length)),
                // Stray empty lines are between messages, not before one.
                None => continue,
            }
        }
        match line.split_once(':') {
            Some((name, value)) if name.trim().eq_ignore_ascii_case("content-length") => {
                match value.trim().parse() {
                    Ok(value) => length = Some(value),
                    Err(_) => return Ok(Header::Malformed(format!("{:?} is no length", value.trim()))),
                }
            }
            Some(_) => {}
            None => return Ok(Header::Malformed("a header line without a colon".into())),
        }
    }
}

/// Where messages to the client go.
#[derive(Clone)]
pub(crate) struct Output(Arc<Mutex<Box<dyn Write + Send>>>);

impl Output {
    pub(crate) fn stdout() -> Self {
        Self(Arc::new(Mutex::new(Box::new(io::stdout()))))
    }

    /// Sends a message. Where the client is gone nobody is there to be told; the end of the input says so, too.
    pub(crate) fn send(&self, message: Message) {
        let mut output = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let _ = message.write(&mut *output);
    }

    /// Answers something that is no message, whose id is not known.
    pub(crate) fn malformed(&self, why: &str) {
        let code = ErrorCode::ParseError as i32;
        let error =
            serde_json::json!({ "jsonrpc": "2.0", "id": null, "error": { "code": code, "message": why } });
        let text = error.to_string();
        let mut output = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let _ = write!(output, "Content-Length: {}\r\n\r\n{text}", text.len()).and_then(|()| output.flush());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(mut input: &[u8]) -> Vec<String> {
        let mut found = Vec::new();
        loop {
            match read(&mut input).unwrap() {
                Incoming::Message(Message::Notification(message)) => found.push(message.method),
                Incoming::Message(_) => found.push("other".into()),
                Incoming::Malformed(why) => found.push(format!("malformed: {why}")),
                Incoming::End => return found,
            }
        }
    }

    #[test]
    fn reading_goes_on_after_what_is_no_message() {
        let good = r#"{"jsonrpc":"2.0","method":"m"}"#;
        let framed = |body: &str| format!("Content-Length: {}\r\n\r\n{body}", body.len());
        let text = [
            framed(good),
            framed("{"),
            framed(r#"{"jsonrpc":"2.0"}"#),
            "nonsense\r\n".into(),
            "Content-Length: x\r\n\r\n".into(),
            format!("content-length:{}\r\nContent-Type: y\n\n{good}", good.len()),
            "Content-Length: 99999999999\r\n\r\n{".into(),
        ];
        let found = all(text.concat().as_bytes());
        let kinds: Vec<&str> = found.iter().map(|text| text.split(':').next().unwrap()).collect();
        assert_eq!(kinds, ["m", "malformed", "malformed", "malformed", "malformed", "m", "malformed"]);
        assert_eq!(all(b"Content-Length: 10\r\n\r\n{}"), [""; 0]);
    }
}
