//! The file readers of the command line: OBJ, OFF, PLY, STL, files without extension, and the points of polylines.
#![no_main]

// The program's own modules, of which nothing but the readers is used here.
#[allow(dead_code)]
#[path = "../../src/bin/umbilic/mesh.rs"]
mod mesh;
#[allow(dead_code)]
#[path = "../../src/bin/umbilic/progress.rs"]
mod progress;
#[allow(dead_code)]
#[path = "../../src/bin/umbilic/read/mod.rs"]
mod read;

use libfuzzer_sys::fuzz_target;
use mesh::PolygonMesh;
use read::PolylineFile;
use std::alloc::{GlobalAlloc, Layout, System};
use std::fs::File;
use std::os::unix::fs::FileExt;
use std::path::PathBuf;
use std::sync::LazyLock;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// The system's allocator, with the largest sum of what was held at once.
struct Counting;

static HELD: AtomicUsize = AtomicUsize::new(0);
static PEAK: AtomicUsize = AtomicUsize::new(0);

// SAFETY: everything is handed on.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let held = HELD.fetch_add(layout.size(), Relaxed) + layout.size();
        PEAK.fetch_max(held, Relaxed);
        // SAFETY: handed on.
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, place: *mut u8, layout: Layout) {
        HELD.fetch_sub(layout.size(), Relaxed);
        // SAFETY: handed on.
        unsafe { System.dealloc(place, layout) };
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Bytes that a reader may hold for each byte of its file, and however short that is.
const MOST_MEMORY: (usize, usize) = (400, 1 << 18);

/// A file of each name, in memory where the system has such a folder.
struct Files {
    files: Vec<(PathBuf, File)>,
}

const NAMES: [&str; 8] =
    ["mesh.obj", "mesh.off", "mesh.ply", "mesh.stl", "mesh", "points.txt", "mesh.PLY", "mesh.CNOFF"];

static FILES: LazyLock<Files> = LazyLock::new(|| {
    let memory = PathBuf::from("/dev/shm");
    let folder = if memory.is_dir() { memory } else { std::env::temp_dir() };
    let folder = folder.join(format!("umbilic-fuzz-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder for files");
    let open = |name: &str| {
        let path = folder.join(name);
        let file = File::create(&path).expect("a file to write");
        (path, file)
    };
    Files { files: NAMES.iter().map(|name| open(name)).collect() }
});

fuzz_target!(|data: &[u8]| {
    // The first byte names the kind of file.
    let Some((&kind, bytes)) = data.split_first() else { return };
    let kind = kind as usize % NAMES.len();
    let (path, file) = &FILES.files[kind];
    file.set_len(0).expect("an empty file");
    file.write_all_at(bytes, 0).expect("a written file");
    let before = HELD.load(Relaxed);
    PEAK.store(before, Relaxed);
    if NAMES[kind] == "points.txt" {
        match read::read_polyline(path) {
            Ok(PolylineFile::Plane(points)) => check_points(points.as_flattened()),
            Ok(PolylineFile::Space(points)) => check_points(points.as_flattened()),
            Err(error) => check_message(&error.to_string()),
        }
    } else {
        match read::read_mesh(path) {
            Ok(mesh) => check_mesh(&mesh),
            Err(error) => check_message(&error.to_string()),
        }
    }
    let most = PEAK.load(Relaxed) - before;
    let allowed = MOST_MEMORY.0 * bytes.len() + MOST_MEMORY.1;
    assert!(most <= allowed, "{most} bytes of memory for a file of {} bytes", bytes.len());
});

fn check_points(coordinates: &[f64]) {
    assert!(!coordinates.is_empty() && coordinates.iter().all(|x| x.is_finite()));
}

/// What every reader promises.
fn check_mesh(mesh: &PolygonMesh) {
    assert!(!mesh.positions.is_empty());
    assert_eq!(mesh.offsets.first(), Some(&0));
    assert!(mesh.offsets.is_sorted());
    assert_eq!(mesh.offsets.last().map(|&end| end as usize), Some(mesh.indices.len()));
    assert!(mesh.indices.iter().all(|&index| (index as usize) < mesh.positions.len()));
}

/// Messages are short and cannot play tricks on a terminal.
fn check_message(message: &str) {
    assert!(message.len() < 1000, "a message of {} bytes", message.len());
    assert!(!message.chars().any(char::is_control), "{message:?}");
}
