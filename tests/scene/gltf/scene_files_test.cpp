// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <random>

#include "engine/scene/assets.h"
#include "tests/support/gltf_files.h"
#include "tests/support/scale.h"

namespace gloam {
namespace {

using test::GltfText;
using test::Import;
using test::TemporaryFolder;
using ::testing::HasSubstr;

constexpr std::uint8_t kRed[4] = {255, 0, 0, 255};

/// A file that uses most features that can be broken.
GltfText rich_scene() {
  GltfText gltf;
  const std::string positions = std::to_string(gltf.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3"));
  const std::string uv = std::to_string(gltf.floats({0, 1, 1, 1, 0, 0}, "VEC2"));
  const std::string joints = std::to_string(gltf.accessor(std::vector<std::uint8_t>(12, 0), 5121, "VEC4"));
  const std::string weights = std::to_string(gltf.floats(std::vector<float>(12, 0.25f), "VEC4"));
  const std::string indices = std::to_string(gltf.accessor(std::vector<std::uint16_t>{0, 1, 2}, 5123, "SCALAR"));
  const std::string times = std::to_string(gltf.floats({0, 1}, "SCALAR"));
  const std::string moves = std::to_string(gltf.floats({0, 0, 0, 1, 1, 1}, "VEC3"));
  const std::string bind = std::to_string(gltf.floats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, "MAT4"));
  gltf.mesh("\"POSITION\": " + positions + ", \"TEXCOORD_0\": " + uv + ", \"JOINTS_0\": " + joints +
                ", \"WEIGHTS_0\": " + weights,
            ", \"material\": 0, \"indices\": " + indices + ", \"targets\": [{\"POSITION\": " + positions + "}]");
  const auto png = test::make_png(2, 2, kRed);
  gltf.add("images", R"({"mimeType": "image/png", "bufferView": )" + std::to_string(gltf.view_of(png)) + "}");
  gltf.add("samplers", R"({"wrapS": 33071})");
  gltf.add("textures", R"({"source": 0, "sampler": 0})");
  gltf.add("materials", R"({"normalTexture": {"index": 0}, "extras": {"gloam.subsurface": true}})");
  gltf.add("cameras", R"({"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1, "zfar": 10}})");
  gltf.add("nodes", R"({"name": "root", "mesh": 0, "skin": 0, "children": [1, 2], "weights": [0.5]})");
  gltf.add("nodes", R"({"name": "camera", "camera": 0, "rotation": [0, 0, 0, 1], "scale": [1, 2, 3]})");
  gltf.add("nodes", R"({"matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 5,6,7,1], "extras": {"gloam.closeup": 1},
                        "extensions": {"KHR_lights_punctual": {"light": 0}}})");
  gltf.add("skins", R"({"joints": [1], "inverseBindMatrices": )" + bind + "}");
  gltf.add("animations", R"({"samplers": [{"input": )" + times + R"(, "output": )" + moves +
                             R"(}], "channels": [{"sampler": 0, "target": {"node": 1, "path": "translation"}}]})");
  gltf.add("scenes", R"({"nodes": [0], "extras": {"gloam.exposure": 1}})");
  return gltf;
}

TEST(SceneFiles, the_scene_that_is_broken_below_is_sound) {
  Import import;
  test::import_text(rich_scene().text(), import);
  EXPECT_EQ(import.fault(), "");
}

TEST(SceneFiles, buffers_may_be_embedded_external_or_in_a_binary_chunk) {
  const TemporaryFolder folder;
  GltfText gltf;
  gltf.triangle();
  gltf.add("nodes", R"({"mesh": 0})");
  folder.write("data/a b+c.bin", gltf.buffer());
  const std::string paths[] = {folder.write("embedded.gltf", gltf.text()),
                               folder.write("external.gltf", gltf.text("data/a%20b+c.bin")),
                               folder.write("binary.glb", gltf.glb()), folder.write("named_wrongly.gltf", gltf.glb())};
  for (const std::string& path : paths) {
    Import import;
    test::import_file(path, import);
    EXPECT_EQ(import.fault(), "") << path;
    EXPECT_EQ(import.world.resource<SceneAssets>().meshes[0].primitives[0].positions[1], vec3(1, 0, 0)) << path;
  }
}

TEST(SceneFiles, a_buffers_file_may_be_longer_than_the_buffer) {
  const TemporaryFolder folder;
  GltfText gltf;
  gltf.triangle();
  std::vector<std::uint8_t> longer = gltf.buffer();
  longer.resize(longer.size() + 1000);
  folder.write("a.bin", longer);
  Import import;
  test::import_file(folder.write("a.gltf", gltf.text("a.bin")), import);
  EXPECT_EQ(import.fault(), "");
}

