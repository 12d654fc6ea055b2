// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/ecs/component.h"
#include "engine/ecs/storage/archetype.h"

namespace gloam {

/// The terms of a view, as component ids.
struct QueryTerms {
  std::vector<ComponentId> columns;   ///< passed to the view's functions, in order; a match may lack some
  std::vector<ComponentId> required;  ///< every match has these
  std::vector<ComponentId> excluded;  ///< no match has any of these
};

/// The archetypes that match a view, found once and extended when archetypes are added. Archetypes and the fronts of
/// their columns never move, so a match keeps plain pointers.
class Query {
 public:
  explicit Query(QueryTerms terms) : terms_(std::move(terms)) {}

  [[nodiscard]] const QueryTerms& terms() const { return terms_; }
  [[nodiscard]] bool accepts(const Archetype& archetype) const;

  [[nodiscard]] std::size_t match_count() const { return matches_.size(); }
  [[nodiscard]] Archetype& match(std::size_t i) const { return *matches_[i]; }
  /// Returns one pointer per term of `columns`, for rows in the same range as `row`, as Archetype::base gives them;
  /// null where the match lacks the term. `storage` must have room for one pointer per term; the result may point into
  /// it.
  [[nodiscard]] std::byte* const* match_columns(std::size_t i, std::uint32_t row, std::byte** storage) const {
    if (row < matches_[i]->front_rows()) return fronts_.data() + i * terms_.columns.size();
    for (std::size_t term = 0; term < terms_.columns.size(); ++term)
      storage[term] = matches_[i]->base(terms_.columns[term], row);
    return storage;
  }
  [[nodiscard]] std::size_t row_count() const;

  /// Number of archetypes examined so far.
  [[nodiscard]] std::size_t seen() const { return seen_.load(std::memory_order_acquire); }
  void extend(std::span<const std::unique_ptr<Archetype>> archetypes);

 private:
  QueryTerms terms_;
  std::vector<Archetype*> matches_;
  std::vector<std::byte*> fronts_;  ///< terms_.columns.size() pointers per match
  std::atomic<std::size_t> seen_ = 0;
};

/// Rows [first, first + count) of one match, a contiguous range.
struct ViewChunk {
  std::uint32_t match = 0;
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

/// The rows of a query, split for parallel work. Depends only on the world and the grain.
struct ChunkPlan {
  std::vector<ViewChunk> chunks;
  /// Job i runs chunks [job_ends[i - 1], job_ends[i]), about a grain of rows, so that many small archetypes make few
  /// jobs.
  std::vector<std::uint32_t> job_ends;
};

/// grain_rows ≥ 1: greatest number of rows per chunk.
[[nodiscard]] ChunkPlan plan_chunks(const Query& query, std::size_t grain_rows);
/// Number of chunks in plan_chunks(query, grain_rows).
[[nodiscard]] std::size_t count_chunks(const Query& query, std::size_t grain_rows);

}  // namespace gloam
