// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "engine/core/assert.h"
#include "engine/ecs/access_checker.h"
#include "engine/ecs/component.h"
#include "engine/ecs/entity.h"
#include "engine/ecs/resources.h"
#include "engine/ecs/storage/archetype.h"
#include "engine/ecs/storage/query.h"
#include "engine/ecs/storage/virtual_memory.h"
#include "engine/ecs/type_key.h"
#include "engine/ecs/type_table.h"

namespace gloam {

template <class... Args>
class View;

/// Sizes of the address space to reserve; only the part in use takes memory. Exceeding a limit asserts.
struct WorldLimits {
  std::uint32_t max_rows_per_archetype = 1u << 23;
  std::uint32_t max_entities = 1u << 26;
  /// Gives the memory of components and of the entity table, in place of address space of the system; must outlive the
  /// world. What the limits above allow is then allocated at once: the entity table with the world, the columns of an
  /// archetype when it outgrows its first rows. So lower the limits.
  CpuAllocator* allocator = nullptr;
};

/// Entities, their components, and resources. Two worlds share nothing.
///
/// Rules:
/// - A component type must be registered before any other use. Ids follow the order of registration.
/// - A *structural change* is create, destroy, add or remove. It must not happen while a view iterates (asserted):
///   record it in a CommandBuffer instead. During a structural change no other thread may use the world.
/// - References and spans to components stay valid while entities are created, because rows keep their place. They
///   become invalid when their entity is destroyed or gains or loses a component, and also when this happens to another
/// entity with the same set of components (the last row moves into the freed row).
/// - References to resources stay valid until the resource is removed; setting it again assigns in place.
/// - Between structural changes any number of threads may read, construct and iterate views, and write different
///   values.
/// - The order of rows is unspecified, but the same calls give the same order.
class World {
 public:
  explicit World(const WorldLimits& limits = {});
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// Registers T and returns its id. A type that is already registered keeps its id and name. T: trivially copyable,
  /// alignment ≤ 64; an empty struct is a tag and takes no bytes. A name of another type asserts.
  template <class T>
  ComponentId register_component(std::string_view name = type_name<T>()) {
    require_component<T>();
    return register_type(type_key<T>(), detail::kTypeNameHash<T>, name, kComponentSize<T>);
  }
  template <class T>
  [[nodiscard]] bool is_registered() const {
    return types_.find(type_key<T>()) != TypeTable::kAbsent;
  }
  template <class T>
  [[nodiscard]] ComponentId component_id() const {
    require_component<T>();
    const auto search = [this] { return std::uint32_t{find_id(type_key<T>(), type_name<T>())}; };
    return static_cast<ComponentId>(fast_ids_.find_or<T>(search));
  }
  /// All registered components, indexed by id.
  [[nodiscard]] std::span<const ComponentInfo> components() const { return infos_; }

  /// Creates an entity with these components, each type at most once.
  template <class... Ts>
  Entity create(const Ts&... values) {
    begin_structural_change();
    const Bundle& bundle = bundle_of<Ts...>();
    const NewRows rows = create_one(*bundle.archetype);
    fill_rows(bundle, rows.first, rows.first + 1, std::index_sequence_for<Ts...>{}, values...);
    return rows.entity;
  }
  /// Creates out.size() entities with the same values, as one contiguous range of rows in the order of `out`.
  template <class... Ts>
  void create_bulk(std::span<Entity> out, const Ts&... values) {
    begin_structural_change();
    const Bundle& bundle = bundle_of<Ts...>();
    const std::uint32_t first = create_many(*bundle.archetype, out);
    fill_rows(bundle, first, first + static_cast<std::uint32_t>(out.size()), std::index_sequence_for<Ts...>{},
              values...);
  }
  /// `e` must be alive.
  void destroy(Entity e);
  [[nodiscard]] bool alive(Entity e) const {
    if (e.index >= records_.size()) [[unlikely]]
      return false;
    const Record& record = records_[e.index];
    if (record.generation != e.generation) [[unlikely]]
      return false;
    return bool{record.range};
  }
  [[nodiscard]] std::size_t entity_count() const { return alive_count_; }

