// Declares the header and the pools of a structure, and reaches them: through the descriptors of
// STRUCTURE_SET or, if ADDRESSING_ADDRESS is defined, through device addresses. The address of the header is
// in a push constant, those of the pools are in the header.
// Reads, writes: nothing.
// A structure declares its header in one line of its header.glsl, and each pool in one line of its
// accessors.glsl. Shaders that only read define STRUCTURE_READ_ONLY, because writing from a vertex shader is
// a device feature of its own.
// `Name` and `name` are what the structure's records and functions begin with. The other arguments are:
//   pool       name of the pool in the header: `lists` of `lists_address`
//   view       a name for the contents of a pool that does not only hold words
//   place      the binding
#ifndef ADS_POOLS_GLSL
#define ADS_POOLS_GLSL

#ifndef STRUCTURE_SET
#define STRUCTURE_SET 1
#endif

#ifdef STRUCTURE_READ_ONLY
#define POOL_ACCESS readonly
#else
#define POOL_ACCESS
#endif

#ifdef ADDRESSING_ADDRESS

layout(buffer_reference, scalar, buffer_reference_align = 4) POOL_ACCESS buffer WordAddress { uint words[]; };

// Declares the reference type of a structure and its header. The reference is the header's device address;
// with descriptors it is not used.
#define STRUCTURE_HEADER(Name, name) \
    struct Name##Ref { uvec2 header; }; \
    layout(buffer_reference, scalar, buffer_reference_align = 4) POOL_ACCESS buffer Name##HeaderAddress { Name##Header header; };
// Declares a pool of words.
#define POOL_WORDS(name, pool, place)
// Declares a pool of records.
#define POOL_RECORDS(name, view, place, Record) \
    layout(buffer_reference, scalar, buffer_reference_align = 4) buffer name##_##view##_address { Record elements[]; };
// Declares a pool of records that is read as vectors of `bytes` bytes each.
#define POOL_VECTORS(name, view, place, Vector, bytes) \
    layout(buffer_reference, scalar, buffer_reference_align = bytes) readonly buffer name##_##view##_address { Vector elements[]; };

// Expressions for the header, the words of a pool, and the elements of a pool that does not only hold words.
#define STRUCTURE_HEADER_OF(Name, name, s) Name##HeaderAddress(s.header).header
#define POOL_WORDS_OF(name, pool, structure_header) WordAddress(structure_header.pool##_address).words
#define POOL_VIEW_OF(name, view, address) name##_##view##_address(address).elements

#else

#define STRUCTURE_HEADER(Name, name) \
    struct Name##Ref { uvec2 header; }; \
    layout(set = STRUCTURE_SET, binding = 0, scalar) POOL_ACCESS buffer Name##HeaderBuffer { Name##Header name##_header; };
#define POOL_WORDS(name, pool, place) \
    layout(set = STRUCTURE_SET, binding = place, scalar) POOL_ACCESS buffer name##_##pool##_buffer { uint name##_##pool##_words[]; };
#define POOL_RECORDS(name, view, place, Record) \
    layout(set = STRUCTURE_SET, binding = place, scalar) buffer name##_##view##_buffer { Record name##_##view##_elements[]; };
#define POOL_VECTORS(name, view, place, Vector, bytes) \
    layout(set = STRUCTURE_SET, binding = place, scalar) readonly buffer name##_##view##_buffer { Vector name##_##view##_elements[]; };

#define STRUCTURE_HEADER_OF(Name, name, s) name##_header
#define POOL_WORDS_OF(name, pool, structure_header) name##_##pool##_words
#define POOL_VIEW_OF(name, view, address) name##_##view##_elements

#endif

#endif
