//! Files of numbers that a script names: they lie in the project's folder, as what `use` imports does.

use crate::bounded::{Unread, read_file};
use crate::files::{FileError, Files, leads_nowhere, nearest_file, plain};
use std::path::{Component, Path};

impl Files {
    /// The bytes of a file of the project, `bytes_max` of them at most. Its path counts from the project's folder and does not
    /// lead out of it, neither by itself nor by a link.
    pub(crate) fn data(&self, path: &str, bytes_max: u64) -> Result<Vec<u8>, FileError> {
        let error = |what: &str, help: &str| FileError { message: format!("`{path}` {what}"), help: Some(help.into()) };
        let parts = Path::new(path).components();
        if path.is_empty() || !parts.into_iter().all(|part| matches!(part, Component::Normal(_) | Component::CurDir)) {
            return Err(error(
                "does not lie in the project's folder",
                "copy the file there, and name it from there, such as `bathymetry/bay.csv`",
            ));
        }
        let file = self.root().join(path);
        if leads_nowhere(&file) {
            return Err(error("is a link that leads nowhere", "put the file itself in its place"));
        }
        if !file.exists() {
            return Err(self.missing(path, &file));
        }
        let inside = match (file.canonicalize(), self.root().canonicalize()) {
            (Ok(file), Ok(root)) => file.starts_with(root),
            _ => false,
        };
        if !inside {
            return Err(error("is a link that leads out of the project", "copy the file into the project's folder"));
        }
        read_file(&file, bytes_max).map_err(|unread| match unread {
            Unread::System(e) => error(&format!("cannot be read: {}", plain(&e)), "look at its permissions"),
            Unread::NoFile(what) => error(&format!("is {what}"), "name a file"),
            Unread::Large(most) => {
                let (has, most) = (file.metadata().map_or(most, |found| found.len()) as f64 / 1e6, most as f64 / 1e6);
                error(&format!("has {has:.1} MB: {most} MB are read at most"), "cut out the part that is needed")
            }
        })
    }

    /// There is no such file; one of its folder may be meant.
    fn missing(&self, path: &str, file: &Path) -> FileError {
        let folder = file.parent().unwrap_or(Path::new("."));
        let named = |entry: std::fs::DirEntry| entry.file_name().to_string_lossy().into_owned();
        let mut near: Vec<String> = std::fs::read_dir(folder).into_iter().flatten().flatten().map(named).collect();
        near.sort();
        let wanted = file.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        let help = match nearest_file(&wanted, &near) {
            Some(near) => format!("did you mean `{}`?", Path::new(path).with_file_name(near).display()),
            None => format!("paths count from the project's folder, `{}`", self.root().display()),
        };
        FileError { message: format!("there is no file `{path}`"), help: Some(help) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::PathBuf;

    /// A project of its own with a file in it, and one beside it.
    fn project(name: &str) -> (PathBuf, Files) {
        let folder = std::env::temp_dir().join(format!("albacore-data-{}-{name}", std::process::id()));
        let _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(folder.join("project/sub")).unwrap();
        std::fs::write(folder.join("secret.csv"), "secret").unwrap();
        std::fs::write(folder.join("project/albacore.toml"), "").unwrap();
        std::fs::write(folder.join("project/sub/bay.csv"), "depths").unwrap();
        (folder.clone(), Files::around(&folder.join("project/sub/mission.alb")))
    }

    #[track_caller]
    fn refused(files: &Files, path: &str, expected: &str) {
        let error = files.data(path, 100).unwrap_err();
        assert!(error.message.contains(expected) && error.help.is_some(), "{error:?}");
    }

    #[test]
    fn a_file_is_named_from_the_folder_of_the_project() {
        let (folder, files) = project("named");
        assert_eq!(files.data("sub/bay.csv", 100).unwrap(), b"depths");
        assert_eq!(files.data("./sub/bay.csv", 6).unwrap(), b"depths");
        refused(&files, "bay.csv", "there is no file `bay.csv`");
        let help = |path: &str| files.data(path, 9).unwrap_err().help.unwrap();
        assert_eq!(help("sub/bya.csv"), "did you mean `sub/bay.csv`?");
        assert_eq!(help("sub/bay.cvs"), "did you mean `sub/bay.csv`?");
        assert!(
            help("sub/sea.csv").starts_with("paths count from the project's folder"),
            "what they share is the ending"
        );
        refused(&files, "sub", "is a folder");
        std::fs::write(folder.join("project/large.csv"), [b'1'; 101]).unwrap();
        refused(&files, "large.csv", "are read at most");
        std::fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    #[cfg(unix)]
    fn no_path_leads_out_and_nothing_is_read_but_files() {
        let (folder, files) = project("out");
        for path in ["../secret.csv", "sub/../../secret.csv", "/etc/passwd", "/dev/zero", ""] {
            refused(&files, path, "does not lie in the project's folder");
        }
        std::os::unix::fs::symlink(folder.join("secret.csv"), folder.join("project/link.csv")).unwrap();
        std::os::unix::fs::symlink("/dev/zero", folder.join("project/zero.csv")).unwrap();
        refused(&files, "link.csv", "is a link that leads out of the project");
        refused(&files, "zero.csv", "is a link that leads out of the project");
        for (link, to) in [("loop.csv", "loop.csv"), ("gone.csv", "nothing.csv")] {
            std::os::unix::fs::symlink(to, folder.join("project").join(link)).unwrap();
            refused(&files, link, &format!("`{link}` is a link that leads nowhere"));
            let script = crate::files::read(&folder.join("project").join(link)).unwrap_err();
            assert!(script.message.ends_with("is a link that leads nowhere"), "{script:?}");
        }
        assert!(std::process::Command::new("mkfifo").arg(folder.join("project/pipe.csv")).status().unwrap().success());
        refused(&files, "pipe.csv", "is no ordinary file");
        std::fs::remove_dir_all(folder).unwrap();
    }
}
