// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <any>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/log.h"
#include "engine/frame/frame_graph.h"
#include "engine/frame/history.h"
#include "engine/frame/transfers/results.h"
#include "engine/frame/transfers/upload.h"
#include "engine/jobs/executor.h"
#include "engine/render/board.h"
#include "engine/render/draws/caster_source.h"
#include "engine/render/draws/draw_lists.h"
#include "engine/render/draws/motion_history.h"
#include "engine/render/knobs/knobs.h"
#include "engine/render/outputs.h"
#include "engine/render/pipelines/pipelines.h"
#include "engine/render/view.h"

namespace gloam {

namespace declare {
struct State;
}  // namespace declare

/// How a pass samples an image: clamped to the edge, mips by the same filter.
enum class Sampling : std::uint8_t { nearest, linear };

/// Services of the renderer for passes. They live as long as the renderer.
struct FrameServices {
  gpu::Device& device;
  JobExecutor& executor;
  LogSink& log;
  const KnobRegistry& knobs;
  Pipelines& pipelines;
  UploadRing& uniforms;
  UploadRing& storage;
  FrameResults& results;
  declare::State& declared;  ///< of passes that bind by name
  History& history;
  bool wait_for_pipelines = true;  ///< false: prefer ready pipelines where there is a choice (Pipelines::request)
};

/// One view of one frame while its passes are declared; the renderer gives it to each module in turn. The builder and
/// everything it refers to live until the frame is submitted. Pass functions run before that, so they may capture the
/// builder.
class FrameBuilder {
 public:
  /// Number `view_index` of the frame's views.
  FrameBuilder(const FrameServices& services, FrameGraph& graph, const World& world, const RenderView& view,
               const GpuScene& scene, const FrameDraws& draws, std::size_t view_index, Board& shared)
      : services_(services),
        graph_(graph),
        world_(world),
        view_(view),
        scene_(scene),
        draws_(draws),
        view_index_(view_index),
        shared_(shared),
        log_(services.log, "render") {}
  FrameBuilder(const FrameBuilder&) = delete;
  FrameBuilder& operator=(const FrameBuilder&) = delete;

  [[nodiscard]] const FrameServices& services() const { return services_; }
  [[nodiscard]] FrameGraph& graph() { return graph_; }
  [[nodiscard]] const World& world() const { return world_; }
  [[nodiscard]] const RenderView& view() const { return view_; }
  [[nodiscard]] const GpuScene& scene() const { return scene_; }
  [[nodiscard]] const ViewDraws& draws() const { return draws_.views[view_index_]; }
  /// Draws of all views of the frame, and what they share.
  [[nodiscard]] const FrameDraws& frame_draws() const { return draws_; }
  /// All shadow casters, in the camera's view or not; empty if no module that the world demands needs them
  /// (Module::needs_casters).
  [[nodiscard]] const CasterList& casters() const { return draws_.casters; }
  /// Adds a caster without a mesh, for this view and frame. Asserts after the first call of caster_sources(): call it
  /// in PassPhase::announce, because shadow maps are declared in PassPhase::lists.
  void add_caster_source(CasterSource source);
  /// All caster sources, in the order in which they were added.
  [[nodiscard]] std::span<const CasterSource* const> caster_sources();
  /// The world's instances in the previous frame; null if the view has no motion (GeometryOutputs::motion).
  [[nodiscard]] const DrawnInstances* previous_instances() const { return previous_instances_; }
  void set_previous_instances(const DrawnInstances* instances) { previous_instances_ = instances; }
  [[nodiscard]] const KnobRegistry& knobs() const { return services_.knobs; }
  [[nodiscard]] std::string_view visualizer() const { return visualizer_; }
  /// ViewSettings::heat_range.
  [[nodiscard]] float heat_range() const { return heat_range_; }
  void set_visualizer(std::string_view name, float heat_range) {
    visualizer_ = name;
    heat_range_ = heat_range;
  }

