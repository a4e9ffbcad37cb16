//! The curvature of the section along every edge of every ring.
//!
//! See [`section`](super::section) for the formulas. Results lie parallel to the topology's flat ring array: those of a
//! vertex stand where its neighbours stand, fan after fan. Input: any ring of triangles or polygons. Boundary: no rule
//! needed. Degenerate rule: an edge without length, along the normal, or at a vertex without normal has no section: 0, and
//! its status says so. Cost: a division and a cross product an edge.

use super::ring::own_normals;
use super::section::{EdgeCurvature, edge};
use super::vertex::{NORMAL_SHARE, VertexNormals, unit_normals};
use super::{Section, section_status};
use crate::error::Error;
use crate::parallel::Run;
use crate::simd::{Vector, Vector3};
use crate::sweep::{FaceNeeds, Quantity, Ring, RingFaces, Scratch, VertexFans, sweep};
use crate::topology::Topology;
use crate::view::{Output, Points, ScalarOutput, StatusOutput};

/// Where the results of [`edge_sections`] and [`direction_sections`](super::direction_sections) go; all are optional.
#[derive(Debug, Default)]
pub struct SectionOutputs<'a> {
    /// Curvature of each section, 1/length; positive where the surface bends away from the normal.
    pub curvature: Option<ScalarOutput<'a>>,
    /// [`section_status`] bits of each section.
    pub status: Option<StatusOutput<'a>>,
    /// The unit vertex normals that were used, `#V × 3`.
    pub normal: Option<Output<'a>>,
}

impl SectionOutputs<'_> {
    pub(super) fn check(&self, sections: usize, vertices: usize) -> Result<(), Error> {
        let check = |what: &'static str, found: Option<usize>, expected: usize| match found {
            Some(found) if found != expected => {
                Err(Error::Size { what, found: found as u64, expected: expected as u64 })
            }
            _ => Ok(()),
        };
        check("outputs.curvature", self.curvature.as_ref().map(Output::len), sections)?;
        check("outputs.status", self.status.as_ref().map(StatusOutput::len), sections)?;
        check("outputs.normal", self.normal.as_ref().map(Output::len), vertices)
    }

    #[inline(always)]
    pub(super) fn write(&self, index: usize, curvature: f64, status: u8) {
        if let Some(output) = &self.curvature {
            output.write(index, [curvature]);
        }
        if let Some(output) = &self.status {
            output.write(index, status);
        }
    }

    pub(super) fn write_normals(&self, normals: &[[f64; 3]], vertices: Option<&[u32]>) {
        let Some(output) = &self.normal else { return };
        match vertices {
            Some(list) => list.iter().for_each(|&vertex| output.write(vertex as usize, normals[vertex as usize])),
            None => normals.iter().enumerate().for_each(|(vertex, &normal)| output.write(vertex, normal)),
        }
    }
}

/// Computes the sectional curvature along each edge of the rings of all vertices, or of those in [`Run::vertices`].
/// `curvature` and `status` have an element for each entry of [`Topology::ring_neighbours`].
///
/// # Errors
/// [`Error::Size`] where counts do not fit; [`Error::NonFinitePosition`]; [`Error::NonFiniteNormal`];
/// [`Error::IndexOutOfRange`]; [`Error::Cancelled`]; [`Error::OutOfMemory`].
pub fn edge_sections(
    topology: &Topology,
    points: &Points<'_>,
    section: Section,
    normals: VertexNormals<'_>,
    mut run: Run<'_>,
    outputs: &SectionOutputs<'_>,
) -> Result<(), Error> {
    outputs.check(topology.rings().entry_count(), topology.vertex_count())?;
    let normals = unit_normals(topology, points, normals, &mut run)?;
    let quantity = EdgeSections { topology, normals: &normals, section, outputs };
    run.part(NORMAL_SHARE, 1.0, |mut run| sweep(topology, points, &mut run, true, &quantity))?;
    outputs.write_normals(&normals, run.vertices);
    Ok(())
}

struct EdgeSections<'a> {
    topology: &'a Topology,
    normals: &'a [[f64; 3]],
    section: Section,
    outputs: &'a SectionOutputs<'a>,
}

impl Quantity for EdgeSections<'_> {
    const FACES: FaceNeeds = FaceNeeds::Unused;
    const SINGLE: bool = false;

    #[inline(always)]
    fn block<V: Vector, F: RingFaces<V>>(
        &self,
        vertices: &[u32],
        ring: &Ring<'_, V, F>,
        scale: V,
        _scratch: &mut Scratch<'_, V>,
    ) -> u32 {
        let normal: Vector3<V> = own_normals(self.normals, vertices);
        // Without a normal there is no section.
        let there = V::select(V::zero().lt(normal.squared()), V::one(), V::zero());
        for index in 0..ring.edge_count() {
            let EdgeCurvature { curvature, weight } =
                edge(ring.edges[index], ring.squared[index], normal, self.section);
            let curvatures = (curvature * scale).to_lanes();
            let weights = (weight * there).to_lanes();
            for (lane, &vertex) in vertices.iter().enumerate() {
                let entry = self.topology.rings().ring_range(vertex as usize).start + index;
                self.write(entry, curvatures[lane].into(), weights[lane].into());
            }
        }
        ring.overflowed() & ((1u32 << vertices.len()) - 1)
    }

    fn alone<F: RingFaces<f64>>(
        &self,
        vertex: usize,
        fans: &VertexFans<'_, F>,
        scale: f64,
        _scratch: &mut Scratch<'_, f64>,
    ) {
        let normal = own_normals::<f64>(self.normals, &[vertex as u32]);
        let there = if normal.squared() > 0.0 { 1.0 } else { 0.0 };
        let mut entry = self.topology.rings().ring_range(vertex).start;
        for ring in fans.rings() {
            for index in 0..ring.edge_count() {
                let EdgeCurvature { curvature, weight } =
                    edge(ring.edges[index], ring.squared[index], normal, self.section);
                self.write(entry, curvature * scale, weight * there);
                entry += 1;
            }
        }
    }

    fn isolated(&self, _vertex: usize) {}
}

impl EdgeSections<'_> {
    #[inline(always)]
    fn write(&self, entry: usize, curvature: f64, weight: f64) {
        if weight > 0.0 {
            self.outputs.write(entry, curvature, 0);
        } else {
            self.outputs.write(entry, 0.0, section_status::NONE);
        }
    }
}
