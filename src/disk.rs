//! The one place that writes to the disk. A file is written whole or not at all, and what is in the making has a name that
//! nobody chose: it overwrites nothing, and follows no link. `tests/writers.rs` keeps every other writer out.

use crate::interruption::{self, Held};
use crate::made::{Made, is_as_made};
use crate::run_folder::is_of_a_run;
use std::fs::{self, File, Metadata, OpenOptions, Permissions};
use std::io::{self, ErrorKind, Read, Seek, Write};
use std::path::{Path, PathBuf};
use tempfile::{Builder, NamedTempFile, TempDir};

/// Writes a whole file, or leaves what was there: a temporary file beside it is synced and then renamed to it. A link in its
/// place is replaced, what it leads to is left alone. An existing file's permissions and owner stay, and one that is
/// read-only is refused, as is what is no ordinary file, such as `/dev/null`.
pub fn whole(path: &Path, text: &str) -> io::Result<()> {
    replace(path, text.as_bytes()).map(drop)
}

/// The same for a file that is the person's own, and held a text (none: there was no such file) when it was read: what a link in its place
/// leads to is written, and the link stays. One that holds something else by now is left alone. Gives how many other names the file
/// had (hard links): they keep what it held, for written in place it would not be whole at every moment.
pub fn rewrite(path: &Path, was: Option<&str>, text: &str) -> io::Result<u64> {
    let file = match path.canonicalize() {
        Err(error) if error.kind() == ErrorKind::NotFound && !path.is_symlink() => path.to_path_buf(),
        file => file?,
    };
    let others = names(&file).saturating_sub(1);
    replace_if(&file, text.as_bytes(), || match (fs::read(&file), was) {
        (Ok(there), Some(was)) if there == was.as_bytes() => Ok(()),
        (Err(error), None) if error.kind() == ErrorKind::NotFound => Ok(()),
        _ => Err(io::Error::new(ErrorKind::AlreadyExists, "it was changed meanwhile, and is left as it is")),
    })?;
    Ok(others)
}

/// What a file is called without its ending, as a text in which no two names are the same: bytes that are no text, or control whoever shows
/// them, are written as `%FF`, and the sign of what looks like one of these as `%25`.
pub fn stem(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default().as_encoded_bytes();
    let part = |chunk: std::str::Utf8Chunk| {
        chunk.invalid().iter().fold(escaped(chunk.valid()), |text, byte| text + &format!("%{byte:02X}"))
    };
    stem.utf8_chunks().map(part).collect()
}

/// A text in which nothing looks like a byte that is written as `%FF`, and nothing is a control character.
fn escaped(text: &str) -> String {
    let is_hex = |byte: Option<&u8>| byte.is_some_and(|byte| matches!(byte, b'0'..=b'9' | b'A'..=b'F'));
    let looks_like_one = |at: usize| is_hex(text.as_bytes().get(at + 1)) && is_hex(text.as_bytes().get(at + 2));
    text.char_indices().fold(String::new(), |text, (at, c)| match c {
        '%' if looks_like_one(at) => text + "%25",
        c if c.is_control() => {
            c.encode_utf8(&mut [0; 4]).bytes().fold(text, |text, byte| text + &format!("%{byte:02X}"))
        }
        c => text + c.encode_utf8(&mut [0; 4]),
    })
}

/// How many names a file has.
#[cfg(unix)]
pub fn names(path: &Path) -> u64 {
    use std::os::unix::fs::MetadataExt;
    fs::metadata(path).map_or(0, |there| there.nlink())
}

/// Nobody tells.
#[cfg(not(unix))]
pub fn names(_: &Path) -> u64 {
    1
}

/// The same for what was made, in the place of what was made before and is as it was made: all others stay, and so does what a run
/// has left.
pub fn remake(path: &Path, made: &Made) -> io::Result<()> {
    if is_of_a_run(path) {
        return Err(io::Error::new(ErrorKind::AlreadyExists, "it is a file of the run in this folder"));
    }
    spare(path)?;
    whole(path, made.text())
}

