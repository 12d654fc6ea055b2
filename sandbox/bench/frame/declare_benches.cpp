// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/hash.h"
#include "engine/core/log.h"
#include "engine/frame/frame_graph.h"
#include "engine/gpu/recording_device.h"
#include "engine/render/declare/compute_pass.h"
#include "engine/render/declare/recording.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/measure.h"
#include "shaders/lights/shaders.h"

// CPU time of declaring a frame whose plan is cached: begin, 100 passes that bind by name, and look-up of the plan.
// Recording the passes is not included. Runs on the recording device, without Vulkan.

namespace gloam {
namespace {

constexpr std::size_t kPasses = 100;
constexpr int kRepetitions = 101;
constexpr int kFramesARepetition = 10;
constexpr double kNsPerMs = 1e6;

/// A frame of 100 passes with ten bindings each. Each reads what the pass before it and the pass eight before it wrote,
/// and writes a transient image, a transient buffer and an imported buffer, so that no pass is culled.
class HundredPasses {
 public:
  explicit HundredPasses(gpu::Device& device)
      : pipelines_(device),
        uniforms_(device, "bench", gpu::BufferUsage::uniform),
        storage_(device, "bench", gpu::BufferUsage::storage),
        results_(device),
        declared_(device),
        history_(device),
        scene_(device, pipelines_),
        executor_(make_serial_executor()),
        services_{.device = device,
                  .executor = *executor_,
                  .log = null_log(),
                  .knobs = knobs_,
                  .pipelines = pipelines_,
                  .uniforms = uniforms_,
                  .storage = storage_,
                  .results = results_,
                  .declared = declared_,
                  .history = history_},
        graph_(device) {
    for (std::size_t i = 0; i < kPasses; ++i) names_.push_back("declared_pass_" + std::to_string(i));
    gpu::BufferDesc kept = buffer_desc("declared_counters");
    kept.usage = gpu::BufferUsage::storage;
    counters_ = device.create_buffer(kept).value();
    ViewSettings settings;
    settings.width = settings.height = 64;
    view_ = make_view(settings, 0);
    draws_.views.resize(1);
  }

  [[nodiscard]] Status declare() {
    graph_.begin();
    declared_.recordings.begin_frame();
    declared_.due_pipelines.begin_frame();
    uniforms_.begin_frame();
    shared_.clear();
    frame_.emplace(services_, graph_, world_, view_, scene_, draws_, 0, shared_);
    frame_->upload_view_constants(0);
    const gpu::Binding::BufferRange uniform = std::get<gpu::Binding::BufferRange>(frame_->view_binding().resource);
    images_.fill({});
    BufferRef counters =
        graph_.import_buffer("declared_counters", counters_, gpu::Access::compute_write, gpu::Access::compute_write);
    BufferRef masks;
    for (std::size_t i = 0; i < kPasses; ++i) {
      ComputePass pass(*frame_, names_[i], shaders::lights::find_lights_accurate_tiles_comp);
      pass.read("lights", uniform);
      pass.read("grid", uniform);
      pass.read("depth_image", i >= 1 ? images_[i - 1] : ImageRef{});
      pass.read("light_texels", i >= 8 ? images_[i - 8] : ImageRef{});
      pass.read("depth_bounds", i >= 1 ? images_[i - 1] : ImageRef{});
      pass.read("group_masks", masks);
      images_[i] = pass.write("tile_lists", graph_.create_image(image_desc(names_[i])));
      masks = pass.write("early_lists", graph_.create_buffer(buffer_desc(names_[i])));
      counters = pass.write("counters", counters);
      pass.dispatch_over(64, 64);
      pass.record([this](PassContext&) { ++recorded_; });
    }
    GLOAM_TRY(frame_->status());
    GLOAM_TRY(declared_.due_pipelines.make_all(pipelines_, *executor_));
    return graph_.compile();
  }

  /// Records the frame declared last.
  void execute(gpu::CommandList& commands) { graph_.execute(commands); }
  /// Number of passes that were recorded.
  [[nodiscard]] std::size_t recorded() const { return recorded_; }
  [[nodiscard]] const FrameGraph& graph() const { return graph_; }

 private:
  static gpu::ImageDesc image_desc(std::string name) {
    return {.name = std::move(name), .module = "bench", .format = gpu::Format::rg32_uint, .width = 64, .height = 64};
  }
  static gpu::BufferDesc buffer_desc(std::string name) {
    return {.name = std::move(name), .module = "bench", .size = 4096};
  }

  KnobRegistry knobs_;
  Pipelines pipelines_;
  UploadRing uniforms_;
  UploadRing storage_;
  FrameResults results_;
  declare::State declared_;
  History history_;
  GpuScene scene_;
  std::unique_ptr<JobExecutor> executor_;
  FrameServices services_;
  FrameGraph graph_;
  World world_;
  RenderView view_;
  FrameDraws draws_;
  Board shared_;
  std::optional<FrameBuilder> frame_;
  std::vector<std::string> names_;
  gpu::BufferHandle counters_;
  std::array<ImageRef, kPasses> images_;
  std::size_t recorded_ = 0;
};

/// Records the last frame once: every pass must be live, and every barrier right.
Result<std::uint64_t> recorded_hash(gpu::RecordingDevice& device, HundredPasses& frame) {
  auto commands = device.begin_frame();
  if (!commands) return commands.error();
  GLOAM_TRY(frame.declare());
  frame.execute(**commands);
  GLOAM_TRY(device.submit_frame());
  if (!device.faults().empty()) return Error{ErrorKind::failed, "frame.declare_100_passes: " + device.faults().front()};
  if (frame.recorded() != kPasses)
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
  auto times = time_ns(kRepetitions, {}, [&] {
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
