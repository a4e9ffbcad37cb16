//! Positions: natural, on a small grid, at the ends of the range of numbers, any bits.

use crate::source::Source;

/// What single coordinates are replaced by.
const SPECIAL: [f64; 14] = [
    0.0,
    -0.0,
    1.0,
    1.0 + f64::EPSILON,
    1e-38,
    1e-45,
    5e-324,
    f64::MIN_POSITIVE,
    1e-200,
    1e150,
    -1e30,
    f32::MAX as f64,
    f64::MAX,
    -f64::MAX,
];

/// `count` rows of three numbers, finite in the scalar that they will have unless the input is hostile.
pub fn rows(source: &mut Source<'_>, natural: &[[f64; 3]], count: usize, double: bool) -> Vec<[f64; 3]> {
    let mut rows = natural.to_vec();
    rows.resize(count, [0.25, 0.5, -1.0]);
    let kind = source.below(9);
    let mut state = if kind > 0 { source.number::<u16>() as u64 } else { 0 } | 1 << 20;
    let mut random = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 33) as i32
    };
    // In [-1, 1).
    let mut signed = || random() as f64 / (1u64 << 30) as f64 - 1.0;
    match kind {
        0 => {}
        1 => each(&mut rows, |x| x + 0.1 * signed()),
        2 => each(&mut rows, |_| signed()),
        3 => each(&mut rows, |_| (3.0 * signed()).round()),
        4 => {
            let exponent = source.byte() as i8 as i32 * if double { 8 } else { 1 };
            each(&mut rows, |x| (x + 0.05 * signed()) * 2f64.powi(exponent));
        }
        5 => {
            let range = if double { 1000.0 } else { 126.0 };
            each(&mut rows, |_| signed() * 2f64.powi((range * signed()) as i32));
        }
        // Far from the origin.
        6 => each(&mut rows, |x| x + 0.05 * signed() + 1e6),
        // Slivers: nearly flat, or nearly along a line.
        7 => {
            let (y, z) = (2f64.powi(-(source.below(60) as i32)), 2f64.powi(-(source.below(60) as i32)));
            for row in &mut rows {
                let wobble = 1.0 + 0.1 * signed();
                *row = [row[0] * wobble, row[1] * y, row[2] * z];
            }
        }
        _ => {
            for x in rows.as_flattened_mut() {
                *x = if double { f64::from_bits(source.number()) } else { f32::from_bits(source.number()).into() };
            }
        }
    }
    let places = rows.as_flattened().len();
    if places > 0 && source.half() {
        for _ in 0..source.below(6) {
            let place = source.below(places);
            rows.as_flattened_mut()[place] = if source.spoils() {
                source.pick(&[f64::NAN, f64::INFINITY, f64::NEG_INFINITY])
            } else {
                source.pick(&SPECIAL)
            };
        }
    }
    if !source.is_hostile() {
        let most = if double { f64::MAX } else { f32::MAX.into() };
        each(&mut rows, |x| if x.is_nan() { 1.0 } else { x.clamp(-most, most) });
    }
    rows
}

fn each(rows: &mut [[f64; 3]], mut value: impl FnMut(f64) -> f64) {
    rows.as_flattened_mut().iter_mut().for_each(|x| *x = value(*x));
}
