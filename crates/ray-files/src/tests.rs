//! Round trips bit for bit, and bytes that are no valid file.

use super::error::FormatError;
use super::*;
use proptest::prelude::*;
use rasray_ads::{Hit, PRIMITIVE_NONE, RAY_CULL_BACK_FACES, Ray, StructureKind};

/// Makes rays with awkward bits: subnormal, negative zero, an infinite and a negative end, an exclusion.
fn rays() -> Vec<Ray> {
    let plain = Ray::new([1.0e-40, -0.0, 3.25], [0.1, -2.0e30, f32::MIN_POSITIVE]);
    vec![
        plain,
        Ray { t_min: 1.0e-3, t_max: 17.5, exclude_primitive: 7, ..plain },
        Ray { t_max: -1.0, cone_width: 0.5, cone_spread: 1.0e-4, ..plain },
        Ray { flags: RAY_CULL_BACK_FACES, ..plain },
    ]
}

fn bits(rays: &[Ray]) -> Vec<[u32; 12]> {
    rays.iter().map(words_of).collect()
}

fn words_of(ray: &Ray) -> [u32; 12] {
    let ([a, b, c], [x, y, z]) = (ray.origin, ray.direction);
    let floats = [a, b, c, ray.t_min, x, y, z, ray.t_max].map(f32::to_bits);
    let mut words = [0; 12];
    words[..8].copy_from_slice(&floats);
    words[8..].copy_from_slice(&[
        ray.exclude_primitive,
        ray.flags,
        ray.cone_width.to_bits(),
        ray.cone_spread.to_bits(),
    ]);
    words
}

#[test]
fn rays_survive_the_binary_format_bit_for_bit_about_any_origin() {
    for origin in [[0.0; 3], [1.0e6, -4096.0, 0.1]] {
        let read = read_rays(&write_rays(&rays(), origin)).expect("what was written");
        assert_eq!(bits(&read.relative_to(origin)), bits(&rays()));
        // Relative to another origin the rays are shifted.
        let moved = read.relative_to([origin[0] - 2.0, origin[1], origin[2]]);
        assert_eq!((moved[0].origin[0], moved[0].origin[2]), (2.0, 3.25));
    }
}

#[test]
fn rays_survive_npy_bit_for_bit_where_the_origin_is_the_worlds() {
    let read = rays_from_npy(&rays_to_npy(&rays(), [0.0; 3])).expect("what was written");
    // An array has neither exclusions nor flags nor cones.
    let expected: Vec<_> = rays()
        .iter()
        .map(|ray| Ray { t_min: ray.t_min, t_max: ray.t_max, ..Ray::new(ray.origin, ray.direction) })
        .collect();
    assert_eq!(bits(&read.relative_to([0.0; 3])), bits(&expected));
    let origin = [4096.0, -512.0, 0.0];
    let far = rays_from_npy(&rays_to_npy(&rays(), origin)).expect("what was written").relative_to(origin);
    assert_eq!((far[0].origin[2], far[1].t_max, far[0].direction), (3.25, 17.5, rays()[0].direction));
}

#[test]
fn an_array_of_six_columns_has_no_limits_and_one_of_seven_begins_late() {
    let array = |columns: usize| {
        let numbers = [1.0_f32, 2.0, 3.0, 0.0, 0.0, 1.0, 0.5];
        let bytes = numbers[..columns].iter().flat_map(|x| x.to_le_bytes()).collect();
        super::npy::Array::plain(super::npy::Kind::F4, &[1, columns], bytes).to_bytes()
    };
    let ray = |columns| rays_from_npy(&array(columns)).map(|file| file.rays[0]);
    assert_eq!(ray(6), Ok(Ray::new([1.0, 2.0, 3.0], [0.0, 0.0, 1.0])));
    assert_eq!(ray(7).map(|ray| (ray.t_min, ray.t_max)), Ok((0.5, f32::INFINITY)));
    assert!(matches!(ray(5), Err(FormatError::Content { .. })));
}

