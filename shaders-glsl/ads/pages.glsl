// Lists of pages: an entry gets a slot in the first page of its list, or in a new page, without locks. Also
// reads such lists.
// Reads, writes: through what the including file defines first. This file undefines all of it at its end:
//   PageRef                  reference type of the structure
//   PAGE_SIZE                slots per page, 1 to 8
//   PAGE_LIST(s, list)       the word of a list, 0 if the list is empty
//   PAGE_NEXT(s, page)       the word that leads from a page to the next one
//   PAGE_DEMAND(s)           number of pages taken, including those past the end of the pool
//   PAGE_CAPACITY(s)         number of pages in the pool
// Source: Crassin 2010; Frid Kastrati and Goswami 2017, section 3.2. Both guard a list with a spin lock.
// A shader with several structures includes this file once per structure: the functions are overloads by the
// reference type.
// The word that leads to a page is (page + 1) << 4 | used, where `used` is the number of the page's slots in
// use. So one compare-exchange takes a slot. Slots are used from the last to the first, so a page is read
// from its first used slot to its end. A thread whose compare-exchange fails too often begins a new page, and
// leaves the rest of the old page unused. No thread waits for another.

#ifndef ADS_PAGES_GLSL
#define ADS_PAGES_GLSL
// Number of times that a thread tries to get a slot in the first page of a list before it begins a new page.
#define PAGE_TRIES 64u
#endif

// Returns the first used slot of the page that a word leads to, counted over all pages. The word must not be
// 0.
uint page_first_slot(PageRef s, uint word) {
    return ((word >> 4) - 1u) * PAGE_SIZE + PAGE_SIZE - (word & 15u);
}

// Sets the word that leads from a page to the next one, if the page exists. This is a function of its own
// because the shader compiler does not end if `precise` values depend on memory that is written from a local
// variable.
void page_set_next(PageRef s, uint page, uint word) {
    if (page < PAGE_CAPACITY(s)) {
        PAGE_NEXT(s, page) = word;
    }
}

// Takes a slot for an entry of a list, and returns the slot, counted over all pages. It may lie past the last
// page of the pool.
uint page_take_slot(PageRef s, uint list) {
    uint word = PAGE_LIST(s, list);
    for (uint i = 0u; i < PAGE_TRIES && word != 0u && (word & 15u) < PAGE_SIZE; i++) {
        uint found = atomicCompSwap(PAGE_LIST(s, list), word, word + 1u);
        if (found == word) {
            return page_first_slot(s, word + 1u);
        }
        word = found;
    }
    uint page = atomicAdd(PAGE_DEMAND(s), 1u);
    uint mine = (page + 1u) << 4 | 1u;
    page_set_next(s, page, atomicExchange(PAGE_LIST(s, list), mine));
    return page_first_slot(s, mine);
}

// Returns the link of the first used slot of the page that a word leads to: the slot plus 1, or 0 at the end
// of a list.
uint page_link(PageRef s, uint word) {
    return word >> 4 == 0u ? 0u : page_first_slot(s, word) + 1u;
}

// Returns the link of the first used slot of the page that follows the page of a link.
uint page_link_of_next(PageRef s, uint link) {
    return page_link(s, PAGE_NEXT(s, (link - 1u) / PAGE_SIZE));
}

// Returns the link of the slot after that of a link, in the same page or in the next one.
uint page_link_behind(PageRef s, uint link) {
    return link % PAGE_SIZE == 0u ? page_link_of_next(s, link) : link + 1u;
}

#undef PageRef
#undef PAGE_SIZE
#undef PAGE_LIST
#undef PAGE_NEXT
#undef PAGE_DEMAND
#undef PAGE_CAPACITY
