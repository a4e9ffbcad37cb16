//! What an adaptive jet knows of a mesh before it looks at a vertex: how noisy its positions are, and how smooth its surface.

use crate::error::Error;

/// The coordinates in which an adaptive jet writes the surface near a vertex.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Coordinates {
    /// Heights over the tangent plane.
    #[default]
    Height,
    /// Heights over the distance from the vertex, in the direction of its projection to the tangent plane: the paper's circles,
    /// in which a sphere is exactly quadratic.
    Circle,
}

/// The numbers that [`learn_model`](crate::learn_model) learns from a mesh, and with which adaptive jets are then fitted.
///
/// Each call learns its own if it is given none, which takes all positions of the mesh. Given the same model, a list of vertices,
/// a part of a mesh that is cut up, or a later frame of one that moves is fitted alike, and a list of vertices costs little more
/// than they do.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AdaptiveModel {
    /// The median over the vertices of the mean length of a vertex's edges; the unit of what follows.
    pub edge_length: f64,
    /// The standard deviation of the positions along the normal, in the mesh's unit of length: what is not the surface. At
    /// least 1e-8 edge lengths.
    pub noise: f64,
    /// The root mean square size of the surface's Taylor coefficients of degrees 2, 3 and 4, and of what lies beyond these,
    /// for lengths in units of `edge_length`.
    pub sizes: [f64; 4],
    /// The noise of a vertex is `noise` times its own mean edge length, in units of `edge_length`, to this power: 0 to 2.
    pub noise_exponent: u8,
    /// Whether sizes are understood in units of the vertex's own mean edge length (1) or of `edge_length` (0).
    pub size_exponent: u8,
    /// The coordinates that describe the sample better.
    pub coordinates: Coordinates,
    /// The mean logarithm of the evidence of a sample vertex for [`Coordinates::Height`] and for [`Coordinates::Circle`], each with
    /// its own best numbers; larger is better. 0 where it was not looked at. Nothing is computed from these.
    pub evidence: [f64; 2],
    /// How many vertices it was learned from; 0 if it was not learned.
    pub sample: u32,
}

/// The least noise, in units of the edge length: a thousandth of what single precision leaves of a coordinate of that size.
pub(super) const LEAST_NOISE: f64 = 1e-8;

/// The fewest and the most rings that a fit asks for by itself.
const LEAST_AUTOMATIC_RINGS: usize = 3;
pub(super) const MOST_AUTOMATIC_RINGS: usize = 6;

/// Points count to this many times the distance where what the polynomial leaves out is as large as the noise: there their weight has
/// fallen to a hundredth.
const REACH: f64 = 1.6;

impl AdaptiveModel {
    /// How many rings of neighbours a fit takes if it is not told: as far as they have any weight, 3 to 6.
    pub fn rings(&self) -> usize {
        let ratio = self.noise / self.edge_length / self.sizes[3];
        let most = MOST_AUTOMATIC_RINGS;
        (LEAST_AUTOMATIC_RINGS..most).find(|&rings| ratio * REACH.powi(5) <= (rings as f64).powi(5)).unwrap_or(most)
    }

    /// What is used of a mesh without any edge, where nothing can be learned.
    pub(super) const UNKNOWN: AdaptiveModel = AdaptiveModel {
        edge_length: 1.0,
        noise: LEAST_NOISE,
        sizes: [1e3, 0.3, 0.1, 0.03],
        noise_exponent: 0,
        size_exponent: 0,
        coordinates: Coordinates::Circle,
        evidence: [0.0; 2],
        sample: 0,
    };

    /// Refuses numbers that describe no mesh.
    ///
    /// # Errors
    /// [`Error::OptionOutOfRange`]
    pub(crate) fn check(&self) -> Result<(), Error> {
        let positive = |x: f64| x > 0.0 && x < f64::INFINITY;
        for (what, good) in [
            ("model.edge_length", positive(self.edge_length)),
            ("model.noise", positive(self.noise) && positive(self.noise / self.edge_length)),
            ("model.sizes", self.sizes.into_iter().all(positive)),
            ("model.noise_exponent", self.noise_exponent <= 2),
            ("model.size_exponent", self.size_exponent <= 1),
        ] {
            if !good {
                return Err(Error::OptionOutOfRange { what });
            }
        }
        Ok(())
    }

    /// The noise at a vertex whose edges have that mean length, in the mesh's unit.
    pub(crate) fn noise_at(&self, edge_length: f64) -> f64 {
        let mut noise = self.noise;
        for _ in 0..self.noise_exponent {
            noise *= edge_length / self.edge_length;
        }
        noise.clamp(f64::MIN_POSITIVE, f64::MAX)
    }
}
