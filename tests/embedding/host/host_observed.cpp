// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
// A host that looks at gloam from outside: its own profiler receives zones, times of the GPU and counters, its log
// receives categories, and every Vulkan object and group of commands has a name. Exit code 77: there is no Vulkan
// device.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "checks.h"
#include "engine/core/zones.h"
#include "engine/gpu/vulkan_device.h"
#include "engine/gpu/vulkan_interop.h"
#include "engine/render/renderer.h"
#include "little_world.h"
#include "modules/module_list/module_list.h"
#include "thread_executor.h"
#include "trace_profiler.h"
#include "vulkan_host.h"
#include "watched_names.h"

namespace {

namespace gpu = gloam::gpu;

constexpr int kFrames = 6;

using host::check;
using host::fail;
using host::value_of;
void expect(bool holds, const std::string& what) {
  if (!holds) fail("WRONG: " + what);
}

/// A log that sorts lines by category.
class SortingLog final : public gloam::LogSink {
 public:
  void write(gloam::LogLevel, std::string_view line) override {
    fail("a line without a category: " + std::string(line));
  }
  void write_from(std::string_view category, gloam::LogLevel, std::string_view line) override {
    const std::lock_guard lock(mutex_);
    lines_.emplace(std::string(category), std::string(line));
  }
  [[nodiscard]] bool has(const std::string& category, const std::string& part) {
    const std::lock_guard lock(mutex_);
    return std::any_of(lines_.begin(), lines_.end(), [&](const auto& line) {
      return line.first == category && line.second.find(part) != std::string::npos;
    });
  }

 private:
  std::mutex mutex_;
  std::set<std::pair<std::string, std::string>> lines_;
};

bool has_span(const std::vector<host::TraceProfiler::Span>& spans, const std::string& name, const std::string& module) {
  return std::any_of(spans.begin(), spans.end(),
                     [&](const auto& span) { return span.name == name && span.module == module; });
}

/// Draws a few frames in which nothing may be kept, with whatever listens.
gloam::FrameReport draw(gpu::Device& device, gloam::LogSink& log, gloam::Profiler* profiler,
                        gloam::ZoneRecorder* zones) {
  host::ThreadExecutor executor(3);
  auto renderer = value_of(gloam::Renderer::create({.device = &device,
                                                    .executor = &executor,
                                                    .log = &log,
                                                    .zones = zones,
                                                    .profiler = profiler,
                                                    .modules = gloam::make_all_modules()}));
  check(renderer->knobs().set("scene.reuse", "off"));
  check(renderer->knobs().set("shadows.atlas", "1024"));
  gloam::World world;
  renderer->prepare_world(world);
  host::build_little_world(world, {.shadows = true});
  // Six maps as large as the atlas: the module shadows says so.
  world.create(gloam::LocalTransform{.translation = gloam::dvec3(0.5, 2.5, 1.0)}, gloam::WorldTransform{},
               gloam::Light{.intensity = 50.0f}, gloam::ShadowCaster{.resolution = 1024});
  world.create(gloam::WorldTransform{}, gloam::MeshInstance{77});  // a mistake, which the renderer reports
  gloam::ViewRequest view;
  view.settings.width = 160;
  view.settings.height = 90;
  view.settings.world_from_camera[3] = gloam::dvec4(0.0, 2.2, 6.0, 1.0);
  for (int frame = 0; frame < kFrames; ++frame) {
    check(renderer->render(world, {&view, 1}));
    check(renderer->wait());
  }
  gloam::FrameReport report = renderer->report();
  renderer->release_world(world);
  return report;
}

void check_profiler(const host::TraceProfiler& profiler, const gloam::FrameReport& report) {
  expect(profiler.balanced(), "zones nest and end");
  for (const char* zone : {"render", "sync_assets", "build_draws", "declare_passes", "record_passes"})
    expect(has_span(profiler.zones, zone, "engine"), std::string("zone ") + zone);
  expect(has_span(profiler.zones, "shadow_views", "shadows"), "the systems of modules are zones");
  std::set<std::thread::id> threads;
  for (const auto& zone : profiler.zones) {
    threads.insert(zone.thread);
    expect(zone.begin_ns <= zone.end_ns, "zones end after they begin");
  }
  const auto renders = std::count_if(profiler.zones.begin(), profiler.zones.end(),
                                     [](const auto& zone) { return zone.name == "render" && zone.depth == 0; });
  expect(renders == kFrames, "one outermost zone for each frame");
  // The last frame's times come with the next frame. Names are those of the report.
  std::set<std::uint64_t> frames;
  for (const auto& span : profiler.gpu) {
    frames.insert(span.frame);
    expect(span.begin_ns < span.end_ns || span.begin_ns == span.end_ns, "spans of the GPU end after they begin");
  }
  expect(frames.size() >= kFrames - 2, "times of the GPU for every completed frame");
  for (const gloam::PassTime& pass : report.passes)
    expect(pass.end_ns == 0 || has_span(profiler.gpu, pass.name, pass.module),
           "a span of the GPU for pass " + pass.name);
  for (const auto& [name, value] : report.counters)
    expect(profiler.counters.count(name) == 1, "the profiler is told the counter " + name);
  for (const char* name : {"memory.shadows", "memory.engine", "cpu_ms", "gpu_ms"})
    expect(profiler.counters.count(name) == 1 && profiler.counters.at(name) > 0.0, std::string("counter ") + name);
  std::vector<std::uint64_t> numbers;
  for (std::uint64_t i = 1; i <= kFrames; ++i) numbers.push_back(i);
  expect(profiler.frames == numbers, "the end of each frame, in order");
  std::printf("profiler: %zu zones on %zu threads, %zu spans of the GPU, %zu counters\n", profiler.zones.size(),
              threads.size(), profiler.gpu.size(), profiler.counters.size());
}

void check_names(const gloam::FrameReport& report) {
  const host::WatchedNames watched = host::watched_names();
  for (const std::string& function : watched.unnamed)
    std::fprintf(stderr, "no name for an object of %s\n", function.c_str());
  expect(watched.unnamed.empty() && watched.created > 100, "every Vulkan object of gloam has a name");
  const std::set<std::string> labels(watched.labels.begin(), watched.labels.end());
  for (const gloam::PassTime& pass : report.passes)
    expect(labels.count(pass.name) == 1, "a label for pass " + pass.name);
  std::printf("names: %zu objects created, %zu names, %zu labels\n", watched.created, watched.names.size(),
              watched.labels.size());
}

}  // namespace

