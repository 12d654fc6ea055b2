// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
// Builds a world in code, without a scene file, runs the schedule on an executor of the host, and checks the result.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <span>

#include "engine/ecs/view.h"
#include "engine/ecs/world.h"
#include "engine/jobs/executor.h"
#include "engine/scene/components.h"
#include "engine/scene/gltf/import.h"
#include "engine/scene/systems.h"
#include "engine/schedule/schedule.h"
#include "modules/module_list/module_list.h"

namespace {

struct Orbit {
  double radius_m = 1.0;
  double speed_rad_s = 0.0;
};

void orbit_system(gloam::View<const Orbit, gloam::LocalTransform> orbits,
                  gloam::Resource<const gloam::SceneClock> clock, gloam::JobExecutor& jobs) {
  orbits.parallel_each(jobs, 64, [&](const Orbit& orbit, gloam::LocalTransform& pose) {
    const double angle = orbit.speed_rad_s * clock->time_s;
    pose.translation = gloam::dvec3(orbit.radius_m * std::cos(angle), 0.0, orbit.radius_m * std::sin(angle));
  });
}

/// Forwards the work to the serial executor and counts the calls. A host with its own threads would use them here.
class HostExecutor final : public gloam::JobExecutor {
 public:
  [[nodiscard]] std::uint32_t worker_count() const override { return serial_->worker_count(); }
  void run(std::span<const std::function<void()>> jobs) override { serial_->run(jobs); }
  void parallel_for(std::size_t count, std::size_t grain, const std::function<void(gloam::JobRange)>& body) override {
    ++calls;
    serial_->parallel_for(count, grain, body);
  }
  void run_graph(std::span<gloam::JobNode> nodes) override {
    ++calls;
    serial_->run_graph(nodes);
  }

  std::uint32_t calls = 0;

 private:
  std::unique_ptr<gloam::JobExecutor> serial_ = gloam::make_serial_executor();
};

}  // namespace

int main() {
  gloam::World world;
  gloam::prepare_scene_world(world);
  world.register_component<Orbit>("orbit");
  const gloam::ModuleList modules = gloam::make_all_modules();
  for (const auto& module : modules) module->register_components(world);

  const gloam::Entity sun =
      world.create(gloam::LocalTransform{.translation = gloam::dvec3(100.0, 0.0, 0.0)}, gloam::WorldTransform{});
  constexpr int kPlanets = 1000;
  gloam::Entity last;
  for (int i = 0; i < kPlanets; ++i) {
    last = world.create(Orbit{.radius_m = 1.0 + i, .speed_rad_s = 0.5}, gloam::LocalTransform{},
                        gloam::WorldTransform{}, gloam::Parent{sun, 1});
  }

  gloam::Schedule schedule;
  schedule.add_system("orbits", "host", gloam::Stage::world, &orbit_system);
  gloam::add_scene_systems(schedule);
  HostExecutor executor;
  for (int frame = 0; frame <= 60; ++frame) {
    world.resource<gloam::SceneClock>().time_s = frame / 60.0;
    schedule.run(gloam::Stage::world, world, executor);
  }

  const gloam::dvec3 found(world.get<gloam::WorldTransform>(last).matrix[3]);
  const gloam::dvec3 expected(100.0 + kPlanets * std::cos(0.5), 0.0, kPlanets * std::sin(0.5));
  const bool right = std::abs(found.x - expected.x) < 1e-9 && std::abs(found.z - expected.z) < 1e-9;
  std::printf(
      "gloam embedded: %zu entities, %zu modules, %u calls to the host's executor, last planet at %.3f %.3f: %s\n",
      world.entity_count(), modules.size(), executor.calls, found.x, found.z, right ? "right" : "wrong");
  return right && !modules.empty() && executor.calls > 0 ? 0 : 1;
}
