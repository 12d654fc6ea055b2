// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/renderer.h"

#include "engine/core/nearest_name.h"
#include "engine/ecs/view.h"
#include "engine/render/passes/passes.h"
#include "engine/render/renderer_state.h"
#include "engine/scene/gltf_import.h"
#include "engine/scene/resources.h"
#include "engine/scene/systems.h"

namespace gloam {
namespace {

/// The renderer's own visualizers of the geometry buffer; index + 1 is the code in debug_view.frag.
constexpr const char* kEngineVisualizers[] = {"albedo", "normal", "depth"};

/// Whether the knob is at one of the choices, which are separated by '|'.
bool is_one_of(const KnobRegistry& knobs, std::string_view knob, std::string_view choices) {
  for (std::size_t end = 0; !choices.empty(); choices.remove_prefix(std::min(end + 1, choices.size()))) {
    end = std::min(choices.find('|'), choices.size());
    if (knobs.text(knob) == choices.substr(0, end)) return true;
  }
  return false;
}

std::uint32_t engine_visualizer_code(std::string_view name) {
  for (std::uint32_t i = 0; i < std::size(kEngineVisualizers); ++i)
    if (name == kEngineVisualizers[i]) return i + 1;
  return 0;
}

bool is_picture(gpu::Format format) {
  using enum gpu::Format;
  return format == rgba8_unorm || format == rgba8_srgb || format == bgra8_unorm || format == bgra8_srgb;
}

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

void check_target(const gpu::Device& device, const ViewRequest& request) {
  if (!request.target.image) return;
  const gpu::ImageDesc& desc = device.desc(request.target.image);
  GLOAM_ASSERT(desc.width == request.settings.width && desc.height == request.settings.height,
               "a target image has the size of its view");
  GLOAM_ASSERT(is_picture(desc.format), "a target image is rgba8 or bgra8, UNORM or sRGB");
  GLOAM_ASSERT(gpu::has(desc.usage, gpu::ImageUsage::color_target), "a target image was made to be a color_target");
}

}  // namespace

Renderer::State::State(RendererOptions given)
    : options(std::move(given)),
      pipelines(*options.device),
      uniforms(*options.device, "engine", gpu::BufferUsage::uniform),
      storage(*options.device, "engine", gpu::BufferUsage::storage),
      results(*options.device),
      declared(*options.device),
      graph(*options.device),
      runtimes(options.modules.size()) {
  add_scene_systems(schedule);
  for (const auto& module : options.modules) {
    module->knobs(knobs);
    module->add_systems(schedule);
  }
}

Renderer::State::~State() {
  static_cast<void>(options.device->wait_idle());
  for (const auto& module : options.modules) module->release();
  for (auto& [id, view] : images) destroy_images(view);
}

FrameServices Renderer::State::services() {
  return {*options.device, *options.executor, *options.log, knobs,    pipelines,
          uniforms,        storage,           results,      declared, options.readiness == Readiness::wait};
}

GpuScene& Renderer::State::scene_of(const World& world) {
  const RenderSlot* slot = world.try_resource<RenderSlot>();
  GLOAM_ASSERT(slot != nullptr, "a world must be prepared by the renderer that draws it (Renderer::prepare_world)");
  std::unique_ptr<GpuScene>& scene = scenes[slot->value];
  if (scene == nullptr) scene = std::make_unique<GpuScene>(*options.device, pipelines);
  return *scene;
}

void Renderer::State::destroy_images(ViewImages& view) {
  for (gpu::ImageHandle* image : {&view.lit, &view.picture}) {
    if (*image) options.device->destroy(*image);
    *image = {};
  }
}

void Renderer::State::release_images(const std::function<bool(std::uint32_t id, const ViewImages&)>& unwanted) {
  for (auto at = images.begin(); at != images.end();) {
    const std::uint32_t id = at->first;
    if (!unwanted(id, at->second)) {
      ++at;
      continue;
    }
    destroy_images(at->second);
    std::erase_if(last_requests, [&](const ViewRequest& request) { return request.settings.id.value == id; });
    at = images.erase(at);
  }
}

void Renderer::State::release_idle_views() {
  if (copy_request) return;  // drawing one view of the last frame again does not age the others
  for (auto& [id, view] : images) ++view.idle_frames;
  for (const ViewRequest& request : last_requests) images.at(request.settings.id.value).idle_frames = 0;
  release_images([](std::uint32_t, const ViewImages& view) { return view.idle_frames >= kFramesUntilRelease; });
}

Status Renderer::State::prepare_images(const World& world, const ViewRequest& request) {
  const ViewSettings& settings = request.settings;
  ViewImages& view = images[settings.id.value];
  gpu::Device& device = *options.device;
  view.world = world.resource<RenderSlot>().value;
  if (view.width != settings.width || view.height != settings.height) {
    destroy_images(view);
    view.width = settings.width;
    view.height = settings.height;
  }
  if (request.target.image && view.picture) {
    device.destroy(view.picture);
    view.picture = {};
  }
  const auto make = [&](gpu::ImageHandle& image, const char* name, gpu::Format format) -> Status {
    if (image) return {};
    gpu::ImageDesc desc;
    desc.name = name;
    desc.module = "engine";
    desc.format = format;
    desc.width = view.width;
    desc.height = view.height;
    desc.usage = gpu::ImageUsage::color_target | gpu::ImageUsage::sampled | gpu::ImageUsage::storage |
                 gpu::ImageUsage::transfer_source;
    if (format == gpu::Format::rgba8_srgb)
      desc.usage = gpu::ImageUsage::color_target | gpu::ImageUsage::transfer_source;
    auto made = device.create_image(desc);
    if (!made.ok()) return made.error();
    image = *made;
    return {};
  };
  GLOAM_TRY(make(view.lit, "lit", gpu::Format::rgba16_float));
  if (!request.target.image) GLOAM_TRY(make(view.picture, "picture", gpu::Format::rgba8_srgb));
  return {};
}

void Renderer::State::update_demand(const World& world) {
  for (std::size_t i = 0; i < options.modules.size(); ++i) {
    const Module& module = *options.modules[i];
    runtimes[i].demand = module.demand(world, nullptr);
    runtimes[i].in_view = false;
    runtimes[i].in_last_view = false;
    schedule.set_enabled(module.name(), module.built() && runtimes[i].demand.needed);
  }
}

bool Renderer::State::any_needs(bool (Module::*question)(const World&, const KnobRegistry&) const,
                                const World& world) const {
  for (std::size_t i = 0; i < options.modules.size(); ++i) {
    const Module& module = *options.modules[i];
    if (module.built() && runtimes[i].demand.needed && (module.*question)(world, knobs)) return true;
  }
  return false;
}

bool Renderer::State::needs_motion(const World& world, const RenderView& view) const {
  for (std::size_t i = 0; i < options.modules.size(); ++i) {
    const Module& module = *options.modules[i];
    if (module.built() && runtimes[i].demand.needed && module.needs_motion(world, knobs) &&
        module.demand(world, &view).needed)
      return true;
  }
  return false;
}

bool Renderer::State::takes_part(std::size_t index, const FrameBuilder& builder) {
  const Module& module = *options.modules[index];
  if (!module.built() || !runtimes[index].demand.needed) return false;
  if (!module.demand(builder.world(), &builder.view()).needed) return false;
  runtimes[index].in_view = true;
  if (options.readiness == Readiness::wait || module.essential()) return true;
  PipelineList needed;
  module.pipelines(knobs, options.device->info(), needed);
  return pipelines.request(needed, *options.log);
}

Status Renderer::State::add_module_passes(FrameBuilder& builder) {
  std::vector<Module*> taking_part;
  for (std::size_t i = 0; i < options.modules.size(); ++i)
    if (runtimes[i].in_last_view = takes_part(i, builder); runtimes[i].in_last_view)
      taking_part.push_back(options.modules[i].get());
  for (const PassPhase phase : kAllPhases) {
    for (Module* module : taking_part) {
      builder.set_module(module->name());
      module->add_passes(builder, phase);
      if (!builder.status().ok()) return builder.status();
    }
    builder.set_module("engine");
    if (phase != PassPhase::geometry) continue;
    add_sky_motion_pass(builder);
    add_depth_bounds_pass(builder);
    GLOAM_TRY(builder.status());
  }
  return {};
}

void Renderer::State::warn_of_idle_visualizer(const FrameBuilder& builder) {
  const std::string_view stem = builder.visualizer().substr(0, builder.visualizer().find(':'));
  for (std::size_t i = 0; i < options.modules.size(); ++i) {
    const Module& module = *options.modules[i];
    const Demand demand =
        runtimes[i].demand.needed ? module.demand(builder.world(), &builder.view()) : runtimes[i].demand;
    if (runtimes[i].in_last_view || demand.needed) continue;
    for (const VisualizerInfo& info : module.visualizers()) {
      if (info.name != stem) continue;
      const auto [sentence, fresh] = told.insert("view " + info.name + " shows the picture as it is: " + demand.reason);
      if (fresh) options.log->warning(*sentence);
    }
  }
}

void Renderer::State::release_idle_modules() {
  for (std::size_t i = 0; i < options.modules.size(); ++i) {
    ModuleRuntime& runtime = runtimes[i];
    runtime.idle_frames = runtime.in_view ? 0 : runtime.idle_frames + 1;
    runtime.absent_frames = runtime.demand.needed ? 0 : runtime.absent_frames + 1;
    if (runtime.idle_frames == kFramesUntilRelease) {
      options.modules[i]->release();
      results.forget_module(options.modules[i]->name());
    }
    // Repeated, because a pipeline that was being compiled may have been added since.
    if (runtime.absent_frames != 0 && runtime.absent_frames % kFramesUntilRelease == 0)
      pipelines.release(options.modules[i]->name());
  }
}

Status Renderer::State::add_view(World& world, const ViewRequest& request, const RenderView& view) {
  GpuScene& scene = scene_of(world);
  const ViewImages& own = images.at(view.id.value);
  builders.push_back(std::make_unique<FrameBuilder>(
      services(), graph, world, view, scene,
      build_draw_lists(world, view, scene, *options.executor, any_needs(&Module::needs_casters, world))));
  FrameBuilder& frame = *builders.back();
  frame.set_visualizer(request.settings.visualizer);
  if (needs_motion(world, view)) frame.set_previous_instances(&motion.instances());
  const std::uint32_t code = engine_visualizer_code(request.settings.visualizer);
  frame.upload_view_constants(code);
  add_deform_pass(frame);
  add_geometry_pass(frame);
  GLOAM_TRY(frame.status());
  const GeometryOutputs& geometry = frame.get<GeometryOutputs>();
  for (const ImageRef image : {geometry.base_color, geometry.normals, geometry.material, geometry.depth})
    frame.expose(image);
  if (geometry.motion) frame.expose(geometry.motion);

  const bool external = static_cast<bool>(request.target.image);
  const gpu::ImageHandle picture = external ? request.target.image : own.picture;
  const gpu::Access after = external ? request.target.after : gpu::Access::transfer_read;
  const ImageRef target = graph.import_image("picture", picture, gpu::Access::none, after);
  const ImageRef lit = graph.import_image("lit", own.lit, gpu::Access::none, gpu::Access::transfer_read);
  frame.put(TargetOutput{target, options.device->desc(picture).format});
  frame.put(LitOutput{lit});
  GLOAM_TRY(add_module_passes(frame));
  if (code == 0 && frame.visualizer() != "none") warn_of_idle_visualizer(frame);
  GLOAM_ASSERT(frame.get<LitOutput>().color.resource == lit.resource,
               "LitOutput is written in place: a module has put another image there");
  GLOAM_ASSERT(frame.get<TargetOutput>().color.resource == target.resource,
               "TargetOutput is written in place: a module has put another image there");
  if (code != 0) add_debug_view_pass(frame, code);
  GLOAM_TRY(frame.status());
  if (request.target.overlay) GLOAM_TRY(request.target.overlay(graph, frame.get<TargetOutput>().color));
  if (copy_request && copy_request->view == view.id) GLOAM_TRY(copy_request->add_copies(frame));
  return {};
}

void Renderer::State::hand_out_results(World& world, ViewId view) {
  results.for_each_settled(world.resource<RenderSlot>().value, view.value,
                           [&](const ResultKey& key, const FrameResult& result) {
                             for (std::size_t i = 0; i < options.modules.size(); ++i)
                               if (runtimes[i].demand.needed && options.modules[i]->name() == key.module)
                                 options.modules[i]->take_result(world, view, key.name, result);
                           });
}

Status Renderer::State::record_frame(World& world, std::span<const ViewRequest> requests, gpu::CommandList& commands) {
  uniforms.begin_frame();
  storage.begin_frame();
  results.begin_frame();
  graph.begin();
  declared.recordings.begin_frame();
  builders.clear();
  views.clear();
  const std::uint64_t frame = world.resource<RenderSlot>().frames++;
  motion.begin_frame(world, world.resource<RenderSlot>().value, any_needs(&Module::needs_motion, world),
                     copy_request.has_value());
  for (const ViewRequest& requested : requests) {
    ViewRequest request = requested;
    GLOAM_TRY(acquire_target(*options.device, request));
    ViewSettings& settings = request.settings;
    check_target(*options.device, request);
    follow_camera(world, settings);
    GLOAM_TRY(prepare_images(world, request));
    views.push_back(std::make_unique<RenderView>(make_view(settings, frame)));
    motion.begin_view(*views.back(), settings.camera_cut);
    world.set_view_resource(settings.id, *views.back());
    for (std::size_t i = 0; i < options.modules.size(); ++i)
      if (runtimes[i].demand.needed) options.modules[i]->prepare_view(world, settings.id, knobs);
    hand_out_results(world, settings.id);
    schedule.run_view(settings.id, world, *options.executor, options.zones);
    GLOAM_TRY(add_view(world, request, *views.back()));
  }
  GLOAM_TRY(results.add_pass(graph));
  {
    const ScopedZone zone(options.zones, "compile_frame_graph", "engine");
    GLOAM_TRY(graph.compile());
  }
  {
    const ScopedZone zone(options.zones, "record_passes", "engine");
    graph.execute(commands);
  }
  last_requests.assign(requests.begin(), requests.end());
  collect_counters(world);
  release_idle_modules();
  release_idle_views();
  return {};
}

Renderer::Renderer(std::unique_ptr<State> state) : state_(std::move(state)) {}
Renderer::~Renderer() = default;

Result<std::unique_ptr<Renderer>> Renderer::create(RendererOptions options) {
  GLOAM_ASSERT(options.device != nullptr && options.executor != nullptr, "a renderer needs a device and an executor");
  if (options.log == nullptr) options.log = &null_log();
  return std::unique_ptr<Renderer>(new Renderer(std::make_unique<State>(std::move(options))));
}

KnobRegistry& Renderer::knobs() { return state_->knobs; }
const ModuleList& Renderer::modules() const { return state_->options.modules; }

std::vector<VisualizerInfo> Renderer::visualizers() const {
  std::vector<VisualizerInfo> all = {
      {"none", "engine", "", "the lit picture"},
      {"albedo", "engine", "", "base colour without light"},
      {"normal", "engine", "", "shading normal, -1 to 1 of x, y, z as 0 to 1 of red, green, blue"},
      {"depth", "engine", "", "distance: white near, grey far, black sky"}};
  for (const auto& module : state_->options.modules)
    for (VisualizerInfo& info : module->visualizers()) all.push_back(std::move(info));
  return all;
}

Status Renderer::check_visualizer(const World& world, std::string_view name) const {
  const std::string_view stem = name.substr(0, name.find(':'));
  std::vector<std::string> names;
  std::string list;
  for (const VisualizerInfo& info : visualizers()) {
    names.push_back(info.name);
    list += (list.empty() ? "" : ", ") + info.name + (info.argument.empty() ? "" : ":" + info.argument);
    if (info.name != stem) continue;
    if (!info.built) return Error{ErrorKind::usage, "view " + info.name + " is not built yet"};
    if (!info.knob.empty() && !is_one_of(state_->knobs, info.knob, info.value))
      return Error{ErrorKind::usage, "view " + info.name + " needs " + info.knob + "=" + info.value};
    if (info.argument.empty() != (stem.size() == name.size()))
      return Error{ErrorKind::usage,
                   "view " + info.name + (info.argument.empty() ? " takes no argument" : " needs :" + info.argument)};
    if (info.argument == "LIGHT") {
      auto light = world.resource<SceneNames>().find("light", name.substr(stem.size() + 1));
      if (!light.ok()) return Error{ErrorKind::usage, light.error().message};
    }
    return {};
  }
  return Error{ErrorKind::usage,
               "unknown view " + std::string(name) + "; " + did_you_mean(stem, names) + "there are " + list};
}

void Renderer::prepare_world(World& world) const {
  prepare_scene_world(world);
  for (const auto& module : state_->options.modules) module->register_components(world);
  world.set_resource(RenderSlot{state_->next_slot++});
}

void Renderer::release_world(const World& world) {
  const RenderSlot* slot = world.try_resource<RenderSlot>();
  if (slot == nullptr) return;
  state_->scenes.erase(slot->value);
  state_->results.forget_world(slot->value);
  state_->motion.forget_world(slot->value);
  state_->release_images([&](std::uint32_t, const ViewImages& view) { return view.world == slot->value; });
}

void Renderer::release_view(ViewId view) {
  state_->motion.forget_view(view);
  state_->release_images([&](std::uint32_t id, const ViewImages&) { return id == view.value; });
}

Status Renderer::render(World& world, std::span<const ViewRequest> requests) {
  State& s = *state_;
  const auto start = std::chrono::steady_clock::now();
  s.update_demand(world);
  s.schedule.run(Stage::world, world, *s.options.executor, s.options.zones);
  const SceneAssets& assets = world.resource<SceneAssets>();
  GLOAM_TRY(s.scene_of(world).sync(assets, *s.options.executor));
  if (s.any_needs(&Module::needs_simplified_casters, world))
    GLOAM_TRY(s.scene_of(world).simplify_casters(assets, *s.options.executor));

  auto commands = s.options.device->begin_frame();
  if (!commands.ok()) return commands.error();
  const Status recorded = s.record_frame(world, requests, **commands);
  // Submit even if recording failed: the empty frame signals its semaphores, and the next frame can begin.
  const Status submitted = s.options.device->submit_frame();
  if (recorded.ok() && submitted.ok()) s.motion.commit(world);
  s.cpu_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return recorded.ok() ? submitted : recorded;
}

Status Renderer::wait() { return state_->options.device->wait_idle(); }

}  // namespace gloam
