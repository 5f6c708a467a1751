//! `albacore doc`: reference pages of scripts, from their own words.

mod html;
mod markdown;
mod names;

pub use html::escaped;

use crate::exit::Exit;
use crate::made::{Comment, Made};
use crate::{disk, message, output, plan};
use albacore_session::diagram::{self, Diagram};
use albacore_session::doc::{Page, page};
use albacore_session::{FileId, Script, Sources};
use names::Names;
use std::path::{Path, PathBuf};

/// The page that leads to the others.
const INDEX: &str = "index";

/// Make reference pages of scripts, from their declarations and comments.
#[derive(clap::Args)]
pub struct Doc {
    /// A script, a folder of scripts, or a module of the standard library by its bare name (`cpt`; a folder of that name is
    /// `./cpt`); else the whole standard library.
    #[arg(value_name = "SCRIPT.alb")]
    path: Option<PathBuf>,
    /// What the pages are.
    #[arg(long, value_enum, default_value_t = Format::Markdown)]
    format: Format,
    /// The folder to write into: a page a script, and an index; else standard output.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

#[derive(Clone, Copy, PartialEq, clap::ValueEnum)]
enum Format {
    /// Text, as forges show it.
    Markdown,
    /// A page that needs nothing else, with the diagrams of strategies.
    Html,
}

/// A script that has a page.
pub struct Module {
    /// What it is called.
    name: String,
    page: Page,
    /// The diagrams of its tables, by the names of what has them.
    diagrams: Vec<(String, Diagram)>,
    /// In the standard library: whether `use` is needed for it.
    standard: Option<Import>,
}

/// How a script comes by the names of a module.
#[derive(Clone, Copy, PartialEq)]
enum Import {
    Needed,
    Known,
}

impl Doc {
    /// Makes the pages: all of them, or none, but where the disk takes some and then no more.
    pub fn run(&self) -> Exit {
        self.made().unwrap_or_else(|exit| exit)
    }

    fn made(&self) -> Result<Exit, Exit> {
        let modules = self.modules()?;
        let names = Names::new(&modules);
        if self.out.is_none() && self.format == Format::Html && modules.len() != 1 {
            message::error("several pages are no one page", Some("name a folder to write them into with `--out`"));
            return Err(Exit::Usage);
        }
        let pages: Vec<String> = modules.iter().enumerate().map(|(i, module)| self.page(module, i, &names)).collect();
        let Some(folder) = &self.out else {
            output::print(&pages.join("\n"));
            return Ok(Exit::Well);
        };
        if let Some(module) = modules.iter().find(|module| module.name.eq_ignore_ascii_case(INDEX)) {
            let message = format!("`{}.alb` can have no page: `{INDEX}` is the list of them", module.name);
            message::error(&message, Some("give the script another name, or leave out `--out`"));
            return Err(Exit::Usage);
        }
        let unwritable = |path: &Path, error: std::io::Error| {
            let help = "choose another folder with `--out`";
            message::error(&disk::not_written(path, &error), Some(help));
            Exit::Failed
        };
        std::fs::create_dir_all(folder).map_err(|error| unwritable(folder, error))?;
        let index = (INDEX, self.dressed("Modules", &markdown::index(&modules), None, &names));
        let named = modules.iter().map(|module| module.name.as_str()).zip(pages);
        let file = |name: &str| folder.join(format!("{name}.{}", self.format.ending()));
        // A page ends with an empty line, so that its mark is no part of a list.
        let page = |(name, text): (&str, String)| (file(name), Made::new(text + "\n", Comment::Markup));
        let pages: Vec<_> = named.chain([index]).map(page).collect();
        // A README of somebody's own may be called as a script is.
        pages.iter().try_for_each(|(path, _)| disk::spare(path).map_err(|error| unwritable(path, error)))?;
        pages.iter().try_for_each(|(path, page)| disk::remake(path, page).map_err(|error| unwritable(path, error)))?;
        Ok(Exit::Well)
    }

    /// One page in the format that is wanted.
    fn page(&self, module: &Module, home: usize, names: &Names) -> String {
        let with_diagrams = self.format == Format::Html;
        let text = markdown::page(module, home, names, with_diagrams);
        self.dressed(&module.name, &text, Some((home, module)), names)
    }

    fn dressed(&self, title: &str, text: &str, home: Option<(usize, &Module)>, names: &Names) -> String {
        match self.format {
            Format::Markdown => text.to_string(),
            Format::Html => html::page(title, text, home, names, self.out.is_some()),
        }
    }

    fn modules(&self) -> Result<Vec<Module>, Exit> {
        let Some(path) = &self.path else {
            return albacore_session::standard_modules().map(|name| module(Path::new(name))).collect();
        };
        let is_standard = albacore_session::standard_modules().any(|name| Path::new(name) == path);
        if is_standard || !path.is_dir() {
            return Ok(vec![module(path)?]);
        }
        let unreadable = |error: std::io::Error| {
            message::error(&format!("`{}` cannot be read: {error}", path.display()), None);
            Exit::Usage
        };
        let mut scripts = Vec::new();
        for entry in std::fs::read_dir(path).map_err(unreadable)? {
            let file = entry.map_err(unreadable)?.path();
            if file.extension().is_some_and(|ending| ending == "alb") {
                scripts.push(file);
            }
        }
        if scripts.is_empty() {
            message::error(&format!("`{}` holds no scripts", path.display()), None);
            return Err(Exit::Usage);
        }
        scripts.sort();
        scripts.iter().map(|script| module(script)).collect()
    }
}

impl Format {
    fn ending(self) -> &'static str {
        match self {
            Format::Markdown => "md",
            Format::Html => "html",
        }
    }
}

/// Reads a script, which must be sound: what it does not mean, no page can tell.
fn module(path: &Path) -> Result<Module, Exit> {
    let script: Script = plan::script_or_module(path)?;
    let source = script.sources.get(FileId(0)).clone();
    let Some(page) = page(&source) else {
        message::error(&format!("`{}` cannot be read", path.display()), None);
        return Err(Exit::Script);
    };
    let name = disk::stem(path);
    let with_table = page.declarations.iter().filter(|d| d.table.is_some()).map(|d| d.name.clone());
    let diagrams = with_table.filter_map(|name| script.diagram(Some(&name)).ok().map(|d| (name, d))).collect();
    stray(&page, &script.sources);
    let is_bare = path.to_str().is_some_and(|path| path == name);
    let standard =
        is_bare.then(|| if albacore_session::is_known_everywhere(&name) { Import::Known } else { Import::Needed });
    Ok(Module { name, page, diagrams, standard })
}

/// Says which comments would be on a page, and are on none.
fn stray(page: &Page, sources: &Sources) {
    for span in &page.stray {
        let place = sources.place(*span);
        message::write(&message::line(&format!("{place}: this comment is on no page: it stands right above nothing")));
    }
}

/// A picture of a module's table, or what stands in its place.
fn drawn(module: &Module, name: &str) -> Option<String> {
    let (_, table) = module.diagrams.iter().find(|(of, _)| of == name)?;
    let too_large = || "<p>The table is too large for a diagram.</p>\n".to_string();
    Some(diagram::svg(table).map_or_else(too_large, |svg| format!("<figure>\n{svg}</figure>\n")))
}
