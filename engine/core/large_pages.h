// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace gloam {

/// Asks the operating system to back memory that was not touched yet with large pages, where it has such. Megabytes that are filled
/// once and read at random (textures on a device that is the CPU) spare a page fault every 4 KiB and most misses of the address
/// cache. Changes nothing else; does nothing where it is not possible.
void advise_large_pages(void* memory, std::size_t bytes);

}  // namespace gloam
