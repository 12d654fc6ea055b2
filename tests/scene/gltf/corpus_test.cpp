// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

#include "engine/scene/assets/check.h"
#include "tests/support/gltf_files.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;

/// Debian's assimp-testmodels: sound, odd and broken files of many origins.
const fs::path kModels = "/usr/share/assimp/models";

std::vector<std::string> model_files() {
  std::vector<std::string> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(kModels)) {
    const fs::path extension = entry.path().extension();
    if (extension == ".gltf" || extension == ".glb") files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

// Hard case: scene.corpus
TEST(Corpus, every_model_loads_or_is_refused_in_one_sentence) {
  if (!fs::exists(kModels)) GTEST_SKIP() << kModels << " is absent (package assimp-testmodels)";
  const std::vector<std::string> files = model_files();
  int loaded = 0;
  for (const std::string& file : files) {
    test::Import import;
    test::import_file(file, import);
    if (import.ok()) {
      ++loaded;
      EXPECT_EQ(asset_fault(import.world.resource<SceneAssets>()), "") << file;
      continue;
    }
    std::cout << "refused: " << import.fault() << '\n';
    EXPECT_EQ(import.result.error().kind, ErrorKind::input) << file;
    EXPECT_THAT(import.fault(), ::testing::StartsWith(fs::path(file).filename().string())) << file;
    EXPECT_EQ(import.fault().find('\n'), std::string::npos) << import.fault();
  }
  std::cout << files.size() << " files: " << loaded << " loaded, " << files.size() - static_cast<std::size_t>(loaded)
            << " refused\n";
  RecordProperty("files", static_cast<int>(files.size()));
  RecordProperty("loaded", loaded);
  EXPECT_GT(loaded, 0);
}

// Hard case: scene.truncated
TEST(Corpus, models_cut_at_every_kilobyte_load_or_are_refused) {
  if (!fs::exists(kModels)) GTEST_SKIP() << kModels << " is absent (package assimp-testmodels)";
  const test::TemporaryFolder folder;
  for (const char* name : {"BoxTextured-glTF-Embedded/BoxTextured.gltf", "BoxTextured-glTF-Binary/BoxTextured.glb"}) {
    std::ifstream file(kModels / "glTF2" / name, std::ios::binary);
    const std::string content{std::istreambuf_iterator<char>(file), {}};
    ASSERT_GT(content.size(), 1024u) << name;
    for (std::size_t size = 0; size < content.size(); size += 1024) {
      test::Import import;
      test::import_file(folder.write("cut.gltf", std::string_view(content).substr(0, size)), import);
      EXPECT_FALSE(import.ok()) << name << " cut at " << size;
      EXPECT_THAT(import.fault(), ::testing::StartsWith("cut.gltf")) << size;
    }
  }
}

TEST(Corpus, sound_models_load) {
  if (!fs::exists(kModels)) GTEST_SKIP() << kModels << " is absent (package assimp-testmodels)";
  for (const char* name :
       {"BoxTextured-glTF/BoxTextured.gltf", "BoxTextured-glTF-Embedded/BoxTextured.gltf",
        "BoxTextured-glTF-Binary/BoxTextured.glb", "cameras/Cameras.gltf", "simple_skin/simple_skin.gltf",
        "glTF-Sample-Models/AnimatedMorphCube-glTF/AnimatedMorphCube.gltf"}) {
    test::Import import;
    test::import_file((kModels / "glTF2" / name).string(), import);
    EXPECT_EQ(import.fault(), "") << name;
  }
}

}  // namespace
}  // namespace gloam
