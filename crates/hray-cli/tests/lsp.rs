//! Conversations with `hray lsp`, as an editor has them: over the pipes of a process.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test may fail loudly")]

use serde_json::{Value, json};
use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::path::PathBuf;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// How long an answer may take on a busy machine.
const PATIENCE: Duration = Duration::from_secs(60);

/// A client and its server.
struct Client {
    folder: TempDir,
    server: Child,
    input: Option<ChildStdin>,
    messages: Receiver<Value>,
    /// Messages that came while another was waited for.
    kept: Vec<Value>,
    next: i32,
}

impl Client {
    /// A server that was not spoken to yet.
    fn start() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let mut server = Command::new(assert_cmd::cargo::cargo_bin!("hray"))
            .arg("lsp")
            .env("XDG_CACHE_HOME", folder.path().join("cache"))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let (input, output) = (server.stdin.take(), server.stdout.take().unwrap());
        let (send, messages) = channel();
        std::thread::spawn(move || {
            let mut output = BufReader::new(output);
            while let Some(message) = read(&mut output) {
                if send.send(message).is_err() {
                    break;
                }
            }
        });
        Self { folder, server, input, messages, kept: Vec::new(), next: 0 }
    }

    /// A server that was greeted.
    fn new(capabilities: Value) -> Self {
        let mut client = Self::start();
        let folder = client.uri("");
        let answer = client.request(
            "initialize",
            json!({ "processId": null, "rootUri": folder, "capabilities": capabilities,
                    "workspaceFolders": [{ "uri": folder, "name": "test" }] }),
        );
        assert_eq!(answer["serverInfo"]["name"], "hray");
        client.notify("initialized", json!({}));
        client
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn uri(&self, name: &str) -> String {
        format!("file://{}", self.path(name).display())
    }

    fn raw(&mut self, bytes: &[u8]) {
        let input = self.input.as_mut().unwrap();
        input.write_all(bytes).unwrap();
        input.flush().unwrap();
    }

    fn send(&mut self, message: &Value) {
        let text = message.to_string();
        self.raw(format!("Content-Length: {}\r\n\r\n{text}", text.len()).as_bytes());
    }

    fn notify(&mut self, method: &str, params: Value) {
        self.send(&json!({ "jsonrpc": "2.0", "method": method, "params": params }));
    }

    fn wait(&mut self, wanted: impl Fn(&Value) -> bool) -> Value {
        if let Some(at) = self.kept.iter().position(&wanted) {
            return self.kept.remove(at);
        }
        let start = Instant::now();
        loop {
            let left = PATIENCE.checked_sub(start.elapsed()).expect("an answer in time");
            let message = self.messages.recv_timeout(left).expect("an answer");
            if wanted(&message) {
                return message;
            }
            self.kept.push(message);
        }
    }

    /// The answer to a request, a result or an error.
    fn answer(&mut self, method: &str, params: Value) -> Value {
        self.next += 1;
        let id = self.next;
        self.send(&json!({ "jsonrpc": "2.0", "id": id, "method": method, "params": params }));
        self.wait(|message| message["id"] == id && message.get("method").is_none())
    }

    fn request(&mut self, method: &str, params: Value) -> Value {
        let answer = self.answer(method, params);
        assert!(answer.get("error").is_none(), "{method}: {answer}");
        answer["result"].clone()
    }

    fn refused(&mut self, method: &str, params: Value) -> (i64, String) {
        let answer = self.answer(method, params);
        let error = &answer["error"];
        (error["code"].as_i64().expect("an error"), error["message"].as_str().unwrap().to_owned())
    }

    fn open(&mut self, name: &str, text: &str) {
        let uri = self.uri(name);
        let document = json!({ "uri": uri, "languageId": "hry", "version": 1, "text": text });
        self.notify("textDocument/didOpen", json!({ "textDocument": document }));
    }

    /// Replaces from one place to another.
    fn edit(&mut self, name: &str, version: i32, from: (u32, u32), to: (u32, u32), text: &str) {
        let range = json!({ "start": { "line": from.0, "character": from.1 }, "end": { "line": to.0, "character": to.1 } });
        let uri = self.uri(name);
        self.notify(
            "textDocument/didChange",
            json!({ "textDocument": { "uri": uri, "version": version }, "contentChanges": [{ "range": range, "text": text }] }),
        );
    }

    /// The diagnostics of a version of a file.
    fn diagnostics(&mut self, name: &str, version: i32) -> Vec<Value> {
        let uri = self.uri(name);
        let message = self.wait(|message| {
            message["method"] == "textDocument/publishDiagnostics"
                && message["params"]["uri"] == uri
                && message["params"]["version"] == version
        });
        message["params"]["diagnostics"].as_array().unwrap().clone()
    }

    fn at(&self, name: &str, line: u32, character: u32) -> Value {
        json!({ "textDocument": { "uri": self.uri(name) }, "position": { "line": line, "character": character } })
    }

    fn with(&self, name: &str, line: u32, character: u32, more: Value) -> Value {
        let mut params = self.at(name, line, character);
        for (key, value) in more.as_object().unwrap() {
            params[key] = value.clone();
        }
        params
    }

    fn document(&self, name: &str) -> Value {
        json!({ "textDocument": { "uri": self.uri(name) } })
    }

    fn hover(&mut self, name: &str, line: u32, character: u32) -> String {
        let params = self.at(name, line, character);
        let answer = self.request("textDocument/hover", params);
        answer["contents"]["value"].as_str().unwrap_or("").to_owned()
    }

    fn completions(&mut self, name: &str, line: u32, character: u32) -> Vec<Value> {
        let params = self.at(name, line, character);
        let answer = self.request("textDocument/completion", params);
        let mut items = answer.as_array().cloned().unwrap_or_default();
        items.sort_by_key(|item| item["sortText"].as_str().unwrap().to_owned());
        items
    }

    /// Says goodbye; the exit code.
    fn finish(mut self) -> Option<i32> {
        assert_eq!(self.request("shutdown", Value::Null), Value::Null);
        self.notify("exit", Value::Null);
        self.exit_code()
    }

    fn exit_code(&mut self) -> Option<i32> {
        let start = Instant::now();
        loop {
            if let Some(status) = self.server.try_wait().unwrap() {
                return status.code();
            }
            assert!(start.elapsed() < PATIENCE, "the server does not end");
            std::thread::sleep(Duration::from_millis(10));
        }
    }
}

