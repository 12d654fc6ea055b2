// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lighting/module.h"

#include "modules/lighting/passes.h"
#include "modules/lighting/tone_reference.h"

namespace gloam {
namespace {

class LightingModule final : public Module {
 public:
  [[nodiscard]] std::string_view name() const override { return "lighting"; }

  void register_components(World&) const override {}
  void scene_keys(KeyRegistry&) const override {}

  void knobs(KnobRegistry& registry) const override {
    Knob curve;
    curve.name = "lighting.tone_map";
    curve.module = "lighting";
    curve.meaning = "tone curve that maps exposed linear light to the picture";
    curve.choices = {"filmic", "reinhard", "linear"};
    registry.add(curve);
    Knob table;
    table.name = "lighting.tone_map_table";
    table.module = "lighting";
    table.meaning = "entries of the tone curve's lookup table; exact: no table, computed for every pixel";
    table.choices = {"exact", "1024", "256", "64"};
    registry.add(table);
  }

  [[nodiscard]] std::vector<ReferenceInfo> references() const override {
    std::vector<ReferenceInfo> list;
    for (const char* knob : {"lighting.tone_map", "lighting.tone_map_table"})
      list.push_back({knob, "double precision", "tone curve on the CPU", true, false, &draw_tone_reference});
    return list;
  }

  [[nodiscard]] Demand demand(const World&, const RenderView*) const override { return {true, "every picture is lit"}; }

  [[nodiscard]] bool essential() const override { return true; }

  void add_passes(FrameBuilder& frame, PassPhase phase) override {
    if (phase == PassPhase::shading) add_deferred_pass(frame);
    if (phase == PassPhase::translucent) add_forward_pass(frame);
    if (phase == PassPhase::output) add_tone_map_passes(frame);
  }
};

}  // namespace

std::unique_ptr<Module> make_lighting_module() { return std::make_unique<LightingModule>(); }

}  // namespace gloam
