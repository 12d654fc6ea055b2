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

#include "engine/frame/history.h"
#include "engine/frame/upload.h"
#include "engine/render/camera_cuts.h"
#include "engine/render/declare/recording.h"
#include "engine/render/draws/motion_history.h"
#include "engine/render/frame_builder.h"
#include "engine/render/readback/capture.h"
#include "engine/render/renderer.h"
#include "engine/render/scene/gpu_scene.h"
#include "engine/schedule/schedule.h"

namespace gloam {

/// Live as long as a renderer, and as a world that a renderer has prepared.
struct RendererToken {};
struct WorldToken {};

/// A world's number among a renderer's GPU scenes, and its frame count. A resource of the world.
struct RenderSlot {
  std::uint64_t value = 0;
  /// Frames drawn so far, without those that were given up or drew a frame again. Counted per world, so that pictures
  /// of one world do not depend on others.
  std::uint64_t frames = 0;
  std::weak_ptr<const RendererToken> renderer;  ///< that has prepared the world
  std::shared_ptr<const WorldToken> token;
};

/// What was checked of a world's MeshInstances: changes up to a tick, against a number and a state of meshes.
struct CheckedInstances {
  Tick tick = 0;
  std::size_t meshes = 0;
  std::uint64_t revision = 0;  ///< SceneAssets::revision()
};

/// Images a renderer keeps for one view between frames.
struct ViewImages {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  gpu::ImageHandle lit;           ///< rgba16f, cd/m²
  bool lit_is_last = false;       ///< `lit` holds the light after all passes of the last frame
  gpu::ImageHandle picture;       ///< rgba8 sRGB; null if the caller provides a target
  std::uint64_t world = 0;        ///< RenderSlot of the world that drew the view last
  std::uint32_t idle_frames = 0;  ///< since a frame drew the view
  bool drawn = false;             ///< a frame that was not given up has drawn the images
};

/// Request to copy results of a view's passes in the next frame. add_copies: called after all passes of the view are
/// declared.
struct CopyRequest {
  ViewId view;
  std::function<Status(FrameBuilder&)> add_copies;
};

/// Number of frames for which a module without demand, or a view that is not drawn, keeps its memory.
inline constexpr std::uint32_t kFramesUntilRelease = 120;

/// The renderer's state of one module.
struct ModuleRuntime {
  Demand demand;                    ///< of the world
  bool in_view = false;             ///< demanded by a view of the current frame
  bool in_last_view = false;        ///< took part in the last declared view
  std::uint32_t idle_frames = 0;    ///< since a view demanded it
  std::uint32_t absent_frames = 0;  ///< since a world demanded it
  /// The views that it has taken part in since it was released last: RenderSlot and id.
  std::set<std::pair<std::uint64_t, std::uint32_t>> views;
};

/// A view of the current frame.
struct FrameView {
  ViewRequest request;
  std::unique_ptr<const KnobRegistry> knobs;  ///< with the view's overrides; null: it has none
  std::unique_ptr<RenderView> view;
  std::optional<ViewId> main;   ///< of a companion: the view that needs it
  bool has_companions = false;  ///< its companions come just before it
};

struct Renderer::State {
  explicit State(RendererOptions given);
  ~State();

  /// The number of a world, which must have been prepared by this renderer.
  [[nodiscard]] const RenderSlot& slot_of(const World& world) const;
  /// Gives the world a number of this renderer.
  void take_world(World& world, std::uint64_t frames);
  /// Asserts that no frame is being drawn: modules and targets must not call the renderer. call: "render".
  void check_idle(std::string_view call) const;
  /// Logs a warning, unless it was logged before.
  void warn_once(const std::string& sentence);
  /// Logs what has no effect as it is: components of the world, the views' cameras and names of modules.
  /// The first changed MeshInstance that names no mesh, if there is one.
  [[nodiscard]] std::optional<Oversight> find_absent_mesh(const World& world);
  void warn_of_oversights(const World& world, std::span<const ViewRequest> requests);
  [[nodiscard]] std::vector<VisualizerInfo> visualizers() const;
  /// Usage error unless there is a visualizer of this name, with or without an argument.
  [[nodiscard]] Status check_visualizer_name(std::string_view name) const;
  /// Frees all that the renderer keeps for a world but what GPU frames still use.
  void release_slot(std::uint64_t slot);
  /// Releases worlds that were destroyed without Renderer::release_world.
  void release_lost_worlds();
  void make_rings();
  /// Frees the memory that all views of a frame share: transient, staging and that of placeholders.
  void free_frame_memory();
  /// Frees the memory of a module: its own, its results and its history.
  void release_module(std::size_t index);
  /// Releases the modules that took part in views of which `gone` is true, and in no others.
  void release_modules_of(const std::function<bool(std::uint64_t slot, std::uint32_t id)>& gone);

