// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/renderer.h"

#include <utility>

#include "engine/gpu/spirv/shader_interface.h"
#include "engine/render/frame/draw_frame.h"
#include "engine/render/frame/renderer_parts.h"
#include "engine/render/modules_in_use/visualizers.h"
#include "engine/render/redraw/redraw.h"
#include "engine/render/views/read_picture.h"
#include "engine/scene/gltf/import.h"

namespace gloam {

Renderer::Renderer(std::unique_ptr<RendererParts> parts) : parts_(std::move(parts)) {}
Renderer::~Renderer() = default;

Result<std::unique_ptr<Renderer>> Renderer::create(RendererOptions options) {
  GLOAM_ASSERT(options.device != nullptr, "RendererOptions::device is null: a renderer needs a device");
  GLOAM_ASSERT(options.upload_budget > 0,
               "RendererOptions::upload_budget is 0: changed assets would never be uploaded");
  GLOAM_ASSERT(options.executor != nullptr, "RendererOptions::executor is null: a renderer needs an executor");
  check_modules(options.modules);
  if (options.log == nullptr) options.log = &null_log();
  return std::unique_ptr<Renderer>(new Renderer(std::make_unique<RendererParts>(std::move(options))));
}

KnobRegistry& Renderer::knobs() { return parts_->knobs.set; }

const ModuleList& Renderer::modules() const { return parts_->modules.list(); }

std::vector<VisualizerInfo> Renderer::visualizers() const { return all_visualizers(modules()); }

Status Renderer::check_visualizer(const World& world, std::string_view name) const {
  static_cast<void>(parts_->worlds.slot_of(world));  // asserts that the world was prepared
  return gloam::check_visualizer(modules(), parts_->knobs.set, world, name);
}

Status Renderer::set_budget(FrameBudget budget) {
  parts_->check_idle("set_budget");
  std::vector<std::string> effects;
  for (const auto& module : modules()) effects.emplace_back(module->name());
  return parts_->budgets.set(std::move(budget), effects, knobs());
}

Status Renderer::change_budget(std::string_view effect, double ms, std::vector<std::string> locked) {
  parts_->check_idle("change_budget");
  return parts_->budgets.change(effect, ms, std::move(locked), knobs());
}

void Renderer::clear_budget(std::string_view effect) { parts_->budgets.clear(effect); }

std::optional<GovernorDecision> Renderer::add_frame_time(const FrameTime& time) {
  parts_->check_idle("add_frame_time");
  BudgetControl* control = parts_->budgets.find(time.effect);
  if (control == nullptr) return std::nullopt;
  FrameTime own = time;
  const LastFrame& last = parts_->last_frame;
  // Work that is spread over frames adds less than this, so a frame that takes longer is too slow without it.
  constexpr double kFarOver = 1.8;
  const bool caught_up = !last.spreads_work || time.ms > kFarOver * control->budget_ms();
  own.judged = own.judged && last.assets_pending == 0 && caught_up && parts_->resources.pipelines.pending() == 0;
  const GovernorDecision decision = control->add(own, parts_->knobs.drawn_version, knobs());
  if (control->take_settled()) parts_->make_pipelines_ahead(*control);
  return decision;
}

std::optional<BudgetState> Renderer::budget(std::string_view effect) const {
  const BudgetControl* control = parts_->budgets.find(effect);
  return control != nullptr ? std::optional(control->state()) : std::nullopt;
}

std::vector<BudgetState> Renderer::budgets() const { return parts_->budgets.states(); }

void Renderer::prepare_world(World& world) const {
  parts_->check_idle("prepare_world");
  if (parts_->worlds.has(world)) {
    const std::uint64_t before = world_id(world);
    gloam::release_world(*parts_, before);
    parts_->worlds.remove(before);
  }
  prepare_scene_world(world);
  parts_->worlds.add(world);
  for (const auto& module : modules()) module->register_components(world);
}

void Renderer::release_world(const World& world) {
  parts_->check_idle("release_world");
  const WorldSlot* slot = world.try_resource<WorldSlot>();
  if (slot == nullptr || slot->renderer.expired()) return;
  const std::uint64_t id = parts_->worlds.slot_of(world).id;
  static_cast<void>(wait());  // a lost device frees its memory when it is destroyed
  gloam::release_world(*parts_, id);
  parts_->resources.free_memory();
}

void Renderer::release_view(ViewId view) {
  parts_->check_idle("release_view");
  const bool drawn = parts_->views.find(view) != nullptr;
  static_cast<void>(wait());
  for (const ViewId companion : CompanionViews::ids_of(view)) {
    parts_->views.forget_companion(companion);
    gloam::release_view(*parts_, companion);
  }
  gloam::release_view(*parts_, view);
  if (drawn) parts_->resources.free_memory();
}

void Renderer::release_view(World& world, ViewId view) {
  release_view(view);
  world.remove_view(view);
  for (const ViewId companion : CompanionViews::ids_of(view)) world.remove_view(companion);
}

Status Renderer::render(World& world, std::span<const ViewRequest> requests) {
  const auto frame = draw_frame(*parts_, world, requests);
  return frame.ok() ? Status() : frame.error();
}

bool Renderer::changes_at_rest(const World& world) const {
  return parts_->modules.any_needs(&Module::changes_at_rest, world, parts_->knobs.set);
}

std::uint32_t Renderer::frames_to_rest(const World& world) const {
  return parts_->modules.frames_to_rest(world, parts_->knobs.set);
}

void Renderer::set_readiness(Readiness readiness) {
  parts_->check_idle("set_readiness");
  parts_->options.readiness = readiness;
}

Status Renderer::wait() { return parts_->options.device->wait_idle(); }

FrameReport Renderer::report() {
  return parts_->last_frame.report(parts_->modules, parts_->resources, *parts_->options.device);
}

std::vector<GpuFrameTimes> Renderer::take_times() { return parts_->resources.graph.take_times(); }

void Renderer::free_idle_memory() {
  parts_->check_idle("free_idle_memory");
  static_cast<void>(wait());
  parts_->resources.graph.free_idle_memory();
  parts_->resources.declared.recordings.free_idle_memory();
  parts_->resources.free_staging();
  for (const auto& module : modules()) module->free_idle_memory();
  parts_->resources.pipelines.release_unused();
  parts_->options.device->free_idle_memory();
}

Result<Picture> Renderer::read_picture(ViewId view) {
  parts_->check_idle("read_picture");
  return gloam::read_picture(parts_->views, view, *parts_->options.device);
}

Result<LinearPicture> Renderer::read_linear(ViewId view) {
  parts_->check_idle("read_linear");
  return gloam::read_linear(parts_->views, view, *parts_->options.device);
}

Result<ImageBytes> Renderer::read_image(World& world, ViewId view, std::string_view name) {
  auto images = read_images(world, view, std::span(&name, 1));
  if (!images.ok()) return images.error();
  return std::move(images->front());
}

Result<std::vector<ImageBytes>> Renderer::read_images(World& world, ViewId view,
                                                      std::span<const std::string_view> names) {
  return gloam::read_images(*parts_, world, view, names);
}

Result<GeometryPicture> Renderer::read_geometry(World& world, ViewId view) {
  return gloam::read_geometry(*parts_, world, view);
}

Result<std::vector<std::string>> Renderer::pick(World& world, ViewId view, std::uint32_t x, std::uint32_t y) {
  return gloam::pick(*parts_, world, view, x, y);
}

Result<std::optional<dvec3>> Renderer::pick_position(World& world, ViewId view, std::uint32_t x, std::uint32_t y) {
  return gloam::pick_position(*parts_, world, view, x, y);
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
  parts_->resources.pipelines.replace_shader(embedded.name, std::move(words));
  return {};
}

std::string Renderer::pipeline_record() const { return parts_->resources.pipelines.record(); }

std::size_t Renderer::make_pipelines(std::string_view record, std::span<const gpu::ShaderCode* const> shaders) {
  return parts_->resources.pipelines.request_record(record, shaders, *parts_->options.log);
}

std::string Renderer::describe() const { return parts_->schedule.describe() + parts_->resources.graph.describe(); }

}  // namespace gloam