/// Says that a path cannot be written, and why.
pub fn not_written(path: &Path, error: &io::Error) -> String {
    let is_file = |path: &&Path| fs::metadata(path).is_ok_and(|there| !there.is_dir());
    let is_stray =
        |path: &&Path| path.is_symlink() && fs::metadata(path).is_err_and(|e| e.kind() == ErrorKind::NotFound);
    let is_folders = path.as_os_str().to_string_lossy().ends_with(std::path::is_separator) && !path.is_dir();
    let why = match error.kind() {
        // What we say of what is there already is said.
        ErrorKind::AlreadyExists if error.raw_os_error().is_none() => None,
        ErrorKind::AlreadyExists | ErrorKind::NotFound if path.ancestors().any(|path| is_stray(&path)) => {
            path.ancestors().find(is_stray).map(|link| format!("`{}` is a link that leads nowhere", link.display()))
        }
        ErrorKind::IsADirectory | ErrorKind::NotADirectory if is_folders => {
            Some("its name ends as a folder's does, and there is no such folder".to_string())
        }
        ErrorKind::AlreadyExists => {
            let what = if is_file(&path) { "file" } else { "folder" };
            path.exists().then(|| format!("there is a {what} of that name"))
        }
        ErrorKind::NotADirectory => {
            path.ancestors().find(is_file).map(|file| format!("`{}` is a file, and no folder", file.display()))
        }
        ErrorKind::NotFound => path
            .parent()
            .filter(|folder| !folder.as_os_str().is_empty() && !folder.exists())
            .map(|folder| format!("there is no folder `{}`", folder.display())),
        ErrorKind::IsADirectory => Some("it is a folder".to_string()),
        _ => None,
    };
    format!("`{}` cannot be written: {}", path.display(), why.unwrap_or_else(|| error.to_string()))
}

/// An error if a link is at a path, a file that somebody else wrote or edited, or what no file can take the place of.
pub fn spare(path: &Path) -> io::Result<()> {
    let refused = |why| Err(io::Error::new(ErrorKind::AlreadyExists, why));
    match fs::symlink_metadata(path) {
        Ok(there) if there.is_symlink() => refused("it is a link, which is left as it is"),
        Ok(there) if there.is_file() && !is_remakable(path, there.len()) => {
            refused("it is there already, and is not as Albacore made it")
        }
        _ => replaceable(path).map(drop),
    }
}

fn is_remakable(path: &Path, bytes: u64) -> bool {
    bytes == 0 || read(path, MADE_BYTES_MAX).is_ok_and(|there| is_as_made(&there))
}

/// The first bytes of a file, so many at most.
fn read(path: &Path, bytes_max: u64) -> io::Result<Vec<u8>> {
    let mut there = Vec::new();
    File::open(path)?.take(bytes_max).read_to_end(&mut there).map(|_| there)
}

/// A whole file, where nothing is yet.
pub fn keep(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let folder = folder_of(path);
    let _held = interruption::held();
    let part = filled(folder, bytes, None)?;
    part.persist_noclobber(path).map_err(|failed| failed.error)?;
    sync_folder(folder);
    Ok(())
}

/// The same, to be gone on with at its end: the file is locked before anybody else can open it.
pub fn replace(path: &Path, bytes: &[u8]) -> io::Result<File> {
    replace_if(path, bytes, || Ok(()))
}

/// The same, if nothing speaks against it when all is written but the name.
fn replace_if(path: &Path, bytes: &[u8], allow: impl FnOnce() -> io::Result<()>) -> io::Result<File> {
    let there = replaceable(path)?;
    let folder = folder_of(path);
    // Who interrupts finds whole files and no temporary ones.
    let _held = interruption::held();
    let part = filled(folder, bytes, there)?;
    // Nobody else knows it yet; where a disk knows no locks there are none.
    let _ = part.as_file().try_lock();
    allow()?;
    let file = part.persist(path).map_err(|failed| failed.error)?;
    sync_folder(folder);
    Ok(file)
}

/// A file that is not there yet, to be written bit by bit. Whatever has its name, be it a link, is an error.
pub fn new_file(path: &Path) -> io::Result<File> {
    let file = OpenOptions::new().append(true).create_new(true).open(path)?;
    sync_folder(folder_of(path));
    Ok(file)
}

/// A new file that is written anew in its place: it has kept the room for that, so that a disk that is full by then takes it, and
/// is the same file wherever its folder has gone.
pub struct Reserved {
    file: File,
    room: usize,
    /// What it holds where nobody else has written into it; `None` after a failure.
    held: Option<Vec<u8>>,
}

impl Reserved {
    /// A file that is not there yet, with room for more than its first text. Where there is none for both, there is no file.
    pub fn new(path: &Path, text: &str, more: usize) -> io::Result<Self> {
        let file = OpenOptions::new().read(true).write(true).create_new(true).open(path)?;
        let mut reserved = Reserved { file, room: text.len() + more, held: Some(Vec::new()) };
        if let Err(error) = reserved.write(text) {
            let _ = remove(path);
            return Err(error);
        }
        sync_folder(folder_of(path));
        Ok(reserved)
    }

    /// So many bytes a text may have.
    pub fn room(&self) -> usize {
        self.room
    }

    /// The file.
    pub fn file(&self) -> io::Result<File> {
        self.file.try_clone()
    }

