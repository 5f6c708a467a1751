//! The page of a run that goes on, served to browsers of this machine alone. Nobody can do anything here but look.
//!
//! A thread accepts, and each connection has one more: as long as its time lasts, and only so many at once. None of them holds a run:
//! what they ask for is kept by another thread (`LiveReport`), and the end waits for the last word to pages that ask, but not for long.

mod request;

use crate::clock::{Utc, now};
use crate::exit::Exit;
use crate::message;
use crate::report::page;
use albacore_session::threads::thread;
use albacore_session::{Cursor, Increment, LiveReport};
use request::{Asked, HEAD_BYTES_MAX, Refusal};
use serde::Serialize;
use std::io::{self, Read, Write};
use std::net::{Ipv4Addr, Shutdown, TcpListener, TcpStream};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// Connections at once; further ones are closed.
const CONNECTIONS_MAX: usize = 16;
/// A request has come in this time, or is none.
const REQUEST: Duration = Duration::from_secs(2);
/// ... and its answer is taken in this.
const ANSWER: Duration = Duration::from_secs(5);
/// What comes after a request is thrown away so long and no longer.
const REST: Duration = Duration::from_millis(300);
/// Bytes that are written at once.
const PART: usize = 64 << 10;
/// How long a thread that cannot accept waits before it tries again: all files may be open.
const AGAIN: Duration = Duration::from_millis(200);
/// Pages that are told apart.
const PAGES_MAX: usize = 32;
/// A page that has not asked for so long is closed.
const ASKS: Duration = Duration::from_secs(3);
/// The last word to pages that ask takes no longer.
const LAST_WORD: Duration = Duration::from_secs(2);

/// A server that waits for its run.
pub struct Waiting {
    listener: TcpListener,
    port: u16,
}

/// A server of a run.
pub struct LivePage(Arc<Served>);

/// What is served.
struct Served {
    report: Arc<LiveReport>,
    port: u16,
    /// The page, which does not change.
    page: String,
    /// By which a page knows that it asks about the run that it shows.
    run: String,
    connections: AtomicUsize,
    pages: Mutex<Vec<Looking>>,
    told: Condvar,
}

/// A page that asks.
struct Looking {
    number: u64,
    asked: Duration,
    knows_end: bool,
}

/// An increment with what the page shows of it as it is.
#[derive(Serialize)]
struct Told<'a> {
    run: &'a str,
    title: String,
    head_html: String,
    reports_html: Option<String>,
    #[serde(flatten)]
    increment: &'a Increment,
}

/// An answer: its status, what it is, and whether it tells of the end to a page.
struct Answer {
    status: &'static str,
    kind: &'static str,
    body: Vec<u8>,
    last_word_to: Option<u64>,
}

impl Waiting {
    /// Takes a port of this machine; 0 is any that is free.
    pub fn at(port: u16) -> Result<Self, Exit> {
        let bound = TcpListener::bind((Ipv4Addr::LOCALHOST, port));
        let served = bound.and_then(|listener| Ok((listener.local_addr()?.port(), listener)));
        let (port, listener) = served.map_err(|error| {
            let help = "choose another `--port`, or leave it out: then any that is free is taken";
            message::error(&format!("the page cannot be served at 127.0.0.1:{port}: {error}"), Some(help));
            Exit::Failed
        })?;
        Ok(Waiting { listener, port })
    }

    /// Serves a run from here on, and says where.
    pub fn serve(self, report: Arc<LiveReport>) -> Result<LivePage, Exit> {
        let failed = |error: String| {
            message::error(&format!("the page cannot be served: {error}"), Some("run without `--live`"));
            Exit::Failed
        };
        let page = page::live(&report.beginning()).map_err(|error| failed(error.to_string()))?;
        let run = format!("{}-{}-{}", Utc::now().unix_ms(), std::process::id(), now().as_nanos());
        let (connections, pages, told) = (AtomicUsize::new(0), Mutex::default(), Condvar::new());
        let served = Arc::new(Served { report, port: self.port, page, run, connections, pages, told });
        let accepting = Arc::clone(&served);
        let begun = thread("page").spawn(move || accept(&self.listener, &accepting));
        begun.map_err(|error| failed(error.to_string()))?;
        message::write(&message::line(&format!("live at http://127.0.0.1:{}/", served.port)));
        Ok(LivePage(served))
    }
}

impl LivePage {
    /// Waits until all pages that still ask have been told of the end, or no longer than that is worth.
    pub fn end(self) {
        let until = now() + LAST_WORD;
        let mut pages = self.0.pages();
        loop {
            let time = now();
            let waits = |page: &Looking| !page.knows_end && page.asked + ASKS > time;
            let Some(left) = until.checked_sub(time).filter(|left| !left.is_zero() && pages.iter().any(waits)) else {
                return;
            };
            pages = self.0.told.wait_timeout(pages, left).unwrap_or_else(PoisonError::into_inner).0;
        }
    }
}

impl Served {
    fn pages(&self) -> MutexGuard<'_, Vec<Looking>> {
        self.pages.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A page has asked.
    fn asks(&self, number: u64) {
        let (mut pages, asked) = (self.pages(), now());
        match pages.iter_mut().find(|page| page.number == number) {
            Some(page) => page.asked = asked,
            None => {
                pages.retain(|page| page.asked + ASKS > asked);
                if pages.len() < PAGES_MAX {
                    pages.push(Looking { number, asked, knows_end: false });
                }
            }
        }
    }

    /// A page has been told of the end.
    fn has_told(&self, number: u64) {
        if let Some(page) = self.pages().iter_mut().find(|page| page.number == number) {
            page.knows_end = true;
        }
        self.told.notify_all();
    }

