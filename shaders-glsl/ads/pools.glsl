// Declarations of the header and the pools of a structure, and access to them: through the descriptors of
// STRUCTURE_SET, or (ADDRESSING_ADDRESS) through device addresses, that of the header and those that it holds. Each has
// one line in the structure's header.glsl or accessors.glsl.
// Reads, writes: nothing. Stages that only read say so (STRUCTURE_READ_ONLY), because writing from a vertex shader is a device
// feature of its own.
// `Name` and `name` are those that the structure's records and functions begin with; the other arguments are:
//   pool       its name in the header: `lists` of `lists_address`
//   view       a name for what is in a pool that does not hold words alone
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

// Declares the addresses of a structure, which are unused with descriptors.
#define STRUCTURE_HEADER(Name, name) \
    struct Name##Ref { uvec2 header; }; \
    layout(buffer_reference, scalar, buffer_reference_align = 4) POOL_ACCESS buffer Name##HeaderAddress { Name##Header header; };
// Declares a pool of words.
#define POOL_WORDS(name, pool, place)
// Declares a pool of records.
#define POOL_RECORDS(name, view, place, Record) \
    layout(buffer_reference, scalar, buffer_reference_align = 4) buffer name##_##view##_address { Record elements[]; };
// Declares a pool of records that is read as vectors of that many bytes.
#define POOL_VECTORS(name, view, place, Vector, bytes) \
    layout(buffer_reference, scalar, buffer_reference_align = bytes) readonly buffer name##_##view##_address { Vector elements[]; };

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
