// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/closeups/module.h"

#include "engine/scene/key_table.h"
#include "modules/closeups/components.h"
#include "modules/lights/components.h"

namespace gloam {
namespace {

Status check_light_names(World& world) {
  Status status;
  world.view<const CloseupSubject>().each([&](const CloseupSubject& subject) {
    const std::string& names = world.resource<SceneStrings>().text(subject.lights);
    if (auto lights = resolve_light_names(world, names, "gloam.closeup.lights"); status.ok() && !lights.ok())
      status = lights.error();
  });
  return status;
}

class CloseupsModule final : public Module {
 public:
  [[nodiscard]] std::string_view name() const override { return "closeups"; }
  [[nodiscard]] bool built() const override { return false; }
  void register_components(World& world) const override {
    world.register_component<CloseupSubject>("closeup_subject");
    world.register_component<CloseupPair>("closeup_pair");
  }
  void scene_keys(KeyRegistry& registry) const override {
    registry.add(boolean_key(key_line("closeups", KeyElement::node, "gloam.closeup", "false", "",
                                      "this subtree is a close-up subject"),
                             &CloseupSubject::enabled));
    registry.add(text_key(key_line("closeups", KeyElement::node, "gloam.closeup.lights", "", "",
                                   "comma-separated light node names; default: every shadowed light that reaches it"),
                          &CloseupSubject::lights));
    registry.add(number_key(key_line("closeups", KeyElement::node, "gloam.closeup.priority", "1", "",
                                     "order when the budget is short"),
                            -1e6, 1e6, &CloseupSubject::priority));
    registry.add_finish("closeups", &check_light_names);
  }
  [[nodiscard]] Demand demand(const World& world, const RenderView*) const override {
    std::size_t subjects = 0;
    world.view<const CloseupSubject>().each([&](const CloseupSubject& s) { subjects += s.enabled ? 1 : 0; });
    if (subjects == 0) return {false, "no close-up subject"};
    return {true, std::to_string(subjects) + (subjects == 1 ? " close-up subject" : " close-up subjects")};
  }
};

}  // namespace

std::unique_ptr<Module> make_closeups_module() { return std::make_unique<CloseupsModule>(); }

}  // namespace gloam
