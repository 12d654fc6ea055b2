// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/renderer.h"
#include "engine/gpu/shader_interface.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "engine/core/assert.h"
#include "engine/ecs/view.h"
#include "engine/render/attempt.h"
#include "engine/render/passes/passes.h"
#include "engine/render/renderer_state.h"
#include "engine/scene/gltf_import.h"
#include "engine/scene/resources.h"
#include "engine/scene/systems.h"

namespace gloam {
namespace {

/// Whether the knob is at one of the choices, which are separated by '|'.
bool is_one_of(const KnobRegistry& knobs, std::string_view name, std::string_view choices) {
  const Knob* knob = knobs.find(name);
  GLOAM_ASSERT(knob != nullptr, "the knob of a visualizer must be declared: " + std::string(name));
  for (std::size_t end = 0; !choices.empty(); choices.remove_prefix(std::min(end + 1, choices.size()))) {
    end = std::min(choices.find('|'), choices.size());
    if (knobs.text(*knob) == choices.substr(0, end)) return true;
  }
  return false;
}

}  // namespace

Renderer::State::State(RendererOptions given)
    : options(std::move(given)),
      device_user(*options.device),
      pipelines(*options.device),
      results(*options.device),
      declared(*options.device),
      history(*options.device),
      graph(*options.device),
      runtimes(options.modules.size()) {
  make_rings();
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

FrameServices Renderer::State::services(const KnobRegistry& view_knobs) {
  return {.device = *options.device,
          .executor = *options.executor,
          .log = *options.log,
          .knobs = view_knobs,
          .pipelines = pipelines,
          .uniforms = *uniforms,
          .storage = *storage,
          .results = results,
          .declared = declared,
          .history = history,
          .wait_for_pipelines = options.readiness == Readiness::wait};
}

GpuScene& Renderer::State::scene_of(const World& world) {
  std::unique_ptr<GpuScene>& scene = scenes[slot_of(world).value];
  if (scene == nullptr)
    scene = std::make_unique<GpuScene>(
        *options.device, pipelines,
        AssetUploadOptions{.background = options.readiness == Readiness::background, .budget = options.upload_budget});
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
  if ((request.target.image || request.target.light) && view.picture) {
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
    view.drawn = false;
    return {};
  };
  GLOAM_TRY(make(view.lit, "lit", gpu::Format::rgba16_float));
  if (!request.target.image && !request.target.light) GLOAM_TRY(make(view.picture, "picture", gpu::Format::rgba8_srgb));
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
    if (!module.built() || !runtimes[i].demand.needed) continue;
    for (const FrameView& view : frame_views)
      if ((module.*question)(world, knobs_of(view))) return true;
  }
  return false;
}

bool Renderer::State::may_draw(std::size_t index, const World& world, const FrameView& view) const {
  const Module& module = *options.modules[index];
  const std::vector<std::string>& without = view.request.settings.without;
  return std::ranges::find(without, module.name()) == without.end() && module.built() &&
         runtimes[index].demand.needed && module.demand(world, view.view.get()).needed;
}

bool Renderer::State::view_needs(bool (Module::*question)(const World&, const KnobRegistry&) const, const World& world,
                                 const FrameView& view) const {
  for (std::size_t i = 0; i < options.modules.size(); ++i)
    if (may_draw(i, world, view) && ((*options.modules[i]).*question)(world, knobs_of(view))) return true;
  return false;
}

bool Renderer::State::takes_part(std::size_t index, const FrameBuilder& builder, const FrameView& view) {
  const Module& module = *options.modules[index];
  if (!may_draw(index, builder.world(), view)) return false;
  runtimes[index].in_view = true;
  runtimes[index].views.emplace(slot_of(builder.world()).value, builder.view().id.value);
  if (options.readiness == Readiness::wait || module.essential()) return true;
  PipelineList needed;
  module.pipelines(knobs_of(view), options.device->info(), needed);
  return pipelines.request(needed, *options.log);
}

Status Renderer::State::add_module_passes(FrameBuilder& builder, const FrameView& view) {
  std::vector<Module*> taking_part;
  for (std::size_t i = 0; i < options.modules.size(); ++i)
    if (runtimes[i].in_last_view = takes_part(i, builder, view); runtimes[i].in_last_view)
      taking_part.push_back(options.modules[i].get());
  for (const PassPhase phase : kAllPhases) {
    if ((view.request.target.light || view.main) && phase >= PassPhase::output) break;
    for (Module* module : taking_part) {
      builder.set_module(module->name());
      GLOAM_TRY(attempt([&] { return "declaring the passes of module '" + std::string(module->name()) + "'"; },
                        [&]() -> Status {
                          module->add_passes(builder, phase);
                          return builder.status();
                        }));
    }
    builder.set_module("engine");
    if (phase != PassPhase::geometry) continue;
    add_sky_motion_pass(builder);
    if (view_needs(&Module::needs_smooth_surfaces, builder.world(), view)) add_smooth_surface_pass(builder);
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
      warn_once("view " + info.name + " shows the picture as it is: " + demand.reason);
    }
  }
}

