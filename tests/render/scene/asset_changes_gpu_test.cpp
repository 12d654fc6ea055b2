// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Pictures of a world whose assets change one by one. A world that had them so from the beginning must give the same
// picture, to the bit.
#include <gmock/gmock.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "modules/grass/components.h"
#include "modules/reflections/components.h"
#include "modules/shadows/components.h"
#include "tests/render/draws/drawn_scene.h"

namespace gloam {
namespace {

dmat4 moved_to(double x, double y, double z) { return glm::translate(dmat4(1.0), dvec3(x, y, z)); }

/// The assets that the tests change: a floor that shines, a textured cube, a leaf that cuts out, and lamps with
/// shadows.
struct ChangedScene {
  std::uint32_t floor_material = 0, cube_material = 0, leaf_material = 0;
  std::uint32_t floor = 0, cube = 0, leaf = 0;
  std::uint32_t texture = 0;
};

ChangedScene fill_changing(World& world) {
  test::SceneMaker maker(world);
  ChangedScene scene;
  Material floor, cube, leaf;
  floor.metallic = 0.0f;
  floor.roughness = 0.1f;
  floor.base_color = vec4(0.3f, 0.3f, 0.3f, 1.0f);
  scene.floor_material = maker.material(floor);
  scene.texture = maker.texture(2, 2, {255, 60, 0, 255, 0, 255, 60, 255, 60, 0, 255, 255, 255, 255, 255, 0}, true);
  cube.metallic = 0.0f;
  cube.base_color_texture.texture = scene.texture;
  scene.cube_material = maker.material(cube);
  leaf = cube;
  leaf.alpha_mode = AlphaMode::mask;
  leaf.double_sided = true;
  scene.leaf_material = maker.material(leaf);
  scene.floor = maker.mesh(test::box(vec3(4.0f, 0.1f, 4.0f), scene.floor_material));
  scene.cube = maker.mesh(test::box(vec3(0.6f), scene.cube_material));
  scene.leaf = maker.mesh(test::quad(0.7f, scene.leaf_material));
  maker.draw(scene.floor, moved_to(0, -0.1, 0));
  maker.draw(scene.cube, moved_to(-1, 0.7, 0));
  maker.draw(scene.leaf, moved_to(1, 0.9, 0.4));
  for (const double x : {-2.0, 2.0}) {
    Light lamp;
    lamp.intensity = 60.0f;
    lamp.width_m = 0.1f;
    world.create(WorldTransform{moved_to(x, 2.5, 1.5)}, lamp, ShadowCaster{});
  }
  auto& environment = world.resource<SceneEnvironment>();
  environment.sky_zenith = vec3(0.5f, 1.0f, 3.0f);
  environment.sky_horizon = vec3(3.0f, 2.0f, 1.0f);
  environment.has_exposure = true;
  environment.exposure_ev100 = 4.0f;
  return scene;
}

using Change = std::function<void(World&, const ChangedScene&)>;

struct ChangeCase {
  std::string name;
  Change change;
};

void PrintTo(const ChangeCase& c, std::ostream* out) { *out << c.name; }

Mesh mesh_of(Primitive primitive) {
  Mesh mesh;
  mesh.bounds = primitive.bounds;
  mesh.primitives.push_back(std::move(primitive));
  return mesh;
}

std::vector<ChangeCase> change_cases() {
  const auto assets = [](World& world) -> SceneAssets& { return world.resource<SceneAssets>(); };
  return {
      {"colour",
       [=](World& world, const ChangedScene& scene) {
         assets(world).materials[scene.floor_material].base_color = vec4(0.7f, 0.2f, 0.1f, 1.0f);
         assets(world).mark_changed(AssetKind::material, scene.floor_material);
       }},
      {"a_mirror_becomes_rough_and_glows",
       [=](World& world, const ChangedScene& scene) {
         assets(world).materials[scene.floor_material].roughness = 1.0f;
         assets(world).materials[scene.floor_material].emissive = vec3(2.0f, 0.0f, 0.0f);
         assets(world).mark_changed(AssetKind::material, scene.floor_material);
       }},
      {"a_cut_out_becomes_opaque",
       [=](World& world, const ChangedScene& scene) {
         assets(world).materials[scene.leaf_material].alpha_mode = AlphaMode::opaque;
         assets(world).mark_changed(AssetKind::material, scene.leaf_material);
       }},
      {"image_of_another_size",
       [=](World& world, const ChangedScene& scene) {
         const std::uint32_t image = assets(world).textures[scene.texture].image;
         assets(world).images[image] = {"stripes", 4, 1, {255, 0, 0, 255, 0, 0, 0, 0, 0, 0, 255, 255, 0, 0, 0, 0}};
         assets(world).mark_changed(AssetKind::image, image);
       }},
      {"mesh",
       [=](World& world, const ChangedScene& scene) {
         assets(world).meshes[scene.cube] = mesh_of(test::round_ball(0.8f, 24, 12, scene.cube_material));
         assets(world).mark_changed(AssetKind::mesh, scene.cube);
       }},
      {"mesh_destroyed",
       [=](World& world, const ChangedScene& scene) { assets(world).destroy(AssetKind::mesh, scene.cube); }},
      {"another_mesh_in_a_destroyed_one's_place",
       [=](World& world, const ChangedScene& scene) {
         assets(world).destroy(AssetKind::mesh, scene.cube);
         EXPECT_EQ(assets(world).add(mesh_of(test::box(vec3(0.3f, 1.0f, 0.3f), scene.floor_material))), scene.cube);
       }},
      {"everything_added",
       [=](World& world, const ChangedScene&) {
         const std::uint32_t image = assets(world).add(Image{"new", 1, 1, {20, 200, 30, 255}});
         const std::uint32_t texture = assets(world).add(Texture{.name = "new", .image = image, .srgb = true});
         Material material;
         material.metallic = 0.0f;
         material.base_color_texture.texture = texture;
         const std::uint32_t mesh = assets(world).add(mesh_of(test::box(vec3(0.4f), assets(world).add(material))));
         world.create(WorldTransform{moved_to(0.2, 0.4, 1.5)}, MeshInstance{mesh});
       }},
  };
}

/// A renderer with a world.
struct Show {
  explicit Show(Readiness readiness, std::uint64_t budget = std::uint64_t{8} << 20) {
    RendererOptions options;
    options.device = test::drawing_device();
    options.executor = executor.get();
    options.log = &test::gpu_log();
    options.modules = make_all_modules();
    options.readiness = readiness;
    options.upload_budget = budget;
    renderer = test::value_of(Renderer::create(std::move(options)));
    renderer->prepare_world(world);
    scene = fill_changing(world);
  }
  void draw() {
    ViewRequest request;
    request.settings = test::look_at(dvec3(0.5, 2.0, 5.0), dvec3(0.0, 0.5, 0.0), 96, 64);
    const Status status = renderer->render(world, {&request, 1});
    ASSERT_TRUE(status.ok()) << status.error().message;
  }
  [[nodiscard]] Picture picture() {
    draw();
    return test::value_of(renderer->read_picture(ViewId{0}));
  }
  /// The picture after a few frames: maps and lists have settled.
  [[nodiscard]] Picture settled() {
    for (int frame = 0; frame < 3; ++frame) draw();
    return picture();
  }