impl Drop for Client {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

fn read(output: &mut impl BufRead) -> Option<Value> {
    let mut length = 0;
    loop {
        let mut line = String::new();
        output.read_line(&mut line).ok().filter(|read| *read > 0)?;
        match line.trim_end().split_once(": ") {
            Some((_, value)) => length = value.parse().unwrap(),
            None => break,
        }
    }
    let mut body = vec![0; length];
    output.read_exact(&mut body).ok()?;
    Some(serde_json::from_slice(&body).unwrap())
}

fn labels(items: &[Value]) -> Vec<&str> {
    items.iter().map(|item| item["label"].as_str().unwrap()).collect()
}

fn position(line: u32, character: u32) -> Value {
    json!({ "line": line, "character": character })
}

/// A text after edits of one file.
fn edited(text: &str, edits: &Value) -> String {
    let offset = |position: &Value| {
        let (line, column) =
            (position["line"].as_u64().unwrap() as usize, position["character"].as_u64().unwrap());
        let start: usize = text.split_inclusive('\n').take(line).map(str::len).sum();
        let mut units = 0;
        let inside = text[start..].chars().take_while(|c| {
            let before = units < column;
            units += c.len_utf16() as u64;
            before
        });
        start + inside.map(char::len_utf8).sum::<usize>()
    };
    let mut all: Vec<_> = edits.as_array().unwrap().iter().collect();
    all.sort_by_key(|edit| std::cmp::Reverse(offset(&edit["range"]["start"])));
    let mut new = text.to_owned();
    for edit in all {
        let span = offset(&edit["range"]["start"])..offset(&edit["range"]["end"]);
        new.replace_range(span, edit["newText"].as_str().unwrap());
    }
    new
}

/// The character before the name is two units of UTF-16 and four bytes.
const SCENE: &str = "\
import \"palette.hry\" (ink)
--| Twice 𝕏 of it.
double : Number -> Number
double x = x * 2
t = \"𝕏\" |> (\\_ -> double 2)
scene = { depth = t, objects = [ ball ink ] }
ball c = sphere { material = classic { color = c } }
";
const PALETTE: &str = "--| Dark.\nink : Color\nink = #102030\n";

fn opened(capabilities: Value) -> Client {
    let mut client = Client::new(capabilities);
    fs::write(client.path("palette.hry"), PALETTE).unwrap();
    client.open("scene.hry", SCENE);
    client
}

#[test]
fn a_conversation_from_greeting_to_goodbye() {
    let mut client =
        opened(json!({ "textDocument": { "completion": { "completionItem": { "snippetSupport": true } } } }));
    assert_eq!(client.diagnostics("scene.hry", 1), [] as [Value; 0]);

    // An edit behind the character of two units; what it breaks, and a quick fix.
    client.edit("scene.hry", 2, (4, 19), (4, 25), "duble");
    let found = client.diagnostics("scene.hry", 2);
    let error = found.iter().find(|found| found["severity"] == 1).expect("an error");
    assert_eq!(error["range"], json!({ "start": position(4, 19), "end": position(4, 24) }));
    let params = json!({ "textDocument": client.document("scene.hry")["textDocument"], "range": error["range"], "context": { "diagnostics": [] } });
    let actions = client.request("textDocument/codeAction", params);
    let changes = &actions[0]["edit"]["changes"][client.uri("scene.hry")];
    assert_eq!(
        (actions[0]["kind"].as_str(), changes[0]["newText"].as_str()),
        (Some("quickfix"), Some("double"))
    );
    client.edit("scene.hry", 3, (4, 19), (4, 24), "double");
    assert_eq!(client.diagnostics("scene.hry", 3), [] as [Value; 0]);

    // Hover: types, documentation, colours.
    let hover = client.hover("scene.hry", 4, 20);
    assert!(hover.contains("double : Number -> Number") && hover.contains("Twice 𝕏 of it."), "{hover}");
    let hover = client.hover("scene.hry", 0, 23);
    assert!(
        hover.contains("ink : Color") && hover.contains("`#102030`") && hover.contains("palette.hry"),
        "{hover}"
    );
    assert_eq!(client.hover("scene.hry", 1, 6), "");

    // Definitions: here, in the imported file, in the library.
    let params = client.at("scene.hry", 4, 20);
    let place = client.request("textDocument/definition", params);
    assert_eq!(
        (place["uri"].as_str(), &place["range"]["start"]),
        (Some(client.uri("scene.hry").as_str()), &position(3, 0))
    );
    let params = client.at("scene.hry", 5, 39);
    let place = client.request("textDocument/definition", params);
    assert_eq!(
        (place["uri"].as_str(), &place["range"]["start"]),
        (Some(client.uri("palette.hry").as_str()), &position(2, 0))
    );
    let params = client.at("scene.hry", 6, 12);
    let place = client.request("textDocument/definition", params);
    let library = place["uri"].as_str().unwrap().strip_prefix("file://").unwrap().to_owned();
    let line = place["range"]["start"]["line"].as_u64().unwrap() as usize;
    assert!(fs::read_to_string(library).unwrap().lines().nth(line).unwrap().starts_with("sphere"));

    // References and renaming, in both files.
    let params = client.with("scene.hry", 5, 39, json!({ "context": { "includeDeclaration": true } }));
    let places = client.request("textDocument/references", params);
    assert_eq!(places.as_array().unwrap().len(), 4, "{places}");
    let params = client.at("scene.hry", 5, 39);
    assert_eq!(client.request("textDocument/prepareRename", params)["placeholder"], "ink");
    let params = client.with("scene.hry", 5, 39, json!({ "newName": "dark" }));
    let changes = client.request("textDocument/rename", params)["changes"].clone();
    let palette = edited(PALETTE, &changes[client.uri("palette.hry")]);
    assert_eq!(palette, "--| Dark.\ndark : Color\ndark = #102030\n");
    let scene = edited(SCENE, &changes[client.uri("scene.hry")]);
    assert!(scene.contains("(dark)") && scene.contains("ball dark") && !scene.contains("ink"), "{scene}");
    let params = client.with("scene.hry", 4, 20, json!({ "newName": "t" }));
    assert!(client.refused("textDocument/rename", params).1.contains("already means"));
    let params = client.at("scene.hry", 6, 12);
    assert!(client.refused("textDocument/prepareRename", params).1.contains("library"));

    // Symbols.
    let params = client.document("scene.hry");
    let symbols = client.request("textDocument/documentSymbol", params);
    assert_eq!(
        symbols.as_array().unwrap().iter().map(|s| s["name"].as_str().unwrap()).collect::<Vec<_>>(),
        ["double", "t", "scene", "ball"]
    );
    assert_eq!(client.finish(), Some(0));
}

#[test]
fn completion_knows_the_place() {
    let mut client =
        opened(json!({ "textDocument": { "completion": { "completionItem": { "snippetSupport": true } } } }));
    // A field of the sphere, behind the one that is given.
    client.edit("scene.hry", 2, (6, 50), (6, 50), ", ra");
    let items = client.completions("scene.hry", 6, 54);
    assert_eq!(labels(&items), ["radius", "center"]);
    assert_eq!(items[0]["textEdit"]["newText"], "radius = ${1:1}");
    assert_eq!(items[0]["textEdit"]["range"], json!({ "start": position(6, 52), "end": position(6, 54) }));
    assert!(items[0]["detail"].as_str().unwrap().contains("Number"));
    assert!(items[0]["documentation"]["value"].as_str().unwrap().contains("scene units"));
    // After a point, behind a character of two units.
    client.open("b.hry", "f : Hit -> Number\nf h = let s = \"𝕏\" in h.");
    assert_eq!(labels(&client.completions("b.hry", 1, 24)), ["p", "world", "normal", "uv", "time"]);
    // Names, and the files that an import may name.
    client.open("c.hry", "import \"\"\nx y = ");
    assert_eq!(labels(&client.completions("c.hry", 0, 8)), ["palette.hry"]);
    let items = client.completions("c.hry", 1, 6);
    assert_eq!(labels(&items)[0], "y");
    assert!(labels(&items).contains(&"sphere") && labels(&items).contains(&"match"));
    assert_eq!(client.finish(), Some(0));
}

#[test]
fn colours_and_layout() {
    let mut client = Client::new(json!({}));
    let text = "n = \"𝕏\"\nc = [n, n] |> (\\_ -> #ff8000)\nd = rgb 1 0 0\n\n\nscene={depth=1}\n";
    client.open("scene.hry", text);
    let params = client.document("scene.hry");
    let colors = client.request("textDocument/documentColor", params);
    assert_eq!(colors.as_array().unwrap().len(), 2, "{colors}");
    assert_eq!(colors[0]["range"], json!({ "start": position(1, 21), "end": position(1, 28) }));
    assert_eq!(colors[0]["color"]["red"], 1.0);
    let params = json!({ "textDocument": client.document("scene.hry")["textDocument"], "range": colors[0]["range"],
                         "color": { "red": 0.0, "green": 0.0, "blue": 1.0, "alpha": 1.0 } });
    let ways = client.request("textDocument/colorPresentation", params);
    let texts: Vec<&str> =
        ways.as_array().unwrap().iter().map(|way| way["label"].as_str().unwrap()).collect();
    assert_eq!(texts, ["#0000ff", "rgb 0 0 1", "hsl 240deg 1 0.5"]);

    let options = json!({ "tabSize": 2, "insertSpaces": true });
    let mut params = client.document("scene.hry");
    params["options"] = options.clone();
    let edits = client.request("textDocument/formatting", params);
    let formatted = edited(text, &edits);
    assert!(formatted.contains("scene = { depth = 1 }"), "{formatted}");
    // What has errors and what is classic keeps its layout.
    for text in ["x = (", "renderDescr (resolution(1,1)) 1 []"] {
        client.open("other.hry", text);
        let mut params = client.document("other.hry");
        params["options"] = options.clone();
        assert_eq!(client.request("textDocument/formatting", params), Value::Null);
    }
    assert_eq!(client.finish(), Some(0));
}

#[test]
fn what_is_open_counts_for_more_than_the_disk() {
    let mut client = opened(json!({}));
    assert_eq!(client.diagnostics("scene.hry", 1), [] as [Value; 0]);
    // The name is gone in the editor's text of the imported file, then back when that is closed.
    client.open("palette.hry", "other = 1\n");
    let found = client.diagnostics("scene.hry", 1);
    assert!(
        found.iter().any(|found| found["message"].as_str().unwrap().contains("does not define `ink`")),
        "{found:?}"
    );
    let params = client.document("palette.hry");
    client.notify("textDocument/didClose", params);
    assert_eq!(client.diagnostics("scene.hry", 1), [] as [Value; 0]);
    // A mistake in an imported file shows at the import, and where it is.
    fs::write(client.path("palette.hry"), "ink = #102030 +\n").unwrap();
    client.notify("workspace/didChangeWatchedFiles", json!({ "changes": [] }));
    let found = client.diagnostics("scene.hry", 1);
    assert_eq!(found[0]["range"]["start"], position(0, 7));
    assert_eq!(found[0]["relatedInformation"][0]["location"]["uri"], client.uri("palette.hry").as_str());
    assert_eq!(client.finish(), Some(0));
}

#[test]
fn evaluation_adds_what_only_it_finds() {
    let mut client = Client::new(json!({}));
    client.open("scene.hry", "scene = { depth = at 3 [1, 2] }\n");
    assert_eq!(client.diagnostics("scene.hry", 1), [] as [Value; 0]);
    let found = client.diagnostics("scene.hry", 1);
    assert_eq!((found.len(), &found[0]["severity"]), (1, &json!(1)), "{found:?}");
    // A scene that never ends: everything else goes on, and there is a word about it.
    client.edit("scene.hry", 2, (0, 18), (0, 29), "f 0");
    client.edit("scene.hry", 3, (1, 0), (1, 0), "f x = iterate 1e9 (\\y -> y < 0) (\\y -> y + 1) x\n");
    assert!(client.hover("scene.hry", 0, 18).contains("f : "));
    let wait = |client: &mut Client| client.diagnostics("scene.hry", 3);
    let mut found = wait(&mut client);
    while found.is_empty() {
        found = wait(&mut client);
    }
    assert_eq!(found[0]["severity"], 2, "{found:?}");
    client.edit("scene.hry", 4, (0, 18), (0, 21), "5");
    let found = client.diagnostics("scene.hry", 4);
    assert!(found.iter().all(|found| found["severity"] == 2), "{found:?}");
    assert_eq!(client.finish(), Some(0));
}

#[test]
fn classic_files_are_checked() {
    let mut client = Client::new(json!({}));
    client.open(
        "old.hry",
        "renderDescr ( resolution (400,300) ) 3 [\n scene { camera (0,0.0,150.0) (100,75) } ",
    );
    let found = client.diagnostics("old.hry", 1);
    assert!(found.iter().any(|found| found["range"]["start"] == position(1, 17)), "{found:?}");
    assert_eq!(client.hover("old.hry", 0, 3), "");
    assert_eq!(client.completions("old.hry", 1, 5), [] as [Value; 0]);
    assert_eq!(client.finish(), Some(0));
}

#[test]
fn positions_can_be_counted_in_bytes() {
    let mut client = opened(json!({ "general": { "positionEncodings": ["utf-8", "utf-16"] } }));
    client.edit("scene.hry", 2, (4, 21), (4, 27), "duble");
    let found = client.diagnostics("scene.hry", 2);
    let error = found.iter().find(|found| found["severity"] == 1).expect("an error");
    assert_eq!(error["range"], json!({ "start": position(4, 21), "end": position(4, 26) }));
    assert_eq!(client.finish(), Some(0));
}

#[test]
fn nothing_that_a_client_sends_ends_the_conversation() {
    let mut client = Client::start();
    assert_eq!(client.refused("textDocument/hover", json!({})).0, -32002);
    client.notify("textDocument/didOpen", json!({}));
    client.raw(b"Content-Length: 1\r\n\r\n{");
    client.raw(b"Content-Length: 7\r\n\r\n\"\xff\xfe\xfd\"  ");
    client.raw(b"nonsense\r\nContent-Length: -3\r\n\r\n");
    let malformed = client.wait(|message| message["error"]["code"] == -32700);
    assert_eq!(malformed["id"], Value::Null);
    client.request("initialize", json!({ "capabilities": {} }));
    client.notify("initialized", json!({}));
    assert_eq!(client.refused("initialize", json!({ "capabilities": {} })).0, -32600);
    assert_eq!(client.refused("textDocument/astrology", json!({})).0, -32601);
    assert_eq!(client.refused("textDocument/hover", json!({ "position": 3 })).0, -32602);
    client.notify("$/cancelRequest", json!({ "id": 77 }));
    client.notify("textDocument/didChange", json!({ "textDocument": 1 }));
    // Documents that are not open, places that are not there.
    let params = client.at("none.hry", 0, 0);
    assert_eq!(client.request("textDocument/hover", params), Value::Null);
    client.edit("none.hry", 2, (0, 0), (0, 0), "x");
    client.open("scene.hry", "x = 1");
    client.edit("scene.hry", 2, (999, 5), (7, 4_000_000_000), "\ny = é");
    for (line, character) in [(0, 0), (1, 5), (1, 99), (u32::MAX >> 1, u32::MAX >> 1)] {
        for method in ["hover", "completion", "definition", "prepareRename", "documentHighlight"] {
            let params = client.at("scene.hry", line, character);
            client.answer(&format!("textDocument/{method}"), params);
        }
    }
    client.notify(
        "textDocument/didOpen",
        json!({ "textDocument": { "uri": "untitled:Untitled-1", "languageId": "hry", "version": 1, "text": "import \"a.hry\"\nx = gold" } }),
    );
    let hover = json!({ "textDocument": { "uri": "untitled:Untitled-1" }, "position": position(1, 5) });
    assert!(
        client.request("textDocument/hover", hover)["contents"]["value"]
            .as_str()
            .unwrap()
            .contains("gold : Color")
    );
    // The edits before are there.
    let params = client.document("scene.hry");
    assert_eq!(client.request("textDocument/documentSymbol", params).as_array().unwrap().len(), 2);
    // An end without goodbye.
    drop(client.input.take());
    assert_eq!(client.exit_code(), Some(1));
}

#[test]
fn uses_are_found_anywhere_in_the_workspace() {
    let mut client = opened(json!({}));
    fs::create_dir_all(client.path("a/b")).unwrap();
    let other = "import \"../../palette.hry\" as p\nscene = { background = p.ink, depth = ink }\nink = 2\n";
    fs::write(client.path("a/b/other.hry"), other).unwrap();
    fs::write(client.path("a/none.hry"), "ink = 3\n").unwrap();
    let params = client.with("scene.hry", 5, 39, json!({ "context": { "includeDeclaration": true } }));
    let places = client.request("textDocument/references", params);
    assert_eq!(places.as_array().unwrap().len(), 5, "{places}");
    let params = client.with("scene.hry", 5, 39, json!({ "newName": "dark" }));
    let changes = client.request("textDocument/rename", params)["changes"].clone();
    assert_eq!(changes.as_object().unwrap().len(), 3, "{changes}");
    let renamed = edited(other, &changes[client.uri("a/b/other.hry")]);
    assert_eq!(renamed, other.replace("p.ink", "p.dark"));
}
