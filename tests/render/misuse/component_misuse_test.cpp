// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Components and assets with values of no sense: each is drawn, logged, or refused by a sentence that names it.
#include <functional>
#include <limits>

#include "modules/closeups/components.h"
#include "modules/depth_of_field/components.h"
#include "modules/fog/components.h"
#include "modules/grass/components.h"
#include "modules/particles/components.h"
#include "modules/reflections/components.h"
#include "modules/shadows/components.h"
#include "tests/render/misuse/careless_host.h"

namespace gloam {
namespace {

using test::CarelessHost;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(ComponentMisuse, assets_that_cannot_be_drawn_are_named_by_the_renderer) {
  using Break = std::function<void(SceneAssets&, Primitive&)>;
  const std::pair<Break, const char*> cases[] = {
      {[](auto&, auto& p) { p.normals.clear(); }, "has no normals"},
      {[](auto&, auto& p) { p.normals.pop_back(); }, "normals for"},
      {[](auto&, auto& p) { p.uv0.resize(1); }, "has 1 texture coordinates for"},
      {[](auto&, auto& p) { p.joints.resize(p.positions.size()); }, "has joints without weights"},
      {[](auto&, auto& p) { p.indices[0] = 1'000'000; }, "has the index 1000000 for"},
      {[](auto&, auto& p) { p.indices.pop_back(); }, "which are no triangles"},
      {[](auto&, auto& p) { p.positions[0].x = kNan; }, "has a position that is not finite"},
      {[](auto&, auto& p) { p.bounds = {}; }, "has no bounds"},
      {[](auto&, auto& p) { p.material = 77; }, "has the material 77 of"},
      {[](auto& a, auto&) { a.materials.at(0).base_color_texture.texture = 77; }, "has the texture 77 of"},
      {[](auto& a, auto&) { a.textures.push_back({.image = 77}); }, "has the image 77 of"},
      {[](auto& a, auto&) { a.images.push_back({.width = 4, .height = 4}); }, "has 0 bytes for 4x4 pixels"},
  };
  for (const auto& [broken, sentence] : cases) {
    CarelessHost stage;
    auto& assets = stage.world.resource<SceneAssets>();
    broken(assets, assets.meshes[0].primitives[0]);
    ++assets.version;
    EXPECT_ASSERT((void)stage.render(CarelessHost::request()), sentence);
  }
}

TEST(ComponentMisuse, a_number_of_no_string) {
  CarelessHost stage;
  stage.world.create(WorldTransform{}, Light{.kind = LightKind::spot, .cookie = 4711});
  EXPECT_ASSERT((void)stage.render(CarelessHost::request()), "a string's number comes from intern");
}

TEST(ComponentMisuse, a_parent_that_is_dead) {
  CarelessHost stage;
  const Entity parent = stage.world.create(LocalTransform{}, WorldTransform{});
  stage.world.create(LocalTransform{}, WorldTransform{}, Parent{parent, 1}, MeshInstance{0});
  stage.world.destroy(parent);
  ASSERT_TRUE(stage.render(CarelessHost::request()).ok());
  EXPECT_THAT(stage.device->faults(), IsEmpty());
}

TEST(ComponentMisuse, transforms_that_are_not_finite_are_drawn) {
  for (const double value : {double{kNan}, double{kInfinity}, 1e300, 0.0}) {
    CarelessHost stage;
    const dmat4 matrix(value);
    stage.world.create(LocalTransform{.translation = dvec3(value)}, WorldTransform{}, MeshInstance{0});
    stage.world.create(WorldTransform{matrix}, MeshInstance{0});
    stage.world.create(WorldTransform{matrix}, Light{.kind = LightKind::spot}, ShadowCaster{});
    stage.world.create(WorldTransform{matrix}, Light{.kind = LightKind::directional}, ShadowCaster{});
    stage.world.create(WorldTransform{matrix}, CasterVolume{});
    stage.world.create(WorldTransform{matrix}, MeshInstance{0}, CloseupSubject{.enabled = true, .priority = kNan});
    stage.world.create(WorldTransform{matrix}, IbrProxy{.size_m = vec2(kNan)});
    stage.world.create(WorldTransform{matrix}, CubeProbe{.size_m = vec3(kInfinity), .resolution = 0});
    stage.world.create(WorldTransform{matrix}, IbrRoom{.size_m = vec3(kNan)});
    stage.world.create(WorldTransform{matrix}, Collider{.shape = ColliderShape::capsule, .radius_m = kNan});
    stage.world.create(WorldTransform{matrix}, Wind{.velocity = vec3(kNan), .gust = kInfinity});
    ASSERT_TRUE(stage.render(CarelessHost::request()).ok()) << value;
    ASSERT_TRUE(stage.render(CarelessHost::request()).ok()) << value;
    EXPECT_THAT(stage.device->faults(), IsEmpty()) << value;
  }
}

TEST(ComponentMisuse, emitters_fog_and_lenses_of_no_sense_are_drawn) {
  for (const float value : {kNan, kInfinity, -1.0f, 1e30f}) {
    CarelessHost stage;
    stage.world.create(
        WorldTransform{},
        ParticleEmitter{.kind = EmitterKind::smoke, .rate = value, .lifetime_s = value, .size_m = value});
    stage.world.create(WorldTransform{}, ParticleEmitter{.kind = EmitterKind::dust, .box_m = vec3(value)});
    stage.world.create(Fog{.density = value});
    ViewRequest view = CarelessHost::request();
    view.settings.camera_entity = stage.world.create(WorldTransform{}, Camera{}, DepthOfField{.focus_m = value});
    view.settings.follow_camera = false;
    for (int frame = 0; frame < 3; ++frame) {
      stage.world.resource<SceneClock>().time_s += 1.0;
      ASSERT_TRUE(stage.render(view).ok()) << value;
    }
    EXPECT_THAT(stage.device->faults(), IsEmpty()) << value;
  }
}

TEST(ComponentMisuse, a_clock_of_no_sense_draws) {
  for (const double value : {double{kNan}, double{kInfinity}, -1.0, 1e300}) {
    CarelessHost stage;
    stage.world.create(WorldTransform{}, ParticleEmitter{.kind = EmitterKind::fire});
    for (int frame = 0; frame < 3; ++frame) {
      stage.world.resource<SceneClock>().time_s = value;
      stage.world.resource<SceneClock>().dt_s = value;
      ASSERT_TRUE(stage.render(CarelessHost::request()).ok()) << value;
    }
    EXPECT_THAT(stage.device->faults(), IsEmpty()) << value;
  }
}

TEST(ComponentMisuse, grass_on_nothing_or_of_no_sense) {
  for (const float value : {kNan, kInfinity, -1.0f}) {
    CarelessHost stage;
    stage.world.create(WorldTransform{}, GrassSurface{.density = 5.0f});
    stage.world.create(WorldTransform{}, MeshInstance{0}, GrassSurface{.density = value});
    stage.world.create(WorldTransform{}, MeshInstance{0}, GrassSurface{.density = 1.0f, .height_m = vec2(value)});
    ASSERT_TRUE(stage.render(CarelessHost::request()).ok()) << value;
    EXPECT_THAT(stage.device->faults(), IsEmpty()) << value;
  }
}

}  // namespace
}  // namespace gloam
