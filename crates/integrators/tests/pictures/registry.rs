//! Registry of integrators against the registry of the naive ones.

use std::collections::BTreeSet;

use crate::pictures::common::{difference::*, scenes::*, *};
use glam::DVec3;
use rasray_integrators::{INTEGRATORS, IntegratorSpec};
use rasray_reference::integrators as reference;
use rasray_scene::Environment;

/// Returns every integrator by itself and with each value that tests try, each once.
fn specs() -> Vec<IntegratorSpec> {
    let mut specs: Vec<IntegratorSpec> = Vec::new();
    for row in INTEGRATORS {
        let plain = IntegratorSpec::from(row);
        let values = row.options.iter().flat_map(|option| {
            option.tried().into_iter().map(|text| (option.name, option.parse(text).expect("it is tried")))
        });
        let tried = values.map(|(name, value)| plain.with(name, value).expect("its own option"));
        for spec in std::iter::once(plain.clone()).chain(tried) {
            if !specs.contains(&spec) {
                specs.push(spec);
            }
        }
    }
    specs
}

#[test]
fn every_integrator_has_a_naive_one_of_its_name() {
    let names = |names: &mut dyn Iterator<Item = &'static str>| names.collect::<BTreeSet<_>>();
    let naive = names(&mut reference::INTEGRATORS.iter().map(|row| row.name));
    assert_eq!(names(&mut INTEGRATORS.iter().map(|row| row.name)), naive);
}

#[test]
fn every_option_does_on_the_device_what_it_does_in_the_naive_integrator() {
    let eye = forward_camera(DVec3::new(0.0, 0.0, 0.9));
    // The room is open to one side, so that not everything is occluded; walls emit, so that there is light
    // without bounces.
    let mut scene = veiled_room();
    scene.instances.remove(0);
    scene.environment = Environment::Constant([0.3, 0.4, 0.5]);
    scene.materials[0].emission = [0.05, 0.1, 0.02];
    for spec in specs() {
        let found = difference(&scene, &scene, &eye, 4, &spec);
        eprintln!("{} {:?}: {found:?}", spec.name(), spec.options());
        found.assert_within(0.01, 0.01, format_args!("{spec:?}"));
    }
}
