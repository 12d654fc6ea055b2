// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/module.h"

#include <algorithm>
#include <atomic>

#include "engine/ecs/view.h"
#include "engine/render/frame_builder.h"
#include "modules/lights/light_keys.h"
#include "modules/lights/light_list.h"
#include "modules/lights/outputs.h"
#include "modules/lights/tile_masks_pass.h"

namespace gloam {
namespace {

void gather_lights_system(View<const Light, const WorldTransform> lights, Resource<LightSet> set) {
  set->lights.clear();
  lights.each([&](Entity entity, const Light& light, const WorldTransform& transform) {
    set->lights.push_back(place_light(entity, light, transform.matrix));
  });
  std::sort(set->lights.begin(), set->lights.end(),
            [](const PlacedLight& a, const PlacedLight& b) { return a.entity.index < b.entity.index; });
}

void select_lights_system(Resource<const LightSet> set, ViewResource<const RenderView> view, ViewResource<VisibleLights> visible) {
  select_lights(set->lights, *view, *visible);
}

class LightsModule final : public Module {
 public:
  [[nodiscard]] std::string_view name() const override { return "lights"; }

  void register_components(World& world) const override {
    world.register_component<Light>("light");
    world.set_resource(LightSet{});
  }
  void scene_keys(KeyRegistry& registry) const override { add_light_keys(registry); }

  void knobs(KnobRegistry& registry) const override {
    Knob culling;
    culling.name = "lights.culling";
    culling.module = "lights";
    culling.meaning = "lights a pixel looks at: those of its tile, or all of them";
    culling.choices = {"brute", "tiled"};
    culling.default_number = 1;
    culling.exact = "brute";
    registry.add(culling);
  }

  void add_systems(Schedule& schedule) override {
    schedule.add_system("gather_lights", "lights", Stage::world, &gather_lights_system);
    schedule.add_system("select_lights", "lights", Stage::view, &select_lights_system);
  }

  [[nodiscard]] Demand demand(const World& world, const RenderView* view) const override {
    const std::size_t count = world.view<const Light>().size();
    if (count == 0) return {false, "no light"};
    const std::string lights = std::to_string(count) + (count == 1 ? " light" : " lights");
    const VisibleLights* visible = view == nullptr ? nullptr : world.try_view_resource<VisibleLights>(view->id);
    if (visible != nullptr && visible->block.local_count + visible->block.directional_count == 0)
      return {false, lights + ", none in view"};
    return {true, lights};
  }

  void pipelines(const KnobRegistry& knobs, PipelineList& list) const override {
    list.push_back(light_texels_pipeline());
    if (knobs.is("lights.culling", "tiled")) list.push_back(tile_masks_pipeline());
  }

  [[nodiscard]] std::vector<VisualizerInfo> visualizers() const override {
    return {{"tile_masks", "lights", "", "lights of each 8x8 tile: black 0, blue 6, cyan 12, green 19, yellow 25, red 31, white more"},
            {"light_culling", "lights", "LIGHT", "tiles a light may touch", false},
            {"light_list", "lights", "LIGHT", "pixels a light's lists hold", false},
            {"lights_approx", "lights", "", "lights a tile after the approximate search", false},
            {"lights_accurate", "lights", "", "lights a tile after the accurate search", false},
            {"lights_difference", "lights", "", "lights a tile the accurate search dropped", false},
            {"lights_final", "lights", "", "lights a tile in the final list", false}};
  }

  void prepare_view(World& world, ViewId view) const override {
    if (world.try_view_resource<VisibleLights>(view) == nullptr) world.set_view_resource(view, VisibleLights{});
  }

  [[nodiscard]] Status add_passes(FrameBuilder& frame, PassPhase phase) override {
    if (phase == PassPhase::visualize && frame.visualizer() == "tile_masks") return add_tile_masks_view_pass(frame);
    if (phase != PassPhase::lists) return {};
    const auto& visible = frame.world().view_resource<VisibleLights>(frame.view().id);
    if (visible.dropped > 0 && !warned_.exchange(true)) {
      frame.services().log.warning("more lights are visible than fit (" + std::to_string(GLOAM_MAX_LOCAL_LIGHTS) + " local, " +
                                   std::to_string(GLOAM_MAX_DIRECTIONAL_LIGHTS) + " directional): the " +
                                   std::to_string(visible.dropped) + " least important are left out (counter lights.dropped)");
    }
    return add_tile_masks_pass(frame, visible);
  }

  void counters(const World& world, const RenderView& view, CounterSink& sink) const override {
    const auto& visible = world.view_resource<VisibleLights>(view.id);
    sink.count("lights.total", visible.total);
    sink.count("lights.visible", visible.block.local_count + visible.block.directional_count);
    sink.count("lights.dropped", visible.dropped);
  }

 private:
  std::atomic<bool> warned_ = false;
};

}  // namespace

std::unique_ptr<Module> make_lights_module() { return std::make_unique<LightsModule>(); }

}  // namespace gloam
