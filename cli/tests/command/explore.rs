//! `adsdv explore`: the Explorer answers on loopback, in words and pictures.

use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::process::{Child, Stdio};
use std::time::Duration;

use serde_json::Value;

use crate::run::{adsdv, run};

/// Longer than any answer takes.
const PATIENCE: Duration = Duration::from_secs(30);

/// The command while it serves. It is stopped when this is dropped, so also when a test fails.
struct Explorer {
    child: Child,
    /// The host and port that it names.
    address: String,
}

impl Explorer {
    fn start(options: &[&str]) -> Self {
        let mut child = adsdv(&[&["explore", "--port", "0"], options].concat())
            .stdout(Stdio::piped())
            .spawn()
            .expect("the command starts");
        let stdout = child.stdout.take().expect("a pipe");
        let mut explorer = Self { child, address: String::new() };
        let (mut edition, mut line) = (String::new(), String::new());
        let mut stdout = BufReader::new(stdout);
        stdout.read_line(&mut edition).expect("a line");
        assert!(edition.starts_with("edition 3.0"), "{edition:?}");
        stdout.read_line(&mut line).expect("a line");
        let address =
            line.strip_prefix("http://").and_then(|rest| rest.strip_suffix("/ (stop with Ctrl-C)\n"));
        address.unwrap_or_else(|| panic!("no address in {line:?}")).clone_into(&mut explorer.address);
        explorer
    }

    /// The body of the answer to a request.
    fn get(&self, path: &str) -> String {
        // The command prints the address just before it serves it.
        let connect = || TcpStream::connect(&self.address).ok();
        let mut stream = (0..100)
            .find_map(|_| {
                connect().or_else(|| {
                    std::thread::sleep(Duration::from_millis(50));
                    None
                })
            })
            .expect("somebody listens");
        stream.set_read_timeout(Some(PATIENCE)).expect("a time that is not zero");
        // Of this version no answer comes in pieces.
        write!(stream, "GET {path} HTTP/1.0\r\nHost: {}\r\nConnection: close\r\n\r\n", self.address)
            .expect("the request is taken");
        let mut answer = String::new();
        stream.read_to_string(&mut answer).expect("an answer that ends");
        let (head, body) = answer.split_once("\r\n\r\n").expect("a head and a body");
        assert_eq!(head.split(' ').nth(1), Some("200"), "{path}: {head}\n{body}");
        body.to_owned()
    }

    /// The answer to a request, as JSON.
    fn json(&self, path: &str) -> Value {
        let body = self.get(path);
        serde_json::from_str(&body).unwrap_or_else(|error| panic!("{path}: {error}: {body}"))
    }
}

impl Drop for Explorer {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn text<'a>(value: &'a Value, key: &str) -> &'a str {
    value[key].as_str().unwrap_or_else(|| panic!("no text {key} in {value}"))
}

#[test]
fn states_and_actions_are_put_into_words_and_drawn() {
    let explorer = Explorer::start(&[]);
    assert!(explorer.address.starts_with("127.0.0.1:"), "{}", explorer.address);
    assert!(explorer.get("/").contains("<html"), "a page");

    let status = explorer.json("/.status");
    assert!(status["properties"].to_string().contains("conforming-ai-causes-no-emergency"), "{status}");

    let first = explorer.json("/.states");
    let first = &first[0];
    for words in
        ["VCU          AS_OFF\n", "AI Computer  NOT SELECTED, NEUTRAL", "operator     no mission, TSMS off"]
    {
        assert!(text(first, "state").contains(words), "{words:?} is missing: {first}");
    }
    assert!(text(first, "svg").starts_with("<svg"), "{first}");

    let next = explorer.json(&format!("/.states/{}", text(first, "fingerprint")));
    let next = next.as_array().expect("the states that follow");
    let actions: Vec<_> = next.iter().map(|state| text(state, "action")).collect();
    for action in ["operator: mission TRACK_DRIVE", "operator: TSMS on", "operator: ASMS on"] {
        assert!(actions.contains(&action), "{action} is missing: {actions:?}");
    }
    for state in next {
        let svg = text(state, "svg");
        assert!(svg.starts_with("<svg") && svg.contains(">VCU<") && svg.contains(">AS_OFF<"), "{svg}");
    }
}

#[test]
fn a_port_that_is_taken() {
    let taken = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).expect("a free port");
    let port = taken.local_addr().expect("its number").port().to_string();
    let outcome = run(&["explore", "--port", &port]);
    assert_eq!((outcome.status, outcome.stdout.as_str()), (Some(2), ""));
    let mut lines = outcome.stderr.lines();
    let error = lines.next().unwrap_or_default();
    assert!(error.starts_with(&format!("adsdv: port {port}: cannot serve on this port: ")), "{error}");
    let hint = lines.next().unwrap_or_default();
    assert!(hint.starts_with("hint: ") && hint.contains("--port"), "{hint}");
    assert_eq!(lines.next(), None);
}
