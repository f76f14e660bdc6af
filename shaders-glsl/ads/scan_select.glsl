// What: the one place that says which numbers of a structure a scan runs over. A structure that scans has a file
// scanned.glsl that defines ScanRef and
//   uint scan_count(ScanRef s, uint step)                    how many numbers
//   uint scan_number(ScanRef s, uint step, uint i)           one of them
//   void scan_set_number(ScanRef s, uint step, uint i, uint number)
//   uint scan_sum(ScanRef s, uint step, uint block)          one of ceil(scan_count / SCAN_BLOCK) sums
//   void scan_set_sum(ScanRef s, uint step, uint block, uint sum)
//   void scan_set_total(ScanRef s, uint step, uint total)    the sum of all, 2^32 - 1 where it exceeds 32 bits
// A structure with several scans tells them apart by the step.
// Reads, writes: see the structure.
#ifndef ADS_SCAN_SELECT_GLSL
#define ADS_SCAN_SELECT_GLSL

#include "contract/structures.glsl"
#include "ads/scan.glsl"

#if STRUCTURE == STRUCTURE_PRIMITIVE
#include "primitive/scanned.glsl"
#elif STRUCTURE == STRUCTURE_ABUFFER
#include "abuffer/scanned.glsl"
#elif STRUCTURE == STRUCTURE_BVH
#include "bvh/scanned.glsl"
#elif STRUCTURE == STRUCTURE_VOXEL
#include "voxel/scanned.glsl"
#elif STRUCTURE == STRUCTURE_LDC
#include "ldc/scanned.glsl"
#else
#error "STRUCTURE names no structure that scans: add it to ads/scan_select.glsl"
#endif

#endif
