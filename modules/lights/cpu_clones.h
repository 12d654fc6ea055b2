// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

/// Loops over lights that the compiler turns into vector code are compiled for several widths of vectors; the machine
/// picks one when the program starts. No contraction (see cmake/GloamTargets.cmake): all of them compute the same bits.
/// Sanitizers cannot watch the picking.
#if defined(__x86_64__) && defined(__linux__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define GLOAM_CPU_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define GLOAM_CPU_CLONES
#endif

/// For functions that such loops call: compiled into each of them.
#if defined(__GNUC__)
#define GLOAM_CPU_INLINE [[gnu::always_inline]] inline
#else
#define GLOAM_CPU_INLINE inline
#endif
