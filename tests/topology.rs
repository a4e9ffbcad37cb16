//! One-rings, counts and defects.
// Every call keeps the contract that the header states; where a test breaks it on purpose, that is the test.
#![allow(clippy::undocumented_unsafe_blocks)]

mod common;
use common::capi::Handle;
use common::mesh::{self, Mesh, letter_prism, ring_sphere, soup, torus};
use common::oracle::cleaned;
use std::collections::{HashMap, HashSet};
use umbilic::capi::*;
use umbilic::{Faces, Level, Topology};

fn fans(handle: &Handle, vertex: usize) -> Vec<(Vec<u32>, usize, bool)> {
    let (mut count, error) = (0, std::ptr::null_mut());
    assert_eq!(unsafe { umb_topology_fan_count(handle.0, vertex, &mut count, error) }, UMB_OK);
    (0..count)
        .map(|index| {
            let mut fan: umb_fan = common::capi::zeroed();
            assert_eq!(unsafe { umb_topology_fan(handle.0, vertex, index, &mut fan, error) }, UMB_OK);
            let neighbours = unsafe { std::slice::from_raw_parts(fan.neighbours, fan.neighbour_count) };
            (neighbours.to_vec(), fan.corner_count, fan.closed == 1)
        })
        .collect()
}

fn flags(handle: &Handle) -> Vec<u8> {
    unsafe {
        let count = umb_topology_vertex_count(handle.0);
        std::slice::from_raw_parts(umb_topology_flags(handle.0), count).to_vec()
    }
}

#[test]
fn a_closed_mesh() {
    let mesh = ring_sphere(8, 5);
    let handle = Handle::new(&mesh);
    let stats = handle.stats();
    assert_eq!((stats.vertex_count, stats.face_count, stats.edge_count), (42, 80, 120));
    assert_eq!(stats.euler_characteristic, 2);
    assert_eq!((stats.component_count, stats.boundary_loops, stats.max_valence), (1, 0, 8));
    assert!(flags(&handle).iter().all(|flags| *flags == 0));
    // The ring of the north pole, counter-clockwise from its first face on.
    assert_eq!(fans(&handle, 0), [(vec![1, 2, 3, 4, 5, 6, 7, 8], 8, true)]);
    assert_eq!(Handle::new(&torus(12, 7, 0.1, 0.5, 1)).stats().euler_characteristic, 0);
    assert_eq!(Handle::new(&letter_prism()).stats().euler_characteristic, 2);
}

#[test]
fn an_open_mesh_with_two_loops() {
    // A square ring of four quads.
    let positions = vec![[0.0; 3]; 8];
    let faces = vec![vec![0, 1, 5, 4], vec![1, 2, 6, 5], vec![2, 3, 7, 6], vec![3, 0, 4, 7]];
    let handle = Handle::new(&Mesh::new("frame", positions, faces));
    let stats = handle.stats();
    assert_eq!((stats.boundary_loops, stats.boundary_edges, stats.boundary_vertices), (2, 8, 8));
    assert_eq!((stats.edge_count, stats.euler_characteristic, stats.component_count), (12, 0, 1));
    assert_eq!(fans(&handle, 0), [(vec![1, 4, 3], 2, false)]);
}

#[test]
fn two_fans_at_a_vertex() {
    // Two tetrahedra that share a vertex; and two triangles that do.
    let tetrahedron = |a: u32, b, c, d| vec![vec![a, b, c], vec![a, c, d], vec![a, d, b], vec![b, d, c]];
    let faces = [tetrahedron(0, 1, 2, 3), tetrahedron(0, 4, 5, 6)].concat();
    let handle = Handle::new(&Mesh::new("hourglass", vec![[0.0; 3]; 7], faces));
    assert_eq!(fans(&handle, 0), [(vec![1, 2, 3], 3, true), (vec![4, 5, 6], 3, true)]);
    let stats = handle.stats();
    assert_eq!((stats.non_manifold_vertices, stats.non_manifold_edges, stats.boundary_edges), (1, 0, 0));
    assert_eq!(flags(&handle)[0], UMB_VERTEX_NON_MANIFOLD);
    let handle = Handle::new(&Mesh::new("bow tie", vec![[0.0; 3]; 5], vec![vec![0, 1, 2], vec![0, 3, 4]]));
    assert_eq!(fans(&handle, 0), [(vec![1, 2], 1, false), (vec![3, 4], 1, false)]);
    assert_eq!(flags(&handle)[0], UMB_VERTEX_NON_MANIFOLD | UMB_VERTEX_BOUNDARY);
    // Fans are sheets of their own, so the boundary runs around each triangle.
    assert_eq!(handle.stats().boundary_loops, 2);
}

