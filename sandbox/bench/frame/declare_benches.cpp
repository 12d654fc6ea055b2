// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/hash.h"
#include "engine/frame/frame_graph.h"
#include "engine/gpu/recording_device.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/measure.h"

// CPU time of the frame graph in a frame whose plan is cached: begin, declaration of 100 passes, and look-up of the
// plan. Recording the passes is not included. Runs on the recording device, without Vulkan.

namespace gloam {
namespace {

constexpr std::size_t kPasses = 100;
constexpr int kRepetitions = 101;
constexpr int kFramesARepetition = 10;
constexpr double kNsPerMs = 1e6;

/// A frame of 100 passes. Each writes a transient image or, every fourth, a buffer, and reads what the pass before it
/// and the pass eight before it wrote. Every tenth pass also writes an imported image, so no pass is culled.
class HundredPasses {
 public:
  explicit HundredPasses(gpu::Device& device) : graph_(device) {
    for (std::size_t i = 0; i < kPasses; ++i) names_.push_back("declared_pass_" + std::to_string(i));
    gpu::ImageDesc target = image_desc("declared_target");
    target.usage = gpu::ImageUsage::storage;
    target_ = device.create_image(target).value();
  }

  [[nodiscard]] Status declare() {
    graph_.begin();
    images_.fill({});
    buffers_.fill({});
    ImageRef target = graph_.import_image("declared_target", target_, gpu::Access::none, gpu::Access::compute_read);
    for (std::size_t i = 0; i < kPasses; ++i) {
      PassBuilder pass = graph_.add_pass(names_[i], "bench");
      if (i >= 1) read(pass, i - 1);
      if (i >= 8) read(pass, i - 8);
      if (i % 4 == 3) {
        buffers_[i] = pass.write(graph_.create_buffer(buffer_desc(names_[i])), gpu::Access::compute_write);
      } else {
        images_[i] = pass.write(graph_.create_image(image_desc(names_[i])), gpu::Access::compute_write);
      }
      if (i % 10 == 9) target = pass.write(target, gpu::Access::compute_write);
      pass.execute([this, i](PassContext& context) { dispatched_ += touch(context, i); });
    }
    return graph_.compile();
  }

  /// Records the frame declared last.
  void execute(gpu::CommandList& commands) { graph_.execute(commands); }
  /// Number of passes that were recorded and found their resource.
  [[nodiscard]] std::size_t dispatched() const { return dispatched_; }
  [[nodiscard]] const FrameGraph& graph() const { return graph_; }

 private:
  static gpu::ImageDesc image_desc(std::string name) {
    return {.name = std::move(name), .module = "bench", .format = gpu::Format::rgba8_unorm, .width = 64, .height = 64};
  }
  static gpu::BufferDesc buffer_desc(std::string name) {
    return {.name = std::move(name), .module = "bench", .size = 4096};
  }
  void read(PassBuilder& pass, std::size_t written) {
    if (images_[written]) pass.read(images_[written], gpu::Access::compute_read);
    if (buffers_[written]) pass.read(buffers_[written], gpu::Access::compute_read);
  }
  [[nodiscard]] std::size_t touch(PassContext& context, std::size_t i) const {
    return (images_[i] ? static_cast<bool>(context.image(images_[i])) : static_cast<bool>(context.buffer(buffers_[i])))
               ? 1
               : 0;
  }

  FrameGraph graph_;
  std::vector<std::string> names_;
  gpu::ImageHandle target_;
  std::array<ImageRef, kPasses> images_;
  std::array<BufferRef, kPasses> buffers_;
  std::size_t dispatched_ = 0;
};

/// Records the last frame once: every pass must be live, and every barrier right.
Result<std::uint64_t> recorded_hash(gpu::RecordingDevice& device, HundredPasses& frame) {
  auto commands = device.begin_frame();
  if (!commands) return commands.error();
  GLOAM_TRY(frame.declare());
  frame.execute(**commands);
  GLOAM_TRY(device.submit_frame());
  if (!device.faults().empty()) return Error{ErrorKind::failed, "frame.declare_100_passes: " + device.faults().front()};
  if (frame.dispatched() != kPasses)
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