#[test]
fn hits_survive_npy_bit_for_bit() {
    let hits = [
        Hit { t: 1.0e-40, primitive: 16_777_217, a: 0.25, b: -0.0 },
        Hit { t: f32::INFINITY, primitive: PRIMITIVE_NONE, a: 0.0, b: 0.0 },
        Hit { t: f32::NAN, primitive: 4_294_967_294, a: 1.0, b: 0.5 },
    ];
    let words = |hits: &[Hit]| -> Vec<_> {
        hits.iter().map(|hit| [hit.t.to_bits(), hit.primitive, hit.a.to_bits(), hit.b.to_bits()]).collect()
    };
    let bytes = hits_to_npy(&hits, StructureKind::Primitive);
    assert_eq!(words(&hits_from_npy(&bytes).expect("what was written")), words(&hits));
    // Hits on fragments have no weights of vertices.
    let bytes = hits_to_npy(&hits, StructureKind::Fragment);
    assert!(hits_from_npy(&bytes).expect("what was written")[0].a.is_nan());
    // The oracle's answers can be compared as well: they have fields of the same names.
    let truth = TrueHit { t: 2.5, primitive: 3, barycentrics: [0.5, 0.25], ambiguous: true };
    let read = hits_from_npy(&truth_to_npy(&[truth])).expect("what was written");
    assert_eq!(read, [Hit { t: 2.5, primitive: 3, a: 0.5, b: 0.25 }]);
}

/// Bytes that `numpy.save` of version 2.1 wrote for `numpy.array([[1., -1.], [2.5, 7.]])`.
const BY_NUMPY: &[u8] = b"\x93NUMPY\x01\x00v\x00{'descr': '<f8', 'fortran_order': False, 'shape': (2, 2), }                                                          \n\
\x00\x00\x00\x00\x00\x00\xf0\x3f\x00\x00\x00\x00\x00\x00\xf0\xbf\x00\x00\x00\x00\x00\x00\x04\x40\x00\x00\x00\x00\x00\x00\x1c\x40";

#[test]
fn arrays_of_numpy_are_read() {
    let hits = hits_from_npy(BY_NUMPY).expect("two rows of t and primitive");
    assert_eq!((hits[0].is_hit(), hits[1].t, hits[1].primitive), (false, 2.5, 7));
}

#[test]
fn headers_that_are_not_arrays_are_refused() {
    let file = |header: &str| {
        let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
        bytes.extend((header.len() as u16).to_le_bytes());
        bytes.extend(header.as_bytes());
        hits_from_npy(&bytes)
    };
    assert_eq!(file("{'descr': '<f4', 'fortran_order': False, 'shape': (0, 2), }"), Ok(Vec::new()));
    let deep = "(".repeat(2000);
    for (header, wanted) in [
        ("", "expected"),
        ("{", "expected"),
        ("{'descr': '<f4'", "','"),
        ("{'descr': '<f4'}", "fortran_order"),
        ("{'descr': '<f4', 'fortran_order': False}", "shape"),
        ("{'descr': '<f4', 'fortran_order': True, 'shape': (0, 2)}", "Fortran"),
        ("{'descr': '>f4', 'fortran_order': False, 'shape': (0, 2)}", "little-endian"),
        ("{'descr': 'O', 'fortran_order': False, 'shape': (0, 2)}", "type 'O'"),
        ("{'descr': [], 'fortran_order': False, 'shape': (0, 2)}", "no field"),
        ("{'descr': [('t', '<f4', (2,))], 'fortran_order': False, 'shape': (0,)}", "(name, type)"),
        ("{'descr': '<f4', 'fortran_order': False, 'shape': (3, 2)}", "promises"),
        ("{'descr': '<f4', 'fortran_order': False, 'shape': (18446744073709551615, 2)}", "at most"),
        ("{'descr': '<f4', 'fortran_order': False, 'shape': (99999999999999999999, 2)}", "64 bits"),
        ("{'descr': '<f4', 'fortran_order': False, 'shape': (-1, 2)}", "expected"),
        ("{'descr': '<f4', 'fortran_order': False, 'shape': ()}", "promises"),
        ("{'descr': '<f4', 'fortran_order': False, 'shape': (0, 9)}", "records with t"),
        ("{'descr': '<\\x66', 'fortran_order': False, 'shape': (0, 2)} x", "escapes"),
        ("{'descr': '<f4', 'fortran_order': False, 'shape': (0, 2)} x", "the end"),
        (deep.as_str(), "less nesting"),
    ] {
        let error = file(header).expect_err(header);
        assert!(error.to_string().contains(wanted), "{header}: {error}");
    }
}

