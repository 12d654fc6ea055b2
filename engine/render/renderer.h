// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "engine/core/zones.h"
#include "engine/frame/frame_graph.h"
#include "engine/gpu/device.h"
#include "engine/jobs/executor.h"
#include "engine/render/module.h"
#include "engine/render/readback/geometry_picture.h"
#include "engine/render/readback/picture.h"

namespace gloam {

/// What happens while a demanded module's pipelines are not made yet.
enum class Readiness {
  wait,        ///< the frame waits: every demanded effect is in the first frame
  background,  ///< the module is left out until another thread has made them
};

struct RendererOptions {
  gpu::Device* device = nullptr;
  JobExecutor* executor = nullptr;
  LogSink* log = nullptr;
  ZoneRecorder* zones = nullptr;  ///< may be null
  ModuleList modules;             ///< in the order of the module graph
  Readiness readiness = Readiness::wait;
};

/// Where a view's picture goes. An image of the caller (swapchain, host) must be rgba8 or bgra8, UNORM (written
/// sRGB-encoded by the shader) or sRGB (by the hardware), of the view's size, made as a color_target; it is taken with
/// contents thrown away and left ready for `after`, an access that its usage allows. No image: the renderer keeps one,
/// see read_picture.
struct ViewTarget {
  gpu::ImageHandle image;
  gpu::Access after = gpu::Access::color_target;
  /// Instead of `image`, for pictures that exist only while a frame is recorded (gpu::Swapchain::acquire): called when
  /// the frame has begun. The view takes the size of the image it gives; when it gives none, the renderer's own picture
  /// is drawn.
  std::function<Result<gpu::ImageHandle>()> acquire;
  /// Draws over the finished picture: called while the frame is declared, when all modules have added their passes.
  /// Adds passes that write `picture`, which it leaves at its newest version. What they use must live until the frame
  /// is submitted.
  std::function<Status(FrameGraph& graph, ImageRef& picture)> overlay;
};

struct ViewRequest {
  ViewSettings settings;
  ViewTarget target;
};

struct ModuleState {
  std::string name;
  bool built = true;
  bool demanded = false;
  std::string reason;
  std::uint32_t pipelines = 0;
  std::uint64_t gpu_bytes = 0;
  std::uint64_t cpu_bytes = 0;
};

/// What the last call of `render` cost; GPU figures are of the newest completed frame (after `wait`: of the last one).
struct FrameReport {
  double cpu_ms = 0.0;  ///< systems, declaration and recording
  double gpu_ms = 0.0;
  std::vector<PassTime> passes;
  std::vector<ModuleState> modules;        ///< "engine" first, then the list's order
  std::map<std::string, double> counters;  ///< of the last view; those the GPU counts are GPU figures
  std::uint64_t plans_compiled = 0;        ///< FrameGraph::plans_compiled, since the renderer was made
  std::size_t pipelines_pending = 0;  ///< made in the background; frames stand in for them with less or slower passes
};

/// Draws worlds. Owns modules, knobs, the schedule and all GPU state; one thread at a time.
class Renderer {
 public:
  [[nodiscard]] static Result<std::unique_ptr<Renderer>> create(RendererOptions options);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  [[nodiscard]] KnobRegistry& knobs();
  [[nodiscard]] const ModuleList& modules() const;
  [[nodiscard]] std::vector<VisualizerInfo> visualizers() const;
  /// Usage error listing what is valid; checks the argument too where the module can.
  [[nodiscard]] Status check_visualizer(const World& world, std::string_view name) const;

  /// Registers every module's components and resources; once a world, before it is filled.
  void prepare_world(World& world) const;
  /// Gives back what the renderer keeps for a world on the GPU, before the world goes; drawing it again uploads it
  /// anew.
  void release_world(const World& world);

  /// One frame: world systems, then for every view its systems and passes, then submission. Does not wait for the GPU.
  [[nodiscard]] Status render(World& world, std::span<const ViewRequest> views);
  /// Until everything submitted has ended on the GPU.
  [[nodiscard]] Status wait();

  [[nodiscard]] FrameReport report();
  /// Gives back memory of frames that were put together otherwise than the last one; it would be kept for a while,
  /// should they return.
  void free_idle_memory();
  /// The picture of a view that had no target image, from its last frame; waits.
  [[nodiscard]] Result<Picture> read_picture(ViewId view);
  /// The same frame's linear light.
  [[nodiscard]] Result<LinearPicture> read_linear(ViewId view);
  /// An image that passes of the view's last frame exposed (FrameBuilder::expose), from that frame drawn once more;
  /// waits. Engine: "base_color", "normals", "material", "depth". Usage error listing what there is when there is none
  /// of that name.
  [[nodiscard]] Result<ImageBytes> read_image(World& world, ViewId view, std::string_view name);
  /// Several of one frame, in the order of the names, which differ.
  [[nodiscard]] Result<std::vector<ImageBytes>> read_images(World& world, ViewId view,
                                                            std::span<const std::string_view> names);
  /// The geometry buffer of the view's last frame, likewise.
  [[nodiscard]] Result<GeometryPicture> read_geometry(World& world, ViewId view);
  /// Lines of text: what the engine and the modules know about a pixel of the last frame.
  [[nodiscard]] Result<std::vector<std::string>> pick(World& world, ViewId view, std::uint32_t x, std::uint32_t y);
  /// Systems and passes as text, for people and for tests.
  [[nodiscard]] std::string describe() const;

 private:
  struct State;
  explicit Renderer(std::unique_ptr<State> state);
  /// Draws a view of the last frame once more, into a picture of the renderer's own; `add_copies` declares what to copy
  /// into State::copies, which are finished when this returns without error.
  [[nodiscard]] Status draw_again(World& world, ViewId view, std::function<Status(FrameBuilder&)> add_copies);
  std::unique_ptr<State> state_;
};

}  // namespace gloam