  std::unique_ptr<JobExecutor> executor = make_pool_executor(2);
  std::unique_ptr<Renderer> renderer;
  World world;
  ChangedScene scene;
};

class AssetChanges : public ::testing::TestWithParam<ChangeCase> {
 protected:
  void SetUp() override {
    GLOAM_REQUIRE_GPU(test::drawing_device());
    GLOAM_REQUIRE_DEPTH_TESTS(test::drawing_device());
  }
  void TearDown() override {
    if (test::drawing_device() != nullptr) {
      EXPECT_EQ(test::drawing_device()->validation_messages(), 0u);
    }
  }
  /// The picture of a world that had the change before its first frame.
  [[nodiscard]] static Picture expected() {
    Show show(Readiness::wait);
    GetParam().change(show.world, show.scene);
    return show.settled();
  }
};

TEST_P(AssetChanges, give_the_picture_of_a_new_world) {
  Show show(Readiness::wait);
  const Picture before = show.settled();
  GetParam().change(show.world, show.scene);
  const Picture after = show.picture();
  EXPECT_NE(after.rgba, before.rgba) << "the next frame shows the change";
  EXPECT_EQ(show.renderer->report().assets_pending, 0u);
  EXPECT_EQ(show.settled().rgba, expected().rgba);
}

TEST_P(AssetChanges, give_the_same_picture_when_they_come_in_the_background) {
  Show show(Readiness::background, 256);
  for (int frame = 0; frame < 3 || show.renderer->report().pipelines_pending > 0; ++frame) show.draw();
  GetParam().change(show.world, show.scene);
  int frames = 0;
  do {
    show.draw();
    ASSERT_LT(++frames, 5000);
  } while (show.renderer->report().assets_pending > 0 || show.renderer->report().pipelines_pending > 0);
  EXPECT_EQ(show.settled().rgba, expected().rgba);
}

INSTANTIATE_TEST_SUITE_P(All, AssetChanges, ::testing::ValuesIn(change_cases()), [](const auto& given) {
  std::string name = given.param.name;
  std::erase(name, '\'');
  return name;
});

}  // namespace
}  // namespace gloam
