// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/report/last_frame.h"

#include <optional>
#include <string_view>
#include <utility>

#include "engine/render/draws/occluders.h"
#include "engine/render/passes/culling_passes.h"
#include "shaders/render/culling/culling_shared.h"

namespace gloam {
namespace {

class MapSink final : public CounterSink {
 public:
  explicit MapSink(std::map<std::string, double>& map) : map_(map) {}
  void count(std::string_view name, double value) override { map_[std::string(name)] = value; }

 private:
  std::map<std::string, double>& map_;
};

ModuleState state_of(std::string_view name, const gpu::Device& device, const std::vector<gpu::ModuleMemory>& memory) {
  ModuleState state;
  state.name = name;
  state.pipelines = device.pipeline_count(name);
  for (const gpu::ModuleMemory& m : memory)
    if (m.module == name) state.gpu_bytes = m.bytes;
  return state;
}

void count_culled(const shaders::CullingCounters& culled, CounterSink& sink) {
  sink.count("scene.clusters_culled", culled.clusters);
  sink.count("scene.triangles_culled", culled.triangles);
}

}  // namespace

ViewCounters count_view(const ModuleSet& modules, const FrameBuilder& builder) {
  ViewCounters view{builder.view().id, {}};
  MapSink sink(view.counters);
  sink.count("engine.draws", static_cast<double>(builder.draws().solid.size() + builder.draws().blended.size()));
  sink.count("engine.culled_primitives", builder.draws().culled_instances);
  sink.count("scene.kept", 0.0);  // LastFrame::report
  sink.count("scene.clusters", static_cast<double>(builder.draws().clusters.size()));
  sink.count("scene.clusters_culled", 0.0);
  sink.count("scene.triangles", solid_triangles(builder.draws()));
  sink.count("scene.triangles_culled", 0.0);
  for (const Module* module : modules.taking_part()) module->counters(builder.world(), builder.view(), sink);
  return view;
}

void LastFrame::commit(std::vector<ViewCounters> views, const FrameResults& results) {
  views_ = std::move(views);
  counted_results_.clear();
  if (views_.empty()) return;
  counted_results_ = results.kept_keys();
  std::erase_if(counted_results_, [&](const ResultKey& key) { return key.view != views_.back().view.value; });
}

std::map<std::string, double> LastFrame::counters(const ModuleList& modules, const FrameResults& results) const {
  if (views_.empty()) return {};
  std::map<std::string, double> all = views_.back().counters;
  MapSink sink(all);
  for (const ResultKey& key : counted_results_) {
    const std::optional<FrameResult> result = results.newest(key);
    if (!result) continue;
    if (key.module == "engine" && key.name == kCullingResult)
      count_culled(result->value<shaders::CullingCounters>(), sink);
    for (const auto& module : modules)
      if (module->name() == key.module) module->result_counters(key.name, *result, sink);
  }
  return all;
}

FrameReport LastFrame::report(const ModuleSet& modules, FrameResources& resources, const gpu::Device& device) const {
  FrameReport report;
  report.cpu_ms = cpu_ms;
  report.kept = kept;
  report.passes = resources.graph.pass_times();
  report.gpu_ms = resources.graph.gpu_ms();
  report.submitted_ns = submitted_ns;
  report.counters = counters(modules.list(), resources.results);
  if (const auto found = report.counters.find("scene.kept"); found != report.counters.end() && kept)
    found->second = 1.0;
  std::map<std::string, std::uint64_t> kept_bytes;
  if (!views_.empty()) kept_bytes = resources.history.bytes_of_view(views_.back().view.value);
  report.views = views_;
  report.plans_compiled = resources.graph.plans_compiled();
  report.pipelines_pending = resources.pipelines.pending();
  if (report.pipelines_pending > 0) report.pipeline_made = resources.pipelines.made_in_background();
  report.assets_pending = assets_pending;
  report.gpu_memory = device.memory_totals();
  const std::vector<gpu::ModuleMemory> memory = device.memory();
  ModuleState engine = state_of("engine", device, memory);
  engine.demanded = true;
  engine.reason = "always";
  report.modules.push_back(std::move(engine));
  for (std::size_t i = 0; i < modules.list().size(); ++i) {
    ModuleState state = state_of(modules.list()[i]->name(), device, memory);
    state.demanded = modules.demand(i).needed;
    state.reason = modules.demand(i).reason;
    if (const auto bytes = kept_bytes.find(state.name); bytes != kept_bytes.end() && state.demanded)
      report.counters[state.name + ".kept_bytes"] = static_cast<double>(bytes->second);
    report.modules.push_back(std::move(state));
  }
  return report;
}

}  // namespace gloam
