// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/gltf/entities/scene_totals.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "engine/scene/resources.h"
#include "engine/scene/systems.h"
#include "tests/support/gltf_files.h"

namespace gloam {
namespace {

using test::GltfText;
using test::Import;
using ::testing::HasSubstr;

std::string repeated(const std::string& item, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += (i > 0 ? "," : "") + item;
  return text;
}

/// Adds a mesh of one skinned triangle.
int add_skinned_triangle(GltfText& gltf) {
  const int positions = gltf.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  const int joints = gltf.accessor(std::vector<std::uint8_t>(12, 0), 5121, "VEC4");
  const int weights = gltf.floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
  return gltf.mesh("\"POSITION\": " + std::to_string(positions) + ", \"JOINTS_0\": " + std::to_string(joints) +
                   ", \"WEIGHTS_0\": " + std::to_string(weights));
}

/// A file whose nodes all draw one skinned triangle with one skin of many joints.
std::string file_of_skins(std::size_t nodes, std::size_t joints) {
  GltfText gltf;
  add_skinned_triangle(gltf);
  gltf.add("skins", R"({"joints": [)" + repeated("0", joints) + "]}");
  for (std::size_t i = 0; i < nodes; ++i) gltf.add("nodes", R"({"mesh": 0, "skin": 0})");
  return gltf.text();
}

/// A file whose nodes all draw one mesh of `vertices` vertices that has one morph target without data.
std::string file_of_morphs(std::size_t nodes, std::size_t vertices) {
  GltfText gltf;
  std::vector<float> positions(3 * vertices);
  for (std::size_t i = 0; i < positions.size(); ++i) positions[i] = static_cast<float>(i * i % 7);
  const int accessor = gltf.floats(positions, "VEC3");
  gltf.mesh("\"POSITION\": " + std::to_string(accessor), R"(, "targets": [{}])");
  for (std::size_t i = 0; i < nodes; ++i) gltf.add("nodes", R"({"mesh": 0})");
  return gltf.text();
}

void expect_refused(const std::string& text, const std::string& fault) {
  Import import;
  test::import_text(text, import);
  ASSERT_FALSE(import.ok());
  EXPECT_EQ(import.result.error().kind, ErrorKind::input);
  EXPECT_THAT(import.fault(), HasSubstr(fault));
}

TEST(SceneTotals, joints_of_many_skinned_nodes_that_wrap_32_bits_are_refused) {
  // 2^16 nodes of 2^16 joints sum up to 2^32; node 16 is the first one past the limit.
  expect_refused(file_of_skins(65536, 65536),
                 "scene.gltf: node 16: the scene has 1114112 joints of skinned nodes up to here, at most 1048576");
}

TEST(SceneTotals, joints_up_to_the_limit_are_posed) {
  Import import;
  test::import_text(file_of_skins(1024, 1024), import);
  EXPECT_EQ(import.fault(), "");
}

TEST(SceneTotals, deformed_vertices_that_wrap_32_bits_to_zero_are_refused) {
  // 65536 nodes of 65536 vertices: the sum is 2^32, of which 32 bits are 0.
  expect_refused(file_of_morphs(65536, 65538), "skinned and morphed vertices up to here, at most 16777216 are read");
}

TEST(SceneTotals, a_rigid_mesh_may_have_more_instances_than_a_deformed_one) {
  GltfText gltf;
  std::vector<float> positions(3 * 3072, 1.0f);
  gltf.mesh("\"POSITION\": " + std::to_string(gltf.floats(positions, "VEC3")));
  for (int i = 0; i < 8192; ++i) gltf.add("nodes", R"({"mesh": 0})");
  Import import;
  test::import_text(gltf.text(), import);
  EXPECT_EQ(import.fault(), "");
  EXPECT_EQ(import.info().triangles, 8192u * 1024u);
}

TEST(SceneTotals, drawn_primitives_and_triangles_have_limits) {
  GltfText gltf;
  const std::string attributes =
      R"({"attributes": {"POSITION": )" + std::to_string(gltf.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3")) + "}}";
  gltf.add("meshes", R"({"primitives": [)" + repeated(attributes, 1000) + "]}");
  for (int i = 0; i < 3000; ++i) gltf.add("nodes", R"({"mesh": 0})");
  expect_refused(gltf.text(), "node 2097: the scene has 2098000 drawn primitives up to here, at most 2097152 are read");

  GltfText large;
  const std::vector<float> positions(3 * 300000, 1.0f);
  large.mesh("\"POSITION\": " + std::to_string(large.floats(positions, "VEC3")));
  for (int i = 0; i < 20000; ++i) large.add("nodes", R"({"mesh": 0})");
  expect_refused(large.text(), "node 10737: the scene has 1073800000 drawn triangles up to here");
}

TEST(SceneTotals, nodes_outside_the_scene_do_not_count) {
  std::string text = file_of_skins(65, 65536);
  text.insert(1, R"("scenes": [{"nodes": [0]}],)");
  Import import;
  test::import_text(text, import);
  EXPECT_EQ(import.fault(), "");
}

TEST(SceneTotals, components_of_morph_targets_of_a_primitive_have_a_limit) {
  GltfText gltf;
  const std::vector<float> positions(3 * 60000, 1.0f);
  const int accessor = gltf.floats(positions, "VEC3");
  gltf.mesh("\"POSITION\": " + std::to_string(accessor), R"(, "targets": [)" + repeated("{}", 100) + "]");
  expect_refused(gltf.text(),
                 "mesh 0: a primitive has 36000000 components of morph targets, at most 33554432 are read");
}

}  // namespace
}  // namespace gloam
