//! The headers of all answers: of the page, of a stream, and of what is refused.

/// What every answer says of itself. The page has its own policy; that nobody puts it into a frame can be said only here.
pub(crate) const HEADERS: [(&str, &str); 5] = [
    ("Content-Security-Policy", "frame-ancestors 'none'"),
    ("Cross-Origin-Resource-Policy", "same-origin"),
    ("Referrer-Policy", "no-referrer"),
    ("X-Content-Type-Options", "nosniff"),
    ("Cache-Control", "no-cache"),
];
