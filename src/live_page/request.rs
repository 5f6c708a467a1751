//! A request of the page of a run that goes on: read within bounds, and understood or refused.

use albacore_session::Cursor;

/// More bytes than these no request line with its headers has.
pub const HEAD_BYTES_MAX: usize = 8 << 10;

/// What is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Asked {
    /// The page.
    Page,
    /// What is new to a page that knows so much, and the number by which it is told from others.
    Data(Option<Cursor>, Option<u64>),
}

/// Why a request is not answered with what it asks for: a status of HTTP.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// It cannot be read.
    Unreadable,
    /// It was made in the name of another host: a page of somebody else may be behind it.
    Foreign,
    /// There is no such thing.
    Unknown,
    /// Nothing can be done here but look.
    NotGet,
    /// It did not come to its end in time.
    Late,
    /// Its line and headers are too long.
    TooLong,
}

impl Refusal {
    /// Its number and words in HTTP.
    pub fn status(self) -> &'static str {
        match self {
            Refusal::Unreadable => "400 Bad Request",
            Refusal::Foreign => "403 Forbidden",
            Refusal::Unknown => "404 Not Found",
            Refusal::NotGet => "405 Method Not Allowed",
            Refusal::Late => "408 Request Timeout",
            Refusal::TooLong => "431 Request Header Fields Too Large",
        }
    }
}

/// Where the headers end, if they have.
pub fn end_of_head(bytes: &[u8]) -> Option<usize> {
    bytes.windows(4).position(|four| four == b"\r\n\r\n")
}

/// Understands a request line with its headers, made to a server at a port.
pub fn understand(head: &[u8], port: u16) -> Result<Asked, Refusal> {
    let head = std::str::from_utf8(head).map_err(|_| Refusal::Unreadable)?;
    let mut lines = head.split("\r\n");
    let mut words = lines.next().unwrap_or_default().split(' ');
    let (Some(method), Some(target), Some(version), None) = (words.next(), words.next(), words.next(), words.next())
    else {
        return Err(Refusal::Unreadable);
    };
    if method.is_empty() || !matches!(version, "HTTP/1.1" | "HTTP/1.0") {
        return Err(Refusal::Unreadable);
    }
    let headers = headers(lines)?;
    let named = |name: &'static str| headers.iter().filter(move |(known, _)| known.eq_ignore_ascii_case(name));
    let mut hosts = named("host");
    match (hosts.next(), hosts.next()) {
        (Some((_, host)), None) if is_ours(host, port) => {}
        (Some(_), None) => return Err(Refusal::Foreign),
        _ => return Err(Refusal::Unreadable),
    }
    if method != "GET" {
        return Err(Refusal::NotGet);
    }
    let (path, query) = target.split_once('?').unwrap_or((target, ""));
    match path {
        "/" => Ok(Asked::Page),
        // A page of somebody else could not read the answer, and is to be no reason to wait for it in the end.
        "/data" if named("sec-fetch-site").any(|(_, site)| !matches!(*site, "same-origin" | "none")) => {
            Err(Refusal::Foreign)
        }
        "/data" => data(query),
        _ => Err(Refusal::Unknown),
    }
}

/// The names and values of headers; one that is continued on a next line is none.
fn headers<'a>(lines: impl Iterator<Item = &'a str>) -> Result<Vec<(&'a str, &'a str)>, Refusal> {
    let header = |line: &'a str| {
        let (name, value) = line.split_once(':').ok_or(Refusal::Unreadable)?;
        let is_name = !name.is_empty() && name.bytes().all(|byte| byte.is_ascii_graphic());
        is_name.then(|| (name, value.trim_matches([' ', '\t']))).ok_or(Refusal::Unreadable)
    };
    lines.map(header).collect()
}

/// Whether a host is this one: a name of somebody else that leads here, by a server of names that says so, is not.
fn is_ours(host: &str, port: u16) -> bool {
    let names = ["127.0.0.1", "localhost", "[::1]"];
    names.iter().any(|name| {
        let rest = host.get(..name.len()).filter(|begin| begin.eq_ignore_ascii_case(name)).map(|_| &host[name.len()..]);
        // A browser leaves out the port that is usual.
        rest.is_some_and(|rest| rest.strip_prefix(':') == Some(&port.to_string()) || (rest.is_empty() && port == 80))
    })
}

