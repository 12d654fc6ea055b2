// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/ecs/world.h"
#include "engine/frame/frame_results.h"
#include "engine/render/knobs/knobs.h"
#include "engine/render/knobs/measure.h"
#include "engine/render/pipelines.h"
#include "engine/render/reference/reference.h"
#include "engine/render/view.h"
#include "engine/scene/key_registry.h"
#include "engine/schedule/schedule.h"

namespace gloam {

class Captures;
class FrameBuilder;

/// Whether a world and view call for an effect, and why (or why not), in a few words for people.
struct Demand {
  bool needed = false;
  std::string reason;
};

/// Where in the frame a module adds passes; inside a phase, modules come in the order of their list.
enum class PassPhase {
  announce,     ///< no passes: what modules leave on the board for modules that come before them
  lists,        ///< after geometry and depth bounds: light lists, shadows
  shading,      ///< opaque surfaces and sky into linear light
  translucent,  ///< forward-lit things over them
  post,         ///< on linear light: depth of field, bloom. Automatic exposure meters what this phase leaves
  output,       ///< linear light → picture: meters (where no exposure is set), then maps tones
  visualize,    ///< over the picture, when FrameBuilder::visualizer() names one of the module's
};
inline constexpr PassPhase kAllPhases[] = {PassPhase::announce,    PassPhase::lists, PassPhase::shading,
                                           PassPhase::translucent, PassPhase::post,  PassPhase::output,
                                           PassPhase::visualize};

/// A picture a module can show instead of the lit one.
struct VisualizerInfo {
  std::string name;  ///< "light_list"; takes an argument after ':' when `argument` is not empty
  std::string module;
  std::string argument;    ///< "LIGHT"
  std::string legend;      ///< what colours mean, one line
  bool built = true;       ///< false: known, not built yet
  std::string knob = {};   ///< what must be set so for the view to have something to show; empty: nothing
  std::string value = {};  ///< one choice, or some: "monolithic|deferred"
  /// Set when the view shows what has to be traced first: computes it from a frame that has been drawn without the view
  /// (whose pictures and redraw may be absent) and puts it into the world, for the frame that shows it. Who cannot wait
  /// for that does not offer the view.
  std::function<Status(World& world, const ReferenceInput& input)> trace = {};
};

/// A pixel that Renderer::pick was asked about, and what lies there.
struct PickedPixel {
  std::uint32_t x = 0;
  std::uint32_t y = 0;
  float depth = 0.0f;         ///< reversed Z; 0 is sky
  float view_depth_m = 0.0f;  ///< 0 for sky
};

/// Named numbers of a frame ("lights.visible").
class CounterSink {
 public:
  virtual ~CounterSink() = default;
  virtual void count(std::string_view name, double value) = 0;
};

/// One effect. Made once a renderer; its state of a world lives in the world, its GPU state in itself. What a world
/// does not demand adds no systems to run, passes, pipelines or bytes.
class Module {
 public:
  virtual ~Module() = default;

  [[nodiscard]] virtual std::string_view name() const = 0;
  /// False while only its components and keys exist: what calls for it is told, nothing is drawn.
  [[nodiscard]] virtual bool built() const { return true; }

  virtual void register_components(World& world) const = 0;
  virtual void scene_keys(KeyRegistry& registry) const = 0;
  virtual void knobs(KnobRegistry& registry) const { static_cast<void>(registry); }
  /// For knobs that are judged by more than their most exact value; at most one a knob.
  [[nodiscard]] virtual std::vector<ReferenceInfo> references() const { return {}; }
  /// For knobs whose values all give the same picture: what else tells them apart; at most one a knob, which then needs
  /// no reference.
  [[nodiscard]] virtual std::vector<MeasureInfo> measures() const { return {}; }
  virtual void add_systems(Schedule& schedule) { static_cast<void>(schedule); }
  [[nodiscard]] virtual std::vector<VisualizerInfo> visualizers() const { return {}; }

