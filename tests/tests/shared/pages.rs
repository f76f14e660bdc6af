//! Lists of pages that many threads fill at once: every entry gets a slot of its own, in its own list.

use rasray_shaders_glsl::ADS_TEST_PAGES;
use rasray_shaders_glsl::records::test_kernels::PageTestConstants;
use rasray_tests::harness::Bench;
use rasray_tests::random::Random;
use rasray_tests::visits::run_kernel;

/// The words of the lists and pages after `threads` threads put an entry each into one of `lists` lists, and
/// the slot that each was given.
fn fill(bench: &Bench, lists: &[u32], list_count: usize, page: u32, capacity: u32) -> (Vec<u32>, Vec<u32>) {
    let words = 1 + list_count + (capacity * (1 + page)) as usize;
    let constants = PageTestConstants {
        thread_count: lists.len() as u32,
        list_count: list_count as u32,
        page_size: page,
        page_capacity: capacity,
    };
    let inputs = bytemuck::cast_slice(lists);
    let (slots, words) = run_kernel(
        bench.device(),
        &ADS_TEST_PAGES,
        inputs,
        lists.len(),
        Some(words),
        lists.len(),
        &constants,
    );
    (words, slots)
}

/// The entries of a list.
fn entries(words: &[u32], list_count: usize, list: usize, page_size: usize) -> Vec<usize> {
    let mut found = Vec::new();
    let mut word = words[1 + list] as usize;
    while word != 0 {
        let (page, used) = ((word >> 4) - 1, word & 15);
        assert!((1..=page_size).contains(&used), "list {list}: {used} slots of page {page} are used");
        assert!(page < words[0] as usize, "list {list}: page {page} was never taken");
        let at = 1 + list_count + page * (1 + page_size);
        found.extend(words[at + 1..][page_size - used..page_size].iter().map(|entry| *entry as usize));
        assert!(found.len() < 1 << 20, "list {list} runs in a circle");
        word = words[at] as usize;
    }
    found
}

#[test]
fn every_entry_is_in_its_list_once() {
    const THREADS: usize = 20_000;
    let bench = Bench::new();
    let mut random = Random::new(3);
    for list_count in [1, 7, 3000] {
        let lists: Vec<u32> = (0..THREADS).map(|_| (random.bits() % list_count as u64) as u32).collect();
        for page in [1, 2, 4, 8] {
            let (words, slots) = fill(&bench, &lists, list_count, page, THREADS as u32);
            let pages = words[0] as usize;
            let least: usize = (0..list_count)
                .map(|list| lists.iter().filter(|l| **l as usize == list).count().div_ceil(page as usize))
                .sum();
            assert!(pages >= least && pages <= THREADS, "{pages} pages, and {least} would do");
            let mut seen = vec![false; THREADS];
            for list in 0..list_count {
                for entry in entries(&words, list_count, list, page as usize) {
                    let thread = entry.checked_sub(1).expect("a used slot holds an entry");
                    assert_eq!(lists[thread] as usize, list, "thread {thread}");
                    assert!(!std::mem::replace(&mut seen[thread], true), "thread {thread} is listed twice");
                }
            }
            assert!(seen.iter().all(|seen| *seen), "{list_count} lists, {page} per page: an entry is lost");
            let mut slots = slots;
            slots.sort_unstable();
            assert!(slots.windows(2).all(|pair| pair[0] < pair[1]), "a slot was given twice");
        }
    }
}

/// Threads that do not collide begin no more pages than they need, and demand is counted past the end of the
/// pool.
#[test]
fn demand_is_exact_where_threads_do_not_collide_and_counted_past_the_end() {
    const LISTS: usize = 640;
    let bench = Bench::new();
    // One thread per list: a page each, whatever the capacity.
    let lists: Vec<u32> = (0..LISTS as u32).collect();
    for capacity in [0, 1, 100, LISTS as u32] {
        let (words, slots) = fill(&bench, &lists, LISTS, 4, capacity);
        assert_eq!(words[0] as usize, LISTS, "capacity for {capacity}");
        assert!(slots.iter().all(|slot| slot % 4 == 3), "a page is filled from its end");
        let stored = words[1 + LISTS..].chunks_exact(5).filter(|page| page[4] != 0).count();
        assert_eq!(stored, capacity as usize);
    }
}
