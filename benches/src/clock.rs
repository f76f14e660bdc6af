//! Clock of processor time, which depends less on other work on the machine than wall time does.

use std::time::Instant;

/// Time spent in a call.
#[derive(Clone, Copy, Debug)]
pub struct Spent {
    /// Wall time, milliseconds.
    pub wall: f64,
    /// Processor time of all threads of this process, including threads of a software driver, milliseconds;
    /// absent where the system has no such clock.
    pub processor: Option<f64>,
}

/// Calls a function, and returns its result with the time spent.
pub fn spent<T>(call: impl FnOnce() -> T) -> (T, Spent) {
    let (started, processor) = (Instant::now(), processor_milliseconds());
    let answer = call();
    let processor = processor.zip(processor_milliseconds()).map(|(before, after)| after - before);
    (answer, Spent { wall: started.elapsed().as_secs_f64() * 1.0e3, processor })
}

/// Returns the processor time of all threads of this process since it began, milliseconds.
#[cfg(unix)]
fn processor_milliseconds() -> Option<f64> {
    let mut time = std::mem::MaybeUninit::<libc::timespec>::uninit();
    // SAFETY: the pointer is to memory for a `timespec`, which the call writes.
    let answer = unsafe { libc::clock_gettime(libc::CLOCK_PROCESS_CPUTIME_ID, time.as_mut_ptr()) };
    // SAFETY: the call wrote the value, as its return value 0 says.
    let time = (answer == 0).then(|| unsafe { time.assume_init() })?;
    Some(time.tv_sec as f64 * 1.0e3 + time.tv_nsec as f64 / 1.0e6)
}

/// Returns the processor time of all threads of this process since it began, milliseconds.
#[cfg(not(unix))]
fn processor_milliseconds() -> Option<f64> {
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sleep_takes_time_on_the_wall_and_work_of_the_processor() {
        let pause = std::time::Duration::from_millis(60);
        let ((), slept) = spent(|| std::thread::sleep(pause));
        assert!(slept.wall >= 60.0, "{slept:?}");
        let (sum, worked) = spent(|| {
            let started = Instant::now();
            let mut sum = 0_u64;
            while started.elapsed() < pause {
                sum = std::hint::black_box(sum + 1);
            }
            sum
        });
        assert!(sum > 0);
        if let Some(processor) = worked.processor {
            assert!(processor > 0.0, "{worked:?}");
        }
    }
}
