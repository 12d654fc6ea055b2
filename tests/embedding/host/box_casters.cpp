// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "box_casters.h"

#include <glm/ext/matrix_transform.hpp>

#include "engine/render/draws/caster_source.h"
#include "engine/render/frame_builder.h"
#include "little_world.h"
#include "shaders/boxes/shaders.h"

namespace host {
namespace {

using namespace gloam;

gpu::GraphicsPipelineDesc pipeline_of_boxes() {
  return caster_pipeline_desc({.vertex = shaders::boxes::box_vert}, "boxes");
}

class BoxCasters final : public Module {
 public:
  [[nodiscard]] std::string_view name() const override { return "boxes"; }
  void register_components(World&) const override {}
  void scene_keys(KeyRegistry&) const override {}
  [[nodiscard]] Demand demand(const World&, const RenderView*) const override { return {true, "the host's boxes"}; }
  void pipelines(const KnobRegistry&, const gpu::DeviceInfo&, PipelineList& list) const override {
    list.push_back(pipeline_of_boxes());
  }
  void add_passes(FrameBuilder& frame, PassPhase phase) override {
    if (phase != PassPhase::announce) return;
    const auto pipeline = frame.services().pipelines.get(pipeline_of_boxes());
    if (!frame.check(pipeline)) return;
    std::uint64_t number = 0;
    for (const LittleBox& box : kLittleBoxes) {
      CasterSource source;
      source.bounds.min = box.position - dvec3(box.half_m);
      source.bounds.max = box.position + dvec3(box.half_m);
      source.content_hash = ++number;  // the box never changes: maps are drawn once and kept
      const dmat4 world_from_cube = glm::scale(glm::translate(dmat4(1.0), box.position), dvec3(box.half_m));
      source.record = [pipeline = *pipeline, world_from_cube](const CasterSourceDraw& draw) {
        gpu::CommandList& commands = draw.context().commands();
        draw.bind_pipeline(pipeline);
        commands.push(draw.projection().constants(world_from_cube));
        commands.draw(36, 1, 0, 0);
      };
      frame.add_caster_source(std::move(source));
    }
  }
};

}  // namespace

std::unique_ptr<gloam::Module> make_box_casters() { return std::make_unique<BoxCasters>(); }

}  // namespace host