    /// Whether a path leads to it.
    pub fn is_at(&self, path: &Path) -> bool {
        is_at(&self.file, path).unwrap_or(false)
    }

    /// Writes the last text, and gives back the room that it does not need.
    pub fn finish(&mut self, text: &str) -> io::Result<()> {
        self.write(text)?;
        self.file.set_len(text.len() as u64)?;
        self.held = Some(text.as_bytes().to_vec());
        self.file.sync_all()
    }

    /// A text over the one that was there, with blanks as far as the room goes: the file grows only once.
    pub fn write(&mut self, text: &str) -> io::Result<()> {
        let blanks = self.room.checked_sub(text.len()).ok_or(ErrorKind::FileTooLarge)?;
        let text = (text.to_string() + &" ".repeat(blanks)).into_bytes();
        if let Some(held) = self.held.take()
            && !self.holds(&held)?
        {
            self.held = Some(held);
            return Err(io::Error::other("another program has written into it, and that is left as it is"));
        }
        self.file.rewind()?;
        self.file.write_all(&text)?;
        self.held = Some(text);
        self.file.sync_all()
    }

    fn holds(&mut self, held: &[u8]) -> io::Result<bool> {
        let mut there = Vec::new();
        self.file.rewind()?;
        (&self.file).take(held.len() as u64 + 1).read_to_end(&mut there)?;
        Ok(there == held)
    }
}

/// Whether a path leads to this very file: what has its name may be another by now.
#[cfg(unix)]
pub fn is_at(file: &File, path: &Path) -> io::Result<bool> {
    use std::os::unix::fs::MetadataExt;
    let there = match fs::symlink_metadata(path) {
        Err(error) if matches!(error.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory) => return Ok(false),
        there => there?,
    };
    let ours = file.metadata()?;
    Ok((ours.dev(), ours.ino()) == (there.dev(), there.ino()))
}

/// Files have no numbers here, and one that is open keeps its name.
#[cfg(not(unix))]
pub fn is_at(_: &File, path: &Path) -> io::Result<bool> {
    fs::symlink_metadata(path).map(|there| there.is_file())
}

/// Makes an empty folder that was not there: of this name and the first number that is free.
pub fn new_folder(parent: &Path, name: &str) -> io::Result<PathBuf> {
    fs::create_dir_all(parent)?;
    for number in 1u64.. {
        let folder = parent.join(format!("{name}-{number}"));
        match fs::create_dir(&folder) {
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            made => return made.map(|()| folder),
        }
    }
    Err(ErrorKind::AlreadyExists.into())
}

/// A file that is there, to be read and gone on with.
pub fn old_file(path: &Path) -> io::Result<File> {
    OpenOptions::new().read(true).append(true).open(path)
}

/// The same for one to which there may be nothing to add: where it must not be written it is opened to be read, with the reason.
pub fn known_file(path: &Path) -> io::Result<(File, Option<io::Error>)> {
    match old_file(path) {
        Err(error) if is_forbidden(&error) => Ok((File::open(path)?, Some(error))),
        file => Ok((file?, None)),
    }
}

/// Whether it is not for want of room that something cannot be written, but for want of permission.
pub fn is_forbidden(error: &io::Error) -> bool {
    matches!(error.kind(), ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem)
}

/// Whether there is no room for what is to be written: on the disk, in what a user may have of it, or in a file.
pub fn is_full(error: &io::Error) -> bool {
    matches!(error.kind(), ErrorKind::StorageFull | ErrorKind::QuotaExceeded | ErrorKind::FileTooLarge)
}

/// Removes a file, or a link and not what it leads to. What is not there is removed already.
pub fn remove(path: &Path) -> io::Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// Removes a folder that is empty.
pub fn remove_empty(folder: &Path) -> io::Result<()> {
    fs::remove_dir(folder)
}

/// A folder in the making, beside the one that it becomes. It is gone when it does not become one.
pub struct PartFolder(TempDir, Held);

impl PartFolder {
    /// An empty one, on the same disk.
    pub fn beside(folder: &Path) -> io::Result<Self> {
        let held = interruption::held();
        let mut builder = Builder::new();
        builder.prefix(PREFIX).suffix(SUFFIX);
        readable(&mut builder, 0o777);
        builder.tempdir_in(folder_of(folder)).map(|part| PartFolder(part, held)).map_err(plain)
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        self.0.path()
    }

    /// Gives it its name.
    pub fn become_folder(self, folder: &Path) -> io::Result<()> {
        fs::rename(self.0.path(), folder)?;
        let _: PathBuf = self.0.keep();
        sync_folder(folder_of(folder));
        Ok(())
    }
}

