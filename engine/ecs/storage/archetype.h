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
#include "engine/ecs/storage/virtual_memory.h"

namespace gloam {

/// Memory of the fronts of all archetypes of a world. Entities lie apart from components: most loops read no entities,
/// and without them the components of successive archetypes are closer together, so that prefetching reaches further.
struct FrontMemory {
  explicit FrontMemory(CpuAllocator* host = nullptr) : entities(host), components(host), allocator(host) {}
  PackedMemory entities;
  PackedMemory components;
  CpuAllocator* allocator;  ///< of the rest, too; null: the system
};

/// All entities that have exactly the same set of components: one column of entities and one column per component. A
/// row is one entity, at the same index in every column.
///
/// Rows keep their place while other rows are added. The first front_rows() of them, the *front*, lie in memory shared
/// with other archetypes, so that many small archetypes fill whole pages instead of one page per column. The remaining
/// rows, the *rest*, lie in address space that each column reserves for `max_rows` rows and commits page by page. So a
/// column has at most two contiguous ranges. Rows that are added together always lie in one range: if they do not fit
/// into the front, all go to the rest.
class Archetype {
  using Bases = std::array<std::byte*, 2>;  ///< base addresses of the front and of the rest

 public:
  /// A contiguous range of rows, the front or the rest. It is one pointer to the range's table of column bases, so that
  /// an entity's values are found without reading the archetype. Null by default. Valid until cover_ids returns true.
  class Range {
   public:
    Range() = default;
    explicit operator bool() const { return table_ != nullptr; }
    [[nodiscard]] Archetype& archetype() const { return *reinterpret_cast<Archetype*>(table_[kOwner]); }
    /// As Archetype::base, for rows of this range.
    [[nodiscard]] std::byte* base(std::size_t id) const { return table_[kFirstId + id]; }

   private:
    friend class Archetype;
    // A table holds the owning archetype and then the column bases by component id, so that one load finds a column.
    static constexpr std::size_t kOwner = 0;
    static constexpr std::size_t kFirstId = 1;
    explicit Range(std::byte** table) : table_(table) {}

    std::byte** table_ = nullptr;
  };

  /// `components`: sorted, without duplicates, indices into `infos`. `index`: number of the archetype in its world.
  /// `fronts` must outlive the archetype.
  Archetype(std::uint32_t index, std::vector<ComponentId> components, std::span<const ComponentInfo> infos,
            std::uint32_t max_rows, FrontMemory& fronts);
  Archetype(const Archetype&) = delete;
  Archetype& operator=(const Archetype&) = delete;

  [[nodiscard]] std::uint32_t row_count() const { return rows_; }
  [[nodiscard]] std::span<const ComponentId> components() const { return components_; }
  /// `id`: below the number of components at construction or in the last call of cover_ids.
  [[nodiscard]] bool has(ComponentId id) const { return front(id) != nullptr; }
  /// Extends the tables to all ids below component_count. Returns true if that allocated new tables: ranges taken
  /// before are then invalid.
  bool cover_ids(std::size_t component_count);

  /// Rows with a lower index are in the front, including rows that will be added later. Changes only while the rest has
  /// no rows.
  [[nodiscard]] std::uint32_t front_rows() const { return front_rows_; }
  /// End of the contiguous range of rows that begins at `first`; at most `last`.
  [[nodiscard]] std::uint32_t range_end(std::uint32_t first, std::uint32_t last) const {
    return first < front_rows_ && last > front_rows_ ? front_rows_ : last;
  }

  /// The range that holds a row.
  [[nodiscard]] Range range(std::uint32_t row) const { return ranges_[part(row)]; }
  /// Base address of a column for rows in the same range as `row`: the value of a row is at base + row · size. Null if
  /// the archetype lacks the component. For a tag it is not null, but there are no bytes behind it. Does not change
  /// once a row was in the range.
  [[nodiscard]] std::byte* base(ComponentId id, std::uint32_t row) const { return range(row).base(id); }
  /// As base, for the rows in the front. Valid from construction on.
  [[nodiscard]] std::byte* front(ComponentId id) const { return ranges_[0].base(id); }
  /// The column of entities, to be indexed with a row in the same range as `row`.
  [[nodiscard]] Entity* entities(std::uint32_t row) const {
    return reinterpret_cast<Entity*>(entity_bases_[part(row)]);
  }

