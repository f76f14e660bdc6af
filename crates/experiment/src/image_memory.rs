//! Checks that an image fits into the memory of device and host, before anything is made.

use rasray_gpu::Device;
use rasray_integrators::FilmPixel;

use crate::error::{ExperimentError, Holder};
use crate::jobs::{Aov, AovSelection, Frame};

/// Bytes per pixel on device and host.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct PerPixel {
    device: u64,
    host: u64,
}

const NUMBER: u64 = size_of::<u32>() as u64;
const COLOUR: u64 = size_of::<[f32; 3]>() as u64;

/// Bytes per pixel of the pilot of adaptive samples: mean, squares, sum, and two numbers of samples.
const PILOT: u64 = 5 * NUMBER;

/// Bytes per pixel whose variance is measured: mean, squares, sum and number of samples for each channel.
const MOMENTS: u64 = 3 * 4 * NUMBER;

impl PerPixel {
    /// Returns the memory per pixel of an image with these additional images, and with sums if the image is a
    /// share of the samples.
    fn of(aovs: AovSelection, is_adaptive: bool, has_sums: bool) -> Self {
        let total =
            |kept: &[(bool, u64)]| kept.iter().filter(|(is_kept, _)| *is_kept).map(|(_, bytes)| bytes).sum();
        let film = size_of::<FilmPixel>() as u64;
        Self {
            device: total(&[(true, film), (is_adaptive, NUMBER), (aovs.has_direct_light(), film)]),
            host: total(&[
                (true, COLOUR),
                (has_sums, COLOUR + NUMBER),
                (true, aovs.iter().map(Aov::bytes).sum()),
                (is_adaptive, PILOT),
                (aovs.contains(Aov::Variance), MOMENTS),
            ]),
        }
    }
}

/// Available memory, bytes.
#[derive(Clone, Copy, Debug)]
struct There {
    /// Memory of the device; absent if the device uses the host's.
    device: Option<u64>,
    /// Memory of the host; absent if it is not known.
    host: Option<u64>,
}

impl There {
    fn of(device: &Device) -> Self {
        let of_device = device.limits().device_local_bytes;
        Self { device: (!device.is_software()).then_some(of_device), host: available_to_host() }
    }

    /// # Errors
    /// The memory cannot hold an image with this number of pixels.
    fn check(self, [width, height]: [u32; 2], per_pixel: PerPixel) -> Result<(), ExperimentError> {
        let pixels = u64::from(width) * u64::from(height);
        let refused = |bytes_per_pixel, available, memory| {
            Err(ExperimentError::ImageTooLarge { size: [width, height], bytes_per_pixel, available, memory })
        };
        let PerPixel { device, host } = per_pixel;
        if let Some(there) = self.device.filter(|there| pixels * device > *there) {
            return refused(device, there, Holder::Device);
        }
        let bytes = if self.device.is_some() { host } else { host + device };
        if let Some(there) = self.host.filter(|there| pixels * bytes > *there) {
            return refused(bytes, there, Holder::Host);
        }
        Ok(())
    }
}

/// Refuses an image that the memory of the device or of the host cannot hold.
///
/// # Errors
/// The image is too large; the error gives the largest size.
pub(crate) fn check(
    device: &Device,
    frame: &Frame,
    aovs: AovSelection,
    has_sums: bool,
) -> Result<(), ExperimentError> {
    let per_pixel = PerPixel::of(aovs, frame.adaptive.is_some(), has_sums);
    There::of(device).check([frame.width, frame.height], per_pixel)
}

/// Returns the bytes that the process may still allocate, if the system tells: free or reclaimable bytes, at
/// most the limit of the process's group.
fn available_to_host() -> Option<u64> {
    let free = std::fs::read_to_string("/proc/meminfo").ok().and_then(|text| available(&text))?;
    let limit = std::fs::read_to_string("/sys/fs/cgroup/memory.max").ok();
    Some(limit.and_then(|text| text.trim().parse().ok()).map_or(free, |limit: u64| free.min(limit)))
}

/// Reads `MemAvailable` of `/proc/meminfo`, bytes.
fn available(text: &str) -> Option<u64> {
    let line = text.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    let kibibytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    kibibytes.checked_mul(1 << 10)
}

#[cfg(test)]
mod tests {
    use super::*;

    const GIBIBYTE: u64 = 1 << 30;
    const PLAIN: PerPixel = PerPixel { device: 16, host: 12 };

    #[test]
    fn an_image_that_does_not_fit_is_refused_with_the_size_that_does() {
        let size = [8192, 8192];
        let check = |device, host| There { device, host }.check(size, PLAIN);
        // An image of 64 Mi pixels takes 1 GiB on the device and three quarters of one on the host.
        assert!(check(Some(GIBIBYTE), Some(GIBIBYTE)).is_ok());
        assert!(check(None, Some(2 * GIBIBYTE)).is_ok() && check(None, None).is_ok());
        let device = check(Some(GIBIBYTE / 2), None).expect_err("the device is too small");
        assert!(matches!(device, ExperimentError::ImageTooLarge { memory: Holder::Device, .. }), "{device}");
        let expected =
            "an image of 8192 x 8192 pixels takes 1.00 GiB (16 bytes a pixel), and the device has 512.00 MiB";
        assert_eq!(device.to_string(), expected);
        let shared = check(None, Some(GIBIBYTE)).expect_err("device and host share what there is");
        let is_host = matches!(shared, ExperimentError::ImageTooLarge { memory: Holder::Host, .. });
        assert!(is_host && shared.to_string().contains("1.75 GiB"), "{shared}");
        let host = check(Some(GIBIBYTE), Some(GIBIBYTE / 2)).expect_err("the host is too small");
        assert!(host.to_string().contains("768.00 MiB (12 bytes a pixel)"), "{host}");
    }

    #[test]
    fn whatever_is_kept_of_a_pixel_counts() {
        let of = |aovs: &[Aov]| PerPixel::of(aovs.iter().copied().collect(), false, false);
        assert_eq!(of(&[]), PLAIN);
        assert_eq!(of(&[Aov::Normal, Aov::Material, Aov::Uv]), PerPixel { host: 12 + 12 + 4 + 8, ..PLAIN });
        assert_eq!(of(&[Aov::Indirect]), PerPixel { device: 16 + 16, host: 12 + 12 });
        assert_eq!(of(&[Aov::Variance]), PerPixel { host: 12 + 12 + 48, ..PLAIN });
        let share = PerPixel::of(AovSelection::default(), true, true);
        assert_eq!(share, PerPixel { device: 16 + 4, host: 12 + 16 + 20 });
    }

    #[test]
    fn what_the_system_says_is_read() {
        let text =
            "MemTotal:       24684084 kB\nMemFree:  160 kB\nMemAvailable:   20437580 kB\nBuffers: 1 kB\n";
        assert_eq!(available(text), Some(20_437_580 << 10));
        assert_eq!(available("MemTotal: 1 kB\n"), None);
    }
}