/// What was made has fewer bytes.
const MADE_BYTES_MAX: u64 = 64 << 20;

const PREFIX: &str = ".albacore-";
const SUFFIX: &str = ".part";

/// A temporary file in a folder, created by us and by nobody else, gone unless it is kept.
fn part(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = Builder::new();
    builder.prefix(PREFIX).suffix(SUFFIX);
    readable(&mut builder, 0o666);
    builder.tempfile_in(folder).map_err(plain)
}

/// One that holds these bytes, with the owner and the permissions of what it replaces.
fn filled(folder: &Path, bytes: &[u8], there: Option<Metadata>) -> io::Result<NamedTempFile> {
    let part = part(folder)?;
    part.as_file().write_all(bytes)?;
    if let Some(there) = there {
        alike(part.as_file(), &there)?;
    }
    part.as_file().sync_all()?;
    Ok(part)
}

/// Who may read what is new is the user's mask to say; temporary files are private otherwise.
#[cfg(unix)]
fn readable(builder: &mut Builder, mode: u32) {
    use std::os::unix::fs::PermissionsExt;
    builder.permissions(Permissions::from_mode(mode));
}

#[cfg(not(unix))]
fn readable(_: &mut Builder, _: u32) {}

/// What is at a path, if it can be replaced by a file.
fn replaceable(path: &Path) -> io::Result<Option<Metadata>> {
    // `/dev/stdout` is a link to an ordinary file when the output goes to one.
    let is_stream = fs::read_link(path).is_ok_and(|target| target.starts_with("/proc"));
    match fs::metadata(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(error),
        Ok(there) if is_stream || !there.is_file() => {
            Err(io::Error::new(ErrorKind::InvalidInput, "it is no ordinary file"))
        }
        Ok(there) if there.permissions().readonly() => {
            Err(io::Error::new(ErrorKind::PermissionDenied, "it is read-only"))
        }
        Ok(there) => Ok(Some(there)),
    }
}

/// Gives a file the owner and the permissions of another. Only root can give files away.
fn alike(file: &File, there: &Metadata) -> io::Result<()> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::{MetadataExt, fchown};
        let _ = fchown(file, Some(there.uid()), Some(there.gid()));
    }
    let permissions: Permissions = there.permissions();
    file.set_permissions(permissions)
}

/// The folder that a path lies in.
fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// A name is safe from a power failure when its folder is. Not every system can do it; the file itself was written.
fn sync_folder(folder: &Path) {
    let _ = File::open(folder).and_then(|folder| folder.sync_all());
}

/// The system's own error, without the name of a temporary file.
fn plain(error: io::Error) -> io::Error {
    match error.to_string().split_once(" at path \"") {
        Some((said, _)) => io::Error::new(error.kind(), said),
        None => error,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[cfg(unix)]
    fn no_two_names_are_called_the_same() {
        use std::os::unix::ffi::OsStrExt;
        let names = [
            &b"bad\xff.alb"[..],
            b"bad\xfe.alb",
            b"bad%FF.alb",
            b"bad%25FF.alb",
            b"at 5%.alb",
            b"depth_\xc3\xa4.alb",
            b"a\n\x1b[31mb.alb",
        ];
        let stems: Vec<String> = names.iter().map(|name| stem(Path::new(std::ffi::OsStr::from_bytes(name)))).collect();
        assert_eq!(stems, ["bad%FF", "bad%FE", "bad%25FF", "bad%2525FF", "at 5%", "depth_\u{e4}", "a%0A%1B[31mb"]);
    }

    /// What somebody saved while a text was laid out is kept.
    #[test]
    fn what_was_changed_since_it_was_read_is_not_written_over() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("script");
        fs::write(&path, "saved").unwrap();
        for was in [Some("read"), None] {
            let error = rewrite(&path, was, "laid out").unwrap_err();
            assert!(error.to_string().contains("changed meanwhile"), "{error}");
        }
        assert_eq!(fs::read_to_string(&path).unwrap(), "saved");
        rewrite(&path, Some("saved"), "laid out").unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "laid out");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "nothing is left beside it");
    }

    /// What is written at the end takes no more of the disk than what was written at the start.
    #[test]
    fn a_file_with_room_grows_once() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("record");
        let mut file = Reserved::new(&path, "begun", 10).unwrap();
        assert_eq!((file.room(), fs::read_to_string(&path).unwrap().as_str()), (15, "begun          "));
        assert!(file.finish("it is longer than it").is_err());
        assert_eq!(fs::read_to_string(&path).unwrap().trim_end(), "begun");
        file.finish("ended at length").unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "ended at length");
        file.finish("ended").unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "ended");
        assert!(Reserved::new(&path, "another", 0).is_err());
    }
}
