// The running sum across a workgroup of SCAN_THREADS threads, and what passes that scan need of a structure.
// Reads, writes: shared memory.
// Source: Sengupta et al. 2007 (sums of rows, then within rows), with one level of rows, since barriers cost
// more than additions.
// The passes include structure/scanned.glsl, in which a structure says which of its numbers they run over. A
// structure with several scans tells them apart by the step. The file defines:
//   uint scan_count(StructureRef s, uint step)                    how many numbers there are
//   uint scan_number(StructureRef s, uint step, uint i)           one of the numbers
//   void scan_set_number(StructureRef s, uint step, uint i, uint number)
//   uint scan_sum(StructureRef s, uint step, uint block)          one of ceil(scan_count / SCAN_BLOCK) sums
//   void scan_set_sum(StructureRef s, uint step, uint block, uint sum)
//   void scan_set_total(StructureRef s, uint step, uint total)    sum of all; 2^32 - 1 if it overflows
#ifndef ADS_SCAN_GLSL
#define ADS_SCAN_GLSL

#include "ads/constants.glsl"

const uint SCAN_ROWS = SCAN_THREADS / SCAN_ROW;

shared uint scan_values[SCAN_THREADS];
shared uint scan_rows[SCAN_ROWS];

// Returns the sum of `value` over the threads up to and including this one. Every thread of the workgroup
// must call it.
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

// Returns the sum over all threads. It is defined after scan_inclusive.
uint scan_total() {
    uint sum = 0u;
    for (uint row = 0u; row < SCAN_ROWS; row++) {
        sum += scan_rows[row];
    }
    return sum;
}

#endif
