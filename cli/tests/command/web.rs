//! `adsdv web`: one page on loopback, and nothing else.

use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::process::{Child, Stdio};
use std::time::Duration;

use crate::run::{adsdv, run};

/// The command while it serves. It is stopped when this is dropped, so also when a test fails.
struct Server {
    child: Child,
    address: String,
}

impl Server {
    fn start() -> Self {
        let mut child =
            adsdv(&["web", "--port", "0"]).stdout(Stdio::piped()).spawn().expect("the command starts");
        let stdout = child.stdout.take().expect("a pipe");
        let mut server = Self { child, address: String::new() };
        let mut line = String::new();
        BufReader::new(stdout).read_line(&mut line).expect("a line");
        let address =
            line.strip_prefix("http://").and_then(|rest| rest.strip_suffix("/ (stop with Ctrl-C)\n"));
        address.unwrap_or_else(|| panic!("no address in {line:?}")).clone_into(&mut server.address);
        server
    }

    /// The head and the body of the answer to what is sent.
    fn answer(&self, request: &str) -> (String, String) {
        let mut stream = TcpStream::connect(&self.address).expect("somebody listens");
        stream.set_read_timeout(Some(Duration::from_secs(30))).expect("a time that is not zero");
        stream.write_all(request.as_bytes()).expect("the request is taken");
        let mut answer = Vec::new();
        stream.read_to_end(&mut answer).expect("an answer that ends");
        let answer = String::from_utf8(answer).expect("text");
        let (head, body) = answer.split_once("\r\n\r\n").expect("a head and a body");
        (head.to_owned(), body.to_owned())
    }

    fn ask(&self, method: &str, path: &str) -> (String, String) {
        self.answer(&format!("{method} {path} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n"))
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

#[test]
fn the_page_is_served_on_loopback_and_is_what_print_prints() {
    let server = Server::start();
    assert!(server.address.starts_with("127.0.0.1:"), "{}", server.address);
    let printed = run(&["web", "--print"]);
    assert_eq!((printed.status, printed.stderr.as_str()), (Some(0), ""));
    for path in ["/", "/index.html", "/?anything"] {
        let (head, body) = server.ask("GET", path);
        assert!(head.starts_with("HTTP/1.1 200 OK\r\n"), "{path}: {head}");
        let head = head.to_ascii_lowercase();
        for header in ["content-type: text/html", "x-content-type-options: nosniff", "frame-ancestors 'none'"]
        {
            assert!(head.contains(header), "{path} lacks {header}: {head}");
        }
        assert!(body == printed.stdout, "{path}: another page");
    }
    let (head, body) = server.ask("HEAD", "/");
    assert!(head.starts_with("HTTP/1.1 200 OK\r\n") && body.is_empty(), "{head}");
}

#[test]
fn no_path_reaches_a_file_and_no_request_ends_it() {
    let server = Server::start();
    for path in
        ["/../Cargo.toml", "//etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "/page/dist/adsdv.html", "/\u{7f}"]
    {
        let (head, body) = server.ask("GET", path);
        assert!(head.starts_with("HTTP/1.1 404 ") || head.starts_with("HTTP/1.1 400 "), "{path}: {head}");
        assert!(body.len() < 200 && !body.contains("root:"), "{path}: {body}");
    }
    for method in ["POST", "PUT", "DELETE", "OPTIONS"] {
        let (head, _) = server.ask(method, "/");
        assert!(head.starts_with("HTTP/1.1 405 ") && head.contains("Allow: GET, HEAD"), "{method}: {head}");
    }
    for rubbish in ["\r\n\r\n", "GET\r\n\r\n", "GET / HTTP/9.9\r\n\r\n", "\u{0}\u{1}\u{2}\r\n\r\n"] {
        let mut stream = TcpStream::connect(&server.address).expect("somebody listens");
        // What comes back, if anything does, is the server's business.
        let _ = stream.write_all(rubbish.as_bytes());
    }
    assert!(server.ask("GET", "/").0.starts_with("HTTP/1.1 200 "));
}

#[test]
fn an_address_that_cannot_be_had() {
    let taken = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).expect("a free port");
    let port = taken.local_addr().expect("its number").port().to_string();
    let outcome = run(&["web", "--port", &port]);
    assert_eq!((outcome.status, outcome.stdout.as_str()), (Some(2), ""));
    assert!(
        outcome.stderr.starts_with(&format!("adsdv: port {port}: cannot serve on this port: ")),
        "{}",
        outcome.stderr
    );
    assert!(outcome.stderr.contains("\nhint: name another port with --port"), "{}", outcome.stderr);

    // One that is for documents, and no machine has (RFC 5737).
    let outcome = run(&["web", "--port", "0", "--address", "192.0.2.1"]);
    assert_eq!(outcome.status, Some(2));
    let said = "adsdv: address 192.0.2.1: cannot serve on this address: ";
    assert!(outcome.stderr.starts_with(said) && outcome.stderr.contains("--address"), "{}", outcome.stderr);
}
