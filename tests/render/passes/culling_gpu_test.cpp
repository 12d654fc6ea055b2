// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "engine/render/draws/culling.h"
#include "tests/render/draws/drawn_scene.h"

// Hidden clusters are not drawn: pictures and depths are those of drawing all clusters of the view, bit by bit.

namespace gloam {
namespace {

class Random {
 public:
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(numbers_()) / static_cast<double>(std::mt19937::max());
  }
  float unit() { return static_cast<float>(between(0.0, 1.0)); }
  std::size_t below(std::size_t count) { return numbers_() % count; }

 private:
  std::mt19937 numbers_{7};
};

class HiddenClusters : public test::DrawingTest {
 protected:
  /// A crowd of boxes, balls and walls, of all kinds of materials, mirrored, turned and stretched, within `reach` of
  /// the middle. Some lie in the planes of others.
  void fill(Random& random, const dvec3& middle, double reach) {
    std::vector<std::uint32_t> meshes;
    for (int kind = 0; kind < 12; ++kind) {
      Material material;
      material.base_color = vec4(random.unit(), random.unit(), random.unit(), 1.0f);
      material.double_sided = kind % 3 == 0;
      if (kind % 4 == 1) {
        material.alpha_mode = AlphaMode::mask;
        material.base_color_texture.texture = stage->scene.texture(2, 1, {255, 0, 0, 255, 0, 255, 0, 0}, true);
      }
      const std::uint32_t id = stage->scene.material(material);
      const Primitive shapes[] = {test::box(vec3(1.0f, 0.6f, 0.3f), id), test::round_ball(0.8f, 40, 24, id),
                                  test::quad(1.5f, id)};
      meshes.push_back(stage->scene.mesh(shapes[kind / 4]));
    }
    for (int i = 0; i < 160; ++i) {
      const bool aligned = i % 4 == 0;
      const auto place = [&] {
        const double at = random.between(-1.0, 1.0) * reach;
        return aligned ? std::round(at / (0.5 * reach)) * 0.5 * reach : at;
      };
      dmat4 matrix = glm::translate(dmat4(1.0), middle + dvec3(place(), place(), place()));
      if (!aligned)
        matrix = glm::rotate(matrix, random.between(0.0, 6.0),
                             glm::normalize(dvec3(random.unit() - 0.5, random.unit() - 0.5, random.unit() + 0.1)));
      const auto side = [&] { return (random.unit() < 0.2f ? -1.0 : 1.0) * random.between(0.03, 0.25) * reach; };
      stage->scene.draw(meshes[random.below(meshes.size())],
                        glm::scale(matrix, aligned ? dvec3(0.25 * reach) : dvec3(side(), side(), side())));
    }
  }

  void expect_same_with_culling(const std::string& what) {
    struct Drawn {
      Picture picture;
      ImageBytes depth;
    };
    const auto draw = [&](Culling culling) {
      stage->renderer->knobs().set(kCulling, culling);
      stage->render();
      Picture picture = stage->picture();
      return Drawn{std::move(picture), test::value_of(stage->renderer->read_image(stage->world, ViewId{0}, "depth"))};
    };
    const Drawn all = draw(Culling::frustum), culled = draw(Culling::occlusion);
    EXPECT_TRUE(all.picture.rgba == culled.picture.rgba) << what << ": the picture differs";
    EXPECT_TRUE(all.depth.bytes == culled.depth.bytes) << what << ": the depth differs";
    hidden += stage->renderer->report().counters.at("scene.clusters_culled");
    in_view += stage->renderer->report().counters.at("scene.clusters");
  }