fn data(query: &str) -> Result<Asked, Refusal> {
    let (mut known, mut page) = (None, None);
    for part in query.split('&').filter(|part| !part.is_empty()) {
        match part.split_once('=') {
            Some(("since", "")) => known = None,
            Some(("since", cursor)) => known = Some(cursor.parse().map_err(|_| Refusal::Unreadable)?),
            Some(("page", number)) => page = Some(number.parse().map_err(|_| Refusal::Unreadable)?),
            _ => return Err(Refusal::Unreadable),
        }
    }
    Ok(Asked::Data(known, page))
}

#[cfg(test)]
mod tests {
    use super::{Asked, Refusal, end_of_head, understand};

    fn asked(head: &str) -> Result<Asked, Refusal> {
        understand(head.replace('\n', "\r\n").as_bytes(), 8642)
    }

    #[test]
    fn page_and_data_are_all_that_there_is() {
        assert_eq!(asked("GET / HTTP/1.1\nHost: 127.0.0.1:8642"), Ok(Asked::Page));
        assert_eq!(asked("GET /?x HTTP/1.0\nHOST:localhost:8642"), Ok(Asked::Page));
        assert_eq!(asked("GET /data HTTP/1.1\nHost: [::1]:8642\nA: b"), Ok(Asked::Data(None, None)));
        let cursor = "1.2.3.4.5.6.7.8".parse().ok();
        let line = "GET /data?page=7&since=1.2.3.4.5.6.7.8 HTTP/1.1\nHost: LocalHost:8642";
        assert_eq!(asked(line), Ok(Asked::Data(cursor, Some(7))));
        for path in ["/x", "//", "/data/", "/../etc/passwd", "/%2e%2e/x", "http://127.0.0.1:8642/", "*"] {
            assert_eq!(asked(&format!("GET {path} HTTP/1.1\nHost: 127.0.0.1:8642")), Err(Refusal::Unknown), "{path}");
        }
    }

    #[test]
    fn what_is_made_in_the_name_of_another_host_is_refused() {
        for host in
            ["evil.example:8642", "127.0.0.1", "127.0.0.1:80", "localhost:86420", "127.0.0.1:8642.evil.example", ""]
        {
            assert_eq!(asked(&format!("GET / HTTP/1.1\nHost: {host}")), Err(Refusal::Foreign), "{host}");
        }
        for hosts in ["", "\nHost: localhost:8642\nHost: evil.example"] {
            assert_eq!(asked(&format!("GET / HTTP/1.1{hosts}")), Err(Refusal::Unreadable), "{hosts}");
        }
        let foreign = "GET /data HTTP/1.1\nHost: localhost:8642\nSec-Fetch-Site: cross-site";
        assert_eq!(asked(foreign), Err(Refusal::Foreign));
    }

    #[test]
    fn what_is_no_request_is_refused() {
        for line in ["", "GET", "GET /", "GET / HTTP/2", "GET  / HTTP/1.1", "GET / HTTP/1.1 x", " / HTTP/1.1"] {
            assert_eq!(asked(&format!("{line}\nHost: localhost:8642")), Err(Refusal::Unreadable), "{line}");
        }
        for header in [" folded", "no colon", ": no name", "a b: c"] {
            let head = format!("GET / HTTP/1.1\nHost: localhost:8642\n{header}");
            assert_eq!(asked(&head), Err(Refusal::Unreadable), "{header}");
        }
        for query in ["since=x", "page=-1", "page=99999999999999999999", "since", "x=1"] {
            let head = format!("GET /data?{query} HTTP/1.1\nHost: localhost:8642");
            assert_eq!(asked(&head), Err(Refusal::Unreadable), "{query}");
        }
        for method in ["POST", "PUT", "DELETE", "HEAD", "OPTIONS", "CONNECT", "get"] {
            assert_eq!(asked(&format!("{method} / HTTP/1.1\nHost: localhost:8642")), Err(Refusal::NotGet), "{method}");
        }
        assert_eq!(understand(b"GET / HTTP/1.1\r\nHost: \xff", 8642), Err(Refusal::Unreadable));
        assert_eq!((end_of_head(b"a\r\n\r\nb"), end_of_head(b"a\r\n\r")), (Some(1), None));
    }
}
