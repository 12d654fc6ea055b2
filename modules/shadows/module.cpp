// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/module.h"

#include "engine/scene/key_table.h"
#include "modules/lights/components.h"
#include "modules/shadows/components.h"

namespace gloam {
namespace {

class ShadowsModule final : public Module {
 public:
  [[nodiscard]] std::string_view name() const override { return "shadows"; }
  [[nodiscard]] bool built() const override { return false; }
  void register_components(World& world) const override {
    world.register_component<ShadowCaster>("shadow_caster");
  }
  void scene_keys(KeyRegistry& registry) const override {
    registry.add(boolean_key(key_line("shadows", KeyElement::light_node, "gloam.light.shadow", "true", "", "casts shadows"),
                             &ShadowCaster::enabled));
    registry.add(integer_key(key_line("shadows", KeyElement::light_node, "gloam.light.shadow_resolution", "0", "texels",
                                      "of one face; 0 = from screen coverage"),
                             0, 8192, &ShadowCaster::resolution));
  }
  [[nodiscard]] Demand demand(const World& world, const RenderView*) const override {
    std::size_t casters = 0;
    world.view<const Light, Maybe<const ShadowCaster>>().each(
        [&](const Light&, const ShadowCaster* caster) { casters += caster == nullptr || caster->enabled ? 1 : 0; });
    if (casters == 0) return {false, "no light casts shadows"};
    return {true, std::to_string(casters) + (casters == 1 ? " light casts shadows" : " lights cast shadows")};
  }
};

}  // namespace

std::unique_ptr<Module> make_shadows_module() { return std::make_unique<ShadowsModule>(); }

}  // namespace gloam
