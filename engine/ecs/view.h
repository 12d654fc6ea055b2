// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "engine/core/assert.h"
#include "engine/ecs/storage/query.h"
#include "engine/ecs/view_terms.h"
#include "engine/ecs/world.h"
#include "engine/jobs/executor.h"

namespace gloam {

/// All entities that match the terms of the view, e.g. `View<const Velocity, Position, Without<Frozen>>`. A const
/// component is only read. A view is two pointers: copy it freely and construct it on any thread. It stays valid as
/// long as its world and includes entities created later.
///
/// each, each_chunk and parallel_… visit every row once, changed_since at most once. The serial functions visit
/// archetypes in order of creation and rows in order. A structural change during a call asserts. Spans are valid until
/// the next structural change. While a view iterates, nothing may write its const components, not even its own
/// function: the compiler relies on it (see ViewTerm).
template <class... Args>
class View {
 public:
  static constexpr bool kReadsOnly = !(detail::ViewTerm<Args>::kWrites || ...);

  explicit View(World& world) : View(world, 0) {}
  explicit View(const World& world) requires(kReadsOnly) : View(world, 0) {}

  /// Calls f([Entity,] A&, const B&, …) for every row, with one argument per column; a pointer for Maybe.
  template <class F>
  void each(F&& f) const {
    const Iteration iteration(*this);
    for (std::size_t m = 0; m < query_->match_count(); ++m) rows(f, m, 0, query_->match(m).row_count(), kColumns);
  }

  /// Calls f([span<const Entity>,] span<A>, span<const B>, …) for every contiguous range of rows. An archetype has one
  /// or two (its front and the rest; see archetype.h). An absent Maybe is an empty span.
  template <class F>
  void each_chunk(F&& f) const {
    const Iteration iteration(*this);
    for (std::size_t m = 0; m < query_->match_count(); ++m) chunks(f, m, 0, query_->match(m).row_count(), kColumns);
  }

  /// As each, from many threads at once, with about grain_rows (≥ 1) rows per job. Every row is visited once.
  template <class F>
  void parallel_each(JobExecutor& executor, std::size_t grain_rows, F&& f) const {
    parallel(executor, grain_rows,
             [&](std::size_t, const ViewChunk& c) { rows(f, c.match, c.first, c.first + c.count, kColumns); });
  }

  /// Calls f(ordinal, [span<const Entity>,] spans…) for contiguous ranges of at most grain_rows (≥ 1) rows, from many
  /// threads at once. Ordinals number the ranges from 0 to chunk_count(grain_rows) - 1 in the order in which each()
  /// would visit them.
  template <class F>
  void parallel_chunks(JobExecutor& executor, std::size_t grain_rows, F&& f) const {
    parallel(executor, grain_rows,
             [&](std::size_t ordinal, const ViewChunk& c) { numbered_chunk(f, ordinal, c, kColumns); });
  }

  /// Number of calls that parallel_chunks makes with this grain, e.g. to allocate one result per range.
  [[nodiscard]] std::size_t chunk_count(std::size_t grain_rows) const {
    world_->refresh(*query_);
    return count_chunks(*query_, grain_rows);
  }

  /// Number of rows in all matches.
  [[nodiscard]] std::size_t size() const {
    world_->refresh(*query_);
    return query_->row_count();
  }
  [[nodiscard]] bool empty() const { return size() == 0; }

  /// Whether `e` is alive and matches the view.
  [[nodiscard]] bool contains(Entity e) const {
    return world_->alive(e) && query_->accepts(world_->records_[e.index].range.archetype());
  }

  /// Pointer to the T of `e`, const if the view's term is const. Null unless `e` is alive, matches the view and has a
  /// T.
  template <class T>
  [[nodiscard]] auto try_get(Entity e) const {
    using Component = std::remove_const_t<T>;
    using Find = detail::FindColumn<Component, Columns>;
    using Pointer = decltype(Find::value_pointer());
    const ComponentId id = query_->terms().columns[Find::index()];
    world_->check_component(id, kWrites<Component>);
    if (!contains(e)) return Pointer(nullptr);
    return Pointer(world_->template cell_at<Component>(world_->records_[e.index], id));
  }

  /// Marks all blocks of column T, which the view must write, as changed.
  template <class T>
  void mark_changed() const {
    const ComponentId id = writable_column<T>();
    world_->refresh(*query_);
    for (std::size_t m = 0; m < query_->match_count(); ++m) {
      Archetype& archetype = query_->match(m);
      if (archetype.has(id)) archetype.mark_changed(id, 0, archetype.row_count(), world_->tick());
    }
  }
  /// Marks the blocks of a range of rows as changed. `range`: the entities that a chunk function received, or a
  /// contiguous part of them. Safe from many threads at once.
  template <class T>
  void mark_changed(std::span<const Entity> range) const {
    const ComponentId id = writable_column<T>();
    if (range.empty()) return;
    const World::Record& record = world_->living(range.front());
    GLOAM_ASSERT(record.range.archetype().entities(record.row) + record.row == range.data(),
                 "changes are marked on a range of a view's own entities");
    record.range.archetype().mark_changed(id, record.row, static_cast<std::uint32_t>(range.size()), world_->tick());
  }
  /// Marks the block that holds `e`, which must be alive and have a T, as changed.
  template <class T>
  void mark_changed(Entity e) const {
    const ComponentId id = writable_column<T>();
    const World::Record& record = world_->living(e);
    GLOAM_ASSERT(record.range.archetype().has(id), "changes are marked on entities that have the component");
    record.range.archetype().mark_changed(id, record.row, 1, world_->tick());
  }

