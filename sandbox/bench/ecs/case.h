// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "engine/core/hash.h"
#include "engine/ecs/view.h"
#include "engine/ecs/world.h"
#include "sandbox/bench/ecs/bare_table.h"
#include "sandbox/bench/harness/registry.h"

namespace gloam::bench {

/// One side of a comparison: holds its data, does the work, hashes the outcome.
class Contender {
 public:
  virtual ~Contender() = default;
  /// Untimed, before each run.
  virtual void prepare() {}
  virtual void run() = 0;
  [[nodiscard]] virtual std::uint64_t hash() const = 0;
};

/// The same work done by a World and by plain arrays; both must compute the same. Both live at once and run turn about.
struct EcsCase {
  std::string id;
  double entities = 0.0;            ///< that one run touches
  std::optional<double> bar_ns;     ///< of the world, an entity
  std::optional<double> bar_ratio;  ///< of the world over plain arrays
  std::function<std::unique_ptr<Contender>()> world;
  std::function<std::unique_ptr<Contender>()> bare;
};

/// Two rows: `id` in ns/entity and `id_over_bare` as a ratio. A difference in what they computed is an error.
void add_case(BenchRegistry& registry, EcsCase ecs_case);

void add_iteration_cases(BenchRegistry& registry);
void add_change_cases(BenchRegistry& registry);

inline void register_components(World& world) {
  world.register_component<Position>("position");
  world.register_component<Velocity>("velocity");
  world.register_component<Mass>("mass");
}

/// One row's share of a hash that does not depend on the order of rows: shares are added.
inline std::uint64_t share(const Position& p, const Velocity& v) {
  return Hasher().value(std::bit_cast<std::uint32_t>(p.x)).value(std::bit_cast<std::uint32_t>(v.x)).digest();
}

[[nodiscard]] inline std::uint64_t content_hash(const World& world) {
  std::uint64_t sum = 0;
  world.view<const Position, const Velocity>().each([&](const Position& p, const Velocity& v) { sum += share(p, v); });
  return sum;
}

[[nodiscard]] inline std::uint64_t content_hash(const BareTable::Columns& columns) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < columns.positions.size(); ++i) sum += share(columns.positions[i], columns.velocities[i]);
  return sum;
}

[[nodiscard]] inline std::uint64_t content_hash(const BareTable& table) {
  return content_hash(table.plain) + content_hash(table.heavy);
}

/// Where thing number i starts.
[[nodiscard]] inline Position start_of(std::size_t i) {
  return {.x = static_cast<float>(i % 1024), .y = 0.0f, .z = 1.0f};
}

}  // namespace gloam::bench
