// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/ecs/component.h"
#include "engine/ecs/entity.h"
#include "engine/ecs/virtual_memory.h"

namespace gloam {

/// All entities that have exactly one set of components: a column of entities and one contiguous column a component,
/// row beside row. Columns reserve the address space for `max_rows` and commit pages as rows come, so they never move.
class Archetype {
 public:
  /// `components`: sorted, without duplicates, indices into `infos`. `index` numbers the archetypes of a world.
  Archetype(std::uint32_t index, std::vector<ComponentId> components, std::span<const ComponentInfo> infos,
            std::uint32_t max_rows);

  [[nodiscard]] std::uint32_t row_count() const { return rows_; }
  [[nodiscard]] const Entity* entities() const { return entities_; }
  [[nodiscard]] std::span<const ComponentId> components() const { return components_; }
  [[nodiscard]] bool has(ComponentId id) const { return data(id) != nullptr; }

  /// First byte of a component's column; null when the archetype lacks it. A tag's is not null, but has no bytes behind
  /// it. `id`: below the number of components that there were when the archetype was made, or cover_ids was told of.
  [[nodiscard]] std::byte* data(ComponentId id) const { return data_[id]; }
  void cover_ids(std::size_t component_count);

  /// Appends `count` rows and returns the first. Entities and values are the caller's to write.
  std::uint32_t push_rows(std::uint32_t count, Tick now) {
    if (count > capacity_ - rows_) grow(count);
    const std::uint32_t first = rows_;
    rows_ += count;
    stamp(row_ticks_, first, count, now);
    return first;
  }
  void set_entity(std::uint32_t row, Entity e) { entities_[row] = e; }

  /// Moves the last row into `row` and drops the last. Returns the entity that lives in `row` afterwards, or kNoEntity.
  Entity remove_row(std::uint32_t row, Tick now);

  /// The way to another archetype.
  struct Edge {
    struct Column {
      std::byte* from = nullptr;
      std::byte* to = nullptr;  ///< null where the other one lacks the component
      std::uint32_t size = 0;
    };
    Archetype* to = nullptr;
    std::vector<Column> columns;  ///< all that have bytes
  };
  /// Copies the entity and the values both archetypes have to a row of the other, and removes the row as remove_row does.
  Entity move_row(std::uint32_t row, const Edge& edge, std::uint32_t to_row, Tick now);

  /// The way to the archetype one component away: with `id` if this one lacks it, without if it has it. Null until set.
  [[nodiscard]] const Edge* edge(ComponentId id) const { return id < edges_.size() ? edges_[id].get() : nullptr; }
  const Edge& set_edge(ComponentId id, Archetype& neighbour);

  /// Stamps the blocks of a column that hold these rows. Safe from many threads at once.
  void mark_changed(ComponentId id, std::uint32_t first, std::uint32_t count, Tick now);
  /// Whether rows of a block came, moved or were marked in the column behind tick `since`.
  [[nodiscard]] bool changed(ComponentId id, std::uint32_t block, Tick since) const;
  [[nodiscard]] std::uint32_t block_count() const { return (rows_ + kTickBlockRows - 1) / kTickBlockRows; }

 private:
  struct Column {
    std::byte* data = nullptr;
    std::uint32_t size = 0;  ///< bytes a row, > 0
    ComponentId id = kNoComponent;
    ReservedMemory::Stretch stretch;
    std::vector<Tick> ticks;  ///< one a block
  };

  static void stamp(std::vector<Tick>& ticks, std::uint32_t first, std::uint32_t count, Tick now) {
    if (count == 0) return;
    const std::uint32_t last = (first + count - 1) / kTickBlockRows;
    for (std::uint32_t block = first / kTickBlockRows; block <= last; ++block) ticks[block] = now;
  }
  void grow(std::uint32_t more_rows);
  void commit(Column& column, std::uint32_t rows);

  // What access to single entities needs comes first, on one cache line.
  std::uint32_t rows_ = 0;
  std::uint32_t capacity_ = 0;  ///< rows that fit what is committed
  std::uint32_t id_end_ = 0;    ///< ids that `data_` covers
  Entity* entities_ = nullptr;
  std::unique_ptr<std::byte*[]> data_;  ///< by component id
  std::vector<Column> columns_;         ///< of components that have bytes, by ascending id
  std::vector<Tick> row_ticks_;         ///< one a block: rows came or moved
  std::vector<std::unique_ptr<Edge>> edges_;
  Column entity_column_;
  std::vector<ComponentId> components_;
  std::uint32_t max_rows_ = 0;
  ReservedMemory memory_;
};

}  // namespace gloam
