//! What the tests share: meshes, an oracle, and the C interface in a test's words.
#![allow(dead_code)]

pub mod adaptive;
pub mod adaptive_oracle;
pub mod answer;
pub mod bodies;
pub mod calls;
pub mod capi;
pub mod curvature;
pub mod curvature_oracle;
pub mod householder;
pub mod learning_oracle;
pub mod linear;
pub mod mesh;
pub mod oracle;
pub mod outputs;
pub mod random;
pub mod real;
pub mod segment_oracle;
pub mod solids;

pub use random::Random;

pub type Vector = [f64; 3];

pub fn sub(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}
pub fn add(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}
pub fn scale(a: Vector, s: f64) -> Vector {
    a.map(|x| x * s)
}
pub fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
pub fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
pub fn length(a: Vector) -> f64 {
    dot(a, a).sqrt()
}
pub fn unit(a: Vector) -> Vector {
    scale(a, 1.0 / length(a))
}
pub fn largest_difference(a: Vector, b: Vector) -> f64 {
    sub(a, b).iter().fold(0.0, |largest: f64, x| largest.max(x.abs()))
}