#[test]
fn an_edge_with_three_faces() {
    let faces = vec![vec![0, 1, 2], vec![1, 0, 3], vec![0, 1, 4]];
    let handle = Handle::new(&Mesh::new("book", vec![[0.0; 3]; 5], faces));
    let stats = handle.stats();
    assert_eq!((stats.non_manifold_edges, stats.boundary_edges, stats.edge_count), (1, 6, 7));
    // The boundary of every page ends at the back of the book.
    assert_eq!(stats.boundary_loops, 0);
    assert_eq!(fans(&handle, 0).len(), 3);
    assert_eq!(flags(&handle)[0], UMB_VERTEX_NON_MANIFOLD | UMB_VERTEX_BOUNDARY);
    let mut valence = 0;
    assert_eq!(unsafe { umb_topology_valence(handle.0, 0, &mut valence, std::ptr::null_mut()) }, UMB_OK);
    assert_eq!(valence, 4);
}

#[test]
fn inconsistent_winding() {
    let handle = Handle::new(&Mesh::new("flipped", vec![[0.0; 3]; 4], vec![vec![0, 1, 2], vec![0, 3, 2]]));
    let stats = handle.stats();
    assert_eq!((stats.winding_edges, stats.boundary_edges, stats.non_manifold_edges), (1, 4, 0));
    let both = UMB_VERTEX_WINDING | UMB_VERTEX_NON_MANIFOLD | UMB_VERTEX_BOUNDARY;
    assert_eq!(flags(&handle), [both, UMB_VERTEX_BOUNDARY, both, UMB_VERTEX_BOUNDARY]);
}

#[test]
fn duplicate_degenerate_and_short_faces() {
    let faces = vec![vec![0, 1, 2], vec![1, 2, 0], vec![2, 1, 3], vec![0, 0, 3], vec![1, 2, 1]];
    let stats = Handle::new(&Mesh::new("triangles", vec![[0.0; 3]; 5], faces)).stats();
    assert_eq!((stats.duplicate_faces, stats.degenerate_faces, stats.ignored_faces), (1, 2, 2));
    assert_eq!((stats.isolated_vertices, stats.corner_count, stats.face_count), (1, 9, 5));
    let faces = vec![
        vec![0, 1, 2, 3],
        vec![2, 3, 0, 1],
        vec![0, 1, 2, 4],
        vec![0, 1, 1, 4],
        vec![0, 4],
        vec![],
        vec![3, 3, 3, 3],
    ];
    let stats = Handle::new(&Mesh::new("polygons", vec![[0.0; 3]; 5], faces)).stats();
    assert_eq!((stats.duplicate_faces, stats.degenerate_faces, stats.ignored_faces), (1, 4, 3));
    // The same face twice counts once as a duplicate, three times twice.
    let faces = vec![vec![5, 1, 2]; 3];
    assert_eq!(Handle::new(&Mesh::new("thrice", vec![[0.0; 3]; 6], faces)).stats().duplicate_faces, 2);
    // A vertex twice in a face does not confuse the count, wherever the face starts.
    for second in [vec![0, 1, 2, 0, 3, 4], vec![0, 3, 4, 0, 1, 2], vec![3, 4, 0, 1, 2, 0]] {
        let faces = vec![vec![0, 1, 2, 0, 3, 4], second];
        assert_eq!(Handle::new(&Mesh::new("pinched", vec![[0.0; 3]; 5], faces)).stats().duplicate_faces, 1);
    }
}

