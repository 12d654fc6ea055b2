// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/scene_path.h"

#include <gmock/gmock.h>

#include "tests/support/gltf_files.h"

namespace gloam {
namespace {

using ::testing::HasSubstr;

TEST(ScenePath, stays_below_the_scenes_folder) {
  EXPECT_EQ(*resolve_scene_path("dir", "textures/wall.png"), "dir/textures/wall.png");
  EXPECT_EQ(*resolve_scene_path("", "a.bin"), "a.bin");
  EXPECT_EQ(*resolve_scene_path("dir", "a%20b+c.bin"), "dir/a b+c.bin");
  EXPECT_EQ(*resolve_scene_path("dir", "a/../b.bin"), "dir/b.bin");
  EXPECT_EQ(*resolve_scene_path("dir", "./././b.bin"), "dir/b.bin");
  EXPECT_EQ(*resolve_scene_path("dir", "100%.bin"), "dir/100%.bin");
}

TEST(ScenePath, may_hold_colons_that_mark_no_scheme) {
  EXPECT_EQ(*resolve_scene_path("dir", "wall%3A1.png"), "dir/wall:1.png");
  EXPECT_EQ(*resolve_scene_path("dir", "file%3a//x.png"), "dir/file:/x.png");
  EXPECT_EQ(*resolve_scene_path("dir", "a/b:c.png"), "dir/a/b:c.png");
  EXPECT_EQ(*resolve_scene_path("dir", "a%2Fb:c.png"), "dir/a/b:c.png");
  EXPECT_EQ(*resolve_scene_path("dir", "./b:c.png"), "dir/b:c.png");
  EXPECT_EQ(*resolve_scene_path("dir", "12:30.png"), "dir/12:30.png");
}

// Hard case: scene.path_leaves
TEST(ScenePath, refuses_whatever_leaves_the_folder) {
  for (const char* uri : {"../a.bin", "a/../../b.bin", "/etc/passwd", "%2e%2e/a.bin", "%2E%2e%2fa.bin", "..\\a.bin",
                          "\\\\host\\a", "C:/a.bin", "c:a.bin", "data:x", "file:///etc/passwd",
                          "https://example.org/a.bin", "a/..%2f../b", "..", "%2Fetc/passwd"}) {
    const Result<std::string> path = resolve_scene_path("dir", uri);
    ASSERT_FALSE(path.ok()) << uri;
    EXPECT_EQ(path.error().kind, ErrorKind::input);
    EXPECT_THAT(path.error().message, HasSubstr("leaves the scene's folder")) << uri;
  }
}

TEST(ScenePath, refuses_empty_paths_and_zero_bytes) {
  EXPECT_FALSE(resolve_scene_path("dir", "").ok());
  EXPECT_THAT(resolve_scene_path("dir", "a%00.bin").error().message, HasSubstr("zero byte"));
}

TEST(SceneFile, is_read_whole_or_to_the_wanted_size) {
  const test::TemporaryFolder folder;
  const std::string path = folder.write("a.bin", std::string_view("twelve bytes"));
  EXPECT_EQ(read_scene_file(path)->size(), 12u);
  EXPECT_EQ(read_scene_file(path, 5)->size(), 5u);
  EXPECT_THAT(read_scene_file(path, 13).error().message, HasSubstr("has 12 bytes, needs 13"));
}

TEST(SceneFile, must_be_a_file_that_is_there) {
  const test::TemporaryFolder folder;
  EXPECT_THAT(read_scene_file(folder.path() + "/b.bin").error().message, HasSubstr("is absent"));
  EXPECT_THAT(read_scene_file(folder.path()).error().message, HasSubstr("is not a file"));
  EXPECT_THAT(read_scene_file("/dev/zero").error().message, HasSubstr("is not a file"));
}

}  // namespace
}  // namespace gloam
