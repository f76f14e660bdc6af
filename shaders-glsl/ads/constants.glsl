// Numbers that the shared build passes and their recording in Rust share. Only `#define NAME number` may stand here.
#ifndef ADS_CONSTANTS_GLSL
#define ADS_CONSTANTS_GLSL

// Numbers that one workgroup of a scan adds up, and its threads.
#define SCAN_BLOCK 1024u
#define SCAN_THREADS 256u

// In the word of a brick: it lists nothing.
#define BRICK_EMPTY 0x80000000u
// Bricks that one step over empty ones crosses at most, its own included.
#define BRICK_REACH 8u

#endif
