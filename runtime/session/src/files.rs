//! Where scripts come from: the project's folder, then the standard library inside the binary, nowhere else.

use crate::bounded::{Unread, read_all, read_file};
use crate::wanted::Wanted;
use albacore_formats::FileFault;
use albacore_lang::source::{SOURCE_BYTES_MAX, Source};
use albacore_lang::{Library, Prelude, Script};
use albacore_wording::nearest;
use std::io::Read;
use std::path::{Component, Path, PathBuf};
use std::sync::LazyLock;

/// The standard library, compiled in: an installed binary needs no checkout.
const STDLIB: &[(&str, &str)] = &[
    ("amp", include_str!("../../../stdlib/amp.alb")),
    ("bathymetry", include_str!("../../../stdlib/bathymetry.alb")),
    ("boundary", include_str!("../../../stdlib/boundary.alb")),
    ("calendar", include_str!("../../../stdlib/calendar.alb")),
    ("cpt", include_str!("../../../stdlib/cpt.alb")),
    ("craft", include_str!("../../../stdlib/craft.alb")),
    ("drifting", include_str!("../../../stdlib/drifting.alb")),
    ("faults", include_str!("../../../stdlib/faults.alb")),
    ("features", include_str!("../../../stdlib/features.alb")),
    ("filters", include_str!("../../../stdlib/filters.alb")),
    ("inputs", include_str!("../../../stdlib/inputs.alb")),
    ("instruments", include_str!("../../../stdlib/instruments.alb")),
    ("likelihood", include_str!("../../../stdlib/likelihood.alb")),
    ("links", include_str!("../../../stdlib/links.alb")),
    ("localize", include_str!("../../../stdlib/localize.alb")),
    ("maneuver", include_str!("../../../stdlib/maneuver.alb")),
    ("maps", include_str!("../../../stdlib/maps.alb")),
    ("outlines", include_str!("../../../stdlib/outlines.alb")),
    ("reckoning", include_str!("../../../stdlib/reckoning.alb")),
    ("safety", include_str!("../../../stdlib/safety.alb")),
    ("scenarios", include_str!("../../../stdlib/scenarios.alb")),
    ("search", include_str!("../../../stdlib/search.alb")),
    ("vehicles", include_str!("../../../stdlib/vehicles.alb")),
    ("waypoints_2016", include_str!("../../../stdlib/waypoints_2016.alb")),
    ("world", include_str!("../../../stdlib/world.alb")),
];

/// Modules whose names every script knows.
const PRELUDE: [&str; 6] = ["inputs", "scenarios", "world", "craft", "instruments", "faults"];

/// So many names are listed in a message at most.
const LISTED_MAX: usize = 12;

/// The file that marks a project's folder.
const PROJECT_FILE: &str = "albacore.toml";

/// A script that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct FileError {
    /// What is wrong, with the path.
    pub message: String,
    /// How to mend it.
    pub help: Option<String>,
}

/// The files of a project.
#[derive(Clone, Debug)]
pub struct Files {
    root: PathBuf,
}

/// Reads and checks a script file, with what is wanted of it.
pub fn load_for(path: &Path, wanted: &Wanted) -> Result<Script, FileError> {
    let source = read(path)?;
    let (own, _) = wanted.parted();
    Ok(albacore_lang::load_for(source, &Files::around(path), &wanted.of_script(&own)))
}

/// The same for a mission in its own scenario.
pub fn load(path: &Path, mission: Option<&str>, set: &[String]) -> Result<Script, FileError> {
    load_for(path, &Wanted { mission, set, ..Wanted::default() })
}

