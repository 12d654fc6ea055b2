// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/posing/morphing.h"

#include <algorithm>

namespace gloam {
namespace {

bool fits(const MorphRow& row, std::size_t value_count) {
  const MorphInstance& instance = *row.instance;
  return instance.count == morph_target_count(*row.mesh) && std::size_t{instance.first} + instance.count <= value_count;
}

}  // namespace

std::uint32_t morph_target_count(const Mesh& mesh) {
  return mesh.primitives.empty() ? 0 : static_cast<std::uint32_t>(mesh.primitives.front().morph_targets.size());
}

bool lay_out_morph_weights(std::span<const MorphRow> rows, std::vector<float>& values) {
  std::size_t needed = 0;
  for (const MorphRow& row : rows) needed += morph_target_count(*row.mesh);
  const bool all_fit = std::ranges::all_of(rows, [&](const MorphRow& row) { return fits(row, values.size()); });
  if (all_fit && needed == values.size()) return false;

  std::vector<float> laid_out;
  laid_out.reserve(needed);
  for (const MorphRow& row : rows) {
    const std::size_t first = laid_out.size();
    const std::uint32_t count = morph_target_count(*row.mesh);
    if (fits(row, values.size())) {
      const auto kept = std::span(values).subspan(row.instance->first, count);
      laid_out.insert(laid_out.end(), kept.begin(), kept.end());
    } else {
      const auto& defaults = row.mesh->morph_weights;
      laid_out.insert(laid_out.end(), defaults.begin(),
                      defaults.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(count, defaults.size())));
      laid_out.resize(first + count, 0.0f);
    }
    *row.instance = {.first = static_cast<std::uint32_t>(first), .count = count};
  }
  values = std::move(laid_out);
  return true;
}

}  // namespace gloam
