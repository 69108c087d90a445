//! Serves the page.

use std::error::Error;
use std::fmt;
use std::io;
use std::net::{IpAddr, Ipv4Addr, SocketAddr, TcpListener};

use std::thread;

use tiny_http::{Header, Method, Request, Response, Server};

use crate::PAGE;
use crate::feed::Feed;
use crate::headers::HEADERS;
use crate::live;
use crate::stream;

/// A server of the page.
///
/// ```
/// use std::io::{Read, Write};
/// use std::net::{Ipv4Addr, TcpStream};
///
/// let site = adsdv_site::Site::bind(Ipv4Addr::LOCALHOST.into(), 0)?;
/// let address = site.address();
/// std::thread::spawn(move || site.serve());
/// let mut stream = TcpStream::connect(address)?;
/// stream.write_all(b"GET / HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n")?;
/// let mut answer = String::new();
/// stream.read_to_string(&mut answer)?;
/// assert!(answer.starts_with("HTTP/1.1 200 OK\r\n") && answer.ends_with(adsdv_site::PAGE));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Site {
    server: Server,
    address: SocketAddr,
    live: Option<Live>,
}

/// A stream that the page shows, and the page that does.
struct Live {
    feed: Feed,
    page: String,
}

/// So many pages may read a stream at once.
const READERS: usize = 16;

/// Why nothing is served: the address cannot be had.
#[derive(Debug)]
pub struct SiteError(io::Error);

impl SiteError {
    /// What the system says.
    pub const fn source_error(&self) -> &io::Error {
        &self.0
    }
}

impl fmt::Display for SiteError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the address cannot be had: {}", self.0)
    }
}

impl Error for SiteError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        Some(&self.0)
    }
}

impl Site {
    /// Takes an address; with port 0 the system chooses one that is free.
    ///
    /// # Errors
    ///
    /// Fails if the address cannot be had: another program listens there, or it is none of this machine's.
    pub fn bind(host: IpAddr, port: u16) -> Result<Self, SiteError> {
        let listener = TcpListener::bind((host, port)).map_err(SiteError)?;
        let address = listener.local_addr().map_err(SiteError)?;
        let server = Server::from_listener(listener, None)
            .map_err(|error| SiteError(io::Error::other(error.to_string())))?;
        Ok(Self { server, address, live: None })
    }

    /// Takes an address of loopback, and shows a stream in the page: what is on the bus is for nobody else than who sits at this machine.
    ///
    /// # Errors
    ///
    /// As [`bind`](Self::bind).
    pub fn live(port: u16, feed: &Feed) -> Result<Self, SiteError> {
        let site = Self::bind(Ipv4Addr::LOCALHOST.into(), port)?;
        Ok(Self { live: Some(Live { feed: feed.clone(), page: live::page() }), ..site })
    }

    /// Where it is.
    pub const fn address(&self) -> SocketAddr {
        self.address
    }

    /// Serves the page until the process ends.
    pub fn serve(&self) {
        for request in self.server.incoming_requests() {
            let Some(live) = &self.live else {
                // Who asked may be gone, and others still ask.
                let _ = answer(request, PAGE);
                continue;
            };
            let _ = if !live::is_asked_for_here(&request, self.address) {
                refuse(request, 421, "This page answers to 127.0.0.1 and localhost alone.\n")
            } else if path(&request) == stream::PATH && *request.method() == Method::Get {
                begin(request, &live.feed)
            } else {
                answer(request, &live.page)
            };
        }
    }
}

/// Streams to a page in a thread of its own.
fn begin(request: Request, feed: &Feed) -> io::Result<()> {
    let Some(reader) = feed.reader(READERS) else {
        return refuse(request, 503, "Too many pages show this bus already.\n");
    };
    let stream = move || {
        // Who read may be gone.
        let _ = stream::write(request, &reader);
    };
    thread::Builder::new().name("stream".to_owned()).spawn(stream).map(drop)
}

fn path(request: &Request) -> &str {
    request.url().split(['?', '#']).next().unwrap_or_default()
}

/// Answers a request: the page, and nothing else.
fn answer(request: Request, page: &str) -> io::Result<()> {
    let (status, kind, text) = match (request.method(), path(&request)) {
        (Method::Get | Method::Head, "/" | "/index.html") => (200, "text/html; charset=utf-8", page),
        (Method::Get | Method::Head, _) => (404, PLAIN, "There is only the page at /.\n"),
        _ => (405, PLAIN, "There is only GET.\n"),
    };
    respond(request, status, kind, text)
}

fn refuse(request: Request, status: u16, text: &str) -> io::Result<()> {
    respond(request, status, PLAIN, text)
}

const PLAIN: &str = "text/plain; charset=utf-8";

fn respond(request: Request, status: u16, kind: &str, text: &str) -> io::Result<()> {
    let mut response = Response::new(status.into(), Vec::new(), text.as_bytes(), Some(text.len()), None)
        // Its length is known, so that a browser shows how far it is.
        .with_chunked_threshold(usize::MAX);
    let allow = (status == 405).then_some(("Allow", "GET, HEAD"));
    for (name, value) in HEADERS.into_iter().chain([("Content-Type", kind)]).chain(allow) {
        if let Ok(header) = Header::from_bytes(name, value) {
            response.add_header(header);
        }
    }
    request.respond(response)
}