void Renderer::State::release_idle_modules() {
  for (std::size_t i = 0; i < options.modules.size(); ++i) {
    ModuleRuntime& runtime = runtimes[i];
    runtime.idle_frames = runtime.in_view ? 0 : runtime.idle_frames + 1;
    runtime.absent_frames = runtime.demand.needed ? 0 : runtime.absent_frames + 1;
    if (runtime.idle_frames == kFramesUntilRelease) release_module(i);
    // Repeated, because a pipeline that was being compiled may have been added since.
    if (runtime.absent_frames != 0 && runtime.absent_frames % kFramesUntilRelease == 0)
      pipelines.release(options.modules[i]->name());
  }
}

Renderer::Renderer(std::unique_ptr<State> state) : state_(std::move(state)) {}
Renderer::~Renderer() = default;

Result<std::unique_ptr<Renderer>> Renderer::create(RendererOptions options) {
  GLOAM_ASSERT(options.device != nullptr, "RendererOptions::device is null: a renderer needs a device");
  GLOAM_ASSERT(options.upload_budget > 0,
               "RendererOptions::upload_budget is 0: changed assets would never be uploaded");
  GLOAM_ASSERT(options.executor != nullptr, "RendererOptions::executor is null: a renderer needs an executor");
  check_modules(options.modules);
  if (options.log == nullptr) options.log = &null_log();
  return std::unique_ptr<Renderer>(new Renderer(std::make_unique<State>(std::move(options))));
}

KnobRegistry& Renderer::knobs() { return state_->knobs; }
const ModuleList& Renderer::modules() const { return state_->options.modules; }

std::vector<VisualizerInfo> Renderer::visualizers() const { return state_->visualizers(); }

Status Renderer::check_visualizer(const World& world, std::string_view name) const {
  GLOAM_TRY(state_->check_visualizer_name(name));
  const std::string_view stem = name.substr(0, name.find(':'));
  for (const VisualizerInfo& info : visualizers()) {
    if (info.name != stem) continue;
    if (!info.built) return Error{ErrorKind::usage, "view " + info.name + " is not built yet"};
    if (!info.knob.empty() && !is_one_of(state_->knobs, info.knob, info.value))
      return Error{ErrorKind::usage, "view " + info.name + " needs " + info.knob + "=" + info.value};
    if (info.argument.empty() != (stem.size() == name.size()))
      return Error{ErrorKind::usage,
                   "view " + info.name + (info.argument.empty() ? " takes no argument" : " needs :" + info.argument)};
    if (info.argument == "LIGHT") {
      static_cast<void>(state_->slot_of(world));
      auto light = world.resource<SceneNames>().find("light", name.substr(stem.size() + 1));
      if (!light.ok()) return Error{ErrorKind::usage, light.error().message};
    }
    return {};
  }
  return {};
}

void Renderer::prepare_world(World& world) const {
  state_->check_idle("prepare_world");
  const RenderSlot* before = world.try_resource<RenderSlot>();
  if (before != nullptr && before->renderer.lock() == state_->token) {
    state_->worlds.erase(before->value);
    state_->release_slot(before->value);
  }
  prepare_scene_world(world);
  for (const auto& module : state_->options.modules) module->register_components(world);
  state_->take_world(world, 0);
}

void Renderer::State::release_idle_companions() {
  if (copy_request) return;
  for (auto& [id, idle] : companion_idle_frames) ++idle;
  for (const FrameView& view : frame_views)
    if (view.main) companion_idle_frames[view.request.settings.id.value] = 0;
  for (auto at = companion_idle_frames.begin(); at != companion_idle_frames.end();) {
    const bool idle = at->second >= kFramesUntilRelease;
    if (idle) release_view(ViewId{at->first});
    at = idle ? companion_idle_frames.erase(at) : std::next(at);
  }
}

Status Renderer::render(World& world, std::span<const ViewRequest> requests) {
  state_->check_idle("render");
  const auto start = std::chrono::steady_clock::now();
  Status drawn = attempt([] { return std::string("the frame"); }, [&] { return state_->draw_frame(world, requests); });
  state_->cpu_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return drawn;
}

Status Renderer::replace_shader(const gpu::ShaderCode& embedded, std::vector<std::uint32_t> words) {
  const auto from = gpu::reflect_spirv(embedded);
  if (!from.ok()) return from.error();
  const auto to = gpu::reflect_spirv({embedded.name, words});
  if (!to.ok()) return Error{ErrorKind::usage, to.error().message};
  const std::string difference = gpu::interface_difference(*from, *to);
  if (!difference.empty())
    return Error{ErrorKind::usage,
                 std::string(embedded.name) + ": " + difference + ": the program must be built again"};
  state_->pipelines.replace_shader(embedded.name, std::move(words));
  return {};
}

Status Renderer::wait() { return state_->options.device->wait_idle(); }

}  // namespace gloam
