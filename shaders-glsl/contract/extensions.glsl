// The language extensions that every module is compiled with; entry points include this file first.
// Reads, writes: nothing.
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#ifdef ADDRESSING_ADDRESS
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#endif
#ifdef BVH_WORDS_64
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#endif
#ifdef RAY_QUERY
#extension GL_EXT_ray_query : require
#endif