  /// The module that is adding passes: passes, images and pipelines made by name belong to it. "engine" outside of
  /// Module::add_passes.
  [[nodiscard]] std::string_view module() const { return module_; }
  void set_module(std::string_view name) {
    module_ = name;
    log_ = LogCategory(services_.log, name);
  }
  /// FrameServices::log with the module as its category.
  [[nodiscard]] LogSink& log() { return log_; }

  /// Gives the frame up: it is not submitted, and Renderer::render returns the first error that was passed.
  void fail(Error error) {
    if (status_.ok()) status_ = std::move(error);
  }
  /// Whether the result holds a value; if not, fail() gets its error.
  template <class T>
  [[nodiscard]] bool check(const Result<T>& result) {
    if (!result.ok()) fail(result.error());
    return result.ok();
  }
  [[nodiscard]] bool check(const Status& status) {
    if (!status.ok()) fail(status.error());
    return status.ok();
  }
  [[nodiscard]] const Status& status() const { return status_; }

  /// Puts an output on the board for later passes: GeometryOutputs, LitOutput, and each module's outputs. The board
  /// holds one output per type; a second one replaces the first.
  template <class T>
  T& put(T value) {
    return board_.put(std::move(value));
  }
  /// The output of this type, or null if there is none.
  template <class T>
  [[nodiscard]] T* find() {
    return board_.find<T>();
  }
  template <class T>
  [[nodiscard]] const T* find() const {
    return board_.find<T>();
  }
  template <class T>
  [[nodiscard]] T& get() {
    T* found = find<T>();
    GLOAM_ASSERT(found != nullptr, absent_output(type_name<T>()));
    return *found;
  }

  /// The frame's board: outputs of earlier views of this frame that later ones may use. One per type, like the view's
  /// board; empty at the begin of a frame.
  [[nodiscard]] Board& shared() { return shared_; }
  [[nodiscard]] const Board& shared() const { return shared_; }

  /// An image that views of this or of earlier frames capture light into (ViewTarget::light): with what earlier views
  /// of this frame have captured, otherwise as it was. ready: the access that the image is left ready for between
  /// frames (LightTarget::before and after).
  [[nodiscard]] ImageRef captured_light(gpu::ImageHandle image, gpu::Access ready);

  /// The view's constants (ViewConstants) as binding 0 of set 0.
  [[nodiscard]] gpu::Binding view_binding() const { return {0, view_range_}; }
  void upload_view_constants(std::uint32_t visualizer_code);

  /// Draws a list with one surface pass, inside a pass that is rendering. `bindings`: those of set 0. cluster_commands:
  /// as in DrawPass::surfaces.
  [[nodiscard]] Status draw_surfaces(PassContext& context, std::span<const Draw> draws, const SurfacePass& pass,
                                     std::span<const gpu::Binding> bindings, BufferRef cluster_commands = {});
  /// Compiles the pipelines of a list before recording, so that errors surface in declaration.
  [[nodiscard]] Status prepare_surfaces(std::span<const Draw> draws, const SurfacePass& pass);
  /// Whether the pipelines of a list are ready. Missing ones are compiled in the background. For passes that have a
  /// fallback.
  [[nodiscard]] bool request_surfaces(std::span<const Draw> draws, const SurfacePass& pass);
  /// Whether the pipelines of a list are ready; compiles none.
  [[nodiscard]] bool has_surfaces(std::span<const Draw> draws, const SurfacePass& pass) const;
  /// Declares that a pass draws meshes or casters and so reads deformed vertices. motion: also those of the previous
  /// frame.
  void read_vertices(PassBuilder& pass, bool motion = false);
  /// Declares that a pass of this frame binds the vertices of this caster. Deformed casters without it are not
  /// deformed, unless a view draws them.
  void use_caster_vertices(const Caster& caster);
  /// After use_caster_vertices. Binds the vertices of a caster: positions (vec3, deformed if the caster is) as stream 0
  /// and, if `with_surfaces`, PackedSurface as stream 1. Both begin at the primitive's first vertex, like its indices
  /// (GpuScene::indices).
  void bind_caster_vertices(PassContext& context, const Caster& caster, bool with_surfaces) const;

