// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <string>

#include "engine/core/profiler.h"
#include "engine/render/frame/attempt.h"
#include "engine/render/frame/stages.h"

namespace gloam {

Status record_graph(gpu::CommandList& commands, RendererParts& parts) {
  FrameGraph& graph = parts.resources.graph;
  Profiler* zones = parts.zones();
  {
    const ScopedZone zone(zones, "make_pipelines", "engine");
    GLOAM_TRY(parts.resources.declared.due_pipelines.make_all(parts.resources.pipelines, *parts.options.executor,
                                                              parts.options.progress));
  }
  {
    const ScopedZone zone(zones, "compile_frame_graph", "engine");
    GLOAM_TRY(graph.compile());
    for (const FrameGraph::UselessPass& pass : graph.useless_passes())
      parts.once.warning(*parts.options.log,
                         "pass '" + std::string(pass.name) + "' of module '" + std::string(pass.module) +
                             "' writes nothing, so it is culled: declare its writes, or call PassBuilder::keep");
  }
  const ScopedZone zone(zones, "record_passes", "engine");
  const auto place = [&] { return "pass '" + std::string(graph.recording()) + "'"; };
  return attempt(place, [&]() -> Status {
    graph.execute(commands);
    if (graph.recorded().ok()) return {};
    return Error{graph.recorded().error().kind, place() + " failed: " + graph.recorded().error().message};
  });
}

}  // namespace gloam
