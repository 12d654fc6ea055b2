// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <optional>
#include <vector>

#include "engine/render/frame_builder.h"
#include "engine/render/packing/mesh_packing.h"
#include "engine/render/readback/capture.h"
#include "tests/render/draws/drawn_scene.h"

// Casters outside the camera's view are deformed by the GPU, too.

namespace gloam {
namespace {

/// The data of the last frame that a probe module has recorded.
struct Seen {
  std::vector<Caster> casters;
  std::vector<std::uint32_t> first_vertices;  ///< by caster; kNone for rigid ones
  std::vector<vec3> moved;                    ///< the frame's deformed positions
  std::optional<Capture> capture;
  std::size_t draws = 0;
  bool simplified = false;
};

/// Records the casters and copies the deformed vertices out. `seen` must outlive it.
class ProbeModule final : public Module {
 public:
  ProbeModule(Seen& seen, bool simplified) : seen_(seen), simplified_(simplified) {}
  [[nodiscard]] std::string_view name() const override { return "probe"; }
  void register_components(World&) const override {}
  void scene_keys(KeyRegistry&) const override {}
  [[nodiscard]] Demand demand(const World&, const RenderView*) const override { return {true, "always"}; }
  [[nodiscard]] bool needs_casters(const World&, const KnobRegistry&) const override { return true; }
  [[nodiscard]] bool needs_simplified_casters(const World&, const KnobRegistry&) const override { return simplified_; }
  void add_passes(FrameBuilder& frame, PassPhase phase) override {
    if (phase != PassPhase::lists) return;
    seen_ = {};
    seen_.draws = frame.draws().solid.size() + frame.draws().blended.size();
    seen_.casters = frame.casters().casters;
    for (const Caster& caster : frame.casters().casters) {
      frame.use_caster_vertices(caster);
      seen_.first_vertices.push_back(caster.deform == kNone ? kNone
                                                            : frame.frame_draws().deforms[caster.deform].first_vertex);
      seen_.simplified = seen_.simplified || caster.primitive->simplified_index_count > 0;
    }
    const FrameBuilder::Deformed* deformed = frame.shared().find<FrameBuilder::Deformed>();
    if (deformed == nullptr) return;
    auto capture = capture_buffer(frame.graph(), frame.services().device, deformed->positions);
    if (frame.check(capture)) seen_.capture = *capture;
  }

 private:
  Seen& seen_;
  bool simplified_;
};

class CastersOnTheGpu : public test::DrawingTest {
 protected:
  void draw(test::Stage& own, Seen& seen) {
    own.render();
    ASSERT_TRUE(own.renderer->wait().ok());
    if (!seen.capture) return;
    const std::vector<std::byte> bytes = take_capture(*test::drawing_device(), *seen.capture);
    seen.moved.resize(bytes.size() / sizeof(vec3));
    std::memcpy(seen.moved.data(), bytes.data(), seen.moved.size() * sizeof(vec3));
  }
};

/// The bar's vertices in the GPU's order.
Primitive bar_in_gpu_order() {
  const Primitive bar = test::skinned_bar();
  std::vector<std::uint32_t> indices;
  static_cast<void>(build_clusters(bar, indices));
  return in_fetch_order(bar, indices);
}

TEST_F(CastersOnTheGpu, a_skinned_caster_behind_the_camera_is_moved_where_its_joints_are) {
  for (const double far : {0.0, 1e5}) {
    Seen seen;
    test::Stage own(std::make_unique<ProbeModule>(seen, false));
    const dvec3 offset(far, -far, far);
    own.settings = test::look_at(offset, offset + dvec3(0.0, 0.0, -1.0), 32, 18);
    const dmat4 base = glm::translate(dmat4(1.0), offset + dvec3(1.5, -1.0, 12.0));
    const dmat4 lower = base * glm::rotate(dmat4(1.0), 0.4, dvec3(0.0, 1.0, 0.0));
    const dmat4 upper =
        base * glm::translate(dmat4(1.0), dvec3(0.0, 2.0, 0.0)) * glm::rotate(dmat4(1.0), 1.1, dvec3(0.0, 0.0, 1.0));
    const std::uint32_t skin = test::two_joint_skin(own.world, 0, lower, upper);
    own.world.create(WorldTransform{base}, MeshInstance{own.scene.mesh(test::skinned_bar()), skin});
    draw(own, seen);
    EXPECT_EQ(seen.draws, 0u) << "nobody sees it";
    ASSERT_EQ(seen.casters.size(), 1u);
    const Caster& caster = seen.casters[0];
    ASSERT_NE(caster.deform, kNone);
    const Primitive bar = bar_in_gpu_order();
    ASSERT_GE(seen.moved.size(), seen.first_vertices[0] + bar.positions.size());
    const dmat4 joints[] = {lower, upper * glm::translate(dmat4(1.0), dvec3(0.0, -2.0, 0.0))};
    for (std::size_t v = 0; v < bar.positions.size(); ++v) {
      const dvec4 rest(dvec3(bar.positions[v]), 1.0);
      const dvec3 expected(static_cast<double>(bar.weights[v].x) * (joints[0] * rest) +
                           static_cast<double>(bar.weights[v].y) * (joints[1] * rest));
      const dvec3 moved = dvec3(caster.world_from_mesh * dvec4(dvec3(seen.moved[seen.first_vertices[0] + v]), 1.0));
      ASSERT_LT(glm::length(moved - expected), 1e-4) << "vertex " << v << " at " << far;
      ASSERT_TRUE(glm::all(glm::lessThanEqual(caster.bounds_min - 1e-4, moved)) &&
                  glm::all(glm::lessThanEqual(moved, caster.bounds_max + 1e-4)));
    }
  }
}

TEST_F(CastersOnTheGpu, simplified_indices_draw_the_same_picture) {
  std::vector<std::uint8_t> pictures[2];
  for (const bool simplified : {false, true}) {
    Seen seen;
    test::Stage own(std::make_unique<ProbeModule>(seen, simplified));
    test::fill_small_scene(own.world);
    test::add_lights(own.world);
    Primitive sheet;
    for (std::uint32_t i = 0; i < 21 * 21; ++i)
      sheet.positions.push_back({static_cast<float>(i % 21) - 10.0f, 0.0f, static_cast<float>(i / 21) - 10.0f});
    for (std::uint32_t z = 0; z < 20; ++z)
      for (std::uint32_t x = 0; x < 20; ++x)
        for (const std::uint32_t v : {0u, 21u, 1u, 1u, 21u, 22u}) sheet.indices.push_back(z * 21 + x + v);
    sheet.normals.assign(sheet.positions.size(), vec3(0.0f, 1.0f, 0.0f));
    own.scene.draw(own.scene.mesh(test::finished(std::move(sheet))), glm::translate(dmat4(1.0), dvec3(0.0, -1.5, 0.0)));
    own.settings = test::look_at(dvec3(2.0, 3.0, 9.0), dvec3(0.0), 48, 27);
    draw(own, seen);
    EXPECT_EQ(seen.simplified, simplified);
    pictures[simplified ? 1 : 0] = own.picture().rgba;
  }
  EXPECT_EQ(pictures[0], pictures[1]) << "what the camera sees has all its triangles";
}

}  // namespace
}  // namespace gloam
