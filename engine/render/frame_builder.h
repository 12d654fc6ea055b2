// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <any>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <typeindex>
#include <unordered_map>
#include <vector>

#include "engine/core/log.h"
#include "engine/frame/frame_graph.h"
#include "engine/frame/frame_results.h"
#include "engine/frame/upload.h"
#include "engine/jobs/executor.h"
#include "engine/render/draws/draw_lists.h"
#include "engine/render/knobs/knobs.h"
#include "engine/render/outputs.h"
#include "engine/render/pipelines.h"
#include "engine/render/view.h"

namespace gloam {

/// What lives as long as the renderer and passes need.
struct FrameServices {
  gpu::Device& device;
  JobExecutor& executor;
  LogSink& log;
  const KnobRegistry& knobs;
  Pipelines& pipelines;
  UploadRing& uniforms;
  UploadRing& storage;
  FrameResults& results;
  bool wait_for_pipelines = true;  ///< false: where there is a choice, take what is ready (Pipelines::request)
};

/// One view of one frame while its passes are declared: handed to the modules in turn. References are valid until the
/// frame is submitted, which is when pass functions run: they may capture the builder.
class FrameBuilder {
 public:
  FrameBuilder(const FrameServices& services, FrameGraph& graph, const World& world, const RenderView& view,
               const GpuScene& scene, DrawLists draws)
      : services_(services), graph_(graph), world_(world), view_(view), scene_(scene), draws_(std::move(draws)) {}
  FrameBuilder(const FrameBuilder&) = delete;
  FrameBuilder& operator=(const FrameBuilder&) = delete;

  [[nodiscard]] const FrameServices& services() const { return services_; }
  [[nodiscard]] FrameGraph& graph() { return graph_; }
  [[nodiscard]] const World& world() const { return world_; }
  [[nodiscard]] const RenderView& view() const { return view_; }
  [[nodiscard]] const GpuScene& scene() const { return scene_; }
  [[nodiscard]] const DrawLists& draws() const { return draws_; }
  /// What casts shadows, in the camera's view or not; empty when no module that the world demands has asked
  /// (Module::needs_casters).
  [[nodiscard]] const CasterList& casters() const { return draws_.casters; }
  [[nodiscard]] const KnobRegistry& knobs() const { return services_.knobs; }
  [[nodiscard]] std::string_view visualizer() const { return visualizer_; }
  void set_visualizer(std::string_view name) { visualizer_ = name; }

  /// Puts what later passes look for: GeometryOutputs, LitOutput, and each module's outputs. One of a type.
  template <class T>
  T& put(T value) {
    return std::any_cast<T&>(board_.insert_or_assign(std::type_index(typeid(T)), std::move(value)).first->second);
  }
  /// Null when nobody put one.
  template <class T>
  [[nodiscard]] T* find() {
    const auto found = board_.find(std::type_index(typeid(T)));
    return found == board_.end() ? nullptr : &std::any_cast<T&>(found->second);
  }
  template <class T>
  [[nodiscard]] const T* find() const {
    const auto found = board_.find(std::type_index(typeid(T)));
    return found == board_.end() ? nullptr : &std::any_cast<const T&>(found->second);
  }
  template <class T>
  [[nodiscard]] T& get() {
    T* found = find<T>();
    GLOAM_ASSERT(found != nullptr, "a pass needs an output that no earlier pass has put");
    return *found;
  }

  /// The view's constants (ViewConstants) as binding 0 of set 0.
  [[nodiscard]] gpu::Binding view_binding() const { return {0, view_range_}; }
  [[nodiscard]] Status upload_view_constants(std::uint32_t visualizer_code);

  /// Draws a list with one surface pass inside a pass that is rendering. `bindings` are those of set 0.
  [[nodiscard]] Status draw_surfaces(PassContext& context, std::span<const Draw> draws, const SurfacePass& pass,
                                     std::span<const gpu::Binding> bindings);
  /// Pipelines of a list, made before recording so that errors surface in declaration.
  [[nodiscard]] Status prepare_surfaces(std::span<const Draw> draws, const SurfacePass& pass);
  /// Whether the pipelines of a list are there; those that are not are made in the background. For passes that another
  /// can stand in for.
  [[nodiscard]] bool request_surfaces(std::span<const Draw> draws, const SurfacePass& pass);
  /// The same, but makes none.
  [[nodiscard]] bool has_surfaces(std::span<const Draw> draws, const SurfacePass& pass) const;
  /// Declares that a pass draws meshes or casters: reads deformed vertices.
  void read_vertices(PassBuilder& pass);
  /// For a pipeline that draws casters: binds positions (vec3, moved where the caster is deformed) as stream 0 and,
  /// `with_surfaces`, PackedSurface as stream 1; relative to the primitive's first vertex, as its indices
  /// (GpuScene::indices) are.
  void bind_caster_vertices(PassContext& context, const Caster& caster, bool with_surfaces) const;

  /// Keeps what a buffer holds at the end of the frame for the CPU to look at later (Module::take_result,
  /// Module::result_counters). `buffer`: the version that no later pass writes.
  void keep_result(std::string module, std::string name, BufferRef buffer, std::any note = {});

  /// Lets Renderer::read_image find an image of this view, under the image's own name or `name`; as it is when all
  /// passes have written it. One that is owned outside the graph was made as a transfer_source. A later image of the
  /// same name takes its place.
  void expose(ImageRef image, std::string_view name = {});
  struct Exposed {
    std::string name;
    ImageRef image;  ///< a version of it
  };
  [[nodiscard]] std::span<const Exposed> exposed() const { return exposed_; }

  /// Nearest and linear clamped samplers for full-screen passes.
  [[nodiscard]] Result<gpu::SamplerHandle> nearest_sampler() const;
  [[nodiscard]] Result<gpu::SamplerHandle> linear_sampler() const;

  /// Deformed vertex streams of this view; set by the deform pass.
  struct Deformed {
    BufferRef positions;
    BufferRef frames;
  };

 private:
  FrameServices services_;
  FrameGraph& graph_;
  const World& world_;
  const RenderView& view_;
  const GpuScene& scene_;
  DrawLists draws_;
  std::string_view visualizer_ = "none";
  gpu::Binding::BufferRange view_range_;
  std::unordered_map<std::type_index, std::any> board_;
  std::vector<Exposed> exposed_;
};

/// A colour image of the view's size (divided by `divisor`, rounded up), transient.
[[nodiscard]] ImageRef create_view_image(FrameBuilder& frame, std::string name, std::string module, gpu::Format format,
                                         std::uint32_t divisor = 1);

/// Begins drawing into images of the view's size; viewport and scissor are all of it.
void begin_view_rendering(gpu::CommandList& commands, const RenderView& view, gpu::RenderingDesc rendering);

/// Records one full-screen triangle into `target` with a pipeline of `fullscreen.vert`. Bindings are those of set 0.
struct FullscreenPass {
  gpu::PipelineHandle pipeline;
  std::vector<gpu::Binding> bindings;
  gpu::ImageHandle target;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  gpu::LoadOp load = gpu::LoadOp::discard;  ///< load: what is in the target is kept or blended over
  std::span<const std::byte> constants;     ///< pushed when there are any
};
void record_fullscreen(gpu::CommandList& commands, const FullscreenPass& pass);
[[nodiscard]] gpu::GraphicsPipelineDesc fullscreen_pipeline(std::string name, std::string module,
                                                            gpu::ShaderCode fragment, gpu::Format format);

}  // namespace gloam
