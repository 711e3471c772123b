#pragma once

/// Compiles a function for several processors, of which the fastest supported one is chosen at load time;
/// functions inlined into it are included. For functions that spend their time in loops over many cells. Only
/// AVX2, without fused multiply-add, so that all variants give identical bits. Not without optimisation,
/// because it would be of no use, and the link-time optimiser takes variants for second definitions. Only on
/// Linux, because the choice is made by its loader.
#if defined(__x86_64__) && defined(__linux__) && defined(__GNUC__) && !defined(__clang__) && \
    defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define D2B_MULTIVERSION __attribute__((target_clones("avx2", "default"), flatten))
#else
#define D2B_MULTIVERSION
#endif
