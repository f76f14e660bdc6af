//! Build and trace times of every registered system: `cargo bench -- [SCENE] [RAYS]`.
//!
//! Prints, for every registered system and preset, the median build time and the median trace time of random rays,
//! alternated between systems in one process. Times of software devices are for ratios on that device. For errors
//! beside speed use `rasray compare`.

use std::ops::ControlFlow;

use rasray_experiment::{
    Contestant, Stage, StructureOptions, SystemConfig, incoherent_rays, requirements, trace_in_turns,
};
use rasray_gpu::{Device, DeviceDesc};
use rasray_metrics::median;
use rasray_scene::needs::{Integrator, Needs, Workload};
use rasray_scene::{builtin, default_view};
use rasray_systems::SYSTEMS;

const REPETITIONS: u32 = 5;

/// Of all random numbers.
const SEED: u32 = 1;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let name = arguments.first().map_or("spheres:10k", String::as_str);
    let rays: u32 = match arguments.get(1) {
        Some(text) => text.parse().ok().filter(|rays| *rays > 0).ok_or_else(|| {
            format!("RAYS must be a whole number above 0, not `{text}`; cargo bench -- [SCENE] [RAYS]")
        })?,
        None => 4096,
    };
    let scene = builtin::builtin(name).ok_or_else(|| format!("there is no built-in scene `{name}`"))??;
    let camera = scene.cameras.first().cloned().unwrap_or_else(|| default_view::default_camera(&scene));
    let device = Device::create(&DeviceDesc { requirements: requirements(), ..DeviceDesc::default() })?;
    println!("{}, {name}, {rays} incoherent rays, medians of {REPETITIONS}", device.name());

    let needs = Needs::of(&scene, Workload { integrator: Integrator::Raycast, bounces: 0 });
    let stage = Stage::new(&device, &scene, &camera, [64, 64], SEED, &needs)?;
    let systems: Vec<SystemConfig> = SYSTEMS
        .iter()
        .flat_map(|system| system.presets.iter().map(move |preset| (system, *preset)))
        .map(|(system, preset)| SystemConfig {
            system,
            preset,
            options: StructureOptions::default(),
            variant: None,
        })
        .collect();
    let contestants =
        Contestant::all(&device, &stage, &systems, stage.scene.eye(), REPETITIONS, &mut |_| {
            ControlFlow::Continue(())
        })?
        .unwrap_or_default();
    let rays = incoherent_rays(stage.scene.geometry().bounds(), SEED, rays);
    let traces = trace_in_turns(&device, &contestants, &rays, REPETITIONS)?;
    println!("{:<24} {:>12} {:>12} {:>14}", "system", "build ms", "trace ms", "Mrays/s");
    for (contestant, traced) in contestants.iter().zip(&traces) {
        let run = contestant.run(&device)?;
        let name = format!("{} {}", run.system, run.preset);
        let trace = median(&traced.milliseconds);
        let shown =
            |value: Option<f64>, digits| value.map_or("-".to_owned(), |value| format!("{value:.digits$}"));
        let speed = trace.map(|trace| rays.len() as f64 / trace / 1.0e3);
        println!(
            "{name:<24} {:>12} {:>12} {:>14}",
            shown(run.times.build_ms, 2),
            shown(trace, 2),
            shown(speed, 3)
        );
    }
    Ok(())
}