  [[nodiscard]] FrameServices services(const KnobRegistry& view_knobs);
  [[nodiscard]] const KnobRegistry& knobs_of(const FrameView& view) const {
    return view.knobs == nullptr ? *frame_knobs : *view.knobs;
  }
  /// The knobs that frames are drawn with. With Readiness::background, changed values wait until the pipelines of all
  /// modules that the last frame showed are ready: until then the old ones stay.
  [[nodiscard]] const KnobRegistry& settled_knobs();
  [[nodiscard]] GpuScene& scene_of(const World& world);
  /// Creates the view's images if they are missing or of another size. Frees its picture if the caller provides a
  /// target.
  [[nodiscard]] Status prepare_images(const World& world, const ViewRequest& request);
  void destroy_images(ViewImages& view);
  /// An error unless the view's images have been drawn.
  [[nodiscard]] static Status check_drawn(const ViewImages& view);
  /// Frees the images of views for which `unwanted` is true.
  void release_images(const std::function<bool(std::uint32_t id, const ViewImages&)>& unwanted);
  /// After a frame: frees the images of views that were not drawn for kFramesUntilRelease frames.
  void release_idle_views();
  void update_demand(const World& world);
  /// Whether `question` (e.g. &Module::needs_casters) is true for any demanded module.
  [[nodiscard]] bool any_needs(bool (Module::*question)(const World&, const KnobRegistry&) const,
                               const World& world) const;
  /// Whether the module is built, demanded by the world and the view, and not left out by the view's settings.
  [[nodiscard]] bool may_draw(std::size_t module, const World& world, const FrameView& view) const;
  /// Whether `question` (e.g. &Module::needs_motion) is true for a module that may draw in the view.
  [[nodiscard]] bool view_needs(bool (Module::*question)(const World&, const KnobRegistry&) const, const World& world,
                                const FrameView& view) const;
  /// Renderer::render, except for exceptions that it passes on after giving the frame up.
  [[nodiscard]] Status draw_frame(World& world, std::span<const ViewRequest> requests);
  /// Notes a submitted frame as drawn.
  void commit_frame(World& world, std::span<const ViewRequest> requests);
  /// Undoes what was noted for a frame that the GPU does not execute. `frame`: its Device::frame_number.
  void give_up_frame(const World& world, std::uint64_t frame);
  /// Runs the systems of the world, or of a view. An exception becomes an error that names the system.
  [[nodiscard]] Status run_systems(World& world, std::optional<ViewId> view);
  /// Everything between Device::begin_frame and submit_frame.
  [[nodiscard]] Status record_frame(World& world, gpu::CommandList& commands);
  /// A view of the frame, with its knobs.
  [[nodiscard]] Result<FrameView> begin_view(const ViewRequest& request) const;
  /// Starts the frame's views: requests and knobs.
  [[nodiscard]] Status begin_views(std::span<const ViewRequest> requests);
  /// Settles pose and size of the requested views, and puts their companions before them.
  [[nodiscard]] Status add_companions(World& world);
  /// Puts the companions of a view, whose settings are settled, into frame_views.
  [[nodiscard]] Status add_companions_of(World& world, FrameView& main);
  /// Releases a view: all but its resources of a world.
  void release_view(ViewId view);
  /// After a frame: releases companions that were not drawn for kFramesUntilRelease frames.
  void release_idle_companions();
  /// Settles the settings of all views of the frame, and runs their systems.
  [[nodiscard]] Status prepare_views(World& world);
  /// Declares the passes of view number `index`.
  [[nodiscard]] Status add_view(World& world, std::size_t index);
  /// The rest of add_view for a companion: puts its light into CompanionLight.
  [[nodiscard]] Status add_companion(World& world, FrameBuilder& frame, const FrameView& own_view);
  /// Copies the view's linear light into the caller's image.
  [[nodiscard]] Status add_light_copy(FrameBuilder& frame, const LightTarget& target);
  [[nodiscard]] Status add_module_passes(FrameBuilder& builder, const FrameView& view);
  /// After all passes on the view's light: if it has moved from `lit`, the renderer's image, to another image, copies
  /// it back if read_linear wants it.
  void keep_linear(FrameBuilder& frame, ImageRef lit, bool wanted);
  /// Declares the copies that picked_lines reads: texels of the geometry buffer and data of the modules.
  [[nodiscard]] Status add_pick_copies(FrameBuilder& builder);
  /// Facts of the engine and the modules about a pixel, from the copies of a completed frame.
  [[nodiscard]] std::vector<std::string> picked_lines(std::uint32_t x, std::uint32_t y);
  /// Whether a module takes part in a view: built, demanded, and with its pipelines ready unless the frame waits for
  /// them.
  [[nodiscard]] bool takes_part(std::size_t module, const FrameBuilder& builder, const FrameView& view);
  /// Passes a view's settled results to the modules that the world demands.
  void hand_out_results(World& world, ViewId view);
  /// Warns once if the view's visualizer belongs to a module that is not demanded: the picture is then shown as it is.
  void warn_of_idle_visualizer(const FrameBuilder& builder);
  /// After a frame: frees the memory of modules that no view has demanded for kFramesUntilRelease frames, and the
  /// pipelines of modules that no world has demanded for as long.
  void release_idle_modules();
  /// Collects the counters of a view whose passes were declared, from the modules that took part in it.
  void count_view(const World& world, const FrameBuilder& builder);
  /// Makes the counters of the frame's last view those of the report.
  void collect_counters();
  /// Adds counters from the last view's results in the newest completed frame.
  void add_result_counters(std::map<std::string, double>& all) const;

