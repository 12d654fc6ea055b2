// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/ecs/world.h"
#include "sandbox/bench/ecs/bare_table.h"
#include "sandbox/bench/harness/registry.h"

namespace gloam::bench {

/// One side of a comparison: holds its data, does the work, hashes the result.
class Contender {
 public:
  virtual ~Contender() = default;
  /// Called before each run, untimed.
  virtual void prepare() {}
  virtual void run() = 0;
  [[nodiscard]] virtual std::uint64_t hash() = 0;
};

/// The same work done by a World and by plain arrays. Both must compute the same result. Both exist at the same time
/// and run alternately.
struct EcsCase {
  std::string id;
  double entities = 0.0;            ///< entities that one run touches
  std::optional<double> bar_ns;     ///< time of the world per entity
  std::optional<double> bar_ratio;  ///< time of the world over that of plain arrays
  std::function<std::unique_ptr<Contender>()> world;
  std::function<std::unique_ptr<Contender>()> bare;
  std::function<std::unique_ptr<Contender>()> unchecked_bare = {};  ///< plain arrays without checks; may be empty
};

/// Adds two rows: `id` in ns/entity and `id_over_bare` as a ratio; with unchecked_bare also `id_over_unchecked_bare`. A
/// row fails if the sides computed different results.
void add_case(BenchRegistry& registry, const EcsCase& ecs_case);

void add_iteration_cases(BenchRegistry& registry);
void add_change_cases(BenchRegistry& registry);

inline void register_components(World& world) {
  world.register_component<Position>("position");
  world.register_component<Velocity>("velocity");
  world.register_component<Mass>("mass");
}

/// Everything that one thing holds. `index`: the entity's index, or the number of the thing in a bare table.
struct Content {
  std::uint32_t index = 0;
  Position position;
  Velocity velocity;
  bool has_mass = false;
  Mass mass;
};

/// Hash of all values of all things, in order of index: the order of rows does not matter, any other difference does.
[[nodiscard]] std::uint64_t hash_of_contents(std::vector<Content> contents);
[[nodiscard]] std::uint64_t content_hash(World& world);
[[nodiscard]] std::uint64_t content_hash(const BareTable& table);
[[nodiscard]] std::uint64_t content_hash(std::span<const BareTable::Columns> chunks);

/// Start position of thing i.
[[nodiscard]] inline Position start_of(std::size_t i) {
  return {.x = static_cast<float>(i % 1024), .y = 0.0f, .z = 1.0f};
}

}  // namespace gloam::bench
