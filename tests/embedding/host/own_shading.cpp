// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "own_shading.h"

#include <string_view>

#include "engine/render/declare/draw_pass.h"
#include "engine/render/frame_builder.h"
#include "modules/lighting/outputs.h"
#include "modules/shadows/outputs.h"
#include "shaders/own_light/shaders.h"

namespace host {
namespace {

using namespace gloam;

class OwnShading final : public Module {
 public:
  explicit OwnShading(std::uint32_t bands) : bands_(bands) {}

  [[nodiscard]] std::string_view name() const override { return "own_shading"; }
  void register_components(World&) const override {}
  void scene_keys(KeyRegistry&) const override {}
  [[nodiscard]] Demand demand(const World&, const RenderView*) const override { return {true, "the host's look"}; }

  void add_passes(FrameBuilder& frame, PassPhase phase) override {
    if (phase != PassPhase::translucent) return;  // after gloam's own shading, before blended surfaces
    const ShadowsOutputs* shadows = frame.find<ShadowsOutputs>();
    if (shadows == nullptr || !shadows->final_lists) return;  // no shadows in this view: gloam's light stays
    const FinalLists& lists = *shadows->final_lists;
    DrawPass pass(frame, "own_shading",
                  {.fragment = shaders::own_light::shade_frag,
                   .constants = lists.constants,
                   .depth_compare = gpu::CompareOp::less});  // a triangle at depth 0: passes where there is a surface
    LitOutput& lit = frame.get<LitOutput>();
    lit.color = pass.target(lit.color, gpu::LoadOp::load);
    pass.test_depth(frame.get<GeometryOutputs>().depth);
    read_geometry(pass, frame.get<GeometryOutputs>());
    read_lighting(pass, frame);
    read_final_lists(pass, lists);
    pass.push(bands_);
    pass.draw_triangle();
  }

 private:
  std::uint32_t bands_;
};

}  // namespace

std::unique_ptr<gloam::Module> make_own_shading(std::uint32_t bands) { return std::make_unique<OwnShading>(bands); }

}  // namespace host
