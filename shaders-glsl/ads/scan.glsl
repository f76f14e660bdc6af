// What: the running sum across a workgroup of SCAN_THREADS threads. Passes that scan include structure/scanned.glsl, in
// which a structure says which of its numbers they run over. It defines
//   uint scan_count(StructureRef s, uint step)                    how many numbers
//   uint scan_number(StructureRef s, uint step, uint i)           one of them
//   void scan_set_number(StructureRef s, uint step, uint i, uint number)
//   uint scan_sum(StructureRef s, uint step, uint block)          one of ceil(scan_count / SCAN_BLOCK) sums
//   void scan_set_sum(StructureRef s, uint step, uint block, uint sum)
//   void scan_set_total(StructureRef s, uint step, uint total)    the sum of all, 2^32 - 1 where it exceeds 32 bits
// A structure with several scans tells them apart by the step.
// Reads, writes: shared memory.
// Source: Hillis and Steele 1986.
#ifndef ADS_SCAN_GLSL
#define ADS_SCAN_GLSL

#include "ads/constants.glsl"

shared uint scan_values[SCAN_THREADS];

// The sum of `value` over all threads up to and including this one. Every thread of the group calls it.
uint scan_inclusive(uint value) {
    uint thread = gl_LocalInvocationID.x;
    barrier();
    scan_values[thread] = value;
    barrier();
    for (uint reach = 1u; reach < SCAN_THREADS; reach *= 2u) {
        uint before = thread >= reach ? scan_values[thread - reach] : 0u;
        barrier();
        scan_values[thread] += before;
        barrier();
    }
    return scan_values[thread];
}

// The sum over all threads, after scan_inclusive.
uint scan_total() {
    return scan_values[SCAN_THREADS - 1u];
}

#endif