  double hidden = 0.0, in_view = 0.0;
};

TEST_F(HiddenClusters, are_not_drawn_behind_a_wall_but_behind_holes_and_beside_it) {
  Material material;
  material.double_sided = true;
  Material cut_out = material;
  cut_out.alpha_mode = AlphaMode::mask;
  const dmat4 wall_at = glm::translate(dmat4(1.0), dvec3(0.0, 0.0, -5.0));
  const std::uint32_t wall = stage->scene.mesh(test::quad(10.0f, stage->scene.material(material)));
  const std::uint32_t fence = stage->scene.mesh(test::quad(10.0f, stage->scene.material(cut_out)));
  const std::uint32_t ball = stage->scene.mesh(test::round_ball(0.5f, 12, 8));
  const Entity before = stage->scene.draw(wall, wall_at);
  for (int i = 0; i < 9; ++i) stage->scene.draw(ball, glm::translate(dmat4(1.0), dvec3(i % 3 - 1, i / 3 - 1, -9.0)));
  const auto culled = [&](const std::string& what) {
    hidden = 0.0;
    expect_same_with_culling(what);
    return hidden;
  };
  EXPECT_EQ(culled("a wall"), 9.0);
  stage->world.get<MeshInstance>(before).mesh = fence;
  EXPECT_EQ(culled("a surface with holes"), 0.0);
  stage->world.get<MeshInstance>(before).mesh = wall;
  stage->world.get<WorldTransform>(before).matrix = glm::translate(wall_at, dvec3(-10.0, 0.0, 0.0));
  EXPECT_EQ(culled("the left half is hidden"), 3.0);
  stage->world.get<WorldTransform>(before).matrix = glm::translate(wall_at, dvec3(0.0, 0.0, -10.0));
  EXPECT_EQ(culled("the wall is behind"), 0.0);
  stage->world.get<WorldTransform>(before).matrix = wall_at;
  stage->settings.mirror = MirrorPlane{.normal = dvec3(0.0, 0.0, 1.0), .offset = -12.0};
  EXPECT_EQ(culled("a mirror's plane may cut the wall off"), 0.0);
}

TEST_F(HiddenClusters, are_searched_for_automatically_where_that_pays) {
  const std::uint32_t ball = stage->scene.mesh(test::round_ball(0.3f, 48, 40));  // 3,840 triangles
  for (int i = 0; i < 40; ++i)
    stage->scene.draw(ball, glm::translate(dmat4(1.0), dvec3(i % 8 - 3.5, i / 8 - 2.0, -9.0)));
  const auto hidden_after = [&](int frames) {
    for (int i = 0; i < frames; ++i) {
      stage->settings.camera_cut = i == 0;
      stage->render();
    }
    EXPECT_TRUE(stage->renderer->wait().ok());
    bool searched = false;
    for (const PassTime& pass : stage->renderer->report().passes) searched = searched || pass.name == "cull_clusters";
    return searched ? stage->renderer->report().counters.at("scene.clusters_culled") : -1.0;
  };
  EXPECT_EQ(hidden_after(1), 0.0) << "the first frame tries";
  EXPECT_EQ(hidden_after(8), -1.0) << "nothing is hidden: no search";
  stage->scene.draw(stage->scene.mesh(test::quad(10.0f)), glm::translate(dmat4(1.0), dvec3(0.0, 0.0, -5.0)));
  EXPECT_GT(hidden_after(8), 39.0);
  stage->renderer->knobs().set(kCulling, Culling::frustum);
  EXPECT_EQ(hidden_after(4), -1.0);
}

TEST_F(HiddenClusters, do_not_change_pictures_of_random_scenes) {
  Random random;
  struct Place {
    const char* name;
    dvec3 middle;
    double reach;
  };
  for (const Place& place : {Place{"here", dvec3(0.0), 10.0}, Place{"10 km away", dvec3(9e3, 50.0, -5e3), 10.0},
                             Place{"of kilometres", dvec3(0.0), 1e4}, Place{"of millimetres", dvec3(0.0), 1e-2}}) {
    stage = std::make_unique<test::Stage>();
    fill(random, place.middle, place.reach);
    if (place.reach == 10.0) test::fill_small_scene(stage->world);  // skinned, morphed and blended surfaces
    for (int i = 0; i < 12; ++i) {
      const auto at = [&] {
        return place.middle +
               place.reach * dvec3(random.between(-1.3, 1.3), random.between(-1.3, 1.3), random.between(-1.3, 1.3));
      };
      stage->settings = test::look_at(at(), at(), 96, 54);
      stage->settings.camera.near_m = static_cast<float>(place.reach * (i % 3 == 0 ? 1e-4 : 1e-2));
      stage->settings.camera.fov_y = static_cast<float>(random.between(0.2, 2.2));
      if (i % 4 == 3) {
        stage->settings.camera.orthographic = true;
        stage->settings.camera.half_height_m = static_cast<float>(place.reach * random.between(0.1, 1.0));
        stage->settings.camera.far_m = static_cast<float>(place.reach * 4.0);
      }
      expect_same_with_culling(std::string(place.name) + ", camera " + std::to_string(i));
    }
  }
  EXPECT_GT(hidden, 0.05 * in_view) << "clusters are hidden, so the pictures above mean something";
}

}  // namespace
}  // namespace gloam
