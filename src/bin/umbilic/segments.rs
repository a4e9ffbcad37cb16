//! Calls of the library that cut a mesh into segments, and what is known of each of them.

use crate::compute::{self, VertexCurvatures, with_progress};
use crate::mesh::PolygonMesh;
use crate::quantity::Quantity;
use umbilic::{
    Creases, CurvatureOptions, Error, Faces, NO_SEGMENT, Points, RegionOptions, ScalarField, Segmentation,
    ShapeClass, curvedness_depth, feature_segmentation, fill_unknown, has_curvature, region_growing,
    region_tolerance, watershed,
};

/// How a mesh is cut; what is `None` goes with the size of the mesh.
pub enum Way<'a> {
    /// Along edges sharper than an angle, in radians.
    Features { angle: f64 },
    /// Into basins of curvedness, of at least a depth in 1/length.
    Watershed { depth: Option<f64>, curvature: CurvatureOptions<'a> },
    /// Into regions of one shape class, with curvatures of up to a tolerance in 1/length being none.
    Regions { tolerance: Option<f64>, options: RegionOptions<'a>, curvature: CurvatureOptions<'a> },
}

/// A mesh in segments.
pub struct Segments {
    /// The label of each face: its place in `each`, or [`NO_SEGMENT`].
    pub labels: Vec<u32>,
    /// The number of edges between segments.
    pub boundary_edges: usize,
    /// All segments.
    pub each: Vec<Segment>,
    /// The depth or tolerance that was taken.
    pub limit: Option<f64>,
}

/// What is known of a segment.
pub struct Segment {
    /// The number of its faces.
    pub faces: usize,
    /// Its area.
    pub area: f64,
    /// The means of the quantities in [`MEANS`] by area, over what is not at its border, where curvatures were computed.
    pub means: Option<[f64; MEANS.len()]>,
    /// The class of most corners of its faces that are not at its border, where there are classes.
    pub shape: Option<ShapeClass>,
}

impl Segments {
    /// The part that each segment has of the whole area; 0 where there is none.
    pub fn shares(&self) -> Vec<f64> {
        let areas = self.each.iter().map(|segment| segment.area);
        let largest = areas.clone().fold(0.0, f64::max);
        // In parts of the largest, since the sum may leave the range.
        let whole: f64 = areas.clone().map(|area| area / largest).sum();
        areas.map(|area| if largest > 0.0 { area / largest / whole } else { 0.0 }).collect()
    }
}

/// The quantities of which segments have means.
pub const MEANS: [Quantity; 3] = [Quantity::K1, Quantity::K2, Quantity::Curvedness];

/// The curvatures that a way of cutting goes by.
pub fn curvatures(mesh: &PolygonMesh, way: &Way<'_>, threads: usize) -> Result<Option<VertexCurvatures>, Error> {
    match way {
        Way::Features { .. } => Ok(None),
        Way::Watershed { curvature, .. } | Way::Regions { curvature, .. } => {
            let topology = compute::topology(mesh)?;
            compute::vertex_curvatures(mesh, &topology, curvature, threads).map(Some)
        }
    }
}

