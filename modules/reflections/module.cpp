// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/module.h"

#include <map>
#include <set>
#include <utility>

#include "engine/render/frame_builder.h"
#include "engine/render/views/seen_surfaces.h"
#include "engine/render/worlds/world_id.h"
#include "engine/scene/assets.h"
#include "engine/scene/keys/table.h"
#include "modules/lighting/occlusion.h"
#include "modules/lighting/outputs.h"
#include "modules/lights/components.h"
#include "modules/lights/light_names.h"
#include "modules/reflections/bake.h"
#include "modules/reflections/captures.h"
#include "modules/reflections/components.h"
#include "modules/reflections/debug/measures.h"
#include "modules/reflections/debug/pick.h"
#include "modules/reflections/debug/unseen.h"
#include "modules/reflections/debug/visualizers.h"
#include "modules/reflections/diffuse/indirect_light.h"
#include "modules/reflections/frame.h"
#include "modules/reflections/knobs.h"
#include "modules/reflections/materials.h"
#include "modules/reflections/override.h"
#include "modules/reflections/planar/mirror.h"
#include "modules/reflections/planar/patches.h"
#include "modules/reflections/proxies/room_tiers.h"
#include "modules/reflections/proxies/rows.h"
#include "modules/reflections/proxies/systems.h"
#include "modules/reflections/recapture/recapture.h"
#include "modules/reflections/reference/adapter.h"
#include "modules/reflections/reference/indirect_tracing.h"
#include "modules/reflections/reflection_passes.h"
#include "modules/reflections/relighting/capture_factors.h"
#include "modules/reflections/scene_unit.h"

