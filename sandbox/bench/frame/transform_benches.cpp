// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/core/hash.h"
#include "engine/jobs/executor.h"
#include "engine/scene/gltf/import.h"
#include "engine/scene/systems.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/measure.h"

namespace gloam {
namespace {

constexpr int kRepetitions = 200;
constexpr std::size_t kNodes = 3000;

/// 3,000 nodes in trees of ten: a root, three children, two leaves below each.
class Nodes {
 public:
  Nodes() {
    prepare_scene_world(world_);
    schedule_.add_system("transforms", "engine", Stage::world, &transform_system);
    for (std::size_t i = 0; i < kNodes; ++i) {
      const std::size_t in_tree = i % 10;
      const LocalTransform pose{.translation = dvec3(static_cast<double>(i % 7), static_cast<double>(i % 11), 0.5)};
      nodes_.push_back(world_.create(pose, WorldTransform{}));
      if (in_tree == 0) continue;
      const std::size_t parent = in_tree < 4 ? i - in_tree : i - in_tree + 1 + (in_tree - 4) / 2;
      world_.add(nodes_[i], Parent{nodes_[parent], in_tree < 4 ? 1u : 2u});
    }
  }
  void run(JobExecutor& executor) { schedule_.run(Stage::world, world_, executor); }
  /// Moves every hundredth node.
  void move() {
    for (std::size_t i = 0; i < kNodes; i += 100) world_.get<LocalTransform>(nodes_[i]).translation.z += 0.25;
  }
  [[nodiscard]] std::uint64_t hash() const {
    std::vector<dmat4> matrices;
    for (const Entity node : nodes_) matrices.push_back(world_.get<WorldTransform>(node).matrix);
    return hash_bytes(std::as_bytes(std::span(matrices)));
  }

 private:
  World world_;
  Schedule schedule_;
  std::vector<Entity> nodes_;
};

BenchRow transform_row(const char* id, bool moving, double bar_ms) {
  BenchRow row{.id = id, .unit = "ms", .bar = bar_ms};
  row.run = [moving](BenchContext&) -> Result<BenchValue> {
    Nodes nodes;
    const auto executor = make_serial_executor();
    const auto prepare = [&] {
      if (moving) nodes.move();
    };
    auto times = time_ns(kRepetitions, prepare, [&] { nodes.run(*executor); });
    return per_item(std::move(times), kNsPerMs, nodes.hash());
  };
  return row;
}

}  // namespace

void add_transform_benches(BenchRegistry& registry) {
  registry.add(transform_row("frame.static_transforms", false, 0.03));
  registry.add(transform_row("frame.moving_transforms", true, 0.06));
}

}  // namespace gloam
