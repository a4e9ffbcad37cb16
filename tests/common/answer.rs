//! What the oracle of curvatures answers, and tensors in space.

use super::linear::{eigenvalues, tangents, times};
use super::{Vector, add, dot, scale};

pub type Tensor = [Vector; 3];

/// What a method answers; what it does not have is zero.
#[derive(Clone, Copy, Debug, Default)]
pub struct Answer {
    pub k: [f64; 2],
    pub mean: f64,
    pub gaussian: f64,
    pub mean_normal: Vector,
    /// `k1 d1 d1ᵀ + k2 d2 d2ᵀ`
    pub tensor: Tensor,
    pub area: f64,
    pub integrated_mean: f64,
    pub integrated_gaussian: f64,
    pub residual: f64,
    /// Whether a sign is that of a number that rounding decides.
    pub ambiguous: bool,
    /// The square of the length by the width of the narrowest face, where a system of its own was solved for each.
    pub narrow: f64,
}

/// `a bᵀ factor`
pub fn outer(a: Vector, b: Vector, factor: f64) -> Tensor {
    std::array::from_fn(|i| std::array::from_fn(|j| a[i] * b[j] * factor))
}

pub fn plus(a: Tensor, b: Tensor) -> Tensor {
    std::array::from_fn(|i| add(a[i], b[i]))
}

impl Answer {
    /// From the shape operator `(a b; b d)` in two tangents.
    pub fn of_operator(normal: Vector, [x, y]: [Vector; 2], [a, b, d]: [f64; 3]) -> Answer {
        let k = eigenvalues([a, b, d]);
        let mean = (a + d) / 2.0;
        let mixed = plus(outer(x, y, b), outer(y, x, b));
        Answer {
            k,
            mean,
            gaussian: k[0] * k[1],
            mean_normal: scale(normal, mean),
            tensor: plus(plus(outer(x, x, a), outer(y, y, d)), mixed),
            ..Answer::default()
        }
    }

    /// From a tensor in space, of which the part in the tangent plane counts.
    pub fn of_tensor(normal: Vector, tensor: Tensor) -> Answer {
        let [x, y] = tangents(normal);
        let entry = |a: Vector, b: Vector| (dot(a, times(&tensor, b)) + dot(b, times(&tensor, a))) / 2.0;
        Answer::of_operator(normal, [x, y], [entry(x, x), entry(x, y), entry(y, y)])
    }

    pub fn of_mean_and_gaussian(normal: Vector, mean: f64, gaussian: f64) -> Answer {
        let radius = (mean * mean - gaussian).max(0.0).sqrt();
        let mean_normal = scale(normal, mean);
        Answer { k: [mean + radius, mean - radius], mean, gaussian, mean_normal, ..Answer::default() }
    }
}
