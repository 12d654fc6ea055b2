// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// The table of results in docs/embedding.md states the formats that images really have.
#include <fstream>
#include <map>
#include <string>

#include "engine/render/frame_builder.h"
#include "modules/lighting/outputs.h"
#include "modules/lights/outputs.h"
#include "modules/shadows/components.h"
#include "modules/shadows/outputs.h"
#include "tests/render/misuse/careless_host.h"

namespace gloam {
namespace {

/// Notes the format of every image that the table names.
class NotesFormats final : public Module {
 public:
  explicit NotesFormats(std::map<std::string, std::string>& formats) : formats_(formats) {}
  [[nodiscard]] std::string_view name() const override { return "notes"; }
  void register_components(World&) const override {}
  void scene_keys(KeyRegistry&) const override {}
  [[nodiscard]] Demand demand(const World&, const RenderView*) const override { return {true, "always"}; }
  [[nodiscard]] bool needs_motion(const World&, const KnobRegistry&) const override { return true; }
  [[nodiscard]] bool needs_smooth_surfaces(const World&, const KnobRegistry&) const override { return true; }
  void add_passes(FrameBuilder& frame, PassPhase phase) override {
    if (phase == PassPhase::announce) frame.put(DiffuseLightWanted{});
    if (phase != PassPhase::post) return;
    const auto note = [&](const char* name, ImageRef image) {
      if (image) formats_[name] = name_of(frame.graph().desc(image).format);
    };
    note("LitOutput::color", frame.get<LitOutput>().color);
    note("DiffuseLightOutput::light", frame.get<DiffuseLightOutput>().light);
    const GeometryOutputs& geometry = frame.get<GeometryOutputs>();
    note("GeometryOutputs::base_color", geometry.base_color);
    note("GeometryOutputs::normals", geometry.normals);
    note("GeometryOutputs::material", geometry.material);
    note("GeometryOutputs::emissive", geometry.emissive);
    note("GeometryOutputs::depth", geometry.depth);
    note("GeometryOutputs::motion", geometry.motion);
    note("GeometryOutputs::smooth_surfaces", geometry.smooth_surfaces);
    note("GeometryOutputs::depth_bounds", geometry.depth_bounds);
    note("LightsOutputs::texels", frame.get<LightsOutputs>().texels);
    note("LightsOutputs::tile_lists", frame.get<LightsOutputs>().tile_lists);
    note("FinalLists::tiles", frame.get<ShadowsOutputs>().final_lists.value().tiles);
    note("ShadowsOutputs::atlas", frame.get<ShadowsOutputs>().atlas);
  }

 private:
  std::map<std::string, std::string>& formats_;
};

/// The first format of each row of the table, by the first name in the row's second column.
std::map<std::string, std::string> stated_formats() {
  std::ifstream page(GLOAM_SOURCE_DIR "/docs/embedding.md");
  std::map<std::string, std::string> formats;
  bool in_table = false;
  for (std::string line; std::getline(page, line);) {
    in_table = line.starts_with("| Result | Where | Format |") || (in_table && line.starts_with("|"));
    if (!in_table) continue;
    const std::size_t where = line.find("| `");
    const std::size_t format = line.rfind("| `");
    if (where == std::string::npos || where == format) continue;  // a buffer
    const auto quoted = [&](std::size_t bar) { return line.substr(bar + 3, line.find('`', bar + 3) - bar - 3); };
    formats[quoted(where)] = quoted(format);
  }
  return formats;
}

TEST(EmbeddingPage, states_the_formats_that_images_have) {
  std::map<std::string, std::string> formats;
  ModuleList modules = make_all_modules();
  modules.push_back(std::make_unique<NotesFormats>(formats));
  test::CarelessHost stage(std::move(modules));
  stage.world.create(WorldTransform{dmat4(1.0)}, Light{.intensity = 100.0f}, ShadowCaster{});
  ASSERT_TRUE(stage.render(test::CarelessHost::request()).ok());
  EXPECT_EQ(formats, stated_formats());
}

}  // namespace
}  // namespace gloam
