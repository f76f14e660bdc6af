// Lists of pages: how an entry gets a slot in the page at the head of its list, or in a new one,
// without locks; and how a list is read. Included once per structure that has pages: its reference type
// tells the functions apart.
// Reads, writes: through what the including file defines before, all of it undefined again at the end:
//   PageRef                  reference type of the structure
//   PAGE_SIZE                slots per page, 1 to 8
//   PAGE_LIST(s, list)       the word of a list, 0 where it is empty
//   PAGE_NEXT(s, page)       the word that leads from a page to the next one
//   PAGE_DEMAND(s)           pages taken, also those past the end
//   PAGE_CAPACITY(s)         pages there are
// Source: Crassin 2010; Frid Kastrati and Goswami 2017, section 3.2. Both guard a list with a spin lock.
// A word is (page + 1) << 4 | used: the word that leads to a page says how many of its slots are used, so one
// compare-exchange takes a slot. Slots are used from the last to the first: a page is read from the first used slot to
// its end. A thread that loses too often begins a new page and the old one stays partly used; no thread waits.

#ifndef ADS_PAGES_GLSL
#define ADS_PAGES_GLSL
// Number of attempts of a thread to get a slot of the page at the head before it begins a new page.
#define PAGE_TRIES 64u
#endif

// Returns the first used slot of the page that a word leads to, counted over all pages; valid if the word is
// not 0.
uint page_first_slot(PageRef s, uint word) {
    return ((word >> 4) - 1u) * PAGE_SIZE + PAGE_SIZE - (word & 15u);
}

// Links a page to the next one, if the page exists. It is a function of its own because the shader compiler
// does not end if `precise` values depend on memory that is written from a local variable.
void page_set_next(PageRef s, uint page, uint word) {
    if (page < PAGE_CAPACITY(s)) {
        PAGE_NEXT(s, page) = word;
    }
}

// Takes a slot for an entry of a list, counted over all pages. The slot may lie past the last page that
// exists.
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

// Returns the link of the first used slot of the page that a word leads to: its number + 1; 0 at the end of a
// list.
uint page_link(PageRef s, uint word) {
    return word >> 4 == 0u ? 0u : page_first_slot(s, word) + 1u;
}

// Returns the link of the first used slot of the page after that of a link.
uint page_link_of_next(PageRef s, uint link) {
    return page_link(s, PAGE_NEXT(s, (link - 1u) / PAGE_SIZE));
}

// Returns the link of the slot after that of a link, in its page or in the next one.
uint page_link_behind(PageRef s, uint link) {
    return link % PAGE_SIZE == 0u ? page_link_of_next(s, link) : link + 1u;
}

#undef PageRef
#undef PAGE_SIZE
#undef PAGE_LIST
#undef PAGE_NEXT
#undef PAGE_DEMAND
#undef PAGE_CAPACITY