/// Cuts a mesh, with the curvatures for it.
pub fn segment(
    mesh: &PolygonMesh,
    way: &Way<'_>,
    curvatures: Option<&VertexCurvatures>,
    threads: usize,
) -> Result<Segments, Error> {
    let (faces, points) = (Faces::polygons(&mesh.indices, &mesh.offsets)?, Points::from(&mesh.positions));
    // No way asks for curvatures that its method lacks.
    let quantity = |quantity| curvatures.and_then(|found| found.quantity(quantity)).unwrap_or_default();
    let (found, limit, classes) = match way {
        Way::Features { angle } => {
            let creases = Creases { angle: *angle, ..Creases::default() };
            let found = with_progress(mesh, 1, threads, |run| feature_segmentation(&faces, &points, &creases, run))?;
            (found, None, None)
        }
        Way::Watershed { depth, curvature } => {
            let depth = match depth {
                Some(depth) => *depth,
                None => curvedness_depth(&points)?,
            };
            let mut curvedness = quantity(Quantity::Curvedness).to_vec();
            if let Some(found) = curvatures {
                fill_unknown(&compute::topology(mesh)?, curvature.method, &found.status, &mut curvedness);
            }
            let height = ScalarField::Vertices((&curvedness).into());
            let found = with_progress(mesh, 1, threads, |run| watershed(&faces, points.len(), &height, depth, run))?;
            (found, Some(depth), None)
        }
        Way::Regions { tolerance, options, curvature } => {
            let tolerance = match tolerance {
                Some(tolerance) => *tolerance,
                None => region_tolerance(&points)?,
            };
            let mut classes = Vec::new();
            if let Some(found) = curvatures {
                classes = compute::shape_classes(mesh, found, tolerance)?;
                for (class, &status) in classes.iter_mut().zip(&found.status) {
                    if !has_curvature(curvature.method, status) {
                        *class = ShapeClass::Undefined as u8;
                    }
                }
            }
            let known = (&classes).into();
            let found = with_progress(mesh, 1, threads, |run| region_growing(&faces, &points, &known, options, run))?;
            (found, Some(tolerance), Some(classes))
        }
    };
    let inside = inside(mesh, &found);
    let means = match curvatures {
        None => None,
        Some(_) => {
            let mean = |of| means(mesh, &found, &inside, quantity(of));
            Some([mean(MEANS[0])?, mean(MEANS[1])?, mean(MEANS[2])?])
        }
    };
    let shapes = classes.map(|classes| shapes(mesh, &found, &inside, &classes));
    let mut counts = vec![0; found.count()];
    for &label in found.labels().iter().filter(|&&label| label != NO_SEGMENT) {
        counts[label as usize] += 1;
    }
    let areas = found.areas(&faces, &points)?;
    let each = (0..found.count()).map(|label| Segment {
        faces: counts[label],
        area: areas[label],
        means: means.as_ref().map(|means| means.each_ref().map(|values| values[label])),
        shape: shapes.as_ref().map(|shapes| shapes[label]),
    });
    Ok(Segments {
        each: each.collect(),
        boundary_edges: found.boundary_edges().len(),
        labels: found.labels().to_vec(),
        limit,
    })
}

/// Which vertices are not between segments. Those that are tell nothing of either, since creases are there, or mixtures of both
/// sides: they count only where a segment has no others.
fn inside(mesh: &PolygonMesh, found: &Segmentation) -> Vec<bool> {
    let mut inside = vec![true; mesh.vertex_count()];
    for &vertex in found.boundary_edges().as_flattened() {
        inside[vertex as usize] = false;
    }
    inside
}

/// The mean of a scalar at vertices over each segment, by area.
fn means(mesh: &PolygonMesh, found: &Segmentation, inside: &[bool], values: &[f64]) -> Result<Vec<f64>, Error> {
    let (faces, points) = (Faces::polygons(&mesh.indices, &mesh.offsets)?, Points::from(&mesh.positions));
    // What the corners inside have of each face, and of its mean.
    let part = |value: &dyn Fn(usize) -> f64| -> Vec<f64> {
        let of_face = |face: &[u32]| {
            let corners = face.iter().map(|&vertex| vertex as usize).filter(|&vertex| inside[vertex]);
            let sum: f64 = corners.map(|vertex| value(vertex) / face.len() as f64).sum();
            // Thirds of the largest number are rounded up.
            sum.clamp(-f64::MAX, f64::MAX)
        };
        mesh.faces().map(of_face).collect()
    };
    let mean = |of_faces: Vec<f64>| found.means(&faces, &points, &ScalarField::Faces(of_faces.as_slice().into()));
    let [parts, sums] = [mean(part(&|_| 1.0))?, mean(part(&|vertex| values[vertex]))?];
    let all = found.means(&faces, &points, &ScalarField::Vertices(values.into()))?;
    let ratio = |((part, sum), all)| if part > 0.0 { f64::clamp(sum / part, -f64::MAX, f64::MAX) } else { all };
    Ok(parts.into_iter().zip(sums).zip(all).map(ratio).collect())
}