/// Reads and checks a script file, or a module of the standard library. A bare name, without a dot or a folder, is a
/// module's, whatever files there are.
pub fn load_or_module(path: &Path) -> Result<Script, FileError> {
    let Some(name) = path.to_str().filter(|name| !name.contains(['.', '/', '\\'])) else {
        return load(path, None, &[]);
    };
    let Some(source) = stdlib(name) else {
        let modules: Vec<&str> = standard_modules().collect();
        let file = path.with_extension("alb");
        let help = match nearest(name, modules.iter().copied()) {
            _ if file.is_file() => Some(format!("did you mean `{}`?", file.display())),
            Some(near) => Some(format!("did you mean `{near}`?")),
            None => {
                Some(format!("there is {}; a script is named by its file, such as `mission.alb`", modules.join(", ")))
            }
        };
        return Err(FileError { message: format!("the standard library has no module `{name}`"), help });
    };
    Ok(albacore_lang::load(source, &Files::around(Path::new("")), None, &[]))
}

/// The modules of the standard library, in the order of their names.
pub fn standard_modules() -> impl Iterator<Item = &'static str> {
    STDLIB.iter().map(|(name, _)| *name)
}

/// Whether every script knows the names of a module of the standard library.
pub fn is_known_everywhere(module: &str) -> bool {
    PRELUDE.contains(&module)
}

/// Checks a script that is in no file yet, as if it stood alone in the folder of its name.
pub fn load_text(source: Source) -> Script {
    let files = Files::around(Path::new(&*source.name));
    albacore_lang::load(source, &files, None, &[])
}

/// A script without a file of its own: it knows what every script knows, the worlds of the standard library among it. `set`
/// changes the parameters of one of them.
pub fn load_library(scenario: &str, set: &[String]) -> Script {
    let nothing = Source { name: "the standard library".into(), text: "".into() };
    let wanted = Wanted { mission: None, scenario: Some(scenario), set };
    albacore_lang::load_for(nothing, &Files::around(Path::new("")), &wanted.of_script(set))
}

/// Reads a source file as text.
pub fn read(path: &Path) -> Result<Source, FileError> {
    let name = path.display().to_string();
    match read_file(path, SOURCE_BYTES_MAX as u64) {
        Ok(bytes) => source(&name, &format!("`{name}`"), bytes),
        Err(Unread::System(error)) => Err(unreadable(path, &error)),
        Err(Unread::NoFile(what)) => Err(FileError {
            message: format!("`{name}` is {what}"),
            help: Some("name a script, such as `mission.alb`".into()),
        }),
        Err(Unread::Large(most)) => Err(larger(&format!("`{name}`"), most)),
    }
}

/// Reads a source from standard input as text.
pub fn read_input(input: impl Read) -> Result<Source, FileError> {
    const INPUT: &str = "standard input";
    match read_all(input, SOURCE_BYTES_MAX as u64) {
        Ok(bytes) => source("<stdin>", INPUT, bytes),
        Err(Unread::Large(most)) => Err(larger(INPUT, most)),
        Err(error) => Err(FileError { message: format!("{INPUT} cannot be read: {error}"), help: None }),
    }
}

fn source(name: &str, shown: &str, bytes: Vec<u8>) -> Result<Source, FileError> {
    if let Some(what) = no_text(&bytes) {
        return Err(FileError { message: format!("{shown} {what}"), help: Some("save it as UTF-8".into()) });
    }
    match String::from_utf8(bytes) {
        Ok(text) => Ok(Source { name: name.into(), text: text.into() }),
        Err(error) => {
            let valid = error.utf8_error().valid_up_to();
            let line = error.as_bytes()[..valid].iter().filter(|&&b| b == b'\n').count() + 1;
            let message = format!("{shown} is no text in UTF-8: line {line}");
            Err(FileError { message, help: Some("save it as UTF-8".into()) })
        }
    }
}

