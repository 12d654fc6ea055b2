// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/hash.h"
#include "engine/core/log.h"
#include "engine/frame/frame_graph.h"
#include "engine/gpu/recording/device.h"
#include "engine/render/declare/compute_pass.h"
#include "engine/render/declare/pass_frames.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/measure.h"
#include "shaders/lights/shaders.h"

// CPU time of declaring a frame whose plan is cached: begin, 100 passes that bind by name, and look-up of the plan.
// Recording the passes is not included. Runs on the recording device, without Vulkan.

namespace gloam {
namespace {

constexpr std::size_t kDeclarePasses = 100;
constexpr int kDeclareRepetitions = 101;
constexpr int kFramesARepetition = 10;

/// A frame of 100 passes with ten bindings each. Each reads what the pass before it and the pass eight before it wrote,
/// and writes a transient image, a transient buffer and an imported buffer, so that no pass is culled.
class HundredPasses {
 public:
  explicit HundredPasses(gpu::Device& device) : frames_(device, null_log(), "bench", small_view()) {
    for (std::size_t i = 0; i < kDeclarePasses; ++i) names_.push_back("declared_pass_" + std::to_string(i));
    gpu::BufferDesc kept = buffer_desc("declared_counters");
    kept.usage = gpu::BufferUsage::storage;
    counters_ = device.create_buffer(kept).value();
  }

  [[nodiscard]] Status declare() {
    FrameBuilder& frame = frames_.begin();
    FrameGraph& graph = frames_.graph();
    frame.upload_view_constants(0);
    const gpu::Binding::BufferRange uniform = std::get<gpu::Binding::BufferRange>(frame.view_binding().resource);
    images_.fill({});
    BufferRef counters =
        graph.import_buffer("declared_counters", counters_, gpu::Access::compute_write, gpu::Access::compute_write);
    BufferRef masks;
    for (std::size_t i = 0; i < kDeclarePasses; ++i) {
      ComputePass pass(frame, names_[i], shaders::lights::find_lights_accurate_tiles_comp);
      pass.read("lights", uniform);
      pass.read("grid", uniform);
      pass.read("depth_image", i >= 1 ? images_[i - 1] : ImageRef{});
      pass.read("light_texels", i >= 8 ? images_[i - 8] : ImageRef{});
      pass.read("depth_bounds", i >= 1 ? images_[i - 1] : ImageRef{});
      pass.read("group_masks", masks);
      images_[i] = pass.write("tile_lists", graph.create_image(image_desc(names_[i])));
      masks = pass.write("early_lists", graph.create_buffer(buffer_desc(names_[i])));
      counters = pass.write("counters", counters);
      pass.dispatch_over(64, 64);
      pass.record([this](PassContext&) { ++recorded_; });
    }
    return frames_.compile();
  }

  /// Records the frame declared last.
  [[nodiscard]] Status record(gpu::CommandList& commands) { return frames_.record(commands); }
  /// Number of passes that were recorded.
  [[nodiscard]] std::size_t recorded() const { return recorded_; }
  [[nodiscard]] FrameGraph& graph() { return frames_.graph(); }

 private:
  static RenderView small_view() {
    ViewSettings settings;
    settings.width = settings.height = 64;
    return make_view(settings, 0);
  }
  static gpu::ImageDesc image_desc(std::string name) {
    return {.name = std::move(name), .module = "bench", .format = gpu::Format::rg32_uint, .width = 64, .height = 64};
  }
  static gpu::BufferDesc buffer_desc(std::string name) {
    return {.name = std::move(name), .module = "bench", .size = 4096};
  }

  PassFrames frames_;
  std::vector<std::string> names_;
  gpu::BufferHandle counters_;
  std::array<ImageRef, kDeclarePasses> images_;
  std::size_t recorded_ = 0;
};

/// Records the last frame once: every pass must be live, and every barrier right.
Result<std::uint64_t> recorded_hash(gpu::RecordingDevice& device, HundredPasses& frame) {
  auto commands = device.begin_frame();
  if (!commands) return commands.error();
  GLOAM_TRY(frame.declare());
  GLOAM_TRY(frame.record(**commands));
  GLOAM_TRY(device.submit_frame());
  if (!device.faults().empty()) return Error{ErrorKind::failed, "frame.declare_100_passes: " + device.faults().front()};
  if (frame.recorded() != kDeclarePasses)
    return Error{ErrorKind::failed, "frame.declare_100_passes: a declared pass was culled"};
  if (frame.graph().plans_compiled() != 1)
    return Error{ErrorKind::failed, "frame.declare_100_passes: the plan did not come from the cache"};
  Hasher hasher;
  hasher.text(frame.graph().describe());
  for (const gpu::RecordedCommand& command : device.commands()) hasher.text(command.name).text(command.text);
  return hasher.digest();
}

Result<BenchValue> run_declaration(BenchContext&) {
  const auto device = gpu::make_recording_device();
  HundredPasses frame(*device);
  Status status = frame.declare();
  auto times = time_ns(kDeclareRepetitions, {}, [&] {
    for (int i = 0; i < kFramesARepetition && status.ok(); ++i) status = frame.declare();
  });
  GLOAM_TRY(status);
  const auto hash = recorded_hash(*device, frame);
  if (!hash) return hash.error();
  return per_item(std::move(times), kNsPerMs * kFramesARepetition, *hash);
}

}  // namespace

void add_frame_declaration_benches(BenchRegistry& registry) {
  registry.add(
      {.id = "frame.declare_100_passes", .unit = "ms", .bar = 0.1, .better = Better::lower, .run = &run_declaration});
}

}  // namespace gloam
