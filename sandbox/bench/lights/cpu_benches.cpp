// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/hash.h"
#include "engine/jobs/executor.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/lights/cpu_case.h"

namespace gloam {
namespace {

using bench::LightCpuCase;
using bench::LightCpuScene;

constexpr int kLightCpuRepetitions = 101;

struct Setup {
  LightCpuScene scene;
  const char* bound = "rect";
  const char* z_bins = "1024";
};

LightCpuScene cpu_scene_of(std::uint32_t lights, bool is_4k, bool sparse) {
  LightCpuScene scene;
  scene.lights = lights;
  scene.width = is_4k ? 3840 : 1920;
  scene.height = is_4k ? 2160 : 1080;
  if (sparse) scene.least_radius_m = 0.3f;
  if (sparse) scene.greatest_radius_m = 1.5f;
  return scene;
}

std::unique_ptr<LightCpuCase> make_case(const Setup& setup) {
  auto lights = std::make_unique<LightCpuCase>(setup.scene);
  lights->set_knob("lights.tile_bound", setup.bound);
  lights->set_knob("lights.z_bins", setup.z_bins);
  return lights;
}

BenchValue run_ms(const Setup& setup) {
  const auto lights = make_case(setup);
  const auto executor = make_serial_executor();
  auto times = time_ns(
      kLightCpuRepetitions, [&] { lights->move(); }, [&] { lights->run(*executor); });
  return per_item(std::move(times), kNsPerMs, lights->hash());
}

/// Times the systems and a memset of as many bytes as they write, alternately.
BenchValue run_over_memset(const Setup& setup) {
  const auto lights = make_case(setup);
  const auto executor = make_serial_executor();
  lights->move();
  lights->run(*executor);
  std::vector<std::byte> bytes(lights->bytes_written());
  int value = 0;
  const PairTimes times = time_pair_ns(kLightCpuRepetitions, {[&] { lights->move(); }, [&] { lights->run(*executor); }},
                                       {{}, [&] {
                                          std::memset(bytes.data(), ++value, bytes.size());
                                          keep(static_cast<std::uint64_t>(bytes[0]));
                                        }});
  return ratio_of(times.a_ns, times.b_ns, hash_of_both(lights->hash(), hash_bytes(bytes)));
}

/// Bytes written per second, as a share of the rate of a copy of as many bytes (which also reads them).
BenchValue run_bandwidth(const Setup& setup) {
  const auto lights = make_case(setup);
  const auto executor = make_serial_executor();
  lights->move();
  lights->run(*executor);
  std::vector<std::byte> from(lights->bytes_written(), std::byte{1});
  std::vector<std::byte> to(from.size());
  const PairTimes times = time_pair_ns(kLightCpuRepetitions, {[&] { lights->move(); }, [&] { lights->run(*executor); }},
                                       {{}, [&] {
                                          std::memcpy(to.data(), from.data(), to.size());
                                          keep(static_cast<std::uint64_t>(to[0]));
                                        }});
  return ratio_of(times.b_ns, times.a_ns, hash_of_both(lights->hash(), hash_bytes(to)));
}

/// Gives both threads work, as the earlier systems of a frame do: a sleeping helper takes longer to wake than all lists
/// take to build.
void wake(JobExecutor& pool) {
  pool.parallel_for(64, 1, [](JobRange) {
    const auto begin = std::chrono::steady_clock::now();
    while (std::chrono::steady_clock::now() - begin < std::chrono::microseconds(4)) {
    }
  });
}

/// The time of one thread over the time of two.
Result<BenchValue> run_two_workers(const Setup& setup) {
  const auto alone = make_case(setup);
  const auto shared = make_case(setup);
  const auto executor = make_serial_executor();
  const auto pool = make_pool_executor(2);
  const auto prepare = [&] {
    shared->move();
    wake(*pool);
  };
  const PairTimes times = time_pair_ns(kLightCpuRepetitions, {[&] { alone->move(); }, [&] { alone->run(*executor); }},
                                       {prepare, [&] { shared->run(*pool); }});
  if (alone->hash() != shared->hash()) return Error{ErrorKind::failed, "one thread and two made different light lists"};
  return ratio_of(times.a_ns, times.b_ns, alone->hash());
}

void add(BenchRegistry& registry, std::string id, const char* unit, std::optional<double> bar, Better better,
         std::function<Result<BenchValue>()> run) {
  registry.add(
      {.id = std::move(id), .unit = unit, .bar = bar, .better = better, .run = [run = std::move(run)](BenchContext&) {
         return run();
       }});
}

void add_ms(BenchRegistry& registry, std::string id, const Setup& setup) {
  add(registry, std::move(id), "ms", {}, Better::lower, [setup] { return run_ms(setup); });
}

void add_ratios(BenchRegistry& registry) {
  const Setup dense{cpu_scene_of(1024, true, false)};
  const Setup sparse{cpu_scene_of(1024, true, true)};
  add(registry, "lights.cpu_over_memset", "ratio", 6.0, Better::lower, [dense] { return run_over_memset(dense); });
  add(registry, "lights.cpu_over_memset.sparse", "ratio", 6.0, Better::lower,
      [sparse] { return run_over_memset(sparse); });
  add(registry, "lights.cpu_two_workers", "ratio", 1.6, Better::higher, [dense] { return run_two_workers(dense); });
  add(registry, "lights.cpu_two_workers.cone", "ratio", {}, Better::higher, [dense] {
    Setup setup = dense;
    setup.bound = "cone";
    return run_two_workers(setup);
  });
  add(registry, "lights.cpu_share_of_copy", "ratio", {}, Better::higher, [dense] { return run_bandwidth(dense); });
  add(registry, "lights.cpu_share_of_copy.sparse", "ratio", {}, Better::higher,
      [sparse] { return run_bandwidth(sparse); });
}

/// Adds two rows per bound: its time, and the number of lights per tile that it leaves.
void add_bounds(BenchRegistry& registry) {
  for (const char* bound : {"rect", "row_interval", "cone"}) {
    for (const bool sparse : {false, true}) {
      const Setup setup{cpu_scene_of(1024, true, sparse), bound};
      const std::string id = std::string("lights.cpu_1024_4k.") + bound + (sparse ? ".sparse" : "");
      add_ms(registry, id, setup);
      add(registry, id + ".lights_per_tile", "lights", {}, Better::lower, [setup]() -> Result<BenchValue> {
        const auto lights = make_case(setup);
        lights->move();
        lights->run(*make_serial_executor());
        return single_value(lights->lights_per_tile(), lights->hash());
      });
    }
  }
}

}  // namespace

void add_light_cpu_benches(BenchRegistry& registry) {
  for (const bool is_4k : {true, false}) {
    for (const std::uint32_t lights : {1024u, 256u, 64u})
      add_ms(registry, "lights.cpu_" + std::to_string(lights) + (is_4k ? "_4k" : "_1080p"),
             {cpu_scene_of(lights, is_4k, false)});
  }
  add_ratios(registry);
  add_bounds(registry);
  for (const char* bins : {"256", "512", "1024", "2048", "4096"})
    add_ms(registry, std::string("lights.cpu_1024_4k.z_bins_") + bins, {cpu_scene_of(1024, true, false), "rect", bins});
}

}  // namespace gloam