/// Counts by hashing, from the faces.
#[test]
fn counts_of_soups_are_those_of_a_naive_count() {
    for seed in 0..150 {
        for mesh in [soup(14, 24, 3, seed), soup(14, 16, 6, seed)] {
            let stats = Handle::new(&mesh).stats();
            let faces: Vec<Vec<u32>> = mesh.faces().map(cleaned).collect();
            let mut directed: HashMap<(u32, u32), usize> = HashMap::new();
            for face in &faces {
                for i in 0..face.len() {
                    *directed.entry((face[i], face[(i + 1) % face.len()])).or_default() += 1;
                }
            }
            let edges: HashSet<(u32, u32)> = directed.keys().map(|&(a, b)| (a.min(b), a.max(b))).collect();
            let of = |a, b| directed.get(&(a, b)).copied().unwrap_or(0);
            let count = |kind: &dyn Fn(usize, usize) -> bool| {
                edges.iter().filter(|(a, b)| kind(of(*a, *b), of(*b, *a))).count() as u64
            };
            assert_eq!(stats.edge_count, edges.len() as u64);
            assert_eq!(stats.boundary_edges, count(&|out, into| out + into == 1));
            assert_eq!(stats.winding_edges, count(&|out, into| out + into == 2 && out != into));
            assert_eq!(stats.non_manifold_edges, count(&|out, into| out + into > 2));
            assert_eq!(stats.corner_count, faces.iter().map(|face| face.len() as u64).sum::<u64>());
            assert_eq!(stats.ignored_faces, faces.iter().filter(|face| face.is_empty()).count() as u64);
            let used: HashSet<u32> = faces.iter().flatten().copied().collect();
            assert_eq!(stats.isolated_vertices, stats.vertex_count - used.len() as u64);
            let mut kept: Vec<Vec<u32>> = faces
                .iter()
                .filter(|face| !face.is_empty())
                .map(|face| (0..face.len()).map(|i| [&face[i..], &face[..i]].concat()).min().unwrap())
                .collect();
            let total = kept.len();
            kept.sort();
            kept.dedup();
            assert_eq!(stats.duplicate_faces, (total - kept.len()) as u64, "seed {seed}");
            assert_eq!(stats.euler_characteristic, used.len() as i64 - edges.len() as i64 + total as i64);
            let mut component: HashMap<u32, u32> = used.iter().map(|&v| (v, v)).collect();
            for _ in 0..used.len() {
                for (a, b) in &edges {
                    let low = component[a].min(component[b]);
                    component.insert(*a, low);
                    component.insert(*b, low);
                }
            }
            assert_eq!(stats.component_count, component.values().collect::<HashSet<_>>().len() as u64);
        }
    }
}

#[test]
fn index_types_and_arities_give_the_same_topology() {
    let mesh = torus(20, 11, 0.2, 1.0, 3);
    assert!(mesh.faces().all(|face| face.len() == 4));
    let base = Handle::new(&mesh);
    let signed: Vec<i32> = mesh.indices.iter().map(|&i| i as i32).collect();
    let long: Vec<u64> = mesh.indices.iter().map(|&i| i as u64).collect();
    let (signed_offsets, long_offsets): (Vec<i32>, Vec<u64>) =
        mesh.offsets.iter().map(|&o| (o as i32, o as u64)).unzip();
    let count = mesh.indices.len();
    let quads = |indices: *const std::ffi::c_void, index| umb_faces {
        indices,
        index_count: count,
        offsets: std::ptr::null(),
        face_count: 0,
        index,
        arity: 4,
    };
    let polygons =
        |indices, offsets, index| umb_faces { offsets, face_count: 220, arity: 0, ..quads(indices, index) };
    let (u32s, i32s, u64s) = (mesh.indices.as_ptr().cast(), signed.as_ptr().cast(), long.as_ptr().cast());
    for faces in [
        quads(u32s, UMB_INDEX_U32),
        quads(i32s, UMB_INDEX_I32),
        quads(u64s, UMB_INDEX_U64),
        polygons(i32s, signed_offsets.as_ptr().cast(), UMB_INDEX_I32),
        polygons(u64s, long_offsets.as_ptr().cast(), UMB_INDEX_U64),
    ] {
        let handle = Handle::of(&faces, mesh.positions.len());
        for vertex in 0..mesh.positions.len() {
            assert_eq!(fans(&handle, vertex), fans(&base, vertex));
        }
        assert_eq!(handle.stats().face_count, 220);
    }
}

#[test]
fn memory_of_a_triangle_mesh() {
    let stats = Handle::new(&mesh::torus(200, 100, 0.2, 0.0, 1)).stats();
    assert!(stats.bytes <= 24 * stats.face_count, "{} bytes, {} faces", stats.bytes, stats.face_count);
}

