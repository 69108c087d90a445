//! `adsdv watch --web`: the page with a stream, for this machine alone.

use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::net::{TcpListener, TcpStream};
use std::process::{Child, Stdio};
use std::time::Duration;

use crate::run::{FINISHED_WHILE_MOVING, adsdv, file, run};

/// The command, which hears what is written to it. It is stopped when this is dropped, so also when a test fails.
struct Watched {
    child: Child,
    address: String,
}

impl Watched {
    fn start(options: &[&str]) -> Self {
        let mut child = adsdv(&[&["watch", "-", "--web", "--port", "0"], options].concat())
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the command starts");
        let stderr = child.stderr.take().expect("a pipe");
        let mut watched = Self { child, address: String::new() };
        let mut line = String::new();
        BufReader::new(stderr).read_line(&mut line).expect("a line");
        let address = line.strip_prefix("http://").and_then(|rest| rest.strip_suffix("/ shows it\n"));
        address.unwrap_or_else(|| panic!("no address in {line:?}")).clone_into(&mut watched.address);
        watched
    }

    fn hears(&mut self, log: &[u8]) {
        self.child.stdin.as_mut().expect("a pipe").write_all(log).expect("it reads");
    }

    /// The answer to a request with this host and this header, as far as it comes until the stream ends.
    fn ask(&self, path: &str, host: &str, header: &str) -> String {
        let mut stream = TcpStream::connect(&self.address).expect("somebody listens");
        stream.set_read_timeout(Some(Duration::from_secs(30))).expect("a time that is not zero");
        let request = format!("GET {path} HTTP/1.1\r\nHost: {host}\r\n{header}Connection: close\r\n\r\n");
        stream.write_all(request.as_bytes()).expect("the request is taken");
        let mut answer = Vec::new();
        stream.read_to_end(&mut answer).expect("an answer that ends");
        String::from_utf8(answer).expect("text")
    }
}

impl Drop for Watched {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

#[test]
fn every_line_is_streamed_once_and_who_comes_back_goes_on_where_it_was() {
    let log = file(FINISHED_WHILE_MOVING);
    let mut watched = Watched::start(&[]);
    watched.hears(&log);
    drop(watched.child.stdin.take());
    let host = watched.address.clone();
    let answer = watched.ask("/live", &host, "");
    let (head, events) = answer.split_once("\r\n\r\n").expect("a head and a body");
    assert!(head.starts_with("HTTP/1.1 200 OK\r\n") && head.contains("text/event-stream"), "{head}");
    let data = |events: &str| -> Vec<String> {
        let plain = events.split("\n\n").filter(|event| event.starts_with("id: "));
        let lines = plain.flat_map(str::lines).filter_map(|line| line.strip_prefix("data: "));
        lines.map(str::to_owned).collect()
    };
    let expected: Vec<String> = String::from_utf8(log).expect("text").lines().map(str::to_owned).collect();
    assert!(data(events) == expected, "{} lines of {}", data(events).len(), expected.len());
    assert!(events.ends_with("event: end\ndata: no more frames come\n\n"));
    let (first, _) =
        events.split_once("event: begin\ndata: ").expect("it begins").1.split_once('\n').expect("a line");
    let back = watched.ask("/live", &host, &format!("Last-Event-ID: {first}.100\r\n"));
    assert!(data(back.split_once("\r\n\r\n").expect("a body").1) == expected[100..]);
    // Of another run nobody knows where it was.
    let other = watched.ask("/live", &host, "Last-Event-ID: other.100\r\n");
    assert!(data(other.split_once("\r\n\r\n").expect("a body").1) == expected);
}

#[test]
fn only_who_asks_for_this_machine_gets_an_answer() {
    let watched = Watched::start(&[]);
    let (_, port) = watched.address.rsplit_once(':').expect("a port");
    for host in [watched.address.clone(), format!("localhost:{port}")] {
        let page = watched.ask("/", &host, "");
        assert!(page.starts_with("HTTP/1.1 200 OK\r\n"), "{host}");
        assert!(
            page.contains("default-src 'none'; connect-src 'self'; ")
                && page.contains(r#"name="adsdv-live" content="yes""#)
        );
    }
    for host in ["evil.example", &format!("evil.example:{port}"), "127.0.0.1", "127.0.0.1:1"] {
        for path in ["/", "/live"] {
            let answer = watched.ask(path, host, "");
            assert!(answer.starts_with("HTTP/1.1 421 "), "{host}: {answer}");
        }
    }
    // Without a stream the page may ask nobody.
    assert!(!run(&["web", "--print"]).stdout.contains("connect-src"));
}

#[test]
fn what_is_printed_is_the_same_and_a_port_that_cannot_be_had_is_told_before_anything_is_written() {
    let taken = TcpListener::bind("127.0.0.1:0").expect("a port");
    let port = taken.local_addr().expect("its number").port().to_string();
    let log = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("watch-web.log");
    std::fs::write(&log, "as it was").expect("the folder for tests can be written");
    let outcome = run(&["watch", "-", "--web", "--port", &port, "--log", log.to_str().expect("text")]);
    assert_eq!((outcome.status, outcome.stdout.as_str()), (Some(2), ""));
    assert!(
        outcome.stderr.contains("cannot serve on this port") && outcome.stderr.contains("\nhint: "),
        "{}",
        outcome.stderr
    );
    assert_eq!(std::fs::read_to_string(&log).expect("it is there"), "as it was");
    let outcome = run(&["watch", "-", "--port", "1"]);
    assert_eq!(outcome.status, Some(2), "{}", outcome.stderr);
    assert!(outcome.stderr.contains("--web"), "{}", outcome.stderr);
    let mut watched = Watched::start(&["--json"]);
    watched.hears(&file(FINISHED_WHILE_MOVING));
    drop(watched.child.stdin.take());
    let mut line = String::new();
    BufReader::new(watched.child.stdout.take().expect("a pipe")).read_line(&mut line).expect("a line");
    assert!(line.starts_with(r#"{"schema":1,"#) && line.contains(r#""verdict":"violates""#), "{line}");
}
