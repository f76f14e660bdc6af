// Hashes four words to four pseudo-random words, with equal results on every device.
// Reads, writes: nothing.
// Source: pcg4d of Jarzynski and Olano, "Hash functions for GPU rendering", JCGT 9(3), 2020.
#ifndef CONTRACT_RANDOM_WORDS_GLSL
#define CONTRACT_RANDOM_WORDS_GLSL

uvec4 random_words(uvec4 key) {
    key = key * 1664525u + 1013904223u;
    key.x += key.y * key.w;
    key.y += key.z * key.x;
    key.z += key.x * key.y;
    key.w += key.y * key.z;
    key ^= key >> 16;
    key.x += key.y * key.w;
    key.y += key.z * key.x;
    key.z += key.x * key.y;
    key.w += key.y * key.z;
    return key;
}

// Returns a random number in [0, 1) from the upper 24 bits of a word: a multiple of 2^-24, exact in f32.
float random_unit(uint bits) { return float(bits >> 8) * (1.0 / 16777216.0); }

#endif
