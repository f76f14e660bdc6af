//! Draws without attachments.

use crate::device::common::{bytes_of, device, device_with, finish, module, requirements, shaders, storage};
use rasray_gpu::*;

struct Count {
    pipeline: RasterPipeline,
    set: BindingSet,
    buffer: Buffer,
}

fn count(device: &Device, pixels: u64, options: RasterOptions) -> Count {
    let buffer = storage(device, "pixels", pixels * 4);
    let layout = device.create_set_layout("pixels", 1).expect("set layout");
    let set = device.create_binding_set(&layout, "pixels", &[&buffer]).expect("binding set");
    let desc = RasterPipelineDesc {
        name: "count",
        vertex_module: &module(shaders::FULL_VERTEX),
        fragment_module: &module(shaders::COUNT_FRAGMENT),
        sets: &[&layout],
        push_constant_bytes: 4,
        constants: &[],
    };
    let pipeline = device.create_raster_pipeline_with(&desc, options).expect("pipeline");
    Count { pipeline, set, buffer }
}

#[test]
fn every_pixel_of_the_area_is_shaded_once_per_instance() {
    const WIDTH: u32 = 24;
    const HEIGHT: u32 = 10;
    let device = device();
    let count = count(&device, u64::from(WIDTH * HEIGHT), RasterOptions::default());
    let draws = storage(&device, "draw arguments", 16);
    device.upload_slice(&draws, 0, &[3_u32, 1, 0, 0]).expect("upload");
    for timing in [Timing::None, Timing::Device, Timing::Host] {
        let submitted = device
            .submit_passes(timing, |recorder| {
                recorder.fill(&count.buffer, 0, count.buffer.size(), 0);
                recorder.barrier(Access::TRANSFER_WRITE, Access::FRAGMENT);
                recorder.begin_pass(Stage::Build, "draw");
                recorder.begin_rendering(WIDTH, HEIGHT);
                recorder.bind_raster(&count.pipeline);
                recorder.bind_sets(0, &[&count.set]);
                recorder.push_constants(bytes_of(&[WIDTH]));
                recorder.draw(3, 2, 0);
                recorder.draw_indirect(&draws, 0);
                recorder.end_rendering();
                recorder.end_pass();
            })
            .expect("submission");
        assert_eq!(submitted.passes.len(), usize::from(timing != Timing::None));
        let pixels =
            device.download_as::<u32>(&count.buffer, 0, (WIDTH * HEIGHT) as usize).expect("download");
        // Row 0 is at the negative end of clip space's y: y is not flipped, and values increase with the row.
        for (index, value) in (0_u32..).zip(pixels) {
            assert_eq!(value, 3 * (1 + index / WIDTH), "pixel {index} under {timing:?}");
        }
    }
    drop((count, draws));
    finish(device);
}

#[test]
fn views_of_a_mask_are_drawn_at_once() {
    let optional = Requirements {
        optional: vec![(Feature::Multiview, "one draw for all views")],
        ..Requirements::default()
    };
    let device = device_with(requirements().merge(&optional));
    if device.has(Feature::Multiview) {
        let options = RasterOptions { view_mask: 0b111, ..RasterOptions::default() };
        let count = count(&device, 16, options);
        device
            .submit(|recorder| {
                recorder.fill(&count.buffer, 0, 64, 0);
                recorder.barrier(Access::TRANSFER_WRITE, Access::FRAGMENT);
                recorder.begin_rendering_area(RenderArea {
                    width: 4,
                    height: 4,
                    layers: 1,
                    view_mask: 0b111,
                });
                recorder.bind_raster(&count.pipeline);
                recorder.bind_sets(0, &[&count.set]);
                recorder.push_constants(bytes_of(&[4]));
                recorder.draw(3, 1, 0);
                recorder.end_rendering();
            })
            .expect("submission");
        let pixels = device.download_as::<u32>(&count.buffer, 0, 16).expect("download");
        assert_eq!(pixels, [3, 3, 3, 3, 6, 6, 6, 6, 9, 9, 9, 9, 12, 12, 12, 12]);

        let error = device
            .submit(|recorder| {
                recorder.begin_rendering(4, 4);
                recorder.bind_raster(&count.pipeline);
                recorder.bind_sets(0, &[&count.set]);
                recorder.push_constants(bytes_of(&[4]));
                recorder.draw(3, 1, 0);
                recorder.end_rendering();
            })
            .expect_err("the masks differ");
        assert!(error.to_string().contains("view masks"), "{error}");
    }
    finish(device);
}

#[test]
fn options_need_their_features() {
    let device = device();
    let layout = device.create_set_layout("pixels", 1).expect("set layout");
    let desc = RasterPipelineDesc {
        name: "count",
        vertex_module: &module(shaders::FULL_VERTEX),
        fragment_module: &module(shaders::COUNT_FRAGMENT),
        sets: &[&layout],
        push_constant_bytes: 4,
        constants: &[],
    };
    let conservative = RasterOptions { conservative: true, ..RasterOptions::default() };
    let error = device.create_raster_pipeline_with(&desc, conservative).expect_err("not enabled");
    assert!(
        matches!(error, GpuError::FeatureNotEnabled { feature: Feature::ConservativeRasterization, .. }),
        "{error}"
    );
    drop(layout);
    finish(device);
}