  RendererOptions options;
  gpu::DeviceUser device_user;
  bool drawing = false;  ///< a frame is being drawn
  KnobRegistry knobs;
  std::optional<KnobRegistry> settled;       ///< the last values whose pipelines were ready; background only
  const KnobRegistry* frame_knobs = &knobs;  ///< of the current frame
  Schedule schedule;
  Pipelines pipelines;
  std::optional<UploadRing> uniforms;
  std::optional<UploadRing> storage;
  FrameResults results;
  declare::State declared;
  MotionHistory motion;
  History history;
  CameraCuts cuts;
  FrameGraph graph;
  std::map<std::uint64_t, std::unique_ptr<GpuScene>> scenes;
  std::size_t assets_pending = 0;  ///< of the world drawn last
  std::shared_ptr<const RendererToken> token = std::make_shared<const RendererToken>();
  std::uint64_t next_slot = 1;
  std::map<std::uint64_t, CheckedInstances> checked_instances;      ///< by RenderSlot
  std::map<std::uint64_t, std::weak_ptr<const WorldToken>> worlds;  ///< that were prepared, by RenderSlot
  std::map<std::uint32_t, ViewImages> images;
  std::map<std::uint32_t, std::uint32_t> companion_idle_frames;  ///< of the companions that frames have drawn, by id
  /// The following members are of the current frame; pass functions refer to them.
  std::vector<FrameView> frame_views;
  FrameDraws draws;
  Board shared;
  std::vector<std::unique_ptr<FrameBuilder>> builders;
  std::map<gpu::ImageHandle, LightTarget> light_targets;  ///< of captures, by image; the first one of each
  std::vector<ModuleRuntime> runtimes;                    ///< by module
  std::set<std::string> told;                             ///< warnings that were given; each is given once
  std::vector<ViewRequest> last_requests;
  std::map<std::string, double> counters;
  std::vector<ViewCounters> declared_counters;  ///< of the frame that is being declared
  std::vector<ViewCounters> view_counters;      ///< of the last frame
  std::vector<ResultKey> counted_results;       ///< of the last view
  std::optional<CopyRequest> copy_request;
  std::unique_ptr<Captures> copies;  ///< of a frame that Renderer::draw_again has drawn
  double cpu_ms = 0.0;
  std::uint64_t submitted_ns = 0;  ///< FrameReport::submitted_ns
};

}  // namespace gloam
