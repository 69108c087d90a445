//! The page where it shows a stream: it may then ask its own server for that, and for nothing else.

use std::net::SocketAddr;

use tiny_http::Request;

use crate::PAGE;

/// What the page says of a stream, without one and with one.
const STREAM: [&str; 2] =
    [r#"<meta name="adsdv-live" content="no">"#, r#"<meta name="adsdv-live" content="yes">"#];
/// Where its policy begins, without a stream and with one.
const POLICY: [&str; 2] =
    [r#"content="default-src 'none'; "#, r#"content="default-src 'none'; connect-src 'self'; "#];

/// The page with a stream.
pub(crate) fn page() -> String {
    [STREAM, POLICY].iter().fold(PAGE.to_owned(), |page, [without, with]| page.replacen(without, with, 1))
}

/// Whether who asks means this machine: a name that somebody else made lead here is none of its own.
pub(crate) fn is_asked_for_here(request: &Request, address: SocketAddr) -> bool {
    let host = request.headers().iter().find(|header| header.field.equiv("Host"));
    host.is_some_and(|host| is_own(host.value.as_str(), address.port()))
}

fn is_own(host: &str, port: u16) -> bool {
    let (name, given) = match host.rsplit_once(':') {
        Some((name, given)) if !given.ends_with(']') => (name, given.parse().ok()),
        _ => (host, Some(80)),
    };
    given == Some(port)
        && ["127.0.0.1", "localhost", "[::1]"].iter().any(|own| name.eq_ignore_ascii_case(own))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_with_a_stream_may_ask_its_own_server_and_nobody_else() {
        for [without, with] in [STREAM, POLICY] {
            assert_eq!(PAGE.matches(without).count(), 1, "{without}");
            assert_eq!(PAGE.matches(with).count(), 0);
            assert_eq!(page().matches(with).count(), 1);
        }
    }

    #[test]
    fn only_names_of_loopback_are_its_own() {
        for host in ["127.0.0.1:3024", "localhost:3024", "LocalHost:3024", "[::1]:3024"] {
            assert!(is_own(host, 3024), "{host}");
        }
        assert!(is_own("localhost", 80) && is_own("[::1]", 80));
        for host in [
            "",
            "evil.example:3024",
            "127.0.0.1",
            "127.0.0.1:3025",
            "localhost.evil.example:3024",
            "127.0.0.1:3024:80",
        ] {
            assert!(!is_own(host, 3024), "{host}");
        }
    }
}
