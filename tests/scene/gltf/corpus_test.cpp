// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>

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

TEST(Corpus, every_model_loads_or_is_refused_in_one_sentence) {
  if (!fs::exists(kModels)) GTEST_SKIP() << kModels << " is absent (package assimp-testmodels)";
  int loaded = 0;
  for (const std::string& file : model_files()) {
    test::Import import;
    test::import_file(file, import);
    if (import.ok()) {
      ++loaded;
      continue;
    }
    EXPECT_EQ(import.result.error().kind, ErrorKind::input) << file;
    EXPECT_THAT(import.fault(), ::testing::StartsWith(fs::path(file).filename().string())) << file;
    EXPECT_EQ(import.fault().find('\n'), std::string::npos) << import.fault();
  }
  EXPECT_GT(loaded, 0);
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
