// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/ecs/entity.h"
#include "engine/math/types.h"
#include "engine/render/knobs/knobs.h"
#include "engine/render/knobs/measure.h"
#include "engine/render/pipelines/pipeline_list.h"
#include "engine/render/view.h"

namespace gloam {

// Declared only, because they are costly to include: a module's source includes the headers of those that it uses.
class Captures;
class FrameBuilder;
class KeyRegistry;
class Schedule;
class World;
struct FrameResult;
struct ReferenceInfo;
struct ReferenceInput;

/// A module's answer to the question whether a world or a view needs it, with the reason in a few words for users.
struct Demand {
  bool needed = false;
  std::string reason;
};

/// Phases of a frame in which modules add passes. Within a phase, modules come in list order.
enum class PassPhase {
  announce,     ///< no passes: modules put data on the board that modules earlier in the list need
  geometry,     ///< draws solid surfaces into the geometry buffer and its depth (geometry_targets)
  lists,        ///< after geometry and depth bounds: light lists, shadows
  shading,      ///< lights opaque surfaces and sky, into linear light
  translucent,  ///< forward-lit surfaces over them
  post,         ///< on linear light: depth of field, bloom. Automatic exposure meters the result
  output,       ///< linear light → picture: metering (if no exposure is set), then tone mapping
  visualize,    ///< over the picture, if FrameBuilder::visualizer() is one of the module's
};
inline constexpr PassPhase kAllPhases[] = {PassPhase::announce, PassPhase::geometry,    PassPhase::lists,
                                           PassPhase::shading,  PassPhase::translucent, PassPhase::post,
                                           PassPhase::output,   PassPhase::visualize};

/// The colour scale of a visualizer that shows numbers: heat colours from 0 to `most` times ViewSettings::heat_range.
struct HeatScale {
  double most = 0.0;  ///< 0: the visualizer has no such scale
  std::string unit = {};
  bool counts = false;  ///< the numbers are counts: legends show whole numbers only
};

/// A picture a module can show instead of the lit one.
struct VisualizerInfo {
  std::string name;  ///< "light_list"; takes an argument after ':' when `argument` is not empty
  std::string module;
  std::string argument;    ///< "LIGHT"
  std::string legend;      ///< meaning of the colours, one line
  std::string knob = {};   ///< knob that must be at `value` for the visualizer to work; empty: none
  std::string value = {};  ///< one choice, or several: "monolithic|deferred"
  /// Set if the visualizer shows traced data. Computes the data from a frame drawn without the visualizer and puts it
  /// into the world, for the frame that shows it. `picture` and `redraw` of the input may be absent. Callers that
  /// cannot wait must not offer the visualizer.
  std::function<Status(World& world, const ReferenceInput& input)> trace = {};
  std::string image = {};  ///< exposed image with the values that it shows (FrameBuilder::expose); empty: called `name`
  /// The visualizer shows lists whose buffers may be too small in the first frames after a change: callers that show a
  /// single frame draw until no tile overflows.
  bool shows_lists = false;
  HeatScale heat = {};
};

/// The pixel of a call of Renderer::pick, and its depth.
struct PickedPixel {
  std::uint32_t x = 0;
  std::uint32_t y = 0;
  float depth = 0.0f;          ///< reversed Z; 0 is sky
  float view_depth_m = 0.0f;   ///< 0 for sky
  vec3 position = vec3(0.0f);  ///< camera-relative, metres; not set for sky
  vec3 normal = vec3(0.0f);    ///< shading normal, unit length; 0 for sky
};

/// Something in a world that has no effect as it is, for the log: "ENTITY FAULT".
struct Oversight {
  Entity entity;
  std::string fault;  ///< "has a Light but no WorldTransform: it lights nothing"
};

/// Receives counters of a frame, by name ("lights.visible").
class CounterSink {
 public:
  virtual ~CounterSink() = default;
  virtual void count(std::string_view name, double value) = 0;
};

/// One effect. Created once per renderer. Its state of a world lives in the world, its GPU state in the module. If a
/// world does not demand the module, it runs no systems and adds no passes, pipelines or bytes.
class Module {
 public:
  virtual ~Module() = default;

  [[nodiscard]] virtual std::string_view name() const = 0;

  /// Names of the modules that must be in the list, and of all that must come earlier if they are in it. The renderer
  /// asserts both.
  [[nodiscard]] virtual std::vector<std::string_view> needs() const { return {}; }
  [[nodiscard]] virtual std::vector<std::string_view> follows() const { return {}; }

