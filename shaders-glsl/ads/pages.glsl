// What: lists of pages: how an entry gets a slot in the page at the head of its list, or in a new one, without locks; and
// how a list is read.
// Reads, writes: through what the including file defines before:
//   PageRef                                                    names the structure
//   PAGE_SIZE                                                  slots a page, 1 to 8
//   uint page_list(PageRef s, uint list)                       the word of a list, 0 where it is empty
//   uint page_list_exchange(PageRef s, uint list, uint word)   atomically; the word before
//   uint page_list_replace(PageRef s, uint list, uint expected, uint word)   the same, only where it is `expected`
//   uint page_take(PageRef s)                                  the number of a new page, counted past the end
//   void page_set_next(PageRef s, uint page, uint word)        nothing where the page does not exist
//   uint page_next(PageRef s, uint page)                       the word that leads from a page to the next one
// Source: Crassin 2010; Frid Kastrati and Goswami 2017, section 3.2. Both guard a list with a spin lock.
// A word is (page + 1) << 4 | used: the word that leads to a page says how many of its slots are used, so one
// compare-exchange takes a slot. Slots are used from the last to the first: a page is read from the first used slot to
// its end. A thread that loses too often begins a page of its own and leaves the other partly used; nothing waits.
#ifndef ADS_PAGES_GLSL
#define ADS_PAGES_GLSL

// How often a thread tries to get a slot of the page at the head before it begins one.
#define PAGE_TRIES 64u

// The first used slot of the page that a word leads to, counted over all pages; valid where the word is not 0.
uint page_first_slot(uint word) {
    return ((word >> 4) - 1u) * PAGE_SIZE + PAGE_SIZE - (word & 15u);
}

// Takes a slot for an entry of a list, counted over all pages. It may lie past the last page that exists.
uint page_take_slot(PageRef s, uint list) {
    uint word = page_list(s, list);
    for (uint i = 0u; i < PAGE_TRIES && word != 0u && (word & 15u) < PAGE_SIZE; i++) {
        uint found = page_list_replace(s, list, word, word + 1u);
        if (found == word) {
            return page_first_slot(word + 1u);
        }
        word = found;
    }
    uint page = page_take(s);
    uint mine = (page + 1u) << 4 | 1u;
    page_set_next(s, page, page_list_exchange(s, list, mine));
    return page_first_slot(mine);
}

// Link of the first used slot of the page that a word leads to: its number + 1; 0 at the end of a list.
uint page_link(uint word) {
    return word >> 4 == 0u ? 0u : page_first_slot(word) + 1u;
}

// Link of the first used slot of the page behind that of a link.
uint page_link_of_next(PageRef s, uint link) {
    return page_link(page_next(s, (link - 1u) / PAGE_SIZE));
}

// Link of the slot behind that of a link, in its page or in the next one.
uint page_link_behind(PageRef s, uint link) {
    return link % PAGE_SIZE == 0u ? page_link_of_next(s, link) : link + 1u;
}

#endif
