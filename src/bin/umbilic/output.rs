//! Puts output files in place only when they are complete.
//!
//! A file is written under a temporary name next to its destination and then renamed, so a full disk or an
//! interruption leaves no half-written file under the name asked for, and an old file stays until the new one is
//! done. Devices and pipes, which cannot be replaced, are written to directly.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::{error, fmt};

/// Why a file could not be written; displays as `FILE: what`.
#[derive(Debug)]
pub struct WriteError {
    /// The file as it was named.
    path: PathBuf,
    /// What went wrong.
    message: String,
}

impl WriteError {
    /// An error about a file.
    pub fn new(path: &Path, message: impl fmt::Display) -> Self {
        Self { path: path.to_owned(), message: message.to_string() }
    }
}

impl fmt::Display for WriteError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}: {}", self.path.display(), self.message)
    }
}

impl error::Error for WriteError {}

/// Writes the file at `path` with `write`, which gets a buffered writer.
pub fn write_file(path: &Path, write: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>) -> Result<(), WriteError> {
    // Following links replaces what they point to instead of the link.
    let destination = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    let special = fs::metadata(&destination).is_ok_and(|metadata| !metadata.is_file());
    let result = if special {
        write_and_flush(&destination, write)
    } else {
        let mut temporary = destination.clone().into_os_string();
        temporary.push(format!(".{}.part", std::process::id()));
        let temporary = PathBuf::from(temporary);
        write_and_flush(&temporary, write).and_then(|()| fs::rename(&temporary, &destination)).inspect_err(|_| {
            // The first error is the one worth reporting.
            let _ = fs::remove_file(&temporary);
        })
    };
    result.map_err(|error| WriteError::new(path, error))
}

/// Writes a file and makes sure that the last buffer has got there.
fn write_and_flush(path: &Path, write: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>) -> io::Result<()> {
    let mut writer = BufWriter::new(File::create(path)?);
    write(&mut writer)?;
    writer.flush()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failure_keeps_the_old_file_and_leaves_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        write_file(&path, |writer| writer.write_all(b"old")).unwrap();
        let error = write_file(&path, |writer| {
            writer.write_all(b"new")?;
            Err(io::Error::other("no space"))
        })
        .unwrap_err();
        assert!(error.to_string().ends_with("a.txt: no space"), "{error}");
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_missing_folder_is_an_error() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("none").join("a.txt");
        assert!(write_file(&path, |_| Ok(())).is_err());
    }
}
