// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/fog/module.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/render/camera/light_scale.h"
#include "engine/scene/keys/table.h"
#include "engine/scene/units.h"
#include "modules/fog/components.h"
#include "modules/fog/fog_passes.h"
#include "modules/fog/knobs.h"
#include "modules/fog/model.h"
#include "modules/fog/references.h"
#include "modules/lighting/outputs.h"

namespace gloam {
namespace {

constexpr const char* kMarchedView = "fog_reference";

HomogeneousFog homogeneous(const Fog& fog) { return {fog.density, fog.color, fog.sky_distance_m}; }

/// For BrightnessSources.
double brightest_fog(const World& world) {
  double most = 0.0;
  world.view<const Fog>().each([&](Entity, const Fog& fog) {
    const double brightest = static_cast<double>(glm::max(glm::max(fog.color.x, fog.color.y), fog.color.z));
    if (std::isfinite(brightest)) most = std::max(most, brightest);
  });
  return most;
}

class FogModule final : public Module {
 public:
  [[nodiscard]] std::string_view name() const override { return "fog"; }
  [[nodiscard]] std::vector<std::string_view> follows() const override {
    return {"lights", "shadows", "closeups", "lighting"};
  }

  void register_components(World& world) const override {
    world.register_component<Fog>("fog");
    world.ensure_resource<BrightnessSources>().lit[name()] = &brightest_fog;
  }

  void scene_keys(KeyRegistry& registry) const override {
    const auto line = [](std::string key, std::string fallback, std::string unit, std::string meaning) {
      return key_line("fog", KeyElement::node, std::move(key), std::move(fallback), std::move(unit),
                      std::move(meaning));
    };
    registry.add(
        number_key(line("gloam.fog.density", "0", "1/m", "density of homogeneous fog; at most one node per scene"), 0,
                   1e9, &Fog::density));
    registry.add(vec3_key(line("gloam.fog.color", "[0, 0, 0]", "cd/m²", "in-scattered radiance of the fog"), 0, 1e6,
                          &Fog::color));
    registry.add_finish("fog", [](World& world) {
      const auto unit_m = static_cast<float>(metres_per_unit(world));
      world.view<Fog>().each([&](Fog& fog) {
        fog.density *= unit_m;
        fog.sky_distance_m /= unit_m;
      });
      return at_most_one(world.view<const Fog>().size(), "gloam.fog");
    });
  }

  void knobs(KnobRegistry& registry) const override { add_knobs(registry, name(), kFogDivisor, kFogRadius); }

  [[nodiscard]] std::vector<ReferenceInfo> references() const override { return fog_references(); }

  [[nodiscard]] std::vector<VisualizerInfo> visualizers() const override {
    VisualizerInfo view{.name = kMarchedView,
                        .module = "fog",
                        .legend = "the picture with light of lamps that the fog scatters, marched along each ray"};
    view.trace = &put_marched_fog;
    return {std::move(view)};
  }

  /// For references that are computed after the frame.
  void prepare_view(World& world, ViewId, const KnobRegistry&) const override {
    world.set_resource(homogeneous(find_fog(world)));
  }
  /// References of a world whose fog has gone have none.
  void leave_world(World& world) const override {
    if (auto* fog = world.try_resource<HomogeneousFog>()) *fog = {};
  }

  [[nodiscard]] Demand demand(const World& world, const RenderView* view) const override {
    if (view != nullptr && view->purpose == ViewPurpose::capture) return {false, "captures have no fog"};
    if (!(find_fog(world).density > 0.0f)) return {false, "no fog"};
    return {true, "the scene has fog"};
  }

  void pipelines(const KnobRegistry& knobs, const gpu::DeviceInfo&, PipelineList& list) const override {
    list_fog_pipelines(knobs, list);
  }

  void add_passes(FrameBuilder& frame, PassPhase phase) override {
    const Fog fog = find_fog(frame.world());
    if (phase == PassPhase::announce) {
      frame.put(homogeneous(fog));
      frame.put(FrontDepthWanted{});
      if (frame.visualizer() == kMarchedView) frame.put(VisualizerIsPicture{});
    }
    const bool bare = frame.world().try_resource<BareLight>() != nullptr;
    if (phase == PassPhase::post) {
      if (bare) return add_bare_light_pass(frame);
      const auto* picture = frame.world().try_resource<FogPicture>();
      if (picture != nullptr && picture->fits(frame.view()))
        return add_light_picture_pass(frame, staging_, "fog_picture", *picture);
      add_fog_passes(frame, fog);
    }
    if (phase == PassPhase::output && bare) show_bare_light(frame);
  }

  void free_idle_memory() override { staging_.release(); }
  void release() override { staging_.release(); }

 private:
  Staging staging_{"fog"};  // of references
};

}  // namespace

std::unique_ptr<Module> make_fog_module() { return std::make_unique<FogModule>(); }

}  // namespace gloam
