// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/ecs/storage/query.h"

#include <algorithm>

#include "engine/core/assert.h"

namespace gloam {
namespace {

std::size_t ranges_of(std::size_t rows, std::size_t grain) { return rows / grain + (rows % grain != 0 ? 1 : 0); }

}  // namespace

bool Query::accepts(const Archetype& archetype) const {
  const auto has = [&](ComponentId id) { return archetype.has(id); };
  return std::ranges::all_of(terms_.required, has) && std::ranges::none_of(terms_.excluded, has);
}

std::size_t Query::row_count() const {
  std::size_t rows = 0;
  for (const Archetype* archetype : matches_) rows += archetype->row_count();
  return rows;
}

void Query::extend(std::span<const std::unique_ptr<Archetype>> archetypes) {
  for (std::size_t i = seen(); i < archetypes.size(); ++i) {
    Archetype& archetype = *archetypes[i];
    if (!accepts(archetype)) continue;
    matches_.push_back(&archetype);
    for (const ComponentId id : terms_.columns) fronts_.push_back(archetype.front(id));
  }
  seen_.store(archetypes.size(), std::memory_order_release);
}

ChunkPlan plan_chunks(const Query& query, std::size_t grain_rows) {
  GLOAM_ASSERT(grain_rows >= 1, "a parallel range has at least one row");
  ChunkPlan plan;
  std::size_t job_rows = 0;
  for (std::uint32_t match = 0; match < query.match_count(); ++match) {
    const Archetype& archetype = query.match(match);
    const std::uint32_t rows = archetype.row_count();
    for (std::uint32_t first = 0, end = 0; first < rows; first = end) {
      end = archetype.range_end(first,
                                static_cast<std::uint32_t>(first + std::min<std::size_t>(grain_rows, rows - first)));
      plan.chunks.push_back({match, first, end - first});
      job_rows += end - first;
      if (job_rows < grain_rows) continue;
      plan.job_ends.push_back(static_cast<std::uint32_t>(plan.chunks.size()));
      job_rows = 0;
    }
  }
  if (job_rows > 0) plan.job_ends.push_back(static_cast<std::uint32_t>(plan.chunks.size()));
  return plan;
}

std::size_t count_chunks(const Query& query, std::size_t grain_rows) {
  GLOAM_ASSERT(grain_rows >= 1, "a parallel range has at least one row");
  std::size_t chunks = 0;
  for (std::size_t match = 0; match < query.match_count(); ++match) {
    const Archetype& archetype = query.match(match);
    const std::size_t rows = archetype.row_count();
    const std::size_t front = std::min<std::size_t>(archetype.front_rows(), rows);
    chunks += ranges_of(front, grain_rows) + ranges_of(rows - front, grain_rows);
  }
  return chunks;
}

}  // namespace gloam