  /// Adds a component. If `e` already has one, overwrites its value and marks it as changed. `e` must be alive.
  template <class T>
  T& add(Entity e, T value = T{}) {
    T* cell = reinterpret_cast<T*>(add_cell(e, component_id<T>(), kComponentSize<T>));
    if constexpr (!std::is_empty_v<T>) ::new (static_cast<void*>(cell)) T(value);
    return *cell;
  }
  /// Returns whether `e` had a T to remove. `e` must be alive.
  template <class T>
  bool remove(Entity e) {
    return remove_component(e, component_id<T>());
  }
  /// `e` must be alive.
  template <class T>
  [[nodiscard]] bool has(Entity e) const {
    return living(e).range.base(component_id<T>()) != nullptr;
  }
  /// `e` must be alive and have a T. Writing through the reference does not mark a change; mark_changed does.
  template <class T>
  [[nodiscard]] T& get(Entity e) {
    return *get_cell<T>(e, true);
  }
  template <class T>
  [[nodiscard]] const T& get(Entity e) const {
    return *get_cell<T>(e, false);
  }
  /// Null if `e` is dead or has no T.
  template <class T>
  [[nodiscard]] T* try_get(Entity e) {
    return try_cell<T>(e, true);
  }
  template <class T>
  [[nodiscard]] const T* try_get(Entity e) const {
    return try_cell<T>(e, false);
  }

  /// The view with these terms. The caller must include view.h. A const world gives views that only read.
  template <class... Args>
  [[nodiscard]] View<Args...> view() {
    return View<Args...>(*this);
  }
  template <class... Args>
  [[nodiscard]] View<Args...> view() const {
    static_assert(View<Args...>::kReadsOnly, "a const world gives const components");
    return View<Args...>(*this);
  }

  /// R is any movable type. No other thread may use the world during the first set of a type.
  template <class R>
  R& set_resource(R value) {
    check_resource<R>(true);
    return resources_.set<R>(std::move(value));
  }
  /// The R of the world; a new one, by default or equal to `value`, if it has none.
  template <class R>
  R& ensure_resource(R value = R{}) {
    check_resource<R>(true);
    R* const known = resources_.find<R>();
    return known != nullptr ? *known : resources_.set<R>(std::move(value));
  }
  /// The resource must exist.
  template <class R>
  [[nodiscard]] R& resource() {
    return require_resource<R>(resources_.find<R>(), true);
  }
  template <class R>
  [[nodiscard]] const R& resource() const {
    return require_resource<R>(resources_.find<R>(), false);
  }
  /// Null when absent.
  template <class R>
  [[nodiscard]] R* try_resource() {
    check_resource<R>(true);
    return resources_.find<R>();
  }
  template <class R>
  [[nodiscard]] const R* try_resource() const {
    check_resource<R>(false);
    return resources_.find<R>();
  }
  /// Does nothing when it is absent.
  template <class R>
  void remove_resource() {
    check_resource<R>(true);
    resources_.remove<R>();
  }

  /// The same functions for resources of a view: one value per view and type.
  template <class R>
  R& set_view_resource(ViewId view, R value) {
    check_resource<R>(true);
    return view_resources_[view.value].set<R>(std::move(value));
  }
  template <class R>
  [[nodiscard]] R& view_resource(ViewId view) {
    return require_resource<R>(find_view_resource<R>(view), true);
  }
  template <class R>
  [[nodiscard]] const R& view_resource(ViewId view) const {
    return require_resource<R>(find_view_resource<R>(view), false);
  }
  template <class R>
  [[nodiscard]] R* try_view_resource(ViewId view) {
    check_resource<R>(true);
    return find_view_resource<R>(view);
  }
  template <class R>
  [[nodiscard]] const R* try_view_resource(ViewId view) const {
    check_resource<R>(false);
    return find_view_resource<R>(view);
  }
  /// Calls f(R&) for each view that has an R, in any order.
  template <class R, class F>
  void each_view_resource(F&& f) {
    check_resource<R>(true);
    for (auto& [view, resources] : view_resources_)
      if (R* const found = resources.template find<R>()) f(*found);
  }
  /// Removes all resources of a view.
  void remove_view(ViewId view) { view_resources_.erase(view.value); }

  /// Changes with every structural change, and only then.
  [[nodiscard]] std::uint64_t structure_version() const { return structure_version_; }

