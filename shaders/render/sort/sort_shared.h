// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_RENDER_SORT_SORT_SHARED_H
#define GLOAM_SHADERS_RENDER_SORT_SORT_SHARED_H

#include "shaders/common/prelude.h"

// Radix sort of 8-bit keys. The keys are divided into columns, contiguous ranges of equal length. Each column has 256
// counters, one per bin (key value).

#define GLOAM_SORT_BINS 256
#define GLOAM_SORT_RUN_THREADS 8     // threads of a workgroup of *_runs.comp, a column each
#define GLOAM_SORT_BLOCK_THREADS 64  // threads of a workgroup of *_blocks.comp; a workgroup has one column
#define GLOAM_SORT_THREAD_KEYS 64    // keys of a thread there

GLOAM_SHARED_BEGIN

/// Push constants of all passes of the sort.
struct SortConstants {
  uint count;        // of keys
  uint columns;      // columns past the last key have no keys; with runs a multiple of GLOAM_SORT_RUN_THREADS
  uint column_keys;  // a multiple of 16
};

GLOAM_SHARED_END

#endif
