// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/drawing/session_costs.h"

#include <utility>

#include "sandbox/session/drawing/enlarged.h"
#include "sandbox/session/drawing/frame_tracing.h"
#include "sandbox/session/program_knobs.h"

namespace gloam {
namespace {

ModuleCost& share_of(std::vector<ModuleCost>& modules, const std::string& name) {
  for (ModuleCost& cost : modules)
    if (cost.module == name) return cost;
  return modules.emplace_back(ModuleCost{.module = name});
}

std::vector<ModuleCost> module_costs(const FrameSample& sample) {
  std::vector<ModuleCost> modules;
  for (const Zone& zone : sample.zones)
    share_of(modules, zone.module).cpu_ms += static_cast<double>(zone.end_ns - zone.begin_ns) * 1e-6;
  for (const PassTime& pass : sample.report.passes) share_of(modules, pass.module).gpu_ms += pass.ms;
  return modules;
}

}  // namespace

SessionCosts::SessionCosts(Session& session, const Options& options)
    : session_(session),
      options_(options),
      request_{.settings = session.view_settings(options.width, options.height, options.view),
               .target = {.width = options.width, .height = options.height}},
      store_(options.out.empty() ? nullptr : make_reference_store(options.out + "/references")) {}

std::vector<ReferenceInfo> SessionCosts::references() const {
  std::vector<ReferenceInfo> all;
  for (const auto& module : session_.renderer->modules()) {
    for (ReferenceInfo& reference : module->references()) all.push_back(std::move(reference));
  }
  return all;
}

std::vector<MeasureInfo> SessionCosts::measures() const {
  std::vector<MeasureInfo> all;
  for (const auto& module : session_.renderer->modules()) {
    for (MeasureInfo& measure : module->measures()) all.push_back(std::move(measure));
  }
  return all;
}

Status SessionCosts::settle_memory() {
  constexpr std::int32_t kFrames = 130;  // more than kFramesUntilRelease
  for (std::int32_t index = 0; index < kFrames; ++index) GLOAM_TRY(draw(index));
  return {};
}

Result<FrameCost> SessionCosts::draw(std::int32_t index) {
  session_.set_clock(options_.time_s + index * options_.dt_s, options_.dt_s);
  set_scaled_size(request_.settings, options_.width, options_.height, view_scale(knobs()));
  // What frames keep from those before them must not be of another value of a knob.
  request_.settings.camera_cut = index != index_ && index != index_ + 1;
  auto sample = session_.render_frame(request_);
  if (!sample) return sample.error();
  // A session with a window draws earlier values while pipelines are made in the background.
  bool waited = false;
  while (sample->report.pipelines_pending > 0 || sample->report.assets_pending > 0 || std::exchange(waited, false)) {
    waited = sample->report.pipelines_pending > 0 || sample->report.assets_pending > 0;
    sample = session_.render_frame(request_);
    if (!sample) return sample.error();
  }
  index_ = index;
  return FrameCost{.cpu_ms = sample->report.cpu_ms,
                   .gpu_ms = sample->report.gpu_ms,
                   .processor_ms = sample->processor_ms,
                   .modules = module_costs(*sample)};
}

Result<std::uint64_t> SessionCosts::gpu_bytes() {
  // Time goes on: a frame at the same moment as the one before draws no shadow maps anew, so it has another plan, and
  // memory must not depend on that.
  GLOAM_TRY(draw(index_ + 1));
  session_.renderer->free_idle_memory();
  // The device frees memory only after the frames that may still use it have completed.
  for (int frame = 0; frame < 3; ++frame) GLOAM_TRY(draw(index_ + 1));
  std::uint64_t bytes = 0;
  for (const ModuleState& module : session_.renderer->report().modules) bytes += module.gpu_bytes;
  return bytes;
}

Result<FramePictures> SessionCosts::read() {
  auto drawn = read_drawn();
  if (!drawn) return drawn.error();
  return full_size(*drawn);
}

FramePictures SessionCosts::full_size(const FramePictures& pictures) const {
  const auto resize = [&](const auto& picture) {
    return picture.width == 0 ? picture : enlarged(picture, options_.width, options_.height);
  };
  return {.linear = resize(pictures.linear), .picture = resize(pictures.picture)};
}

Result<FramePictures> SessionCosts::read_drawn() {
  auto linear = session_.renderer->read_linear(request_.settings.id);
  if (!linear) return linear.error();
  auto picture = session_.renderer->read_picture(request_.settings.id);
  if (!picture) return picture.error();
  return FramePictures{.linear = std::move(linear).value(), .picture = std::move(picture).value()};
}

Result<FramePictures> SessionCosts::redraw(const std::function<void(World&)>& change,
                                           const std::function<void(World&)>& restore) {
  change(session_.world);
  // Draw twice: the data that a frame takes from its predecessor is settled in the second frame.
  Status drawn;
  for (int frame = 0; frame < 2 && drawn.ok(); ++frame)
    if (const auto cost = draw(index_); !cost) drawn = cost.error();
  Result<FramePictures> pictures = drawn.ok() ? read_drawn() : Result<FramePictures>(drawn.error());
  restore(session_.world);
  return pictures;
}

Result<FramePictures> SessionCosts::draw_reference(const ReferenceInfo& reference, const FramePictures& frame,
                                                   std::uint32_t samples) {
  FrameToTrace traced;
  const bool needs_rays = reference.kind == "traced";
  if (needs_rays) {
    auto read = read_frame_to_trace(session_, request_.settings.id);
    if (!read) return read.error();
    traced = std::move(read).value();
  }
  const bool scaled = view_scale(knobs()) < 1.0;
  auto drawn = scaled ? read_drawn() : Result<FramePictures>(FramePictures());
  if (!drawn) return drawn.error();
  ReferenceInput input = input_of(scaled ? *drawn : frame, samples);
  input.tracer = traced.tracer.get();
  input.geometry = needs_rays ? &traced.geometry : nullptr;
  auto pictures = reference.draw(input);
  if (!pictures || !scaled) return pictures;
  return full_size(*pictures);
}

Result<std::optional<MovedDistance>> SessionCosts::measure_distance(const ReferenceInfo& reference,
                                                                    std::uint32_t samples) {
  const FramePictures none;
  return reference.distance(input_of(none, samples));
}

std::string SessionCosts::no_effect_reason(const Knob& knob) {
  if (std::string unmet = knobs().unmet_setting(knob); !unmet.empty()) return unmet;
  const World& world = session_.world;
  const RenderView& view = world.view_resource<RenderView>(request_.settings.id);
  for (const auto& module : session_.renderer->modules()) {
    if (module->name() != knob.module) continue;
    if (std::string off = module->switched_off(world, knobs()); !off.empty()) return off;
    if (const Demand demand = module->demand(world, nullptr); !demand.needed) return demand.reason;
    if (const Demand demand = module->demand(world, &view); !demand.needed) return demand.reason;
    return module->idle_knob(world, view, knob.name, counters());
  }
  return {};
}

ReferenceInput SessionCosts::input_of(const FramePictures& frame, std::uint32_t samples) {
  return {.world = session_.world,
          .view = session_.world.view_resource<RenderView>(request_.settings.id),
          .knobs = knobs(),
          .frame = frame,
          .samples = samples,
          .executor = *session_.executor,
          .redraw = [this](const auto& change, const auto& restore) { return redraw(change, restore); },
          .store = store_.get()};
}

}  // namespace gloam