  /// The current tick; changes are stamped with it.
  [[nodiscard]] Tick tick() const { return tick_.load(std::memory_order_relaxed); }
  /// Ends the current tick and returns it. Changes made so far are stamped with it or an earlier tick, later changes
  /// with a later one. Safe from many threads.
  Tick advance_tick() const { return tick_.fetch_add(1, std::memory_order_relaxed); }
  /// Marks the T of `e` as changed: stamps the block that holds it. `e` must be alive and have a T.
  template <class T>
  void mark_changed(Entity e) {
    const ComponentId id = component_id<T>();
    static_cast<void>(get_cell<T>(e, true));
    records_[e.index].range.archetype().mark_changed(id, records_[e.index].row, 1, tick());
  }

  /// Sets the checker of all accesses; null: no checks. It must outlive its use here. No other thread may use the world
  /// during the call.
  void set_access_checker(AccessChecker* checker) {
    checker_ = checker;
    fast_ids_.set_on(checker == nullptr);  // when off, access to single entities goes through the checker
  }

  /// All archetypes in order of creation, for statistics.
  [[nodiscard]] std::span<const std::unique_ptr<Archetype>> archetypes() const { return archetypes_; }

 private:
  template <class... Args>
  friend class View;

  /// Location of an entity. In a free slot `range` is null and `row` is the index of the next free slot. A lookup reads
  /// one cache line to learn whether the entity is alive and where its columns are.
  struct Record {
    Archetype::Range range;  ///< the range that holds the row
    std::uint32_t row = 0;
    std::uint32_t generation = 1;
  };
  static_assert(sizeof(Record) <= 16, "records do not cross cache lines");
  /// The archetype of a list of types, and their ids in the order of the list.
  struct Bundle {
    Archetype* archetype = nullptr;
    std::vector<ComponentId> ids;
  };
  struct NewRows {
    Entity entity;
    std::uint32_t first = 0;
  };
  struct ComponentsHash {
    std::size_t operator()(const std::vector<ComponentId>& ids) const;
  };

  static std::string unregistered_sentence(std::string_view type);
  static std::string absent_sentence(std::string_view type, std::string_view where);
  static std::string dead_sentence(Entity e);

  ComponentId register_type(TypeKey key, std::uint32_t name_hash, std::string_view name, std::uint32_t size);
  [[nodiscard]] ComponentId find_id(TypeKey key, std::string_view type) const;
  [[nodiscard]] ComponentId find_accessed_id(TypeKey key, std::string_view type, bool write) const;
  Archetype& archetype_of(std::vector<ComponentId> sorted);
  const Archetype::Edge& edge_of(Archetype& from, ComponentId id) {
    const Archetype::Edge* known = from.edge(id);
    return known != nullptr ? *known : add_edge(from, id);
  }
  const Archetype::Edge& add_edge(Archetype& from, ComponentId id);
  const Bundle& add_bundle(TypeKey key, std::span<const ComponentId> ids);

  void begin_structural_change() {
    if (checker_ != nullptr) checker_->structure();
    GLOAM_ASSERT(iterations_.load(std::memory_order_relaxed) == 0,
                 "structural change while a view iterates: record it in a CommandBuffer");
  }
  Entity take_entity(Archetype::Range range, std::uint32_t row);
  NewRows create_one(Archetype& archetype);
  std::uint32_t create_many(Archetype& archetype, std::span<Entity> out);
  /// Sets the location in `record` to that in `place`; the generation stays.
  static void set_place(Record& record, const Record& place) {
    record.range = place.range;
    record.row = place.row;
  }
  void move_entity(Record& record, ComponentId id);
  std::byte* add_cell(Entity e, ComponentId id, std::uint32_t size);
  bool remove_component(Entity e, ComponentId id);