  virtual void register_components(World& world) const = 0;
  virtual void scene_keys(KeyRegistry& registry) const = 0;
  virtual void knobs(KnobRegistry&) const {}
  /// References for knobs that are not judged by the frame at their exact value; at most one per knob.
  [[nodiscard]] virtual std::vector<ReferenceInfo> references() const;
  /// Measures for knobs whose values all draw the same picture; at most one per knob. A knob with a measure needs no
  /// reference.
  [[nodiscard]] virtual std::vector<MeasureInfo> measures() const;
  /// Why a knob of the module changes nothing in the view's last frame, in a few words for users: "no reflection proxy
  /// is active". Empty: the module cannot tell. Asked for knobs whose values draw equal pictures, so the reason need
  /// not exclude all others, but must be true. counters: of that frame.
  [[nodiscard]] virtual std::string idle_knob(const World&, const RenderView&, std::string_view /*knob*/,
                                              const FrameCounters& /*counters*/) const {
    return {};
  }
  virtual void add_systems(Schedule&) {}
  [[nodiscard]] virtual std::vector<VisualizerInfo> visualizers() const { return {}; }

  /// view null: whether the world needs the module. Called before a frame's systems run, and by `inspect`. If not
  /// needed, no systems run and demand() is not called for views, so it must be needed if any view needs it. view set:
  /// whether this view needs the module. Called after the systems of the view. If not needed, the view gets no passes;
  /// its systems have run anyway. Must be cheap: look at counts, never at pixels.
  [[nodiscard]] virtual Demand demand(const World& world, const RenderView* view) const = 0;

  /// Why the module does nothing with these knobs, e.g. "shadows.mode=off"; empty: it may do something. Then it counts
  /// as not demanded: no systems, no passes, and its memory is freed after 120 frames. Asked for the knobs of the frame
  /// if the world demands the module, and for the knobs of each view.
  [[nodiscard]] virtual std::string switched_off(const World&, const KnobRegistry&) const { return {}; }
  /// Called in each frame, before the systems of the world run, if the world does not demand the module: takes away
  /// what its systems left in the world, so that nothing there is out of date. Must be cheap if nothing is left.
  virtual void leave_world(World&) const {}
  /// Whether the module itself draws something into the view that lights may light: surfaces, sprites or fog. If there
  /// is none of it, no mesh and no geometry of the host, only sky is seen (SeenSurfaces), and modules that light, shade
  /// or smooth surfaces are idle. A module that only works on what others draw returns false. Called like demand() with
  /// a view; SeenSurfaces is not known yet.
  [[nodiscard]] virtual bool shows_surfaces(const World&, const RenderView&) const { return true; }