/// The class that most corners of each segment have, of several the one with the smallest number.
fn shapes(mesh: &PolygonMesh, found: &Segmentation, inside: &[bool], classes: &[u8]) -> Vec<ShapeClass> {
    let mut counts = vec![[[0_usize; ShapeClass::ALL.len()]; 2]; found.count()];
    for (face, &label) in mesh.faces().zip(found.labels()).filter(|&(_, &label)| label != NO_SEGMENT) {
        for vertex in face.iter().map(|&vertex| vertex as usize) {
            counts[label as usize][usize::from(inside[vertex])][classes[vertex] as usize] += 1;
        }
    }
    let most = |[border, inside]: &[[usize; ShapeClass::ALL.len()]; 2]| {
        let counts = if inside.iter().any(|&count| count > 0) { inside } else { border };
        let largest = counts.iter().copied().max().unwrap_or(0);
        let place = counts.iter().position(|&count| count == largest);
        place.map_or(ShapeClass::Undefined, |place| ShapeClass::ALL[place])
    };
    counts.iter().map(most).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate;
    use umbilic::{Run, regions_of_shape, watershed_of_curvedness};

    #[test]
    fn shares_add_up() {
        for areas in [[1.0, 3.0], [f64::MAX, f64::MAX], [1e-320, 0.0]] {
            let each = areas.map(|area| Segment { faces: 1, area, means: None, shape: None }).into();
            let segments = Segments { labels: vec![0, 1], boundary_edges: 0, each, limit: None };
            assert_eq!(segments.shares().iter().sum::<f64>(), 1.0);
        }
        let nothing = Segment { faces: 1, area: 0.0, means: None, shape: None };
        let segments = Segments { labels: vec![0], boundary_edges: 0, each: vec![nothing], limit: None };
        assert_eq!(segments.shares(), [0.0]);
    }

    #[test]
    fn what_is_at_the_border_does_not_count() {
        // A strip of four squares, which is folded in the middle.
        let positions = (0..10).map(|vertex| {
            let [x, y] = [vertex / 2, vertex % 2].map(f64::from);
            if x > 2.0 { [2.0, y, x - 2.0] } else { [x, y, 0.0] }
        });
        let faces = [0, 2, 4, 6].map(|first| [first, first + 2, first + 3, first + 1]);
        let mesh = PolygonMesh::from_uniform_faces(positions.collect(), &faces);
        let way = Way::Features { angle: 1.0 };
        let found = segment(&mesh, &way, None, 1).unwrap();
        assert_eq!((found.labels.as_slice(), found.boundary_edges), (&[0, 0, 1, 1][..], 1));
        let faces = Faces::polygons(&mesh.indices, &mesh.offsets).unwrap();
        let (points, creases) = (Points::from(&mesh.positions), Creases { angle: 1.0, ..Creases::default() });
        let found = feature_segmentation(&faces, &points, &creases, Run::default()).unwrap();
        let inside = inside(&mesh, &found);
        let values = [1.0, 1.0, 4.0, 4.0, 1e9, 1e9, 5.0, 5.0, 5.0, 5.0];
        let close = means(&mesh, &found, &inside, &values).unwrap().into_iter().zip([3.0, 5.0]);
        assert!(close.clone().all(|(mean, exact)| (mean - exact).abs() < 1e-12), "{close:?}");
        let classes = [4, 4, 1, 1, 2, 2, 7, 7, 7, 7];
        assert_eq!(shapes(&mesh, &found, &inside, &classes), [ShapeClass::Peak, ShapeClass::Valley]);
        // Where everything is at a border, all of it counts.
        assert_eq!(means(&mesh, &found, &[false; 10], &[2.0; 10]).unwrap(), [2.0; 2]);
    }

    #[test]
    fn segments_are_those_of_the_library() {
        for mesh in [generate::bumpy(6), generate::torus(12), generate::cube()] {
            let faces = Faces::polygons(&mesh.indices, &mesh.offsets).unwrap();
            let (points, curvature) = (Points::from(&mesh.positions), CurvatureOptions::default());
            let by = |way: Way<'_>| {
                let found = curvatures(&mesh, &way, 1).unwrap();
                segment(&mesh, &way, found.as_ref(), 1).unwrap()
            };
            for depth in [None, Some(0.1)] {
                let expected = watershed_of_curvedness(&faces, &points, depth, &curvature, Run::default()).unwrap();
                let found = by(Way::Watershed { depth, curvature: CurvatureOptions::default() });
                assert_eq!(found.labels, expected.labels());
                assert_eq!(found.boundary_edges, expected.boundary_edges().len());
            }
            for tolerance in [None, Some(0.5)] {
                let options = RegionOptions::default();
                let expected =
                    regions_of_shape(&faces, &points, tolerance, &curvature, &options, Run::default()).unwrap();
                let found = by(Way::Regions { tolerance, options, curvature: CurvatureOptions::default() });
                assert_eq!(found.labels, expected.labels());
                assert_eq!(found.each.iter().map(|segment| segment.faces).sum::<usize>(), mesh.face_count());
            }
        }
    }
}