namespace gloam {
namespace {

Status check_light_names(World& world) {
  Status status;
  world.view<const IbrProxy>().each([&](const IbrProxy& proxy) {
    const std::string& names = world.resource<SceneStrings>().text(proxy.lights);
    if (auto lights = resolve_light_names(world, names, "gloam.ibr_proxy.lights"); status.ok() && !lights.ok())
      status = lights.error();
  });
  return status;
}

// Limit of a scene file: each proxy has a layer of an array image, of which devices allow 2048 and more.
constexpr std::size_t kMostFileProxies = 2048;

Status add_and_count_proxies(World& world) {
  add_flame_proxies(world);
  const std::size_t count = world.view<const IbrProxy>().size();
  if (count <= kMostFileProxies) return {};
  return Error{ErrorKind::input, "gloam.ibr_proxy: the scene has " + std::to_string(count) +
                                     " reflection proxies, those of fires included, at most " +
                                     std::to_string(kMostFileProxies) + " are read"};
}

/// Fog and fire for reflected rays.
ReflectionExtras traced_extras(const World& world) {
  ReflectionExtras extras;
  if (const auto* fog = world.try_resource<HomogeneousFog>())
    extras.fog = {static_cast<double>(fog->density), dvec3(fog->radiance), static_cast<double>(fog->sky_distance_m)};
  const auto& captures = world.resource<ReflectionCaptures>();
  extras.fires = gather_fire_quads(world, [&](std::uint32_t layer) { return proxy_dim(world, captures, layer); });
  return extras;
}

class ReflectionsModule final : public Module {
 public:
  [[nodiscard]] std::string_view name() const override { return "reflections"; }
  [[nodiscard]] std::vector<std::string_view> needs() const override { return {"lights"}; }
  [[nodiscard]] std::vector<std::string_view> follows() const override { return {"shadows", "closeups", "lighting"}; }
  void register_components(World& world) const override {
    world.register_component<IbrProxy>("ibr_proxy");
    world.register_component<FlameProxy>("flame_proxy");
    world.register_component<IbrRoom>("ibr_room");
    world.register_component<CubeProbe>("cube_probe");
    world.register_component<ReflectingHeights>("reflecting_heights");
    world.ensure_resource<ProxySet>();
    world.ensure_resource<ReflectionCaptures>();
    world.ensure_resource<MirrorPatches>();
  }
  void scene_keys(KeyRegistry& registry) const override {
    const auto line = [](std::string key, std::string fallback, std::string unit, std::string meaning) {
      return key_line("reflections", KeyElement::node, std::move(key), std::move(fallback), std::move(unit),
                      std::move(meaning));
    };
    registry.add(vec2_key(line("gloam.ibr_proxy.size", "", "m",
                               "width and height of a reflection proxy, centred in the local XY plane and facing +Z"),
                          1e-6, 1e6, &IbrProxy::size_m));
    registry.add(choice_key(line("gloam.ibr_proxy.kind", "scene", "",
                                 "content of the proxy: captured from the scene, or an emissive image"),
                            {"scene", "fire"}, IbrProxyKind::scene, &IbrProxy::kind));
    registry.add(file_key(line("gloam.ibr_proxy.texture", "", "", "image file to use instead of a capture"),
                          &IbrProxy::texture));
    registry.add(
        text_key(line("gloam.ibr_proxy.lights", "", "", "names of the light nodes that dim the proxy, comma-separated"),
                 &IbrProxy::lights));
    registry.add(vec3_key(line("gloam.ibr_room.size", "", "m", "size of the box of an IBR room, centred on the node"),
                          1e-6, 1e6, &IbrRoom::size_m));
    registry.add(choice_key(line("gloam.ibr_room.tiers", "all", "",
                                 "tiers of reflections that views from this room have, at most those of knob "
                                 "reflections.tiers; the smallest room that contains the camera decides"),
                            {"all", "ibr+cube", "ssr+cube", "cube"}, IbrRoomTiers::all, &IbrRoom::tiers));
    registry.add(
        vec3_key(line("gloam.cube_probe.size", "", "m", "size of the probe's influence box, centred on the node"), 1e-6,
                 1e6, &CubeProbe::size_m));
    registry.add(integer_key(line("gloam.cube_probe.resolution", "128", "texels", "side of each cube face"), 1, 4096,
                             &CubeProbe::resolution));
    registry.add(boolean_key(line("gloam.cube_probe.global", "false", "", "whether this is the global probe"),
                             &CubeProbe::global));
    registry.add_finish("reflections", &check_light_names);
    registry.add_finish("reflections", &add_and_count_proxies);
    registry.add_finish("reflections", &keep_estimated_unit);
  }
  void knobs(KnobRegistry& registry) const override { add_reflection_knobs(registry); }
  /// Knobs whose values differ in the model are judged by traced reflections.
  [[nodiscard]] std::vector<ReferenceInfo> references() const override {
    std::vector<ReferenceInfo> references;
    for (const std::string_view knob :
         {kReflectionMode.name, kReflectionTiers.name, kReflectionPixelRoughness.name, kReflectionBlur.name,
          kReflectionDilation.name, kReflectionBump.name, kReflectionPixelNormals.name, kReflectionTemporal.name,
          kReflectionLightScale.name, kSsrK1.name, kSsrK2.name, kSsrReach.name, kSsrRefine.name,
          kSsrFullResolution.name, kSsrHierarchical.name, kProxyLayers.name, kProxySort.name,
          kReflectionRecapture.name})
      references.push_back(traced_reflections(std::string(knob), false, &traced_extras));
    references.push_back(traced_indirect(std::string(kIndirectLight.name)));
    references.push_back(traced_indirect(std::string(kAmbientOcclusion.name)));
    return references;
  }
  [[nodiscard]] std::vector<std::string> warnings(const World& world) const override { return unseen_captures(world); }
  [[nodiscard]] std::vector<MeasureInfo> measures() const override { return proxy_measures(); }
  [[nodiscard]] std::string idle_knob(const World& world, const RenderView& view, std::string_view knob,
                                      const FrameCounters& counters) const override {
    const auto outdated = counters.find("reflections.outdated");
    if (knob == kReflectionRecapture.name && outdated != counters.end() && outdated->second == 0.0)
      return "no capture is outdated";
    return idle_reflection_knob(world, view, knob);
  }
  void add_systems(Schedule& schedule) override { add_proxy_systems(schedule); }
  void prepare_world(World& world, const KnobRegistry&) const override {
    auto& set = world.resource<ProxySet>();
    if (const double unit = scene_unit(world); set.unit != unit) {
      set.unit = unit;
      ++set.version;
    }
  }
  void prepare_view(World& world, ViewId view, const KnobRegistry& knobs) const override {
    prepare_proxy_view(world, view);
    world.view_resource<ProxyTileSettings>(view) = tile_settings(world, view, knobs);
  }
  void companion_views(World& world, const ViewSettings& main, const KnobRegistry& knobs,
                       CompanionViews& companions) const override {
    const ReflectionKnobs settings = reflection_knobs(knobs);
    add_mirrored_view(world, main, settings, companions);
    const std::uint64_t number = world_id(world);
    const auto factors = factors_.find(number);
    const bool reflected = factors != factors_.end() && reflecting_.contains({number, main.id.value});
    RecaptureState state;
    if (settings.recapture && settings.light_scale && reflected) state.factors = &factors->second;
    if (const auto found = progress_.find(number); found != progress_.end()) state.progress = found->second;
    state.proxies = settings.proxies;
    add_recapture_view(world, main, state, companions);
  }
  [[nodiscard]] bool shows_surfaces(const World&, const RenderView&) const override { return false; }
  [[nodiscard]] std::string switched_off(const World& world, const KnobRegistry& knobs) const override {
    const bool diffuse =
        knobs.value(kIndirectLight) == IndirectSource::probes || world.try_resource<TracedIndirect>() != nullptr;
    const bool off = reflection_knobs(knobs).mode == ReflectionKnobs::Mode::off;
    if (off && !(diffuse && has_diffuse_light(world))) return "reflections.mode=off";
    if (!diffuse && !reflective_demand(world, nullptr).needed && has_diffuse_light(world))
      return "lighting.indirect=sky, and nothing reflects";
    return "";
  }
  /// Proxies and probes alone demand nothing: only reflective materials show them.
  [[nodiscard]] Demand demand(const World& world, const RenderView* view) const override {
    if (view != nullptr && view->purpose == ViewPurpose::capture && !reflects_probes(world, *view) &&
        !has_diffuse_light(world))
      return {false, "captures show light of captured probes only"};
    if (view != nullptr && !sees_surfaces(world, *view)) return {false, "only sky in view"};
    Demand demand = reflective_demand(world, view);
    if (!demand.needed && has_diffuse_light(world)) return {true, "probes with diffuse light, " + demand.reason};
    return demand;
  }
  [[nodiscard]] static Demand reflective_demand(const World& world, const RenderView* view) {
    const ReflectiveMaterials materials = count_reflective(world.resource<SceneAssets>());
    const auto count = [](std::size_t number, const char* one, const char* many) {
      return std::to_string(number) + (number == 1 ? one : many);
    };
    if (materials.mirror + materials.rough == 0) return {false, "no reflective material"};
    if (view != nullptr && !sees_surfaces(world, *view)) return {false, "only sky in view"};
    const std::size_t probes = world.view<const CubeProbe>().size();
    const bool judged =
        world.try_resource<TracedReflections>() != nullptr || world.try_resource<ReflectionOverride>() != nullptr;
    if (materials.mirror == 0 && probes == 0 && !judged) return {false, "no smooth material and no probe"};
    return {true, count(materials.mirror + materials.rough, " reflective material, ", " reflective materials, ") +
                      count(world.view<const IbrProxy>().size(), " proxy", " proxies") +
                      (materials.mirror == 0 ? " that no smooth material shows, " : ", ") +
                      count(probes, " probe", " probes")};
  }
  [[nodiscard]] std::vector<VisualizerInfo> visualizers() const override {
    return reflection_visualizers(&traced_extras);
  }
  void pipelines(const KnobRegistry& knobs, const gpu::DeviceInfo& device, PipelineList& list) const override {
    for (const ReflectionKnobs& wanted : in_all_rooms(reflection_knobs(knobs), last_rooms_))
      list_reflection_pipelines(wanted, device.threads_in_turn, last_blended_, last_probes_, list);
  }
  void add_passes(FrameBuilder& frame, PassPhase phase) override {
    if (phase == PassPhase::announce) {
      announce_indirect_light(frame, staging_, factors_of(frame.world()));
      if (reflects_probes(frame.world(), frame.view())) announce(frame);
    }
    if (phase == PassPhase::lists) add_reflection_list_passes(frame);
    if (phase == PassPhase::shading) add_reflection_passes(frame, staging_, factors_of(frame.world()));
    if (phase == PassPhase::shading) last_blended_ = frame.find<BlendedLayer>() != nullptr;
    if (phase == PassPhase::visualize) add_reflection_view_pass(frame);
  }
  void counters(const World& world, const RenderView& view, CounterSink& sink) const override {
    const ProxyTiles& tiles = world.view_resource<ProxyTiles>(view.id);
    sink.count("ibr.proxies_total", static_cast<double>(tiles.outcomes.size()));
    sink.count("ibr.proxies_active", static_cast<double>(tiles.proxies.size()));
    sink.count("ibr.proxies_other_room", tiles.count(ProxyOutcome::other_room));
    sink.count("ibr.proxies_faces_away", tiles.count(ProxyOutcome::faces_away));
    sink.count("ibr.proxies_out_of_view", tiles.count(ProxyOutcome::out_of_view));
    const auto factors = factors_.find(world_id(world));
    sink.count("reflections.outdated",
               factors == factors_.end() ? 0.0 : static_cast<double>(factors->second.outdated()));
  }
  [[nodiscard]] Status add_pick_copies(FrameBuilder& frame, Captures& copies) override {
    return add_reflection_pick_copies(frame, copies);
  }
  [[nodiscard]] std::vector<std::string> pick(FrameBuilder& frame, const PickedPixel& pixel,
                                              const Captures& copies) const override {
    return reflection_pick_lines(frame, pixel, copies);
  }
  void free_idle_memory() override { staging_.release(); }
  void release() override {
    staging_.release();
    factors_.clear();
    progress_.clear();
    reflecting_.clear();
  }

