//! Shape classes and their tolerance.

use super::{placed, pointer, receiver};
use umbilic::capi::*;
use umbilic_fuzz::parts::{located, scalars};
use umbilic_fuzz::{Bytes, List, Outcome, Run, Scene, Source, Struct, Watch, zeroed};

const ALLOWED: [umb_status; 10] = [
    UMB_ERROR_NULL_POINTER,
    UMB_ERROR_UNKNOWN_FIELD,
    UMB_ERROR_UNKNOWN_CONSTANT,
    UMB_ERROR_STRIDE,
    UMB_ERROR_MISALIGNED,
    UMB_ERROR_SIZE,
    UMB_ERROR_NON_FINITE,
    UMB_ERROR_STRUCT_SIZE,
    UMB_ERROR_OPTION_OUT_OF_RANGE,
    UMB_ERROR_CANCELLED,
];

fn tolerance(source: &mut Source<'_>, scene: &Scene) {
    let (place, to) = receiver(source, -1.0f64);
    let points = placed(source, &scene.points.points());
    let outcome = Outcome::new(source);
    let status = unsafe { umb_shape_tolerance(pointer(&points), to, outcome.pointer()) };
    let found = place.read();
    if outcome.check("umb_shape_tolerance", status, &ALLOWED[..7]) {
        assert!(found >= 0.0 && found.is_finite(), "tolerance {found}");
    } else {
        assert!(source.is_hostile() && found == -1.0, "status {status}, tolerance {found}");
    }
}

pub fn classes(source: &mut Source<'_>, scene: &Scene) {
    if source.byte() < 48 {
        return tolerance(source, scene);
    }
    let count = if source.half() { scene.vertex_count } else { source.below(40) };
    let [k1, k2] = [(); 2].map(|()| scalars(source, count));
    let count = if k1.count < 1 << 16 { k1.count } else { 1 };
    let location = source.below(2) as u32;
    let views = [&k1, &k2].map(|input| located(input, location));
    let [k1, k2] = [placed(source, &views[0]), placed(source, &views[1])];
    let watch = Watch::new(source);
    let run = Run::new(source, &watch, None);
    let mut options: umb_shape_options = zeroed();
    options.run = run.view;
    options.tolerance = match source.byte() {
        0..64 => 0.0,
        byte @ 64..200 => (byte - 63) as f64 / 32.0,
        byte => 2f64.powi(8 * (byte as i32 - 228)),
    };
    if source.spoils() {
        options.tolerance = f64::from_bits(source.number());
    }
    if source.spoils() {
        options.reserved = source.any_u32();
    }
    let known = source.half().then(|| {
        let draw: u64 = source.number();
        let bits = (0..count).map(|vertex| if draw >> (vertex % 61) & 7 == 7 { UMB_VERTEX_DEGENERATE } else { 1 });
        List::<u8>::new(source, bits.collect(), 1)
    });
    if let Some(known) = &known {
        options.status = known.bytes();
    }
    let tolerance = options.tolerance;
    let points = if tolerance != 0.0 && source.half() { None } else { placed(source, &scene.points.points()) };
    options.points = pointer(&points);
    let options = Struct::new(source, &mut options, false);
    let found = Bytes::new(source, count, true);
    let classes = placed(source, &found.view());
    let outcome = Outcome::new(source);
    let status = unsafe {
        let options = options.pointer();
        umb_shape_classes(pointer(&k1), pointer(&k2), options, pointer(&classes), outcome.pointer())
    };
    watch.check(status);
    if !outcome.check("umb_shape_classes", status, &ALLOWED) {
        assert!(found.is_untouched() || status == UMB_ERROR_CANCELLED, "classes are written on status {status}");
        assert!(source.is_hostile() || status == UMB_ERROR_CANCELLED, "sound input is refused: {status}");
        return;
    }
    let all = known.as_ref().is_none_or(|known| known.data.is_null() || known.seen().len() == count);
    assert!(all && views[1].count == count && (0.0..f64::INFINITY).contains(&tolerance));
    assert!(
        views.iter().all(|view| view.location <= UMB_AT_FACES && view.location == views[0].location),
        "scalars at neither vertices nor faces"
    );
    found.check_gaps(|_| true, "class");
    for vertex in 0..count {
        let class = found.element(vertex).expect("a class for each vertex");
        assert!(class <= UMB_SHAPE_SADDLE_VALLEY, "class {class} of vertex {vertex}");
        let undefined = known
            .as_ref()
            .and_then(|known| known.seen().get(vertex))
            .is_some_and(|bits| bits & UMB_VERTEX_DEGENERATE != 0);
        assert_eq!(class == UMB_SHAPE_UNDEFINED, undefined, "vertex {vertex}");
        if tolerance > 0.0 && !undefined {
            let [a, b] = [&views[0], &views[1]].map(|view| unsafe { read(view, vertex) });
            check_class(class, a, b, tolerance);
        }
    }
}

/// # Safety
/// A call has read it.
unsafe fn read(scalars: &umb_scalars, index: usize) -> f64 {
    unsafe {
        let double = scalars.scalar == UMB_SCALAR_F64;
        let step = if scalars.stride == 0 { if double { 8 } else { 4 } } else { scalars.stride };
        let place = scalars.data.cast::<u8>().add(index * step);
        if double { place.cast::<f64>().read() } else { place.cast::<f32>().read().into() }
    }
}

/// Checks a class against the signs, where rounding does not say which they are.
fn check_class(class: u8, k1: f64, k2: f64, tolerance: f64) {
    let sign = |x: f64, limit: f64| if x > limit { 2 } else { (x >= -limit) as usize };
    let moderate = |x: f64| x == 0.0 || (1e-100..1e100).contains(&x.abs());
    let (mean, product) = (0.5 * k1 + 0.5 * k2, k1 * k2);
    let near = |x: f64, limit: f64, size: f64| (x.abs() - limit).abs() <= 1e-12 * size;
    let clear = !near(mean, tolerance, k1.abs().max(k2.abs()))
        && !near(product, tolerance * tolerance, product.abs().max(tolerance * tolerance));
    if ![k1, k2, tolerance].into_iter().all(moderate) || !clear {
        return;
    }
    let table = [
        [UMB_SHAPE_SADDLE_VALLEY, UMB_SHAPE_VALLEY, UMB_SHAPE_PIT],
        [UMB_SHAPE_MINIMAL, UMB_SHAPE_FLAT, UMB_SHAPE_FLAT],
        [UMB_SHAPE_SADDLE_RIDGE, UMB_SHAPE_RIDGE, UMB_SHAPE_PEAK],
    ];
    let expected = table[sign(mean, tolerance)][sign(product, tolerance * tolerance)];
    assert_eq!(class, expected, "{k1:e}, {k2:e}, tolerance {tolerance:e}");
}
