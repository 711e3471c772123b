#pragma once

/// Before a function that spends its time in loops over many cells: it is built for several processors, and
/// the one that the program runs on chooses when it starts. What it calls is built with it. AVX2 alone and no
/// fused multiplication, so that each build gives the same bits.
#if defined(__x86_64__) && defined(__linux__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define D2B_FOR_EACH_PROCESSOR __attribute__((target_clones("avx2", "default"), flatten))
#else
#define D2B_FOR_EACH_PROCESSOR
#endif
