// The running sum across a workgroup of SCAN_THREADS threads. Passes that scan include structure/scanned.glsl, in
// which a structure says which of its numbers they run over. It defines
//   uint scan_count(StructureRef s, uint step)                    how many numbers
//   uint scan_number(StructureRef s, uint step, uint i)           one of them
//   void scan_set_number(StructureRef s, uint step, uint i, uint number)
//   uint scan_sum(StructureRef s, uint step, uint block)          one of ceil(scan_count / SCAN_BLOCK) sums
//   void scan_set_sum(StructureRef s, uint step, uint block, uint sum)
//   void scan_set_total(StructureRef s, uint step, uint total)    the sum of all, 2^32 - 1 where it exceeds 32 bits
// A structure with several scans tells them apart by the step.
// Reads, writes: shared memory.
// Source: Sengupta et al. 2007 (sums of rows, then within them), with one level of rows: barriers cost more than additions.
#ifndef ADS_SCAN_GLSL
#define ADS_SCAN_GLSL

#include "ads/constants.glsl"

const uint SCAN_ROWS = SCAN_THREADS / SCAN_ROW;

shared uint scan_values[SCAN_THREADS];
shared uint scan_rows[SCAN_ROWS];

// Returns the sum of `value` over all threads up to and including this one. Every thread of the group calls
// it.
uint scan_inclusive(uint value) {
    uint thread = gl_LocalInvocationID.x;
    barrier();
    scan_values[thread] = value;
    barrier();
    if (thread < SCAN_ROWS) {
        uint sum = 0u;
        for (uint i = 0u; i < SCAN_ROW; i++) {
            sum += scan_values[SCAN_ROW * thread + i];
        }
        scan_rows[thread] = sum;
    }
    barrier();
    uint row = thread / SCAN_ROW;
    uint sum = 0u;
    for (uint before = 0u; before < row; before++) {
        sum += scan_rows[before];
    }
    for (uint i = SCAN_ROW * row; i <= thread; i++) {
        sum += scan_values[i];
    }
    return sum;
}

// Returns the sum over all threads, after scan_inclusive.
uint scan_total() {
    uint sum = 0u;
    for (uint row = 0u; row < SCAN_ROWS; row++) {
        sum += scan_rows[row];
    }
    return sum;
}

#endif