#[test]
fn rays_that_cannot_be_traced_are_named_by_their_index() {
    let nan = f32::NAN;
    for (broken, what) in [
        (Ray { direction: [0.0, -0.0, 0.0], ..rays()[0] }, "zero"),
        (Ray { direction: [nan, 0.0, 1.0], ..rays()[0] }, "direction is not finite"),
        (Ray { origin: [0.0, f32::INFINITY, 1.0], ..rays()[0] }, "origin"),
        (Ray { t_max: nan, ..rays()[0] }, "NaN"),
        (Ray { flags: 2, ..rays()[0] }, "flags"),
        (Ray { cone_width: nan, ..rays()[0] }, "cone"),
    ] {
        let error = read_rays(&write_rays(&[rays()[0], broken], [0.0; 3])).expect_err(what);
        assert!(error.to_string().contains("entry 1") && error.to_string().contains(what), "{error}");
    }
    let whole = write_rays(&rays(), [0.0; 3]);
    for (place, byte, what) in
        [(0, b'X', "begin"), (8, 2, "version"), (12, 32, "records"), (16, 9, "promises")]
    {
        let mut bytes = whole.clone();
        bytes[place] = byte;
        assert!(read_rays(&bytes).expect_err(what).to_string().contains(what), "{what}");
    }
    let error = read_rays(&write_rays(&rays(), [f64::NAN, 0.0, 0.0])).expect_err("no origin");
    assert!(error.to_string().contains("frame origin"), "{error}");
}

#[test]
fn every_cut_and_every_byte_more_is_refused() {
    let npy = hits_to_npy(&[Hit { t: 1.0, primitive: 0, a: 0.0, b: 0.0 }; 3], StructureKind::Primitive);
    let binary = write_rays(&rays(), [0.0; 3]);
    for length in 0..binary.len() {
        assert!(read_rays(&binary[..length]).is_err(), "{length} bytes");
    }
    for length in 0..npy.len() {
        assert!(hits_from_npy(&npy[..length]).is_err(), "{length} bytes");
    }
    assert!(read_rays(&[binary, vec![0]].concat()).is_err());
    assert!(hits_from_npy(&[npy, vec![0]].concat()).is_err());
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(2000) })]

    /// Any bytes end in rays that can be traced, or in an error.
    #[test]
    fn changed_bytes_never_panic(
        changes in prop::collection::vec((0_usize..400, any::<u8>()), 0..6),
        cut in 0_usize..400,
        wide in any::<bool>(),
    ) {
        let origin = if wide { [1.0, 2.0, 3.0] } else { [0.0; 3] };
        let files = [
            write_rays(&rays(), origin),
            rays_to_npy(&rays(), origin),
            hits_to_npy(&[Hit { t: 1.0, primitive: 0, a: 0.0, b: 0.0 }; 3], StructureKind::Primitive),
        ];
        for mut bytes in files {
            for (place, byte) in &changes {
                if let Some(target) = bytes.get_mut(*place) {
                    *target = *byte;
                }
            }
            // Half of the files are cut short.
            if cut < 200 {
                bytes.truncate(bytes.len() * cut / 200);
            }
            for read in [read_rays(&bytes), rays_from_npy(&bytes)].into_iter().flatten() {
                for ray in read.relative_to(origin) {
                    prop_assert!(ray.direction.iter().all(|x| x.is_finite()));
                }
            }
            _ = hits_from_npy(&bytes);
        }
    }

    /// Text that looks like a header never panics.
    #[test]
    fn header_text_never_panics(text in "[{}()\\[\\]'\",:A-Za-z0-9<>| é]{0,80}") {
        let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
        bytes.extend((text.len() as u16).to_le_bytes());
        bytes.extend(text.as_bytes());
        _ = hits_from_npy(&bytes);
        _ = rays_from_npy(&bytes);
    }
}