/// What bytes are that begin with the mark of UTF-32 or UTF-16, or of which a fourth is zero: in UTF-16 that is one byte of every
/// letter of the language, always the first or always the second; in UTF-32 two bytes of four are in every text. A stray zero in a text
/// is told at its place.
fn no_text(bytes: &[u8]) -> Option<&'static str> {
    let [a, b, c, d] = [0, 1, 2, 3].map(|at| bytes.iter().skip(at).step_by(4).filter(|&&byte| byte == 0).count());
    let letters = bytes.len() / 4;
    let is_four = |upper: usize, lowest: usize| upper >= 2 * letters && lowest * 4 < letters;
    if is_four(a + b, d) || is_four(c + d, a) {
        return Some("is UTF-32");
    }
    let (even, odd) = (a + c, b + d);
    let is_many = even + odd > letters;
    let is_wide = is_many && even.min(odd) * 4 < even.max(odd);
    if is_wide || bytes.starts_with(&[0xFF, 0xFE]) || bytes.starts_with(&[0xFE, 0xFF]) {
        return Some("is UTF-16");
    }
    is_many.then_some("is no text: it is full of bytes that are zero")
}

fn larger(shown: &str, most: u64) -> FileError {
    FileError { message: format!("{shown} is larger than {most} bytes"), help: None }
}

fn unreadable(path: &Path, error: &std::io::Error) -> FileError {
    let name = path.display().to_string();
    if leads_nowhere(path) {
        let help = Some("put the file itself in its place".into());
        return FileError { message: format!("`{name}` is a link that leads nowhere"), help };
    }
    if error.kind() != std::io::ErrorKind::NotFound {
        return FileError { message: format!("`{name}` cannot be read: {}", plain(error)), help: None };
    }
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut scripts: Vec<String> = scripts_in(folder);
    scripts.sort();
    let wanted = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
    let help = if let Some(near) = nearest_file(&wanted, &scripts) {
        Some(format!("did you mean `{}`?", folder.join(near).display()))
    } else if !folder.is_dir() {
        Some(format!("there is no folder `{}`", folder.display()))
    } else if scripts.is_empty() {
        Some(format!("`{}` holds no scripts", folder.display()))
    } else if scripts.len() > LISTED_MAX {
        let some = scripts[..LISTED_MAX].join(", ");
        Some(format!("`{}` holds {some} and {} more", folder.display(), scripts.len() - LISTED_MAX))
    } else {
        Some(format!("`{}` holds {}", folder.display(), scripts.join(", ")))
    };
    FileError { message: format!("there is no file `{name}`"), help }
}

/// Whether there is a link at a path, and no file at its end.
pub(crate) fn leads_nowhere(path: &Path) -> bool {
    path.is_symlink() && !path.exists()
}

/// The file whose name is nearest to a misspelt one, when it is near enough to be meant: the ending that two names share makes
/// them no nearer.
pub(crate) fn nearest_file(name: &str, files: &[String]) -> Option<String> {
    let Some((stem, ending)) = name.rsplit_once('.') else {
        return nearest(name, files.iter().map(String::as_str)).map(String::from);
    };
    let (alike, others): (Vec<&str>, Vec<&str>) =
        files.iter().map(String::as_str).partition(|file| file.rsplit_once('.').is_some_and(|(_, of)| of == ending));
    let stems = alike.into_iter().filter_map(|file| file.rsplit_once('.')).map(|(stem, _)| stem);
    match nearest(stem, stems) {
        Some(near) => Some(format!("{near}.{ending}")),
        None => nearest(name, others).map(String::from),
    }
}

/// An error of the system without its number.
pub(crate) fn plain(error: &std::io::Error) -> String {
    let text = error.to_string();
    text.split(" (os error").next().unwrap_or(&text).to_lowercase()
}

fn scripts_in(folder: &Path) -> Vec<String> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    entries.flatten().map(|e| e.file_name().to_string_lossy().into_owned()).filter(|n| n.ends_with(".alb")).collect()
}