    fn answer(&self, asked: Result<Asked, Refusal>) -> Answer {
        match asked {
            Ok(Asked::Page) => Answer {
                status: "200 OK",
                kind: "text/html; charset=utf-8",
                body: self.page.clone().into_bytes(),
                last_word_to: None,
            },
            Ok(Asked::Data(known, number)) => self.data(known, number),
            Err(refusal) => refused(refusal.status()),
        }
    }

    fn data(&self, known: Option<Cursor>, number: Option<u64>) -> Answer {
        if let Some(number) = number {
            self.asks(number);
        }
        let increment = self.report.since(known);
        let told = Told {
            run: &self.run,
            title: page::title(&increment.head),
            head_html: page::head(&increment.head),
            reports_html: increment.reports.as_ref().map(|rows| page::reports(rows, increment.more_reports)),
            increment: &increment,
        };
        match serde_json::to_vec(&told) {
            Ok(body) => Answer {
                status: "200 OK",
                kind: "application/json",
                body,
                last_word_to: number.filter(|_| increment.ended),
            },
            Err(_) => refused("500 Internal Server Error"),
        }
    }
}

fn refused(status: &'static str) -> Answer {
    Answer { status, kind: "text/plain; charset=utf-8", body: format!("{status}\n").into_bytes(), last_word_to: None }
}

/// Accepts to the end of the program.
fn accept(listener: &TcpListener, served: &Arc<Served>) {
    loop {
        let Ok((stream, _)) = listener.accept() else {
            std::thread::sleep(AGAIN);
            continue;
        };
        if served.connections.fetch_add(1, Ordering::Relaxed) >= CONNECTIONS_MAX {
            served.connections.fetch_sub(1, Ordering::Relaxed);
            continue;
        }
        let serving = Place(Arc::clone(served));
        // Without a thread the connection is closed.
        let _ = thread("client").spawn(move || {
            let _ = converse(stream, &serving.0);
        });
    }
}

/// A place among the connections, which is free again when its thread ends or never began.
struct Place(Arc<Served>);

impl Drop for Place {
    fn drop(&mut self) {
        self.0.connections.fetch_sub(1, Ordering::Relaxed);
    }
}

/// One request and its answer.
fn converse(mut stream: TcpStream, served: &Served) -> io::Result<()> {
    let asked = read_head(&mut stream, now() + REQUEST)?;
    let answer = served.answer(asked.and_then(|head| request::understand(&head, served.port)));
    write_all(&mut stream, &answer.bytes(), now() + ANSWER)?;
    stream.shutdown(Shutdown::Write)?;
    if let Some(number) = answer.last_word_to {
        served.has_told(number);
    }
    // Who closes while something is still coming takes back what was said.
    let until = now() + REST;
    let mut thrown_away = [0; 1024];
    while let Some(left) = left(until) {
        stream.set_read_timeout(Some(left))?;
        if stream.read(&mut thrown_away)? == 0 {
            break;
        }
    }
    Ok(())
}

/// The time that is left, if any is.
fn left(until: Duration) -> Option<Duration> {
    until.checked_sub(now()).filter(|left| !left.is_zero())
}

/// Reads a request line with its headers; an error is of the line.
fn read_head(stream: &mut TcpStream, until: Duration) -> io::Result<Result<Vec<u8>, Refusal>> {
    let mut head = Vec::new();
    let mut part = [0; 1024];
    loop {
        if let Some(end) = request::end_of_head(&head) {
            head.truncate(end);
            return Ok(Ok(head));
        }
        if head.len() > HEAD_BYTES_MAX {
            return Ok(Err(Refusal::TooLong));
        }
        let Some(left) = left(until) else { return Ok(Err(Refusal::Late)) };
        stream.set_read_timeout(Some(left))?;
        match stream.read(&mut part) {
            Ok(0) => return Err(io::ErrorKind::UnexpectedEof.into()),
            Ok(count) => head.extend_from_slice(part.get(..count).unwrap_or_default()),
            Err(error) if is_wait(&error) => {}
            Err(error) => return Err(error),
        }
    }
}

/// Writes, as long as there is time.
fn write_all(stream: &mut TcpStream, mut bytes: &[u8], until: Duration) -> io::Result<()> {
    while !bytes.is_empty() {
        stream.set_write_timeout(Some(left(until).ok_or(io::ErrorKind::TimedOut)?))?;
        match stream.write(bytes.get(..PART).unwrap_or(bytes)) {
            Ok(0) => return Err(io::ErrorKind::WriteZero.into()),
            Ok(count) => bytes = bytes.get(count..).unwrap_or_default(),
            Err(error) if is_wait(&error) => {}
            Err(error) => return Err(error),
        }
    }
    Ok(())
}

/// Whether nothing came, or went, in time.
fn is_wait(error: &io::Error) -> bool {
    matches!(error.kind(), io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut | io::ErrorKind::Interrupted)
}

impl Answer {
    fn bytes(&self) -> Vec<u8> {
        // Nothing is kept, guessed, framed, or given to pages of others.
        let head = format!(
            "HTTP/1.1 {}\r\nContent-Type: {}\r\nContent-Length: {}\r\nConnection: close\r\nCache-Control: no-store\r\n\
             X-Content-Type-Options: nosniff\r\nX-Frame-Options: DENY\r\nReferrer-Policy: no-referrer\r\n\
             Cross-Origin-Resource-Policy: same-origin\r\nCross-Origin-Opener-Policy: same-origin\r\n\
             Content-Security-Policy: default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; \
             connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'\r\n{}\r\n",
            self.status,
            self.kind,
            self.body.len(),
            if self.status.starts_with("405") { "Allow: GET\r\n" } else { "" },
        );
        [head.as_bytes(), &self.body].concat()
    }
}
