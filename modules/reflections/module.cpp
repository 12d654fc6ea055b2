// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/module.h"

#include "engine/scene/key_table.h"
#include "modules/lights/components.h"
#include "modules/reflections/components.h"
#include "modules/reflections/proxies/systems.h"

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

class ReflectionsModule final : public Module {
 public:
  [[nodiscard]] std::string_view name() const override { return "reflections"; }
  [[nodiscard]] bool built() const override { return false; }
  void register_components(World& world) const override {
    world.register_component<IbrProxy>("ibr_proxy");
    world.register_component<IbrRoom>("ibr_room");
    world.register_component<CubeProbe>("cube_probe");
    world.register_component<ReflectingHeights>("reflecting_heights");
    world.set_resource(ProxySet{});
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
    registry.add(
        vec3_key(line("gloam.cube_probe.size", "", "m", "size of the probe's influence box, centred on the node"), 1e-6,
                 1e6, &CubeProbe::size_m));
    registry.add(integer_key(line("gloam.cube_probe.resolution", "128", "texels", "side of each cube face"), 1, 4096,
                             &CubeProbe::resolution));
    registry.add(boolean_key(line("gloam.cube_probe.global", "false", "", "whether this is the global probe"),
                             &CubeProbe::global));
    registry.add_finish("reflections", &check_light_names);
  }
  void add_systems(Schedule& schedule) override { add_proxy_systems(schedule); }
  void prepare_view(World& world, ViewId view, const KnobRegistry&) const override { prepare_proxy_view(world, view); }
  [[nodiscard]] Demand demand(const World& world, const RenderView*) const override {
    std::size_t proxies = 0;
    world.view<const IbrProxy>().each(
        [&](const IbrProxy& p) { proxies += p.size_m.x > 0.0f && p.size_m.y > 0.0f ? 1 : 0; });
    std::size_t probes = 0;
    world.view<const CubeProbe>().each([&](const CubeProbe& p) { probes += p.global || p.size_m.x > 0.0f ? 1 : 0; });
    if (proxies + probes == 0) return {false, "no proxy and no probe"};
    return {true, std::to_string(proxies) + (proxies == 1 ? " proxy, " : " proxies, ") + std::to_string(probes) +
                      (probes == 1 ? " probe" : " probes")};
  }
};

}  // namespace

std::unique_ptr<Module> make_reflections_module() { return std::make_unique<ReflectionsModule>(); }

}  // namespace gloam