  /// Asked twice. Without a view (before a frame's systems, and by `inspect`) the world's answer: "no" means that no
  /// systems run and that no view is asked, so it must cover every view's. With a view (after that view's systems) the
  /// view's answer: "no" means no passes in this view; the systems ran all the same. Cheap: looks at counts, never at
  /// pixels.
  [[nodiscard]] virtual Demand demand(const World& world, const RenderView* view) const = 0;

  /// Before the systems of a view run, when the world demands the module: puts missing view resources in place, and
  /// what systems need to know of knobs into them.
  virtual void prepare_view(World& world, ViewId view, const KnobRegistry& knobs) const {
    static_cast<void>(world);
    static_cast<void>(view);
    static_cast<void>(knobs);
  }
  /// Whether the module's passes look at FrameBuilder::casters(); asked once a frame, when the world demands the
  /// module.
  [[nodiscard]] virtual bool needs_casters(const World& world, const KnobRegistry& knobs) const {
    static_cast<void>(world);
    static_cast<void>(knobs);
    return false;
  }
  /// Whether they shall have simplified indices (GpuPrimitive::simplified_index_count), asked likewise: made when first
  /// wanted.
  [[nodiscard]] virtual bool needs_simplified_casters(const World& world, const KnobRegistry& knobs) const {
    static_cast<void>(world);
    static_cast<void>(knobs);
    return false;
  }
  /// Whether a frame without the module makes no sense: then its pipelines are waited for even under
  /// Readiness::background.
  [[nodiscard]] virtual bool essential() const { return false; }
  /// The pipelines add_passes will ask for with the knobs as they are; only asked under Readiness::background.
  virtual void pipelines(const KnobRegistry& knobs, const gpu::DeviceInfo& device, PipelineList& list) const {
    static_cast<void>(device);
    static_cast<void>(knobs);
    static_cast<void>(list);
  }
  /// Only called when world and view demand it, once a phase. Pipelines are made on first use.
  [[nodiscard]] virtual Status add_passes(FrameBuilder& frame, PassPhase phase) {
    static_cast<void>(frame);
    static_cast<void>(phase);
    return {};
  }
  /// Once a frame, for its last view: if the module took part in that view (demanded by world and view, pipelines
  /// there), when its passes have been recorded and before they are submitted. What counts here is known on the CPU.
  virtual void counters(const World& world, const RenderView& view, CounterSink& sink) const {
    static_cast<void>(world);
    static_cast<void>(view);
    static_cast<void>(sink);
  }
  /// In a frame drawn for Renderer::pick, after all phases: copies out what `pick` will look at. Names begin with the
  /// module's.
  [[nodiscard]] virtual Status add_pick_copies(FrameBuilder& frame, Captures& copies) {
    static_cast<void>(frame);
    static_cast<void>(copies);
    return {};
  }
  /// When that frame has ended on the GPU: what the module knows of the pixel, in lines for people.
  [[nodiscard]] virtual std::vector<std::string> pick(FrameBuilder& frame, const PickedPixel& pixel,
                                                      const Captures& copies) const {
    static_cast<void>(frame);
    static_cast<void>(pixel);
    static_cast<void>(copies);
    return {};
  }
  /// Before the systems of a view run, when the world demands the module, for each of its results
  /// (FrameBuilder::keep_result) of that view: the newest of those that are Device::kFramesInFlight or more frames old.
  /// The same one may come again.
  virtual void take_result(World& world, ViewId view, std::string_view name, const FrameResult& result) const {
    static_cast<void>(world);
    static_cast<void>(view);
    static_cast<void>(name);
    static_cast<void>(result);
  }
  /// Counters that the GPU counted, for reports: from a result of the newest frame that has ended.
  virtual void result_counters(std::string_view name, const FrameResult& result, CounterSink& sink) const {
    static_cast<void>(name);
    static_cast<void>(result);
    static_cast<void>(sink);
  }
  /// Gives back GPU memory, after 120 frames without demand and at the end; the next demand makes it anew. Pipelines
  /// are the renderer's.
  virtual void release() {}
};

using ModuleList = std::vector<std::unique_ptr<Module>>;

/// The scene keys of engine and modules: what import_gltf reads.
[[nodiscard]] KeyRegistry make_key_registry(const ModuleList& modules);

}  // namespace gloam
