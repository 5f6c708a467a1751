//! A page as HTML that needs nothing else: its Markdown set, its code linked, its diagrams drawn.

use super::markdown::DIAGRAM;
use super::names::{Names, Use, anchor};
use super::{Module, drawn};
use albacore_session::is_setpoint;
use albacore_session::seen::shown;
use pulldown_cmark::{CodeBlockKind, CowStr, Event, Options, Parser, Tag, TagEnd, html};

const STYLE: &str = include_str!("style.css");

/// A page; an index has no home. `beside_index` is one that the index leads to.
pub fn page(title: &str, markdown: &str, home: Option<(usize, &Module)>, names: &Names, beside_index: bool) -> String {
    let mut body = String::new();
    html::push_html(&mut body, events(markdown, home, names).into_iter());
    let up = if beside_index && home.is_some() { "<nav><a href=\"index.html\">all modules</a></nav>\n" } else { "" };
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n\
         <style>\n{STYLE}</style>\n</head>\n<body>\n{up}<main>\n{body}</main>\n</body>\n</html>\n",
        escaped(title)
    )
}

fn events<'a>(markdown: &'a str, home: Option<(usize, &Module)>, names: &Names) -> Vec<Event<'a>> {
    let mut out: Vec<Event> = Vec::new();
    // The code block that is being read, and the heading.
    let mut block: Option<(String, String)> = None;
    let mut heading: Option<(usize, String)> = None;
    for event in Parser::new_ext(markdown, Options::ENABLE_TABLES) {
        if let (Some((_, said)), Event::Text(text) | Event::Code(text)) = (&mut heading, &event) {
            said.push_str(text);
        }
        match event {
            Event::Start(Tag::CodeBlock(kind)) => {
                let mark = if let CodeBlockKind::Fenced(mark) = kind { mark.to_string() } else { String::new() };
                block = Some((mark, String::new()));
            }
            Event::End(TagEnd::CodeBlock) => {
                let (mark, text) = block.take().unwrap_or_default();
                out.push(Event::Html(code_block(&mark, &text, home, names).into()));
            }
            Event::Text(text) if block.is_some() => {
                if let Some((_, said)) = &mut block {
                    said.push_str(&text);
                }
            }
            Event::Start(Tag::Heading { .. }) => {
                heading = Some((out.len(), String::new()));
                out.push(event);
            }
            Event::End(TagEnd::Heading(_)) => {
                if let Some((at, said)) = heading.take()
                    && let Some(Event::Start(Tag::Heading { id, .. })) = out.get_mut(at)
                {
                    *id = Some(anchor(&said).into());
                }
                out.push(event);
            }
            Event::Start(Tag::Link { link_type, dest_url, title, id }) => {
                let dest_url = target(&dest_url);
                out.push(Event::Start(Tag::Link { link_type, dest_url, title, id }));
            }
            // A page shows what a comment says, and does not do it.
            Event::Html(text) | Event::InlineHtml(text) => out.push(Event::Text(text)),
            Event::Start(Tag::Image { .. }) | Event::End(TagEnd::Image) => {}
            event => out.push(event),
        }
    }
    out
}

/// Where a link leads: to another page of these, to the web, and nowhere else.
fn target<'a>(written: &str) -> CowStr<'a> {
    let is_web = written.starts_with("https://") || written.starts_with("http://");
    if !is_web && written.contains(':') {
        return CowStr::Borrowed("#");
    }
    match written.split_once(".md") {
        Some((page, rest)) if !is_web && (rest.is_empty() || rest.starts_with('#')) => {
            format!("{page}.html{rest}").into()
        }
        _ => written.to_string().into(),
    }
}

fn code_block(mark: &str, text: &str, home: Option<(usize, &Module)>, names: &Names) -> String {
    let picture = mark.strip_prefix(DIAGRAM).zip(home).and_then(|(name, (_, module))| drawn(module, name));
    if let Some(picture) = picture {
        return picture;
    }
    let shown = match home {
        Some((home, _)) if mark == "alb" => linked(text, home, names),
        _ => escaped(text),
    };
    format!("<pre><code>{shown}</code></pre>\n")
}

/// A piece of a script, in which names lead to what they name.
fn linked(text: &str, home: usize, names: &Names) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        let length = match c {
            '/' if rest.starts_with("//") => rest.find('\n').unwrap_or(rest.len()),
            '"' => rest.get(1..).and_then(|after| after.find(['"', '\n'])).map_or(rest.len(), |at| at + 2),
            c if is_part(c) => rest.find(|c| !is_part(c) && c != '.').unwrap_or(rest.len()),
            c => c.len_utf8(),
        };
        let (token, after) = rest.split_at_checked(length).unwrap_or((rest, ""));
        out.push_str(&match c {
            '/' if length > 1 => format!("<i>{}</i>", escaped(token)),
            c if is_part(c) => word(token, after, home, names),
            _ => escaped(token),
        });
        rest = after;
    }
    out
}

fn is_part(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// A name with what follows its dots. A label, and a channel before its setpoint, name nothing.
fn word(token: &str, after: &str, home: usize, names: &Names) -> String {
    let next = after.trim_start_matches(' ');
    let is_label = next.starts_with(':') || (after.starts_with(' ') && next.starts_with(is_part) && is_setpoint(token));
    let used = if after.starts_with('(') { Use::Called } else { Use::Value };
    // `flow.toward` is a field of `flow`; `search.find` is a name of another module.
    let (head, field) = token.split_once('.').map_or((token, ""), |(head, _)| (head, &token[head.len()..]));
    let whole = names.link(token, home, used).map(|link| (token, "", link));
    let part = || names.link(head, home, Use::Value).map(|link| (head, field, link));
    match whole.or_else(part).filter(|_| !is_label) {
        Some((shown, field, link)) => format!("<a href=\"{}\">{}</a>{}", target(&link), escaped(shown), escaped(field)),
        None => escaped(token),
    }
}

/// A text as HTML shows it, whatever is in it.
pub fn escaped(text: &str) -> String {
    shown(text).replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