  /// Appends `count` rows, stamped with tick `now`, and returns the index of the first. The caller must write their
  /// entities and values.
  std::uint32_t push_rows(std::uint32_t count, Tick now) {
    if (rows_ <= front_rows_ || count > capacity_ - rows_) grow(count);
    const std::uint32_t first = rows_;
    rows_ += count;
    stamp(row_ticks_, first, count, now);
    return first;
  }
  void set_entity(std::uint32_t row, Entity e) { entities(row)[row] = e; }

  /// Removes `row` and moves the last row into its place. Returns the entity in `row` afterwards, or kNoEntity if `row`
  /// was the last.
  Entity remove_row(std::uint32_t row, Tick now);

  /// Precomputed data for moving rows to another archetype.
  struct Edge {
    struct Column {
      const Bases* from = nullptr;
      const Bases* to = nullptr;  ///< null if the other archetype lacks the component
      std::uint32_t size = 0;
    };
    Archetype* to = nullptr;
    std::vector<Column> columns;  ///< all columns of this archetype
  };
  /// Copies the entity and the values of components that both archetypes have to row `to_row` of edge.to, and then
  /// removes `row` as remove_row does.
  Entity move_row(std::uint32_t row, const Edge& edge, std::uint32_t to_row, Tick now);

  /// The edge to the archetype with component `id` added or, if this archetype has it, removed. Null until set_edge.
  [[nodiscard]] const Edge* edge(ComponentId id) const { return id < edges_.size() ? edges_[id].get() : nullptr; }
  const Edge& set_edge(ComponentId id, Archetype& neighbour);

  /// Stamps the blocks of a column that hold rows [first, first + count). Safe from many threads at once.
  void mark_changed(ComponentId id, std::uint32_t first, std::uint32_t count, Tick now);
  /// Whether, after tick `since`, rows of a block were added or moved, or the column was marked as changed there.
  [[nodiscard]] bool changed(ComponentId id, std::uint32_t block, Tick since) const;
  [[nodiscard]] std::uint32_t block_count() const { return (rows_ + kTickBlockRows - 1) / kTickBlockRows; }

 private:
  struct Column {
    Bases bases{};
    std::uint32_t size = 0;  ///< bytes per row, > 0
    ComponentId id = kNoComponent;
    ReservedMemory::Stretch stretch;  ///< address space of the rest
    std::vector<Tick> ticks;          ///< per block: tick of the last mark_changed
  };

  [[nodiscard]] std::size_t part(std::uint32_t row) const { return row < front_rows_ ? 0 : 1; }
  static void stamp(std::vector<Tick>& ticks, std::uint32_t first, std::uint32_t count, Tick now) {
    if (count == 0) return;
    const std::uint32_t last = (first + count - 1) / kTickBlockRows;
    for (std::uint32_t block = first / kTickBlockRows; block <= last; ++block) ticks[block] = now;
  }
  void grow(std::uint32_t more_rows);
  void reserve_columns();
  void extend_columns(std::uint32_t rows);
  void set_bases();

  std::uint32_t rows_ = 0;
  std::uint32_t capacity_ = 0;    ///< rows that fit into the memory at hand
  std::uint32_t front_rows_ = 0;  ///< ≤ front_room_
  std::uint32_t index_ = 0;
  Bases entity_bases_{};
  std::array<Range, 2> ranges_;           ///< front and reserved part
  std::unique_ptr<std::byte*[]> tables_;  ///< tables of both ranges, one after the other
  std::vector<Column> columns_;           ///< the entities, then components with bytes by ascending id; never resized
  std::vector<Tick> row_ticks_;           ///< per block: last tick at which rows were added or moved
  std::vector<std::unique_ptr<Edge>> edges_;
  std::vector<ComponentId> components_;
  std::size_t id_end_ = 0;  ///< the tables cover ids below this
  std::uint32_t front_room_ = 0;
  std::uint32_t reserved_capacity_ = 0;  ///< rows that fit into the committed part of `reserved_`
  std::uint32_t max_rows_ = 0;
  CpuAllocator* allocator_ = nullptr;
  ReservedMemory reserved_;
};

}  // namespace gloam
