// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/frame/draw_frame.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/zones.h"
#include "engine/render/draws/levels.h"
#include "engine/render/frame/attempt.h"
#include "engine/render/frame/stages.h"
#include "engine/render/kept_frames/digest_commands.h"
#include "engine/render/report/oversights.h"
#include "engine/render/report/tell_profiler.h"
#include "engine/render/scene/scene_triangles.h"
#include "engine/render/views/seen_surfaces.h"
#include "engine/scene/resources.h"

namespace gloam {
namespace {

/// Marks that a frame is being drawn.
class Drawing {
 public:
  explicit Drawing(bool& flag) : flag_(flag) { flag_ = true; }
  ~Drawing() { flag_ = false; }
  Drawing(const Drawing&) = delete;
  Drawing& operator=(const Drawing&) = delete;

 private:
  bool& flag_;
};

/// Makes the levels of detail that the frame may draw.
Status make_levels(Frame& frame, const SceneAssets& assets, GpuScene& scene, const RendererParts& parts) {
  frame.caster_levels = frame.any_needs(parts.modules, &Module::needs_caster_levels);
  frame.view_levels =
      std::ranges::any_of(frame.views, [&](const FrameView& own) { return lod_pixels(frame.knobs_of(own)) > 0.0f; });
  if (!frame.caster_levels && !frame.view_levels) return {};
  if (!may_have_levels(frame.world)) frame.caster_levels = frame.view_levels = false;
  if (frame.caster_levels) GLOAM_TRY(scene.make_levels(assets, *parts.options.executor, LevelUse::maps));
  if (frame.view_levels) GLOAM_TRY(scene.make_levels(assets, *parts.options.executor, LevelUse::views));
  return {};
}

/// Before the device's frame: brings the world's assets to the GPU, or finds what has changed.
Status sync_assets(Frame& frame, RendererParts& parts) {
  const SceneAssets& assets = frame.world.resource<SceneAssets>();
  GpuScene& scene = parts.worlds.scene_of(frame.world);
  MeshesInUse in_use = meshes_in_use(frame.world);
  in_use.ages = frame.redraw == nullptr;
  GLOAM_TRY(scene.sync(assets, *parts.options.executor, std::move(in_use)));
  if (frame.any_needs(parts.modules, &Module::needs_simplified_casters))
    GLOAM_TRY(scene.simplify_casters(assets, *parts.options.executor));
  return make_levels(frame, assets, scene, parts);
}

/// Makes the draw lists of all views.
Status build_draws(Frame& frame, RendererParts& parts) {
  GpuScene& scene = parts.worlds.scene_of(frame.world);
  std::vector<dvec3> eyes;
  double nearest = std::numeric_limits<double>::infinity();
  for (const FrameView& own : frame.views) {
    eyes.push_back(own.view->position);
    const Camera& camera = own.view->camera;
    nearest = std::min(nearest, static_cast<double>(camera.orthographic ? camera.half_height_m : camera.near_m));
  }
  scene.split_large_triangles(frame.world, eyes, nearest);
  GLOAM_TRY(scene.stage(frame.world.resource<SceneAssets>()));
  scene.add_pass(parts.resources.graph);
  std::vector<const RenderView*> views;
  for (const FrameView& own : frame.views) views.push_back(own.view.get());
  frame.draws = build_frame_draws(
      frame.world, views, scene, *parts.options.executor,
      {.casters = frame.any_needs(parts.modules, &Module::needs_casters), .caster_levels = frame.caster_levels});
  for (std::size_t i = 0; i < frame.views.size(); ++i) {
    const auto& geometry = frame.views[i].request.geometry;
    if (geometry && !geometry->desc().draws_meshes) frame.draws.views[i] = {};
  }
  return {};
}

/// Notes whether a view may see anything but the sky.
void note_surfaces(Frame& frame, std::size_t index, RendererParts& parts) {
  const FrameView& own = frame.views[index];
  const ViewDraws& draws = frame.draws.views[index];
  const ViewId id = own.request.settings.id;
  frame.world.set_view_resource(id, SeenSurfaces{});  // modules must not see the answer of the last frame
  const bool any = !draws.solid.empty() || !draws.blended.empty() || own.request.geometry ||
                   parts.modules.view_shows_surfaces(frame.query_of(own));
  frame.world.set_view_resource(id, SeenSurfaces{any});
}

/// Everything between Device::begin_frame and submit_frame.
Status record_frame(Frame& frame, RendererParts& parts, gpu::CommandList& commands) {
  FrameResources& resources = parts.resources;
  resources.begin_frame();
  resources.pipelines.begin_frame();
  resources.motion.begin_frame(frame.world, world_id(frame.world),
                               frame.any_needs(parts.modules, &Module::needs_motion), frame.redraw != nullptr);
  GLOAM_TRY(add_companions(frame, parts.modules, *parts.options.device));
  GLOAM_TRY(prepare_views(frame, parts));
  {
    const ScopedZone zone(parts.options.profiler, "build_draws", "engine");
    GLOAM_TRY(build_draws(frame, parts));
  }
  for (std::size_t i = 0; i < frame.views.size(); ++i) note_surfaces(frame, i, parts);
  {
    const ScopedZone zone(parts.options.profiler, "declare_passes", "engine");
    for (std::size_t i = 0; i < frame.views.size(); ++i) GLOAM_TRY(declare_view(frame, i, parts));
  }
  resources.graph.set_view(0);
  GLOAM_TRY(resources.results.add_pass(resources.graph));
  return record_graph(commands, parts);
}

/// Notes a submitted frame as drawn, and ages what it has not used.
void commit_frame(Frame& frame, std::span<const ViewRequest> requests, RendererParts& parts) {
  const bool redraw = frame.redraw != nullptr;
  GpuScene& scene = parts.worlds.scene_of(frame.world);
  parts.resources.commit(frame.world, redraw);
  scene.commit_frame();
  parts.last_frame.assets_pending = scene.pending();
  parts.last_frame.spreads_work = std::ranges::any_of(frame.views, [&](const FrameView& own) {
    return std::ranges::any_of(parts.modules.demanded(),
                               [&](const Module* module) { return module->spreads_work(frame.world, *own.view); });
  });
  if (!redraw) ++frame.world.resource<WorldSlot>().frames;
  parts.views.commit(requests);
  parts.last_frame.commit(std::move(frame.counters), parts.resources.results);
  parts.modules.end_frame(parts.resources);
  if (redraw) return;  // drawing one view of the last frame again does not age the others
  parts.views.free_idle_images();
  std::vector<ViewId> companions;
  for (const FrameView& own : frame.views)
    if (own.main) companions.push_back(own.request.settings.id);
  for (const ViewId idle : parts.views.take_idle_companions(companions)) release_view(parts, idle);
}

/// Whether the last frame may be kept in place of this one, if it repeats it. Before the frame is recorded. Not where
/// the caller draws into the picture, has an image of its own in which somebody else may have drawn since, or submits
/// the frame.
bool may_keep(const Frame& frame, const RendererParts& parts) {
  if (frame.redraw != nullptr || parts.options.device->records_for_host() ||
      frame.any_needs(parts.modules, &Module::changes_at_rest) ||
      frame.any_needs(parts.modules, &Module::computes_every_frame))
    return false;
  return std::ranges::all_of(frame.views, [&](const FrameView& own) {
    const ViewTarget& target = own.request.target;
    return frame.knobs_of(own).value(kFrameReuse) == FrameReuse::exact && !own.request.geometry &&
           (!target.image || target.keeps_image) && !target.acquire && !target.overlay && !target.light;
  });
}

/// Undoes what was noted for a frame that the GPU does not execute. number: its Device::frame_number.
void give_up_frame(const Frame& frame, std::uint64_t number, RendererParts& parts) {
  parts.kept_frames.restart();
  parts.resources.give_up_frame();
  parts.worlds.scene_of(frame.world).give_up_frame();
  parts.modules.give_up_frame(number);
}

/// Records the frame. digest: set if the frame may be kept, to what it does.
Status record(Frame& frame, RendererParts& parts, gpu::CommandList& commands, std::optional<FrameDigest>& digest) {
  if (!may_keep(frame, parts)) return record_frame(frame, parts, commands);
  const History& history = parts.resources.history;
  DigestCommands digesting(commands, *parts.options.device, [&](gpu::ImageHandle image, gpu::BufferHandle buffer) {
    return image ? history.owns(image) : history.owns(buffer);
  });
  GLOAM_TRY(record_frame(frame, parts, digesting));
  if (!history.swaps_pairs(parts.resources.graph)) digest = digesting.digest();
  return {};
}

/// Submits a recorded frame, or drops its commands if the last frames did the same.
Status finish(const std::optional<FrameDigest>& digest, RendererParts& parts) {
  gpu::Device& device = *parts.options.device;
  const std::uint64_t number = device.frame_number();
  parts.last_frame.kept = digest && parts.kept_frames.repeats(*digest);
  parts.last_frame.submitted_ns = parts.options.zones == nullptr ? 0 : parts.options.zones->now_ns();
  GLOAM_TRY(parts.last_frame.kept ? device.abandon_frame() : device.submit_frame());
  if (parts.last_frame.kept) parts.resources.graph.drop_times(number);
  if (digest)
    parts.kept_frames.add(*digest);
  else
    parts.kept_frames.restart();
  return {};
}

/// Records the frame and submits it, or gives it up.
Status submit(Frame& frame, std::span<const ViewRequest> requests, RendererParts& parts) {
  gpu::Device& device = *parts.options.device;
  auto commands = device.begin_frame();
  if (!commands.ok()) return commands.error();
  const std::uint64_t number = device.frame_number();
  std::optional<FrameDigest> digest;
  Status drawn;
  try {
    drawn = record(frame, parts, **commands, digest);
  } catch (...) {
    static_cast<void>(device.abandon_frame());
    give_up_frame(frame, number, parts);
    throw;
  }
  if (drawn.ok()) {
    drawn = finish(digest, parts);
  } else {
    static_cast<void>(device.abandon_frame());  // if the device is lost, the next begin_frame says so
  }
  if (drawn.ok()) {
    commit_frame(frame, requests, parts);
  } else {
    give_up_frame(frame, number, parts);
  }
  return drawn;
}

/// The frame without its time and without the exceptions that become errors.
Status draw(RendererParts& parts, World& world, std::span<const ViewRequest> requests, const Redraw* redraw,
            std::unique_ptr<Frame>& frame) {
  parts.worlds.take_over(world);
  static_cast<void>(parts.worlds.slot_of(world));  // asserts that the world was prepared
  release_lost_worlds(parts);
  const Drawing mark(parts.drawing);
  parts.modules.begin_frame(world, parts.schedule);
  frame = std::make_unique<Frame>(world, parts.knobs.settle(parts.modules, parts.pipeline_wait()), redraw);
  GLOAM_TRY(begin_views(*frame, requests, parts.modules.list()));
  // A view with knobs of its own may switch on what the others switch off.
  std::vector<const KnobRegistry*> knobs = {&frame->knobs};
  for (const FrameView& own : frame->views) knobs.push_back(&frame->knobs_of(own));
  parts.modules.switch_off(world, knobs, parts.schedule);
  parts.modules.leave(world);
  for (const Module* module : parts.modules.demanded()) module->prepare_world(world, frame->knobs);
  GLOAM_TRY(run_systems(*frame, std::nullopt, parts));
  warn_of_oversights(world, requests, parts.modules.list(), parts.worlds, parts.once, *parts.options.log);
  {
    const ScopedZone zone(parts.options.profiler, "sync_assets", "engine");
    GLOAM_TRY(sync_assets(*frame, parts));
  }
  return submit(*frame, requests, parts);
}

}  // namespace

Result<std::unique_ptr<Frame>> draw_frame(RendererParts& parts, World& world, std::span<const ViewRequest> requests,
                                          const Redraw* redraw) {
  parts.check_idle("render");
  const auto start = std::chrono::steady_clock::now();
  std::unique_ptr<Frame> frame;
  const ScopedZone zone(parts.options.profiler, "render", "engine");
  const Status drawn =
      attempt([] { return std::string("the frame"); }, [&] { return draw(parts, world, requests, redraw, frame); });
  parts.last_frame.cpu_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  if (!drawn.ok()) return drawn.error();
  if (parts.options.profiler != nullptr)
    tell_profiler(*parts.options.profiler, parts.resources.graph,
                  parts.last_frame.report(parts.modules, parts.resources, *parts.options.device), ++parts.frames_told);
  return frame;
}

}  // namespace gloam