/// argv[1]: a file for the trace.
int main(int argc, char** argv) {
  const std::unique_ptr<host::VulkanHost> vulkan = host::VulkanHost::open_or_skip();
  gpu::separate_driver_caches();
  SortingLog log;
  gpu::HostDevice description = vulkan->describe();
  description.log = &log;
  description.get_instance_proc_addr = &host::watching_proc_addr;
  description.retained_pipelines = 256;
  auto device = value_of(gpu::create_vulkan_device_on(description));
  {
    host::TraceProfiler profiler;
    const gloam::FrameReport report = draw(*device, log, &profiler, nullptr);
    check_profiler(profiler, report);
    if (vulkan->validates()) check_names(report);  // VulkanHost then enables VK_EXT_debug_utils
    expect(log.has("shadows", "the atlas is full"), "warnings of a module have its name");
    expect(log.has("render", "mesh"), "warnings about the world are the renderer's");
    if (argc > 1) std::ofstream(argv[1]) << profiler.trace();

    // A profiler and a recorder of zones get the same zones of systems.
    host::TraceProfiler second;
    gloam::ZoneRecorder recorder;
    static_cast<void>(draw(*device, log, &second, &recorder));
    const std::vector<gloam::Zone> zones = recorder.take();
    expect(!zones.empty() && second.balanced(), "the recorder gets zones beside a profiler");
    for (const gloam::Zone& zone : zones)
      expect(has_span(second.zones, zone.name, zone.module), "the profiler gets the recorder's zone " + zone.name);
  }
  device.reset();
  const std::uint64_t messages = vulkan->close();
  std::printf("gloam seen from outside: right, %llu validation messages\n", static_cast<unsigned long long>(messages));
  return messages == 0 ? 0 : 1;
}
