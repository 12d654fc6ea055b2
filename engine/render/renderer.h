// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "engine/frame/frame_graph.h"
#include "engine/gpu/types.h"
#include "engine/jobs/executor.h"
#include "engine/render/host_geometry.h"
#include "engine/render/module.h"
#include "engine/render/readback/picture.h"

namespace gloam {

class World;
class ZoneRecorder;
struct GeometryPicture;
namespace gpu {
class Device;
}
/// Greatest width and height of a view, in pixels.
inline constexpr std::uint32_t kMostViewPixels = 16384;

/// Handling of a demanded module whose pipelines are not compiled yet.
enum class Readiness {
  wait,        ///< the frame waits for them: every demanded effect is in the first frame
  background,  ///< the module is left out until another thread has compiled them
};

struct RendererOptions {
  gpu::Device* device = nullptr;
  JobExecutor* executor = nullptr;
  LogSink* log = nullptr;
  ZoneRecorder* zones = nullptr;  ///< may be null
  ModuleList modules;             ///< in the order of the module graph
  Readiness readiness = Readiness::wait;
  /// With Readiness::background: most bytes of changed meshes and images that one frame uploads, ≥ 1 (SceneAssets).
  /// With Readiness::wait a frame shows all changes that were made before it.
  std::uint64_t upload_budget = std::uint64_t{8} << 20;
};

/// Destination of a view's linear light (cd/m² before exposure), for captures: one mip and layer of an image that
/// belongs to the caller, of the view's size and with ImageUsage::color_target; six views make a cube. Several views of
/// a frame may draw into one image; they state the same accesses. `before`: the access that the image was left ready
/// for (none: the frame may discard all of its content). `after`: the access that it is left ready for.
struct LightTarget {
  gpu::ImageHandle image;
  std::uint32_t mip = 0;
  std::uint32_t layer = 0;
  gpu::Access before = gpu::Access::none;
  gpu::Access after = gpu::Access::fragment_read;
};

/// Destination of a view's picture. `image`, if set, belongs to the caller (swapchain, host): rgba8 or bgra8, UNORM
/// (the shader encodes sRGB) or sRGB (the hardware does), of the view's size, created as a color_target. Its content is
/// discarded; after the frame it is ready for `after`, an access that its usage must allow. Without an image, the
/// renderer draws into its own picture, see read_picture.
struct ViewTarget {
  gpu::ImageHandle image;
  gpu::Access after = gpu::Access::color_target;
  /// Alternative to `image`, for images that exist only while a frame is recorded (gpu::Swapchain::acquire): called
  /// after the frame has begun. The view takes the size of the returned image. If it returns none, the renderer draws
  /// into its own picture.
  std::function<Result<gpu::ImageHandle>()> acquire;
  /// Draws over the finished picture. Called while the frame is declared, after all modules have added their passes.
  /// Adds passes that write `picture`, and leaves `picture` at its newest version. Resources of the passes must live
  /// until the frame is submitted.
  std::function<Status(FrameGraph& graph, ImageRef& picture)> overlay;
  /// In place of a picture: the phases `output` and `visualize` are left out. The other members must not be set.
  std::optional<LightTarget> light;
};

struct ViewRequest {
  ViewSettings settings;
  ViewTarget target;
  /// Geometry that the host has drawn, at the view's size. None: gloam draws all geometry.
  std::optional<HostGeometry> geometry = {};
  /// Whether Renderer::read_linear may be called for this frame. It costs a copy of the view's light in frames in which
  /// a pass has moved LitOutput to another image, and nothing in other frames.
  bool keep_linear = true;
};

struct ModuleState {
  std::string name;
  bool demanded = false;
  std::string reason;
  std::uint32_t pipelines = 0;
  std::uint64_t gpu_bytes = 0;
};

/// Counters of one view of the last frame, by name.
struct ViewCounters {
  ViewId view{0};
  std::map<std::string, double> counters;
};

/// Cost of the last call of `render`. GPU figures are of the newest completed frame (after `wait`: of the last frame).
struct FrameReport {
  double cpu_ms = 0.0;  ///< systems, declaration and recording
  double gpu_ms = 0.0;
  std::vector<PassTime> passes;
  /// When the last frame was given to the GPU: ZoneRecorder::now_ns just before; 0 without a recorder.
  std::uint64_t submitted_ns = 0;
  std::vector<ModuleState> modules;  ///< "engine" first, then in list order
  /// Counters of the last view; counters from the GPU are of the newest completed frame.
  std::map<std::string, double> counters;
  std::vector<ViewCounters> views;   ///< counters of each view, in order; those that are known on the CPU
  std::uint64_t plans_compiled = 0;  ///< FrameGraph::plans_compiled, since the renderer was made
  /// Pipelines being compiled in the background; until then, frames leave passes out or use slower ones.
  std::size_t pipelines_pending = 0;
  /// Meshes and images of the world drawn last that are not shown as they are in SceneAssets yet.
  std::size_t assets_pending = 0;
};

/// Draws worlds. Owns modules, knobs, the schedule and all GPU state. Use it from one thread at a time.
class Renderer {
 public:
  [[nodiscard]] static Result<std::unique_ptr<Renderer>> create(RendererOptions options);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  [[nodiscard]] KnobRegistry& knobs();
  [[nodiscard]] const ModuleList& modules() const;
  [[nodiscard]] std::vector<VisualizerInfo> visualizers() const;
  /// Whether a visualizer can be shown: its name, its argument and the knob that it needs. Usage error if not; for an
  /// unknown name it lists the valid ones.
  [[nodiscard]] Status check_visualizer(const World& world, std::string_view name) const;

