// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/ecs/component.h"
#include "engine/ecs/entity.h"
#include "engine/ecs/virtual_memory.h"

namespace gloam {

/// All entities that have exactly one set of components: a column of entities and a column a component, row beside row.
///
/// Rows never move while others come. The first front_rows() of them lie in a piece of memory shared with other
/// archetypes, so that many small archetypes fill pages and not each a page a column. What follows lies in address
/// space that each column has for itself, reserved for `max_rows` and filled by pages. So a column is contiguous but
/// for one joint. Rows that come at once are never torn: those that do not fit the front lie behind it.
class Archetype {
  using Bases = std::array<std::byte*, 2>;  ///< of the front and of the rest

 public:
  /// A contiguous range of rows, the front or the rest: one pointer to a table that leads from an entity to its values
  /// without asking the archetype. Null by default. Valid until cover_ids tells otherwise.
  class Range {
   public:
    Range() = default;
    explicit operator bool() const { return table_ != nullptr; }
    [[nodiscard]] Archetype& archetype() const { return *reinterpret_cast<Archetype*>(table_[kOwner]); }
    /// As Archetype::base, for the rows of this range.
    [[nodiscard]] std::byte* base(std::size_t id) const { return table_[kFirstId + id]; }

   private:
    friend class Archetype;
    // A table holds its owner and then the bases by component id, so that one load finds a column.
    static constexpr std::size_t kOwner = 0;
    static constexpr std::size_t kFirstId = 1;
    explicit Range(std::byte** table) : table_(table) {}

    std::byte** table_ = nullptr;
  };

  /// `components`: sorted, without duplicates, indices into `infos`. `index` numbers the archetypes of a world.
  /// `fronts` outlives the archetype.
  Archetype(std::uint32_t index, std::vector<ComponentId> components, std::span<const ComponentInfo> infos,
            std::uint32_t max_rows, PackedMemory& fronts);
  Archetype(const Archetype&) = delete;
  Archetype& operator=(const Archetype&) = delete;

  [[nodiscard]] std::uint32_t row_count() const { return rows_; }
  [[nodiscard]] std::span<const ComponentId> components() const { return components_; }
  /// `id`: below the number of components that there were when the archetype was made, or cover_ids was told of.
  [[nodiscard]] bool has(ComponentId id) const { return front(id) != nullptr; }
  /// Whether that took new tables: ranges taken before are no longer valid.
  bool cover_ids(std::size_t component_count);

  /// Rows below this are in the front, or will be. Changes only while no row lies behind it.
  [[nodiscard]] std::uint32_t front_rows() const { return front_rows_; }
  /// End of the contiguous range of rows that begins at `first` and ends at `last` at the latest.
  [[nodiscard]] std::uint32_t range_end(std::uint32_t first, std::uint32_t last) const {
    return first < front_rows_ && last > front_rows_ ? front_rows_ : last;
  }

  /// The range that holds a row.
  [[nodiscard]] Range range(std::uint32_t row) const { return ranges_[part(row)]; }
  /// What to add row · size to, for rows in the same range as `row`; null when the archetype lacks the component. A
  /// tag's is not null, but has no bytes behind it. Stays the same once there was a row in the range.
  [[nodiscard]] std::byte* base(ComponentId id, std::uint32_t row) const { return range(row).base(id); }
  /// The same for rows in the front; is there from the beginning.
  [[nodiscard]] std::byte* front(ComponentId id) const { return ranges_[0].base(id); }
  /// What to index with a row in the same range as `row`.
  [[nodiscard]] Entity* entities(std::uint32_t row) const {
    return reinterpret_cast<Entity*>(entity_bases_[part(row)]);
  }

  /// Appends `count` rows and returns the first. Entities and values are the caller's to write.
  std::uint32_t push_rows(std::uint32_t count, Tick now) {
    if (rows_ <= front_rows_ || count > capacity_ - rows_) grow(count);
    const std::uint32_t first = rows_;
    rows_ += count;
    stamp(row_ticks_, first, count, now);
    return first;
  }
  void set_entity(std::uint32_t row, Entity e) { entities(row)[row] = e; }

  /// Moves the last row into `row` and drops the last. Returns the entity that lives in `row` afterwards, or kNoEntity.
  Entity remove_row(std::uint32_t row, Tick now);

  /// The way to another archetype.
  struct Edge {
    struct Column {
      const Bases* from = nullptr;
      const Bases* to = nullptr;  ///< null where the other one lacks the component
      std::uint32_t size = 0;
    };
    Archetype* to = nullptr;
    std::vector<Column> columns;  ///< all that have bytes
  };
  /// Copies the entity and the values both archetypes have to a row of the other, and removes the row as remove_row
  /// does.
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
    Bases bases{};
    std::uint32_t size = 0;  ///< bytes a row, > 0
    ComponentId id = kNoComponent;
    ReservedMemory::Stretch stretch;  ///< of the rest
    std::vector<Tick> ticks;          ///< one a block
  };

  [[nodiscard]] std::size_t part(std::uint32_t row) const { return row < front_rows_ ? 0 : 1; }
  static void stamp(std::vector<Tick>& ticks, std::uint32_t first, std::uint32_t count, Tick now) {
    if (count == 0) return;
    const std::uint32_t last = (first + count - 1) / kTickBlockRows;
    for (std::uint32_t block = first / kTickBlockRows; block <= last; ++block) ticks[block] = now;
  }
  void grow(std::uint32_t more_rows);
  void reserve_rest();
  void extend_rest(std::uint32_t rows);
  void set_bases();

  std::uint32_t rows_ = 0;
  std::uint32_t capacity_ = 0;    ///< rows that fit what is there
  std::uint32_t front_rows_ = 0;  ///< ≤ front_room_
  std::uint32_t index_ = 0;
  Bases entity_bases_{};
  std::array<Range, 2> ranges_;           ///< front and rest
  std::unique_ptr<std::byte*[]> tables_;  ///< of both ranges, one after the other
  std::vector<Column> columns_;  ///< the entities, and components that have bytes by ascending id; stays as it was made
  std::vector<Tick> row_ticks_;  ///< one a block: rows came or moved
  std::vector<std::unique_ptr<Edge>> edges_;
  std::vector<ComponentId> components_;
  std::size_t id_end_ = 0;  ///< ids that the tables cover
  std::uint32_t front_room_ = 0;
  std::uint32_t rest_capacity_ = 0;  ///< rows that fit what is committed of the rest
  std::uint32_t max_rows_ = 0;
  ReservedMemory rest_;
};

}  // namespace gloam