  [[nodiscard]] const Record& living(Entity e) const {
    GLOAM_ASSERT(alive(e), dead_sentence(e));
    return records_[e.index];
  }
  template <class T>
  [[nodiscard]] T* cell_at(const Record& record, std::size_t id) const {
    std::byte* const base = record.range.base(id);
    if constexpr (std::is_empty_v<T>) {
      return reinterpret_cast<T*>(base);
    } else {
      return base == nullptr ? nullptr : reinterpret_cast<T*>(base) + record.row;
    }
  }
  /// Id of a component that is about to be read or written; tells the checker, if there is one.
  template <class T>
  [[nodiscard]] std::uint32_t accessed_id(bool write) const {
    require_component<T>();
    return fast_ids_.find_or<T>([&] { return std::uint32_t{find_accessed_id(type_key<T>(), type_name<T>(), write)}; });
  }
  template <class T>
  [[nodiscard]] T* get_cell(Entity e, bool write) const {
    const std::uint32_t id = accessed_id<T>(write);
    T* cell = cell_at<T>(living(e), id);
    GLOAM_ASSERT(cell != nullptr, absent_sentence(type_name<T>(), "the entity has no component "));
    return cell;
  }
  template <class T>
  [[nodiscard]] T* try_cell(Entity e, bool write) const {
    const std::uint32_t id = accessed_id<T>(write);
    return alive(e) ? cell_at<T>(records_[e.index], id) : nullptr;
  }

  template <class... Ts>
  const Bundle& bundle_of() {
    TypeKey key = type_key<TypeList<Ts...>>();
    const std::uint32_t found = bundle_table_.find(key);
    if (found != TypeTable::kAbsent) return bundles_[found];
    const ComponentId ids[] = {component_id<Ts>()..., kNoComponent};
    return add_bundle(key, std::span(ids, sizeof...(Ts)));
  }
  template <class T>
  static void fill_column(std::byte* base, std::uint32_t first, std::uint32_t end, const T& value) {
    if constexpr (!std::is_empty_v<T>) {
      std::uninitialized_fill(reinterpret_cast<T*>(base) + first, reinterpret_cast<T*>(base) + end, value);
    }
  }
  /// Fills rows [first, end), which lie in one range.
  template <std::size_t... I, class... Ts>
  static void fill_rows(const Bundle& bundle, std::uint32_t first, [[maybe_unused]] std::uint32_t end,
                        std::index_sequence<I...>, const Ts&... values) {
    [[maybe_unused]] const Archetype::Range range = bundle.archetype->range(first);
    (fill_column(range.base(bundle.ids[I]), first, end, values), ...);
  }

  template <class R>
  [[nodiscard]] R* find_view_resource(ViewId view) const {
    const auto found = view_resources_.find(view.value);
    return found == view_resources_.end() ? nullptr : found->second.template find<R>();
  }
  template <class R>
  [[nodiscard]] R& require_resource(R* value, bool write) const {
    check_resource<R>(write);
    GLOAM_ASSERT(value != nullptr, absent_sentence(type_name<R>(), "the world has no resource "));
    return *value;
  }
  void check_component(ComponentId id, bool write) const {
    if (checker_ != nullptr) checker_->component(id, write);
  }
  template <class R>
  void check_resource(bool write) const {
    if (checker_ != nullptr) checker_->resource(type_name<R>(), write);
  }

  /// Used by views. Safe from many threads between structural changes.
  [[nodiscard]] Query* find_query(TypeKey key) const;
  [[nodiscard]] Query* add_query(TypeKey key, QueryTerms terms) const;
  void refresh(Query& query) const;

  WorldLimits limits_;
  VirtualArray<Record> records_;
  std::uint32_t free_head_ = kNoEntity.index;
  std::size_t alive_count_ = 0;
  std::uint64_t structure_version_ = 0;
  mutable std::atomic<Tick> tick_ = 1;
  mutable std::atomic<int> iterations_ = 0;  ///< views that iterate now
  AccessChecker* checker_ = nullptr;

  TypeTable types_;
  TypeCache fast_ids_;  ///< off while there is a checker
  std::vector<ComponentInfo> infos_;
  FrontMemory fronts_;
  std::vector<std::unique_ptr<Archetype>> archetypes_;
  std::unordered_map<std::vector<ComponentId>, Archetype*, ComponentsHash> archetype_by_components_;
  TypeTable bundle_table_;
  std::vector<Bundle> bundles_;

  mutable std::mutex query_mutex_;
  mutable TypeTable query_table_;
  mutable std::vector<std::unique_ptr<Query>> queries_;

  ResourceStore resources_;
  std::unordered_map<std::uint32_t, ResourceStore> view_resources_;
};

}  // namespace gloam
