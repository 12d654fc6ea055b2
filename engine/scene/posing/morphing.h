// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "engine/scene/assets.h"
#include "engine/scene/components.h"

namespace gloam {

/// Number of morph targets of a mesh (glTF: the same for each of its primitives).
[[nodiscard]] std::uint32_t morph_target_count(const Mesh& mesh);

/// One instance and the mesh it draws.
struct MorphRow {
  MorphInstance* instance = nullptr;
  const Mesh* mesh = nullptr;
};

/// Gives every instance a range in `values` as long as its mesh's target count, in the order of the rows. An instance
/// that already has a range of the right length keeps its weights; others start with the mesh's defaults. Does nothing
/// if all ranges fit and `values` is exactly as long as all ranges together. Returns whether anything changed.
bool lay_out_morph_weights(std::span<const MorphRow> rows, std::vector<float>& values);

}  // namespace gloam
