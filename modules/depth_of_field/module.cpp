// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/depth_of_field/module.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/scene/keys/table.h"
#include "engine/scene/units.h"
#include "modules/depth_of_field/components.h"
#include "modules/depth_of_field/debug/coc_view.h"
#include "modules/depth_of_field/dof_passes.h"
#include "modules/depth_of_field/knobs.h"
#include "modules/depth_of_field/lens/lens.h"
#include "modules/depth_of_field/reference/lens_picture.h"
#include "modules/depth_of_field/reference/lens_reference.h"
#include "modules/lighting/outputs.h"

namespace gloam {
namespace {

constexpr const char* kListsResult = "lists";

/// The demand of a view whose world has cameras with a focus.
Demand view_demand(const World& world, const RenderView& view) {
  if (view.purpose == ViewPurpose::capture) return {false, "captures are in focus"};
  if (view.is_companion()) return {false, "the view's main view is blurred"};
  if (const auto* lens = world.try_resource<LensPoint>(); lens != nullptr && lens->camera == view.camera_entity)
    return {false, "the view is drawn from a point of the lens"};
  if (find_lens_picture(world, view) != nullptr) return {true, "the view shows a lens picture"};
  const DepthOfField* values = find_depth_of_field(world, view);
  if (values == nullptr) return {false, "the view's camera has no focus"};
  if (!lens_of(*values, view)) return {false, "the lens is too small to blur anything"};
  return {true, "the view's camera has a focus"};
}

class DepthOfFieldModule final : public Module {
 public:
  [[nodiscard]] std::string_view name() const override { return "depth_of_field"; }
  [[nodiscard]] std::vector<std::string_view> follows() const override {
    return {"lights", "shadows", "closeups", "lighting", "reflections", "grass", "particles", "fog"};
  }
  void register_components(World& world) const override { world.register_component<DepthOfField>("depth_of_field"); }
  void scene_keys(KeyRegistry& registry) const override {
    const auto line = [](std::string key, std::string fallback, std::string unit, std::string meaning) {
      return key_line("depth_of_field", KeyElement::camera_node, std::move(key), std::move(fallback), std::move(unit),
                      std::move(meaning));
    };
    registry.add(number_key(line("gloam.dof.focus", "", "m", "focus distance; if set, the camera has depth of field"),
                            1e-9, 1e12, &DepthOfField::focus_m));
    registry.add(
        number_key(line("gloam.dof.f_number", "2.8", "", "focal length divided by the diameter of the aperture"), 0.1,
                   1000, &DepthOfField::f_number));
    registry.add(choice_key(line("gloam.dof.bokeh", "round", "", "shape of the aperture"), {"round", "hexagonal"},
                            Bokeh::round, &DepthOfField::bokeh));
    registry.add_finish("depth_of_field", [](World& world) -> Status {
      const double unit_m = metres_per_unit(world);
      if (unit_m == 1.0) return {};
      world.view<DepthOfField>().each([&](DepthOfField& values) {
        values.focus_m = static_cast<float>(values.focus_m / unit_m);
        values.metres_per_unit = static_cast<float>(unit_m);
      });
      return {};
    });
  }
  void knobs(KnobRegistry& registry) const override { add_dof_knobs(registry); }
  [[nodiscard]] std::vector<ReferenceInfo> references() const override {
    std::vector<ReferenceInfo> references;
    for (const std::string_view knob : {kDofCache.name, kDofRadius.name, kDofFullResolution.name})
      references.push_back(lens_reference(std::string(knob)));
    return references;
  }
  [[nodiscard]] std::string idle_knob(const World&, const RenderView&, std::string_view,
                                      const FrameCounters& counters) const override {
    const auto tiles = counters.find("dof.tiles");
    return tiles != counters.end() && tiles->second == 0.0 ? "all that is in view is in focus" : "";
  }
  [[nodiscard]] bool shows_surfaces(const World&, const RenderView&) const override { return false; }
  [[nodiscard]] Demand demand(const World& world, const RenderView* view) const override {
    if (view != nullptr) return view_demand(world, *view);
    std::size_t cameras = 0;
    world.view<const DepthOfField>().each([&](const DepthOfField& d) { cameras += has_focus(d) ? 1 : 0; });
    if (cameras == 0) return {false, "no camera has a focus"};
    return {true, std::to_string(cameras) + (cameras == 1 ? " camera has a focus" : " cameras have a focus")};
  }
  [[nodiscard]] std::vector<VisualizerInfo> visualizers() const override { return dof_visualizers(); }
  void pipelines(const KnobRegistry& knobs, const gpu::DeviceInfo& device, PipelineList& list) const override {
    list_dof_pipelines(dof_knobs(knobs), device.threads_in_turn, list);
  }
  void add_passes(FrameBuilder& frame, PassPhase phase) override {
    if (phase == PassPhase::announce && find_depth_of_field(frame.world(), frame.view()) != nullptr)
      frame.put(FrontDepthWanted{});
    if (phase == PassPhase::post) add_post_passes(frame);
    const DofFrame* dof = frame.find<DofFrame>();
    if (dof == nullptr || !frame.status().ok()) return;
    if (phase == PassPhase::post) frame.keep_result("depth_of_field", kListsResult, dof->tiles.lists);
    if (phase == PassPhase::visualize) add_dof_view_pass(frame, *dof);
  }
  void result_counters(std::string_view name, const FrameResult& result, CounterSink& sink) const override {
    if (name != kListsResult) return;
    struct Lists {
      shaders::DofList list[GLOAM_DOF_LISTS];
    };
    const Lists lists = result.value<Lists>();
    std::uint32_t composed = 0;
    for (int kind = 0; kind < GLOAM_DOF_COMPOSE_KINDS; ++kind) composed += lists.list[GLOAM_DOF_COMPOSE + kind].count;
    sink.count("dof.tiles", composed);
    sink.count("dof.tiles_near", lists.list[GLOAM_DOF_NEAR_TILES].count);
    sink.count("dof.tiles_coarser", lists.list[GLOAM_DOF_COARSER].count);
    sink.count("dof.sprites", lists.list[GLOAM_DOF_SPRITES].count);
    sink.count("dof.sprite_overflow", lists.list[GLOAM_DOF_OVERFLOW].count);
  }
  void free_idle_memory() override { staging_.release(); }
  void release() override { staging_.release(); }

 private:
  void add_post_passes(FrameBuilder& frame) {
    if (const LensPicture* picture = find_lens_picture(frame.world(), frame.view()))
      return add_light_picture_pass(frame, staging_, "dof_lens_picture", *picture);
    const DepthOfField* values = find_depth_of_field(frame.world(), frame.view());
    const std::optional<Lens> lens = values != nullptr ? lens_of(*values, frame.view()) : std::nullopt;
    if (lens) add_dof_passes(frame, *values, *lens);
  }

  Staging staging_{"depth_of_field"};
};

}  // namespace

std::unique_ptr<Module> make_depth_of_field_module() { return std::make_unique<DepthOfFieldModule>(); }

}  // namespace gloam
