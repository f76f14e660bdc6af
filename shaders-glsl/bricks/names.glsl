// This structure's names for the contract's plain ones, for shaders compiled for one structure after the other.
// Reads, writes: nothing.
// No include guard: a shader with two structures includes the names of each in turn, and undefines them.
#define StructureRef BricksRef
#define STRUCTURE_NAME(name) bricks_##name
// Words of the cursor that a paused ray keeps.
#define STRUCTURE_CURSOR_WORDS 5u
