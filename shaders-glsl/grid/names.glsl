// The names by which files for any structure (`structure/...`) reach this one: its reference type and its
// prefix.
// Reads, writes: nothing.
// There is no include guard: a shader with two structures includes the names of the first, undefines them,
// and includes those of the second.
#define StructureRef GridRef
#define STRUCTURE_NAME(name) grid_##name
// Number of words of TraceState.cursor that a paused ray keeps.
#define STRUCTURE_CURSOR_WORDS 4u
