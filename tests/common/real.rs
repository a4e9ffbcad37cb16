//! Real meshes, where there are any: OFF files in the folder that the environment variable `UMBILIC_MESHES` names, as
//! `make test` sets it. Without it the tests run on generated meshes alone.

use super::mesh::Mesh;
use std::path::Path;

/// The meshes of the folder, in order of their names; nothing if the variable is not set.
pub fn meshes() -> Vec<Mesh> {
    let Some(folder) = std::env::var_os("UMBILIC_MESHES") else { return vec![] };
    let list = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/peers/meshes.txt")).unwrap();
    let names = list.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'));
    let meshes: Vec<Mesh> =
        names.filter(|name| name.ends_with(".off")).map(|name| read(&Path::new(&folder).join(name))).collect();
    assert!(meshes.len() >= 10, "{} meshes in {}", meshes.len(), Path::new(&folder).display());
    meshes
}

fn read(path: &Path) -> Mesh {
    let text = std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let words = text.lines().flat_map(|line| line.split('#').next().unwrap_or("").split_whitespace());
    let mut words = words.skip_while(|word| word.ends_with("OFF"));
    let mut number = || words.next().unwrap().parse::<f64>().unwrap();
    let (vertices, faces, _) = (number() as usize, number() as usize, number());
    let positions = (0..vertices).map(|_| [number(), number(), number()]).collect();
    let faces = (0..faces).map(|_| (0..number() as usize).map(|_| number() as u32).collect()).collect();
    Mesh::new(&path.file_name().unwrap().to_string_lossy(), positions, faces)
}
