//! Files of numbers that a script names: read from its project's folder, and from nowhere else.

use crate::files::Files;
use std::path::{Component, Path, PathBuf};

/// The folder that a script's data lie in.
#[derive(Clone, Debug)]
pub(crate) struct DataFiles {
    root: PathBuf,
}

impl DataFiles {
    /// The data of the project that a script belongs to.
    pub fn of_script(script: &str) -> Self {
        DataFiles { root: Files::around(Path::new(script)).root().to_path_buf() }
    }

    /// The bytes of a file by its path from the project's folder, if they are no more than `bytes_max`.
    pub fn read(&self, path: &str, bytes_max: u64) -> Result<Vec<u8>, String> {
        let file = self.inside(path)?;
        let metadata = std::fs::metadata(&file).map_err(|error| self.unreadable(path, &error))?;
        // A directory, a device or a pipe would answer with something else, or never.
        if !metadata.is_file() {
            return Err(format!("`{path}` is no ordinary file"));
        }
        if metadata.len() > bytes_max {
            return Err(format!("`{path}` has {} bytes: it must have {bytes_max} at most", metadata.len()));
        }
        std::fs::read(&file).map_err(|error| self.unreadable(path, &error))
    }

    /// The same as text.
    pub fn read_text(&self, path: &str, bytes_max: u64) -> Result<String, String> {
        String::from_utf8(self.read(path, bytes_max)?).map_err(|_| format!("`{path}` is no text in UTF-8"))
    }

    /// Where a file is, which must be in the project, links followed.
    fn inside(&self, path: &str) -> Result<PathBuf, String> {
        let relative = Path::new(path);
        let plain = relative.components().all(|part| matches!(part, Component::Normal(_) | Component::CurDir));
        if path.is_empty() || !plain {
            return Err(format!(
                "`{path}` must be a path from the project's folder, and in it: such as `data/{}`",
                name(path)
            ));
        }
        let file = self.root.join(relative);
        match (file.canonicalize(), self.root.canonicalize()) {
            (Ok(file), Ok(root)) if !file.starts_with(&root) => {
                Err(format!("`{path}` is a link that leads out of the project"))
            }
            (Err(error), _) => Err(self.unreadable(path, &error)),
            _ => Ok(file),
        }
    }

    fn unreadable(&self, path: &str, error: &std::io::Error) -> String {
        if error.kind() == std::io::ErrorKind::NotFound {
            format!("there is no file `{path}` in the project's folder, `{}`", self.root.display())
        } else {
            format!("`{path}` cannot be read: {}", crate::files::plain(error))
        }
    }
}

/// The last part of a path, as an example.
fn name(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().filter(|name| !name.is_empty()).unwrap_or("file")
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn only_files_of_the_project_are_read() {
        let folder = std::env::temp_dir().join(format!("albacore-data-{}", std::process::id()));
        fs::create_dir_all(folder.join("project/data")).unwrap();
        fs::write(folder.join("project/albacore.toml"), "").unwrap();
        fs::write(folder.join("project/data/numbers"), "123").unwrap();
        fs::write(folder.join("secret"), "no").unwrap();
        let files = DataFiles::of_script(&folder.join("project/missions.alb").to_string_lossy());
        assert_eq!(files.read("data/numbers", 3).unwrap(), b"123");
        assert_eq!(files.read_text("./data/numbers", 9).unwrap(), "123");
        for (path, expected) in [
            ("../secret", "must be a path from the project's folder"),
            ("/etc/passwd", "must be a path from the project's folder"),
            ("", "must be a path from the project's folder"),
            ("data", "is no ordinary file"),
            ("data/none", "there is no file `data/none`"),
        ] {
            let said = files.read(path, 100).unwrap_err();
            assert!(said.contains(expected), "{said}");
        }
        assert!(files.read("data/numbers", 2).unwrap_err().contains("has 3 bytes: it must have 2 at most"));
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(folder.join("secret"), folder.join("project/link")).unwrap();
            assert!(files.read("link", 100).unwrap_err().contains("leads out of the project"));
        }
        fs::remove_dir_all(&folder).unwrap();
    }
}
