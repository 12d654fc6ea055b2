// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <filesystem>
#include <string>

#include "engine/ecs/view.h"
#include "engine/jobs/executor.h"
#include "engine/scene/assets.h"
#include "engine/scene/components.h"
#include "engine/scene/resources.h"
#include "tests/support/gltf_files.h"

namespace gloam {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

const std::string kCourtyard = GLOAM_SHARED_DIR "/scenes/courtyard/courtyard.gltf";

struct KeyLine {
  KeyElement on;
  const char* name;
  KeyType type;
};

constexpr KeyLine kKeys[] = {
    {KeyElement::light_node, "gloam.light.shadow", KeyType::boolean},
    {KeyElement::light_node, "gloam.light.shadow_resolution", KeyType::integer},
    {KeyElement::light_node, "gloam.light.angle", KeyType::number},
    {KeyElement::light_node, "gloam.light.cookie", KeyType::text},
    {KeyElement::node, "gloam.closeup.priority", KeyType::number},
    {KeyElement::node, "gloam.closeup.lights", KeyType::text},
    {KeyElement::node, "gloam.collider", KeyType::text},
    {KeyElement::node, "gloam.collider.radius", KeyType::number},
    {KeyElement::node, "gloam.collider.height", KeyType::number},
    {KeyElement::node, "gloam.collider.size", KeyType::vec3},
    {KeyElement::mesh_node, "gloam.grass.seed", KeyType::integer},
    {KeyElement::mesh_node, "gloam.grass.height", KeyType::vec2},
    {KeyElement::mesh_node, "gloam.grass.width", KeyType::number},
    {KeyElement::mesh_node, "gloam.grass.max_distance", KeyType::number},
    {KeyElement::node, "gloam.fog.density", KeyType::number},
    {KeyElement::node, "gloam.fog.color", KeyType::vec3},
    {KeyElement::node, "gloam.ibr_proxy.size", KeyType::vec2},
    {KeyElement::node, "gloam.ibr_proxy.kind", KeyType::text},
    {KeyElement::node, "gloam.ibr_proxy.texture", KeyType::text},
    {KeyElement::node, "gloam.ibr_proxy.lights", KeyType::text},
    {KeyElement::node, "gloam.ibr_room.size", KeyType::vec3},
    {KeyElement::node, "gloam.cube_probe.size", KeyType::vec3},
    {KeyElement::node, "gloam.cube_probe.resolution", KeyType::integer},
    {KeyElement::node, "gloam.cube_probe.global", KeyType::boolean},
    {KeyElement::node, "gloam.wind.velocity", KeyType::vec3},
    {KeyElement::node, "gloam.wind.gust", KeyType::number},
    {KeyElement::node, "gloam.particles", KeyType::text},
    {KeyElement::node, "gloam.particles.rate", KeyType::number},
    {KeyElement::node, "gloam.particles.lifetime", KeyType::number},
    {KeyElement::node, "gloam.particles.size", KeyType::number},
    {KeyElement::node, "gloam.particles.speed", KeyType::number},
    {KeyElement::node, "gloam.particles.spread", KeyType::number},
    {KeyElement::node, "gloam.particles.box", KeyType::vec3},
    {KeyElement::camera_node, "gloam.dof.f_number", KeyType::number},
    {KeyElement::camera_node, "gloam.dof.bokeh", KeyType::text},
};

KeyRegistry courtyard_registry() {
  KeyRegistry registry = test::light_registry();
  for (const KeyLine& line : kKeys) {
    SceneKey key;
    key.on = line.on;
    key.name = line.name;
    key.type = line.type;
    registry.add(std::move(key));
  }
  return registry;
}

class Courtyard : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kCourtyard)) GTEST_SKIP() << kCourtyard << " is absent";
  }

  test::Import import_;
};

TEST_F(Courtyard, loads_with_every_part_its_file_states) {
  test::import_file(kCourtyard, import_, {}, courtyard_registry());
  ASSERT_EQ(import_.fault(), "");
  EXPECT_EQ(import_.info().node_entities.size(), 137u);
  EXPECT_THAT(import_.info().warnings, IsEmpty());
  EXPECT_THAT(import_.world.resource<SceneNames>().names("camera"),
              ElementsAre("court", "closeup", "lawn", "walkway", "down", "grazing"));
  EXPECT_EQ(import_.info().cameras.size(), 6u);
  EXPECT_EQ(import_.info().replaced_normals, 1062u);
  EXPECT_EQ(import_.info().triangles, 50433u);
  const auto& assets = import_.world.resource<SceneAssets>();
  EXPECT_EQ(assets.meshes.size(), 33u);
  EXPECT_EQ(assets.materials.size(), 20u);
  EXPECT_EQ(assets.images.size(), 20u);
  EXPECT_EQ(assets.skins.size(), 3u);
  EXPECT_EQ(assets.clips.size(), 4u);
  EXPECT_FLOAT_EQ(import_.world.resource<SceneEnvironment>().sky_zenith.z, 0.07f);
}

}  // namespace
}  // namespace gloam
