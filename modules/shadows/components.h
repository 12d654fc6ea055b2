// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace gloam {

/// How a light casts shadows. A light without this component casts them, as the defaults say.
struct ShadowCaster {
  bool enabled = true;
  std::uint32_t resolution = 0;  ///< texels of one face; 0: from screen coverage
};

}  // namespace gloam
