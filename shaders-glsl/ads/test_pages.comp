// Appends many entries to few lists of pages at once, for tests.
// Reads: the list of each thread. Writes: the slot of each thread; words of lists, and pages.
// One invocation per entry.
#version 460
#include "contract/extensions.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = 0, scalar) readonly buffer ListBuffer { uint list_of_thread[]; };
layout(set = 0, binding = 1, scalar) buffer SlotBuffer { uint slots[]; };
// Number of pages taken, then the words of the lists, then the pages. A page is a word and PAGE_SIZE entries;
// an entry is the number of its thread plus 1.
layout(set = 0, binding = 2, scalar) buffer PageBuffer { uint words[]; };

// Numbers of threads, lists and pages. 16 bytes.
layout(push_constant, scalar) uniform PageTestConstants {
    uint thread_count;    // threads, each of which appends one entry
    uint list_count;      // lists
    uint page_size;       // entries per page
    uint page_capacity;   // pages
} pushed;

uint page_word(uint page) {
    return 1u + pushed.list_count + page * (1u + pushed.page_size);
}

#define PageRef uint
#define PAGE_SIZE pushed.page_size
#define PAGE_LIST(s, list) words[1u + (list)]
#define PAGE_NEXT(s, page) words[page_word(page)]
#define PAGE_DEMAND(s) words[0]
#define PAGE_CAPACITY(s) pushed.page_capacity
#include "ads/pages.glsl"

void main() {
    uint thread = gl_GlobalInvocationID.x;
    if (thread >= pushed.thread_count) {
        return;
    }
    uint slot = page_take_slot(0u, list_of_thread[thread]);
    slots[thread] = slot;
    uint page = slot / pushed.page_size;
    if (page < pushed.page_capacity) {
        words[page_word(page) + 1u + slot % pushed.page_size] = thread + 1u;
    }
}