  /// Registers the components and resources of the scene and of every module. Call it before the world is filled. A
  /// world that is prepared again is released. One renderer at a time draws a world: the one that has prepared it, and
  /// after its end one with the same modules.
  void prepare_world(World& world) const;
  /// Frees the GPU data of a world, its history, the images of the views that it drew last, and the memory of modules
  /// that no view of another world has needed. Call it before the world is destroyed; a world that is destroyed without
  /// it is released in the next frame. If the world is drawn again, its data is uploaded again.
  /// This and the next functions wait for the GPU, and the memory is free when they return. They must not be called
  /// while a frame is being drawn.
  void release_world(const World& world);
  /// Frees all that the renderer and the modules keep for a view: images, its picture included, maps, histories and
  /// results; and all memory of modules that no other view has needed. Drawing the view again creates it again. The
  /// images of a view that is not drawn for a while are freed without this call. An unknown view has nothing to free.
  void release_view(ViewId view);
  /// The same, and removes the view's resources from the world.
  void release_view(World& world, ViewId view);

  /// Draws one frame: runs the world systems, then the systems and passes of each view, and submits. Does not wait for
  /// the GPU. On an error the frame is given up: the GPU executes nothing of it, its system commands are dropped, and
  /// the next call draws as if it had not been begun. Exceptions of systems, jobs and passes become errors that name
  /// the system or the pass, if they are derived from std::exception; others pass through after the frame was given up.
  /// A view of more than kMostViewPixels a side is a usage error.
  [[nodiscard]] Status render(World& world, std::span<const ViewRequest> views);
  /// Waits until the GPU has finished everything submitted.
  [[nodiscard]] Status wait();

  [[nodiscard]] FrameReport report();
  /// The GPU times of every frame that has completed since the last call, oldest first; at most the last 4. For callers
  /// that keep several frames in flight.
  [[nodiscard]] std::vector<GpuFrameTimes> take_times();
  /// Waits for the GPU, then frees the memory of cached plans except the last frame's (FrameGraph::free_idle_memory),
  /// and of all objects that were destroyed before. Without this call, memory of unused plans is kept for a while, in
  /// case frames with the same passes return.
  void free_idle_memory();
  /// Reads the picture of a view's last frame. The view must have had no target image. Waits for the GPU. Fails if all
  /// frames that drew the view since its images were made were given up.
  [[nodiscard]] Result<Picture> read_picture(ViewId view);
  /// Reads the linear light of the view's last frame, after all passes. Asserts that the frame has kept it
  /// (ViewRequest::keep_linear). Waits for the GPU.
  [[nodiscard]] Result<LinearPicture> read_linear(ViewId view);
  /// Reads an image that passes of the view's last frame exposed (FrameBuilder::expose). Draws that frame again and
  /// waits for the GPU. The engine exposes "base_color", "normals", "material" and "depth". For an unknown name, a
  /// usage error lists the exposed images.
  [[nodiscard]] Result<ImageBytes> read_image(World& world, ViewId view, std::string_view name);
  /// Reads several images of the same frame, in the order of the names. The names must differ.
  [[nodiscard]] Result<std::vector<ImageBytes>> read_images(World& world, ViewId view,
                                                            std::span<const std::string_view> names);
  /// Reads the geometry buffer of the view's last frame. Draws that frame again and waits for the GPU.
  [[nodiscard]] Result<GeometryPicture> read_geometry(World& world, ViewId view);
  /// Facts that the engine and the modules know about a pixel of the last frame, as lines of text. Draws that frame
  /// again and waits for the GPU. Usage error if the pixel lies outside the picture.
  [[nodiscard]] Result<std::vector<std::string>> pick(World& world, ViewId view, std::uint32_t x, std::uint32_t y);
  /// World position of the surface that a pixel of the view's last frame shows; none for the sky. Draws that frame
  /// again and waits for the GPU. Usage error if the pixel lies outside the picture.
  [[nodiscard]] Result<std::optional<dvec3>> pick_position(World& world, ViewId view, std::uint32_t x, std::uint32_t y);
  /// Replaces a shader in all pipelines from the next frame on, for tools that compile shaders while they run. Usage
  /// error if the words are no SPIR-V, or if passes that were written for the embedded shader cannot use them
  /// (gpu::interface_difference); then nothing changes.
  [[nodiscard]] Status replace_shader(const gpu::ShaderCode& embedded, std::vector<std::uint32_t> words);
  /// Lists systems and passes as text, for users and tests.
  [[nodiscard]] std::string describe() const;

 private:
  struct State;
  explicit Renderer(std::unique_ptr<State> state);
  /// Draws a view of the last frame again, into the renderer's own picture. `add_copies` declares copies into
  /// State::copies. The copies are finished when this returns without error.
  [[nodiscard]] Status draw_again(World& world, ViewId view, std::function<Status(FrameBuilder&)> add_copies);
  std::unique_ptr<State> state_;
};

}  // namespace gloam
