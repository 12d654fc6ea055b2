// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdio>
#include <memory>

#include "engine/render/readback/geometry_picture.h"
#include "tests/render/draws/drawn_scene.h"
#include "tests/render/passes/smooth_surface_oracle.h"

// GeometryOutputs::smooth_surfaces against facets hit by rays in double precision.

namespace gloam {
namespace {

using test::Facet;
using test::value_of;

/// Greatest difference from an offset, over its length: directions have 8 bits a coordinate.
constexpr double kMostOff = 0.017;

/// Asks for smooth surfaces while *wanted.
class SmoothSurfaceReader final : public Module {
 public:
  explicit SmoothSurfaceReader(const bool& wanted) : wanted_(wanted) {}
  [[nodiscard]] std::string_view name() const override { return "smooth_surface_reader"; }
  void register_components(World&) const override {}
  void scene_keys(KeyRegistry&) const override {}
  [[nodiscard]] Demand demand(const World&, const RenderView*) const override { return {true, "reads surfaces"}; }
  [[nodiscard]] bool needs_smooth_surfaces(const World&, const KnobRegistry&) const override { return wanted_; }

 private:
  const bool& wanted_;
};

/// A patch z = bend · x² + side_bend · y² over [−1, 1]², in few facets, with the surface's normals.
Primitive patch(float bend, float side_bend, std::uint32_t material) {
  constexpr std::uint32_t kSide = 4;
  Primitive p;
  p.material = material;
  for (std::uint32_t row = 0; row <= kSide; ++row)
    for (std::uint32_t column = 0; column <= kSide; ++column) {
      const float x = 2.0f * static_cast<float>(column) / kSide - 1.0f;
      const float y = 2.0f * static_cast<float>(row) / kSide - 1.0f;
      p.positions.push_back({x, y, bend * x * x + side_bend * y * y});
      p.normals.push_back(glm::normalize(vec3(-2.0f * bend * x, -2.0f * side_bend * y, 1.0f)));
    }
  for (std::uint32_t row = 0; row < kSide; ++row)
    for (std::uint32_t column = 0; column < kSide; ++column) {
      const std::uint32_t a = row * (kSide + 1) + column, b = a + kSide + 1;
      for (const std::uint32_t i : {a, a + 1, b + 1, a, b + 1, b}) p.indices.push_back(i);
    }
  return test::finished(std::move(p));
}

class SmoothSurfaces : public test::DrawingTest {
 protected:
  void SetUp() override {
    DrawingTest::SetUp();
    if (IsSkipped()) return;
    stage = std::make_unique<test::Stage>(std::make_unique<SmoothSurfaceReader>(wanted));
    stage->settings = test::look_at(dvec3(0.5, 0.7, 4.0), dvec3(0.0), 160, 120);
  }
  [[nodiscard]] static dmat4 at(const dvec3& place) { return glm::translate(dmat4(1.0), place); }
  [[nodiscard]] static dmat4 turned(double angle, const dvec3& axis) {
    return glm::rotate(dmat4(1.0), angle, glm::normalize(axis));
  }
  void put(const Primitive& mesh, const dmat4& matrix) {
    stage->scene.draw(stage->scene.mesh(mesh), matrix);
    for (const Facet& facet : test::facets_of(mesh, matrix)) facets.push_back(facet);
  }
  [[nodiscard]] GeometryPicture drawn() {
    stage->render();
    return value_of(stage->renderer->read_geometry(stage->world, ViewId{0}));
  }

