// Gives this structure's names to the contract's plain ones, for shaders that are compiled for each structure
// in turn.
// Reads, writes: nothing.
// There is no include guard: a shader with two structures includes the names of each in turn, and undefines
// them.
#define StructureRef AbufferRef
#define STRUCTURE_NAME(name) abuffer_##name
// Number of words of the cursor that a paused ray keeps.
#define STRUCTURE_CURSOR_WORDS 8u
// Hits may be on fragments: each part of a geometry is searched by itself, and the nearest of the hits is
// taken.
#define STRUCTURE_STORES_FRAGMENTS
