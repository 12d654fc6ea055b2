// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/shader_files.h"

#include <gmock/gmock.h>

#include <chrono>

#include "sandbox/output/file_io.h"
#include "sandbox/play/shader_reload.h"
#include "tests/support/temporary_folder.h"

namespace gloam {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

class ShaderFilesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    write("shaders/common/numbers.glsl", "const float kOne = 1.0;\n");
    write("shaders/common/more.glsl", "#include \"shaders/common/numbers.glsl\"\n");
    write("shaders/a/far.frag.glsl", header() + "#include \"shaders/common/more.glsl\"\n" + body("kOne"));
    write("shaders/a/plain.frag.glsl", header() + body("0.5"));
  }
  static std::string header() {
    return "#version 460\n#extension GL_GOOGLE_include_directive : require\nlayout(location = 0) out vec4 color;\n";
  }
  static std::string body(const std::string& value) { return "void main() { color = vec4(" + value + "); }\n"; }
  void write(const std::string& path, const std::string& text) {
    ASSERT_TRUE(make_folder_of((std::filesystem::path(folder.path()) / path).string()).ok());
    ASSERT_TRUE(write_file((std::filesystem::path(folder.path()) / path).string(), text).ok());
  }
  /// Changes a file's time, as a later edit does.
  void touch(const std::string& path) {
    const auto file = std::filesystem::path(folder.path()) / path;
    std::filesystem::last_write_time(file, std::filesystem::last_write_time(file) + std::chrono::seconds(3));
  }

  test::TestFolder folder;
  const std::vector<std::string> shaders = {"shaders/a/far.frag.glsl", "shaders/a/plain.frag.glsl"};
};

TEST_F(ShaderFilesTest, tells_what_changed_once) {
  ShaderFiles files(folder.path());
  EXPECT_THAT(files.changed(), IsEmpty());
  touch("shaders/a/plain.frag.glsl");
  write("shaders/new.glsl", "");
  EXPECT_THAT(files.changed(), UnorderedElementsAre("shaders/a/plain.frag.glsl", "shaders/new.glsl"));
  EXPECT_THAT(files.changed(), IsEmpty());
  std::filesystem::remove_all(folder.path() + "/shaders");
  EXPECT_THAT(files.changed(), IsEmpty());
}

TEST_F(ShaderFilesTest, finds_shaders_through_the_files_that_they_include) {
  const ShaderFiles files(folder.path());
  EXPECT_THAT(files.that_include(shaders, {"shaders/common/numbers.glsl"}), ElementsAre("shaders/a/far.frag.glsl"));
  EXPECT_THAT(files.that_include(shaders, {"shaders/a/plain.frag.glsl"}), ElementsAre("shaders/a/plain.frag.glsl"));
  EXPECT_THAT(files.that_include(shaders, {"shaders/unused.glsl"}), IsEmpty());
}

TEST_F(ShaderFilesTest, survives_files_that_include_each_other) {
  write("shaders/common/numbers.glsl", "#include \"shaders/common/more.glsl\"\n");
  const ShaderFiles files(folder.path());
  EXPECT_THAT(files.that_include(shaders, {"shaders/unused.glsl"}), IsEmpty());
}

TEST_F(ShaderFilesTest, compiles_a_shader_or_gives_the_compilers_message) {
  const auto words = compile_shader(folder.path(), "shaders/a/far.frag.glsl");
  ASSERT_TRUE(words.ok()) << words.error().message;
  EXPECT_EQ(words->front(), 0x07230203u) << "SPIR-V";
  write("shaders/a/far.frag.glsl", header() + body("nothing_of_this_name"));
  const auto broken = compile_shader(folder.path(), "shaders/a/far.frag.glsl");
  ASSERT_FALSE(broken.ok());
  EXPECT_THAT(broken.error().message, HasSubstr("nothing_of_this_name"));
  EXPECT_THAT(broken.error().message, HasSubstr("far.frag.glsl:4"));
}

}  // namespace
}  // namespace gloam
