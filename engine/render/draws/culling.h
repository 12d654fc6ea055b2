// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

#include "engine/render/knobs/knob_table.h"

namespace gloam {

/// Which clusters of solid surfaces are left out of a view. All values give the same picture to the bit.
enum class Culling : std::uint8_t {
  frustum,    ///< clusters outside of the view's frustum
  occlusion,  ///< hidden clusters, too
  automatic,  ///< hidden clusters, too, where the search pays
};
constexpr std::string_view name_of(Culling culling) {
  switch (culling) {
    case Culling::frustum:
      return "frustum";
    case Culling::occlusion:
      return "occlusion";
    case Culling::automatic:
      return "auto";
  }
  return {};
}

inline constexpr EnumKnob<Culling> kCulling{
    .name = "scene.culling",
    .meaning =
        "solid triangles that are left out: those outside of the view (frustum), also those that others hide "
        "(occlusion), or the latter only in views of more than 131,072 triangles where the last search has paid (auto)",
    .default_value = Culling::automatic,
    .exact = Culling::frustum,
    .same_picture = true};

}  // namespace gloam