/// Meshes on which anything quadratic would take minutes.
#[test]
fn hostile_meshes_take_linear_time() {
    // Many fans at one vertex.
    let count = 200_000u32;
    let faces = (0..count).map(|i| vec![0, 2 * i + 1, 2 * i + 2]).collect();
    let positions = (0..=2 * count).map(|i| [i as f64 % 7.0, i as f64 % 5.0, (i > 0) as u32 as f64]).collect();
    let hub = Mesh::new("hub", positions, faces);
    // One polygon of many corners, twice; and with every corner at one of two vertices.
    let corners: Vec<u32> = (0..count).collect();
    let positions: Vec<[f64; 3]> = (0..count).map(|i| [(i as f64).cos(), (i as f64).sin(), 0.0]).collect();
    let twice = Mesh::new("large polygon twice", positions.clone(), vec![corners.clone(), corners]);
    let alternating = (0..count).map(|i| i % 2 * (1 + i % 3)).collect();
    let pinched = Mesh::new("pinched polygon", positions, vec![alternating]);
    // The same triangle many times.
    let repeated = Mesh::new("one triangle", vec![[0.0; 3]; 3], vec![vec![0, 1, 2]; count as usize]);
    for (mesh, duplicates) in [(&hub, 0), (&twice, 1), (&pinched, 0), (&repeated, count as u64 - 1)] {
        let handle = Handle::new(mesh);
        assert_eq!(handle.stats().duplicate_faces, duplicates, "{}", mesh.name);
        let found = common::capi::normals(&handle, &mesh.positions, UMB_WEIGHT_CONFORMAL, false, |_| ());
        assert!(found.normal.iter().flatten().all(|x| x.is_finite()));
        let list = [0u32; 1000];
        common::capi::normals(&handle, &mesh.positions, UMB_WEIGHT_AREA, false, |run| {
            (run.vertices, run.vertex_count) = (list.as_ptr(), 3);
        });
    }
    assert_eq!(fans(&Handle::new(&hub), 0).len(), count as usize);
}

/// Several windows of vertices, hubs of many corners, borders, soups and isolated vertices in one mesh.
fn everything(sides: usize, seed: u64) -> Mesh {
    let base = torus(130, 70, 0.3, if sides == 3 { 0.0 } else { 0.6 }, seed);
    let mut faces: Vec<Vec<u32>> = base.faces().map(<[u32]>::to_vec).collect();
    let count = base.positions.len() as u32;
    let mut state = seed * 2 + 1;
    let mut below = |limit: u32| {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        ((state >> 33) % limit as u64) as u32
    };
    // Holes.
    faces.retain(|_| below(40) > 0);
    // Closed fans of 6 to 40 corners around new vertices, a strip of them beyond the torus.
    let mut next = count + 5;
    for corners in 6..=40 {
        let hub = next;
        next += corners + 1;
        faces.extend((0..corners).map(|i| vec![hub, hub + 1 + i, hub + 1 + (i + 1) % corners]));
    }
    // Faces at random, many of them at a few vertices.
    for _ in 0..500 {
        let face: Vec<u32> = (0..sides).map(|_| if below(2) == 0 { below(next) } else { below(9) * 611 }).collect();
        faces.insert(below(faces.len() as u32) as usize, face);
    }
    Mesh::new("everything", vec![[0.0; 3]; next as usize + 3], faces)
}

#[test]
fn threads_and_vectors_build_the_same() {
    for (sides, seed) in [(3, 1), (3, 2), (3, 3), (6, 4), (5, 5)] {
        let mesh = everything(sides, seed);
        let faces = Faces::polygons(&mesh.indices, &mesh.offsets).unwrap();
        let all = |threads, level| Topology::with_threads(&faces, mesh.positions.len(), threads, level).unwrap();
        let base = all(1, Level::PORTABLE);
        assert!(base.vertex_count() > 4 * 2048);
        for threads in [1, 2, 3, 5, 8] {
            for level in Level::all() {
                let built = all(threads, level);
                assert_eq!(built.ring_offsets(), base.ring_offsets());
                assert!(built.ring_neighbours() == base.ring_neighbours() && built.flags() == base.flags());
                let stats = |topology: &Topology| topology.stats().unwrap();
                assert_eq!(stats(&built), stats(&base), "{threads} threads, {}", level.name());
                for vertex in 0..mesh.positions.len() {
                    assert!(built.fans(vertex).eq(base.fans(vertex)), "vertex {vertex}, {threads} threads");
                }
            }
        }
        // Each corner once, where its vertex has it.
        let mut corners: Vec<HashSet<(u32, u32)>> = vec![HashSet::new(); mesh.positions.len()];
        let mut counts = vec![0; mesh.positions.len()];
        for face in mesh.faces().map(cleaned) {
            for i in 0..face.len() {
                let at = |offset: usize| face[(i + offset) % face.len()];
                corners[at(0) as usize].insert((at(1), at(face.len() - 1)));
                counts[at(0) as usize] += 1;
            }
        }
        let mut closed = 0;
        for vertex in 0..mesh.positions.len() {
            let mut found = 0;
            for fan in base.fans(vertex) {
                let around = fan.neighbours.iter().chain(fan.neighbours.first().filter(|_| fan.closed));
                let around: Vec<u32> = around.copied().collect();
                assert_eq!(around.len(), fan.corner_count + 1);
                assert!(around.windows(2).all(|pair| corners[vertex].contains(&(pair[0], pair[1]))));
                found += fan.corner_count;
                closed += (fan.closed && fan.corner_count > 8) as usize;
            }
            assert_eq!(found, counts[vertex], "vertex {vertex}");
        }
        assert!(closed > 30, "{closed}");
    }
}