impl Files {
    /// The project that a script belongs to: the nearest folder above it with an `albacore.toml`, else its own folder.
    pub fn around(script: &Path) -> Self {
        let own = script.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new(".")).to_path_buf();
        let absolute = std::path::absolute(&own).unwrap_or_else(|_| own.clone());
        let mut root = own.clone();
        for (up, folder) in absolute.ancestors().enumerate() {
            if folder.join(PROJECT_FILE).is_file() {
                root = own.clone();
                for _ in 0..up {
                    root = if root.as_os_str().is_empty() || root == Path::new(".") {
                        root.join("..")
                    } else {
                        parent(&root)
                    };
                }
                break;
            }
        }
        Files { root }
    }

    /// The project that a script was read from.
    pub(crate) fn of(script: &Script) -> Self {
        let name = script.sources.iter().next().map(|source| source.name.to_string());
        Files::around(Path::new(&name.unwrap_or_default()))
    }

    /// The project's folder.
    pub(crate) fn root(&self) -> &Path {
        &self.root
    }

    /// The names that `use` can give.
    fn known(&self) -> Vec<String> {
        let mut names: Vec<String> =
            scripts_in(&self.root).into_iter().map(|n| n.trim_end_matches(".alb").to_string()).collect();
        names.extend(STDLIB.iter().map(|(n, _)| (*n).to_string()));
        names.sort();
        names.dedup();
        names
    }
}

fn parent(path: &Path) -> PathBuf {
    match path.components().next_back() {
        Some(Component::Normal(_)) => {
            // The folder above `missions` is the one we stand in.
            path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new(".")).to_path_buf()
        }
        _ => path.join(".."),
    }
}

pub(crate) fn stdlib(name: &str) -> Option<Source> {
    let (name, text) = STDLIB.iter().find(|(n, _)| *n == name)?;
    Some(Source { name: format!("stdlib/{name}.alb").into(), text: (*text).into() })
}

/// Whether a module is one of the standard library, and no script that lies where one of them would.
pub(crate) fn is_standard(source: &Source) -> bool {
    let name = source.name.strip_prefix("stdlib/").and_then(|file| file.strip_suffix(".alb"));
    name.and_then(stdlib).is_some_and(|standard| standard.text == source.text)
}

impl Library for Files {
    fn prelude(&self) -> &Prelude {
        static READ: LazyLock<Prelude> =
            LazyLock::new(|| Prelude::read(PRELUDE.into_iter().filter_map(stdlib).collect()));
        &READ
    }

    fn module(&self, importer: &Source, path: &[String]) -> Result<Source, String> {
        // The standard library is made of its own modules, whatever a project calls its scripts.
        if let [name] = path
            && is_standard(importer)
            && let Some(source) = stdlib(name)
        {
            return Ok(source);
        }
        // Names are letters, digits and underscores: they cannot lead out of the folder.
        let file = path.iter().fold(self.root.clone(), |folder, part| folder.join(part)).with_extension("alb");
        if file.exists() {
            let inside = match (file.canonicalize(), self.root.canonicalize()) {
                (Ok(file), Ok(root)) => file.starts_with(root),
                _ => false,
            };
            if !inside {
                return Err(format!("`{}` is a link that leads out of the project", file.display()));
            }
            return read(&file).map_err(|error| error.message);
        }
        if leads_nowhere(&file) {
            return Err(format!("`{}` is a link that leads nowhere", file.display()));
        }
        if let [name] = path
            && let Some(source) = stdlib(name)
        {
            return Ok(source);
        }
        if let [module, name, ..] = path
            && (stdlib(module).is_some() || self.root.join(module).with_extension("alb").is_file())
        {
            return Err(format!("`{module}` is a module: write `use {module}`, and then `{module}.{name}`"));
        }
        let known = self.known();
        let wanted = path.join(".");
        Err(match nearest(&wanted, known.iter().map(String::as_str)) {
            Some(near) => format!("did you mean `{near}`?"),
            None if known.len() <= LISTED_MAX.max(STDLIB.len()) => format!("there is {}", known.join(", ")),
            None => {
                let standard: Vec<&str> = standard_modules().collect();
                format!("there is {}, and the scripts of this project's folder", standard.join(", "))
            }
        })
    }

    fn data_file(&self, path: &str, bytes_max: u64) -> Result<Vec<u8>, FileFault> {
        self.data(path, bytes_max).map_err(|FileError { message, help }| FileFault { message, help })
    }
}