 private:
  /// Captures reflect captured probes only.
  static bool reflects_probes(const World& world, const RenderView& view) {
    return view.purpose != ViewPurpose::capture || !world.resource<ReflectionCaptures>().probe_entities.empty();
  }
  static ProxyTileSettings tile_settings(const World& world, ViewId view, const KnobRegistry& registry) {
    const ReflectionKnobs knobs = reflection_knobs(registry);
    ProxyTileSettings settings = knobs.tiles;
    settings.columns = (world.view_resource<RenderView>(view).width + knobs.scale() - 1) / knobs.scale();
    return settings;
  }

  void announce(FrameBuilder& frame) {
    announce_reflections(frame, staging_, factors_of(frame.world()), progress_[world_id(frame.world())]);
    announce_reflection_view(frame);
    last_rooms_ = room_tiers_in_use(frame.world());
    const auto* plan = frame.find<ReflectionPlan>();
    const auto* probes = frame.find<SurroundingProbes>();
    if (probes != nullptr) last_probes_ = probes->rows.size();
    note_reflecting(frame, plan != nullptr && (plan->mirror || !probes->rows.empty()));
  }

  CaptureFactors& factors_of(const World& world) {
    if (factors_.size() > kMostWorlds) {  // of worlds that are gone
      factors_.clear();
      progress_.clear();
    }
    return factors_[world_id(world)];
  }

  void note_reflecting(const FrameBuilder& frame, bool reflects) {
    const std::pair key(world_id(frame.world()), frame.view().id.value);
    if (reflects) {
      reflecting_.insert(key);
    } else {
      reflecting_.erase(key);
    }
  }

  static constexpr std::size_t kMostWorlds = 8;
  Staging staging_{"reflections"};
  std::map<std::uint64_t, ProbeProgress> progress_;               ///< by world_id
  std::map<std::uint64_t, CaptureFactors> factors_;               ///< by world_id
  std::set<std::pair<std::uint64_t, std::uint32_t>> reflecting_;  ///< world_id and view: its last frame showed captures
  std::size_t last_probes_ = 0;                                   ///< captured probes of the last frame
  RoomTiersInUse last_rooms_ = 0;                                 ///< kinds of rooms in its world
  bool last_blended_ = false;                                     ///< it had a BlendedLayer
};

}  // namespace

std::unique_ptr<Module> make_reflections_module() { return std::make_unique<ReflectionsModule>(); }

}  // namespace gloam
