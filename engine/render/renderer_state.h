// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/frame/upload.h"
#include "engine/render/frame_builder.h"
#include "engine/render/readback/capture.h"
#include "engine/render/renderer.h"
#include "engine/render/scene/gpu_scene.h"

namespace gloam {

/// Which of a renderer's GPU scenes belongs to a world, and its frames; a resource of the world.
struct RenderSlot {
  std::uint64_t value = 0;
  std::uint64_t frames = 0;  ///< drawn so far, so that a world's pictures do not depend on its neighbours
};

/// Images a renderer keeps for one view between frames.
struct ViewImages {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  gpu::ImageHandle lit;      ///< rgba16f, cd/m²
  gpu::ImageHandle picture;  ///< rgba8 sRGB; none while the caller brings a target
};

/// What the next frame's passes of a view leave shall be copied out: called when they have all been declared.
struct CopyRequest {
  ViewId view;
  std::function<Status(FrameBuilder&)> add_copies;
};

/// A module without demand keeps its memory for this many frames.
inline constexpr std::uint32_t kFramesUntilRelease = 120;

/// What the renderer knows of one module.
struct ModuleRuntime {
  Demand demand;                    ///< of the world
  bool in_view = false;             ///< demanded by a view of the frame in the making
  bool in_last_view = false;        ///< took part in the last view that was declared
  std::uint32_t idle_frames = 0;    ///< since a view demanded it last
  std::uint32_t absent_frames = 0;  ///< since a world called for it last
};

struct Renderer::State {
  explicit State(RendererOptions given);
  ~State();

  [[nodiscard]] FrameServices services();
  [[nodiscard]] GpuScene& scene_of(const World& world);
  /// Makes the view's images when missing or of another size.
  [[nodiscard]] Status prepare_images(const ViewRequest& request);
  void update_demand(const World& world);
  /// Whether a demanded module says yes to a question (Module::needs_casters).
  [[nodiscard]] bool any_needs(bool (Module::*question)(const World&, const KnobRegistry&) const,
                               const World& world) const;
  /// Everything between Device::begin_frame and submit_frame.
  [[nodiscard]] Status record_frame(World& world, std::span<const ViewRequest> requests, gpu::CommandList& commands);
  /// Declares one view's passes.
  [[nodiscard]] Status add_view(World& world, const ViewRequest& request, const RenderView& view);
  [[nodiscard]] Status add_module_passes(FrameBuilder& builder);
  /// Copies what a picked pixel's texels and modules' facts are read from.
  [[nodiscard]] Status add_pick_copies(FrameBuilder& builder);
  /// What engine and modules know about the pixel of the request, from copies of a frame that has ended.
  [[nodiscard]] std::vector<std::string> picked_lines(std::uint32_t x, std::uint32_t y);
  /// Whether a module takes part in a view: built, demanded, and its pipelines made where they are not waited for.
  [[nodiscard]] bool takes_part(std::size_t module, const FrameBuilder& builder);
  /// Hands a view's settled results to the modules that the world demands.
  void hand_out_results(World& world, ViewId view);
  /// Says once that a view is asked for whose module has nothing to do, so that the picture is shown as it is.
  void warn_of_idle_visualizer(const FrameBuilder& builder);
  /// After a frame: memory of modules that nobody has demanded for long goes back; pipelines too when the world has no
  /// call for them.
  void release_idle_modules();
  /// Of the frame's last view and the modules that took part in it.
  void collect_counters(const World& world);
  /// From results of the last view, of the newest frame that has ended.
  void add_result_counters(std::map<std::string, double>& all) const;

  RendererOptions options;
  KnobRegistry knobs;
  Schedule schedule;
  Pipelines pipelines;
  UploadRing uniforms;
  UploadRing storage;
  FrameResults results;
  FrameGraph graph;
  std::map<std::uint64_t, std::unique_ptr<GpuScene>> scenes;
  std::uint64_t next_slot = 1;
  std::map<std::uint32_t, ViewImages> images;
  std::vector<std::unique_ptr<FrameBuilder>> builders;  ///< of the frame in the making; pass functions refer to them
  std::vector<std::unique_ptr<RenderView>> views;
  std::vector<ModuleRuntime> runtimes;  ///< by module
  std::set<std::string> told;           ///< warnings that are said once
  std::vector<ViewRequest> last_requests;
  std::map<std::string, double> counters;
  std::vector<ResultKey> counted_results;  ///< of the last view
  std::optional<CopyRequest> copy_request;
  std::unique_ptr<Captures> copies;  ///< of a frame that was drawn once more (Renderer::draw_again)
  double cpu_ms = 0.0;
};

}  // namespace gloam