  /// Keeps the content of a buffer at the end of the frame for the CPU (Module::take_result, Module::result_counters).
  /// `buffer`: the version that no later pass writes.
  void keep_result(std::string module, std::string name, BufferRef buffer, std::any note = {});

  /// Images and buffers whose contents live over frames, of this view or of its world (engine/frame/history.h).
  /// desc.module: the module's own name; its memory goes with the module's (Module::release).
  [[nodiscard]] Result<HistoryImage> history_image(const gpu::ImageDesc& desc, const HistoryUse& use);
  [[nodiscard]] Result<HistoryBuffer> history_buffer(const gpu::BufferDesc& desc, const HistoryUse& use);
  [[nodiscard]] Result<HistoryImagePair> history_image_pair(const gpu::ImageDesc& desc, const HistoryUse& use);
  /// Calls the function after the frame was submitted, and never if the frame is given up: for state of the CPU that
  /// describes contents on the GPU.
  void on_commit(std::function<void()> function);

  /// Makes an image of this view available to Renderer::read_image, under the image's own name or `name`, with its
  /// content after all passes. An image that is owned outside the graph must have been created as a transfer_source. A
  /// later image of the same name replaces it.
  void expose(ImageRef image, std::string_view name = {});
  struct Exposed {
    std::string name;
    ImageRef image;  ///< any version of the image; the newest is read
  };
  [[nodiscard]] std::span<const Exposed> exposed() const { return exposed_; }

  /// Uploads a value as a uniform, or items as storage, for this frame. A null range, and the frame is given up, if
  /// there is no memory.
  template <class T>
  [[nodiscard]] gpu::Binding::BufferRange upload_uniform(const T& value) {
    const auto range = services_.uniforms.write_value(value);
    return check(range) ? *range : gpu::Binding::BufferRange{};
  }
  template <class T>
  [[nodiscard]] gpu::Binding::BufferRange upload_items(std::span<const T> items) {
    const auto range = services_.storage.write(std::as_bytes(items));
    return check(range) ? *range : gpu::Binding::BufferRange{};
  }
  /// A null handle, and the frame is given up, if the device cannot create it.
  [[nodiscard]] gpu::SamplerHandle sampler(Sampling sampling);

  /// Deformed vertex streams of the frame; the deform pass puts them on the shared board.
  struct Deformed {
    BufferRef positions;
    BufferRef frames;
    BufferRef previous_positions;  ///< null if no view so far has motion
    /// By index into FrameDraws::deforms: whether a view draws it or a pass has called use_caster_vertices. The
    /// vertices of all others are undefined.
    std::vector<std::uint8_t> used;
  };

 private:
  [[nodiscard]] std::string absent_output(std::string_view type) const;
  void bind_previous_vertices(PassContext& context, const Draw& draw) const;
  [[nodiscard]] HistoryView history_view() const;

  FrameServices services_;
  FrameGraph& graph_;
  const World& world_;
  const RenderView& view_;
  const GpuScene& scene_;
  const FrameDraws& draws_;
  std::size_t view_index_;
  Board& shared_;
  std::deque<CasterSource> caster_sources_;
  std::vector<const CasterSource*> caster_source_list_;
  bool caster_sources_read_ = false;
  const DrawnInstances* previous_instances_ = nullptr;
  std::string_view visualizer_ = "none";
  float heat_range_ = 1.0f;
  std::string_view module_ = "engine";
  LogCategory log_;
  Status status_;
  gpu::Binding::BufferRange view_range_;
  Board board_;
  std::vector<Exposed> exposed_;
};

/// Creates a transient image of the view's size, divided by `divisor` and rounded up. It is accounted to the module
/// that adds passes.
[[nodiscard]] ImageRef create_view_image(FrameBuilder& frame, std::string name, gpu::Format format,
                                         std::uint32_t divisor = 1);

}  // namespace gloam
