// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/depth_of_field/module.h"

#include "engine/scene/key_table.h"
#include "modules/depth_of_field/components.h"

namespace gloam {
namespace {

class DepthOfFieldModule final : public Module {
 public:
  [[nodiscard]] std::string_view name() const override { return "depth_of_field"; }
  [[nodiscard]] bool built() const override { return false; }
  void register_components(World& world) const override { world.register_component<DepthOfField>("depth_of_field"); }
  void scene_keys(KeyRegistry& registry) const override {
    const auto line = [](std::string key, std::string fallback, std::string unit, std::string meaning) {
      return key_line("depth_of_field", KeyElement::camera_node, std::move(key), std::move(fallback), std::move(unit),
                      std::move(meaning));
    };
    registry.add(number_key(line("gloam.dof.focus", "", "m", "focus distance; if set, the camera has depth of field"),
                            1e-3, 1e6, &DepthOfField::focus_m));
    registry.add(
        number_key(line("gloam.dof.f_number", "2.8", "", "focal length divided by the diameter of the aperture"), 0.1,
                   1000, &DepthOfField::f_number));
    registry.add(choice_key(line("gloam.dof.bokeh", "round", "", "shape of the aperture"), {"round", "hexagonal"},
                            Bokeh::round, &DepthOfField::bokeh));
  }
  [[nodiscard]] Demand demand(const World& world, const RenderView*) const override {
    std::size_t cameras = 0;
    world.view<const DepthOfField>().each([&](const DepthOfField& d) { cameras += d.focus_m > 0.0f ? 1 : 0; });
    if (cameras == 0) return {false, "no camera has a focus"};
    return {true, std::to_string(cameras) + (cameras == 1 ? " camera has a focus" : " cameras have a focus")};
  }
};

}  // namespace

std::unique_ptr<Module> make_depth_of_field_module() { return std::make_unique<DepthOfFieldModule>(); }

}  // namespace gloam
