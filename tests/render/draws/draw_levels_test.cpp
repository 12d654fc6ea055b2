// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/render/camera/jitter.h"
#include "engine/render/packing/make_levels.h"
#include "engine/render/packing/nearest_surface.h"
#include "tests/render/draws/draw_lists_fixture.h"

namespace gloam {
namespace {

using test::placed;

class DrawLevels : public test::DrawListsTest {
 protected:
  void SetUp() override {
    const Primitive source = test::round_ball(1.0f, 96, 48, kNone);
    mesh_ = maker_.mesh(source);
    sync();
    ASSERT_TRUE(scene_.make_levels(maker_.assets(), *serial_, LevelUse::views).ok());
    made_ = make_levels(source, LevelUse::views);
    std::vector<std::uint32_t> indices = test::drawn_order(source);
    ordered_ = in_fetch_order(source, indices);
  }
  [[nodiscard]] const DetailLevels& levels() const { return scene_.meshes()[mesh_][0].levels(LevelUse::views); }
  /// The number of the level that the view draws; −1: all triangles.
  [[nodiscard]] int level_in(const RenderView& view) {
    const FrameDraws lists = lists_of(view);
    if (lists.views[0].solid.empty()) return -2;
    const Draw& drawn = lists.views[0].solid.front();
    if (drawn.first_index < levels().first_index) return -1;
    std::size_t level = 0;
    while (level + 1 < levels().levels.size() &&
           levels().first_index + levels().levels[level + 1].first_index <= drawn.first_index)
      ++level;
    return static_cast<int>(level);
  }
  /// The greatest distance in the picture between a vertex and the nearest point of the level.
  [[nodiscard]] double pixels_between(const RenderView& view, int level, const dmat4& matrix) const {
    const DetailLevel& own = made_.levels.levels[static_cast<std::size_t>(level)];
    const std::vector<std::uint32_t> indices(made_.indices.begin() + own.first_index,
                                             made_.indices.begin() + own.first_index + own.index_count);
    const NearestSurface surface(ordered_.positions, indices);
    const auto place = [&](const dvec3& point) {
      const dvec3 relative = dvec3(matrix * dvec4(point, 1.0)) - view.position;
      const dvec4 clip = dmat4(view.clip_from_relative) * dvec4(relative, 1.0);
      return 0.5 * glm::dvec2(view.width, view.height) * glm::dvec2(clip) / clip.w;
    };
    double most = 0.0;
    for (const vec3& vertex : ordered_.positions) {
      const NearestSurface::Hit hit = surface.nearest(vertex);
      dvec3 nearest(0.0);
      for (std::uint32_t k = 0; k < 3; ++k)
        nearest += static_cast<double>(hit.weights[static_cast<int>(k)]) *
                   dvec3(ordered_.positions[indices[hit.first_index + k]]);
      most = std::max(most, glm::length(place(dvec3(vertex)) - place(nearest)));
    }
    return most;
  }

  std::uint32_t mesh_ = 0;
  MadeLevels made_;
  Primitive ordered_;
};

TEST_F(DrawLevels, no_vertex_is_farther_from_the_level_than_the_view_allows) {
  int coarsest = -1;
  for (const double size : {0.01, 1.0, 100.0})
    for (const double distance : {1.5, 4.0, 15.0, 60.0, 400.0})
      for (const float field : {0.05f, 0.9f, 2.2f})
        for (const bool orthographic : {false, true}) {
          clear();
          const dvec3 at(1000.0 * size, 0.0, 0.0);
          const dmat4 matrix = placed(at, dvec3(0, 1, 0), 0.4, size * dvec3(1.0, 0.7, -1.3));
          draw(mesh_, matrix);
          // The ball is beside the middle of the picture.
          const dvec3 eye = at + size * distance * dvec3(0.6, 0.0, 0.8);
          const dvec3 aside = glm::normalize(dvec3(0.8, 0.0, -0.6)) * size * distance * 0.4 *
                              std::tan(0.5 * static_cast<double>(field));
          ViewSettings settings = test::look_at(eye, at + aside, 320, 180);
          settings.camera.fov_y = field;
          settings.camera.near_m = static_cast<float>(0.01 * size);
          settings.camera.orthographic = orthographic;
          settings.camera.half_height_m = static_cast<float>(size * distance) * std::tan(0.5f * field);
          RenderView view = make_view(settings, 0);
          EXPECT_LE(level_in(view), -1) << "without lod_pixels";
          view.lod_pixels = 0.5f;
          const int level = level_in(view);
          coarsest = std::max(coarsest, level);
          if (level >= 0) {
            EXPECT_LE(pixels_between(view, level, matrix), 0.5 * (1.0 + 1e-4))
                << "size " << size << " distance " << distance << " field " << field << " level " << level;
          }
        }
  EXPECT_EQ(coarsest, static_cast<int>(levels().levels.size()) - 1) << "far away the coarsest level suffices";
}

TEST_F(DrawLevels, a_finer_picture_draws_finer_levels_and_jitter_changes_none) {
  draw(mesh_, placed(dvec3(0.0), dvec3(0, 1, 0), 0.4, dvec3(1.0)));
  int before = 100;
  for (const std::uint32_t height : {45u, 180u, 720u, 2880u}) {
    RenderView view = make_view(test::look_at(dvec3(0.0, 3.0, 30.0), dvec3(0.5, 0.0, 0.0), 16 * height / 9, height), 0);
    view.lod_pixels = 0.5f;
    const int level = level_in(view);
    EXPECT_LE(level, before) << height;
    before = level;
    for (std::uint64_t i = 0; i < 16; ++i) {
      RenderView moved = view;
      apply_jitter(moved, jitter_point(i));
      EXPECT_EQ(level_in(moved), level);
    }
  }
  EXPECT_LT(before, static_cast<int>(levels().levels.size()) - 1);
}

TEST_F(DrawLevels, a_camera_in_the_box_of_a_mesh_sees_all_triangles) {
  draw(mesh_, placed(dvec3(0.0), dvec3(0, 1, 0), 0.4, dvec3(1.0)));
  RenderView view = make_view(test::look_at(dvec3(0.0, 0.0, 1.05), dvec3(0.0), 320, 180), 0);
  view.lod_pixels = 4.0f;
  EXPECT_EQ(level_in(view), -1);
}

}  // namespace
}  // namespace gloam
