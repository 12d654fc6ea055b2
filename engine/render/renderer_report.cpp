// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <cstring>

#include "engine/math/packing.h"
#include "engine/render/renderer_state.h"
#include "engine/schedule/schedule.h"

namespace gloam {
namespace {

class MapSink final : public CounterSink {
 public:
  explicit MapSink(std::map<std::string, double>& map) : map_(map) {}
  void count(std::string_view name, double value) override { map_[std::string(name)] = value; }

 private:
  std::map<std::string, double>& map_;
};

template <class T>
T texel(std::span<const std::byte> bytes, std::size_t index) {
  T value;
  std::memcpy(&value, bytes.data() + index * sizeof(T), sizeof(T));
  return value;
}

}  // namespace

void Renderer::State::count_view(const World& world, const FrameBuilder& builder) {
  ViewCounters& own = declared_counters.emplace_back(ViewCounters{builder.view().id, {}});
  MapSink sink(own.counters);
  sink.count("engine.draws", static_cast<double>(builder.draws().solid.size() + builder.draws().blended.size()));
  sink.count("engine.culled_primitives", builder.draws().culled_instances);
  for (std::size_t i = 0; i < options.modules.size(); ++i)
    if (runtimes[i].in_last_view) options.modules[i]->counters(world, builder.view(), sink);
}

void Renderer::State::collect_counters() {
  counters.clear();
  counted_results.clear();
  view_counters = std::move(declared_counters);
  declared_counters.clear();
  if (view_counters.empty()) return;
  counters = view_counters.back().counters;
  counted_results = results.kept_keys();
  std::erase_if(counted_results, [&](const ResultKey& key) { return key.view != view_counters.back().view.value; });
}

void Renderer::State::add_result_counters(std::map<std::string, double>& all) const {
  MapSink sink(all);
  for (const ResultKey& key : counted_results) {
    const std::optional<FrameResult> result = results.newest(key);
    if (!result) continue;
    for (const auto& module : options.modules)
      if (module->name() == key.module) module->result_counters(key.name, *result, sink);
  }
}

FrameReport Renderer::report() {
  State& s = *state_;
  FrameReport report;
  report.cpu_ms = s.cpu_ms;
  report.passes = s.graph.pass_times();
  report.gpu_ms = s.graph.gpu_ms();
  report.submitted_ns = s.submitted_ns;
  report.counters = s.counters;
  report.views = s.view_counters;
  s.add_result_counters(report.counters);
  report.plans_compiled = s.graph.plans_compiled();
  report.pipelines_pending = s.pipelines.pending();
  report.assets_pending = s.assets_pending;
  const std::vector<gpu::ModuleMemory> memory = s.options.device->memory();
  const auto state_of = [&](std::string_view name) {
    ModuleState state;
    state.name = name;
    state.pipelines = s.options.device->pipeline_count(name);
    for (const gpu::ModuleMemory& m : memory)
      if (m.module == name) state.gpu_bytes = m.bytes;
    return state;
  };
  ModuleState engine = state_of("engine");
  engine.demanded = true;
  engine.reason = "always";
  report.modules.push_back(engine);
  for (std::size_t i = 0; i < s.options.modules.size(); ++i) {
    ModuleState state = state_of(s.options.modules[i]->name());
    state.demanded = s.runtimes[i].demand.needed;
    state.reason = s.runtimes[i].demand.reason;
    report.modules.push_back(state);
  }
  return report;
}

std::vector<GpuFrameTimes> Renderer::take_times() { return state_->graph.take_times(); }

Status Renderer::State::check_drawn(const ViewImages& view) {
  if (view.drawn) return {};
  return Error{ErrorKind::failed, "the view has no picture yet: its frames were given up"};
}

Result<Picture> Renderer::read_picture(ViewId view) {
  state_->check_idle("read_picture");
  State& s = *state_;
  const auto found = s.images.find(view.value);
  GLOAM_ASSERT(found != s.images.end() && found->second.picture,
               "view " + std::to_string(view.value) + ": read_picture needs a view that was rendered without a target");
  GLOAM_TRY(State::check_drawn(found->second));
  GLOAM_TRY(wait());
  auto bytes = read_image_now(*s.options.device, found->second.picture);
  if (!bytes.ok()) return bytes.error();
  Picture picture{found->second.width, found->second.height, {}};
  picture.rgba.resize(bytes->size());
  std::memcpy(picture.rgba.data(), bytes->data(), bytes->size());
  return picture;
}

Result<LinearPicture> Renderer::read_linear(ViewId view) {
  state_->check_idle("read_linear");
  State& s = *state_;
  const auto found = s.images.find(view.value);
  GLOAM_ASSERT(found != s.images.end() && found->second.lit,
               "view " + std::to_string(view.value) + ": read_linear needs a view that was rendered");
  GLOAM_TRY(State::check_drawn(found->second));
  GLOAM_ASSERT(found->second.lit_is_last, "view " + std::to_string(view.value) +
                                              ": read_linear needs a frame drawn with ViewRequest::keep_linear");
  GLOAM_TRY(wait());
  auto bytes = read_image_now(*s.options.device, found->second.lit);
  if (!bytes.ok()) return bytes.error();
  LinearPicture picture{found->second.width, found->second.height, {}};
  picture.rgba.resize(bytes->size() / sizeof(std::uint16_t));
  for (std::size_t i = 0; i < picture.rgba.size(); ++i)
    picture.rgba[i] = half_to_float(texel<std::uint16_t>(*bytes, i));
  return picture;
}

std::string Renderer::describe() const { return state_->schedule.describe() + state_->graph.describe(); }

}  // namespace gloam
