//! Numbers on a mesh, and what faces make of them.

use crate::error::{Error, reserved};
use crate::parallel::fill;
use crate::topology::has_three_corners;
use crate::view::{Faces, Index, Scalars, with_indices, zeroed};

/// A scalar for each vertex, or for each face.
#[derive(Clone, Copy, Debug)]
pub enum ScalarField<'a> {
    /// `#V`; a face has the mean of its corners.
    Vertices(Scalars<'a>),
    /// `#F`; those of ignored faces count for nothing.
    Faces(Scalars<'a>),
}

/// Faces of more corners are rare, and take turns at a buffer.
const FEW_CORNERS: usize = 8;

impl ScalarField<'_> {
    /// # Errors
    /// [`Error::Size`] or [`Error::NonFiniteScalar`].
    pub(super) fn check(&self, what: &'static str, faces: &Faces<'_>, vertex_count: usize) -> Result<(), Error> {
        match self {
            ScalarField::Vertices(scalars) => scalars.check(what, vertex_count),
            ScalarField::Faces(scalars) => scalars.check(what, faces.len()),
        }
    }

    /// The number of each face; 0 for ignored faces. Indices are in range, and counts have been checked.
    pub(super) fn of_faces(&self, faces: &Faces<'_>, threads: usize) -> Result<Vec<f64>, Error> {
        with_indices!(faces.indices(), indices => match self {
            ScalarField::Vertices(scalars) => means_of_corners(faces, indices, scalars, threads),
            ScalarField::Faces(scalars) => {
                let mut values = zeroed(faces.len())?;
                fill(threads, &mut values, |face| match has_three_corners(&indices[faces.range(face)]) {
                    // Zeros of either sign are equal.
                    true => scalars.get(face) + 0.0,
                    false => 0.0,
                });
                Ok(values)
            }
        })
    }
}

fn means_of_corners<I: Index>(
    faces: &Faces<'_>,
    indices: &[I],
    scalars: &Scalars<'_>,
    threads: usize,
) -> Result<Vec<f64>, Error> {
    let mut values = zeroed(faces.len())?;
    fill(threads, &mut values, |face| {
        let corners = &indices[faces.range(face)];
        if corners.len() > FEW_CORNERS || !has_three_corners(corners) {
            return 0.0;
        }
        let mut few = [0.0; FEW_CORNERS];
        for (value, vertex) in few.iter_mut().zip(corners) {
            *value = scalars.get(vertex.widen() as usize);
        }
        mean(&mut few[..corners.len()])
    });
    let most = (0..faces.len()).map(|face| faces.range(face).len()).max().unwrap_or(0);
    if most > FEW_CORNERS {
        let mut many = reserved(most)?;
        for (face, value) in values.iter_mut().enumerate() {
            let corners = &indices[faces.range(face)];
            if corners.len() > FEW_CORNERS && has_three_corners(corners) {
                many.clear();
                many.extend(corners.iter().map(|vertex| scalars.get(vertex.widen() as usize)));
                *value = mean(&mut many);
            }
        }
    }
    Ok(values)
}

/// The mean. That of equal numbers is that number, and their order does not matter: faces of equal height must remain so.
fn mean(values: &mut [f64]) -> f64 {
    let count = values.len() as f64;
    values.sort_unstable_by(f64::total_cmp);
    let Some(&least) = values.first() else { return 0.0 };
    let above: f64 = values.iter().map(|value| value / count - least / count).sum();
    (least + above).clamp(-f64::MAX, f64::MAX) + 0.0
}

#[cfg(test)]
mod tests {
    use super::mean;

    #[test]
    fn means_keep_plateaus() {
        for count in 3..20 {
            for value in [0.1, -7.3, 1e300, 1e-300, f64::MAX, -f64::MAX] {
                assert_eq!(mean(&mut vec![value; count]), value);
            }
        }
        let corners = [0.1, 0.7, 0.3, 0.9];
        let turned = (0..4).map(|turn| mean(&mut [0, 1, 2, 3].map(|place| corners[(place + turn) % 4])));
        assert!(
            turned
                .clone()
                .all(|value| value == 0.5 || (value - 0.5).abs() < 1e-15 && value == turned.clone().next().unwrap())
        );
        assert!(mean(&mut [-f64::MAX, f64::MAX, f64::MAX]).is_finite());
    }
}
