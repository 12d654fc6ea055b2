// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "engine/scene/assets.h"
#include "engine/scene/components.h"

namespace gloam {

/// Morph targets of each of a mesh's primitives (glTF: all have as many).
[[nodiscard]] std::uint32_t morph_target_count(const Mesh& mesh);

/// One instance and the mesh it draws.
struct MorphRow {
  MorphInstance* instance = nullptr;
  const Mesh* mesh = nullptr;
};

/// Gives every instance a range of its mesh's target count in `values`, in the order of the rows. Weights of an
/// instance that had a range of the right length stay as they are, others begin with the mesh's defaults. Does nothing
/// when all ranges fit and the values are as many as the ranges need together. Returns whether it changed anything.
bool lay_out_morph_weights(std::span<const MorphRow> rows, std::vector<float>& values);

}  // namespace gloam