#[test]
fn an_index_out_of_range_is_the_first_on_any_number_of_threads() {
    let mut mesh = everything(3, 6);
    let count = mesh.positions.len();
    (mesh.indices[20_000], mesh.indices[40_001]) = (count as u32, u32::MAX);
    let faces = Faces::triangles(&mesh.indices[..]).unwrap();
    for threads in 1..=8 {
        let error = Topology::with_threads(&faces, count, threads, Level::best()).unwrap_err();
        let expected = umbilic::Error::IndexOutOfRange {
            what: "faces.indices",
            position: 20_000,
            index: count as i128,
            vertex_count: count as u64,
        };
        assert_eq!(error, expected);
    }
}

/// Blocks of sixteen vertices: a hub of forty triangles that share no edge, and fifteen centres of closed fans. Borders are
/// many, so that no room is left over.
#[test]
fn rings_beside_hubs_and_many_borders() {
    for corners in [5, 8, 9, 16, 17] {
        for blocks in 1..24 {
            for polygons in [false, true] {
                let (mut faces, mut rims) = (vec![], 0);
                let first = blocks * (80 + 15 * corners);
                for block in 0..blocks {
                    let hub = first + 16 * block;
                    for _ in 0..40 {
                        faces.push(vec![hub, rims, rims + 1]);
                        rims += 2;
                    }
                    for centre in hub + 1..hub + 16 {
                        faces.extend((0..corners).map(|i| vec![centre, rims + i, rims + (i + 1) % corners]));
                        rims += corners;
                    }
                }
                assert_eq!(rims, first);
                if polygons {
                    faces.push(vec![0, 2, 4, 6]);
                }
                let mesh = Mesh::new("hubs", vec![[0.0; 3]; (first + 16 * blocks) as usize], faces);
                let stats = Handle::new(&mesh).stats();
                assert_eq!(stats.max_valence, 80);
                let handle = Handle::new(&mesh);
                for vertex in first..first + 16 * blocks {
                    let fans = fans(&handle, vertex as usize);
                    let hub = (vertex - first) % 16 == 0;
                    assert_eq!(fans.len(), if hub { 40 } else { 1 });
                    assert!(hub || fans[0].1 == corners as usize && fans[0].2);
                }
            }
        }
    }
}

#[test]
fn wide_indices_are_not_cut_short() {
    let mesh = everything(5, 9);
    let count = mesh.positions.len();
    let offsets: Vec<u64> = mesh.offsets.iter().map(|&offset| offset as u64).collect();
    for beyond in [1u64 << 32, (1 << 32) + 1, u64::MAX, (1 << 63) + 2] {
        let mut triangles: Vec<u64> = (0..3000u64).map(|i| i % 1000).collect();
        triangles[1234] = beyond;
        let found = Topology::new(&Faces::triangles(&triangles[..]).unwrap(), 1000).unwrap_err();
        let expected = |position, vertex_count| umbilic::Error::IndexOutOfRange {
            what: "faces.indices",
            position,
            index: beyond as i128,
            vertex_count,
        };
        assert_eq!(found, expected(1234, 1000));
        let mut indices: Vec<u64> = mesh.indices.iter().map(|&index| index as u64).collect();
        indices[777] = beyond;
        let found = Topology::new(&Faces::polygons(&indices[..], &offsets[..]).unwrap(), count).unwrap_err();
        assert_eq!(found, expected(777, count as u64));
    }
}