  /// Called before the systems of the world run, if the world demands the module. Stores the knob values that they need
  /// in resources of the world.
  virtual void prepare_world(World&, const KnobRegistry&) const {}
  /// Called for each view before the systems of any view run, if the world demands the module. Adds missing view
  /// resources, and stores in them the knob values that systems need.
  virtual void prepare_view(World&, ViewId, const KnobRegistry&) const {}
  /// Adds views that must be drawn before the view `main` in the same frame, for example mirrored ones. Called in every
  /// frame for each view that is no capture, after the systems of the world, if the world demands the module and the
  /// view does not leave it out. main: with pose and size of this frame. Start from a copy of it. Companions draw no
  /// pictures: they end before PassPhase::output, and their light and depth are in CompanionLight of
  /// FrameBuilder::shared() when the passes of `main` are declared. Modules may share with a companion what they keep
  /// for its main view (RenderView::main_view). Companions have no companions.
  virtual void companion_views(World&, const ViewSettings& /*main*/, const KnobRegistry&, CompanionViews&) const {}
  /// Sentences about things in a loaded scene that are likely mistakes, without a full stop. For `inspect`.
  [[nodiscard]] virtual std::vector<std::string> warnings(const World&) const { return {}; }
  /// Entities that have components of the module without any effect. Called in every frame, so it must be cheap. The
  /// renderer logs each fault once per world.
  [[nodiscard]] virtual std::vector<Oversight> oversights(const World&) const { return {}; }
  /// Whether the module's passes read FrameBuilder::casters(). Called in every frame, if the world demands the module.
  [[nodiscard]] virtual bool needs_casters(const World&, const KnobRegistry&) const { return false; }
  /// Whether these casters need simplified indices (GpuPrimitive::simplified_index_count), which are made when first
  /// needed. Called like needs_casters.
  [[nodiscard]] virtual bool needs_simplified_casters(const World&, const KnobRegistry&) const { return false; }
  /// Whether casters may be drawn with fewer triangles (Caster::levels). Called like needs_casters.
  [[nodiscard]] virtual bool needs_caster_levels(const World&, const KnobRegistry&) const { return false; }
  /// Whether the module's passes read GeometryOutputs::motion. Called like needs_casters; views that do not demand the
  /// module get no motion for it.
  [[nodiscard]] virtual bool needs_motion(const World&, const KnobRegistry&) const { return false; }
  /// Whether the module accumulates pictures over frames, and so wants each frame to show other points of the pixels
  /// (RenderView::jitter). Called like needs_casters. Jittered are views that draw a picture of their own geometry:
  /// no captures, references, visualizers, points of a lens or geometry of the host. Companions have the jitter of
  /// their view.
  [[nodiscard]] virtual bool wants_jitter(const World&, const KnobRegistry&) const { return false; }
  /// How many frames of a view at rest it takes until its picture is complete: more than 0 if the module accumulates
  /// pictures. Tools draw as many before they keep or judge a picture. Called like needs_casters.
  [[nodiscard]] virtual std::uint32_t frames_to_rest(const World&, const KnobRegistry&) const { return 0; }
  /// Whether the module's passes read GeometryOutputs::smooth_surfaces. Called like needs_motion.
  [[nodiscard]] virtual bool needs_smooth_surfaces(const World&, const KnobRegistry&) const { return false; }
  /// Whether the module changes the picture from frame to frame while camera, knobs and components stay the same: it
  /// simulates, or adapts to earlier frames. Tools then do not keep a picture of the world in place of drawing it.
  /// Accumulation that comes to rest (frames_to_rest) does not count. Called like needs_casters.
  [[nodiscard]] virtual bool changes_at_rest(const World&, const KnobRegistry&) const { return false; }
  /// Whether the module is told to compute every frame anew. Frames in which nothing has changed are then drawn, too,
  /// although scene.reuse would keep the last one. Called like needs_casters.
  [[nodiscard]] virtual bool computes_every_frame(const World&, const KnobRegistry&) const { return false; }
  /// Whether a frame without the module makes no sense. Then frames wait for its pipelines even with
  /// Readiness::background.
  [[nodiscard]] virtual bool essential() const { return false; }
  /// Appends the pipelines that add_passes will need with the current knobs. Called only with Readiness::background.
  virtual void pipelines(const KnobRegistry&, const gpu::DeviceInfo&, PipelineList&) const {}
  /// Adds the passes of one phase. Called once per phase for each view, if world and view demand the module. Pipelines
  /// are compiled on first use. Errors go to FrameBuilder::fail, which gives the frame up.
  virtual void add_passes(FrameBuilder&, PassPhase) {}
  /// Reports counters that are known on the CPU. Called once per frame for each view, if the module took part in that
  /// view (demanded by world and view, pipelines ready), after its passes were declared and before the frame is
  /// recorded.
  virtual void counters(const World&, const RenderView&, CounterSink&) const {}
  /// Declares readback copies of the data that `pick` reads. Called after all phases of a frame that is drawn for
  /// Renderer::pick. Names of copies begin with the module's name.
  [[nodiscard]] virtual Status add_pick_copies(FrameBuilder&, Captures&) { return {}; }
  /// Facts about the pixel, as lines of text. Called after that frame has ended on the GPU; `copies` holds its data.
  [[nodiscard]] virtual std::vector<std::string> pick(FrameBuilder&, const PickedPixel&,
                                                      const Captures& /*copies*/) const {
    return {};
  }
  /// Called before the systems of a view run, if the world demands the module, for each of its results of that view
  /// (FrameBuilder::keep_result). `result` is the newest one that is at least Device::kFramesInFlight frames old. The
  /// same result may be passed several times.
  virtual void take_result(World&, ViewId, std::string_view /*name*/, const FrameResult& /*result*/) const {}
  /// Reports counters that the GPU counted, from a result of the newest completed frame.
  virtual void result_counters(std::string_view /*name*/, const FrameResult&, CounterSink&) const {}
  /// Whether the last frame of the view did only a part of the work that a change of knobs has made, because the view
  /// is paced (RenderView::paced). Such frames say nothing about the time that the knobs take.
  [[nodiscard]] virtual bool spreads_work(const World&, const RenderView&) const { return false; }
  /// Frees what the module keeps for this view in any world. Called by Renderer::release_view.
  virtual void release_view(ViewId) {}
  /// Frees GPU memory that the next frames will hardly need: staging of what is uploaded once, room that only past
  /// frames have filled. The GPU is idle. Called by Renderer::free_idle_memory.
  virtual void free_idle_memory() {}
  /// Called when a frame is given up (an error, an exception) that declared passes of the module: the GPU executes
  /// nothing of this frame. The module forgets what it noted as done while these passes were declared or recorded, so
  /// that the next frame does it. `frame`: the frame's Device::frame_number. The default frees all of the module's
  /// memory; modules that keep data which cannot be made again override it.
  virtual void give_up_frame(std::uint64_t /*frame*/) { release(); }
  /// Frees the module's GPU memory. Called after 120 frames without demand and when the renderer is destroyed; the
  /// module allocates the memory again when it is next needed. The renderer owns the pipelines.
  virtual void release() {}
};

using ModuleList = std::vector<std::unique_ptr<Module>>;

/// Asserts that no module is null, that all have different names, and that they come in the order that they ask for
/// (Module::needs, Module::follows).
void check_modules(const ModuleList& modules);

/// The scene keys of the engine and all modules, for import_gltf.
[[nodiscard]] KeyRegistry make_key_registry(const ModuleList& modules);

}  // namespace gloam
