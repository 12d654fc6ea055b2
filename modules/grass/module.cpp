// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/module.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/hash.h"
#include "engine/math/finite.h"
#include "engine/math/frustum.h"
#include "engine/render/frame_builder.h"
#include "engine/render/views/seen_surfaces.h"
#include "engine/render/worlds/world_id.h"
#include "engine/scene/posing/animated_nodes.h"
#include "engine/scene/units.h"
#include "modules/grass/components.h"
#include "modules/grass/debug/lod_view.h"
#include "modules/grass/debug/pick.h"
#include "modules/grass/drawing/still_air.h"
#include "modules/grass/drawing/textures.h"
#include "modules/grass/field/metres.h"
#include "modules/grass/grass_passes.h"
#include "modules/grass/keys.h"
#include "modules/grass/reference/tip_distance.h"
#include "modules/grass/simulation/colliders.h"
#include "modules/grass/simulation/simulate_blades_pass.h"
#include "modules/lighting/components.h"
#include "modules/lighting/outputs.h"
#include "modules/lights/components.h"
#include "modules/shadows/components.h"
#include "modules/shadows/outputs.h"

namespace gloam {
namespace {

constexpr const char* kDrawsResult = "draws";
constexpr const char* kDispatchResult = "dispatch";
constexpr const char* kCastingResult = "casting";

/// Blades are about as thin as a texel of the sun's maps: the texels begin at a place of the field, where it was
/// planted.
void set_texel_grid(World& world, const GrassField& field) {
  auto* grid = world.try_resource<ShadowTexelGrid>();
  if (grid == nullptr) return;
  grid->anchor = dvec3(0.0);
  for (const GrassPlanting& planting : field.plantings) {
    if (planting.origins.empty() || !is_finite(planting.origins.front())) continue;
    grid->anchor = planting.origins.front() / metres_per_unit(world);
    return;
  }
}

using ShadowingLights = View<const Light, const WorldTransform, Maybe<const ShadowCaster>>;

/// Culling of the view's patches, from the knobs. A view resource.
struct GrassViewSettings {
  PatchCulling culling;
};

/// The lights that cast shadows and reach the view. In metres, like the view.
std::vector<CastingLight> casting_lights_of(const ShadowingLights& lights, const RenderView& view,
                                            double metres_per_unit) {
  std::vector<CastingLight> found;
  lights.each([&](const Light& light, const WorldTransform& transform, const ShadowCaster* caster) {
    if ((caster != nullptr && !caster->enabled) || !(light.intensity > 0.0f)) return;
    const CastingLight casting{light.kind == LightKind::directional, dvec3(transform.matrix[3]) * metres_per_unit,
                               vec3(-glm::normalize(dvec3(transform.matrix[2]))),
                               static_cast<float>(double{effective_range(light)} * metres_per_unit)};
    const Sphere reach{vec3(casting.position - view.position), casting.range_m};
    if (casting.directional || may_intersect(view.frustum, reach)) found.push_back(casting);
  });
  return found;
}

void grass_patches_system(Resource<const GrassField> field, Resource<const GrassGrowthSettings> growth,
                          ViewResource<const RenderView> view, ViewResource<const GrassViewSettings> settings,
                          ShadowingLights lights, ViewResource<VisiblePatches> visible, JobExecutor& jobs) {
  const RenderView metric = metric_view(*view, growth->metres_per_unit);
  std::vector<CastingLight> casting;
  if (settings->culling.cast_distance_m > 0.0f) casting = casting_lights_of(lights, metric, growth->metres_per_unit);
  PatchCulling culling = settings->culling;
  culling.lights = casting;
  *visible = find_visible_patches(field->patches, metric, culling, jobs);
}

/// CapturedExtras: captures show the grass as it stands before its first step.
std::uint64_t captured_grass_content(const World& world) {
  std::vector<Entity> lawns;
  world.view<const GrassSurface, const WorldTransform>().each(
      [&](Entity entity, const GrassSurface&, const WorldTransform&) { lawns.push_back(entity); });
  std::ranges::sort(lawns, {}, &Entity::index);
  const AnimatedNodes animated(world);
  Hasher hasher;
  for (const Entity entity : lawns) {
    const auto& lawn = world.get<GrassSurface>(entity);
    for (const float value : {lawn.density, lawn.height_m.x, lawn.height_m.y, lawn.width_m, lawn.max_distance_m})
      hasher.bytes_of(value);
    hasher.value(lawn.seed).value(animated.moves(entity));
    if (!animated.moves(entity)) hasher.bytes_of(world.get<WorldTransform>(entity).matrix);
    if (lawn.texture != 0) hasher.value(lawn.texture_layers);
    for (const std::uint32_t name : {lawn.types, lawn.texture}) {
      if (name == 0) continue;
      std::ifstream file(world.resource<SceneStrings>().text(name), std::ios::binary);
      hasher.text(std::string{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()});
    }
  }
  world.view<const Wind>().each([&](const Wind& wind) {
    hasher.bytes_of(wind.velocity);
    hasher.bytes_of(wind.gust);
  });
  return hasher.digest();
}

/// Blades are thinned and widened where they are thinner than pixels: the truth is all of them, sampled finely.
std::vector<ReferenceInfo> grass_references() {
  std::vector<ReferenceInfo> references = tip_references();
  for (const std::string_view knob : {kGrassLodPixels.name, kGrassThreshold.name, kGrassAllSegments.name}) {
    ReferenceInfo& drawn = references.emplace_back(supersampled_reference(std::string(knob)));
    drawn.name = "every blade with all segments, sampled at points of each pixel";
    drawn.drawn_with = {override_of(kGrassLodPixels, 0.0), override_of(kGrassThreshold, 254u),
                        override_of(kGrassAllSegments, true)};
  }
  // Rays meet no blades, so this judges what other things throw on them.
  references.push_back(traced_shadows(std::string(kGrassShadowFilter.name)));
  return references;
}

class GrassModule final : public Module {
 public:
  [[nodiscard]] std::string_view name() const override { return "grass"; }
  [[nodiscard]] std::vector<std::string_view> follows() const override {
    return {"lights", "shadows", "closeups", "lighting"};
  }
  void register_components(World& world) const override {
    world.register_component<GrassSurface>("grass_surface");
    world.register_component<Collider>("collider");
    world.register_component<Wind>("wind");
    register_grass_components(world);
    register_grass_world_resources(world);
    world.ensure_resource<GrassGrowthSettings>();
    world.ensure_resource<GrassField>();
    world.ensure_resource<GrassEntities>();
    world.ensure_resource<GrassWorld>();
    world.ensure_resource<BladeTextures>();
    world.ensure_resource<CapturedExtras>().content["grass"] = &captured_grass_content;
  }
  void knobs(KnobRegistry& registry) const override { add_grass_knobs(registry); }
  [[nodiscard]] std::vector<ReferenceInfo> references() const override { return grass_references(); }
  [[nodiscard]] std::string idle_knob(const World& world, const RenderView& view, std::string_view knob,
                                      const FrameCounters&) const override {
    const bool moves = knob == kGrassIterations.name || knob == kGrassReadback.name || knob == kGrassThreads.name;
    if (moves && world.view<const Wind>().size() == 0 && world.view<const Collider>().size() == 0)
      return "neither wind nor a collider moves the grass";
    const auto* visible = world.try_view_resource<VisiblePatches>(view.id);
    if (knob == kGrassCastDistance.name && visible != nullptr && !visible->cast)
      return "no light that reaches the view casts shadows";
    return {};
  }
  void scene_keys(KeyRegistry& registry) const override { add_grass_keys(registry); }
  [[nodiscard]] Demand demand(const World& world, const RenderView* view) const override {
    std::size_t surfaces = 0;
    world.view<const GrassSurface>().each([&](const GrassSurface& s) { surfaces += s.density > 0.0f ? 1 : 0; });
    // One more frame after the last surface has disappeared removes its blades.
    if (surfaces == 0 && view == nullptr && !world.resource<GrassEntities>().patches.empty())
      return {true, "grass disappears"};
    if (surfaces == 0) return {false, "no surface grows grass"};
    if (view != nullptr) {
      if (view->static_only && !world.resource<CapturedExtras>().views.contains(view->id.value))
        return {false, "grass moves"};
      const auto* visible = world.try_view_resource<VisiblePatches>(view->id);
      if (world.resource<GrassGrowthSettings>().density_scale == 0.0f) return {false, "grass.density_scale=0"};
      if (visible == nullptr || visible->patches.empty()) return {false, "no grass in view"};
      if (visible->in_view == 0 && !sees_surfaces(world, *view)) return {false, "no grass and only sky in view"};
      return {true, std::to_string(visible->patches.size()) + " patches of grass in view"};
    }
    return {true, std::to_string(surfaces) + (surfaces == 1 ? " surface grows grass" : " surfaces grow grass")};
  }
  /// Blades sway, and regrow where they were cut.
  [[nodiscard]] bool changes_at_rest(const World&, const KnobRegistry&) const override { return true; }
  [[nodiscard]] bool shows_surfaces(const World& world, const RenderView& view) const override {
    const auto* visible = world.try_view_resource<VisiblePatches>(view.id);
    return visible != nullptr && visible->in_view > 0;
  }
  /// One frame with a density of 0 removes the blades.
  [[nodiscard]] std::string switched_off(const World& world, const KnobRegistry& knobs) const override {
    const bool off = grass_knobs(knobs).density_scale == 0.0 && world.resource<GrassEntities>().patches.empty();
    return off ? "grass.density_scale=0" : "";
  }
  void add_systems(Schedule& schedule) override {
    schedule.add_system("grass_growth", "grass", Stage::world, &grass_growth_system);
    add_grass_world_systems(schedule);
    schedule.add_system("grass_patches", "grass", Stage::view, &grass_patches_system);
  }
  void prepare_world(World& world, const KnobRegistry& registry) const override {
    const GrassKnobs knobs = grass_knobs(registry);
    GrassGrowthSettings& settings = world.resource<GrassGrowthSettings>();
    settings.slaves_per_master = knobs.slaves_per_master;
    settings.density_scale = static_cast<float>(knobs.density_scale);
    settings.metres_per_unit = metres_per_unit(world);
  }
  /// Growth has run: makes the entities of a field that was regrown.
  void prepare_view(World& world, ViewId view, const KnobRegistry& registry) const override {
    const GrassField& field = world.resource<GrassField>();
    set_texel_grid(world, field);
    // Images of surfaces added after the scene was loaded. BladeTextures::faults keeps errors for the log.
    static_cast<void>(load_blade_textures(world));
    if (world.resource<GrassEntities>().field_version != field.version) make_blade_entities(world, field);
    if (world.resource<GrassEntities>().field_moves != field.moves) move_patch_entities(world, field);
    if (world.try_view_resource<VisiblePatches>(view) == nullptr) world.set_view_resource(view, VisiblePatches{});
    const bool shadows = registry.value(kShadowMode) != ShadowMode::off;
    const float cast_distance_m = shadows ? grass_knobs(registry).cast_distance_m : 0.0f;
    world.set_view_resource(view, GrassViewSettings{{.cast_distance_m = cast_distance_m}});
  }
  [[nodiscard]] std::vector<VisualizerInfo> visualizers() const override { return grass_visualizers(); }
  void pipelines(const KnobRegistry& registry, const gpu::DeviceInfo& device, PipelineList& list) const override {
    list_grass_pipelines(grass_knobs(registry), device.threads_in_turn, textured_, list);
  }
  void add_passes(FrameBuilder& frame, PassPhase phase) override {
    textured_ = has_blade_textures(frame.world());
    if (phase == PassPhase::announce) announce_grass(frame);
    if (phase == PassPhase::geometry) add_grass_passes(frame, worlds_);
    const auto* grass = frame.find<std::shared_ptr<GrassFrame>>();
    if (grass == nullptr || (*grass)->stored.patches.empty()) return;
    if (phase == PassPhase::visualize) add_grass_view_pass(frame, **grass);
    if (phase != PassPhase::geometry || !frame.status().ok()) return;
    frame.keep_result("grass", kDrawsResult, (*grass)->sorted.draws);
    frame.keep_result("grass", kDispatchResult, (*grass)->dispatch);
    const auto& visible = frame.world().view_resource<VisiblePatches>(frame.view().id);
    if (visible.cast) frame.keep_result("grass", kCastingResult, (*grass)->drawn.casting, rest_note(frame, visible));
  }
  void take_result(World& world, ViewId view, std::string_view name, const FrameResult& result) const override {
    if (name == kDispatchResult)
      world.set_view_resource(view, GrassFeedback{result.value<shaders::GrassDispatch>().masters});
    if (name != kCastingResult) return;
    const auto* rest = world.try_view_resource<GrassRest>(view);
    world.set_view_resource(
        view, counted_rest(rest == nullptr ? GrassRest{} : *rest, std::any_cast<const RestNote&>(result.note),
                           result.value<shaders::GrassCasting>().moved));
  }
  void result_counters(std::string_view name, const FrameResult& result, CounterSink& sink) const override {
    if (name == kDrawsResult) sink.count("grass.live", result.value<shaders::GrassDraws>().live);
    if (name == kCastingResult) sink.count("grass.casters", result.value<shaders::GrassCasting>().count);
    if (name == kDispatchResult) sink.count("grass.masters_simulated", result.value<shaders::GrassDispatch>().masters);
  }
  void counters(const World& world, const RenderView& view, CounterSink& sink) const override {
    sink.count("grass.blades", world.resource<GrassField>().statistics.blades);
    sink.count("grass.patches", static_cast<double>(world.view_resource<VisiblePatches>(view.id).patches.size()));
    sink.count("grass.patches_left_out", worlds_.stores.left_out(world_id(world)));
  }
  [[nodiscard]] Status add_pick_copies(FrameBuilder& frame, Captures& copies) override {
    const auto* grass = frame.find<std::shared_ptr<GrassFrame>>();
    if (grass == nullptr || (*grass)->stored.patches.empty()) return {};
    return add_grass_pick_copies(frame, **grass, copies);
  }
  [[nodiscard]] std::vector<std::string> pick(FrameBuilder& frame, const PickedPixel& pixel,
                                              const Captures& copies) const override {
    const auto* grass = frame.find<std::shared_ptr<GrassFrame>>();
    if (grass == nullptr || (*grass)->stored.patches.empty()) return {};
    return grass_pick_lines(frame, **grass, pixel, copies);
  }
  void release() override {
    worlds_.stores.clear();
    worlds_.staging.release();
  }
  void give_up_frame(std::uint64_t) override {}  // all state takes effect when a frame is submitted

 private:
  GrassWorlds worlds_;
  bool textured_ = false;  ///< has_blade_textures() of the last frame, which selects pipelines
};

}  // namespace

std::unique_ptr<Module> make_grass_module() { return std::make_unique<GrassModule>(); }

}  // namespace gloam