  /// Calls f as each_chunk does, but only on runs of blocks (4,096 rows) in which, after tick `since`, rows were added
  /// or moved or T was marked as changed. Returns the tick to pass next time; 0 reports everything. Removed rows are
  /// not reported.
  template <class T, class F>
  Tick changed_since(Tick since, F&& f) const {
    const Iteration iteration(*this);
    const Tick seen = world_->advance_tick();
    const ComponentId id = query_->terms().columns[detail::FindColumn<std::remove_const_t<T>, Columns>::index()];
    for (std::size_t m = 0; m < query_->match_count(); ++m) {
      const Archetype& archetype = query_->match(m);
      if (!archetype.has(id)) continue;
      for (std::uint32_t block = 0; block < archetype.block_count(); ++block) {
        if (!archetype.changed(id, block, since)) continue;
        const std::uint32_t first = block * kTickBlockRows;
        while (block + 1 < archetype.block_count() && archetype.changed(id, block + 1, since)) ++block;
        const std::uint32_t last = std::min((block + 1) * kTickBlockRows, archetype.row_count());
        chunks(f, m, first, last, kColumns);
      }
    }
    return seen;
  }

 private:
  using Columns = detail::ColumnArguments<Args...>;
  static constexpr Columns kColumns{};
  template <class T>
  static constexpr bool kWrites =
      !std::is_const_v<std::remove_pointer_t<decltype(detail::FindColumn<T, Columns>::value_pointer())>>;

  /// During its lifetime a structural change asserts.
  class Iteration {
   public:
    explicit Iteration(const View& view) : world_(*view.world_) {
      view.check_access(kColumns);
      world_.refresh(*view.query_);
      world_.iterations_.fetch_add(1, std::memory_order_relaxed);
    }
    ~Iteration() { world_.iterations_.fetch_sub(1, std::memory_order_relaxed); }
    Iteration(const Iteration&) = delete;
    Iteration& operator=(const Iteration&) = delete;

   private:
    const World& world_;
  };

  View(const World& world, int) : world_(&world), query_(world.find_query(type_key<View>())) {
    if (query_ != nullptr) return;
    QueryTerms terms;
    (detail::ViewTerm<Args>::describe(world, terms), ...);
    query_ = world.add_query(type_key<View>(), std::move(terms));
  }

  template <class... Cs>
  void check_access(TypeList<Cs...>) const {
    std::size_t column = 0;
    (world_->check_component(query_->terms().columns[column++], detail::ViewTerm<Cs>::kWrites), ...);
    static_cast<void>(column);
  }
  template <class T>
  [[nodiscard]] ComponentId writable_column() const {
    static_assert(kWrites<T>, "only what a view may write can be marked as changed");
    const ComponentId id = query_->terms().columns[detail::FindColumn<T, Columns>::index()];
    world_->check_component(id, true);
    return id;
  }

  /// Calls use(first, end, entities, cursor of each column …) for each contiguous range within rows [first, last) of
  /// match m. Entities and cursors are indexed by row.
  template <class Use, class... Cs>
  void for_ranges(std::size_t m, std::uint32_t first, std::uint32_t last, Use&& use, TypeList<Cs...>) const {
    const Archetype& archetype = query_->match(m);
    std::array<std::byte*, sizeof...(Cs) + 1> storage{};
    while (first < last) {
      const std::uint32_t end = archetype.range_end(first, last);
      std::byte* const* columns = query_->match_columns(m, first, storage.data());
      [&]<std::size_t... I>(std::index_sequence<I...>) {
        use(first, end, archetype.entities(first), detail::ViewTerm<Cs>::cursor(columns[I])...);
      }
      (std::index_sequence_for<Cs...>{});
      static_cast<void>(columns);
      first = end;
    }
  }
  template <class F, class... Cs>
  void rows(F& f, std::size_t m, std::uint32_t first, std::uint32_t last, TypeList<Cs...> list) const {
    for_ranges(
        m, first, last,
        [&](std::size_t begin, std::size_t end, const Entity* entities, auto... cursors) {
          detail::call_rows<Cs...>(f, entities, begin, end, cursors...);
        },
        list);
  }
  template <class F>
  void chunks(F& f, std::size_t m, std::uint32_t first, std::uint32_t last, Columns list) const {
    for_ranges(
        m, first, last,
        [&](std::size_t begin, std::size_t end, const Entity* entities, auto... cursors) {
          detail::call_chunk(f, std::span<const Entity>(entities + begin, end - begin),
                             detail::chunk_span(cursors, begin, end - begin)...);
        },
        list);
  }
  template <class F>
  void numbered_chunk(F& f, std::size_t ordinal, const ViewChunk& c, Columns list) const {
    for_ranges(
        c.match, c.first, c.first + c.count,
        [&](std::size_t begin, std::size_t end, const Entity* entities, auto... cursors) {
          detail::call_numbered_chunk(f, ordinal, std::span<const Entity>(entities + begin, end - begin),
                                      detail::chunk_span(cursors, begin, end - begin)...);
        },
        list);
  }
  template <class Body>
  void parallel(JobExecutor& executor, std::size_t grain_rows, const Body& body) const {
    const Iteration iteration(*this);
    const ChunkPlan plan = plan_chunks(*query_, grain_rows);
    executor.parallel_for(plan.job_ends.size(), 1, [&](JobRange range) {
      for (std::size_t job = range.begin; job < range.end; ++job) {
        const std::size_t begin = job == 0 ? 0 : plan.job_ends[job - 1];
        for (std::size_t c = begin; c < plan.job_ends[job]; ++c) body(c, plan.chunks[c]);
      }
    });
  }

  const World* world_;
  Query* query_;
};

}  // namespace gloam
