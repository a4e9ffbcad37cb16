//! What calls ask for besides arrays: weights and models.

use crate::source::Source;
use crate::structs::{Struct, zeroed};
use umbilic::capi::*;

/// A weight; sums over one ring more often than the dear ones.
pub fn weight(source: &mut Source<'_>) -> umb_weight {
    if source.spoils() {
        return source.any_u32();
    }
    match source.byte() {
        byte @ 0..220 => byte as u32 % 10,
        220..236 => UMB_WEIGHT_TILTED_SECTIONS,
        byte if !source.may_be_slow(8) => byte as u32 % 10,
        236..250 => UMB_WEIGHT_JET,
        byte if !source.may_be_slow(32) => byte as u32 % 10,
        _ => UMB_WEIGHT_ADAPTIVE_JET,
    }
}

/// What of jets is small: a degree, a number of rings.
pub fn small(source: &mut Source<'_>, most: usize) -> u32 {
    if source.spoils() { source.any_u32() } else { source.below(most + 1) as u32 }
}

/// A model of the caller's, any numbers above zero; none half of the time.
pub fn model(source: &mut Source<'_>) -> Struct<umb_adaptive_model> {
    if source.half() {
        return Struct::null();
    }
    let mut model: umb_adaptive_model = zeroed();
    model.coordinates = source.below(2) as u32;
    model.edge_length = positive(source);
    model.noise = positive(source);
    model.sizes = [(); 4].map(|()| positive(source));
    model.noise_exponent = source.below(3) as u32;
    model.size_exponent = source.below(2) as u32;
    model.evidence = [source.number(), source.number()];
    model.sample = source.number();
    if source.spoils() {
        match source.below(6) {
            0 => model.coordinates = source.any_u32(),
            1 => model.edge_length = f64::from_bits(source.number()),
            2 => model.noise = f64::from_bits(source.number()),
            3 => model.sizes[0] = f64::from_bits(source.number()),
            4 => (model.noise_exponent, model.size_exponent) = (source.any_u32(), source.any_u32()),
            _ => model.reserved = source.any_u32(),
        }
    }
    Struct::new(source, &mut model, false)
}

/// Mostly near 1, sometimes a power of two so large or small that the ratio of two is still a number.
fn positive(source: &mut Source<'_>) -> f64 {
    let byte = source.byte();
    if byte < 240 { 2f64.powi(byte as i32 % 24 - 16) } else { 2f64.powi(source.number::<i16>() as i32 % 500) }
}