// Hard case: scene.path_leaves
TEST(SceneFiles, files_outside_the_scenes_folder_are_never_opened) {
  const TemporaryFolder folder;
  GltfText gltf;
  gltf.triangle();
  folder.write("secret.bin", gltf.buffer());
  for (const std::string uri : {"../secret.bin", "%2e%2e/secret.bin", "x/../../secret.bin", "..\\\\secret.bin"}) {
    Import import;
    test::import_file(folder.write("inner/a.gltf", gltf.text(uri)), import);
    EXPECT_THAT(import.fault(), HasSubstr("a.gltf: buffer 0: the path")) << uri;
    EXPECT_THAT(import.fault(), HasSubstr("leaves the scene's folder")) << uri;
  }
  Import absolute;
  test::import_file(folder.write("inner/a.gltf", gltf.text(folder.path() + "/secret.bin")), absolute);
  EXPECT_THAT(absolute.fault(), HasSubstr("leaves the scene's folder"));
}

// Hard case: scene.absent_file
TEST(SceneFiles, an_absent_scene_is_an_input_error_in_one_sentence) {
  Import import;
  test::import_file("/nowhere/at/all.gltf", import);
  ASSERT_FALSE(import.ok());
  EXPECT_EQ(import.result.error().kind, ErrorKind::input);
  EXPECT_THAT(import.fault(), HasSubstr("all.gltf: the file \"/nowhere/at/all.gltf\" is absent"));
}

// Hard case: scene.truncated
TEST(SceneFiles, a_binary_file_cut_anywhere_is_refused) {
  const TemporaryFolder folder;
  GltfText gltf;
  gltf.triangle();
  const std::vector<std::uint8_t> whole = gltf.glb();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    Import import;
    test::import_file(folder.write("cut.glb", std::span(whole).first(size)), import);
    ASSERT_FALSE(import.ok()) << size;
    EXPECT_EQ(import.result.error().kind, ErrorKind::input);
    EXPECT_EQ(import.fault().find('\n'), std::string::npos);
  }
}

TEST(SceneFiles, chunk_lengths_that_lie_are_refused) {
  const TemporaryFolder folder;
  GltfText gltf;
  gltf.triangle();
  const std::vector<std::uint8_t> whole = gltf.glb();
  const std::size_t bin_header = 20 + (whole[12] | whole[13] << 8);
  for (const std::size_t at : {std::size_t{8}, std::size_t{12}, bin_header}) {
    for (const int value : {0x00, 0x03, 0x7f, 0xff}) {
      for (std::size_t byte = 0; byte < 4; ++byte) {
        std::vector<std::uint8_t> broken = whole;
        if (broken[at + byte] == value) continue;
        broken[at + byte] = static_cast<std::uint8_t>(value);
        Import import;
        test::import_file(folder.write("broken.glb", broken), import);
        EXPECT_FALSE(import.ok()) << at << "+" << byte << " = " << value;
      }
    }
  }
}

/// A file with a few changed bytes loads or is refused with one line. Sanitizer builds also check its memory accesses.
TEST(SceneFiles, changed_bytes_never_do_worse_than_an_error) {
  const TemporaryFolder folder;
  const std::string text = rich_scene().text();
  const std::vector<std::uint8_t> glb = rich_scene().glb();
  std::mt19937 random(11);
  constexpr std::string_view kBytes = "0123456789-.,:{}[]\"eE+tfn\\ \x01\xff";
  int refused = 0;
  const int rounds = test::scaled(1500);
  for (int i = 0; i < rounds; ++i) {
    const bool binary = i % 3 == 0;
    std::vector<std::uint8_t> bytes = binary ? glb : std::vector<std::uint8_t>(text.begin(), text.end());
    for (unsigned change = 0; change < 1 + random() % 3; ++change) {
      std::uint8_t& byte = bytes[random() % bytes.size()];
      byte = random() % 4 == 0 ? static_cast<std::uint8_t>(random())
                               : static_cast<std::uint8_t>(kBytes[random() % kBytes.size()]);
    }
    if (random() % 16 == 0) bytes.resize(random() % bytes.size());
    Import import;
    test::import_file(folder.write("changed", bytes), import);
    if (import.ok()) continue;
    ++refused;
    EXPECT_EQ(import.result.error().kind, ErrorKind::input) << import.fault();
    EXPECT_EQ(import.fault().find('\n'), std::string::npos) << import.fault();
    EXPECT_LT(import.fault().size(), 500u) << import.fault();
  }
  EXPECT_GT(refused, rounds / 5);
}

}  // namespace
}  // namespace gloam
