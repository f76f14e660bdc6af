// Puts fragments into the list of a cell and reads such a list, in each of three storages.
// Reads, writes: lists, fragments, header.demand, header.fragments, header.corrupted.
// Source: Hu et al. section 3.1, linked lists in one pass; Frid Kastrati and Goswami section 3.2, pages of
// several fragments.
//
// Each list has one word in the pool of lists:
// - Contiguous: at first the length of the list. The scan turns it into the place of the list's next
//   fragment. Once all fragments are stored, it is the end of the list, and the list begins where the one
//   before it ends.
// - Linked: the link of the fragment that was stored last.
// - Paged: the word that leads to the page that was begun last.
// A link is a place + 1, and 0 is no place.
#ifndef VOXEL_LISTS_GLSL
#define VOXEL_LISTS_GLSL

#include "voxel/list_pages.glsl"

// Value that stands for no place.
#define VOXEL_NO_PLACE 0xFFFFFFFFu

// Adds one to the length of a contiguous list.
void voxel_list_count_one(VoxelRef s, uint list) {
    atomicAdd(VOXEL_POOL(s, lists)[list], 1u);
}

// Takes a place for a fragment of a list. Beyond the capacity the fragment is only counted, and the result is
// VOXEL_NO_PLACE.
uint voxel_allocate(VoxelRef s, uint list) {
    uint capacity = VOXEL_HEADER(s).capacity;
    if (voxel_paged()) {
        atomicAdd(VOXEL_HEADER(s).fragments, 1u);
        uint slot = page_take_slot(s, list);
        return slot / VOXEL_PAGE < capacity ? slot : VOXEL_NO_PLACE;
    }
    uint place = voxel_contiguous() ? atomicAdd(VOXEL_POOL(s, lists)[list], 1u) : atomicAdd(VOXEL_HEADER(s).demand, 1u);
    return place < capacity ? place : VOXEL_NO_PLACE;
}

// Puts a place at the front of its list, if fragments are linked.
void voxel_link(VoxelRef s, uint list, uint place) {
    if (!voxel_contiguous() && !voxel_paged()) {
        voxel_set_word(s, place, voxel_stride(), atomicExchange(VOXEL_POOL(s, lists)[list], place + 1u));
    }
}

// Returns the places at which the fragments of a contiguous list begin and end. A list that reaches beyond
// the pool is counted as corrupted and treated as empty.
uvec2 voxel_list(VoxelRef s, uint list) {
    if (list >= voxel_list_count(s)) {
        return uvec2(0u);
    }
    uint begin = list == 0u ? 0u : VOXEL_POOL(s, lists)[list - 1u];
    uint end = VOXEL_POOL(s, lists)[list];
    if (begin > end || end > voxel_stored(s)) {
        atomicAdd(VOXEL_HEADER(s).corrupted, 1u);
        return uvec2(0u);
    }
    return uvec2(begin, end);
}

// Cursor of a list that is being read. A linked or paged list that is damaged may be a cycle, for which
// `mark` and the members below it watch.
struct VoxelCursor {
    uint link;            // link of the next fragment; 0 at the end
    uint last;            // link of the fragment that ends the list; contiguous only
    uint mark;            // a link that was passed; linked and paged only
    uint left;            // links until the mark moves on
    uint reach;           // links between the last two moves of the mark
};

// Returns a cursor that goes on at a link of a list.
VoxelCursor voxel_list_resume(VoxelRef s, uint list, uint link) {
    return VoxelCursor(link, voxel_contiguous() ? voxel_list(s, list).y : 0u, link, 1u, 1u);
}

// Returns a cursor at the beginning of a list.
VoxelCursor voxel_list_begin(VoxelRef s, uint list) {
    if (voxel_contiguous()) {
        uvec2 range = voxel_list(s, list);
        return VoxelCursor(range.x < range.y ? range.x + 1u : 0u, range.y, 0u, 0u, 0u);
    }
    uint word = list < voxel_list_count(s) ? VOXEL_POOL(s, lists)[list] : 0u;
    return voxel_list_resume(s, list, voxel_paged() ? page_link(s, word) : word);
}

// Ends a list that returns to the cursor's mark, and counts it as corrupted. The mark moves on after twice as
// many links each time (Brent 1980), so a cycle is found within three times its links.
void voxel_list_guard(VoxelRef s, inout VoxelCursor cursor) {
    if (cursor.link == cursor.mark) {
        atomicAdd(VOXEL_HEADER(s).corrupted, 1u);
        cursor.link = 0u;
    } else if (--cursor.left == 0u) {
        cursor.mark = cursor.link;
        cursor.reach *= 2u;
        cursor.left = cursor.reach;
    }
}

// Returns the place of the next fragment of a list that has not ended. A link beyond the pool is counted as
// corrupted, ends the list and gives VOXEL_NO_PLACE.
uint voxel_list_next(VoxelRef s, inout VoxelCursor cursor) {
    uint place = cursor.link - 1u;
    if (place >= voxel_stored(s)) {
        atomicAdd(VOXEL_HEADER(s).corrupted, 1u);
        cursor.link = 0u;
        return VOXEL_NO_PLACE;
    }
    if (voxel_contiguous()) {
        cursor.link = cursor.link < cursor.last ? cursor.link + 1u : 0u;
        return place;
    }
    cursor.link = voxel_paged() ? page_link_behind(s, cursor.link) : voxel_word(s, place, voxel_stride());
    voxel_list_guard(s, cursor);
    return place;
}

#endif
