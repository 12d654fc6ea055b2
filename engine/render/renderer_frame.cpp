// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// One frame of a renderer: its views, their passes, recording and submission.
#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "engine/core/zones.h"
#include "engine/render/attempt.h"
#include "engine/render/passes/renderer_passes.h"
#include "engine/render/renderer_state.h"
#include "engine/scene/resources.h"
#include "engine/schedule/schedule.h"

namespace gloam {
namespace {

/// The renderer's own visualizers of the geometry buffer; index + 1 is the code in debug_view.frag.
constexpr const char* kEngineVisualizers[] = {"albedo", "normal", "depth"};

std::uint32_t engine_visualizer_code(std::string_view name) {
  for (std::uint32_t i = 0; i < std::size(kEngineVisualizers); ++i)
    if (name == kEngineVisualizers[i]) return i + 1;
  return 0;
}

bool is_picture(gpu::Format format) {
  using enum gpu::Format;
  return format == rgba8_unorm || format == rgba8_srgb || format == bgra8_unorm || format == bgra8_srgb;
}

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

/// Acquires a target that exists only while a frame is recorded. The view takes its size.
Status acquire_target(const gpu::Device& device, ViewRequest& request) {
  if (!request.target.acquire) return {};
  const auto image = request.target.acquire();
  if (!image.ok()) return image.error();
  request.target.image = *image;
  if (!*image) return {};
  const gpu::ImageDesc& desc = device.desc(*image);
  request.settings.width = desc.width;
  request.settings.height = desc.height;
  return {};
}

std::string size_text(std::uint32_t width, std::uint32_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

void check_light_target(const gpu::Device& device, const ViewRequest& request, const std::string& view) {
  const LightTarget& light = *request.target.light;
  GLOAM_ASSERT(!request.target.image && !request.target.acquire && !request.target.overlay,
               view + ": a view has a picture or a LightTarget, not both");
  GLOAM_ASSERT(light.image, view + ": LightTarget has no image");
  const gpu::ImageDesc& desc = device.desc(light.image);
  GLOAM_ASSERT(light.mip < desc.mips && light.layer < desc.layers,
               view + ": LightTarget names mip " + std::to_string(light.mip) + " of layer " +
                   std::to_string(light.layer) + ", and its image \"" + desc.name + "\" has " +
                   std::to_string(desc.mips) + " mips and " + std::to_string(desc.layers) + " layers");
  GLOAM_ASSERT(gpu::has(desc.usage, gpu::ImageUsage::color_target),
               view + ": the image \"" + desc.name + "\" of LightTarget was made without ImageUsage::color_target");
}

/// A size may come from a user, so a great one is no misuse.
Status check_size(const ViewSettings& settings) {
  if (settings.width <= kMostViewPixels && settings.height <= kMostViewPixels) return {};
  return Error{ErrorKind::usage, "view " + std::to_string(settings.id.value) + " is " +
                                     size_text(settings.width, settings.height) + " pixels: a view has at most " +
                                     std::to_string(kMostViewPixels) + " a side"};
}

/// Asserts that the view can be drawn into its target.
void check_target(const gpu::Device& device, const ViewRequest& request) {
  const ViewSettings& settings = request.settings;
  const std::string view = "view " + std::to_string(settings.id.value);
  if (request.geometry) {
    GLOAM_ASSERT(request.geometry->width() == settings.width && request.geometry->height() == settings.height,
                 view + " is " + size_text(settings.width, settings.height) + " pixels, the host's geometry " +
                     size_text(request.geometry->width(), request.geometry->height()) + ": they must have one size");
  }
  if (request.target.light) check_light_target(device, request, view);
  if (!request.target.image) return;
  const gpu::ImageDesc& desc = device.desc(request.target.image);
  GLOAM_ASSERT(desc.width == settings.width && desc.height == settings.height,
               view + " is " + size_text(settings.width, settings.height) + " pixels, its target image \"" + desc.name +
                   "\" " + size_text(desc.width, desc.height) + ": they must have one size");
  GLOAM_ASSERT(is_picture(desc.format), view + ": a target image is rgba8 or bgra8, UNORM or sRGB, and \"" + desc.name +
                                            "\" is " + std::string(name_of(desc.format)));
  GLOAM_ASSERT(gpu::has(desc.usage, gpu::ImageUsage::color_target),
               view + ": the target image \"" + desc.name + "\" was made without ImageUsage::color_target");
}

/// Asserts that no view is requested twice, and that none has the id of a companion.
void check_ids(std::span<const ViewRequest> requests) {
  std::set<std::uint32_t> ids;
  for (const ViewRequest& request : requests) {
    const std::uint32_t id = request.settings.id.value;
    GLOAM_ASSERT(id - CompanionViews::kFirstId >= CompanionViews::kMost * CompanionViews::kMostMainIds,
                 "view " + std::to_string(id) + ": ids from CompanionViews::kFirstId on are for companions");
    GLOAM_ASSERT(ids.insert(id).second, "view " + std::to_string(id) + " is requested twice in one frame");
  }
}

}  // namespace

Status Renderer::State::add_light_copy(FrameBuilder& frame, const LightTarget& target) {
  const gpu::ImageDesc& desc = options.device->desc(target.image);
  const uvec2 size = glm::max(uvec2(desc.width, desc.height) >> target.mip, uvec2(1));
  GLOAM_ASSERT(size == uvec2(frame.view().width, frame.view().height),
               "the mip of a light target has the size of its view");
  const LightTarget& first = light_targets.try_emplace(target.image, target).first->second;
  GLOAM_ASSERT(first.before == target.before && first.after == target.after,
               "views that capture into one image state the same accesses");
  CapturedLight* captured = shared.find<CapturedLight>();
  if (captured == nullptr) captured = &shared.put(CapturedLight{});
  ImageRef& image = captured->images[target.image];
  if (!image) image = graph.import_image("light_target", target.image, target.before, target.after);
  image = add_copy_light_pass(frame, frame.get<LitOutput>().color, image, target.mip, target.layer);
  return frame.status();
}

Status Renderer::State::add_view(World& world, std::size_t index) {
  const FrameView& own_view = frame_views[index];
  const ViewRequest& request = own_view.request;
  const RenderView& view = *own_view.view;
  builders.push_back(std::make_unique<FrameBuilder>(services(knobs_of(own_view)), graph, world, view, scene_of(world),
                                                    draws, index, shared));
  FrameBuilder& frame = *builders.back();
  graph.set_view(view.id.value);
  frame.set_visualizer(request.settings.visualizer, request.settings.heat_range);
  if (view_needs(&Module::needs_motion, world, own_view)) frame.set_previous_instances(&motion.instances());
  const std::uint32_t code = engine_visualizer_code(request.settings.visualizer);
  frame.upload_view_constants(code);
  add_deform_pass(frame);
  add_geometry_pass(frame, request.geometry ? &*request.geometry : nullptr, copy_request.has_value());
  GLOAM_TRY(frame.status());
  const GeometryOutputs& geometry = frame.get<GeometryOutputs>();
  for (const ImageRef image : {geometry.base_color, geometry.normals, geometry.material, geometry.depth})
    frame.expose(image);
  if (geometry.motion) frame.expose(geometry.motion);
  if (own_view.main) return add_companion(world, frame, own_view);

  const ViewImages& own = images.at(view.id.value);
  const ImageRef lit = graph.import_image("lit", own.lit, gpu::Access::none, gpu::Access::transfer_read);
  frame.put(LitOutput{lit});
  if (request.target.light) {
    GLOAM_TRY(add_module_passes(frame, own_view));
    keep_linear(frame, lit, request.keep_linear);
    GLOAM_TRY(add_light_copy(frame, *request.target.light));
    count_view(world, frame);
    return {};
  }
  const bool external = static_cast<bool>(request.target.image);
  const gpu::ImageHandle picture = external ? request.target.image : own.picture;
  const gpu::Access after = external ? request.target.after : gpu::Access::transfer_read;
  const ImageRef target = graph.import_image("picture", picture, gpu::Access::none, after);
  frame.put(TargetOutput{target, options.device->desc(picture).format});
  GLOAM_TRY(add_module_passes(frame, own_view));
  if (code == 0 && frame.visualizer() != "none") warn_of_idle_visualizer(frame);
  keep_linear(frame, lit, request.keep_linear);
  GLOAM_ASSERT(frame.get<TargetOutput>().color.resource == target.resource,
               "TargetOutput is written in place: a module has put another image there");
  if (code != 0) add_debug_view_pass(frame, code);
  GLOAM_TRY(frame.status());
  if (request.target.overlay) GLOAM_TRY(request.target.overlay(graph, frame.get<TargetOutput>().color));
  if (copy_request && copy_request->view == view.id) GLOAM_TRY(copy_request->add_copies(frame));
  count_view(world, frame);
  return {};
}

Status Renderer::State::add_companion(World& world, FrameBuilder& frame, const FrameView& own_view) {
  frame.put(LitOutput{create_view_image(frame, "companion_light", gpu::Format::rgba16_float)});
  GLOAM_TRY(add_module_passes(frame, own_view));
  CompanionLight* companions = shared.find<CompanionLight>();
  if (companions == nullptr) companions = &shared.put(CompanionLight{});
  companions->views[frame.view().id.value] = {frame.get<LitOutput>().color, frame.get<GeometryOutputs>().depth};
  count_view(world, frame);
  return {};
}

void Renderer::State::keep_linear(FrameBuilder& frame, ImageRef lit, bool wanted) {
  const ImageRef last = frame.get<LitOutput>().color;
  const gpu::ImageDesc &from = graph.desc(last), &to = graph.desc(lit);
  GLOAM_ASSERT(from.format == to.format && from.width == to.width && from.height == to.height,
               "LitOutput may move only to an image of the same size and format");
  const bool moved = last.resource != lit.resource;
  images.at(frame.view().id.value).lit_is_last = !moved || wanted;
  if (moved && wanted) static_cast<void>(add_copy_light_pass(frame, last, graph.newest(lit)));
}

void Renderer::State::hand_out_results(World& world, ViewId view) {
  results.for_each_settled(world.resource<RenderSlot>().value, view.value,
                           [&](const ResultKey& key, const FrameResult& result) {
                             for (std::size_t i = 0; i < options.modules.size(); ++i)
                               if (runtimes[i].demand.needed && options.modules[i]->name() == key.module)
                                 options.modules[i]->take_result(world, view, key.name, result);
                           });
}

const KnobRegistry& Renderer::State::settled_knobs() {
  if (options.readiness == Readiness::wait) return knobs;
  if (settled && settled->version() == knobs.version()) return *settled;
  PipelineList needed;
  for (std::size_t i = 0; i < options.modules.size(); ++i)
    if (options.modules[i]->built() && runtimes[i].demand.needed && runtimes[i].idle_frames == 0)
      options.modules[i]->pipelines(knobs, options.device->info(), needed);
  if (!settled || pipelines.request(needed, *options.log)) settled = knobs;
  return *settled;
}

Result<FrameView> Renderer::State::begin_view(const ViewRequest& request) const {
  FrameView own;
  own.request = request;
  GLOAM_TRY(check_visualizer_name(request.settings.visualizer));
  if (request.settings.knobs.empty()) return own;
  auto overridden = std::make_unique<KnobRegistry>(*frame_knobs);
  for (const KnobOverride& knob : request.settings.knobs) GLOAM_TRY(overridden->set(knob.name, knob.value));
  own.knobs = std::move(overridden);
  return own;
}

Status Renderer::State::begin_views(std::span<const ViewRequest> requests) {
  frame_views.clear();
  check_ids(requests);
  for (const ViewRequest& request : requests) {
    Result<FrameView> own = begin_view(request);
    if (!own.ok()) return own.error();
    frame_views.push_back(std::move(*own));
  }
  return {};
}

Status Renderer::State::add_companions_of(World& world, FrameView& main) {
  const ViewSettings& settings = main.request.settings;
  if (settings.purpose == ViewPurpose::capture || main.request.target.light) return {};
  CompanionViews companions(settings.id);
  for (std::size_t i = 0; i < options.modules.size(); ++i) {
    const Module& module = *options.modules[i];
    const bool left_out = std::ranges::find(settings.without, module.name()) != settings.without.end();
    if (!left_out && module.built() && runtimes[i].demand.needed)
      module.companion_views(world, settings, knobs_of(main), companions);
  }
  for (const ViewSettings& companion : companions.all()) {
    Result<FrameView> own = begin_view({.settings = companion, .target = {}});
    if (!own.ok()) return own.error();
    own->main = settings.id;
    frame_views.push_back(std::move(*own));
    main.has_companions = true;
  }
  return {};
}

Status Renderer::State::add_companions(World& world) {
  std::vector<FrameView> requested = std::move(frame_views);
  frame_views.clear();
  for (FrameView& own : requested) {
    GLOAM_TRY(acquire_target(*options.device, own.request));
    check_target(*options.device, own.request);
    follow_camera(world, own.request.settings);
    check_settings(own.request.settings);
    GLOAM_TRY(check_size(own.request.settings));
    GLOAM_TRY(add_companions_of(world, own));
    frame_views.push_back(std::move(own));
  }
  return {};
}

Status Renderer::State::prepare_views(World& world) {
  const RenderSlot slot = world.resource<RenderSlot>();
  const std::uint64_t frame = copy_request && slot.frames > 0 ? slot.frames - 1 : slot.frames;
  GLOAM_TRY(add_companions(world));
  for (FrameView& own : frame_views) {
    const ViewSettings& settings = own.request.settings;
    if (!own.main) GLOAM_TRY(prepare_images(world, own.request));
    own.view = std::make_unique<RenderView>(make_view(settings, frame, cuts.declare(slot.value, settings, frame)));
    own.view->main_view = own.main.value_or(settings.id);
    own.view->has_companions = own.has_companions;
    motion.begin_view(*own.view);
    world.set_view_resource(settings.id, *own.view);
    for (std::size_t i = 0; i < options.modules.size(); ++i)
      if (runtimes[i].demand.needed) options.modules[i]->prepare_view(world, settings.id, knobs_of(own));
  }
  // Systems of companions come last: what they share with their main view, such as places in a shadow atlas, goes by
  // the needs of the main view.
  for (const bool companions : {false, true})
    for (const FrameView& own : frame_views) {
      if (own.main.has_value() != companions) continue;
      hand_out_results(world, own.view->id);
      GLOAM_TRY(run_systems(world, own.view->id));
    }
  return {};
}

Status Renderer::State::record_frame(World& world, gpu::CommandList& commands) {
  uniforms->begin_frame();
  storage->begin_frame();
  results.begin_frame();
  graph.begin();
  declared.recordings.begin_frame();
  declared.due_pipelines.begin_frame();
  history.begin_frame();
  cuts.begin_frame();
  builders.clear();
  shared.clear();
  light_targets.clear();
  declared_counters.clear();
  motion.begin_frame(world, world.resource<RenderSlot>().value, any_needs(&Module::needs_motion, world),
                     copy_request.has_value());
  GLOAM_TRY(prepare_views(world));
  std::vector<const RenderView*> views;
  for (const FrameView& view : frame_views) views.push_back(view.view.get());
  GpuScene& scene = scene_of(world);
  GLOAM_TRY(scene.stage(world.resource<SceneAssets>()));
  scene.add_pass(graph);
  draws = build_frame_draws(world, views, scene, *options.executor, any_needs(&Module::needs_casters, world));
  for (std::size_t i = 0; i < frame_views.size(); ++i) {
    const auto& geometry = frame_views[i].request.geometry;
    if (geometry && !geometry->desc().draws_meshes) draws.views[i] = {};
    GLOAM_TRY(add_view(world, i));
  }
  graph.set_view(0);
  GLOAM_TRY(results.add_pass(graph));
  {
    const ScopedZone zone(options.zones, "make_pipelines", "engine");
    GLOAM_TRY(declared.due_pipelines.make_all(pipelines, *options.executor));
  }
  {
    const ScopedZone zone(options.zones, "compile_frame_graph", "engine");
    GLOAM_TRY(graph.compile());
    for (const FrameGraph::UselessPass& pass : graph.useless_passes())
      warn_once("pass '" + std::string(pass.name) + "' of module '" + std::string(pass.module) +
                "' writes nothing, so it is culled: declare its writes, or call PassBuilder::keep");
  }
  {
    const ScopedZone zone(options.zones, "record_passes", "engine");
    const auto place = [&] { return "pass '" + std::string(graph.recording()) + "'"; };
    GLOAM_TRY(attempt(place, [&]() -> Status {
      graph.execute(commands);
      if (graph.recorded().ok()) return {};
      return Error{graph.recorded().error().kind, place() + " failed: " + graph.recorded().error().message};
    }));
  }
  return {};
}

Status Renderer::State::run_systems(World& world, std::optional<ViewId> view) {
  return attempt([&] { return "system '" + std::string(schedule.failed_system()) + "'"; },
                 [&]() -> Status {
                   if (view) {
                     schedule.run_view(*view, world, *options.executor, options.zones);
                   } else {
                     schedule.run(Stage::world, world, *options.executor, options.zones);
                   }
                   return {};
                 });
}

void Renderer::State::commit_frame(World& world, std::span<const ViewRequest> requests) {
  const bool again = copy_request.has_value();
  history.commit(graph, !again);
  cuts.commit();
  motion.commit(world);
  scene_of(world).commit_frame();
  assets_pending = scene_of(world).pending();
  if (!again) ++world.resource<RenderSlot>().frames;
  for (const ViewRequest& request : requests) images.at(request.settings.id.value).drawn = true;
  last_requests.assign(requests.begin(), requests.end());
  collect_counters();
  release_idle_modules();
  release_idle_views();
  release_idle_companions();
}

void Renderer::State::give_up_frame(const World& world, std::uint64_t frame) {
  graph.give_up_frame();
  scene_of(world).give_up_frame();
  results.give_up_frame();
  for (std::size_t i = 0; i < options.modules.size(); ++i)
    if (runtimes[i].in_view) options.modules[i]->give_up_frame(frame);
}

Status Renderer::State::draw_frame(World& world, std::span<const ViewRequest> requests) {
  const RenderSlot* slot = world.try_resource<RenderSlot>();
  if (slot != nullptr && slot->renderer.expired()) take_world(world, slot->frames);
  static_cast<void>(slot_of(world));
  release_lost_worlds();
  const Drawing mark(drawing);
  update_demand(world);
  frame_knobs = &settled_knobs();
  for (std::size_t i = 0; i < options.modules.size(); ++i)
    if (options.modules[i]->built() && runtimes[i].demand.needed)
      options.modules[i]->prepare_world(world, *frame_knobs);
  GLOAM_TRY(run_systems(world, std::nullopt));
  GLOAM_TRY(begin_views(requests));
  warn_of_oversights(world, requests);
  const SceneAssets& assets = world.resource<SceneAssets>();
  GLOAM_TRY(scene_of(world).sync(assets, *options.executor));
  if (any_needs(&Module::needs_simplified_casters, world))
    GLOAM_TRY(scene_of(world).simplify_casters(assets, *options.executor));

  gpu::Device& device = *options.device;
  auto commands = device.begin_frame();
  if (!commands.ok()) return commands.error();
  const std::uint64_t frame = device.frame_number();
  Status drawn;
  try {
    drawn = record_frame(world, **commands);
  } catch (...) {
    static_cast<void>(device.abandon_frame());
    give_up_frame(world, frame);
    throw;
  }
  if (drawn.ok()) {
    submitted_ns = options.zones == nullptr ? 0 : options.zones->now_ns();
    drawn = device.submit_frame();
  } else {
    static_cast<void>(device.abandon_frame());  // if the device is lost, the next begin_frame says so
  }
  if (drawn.ok()) {
    commit_frame(world, requests);
  } else {
    give_up_frame(world, frame);
  }
  return drawn;
}

}  // namespace gloam
