// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// The blades that each part of a shadow map's face may see. Without these lists every part draws every casting blade.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/render/declare/compute_pass.h"
#include "engine/render/draws/caster_source.h"
#include "modules/grass/frame.h"
#include "shaders/grass/drawing/pose_shared.h"

namespace gloam {

[[nodiscard]] ComputeProgram grass_part_casters_program();

/// Planes of a part, relative to the camera at `eye`, in units.
[[nodiscard]] shaders::GrassCasterPart caster_part(const CasterSourcePart& part, const dvec3& eye);

/// Lists of one call of CasterSource::prepare.
struct PartLists {
  std::uint32_t first = 0;  ///< index of the first part
  std::uint32_t count = 0;
  std::uint32_t room = 0;  ///< casters of each list
  BufferRef casting;       ///< a shaders::GrassCasting for each part, kPartBytes apart
  BufferRef casters;
  static constexpr std::uint64_t kPartBytes = 4 * GLOAM_GRASS_PART_WORDS;
};

/// Adds the passes that make the lists, and appends them to `lists`. most: casting blades that there can be. Returns
/// the index of the first part; CasterSourceDraw::kNoPart without lists, where they would take too much memory.
[[nodiscard]] std::uint32_t add_part_lists(FrameBuilder& frame, const DrawnBlades& blades, std::uint64_t most,
                                           std::span<const CasterSourcePart> parts, std::vector<PartLists>& lists);

/// The lists that hold a part; null if there are none.
[[nodiscard]] const PartLists* find_part(std::span<const PartLists> lists, std::uint32_t part);

}  // namespace gloam
