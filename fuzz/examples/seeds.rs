//! Writes what fuzzing starts from: `seeds FOLDER` fills `FOLDER/TARGET` for each target.
//!
//! The targets that call the library make a choice of every byte, tame or hostile by the first one, so that any bytes are a
//! sensible call; seeds name each kind of mesh once and leave the rest to chance. The readers get small files of every format,
//! whole and broken.

use std::fs;
use std::path::Path;

/// Kinds of meshes that `Shape::new` knows.
const SHAPES: u8 = 12;

/// A small generator, so that every run writes the same seeds.
struct Random(u64);

impl Random {
    fn bytes(&mut self, count: usize) -> Vec<u8> {
        let mut next = || {
            self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (self.0 >> 40) as u8
        };
        (0..count).map(|_| next()).collect()
    }
}

fn main() -> std::io::Result<()> {
    let folder = std::env::args().nth(1).expect("the folder to write to");
    let folder = Path::new(&folder);
    let mut random = Random(1);
    // Where the kind of mesh stands, and how many bytes before it have so many values.
    for (target, before) in
        [("topology", 1), ("normals", 2), ("curvature", 1), ("segmentation", 1), ("differential", 2), ("polyline", 1)]
    {
        let mut seeds = vec![vec![]];
        for hostile in [0, 1] {
            for shape in 0..SHAPES {
                for length in [6, 30, 80, 160, 300] {
                    let mut seed = random.bytes(before);
                    seed[0] = hostile;
                    seed.push(shape);
                    seed.extend(random.bytes(length));
                    seeds.push(seed);
                }
            }
        }
        write(&folder.join(target), &seeds)?;
    }
    write(&folder.join("readers"), &files())
}

fn write(folder: &Path, seeds: &[Vec<u8>]) -> std::io::Result<()> {
    fs::create_dir_all(folder)?;
    for (index, seed) in seeds.iter().enumerate() {
        fs::write(folder.join(format!("seed-{index:03}")), seed)?;
    }
    Ok(())
}

/// In the order of the names in the target.
const OBJ: u8 = 0;
const OFF: u8 = 1;
const PLY: u8 = 2;
const STL: u8 = 3;
const BARE: u8 = 4;
const POINTS: u8 = 5;

/// Files behind the byte that names their kind; each also cut short, and text with a byte changed.
fn files() -> Vec<Vec<u8>> {
    let texts = [
        (OBJ, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
        (
            OBJ,
            "mtllib a.mtl\r\no part # one\r\nv 0 0 0 0.5\r\nv 1e3 -.5 2 1 0 0\r\nvn 0 0 1\r\nf -1/1/1 \\\r\n -2//2 1/3 2\r\n",
        ),
        (OBJ, "f 1 2 3 4\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv nan inf -inf\nl 1 2\n"),
        (OFF, "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n3 0 1 2\n"),
        (
            OFF,
            "CNOFF 3 1 0 # colours\n0 0 0.25 0 0 1 255 0 0 255\n1 0 0 0 0 1 0.5 0.5 0.5\n0 1 0 0 0 1 1 1 1 1\n3 0 1 2 0.1\n",
        ),
        (OFF, "OFF4 99999999999 0\n0 0 0\n1 0 0\n"),
        (
            PLY,
            "ply\nformat ascii 1.0\ncomment by hand\nelement vertex 3\nproperty float x\nproperty double y\nproperty short z\n\
             element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0.5 0\n0 1 0\n3 0 1 2\n",
        ),
        (
            PLY,
            "ply\nformat ascii 1.0\nelement vertex 4294967296\nproperty float x\nproperty float y\nproperty float z\n\
             element edge 1\nproperty list uint float weights\nelement face 1\nproperty list uint uint vertex_index\n\
             end_header\n0 0 0\n4000000000 1\n",
        ),
        (
            STL,
            "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n",
        ),
        (
            STL,
            "Solid\r\n Facet normal nan 0 1\r\nOUTER LOOP\nvertex 1e39 -0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n",
        ),
        (BARE, "# nothing but a comment\nCOFF\n1 0 0\n0 0 0\n"),
        (POINTS, "# a triangle\n0 0\n\n1,0 # right\r\n\t.5 , 1e0\n"),
        (POINTS, "1 2 3\n4 5 6\n7, 8, 9\n"),
    ];
    let mut files: Vec<Vec<u8>> = texts.iter().map(|(kind, text)| [&[*kind], text.as_bytes()].concat()).collect();
    for little in [false, true] {
        files.push([&[PLY], &binary_ply(little)[..]].concat());
    }
    for count in [1u32, 2, u32::MAX] {
        let mut file = vec![STL];
        file.resize(81, b' ');
        file.extend(count.to_le_bytes());
        for coordinate in [0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, f32::NAN] {
            file.extend(f32::to_le_bytes(coordinate));
        }
        file.extend([0; 2]);
        files.push(file);
    }
    let mut random = Random(2);
    for file in files.clone() {
        let draw = random.bytes(3);
        files.push(file[..1 + draw[0] as usize % (file.len() - 1)].to_vec());
        let mut broken = file;
        let place = 1 + draw[1] as usize % (broken.len() - 1);
        broken[place] = draw[2];
        files.push(broken);
    }
    files
}

fn binary_ply(little: bool) -> Vec<u8> {
    let order = if little { "little" } else { "big" };
    let mut file = format!(
        "ply\nformat binary_{order}_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
         element face 1\nproperty list uchar uint vertex_indices\nend_header\n"
    )
    .into_bytes();
    let mut push = |bytes: [u8; 4]| {
        file.extend(if little { bytes } else { [bytes[3], bytes[2], bytes[1], bytes[0]] });
    };
    for coordinate in [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0] {
        push(f32::to_le_bytes(coordinate));
    }
    file.push(3);
    for corner in 0..3u32 {
        let bytes = corner.to_le_bytes();
        file.extend(if little { bytes } else { [bytes[3], bytes[2], bytes[1], bytes[0]] });
    }
    file
}