  struct Compared {
    int convex = 0;
    int flat = 0;        ///< flat-shaded or concave: no smooth surface
    int partly = 0;      ///< neither
    double worst = 0.0;  ///< greatest difference from the offset, over its length
  };
  /// Compares every pixel with the facet that its ray hits. Pixels near a facet's border are left out.
  [[nodiscard]] Compared compare(const GeometryPicture& picture) const {
    Compared found;
    for (std::uint32_t y = 0; y < picture.view.height; ++y)
      for (std::uint32_t x = 0; x < picture.view.width; ++x) {
        const std::size_t pixel = std::size_t{y} * picture.view.width + x;
        const SmoothSurface seen = picture.smooth_surface(pixel);
        if (picture.is_sky(pixel)) {
          EXPECT_FALSE(seen.exists);
          continue;
        }
        const dvec3 ray = picture.position(x, y);
        const auto hit = test::first_hit(facets, picture.view.position, ray);
        if (!hit || std::min({hit->share.x, hit->share.y, hit->share.z}) < 1e-3) continue;
        compare_pixel(*hit, ray, seen, found);
      }
    return found;
  }
  static void compare_pixel(const test::FacetHit& hit, const dvec3& ray, const SmoothSurface& seen, Compared& found) {
    Facet facet = *hit.facet;
    const dvec3 face = glm::cross(facet[1].position - facet[0].position, facet[2].position - facet[0].position);
    const bool back = glm::dot(face, facet[0].normal) * glm::dot(face, ray) > 0.0;
    if (back)
      for (test::Corner& corner : facet) corner.normal = -corner.normal;
    const dvec3 offset = test::hanika_offset(facet, hit.share);
    if (glm::length(offset) < 1e-6) {
      // Also true for facets that are curved only across: nothing to compare.
      EXPECT_LE(glm::length(seen.offset), 2e-6f);
      found.flat += seen.exists ? 0 : 1;
      return;
    }
    EXPECT_TRUE(seen.exists);
    const double off = glm::length(dvec3(seen.offset) - offset) / glm::length(offset);
    found.worst = std::max(found.worst, off);
    EXPECT_LE(off, kMostOff);
    if (test::is_convex(facet, 1e-4)) {
      ++found.convex;
      EXPECT_LE(glm::length(dvec3(seen.normal) - test::interpolated_normal(facet, hit.share)), 1e-3);
    } else {
      ++found.partly;
      EXPECT_GT(glm::dot(dvec3(seen.normal), -ray), -0.2 * glm::length(ray));
    }
  }
  static void print(const char* what, const Compared& c) {
    std::printf("%-20s %d convex, %d partly, %d flat; offsets off by up to %.4f of their length\n", what, c.convex,
                c.partly, c.flat, c.worst);
  }

  bool wanted = true;
  std::vector<Facet> facets;
};

TEST_F(SmoothSurfaces, lie_where_the_planes_of_the_vertices_are_on_average) {
  put(test::round_ball(0.8f, 12, 8), at({-1.0, 0.3, 0.0}) * turned(0.4, dvec3(1, 2, 3)));
  put(test::round_ball(0.6f, 7, 5), at({0.9, 0.5, 0.3}) * glm::scale(dmat4(1.0), dvec3(-1.0, 1.4, 0.7)));
  put(test::box(vec3(0.3f)), at({0.2, -0.8, 1.0}) * turned(0.6, dvec3(1, 1, 0)));
  const Compared c = compare(drawn());
  print("balls and a box", c);
  EXPECT_GT(c.convex, 2000);
  EXPECT_GT(c.flat, 200);
}

TEST_F(SmoothSurfaces, of_bowls_do_not_exist_and_saddles_have_them_where_planes_are_above) {
  Material sheet;
  sheet.double_sided = true;
  const std::uint32_t material = stage->scene.material(sheet);
  put(patch(0.5f, 0.0f, material), at({-1.2, 0.0, 0.0}));
  put(patch(-0.5f, 0.0f, material), at({1.2, 0.8, 0.0}));
  put(patch(0.4f, -0.4f, material), at({1.2, -1.0, 0.0}));
  const Compared c = compare(drawn());
  print("patches", c);
  EXPECT_GT(c.convex, 500);
  EXPECT_GT(c.partly, 500);
  EXPECT_GT(c.flat, 500) << "the hollow side of a sheet";
}

TEST_F(SmoothSurfaces, keep_their_accuracy_far_from_the_origin) {
  const dvec3 far(1e5, -2e5, 3e5);
  put(test::round_ball(0.8f, 12, 8), at(far) * turned(0.4, dvec3(1, 2, 3)));
  stage->settings = test::look_at(far + dvec3(0.5, 0.7, 4.0), far, 160, 120);
  const Compared c = compare(drawn());
  print("far from the origin", c);
  EXPECT_GT(c.convex, 1000);
}

TEST_F(SmoothSurfaces, exist_only_where_asked_for_and_where_meshes_are_smooth_shaded) {
  put(test::box(vec3(0.5f)), turned(0.6, dvec3(1, 1, 0)));
  EXPECT_TRUE(drawn().smooth_surfaces.empty()) << "a scene of flat-shaded meshes";
  put(test::round_ball(0.3f, 12, 8), at({1.0, 0.0, 0.0}));
  EXPECT_FALSE(drawn().smooth_surfaces.empty());
  wanted = false;
  EXPECT_TRUE(drawn().smooth_surfaces.empty());
}

}  // namespace
}  // namespace gloam
