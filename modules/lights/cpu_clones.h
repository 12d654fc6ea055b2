// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

/// Attribute for loops over lights that the compiler vectorizes: compiles them for several vector widths, and the
/// program picks one at startup. Floating-point contraction is off (see cmake/GloamTargets.cmake), so all versions
/// compute the same bits. Off under sanitizers, which do not support the startup selection.
#if defined(__x86_64__) && defined(__linux__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define GLOAM_CPU_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define GLOAM_CPU_CLONES
#endif

/// For functions that these loops call: inlined, and so compiled, into each version.
#if defined(__GNUC__)
#define GLOAM_CPU_INLINE [[gnu::always_inline]] inline
#else
#define GLOAM_CPU_INLINE inline
#endif

/// Before a loop whose arrays do not overlap: the compiler need not check that before it vectorizes. Clang checks.
#if defined(__GNUC__) && !defined(__clang__)
#define GLOAM_CPU_IVDEP _Pragma("GCC ivdep")
#else
#define GLOAM_CPU_IVDEP
#endif
