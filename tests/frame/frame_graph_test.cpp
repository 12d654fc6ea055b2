// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/frame/frame_graph.h"

#include "tests/frame/graph_fixture.h"
#include "tests/support/expect_assert.h"

namespace gloam::test {
namespace {

using FrameGraphTest = GraphFixture;

TEST_F(FrameGraphTest, writing_gives_a_newer_version_of_the_same_resource) {
  graph.begin();
  const ImageRef empty = graph.create_image(image_desc("masks"));
  const ImageRef first = graph.add_pass("a", "test").write(empty, Access::compute_write);
  const ImageRef second = graph.add_pass("b", "test").write(first, Access::compute_write);
  EXPECT_EQ(first.resource, empty.resource);
  EXPECT_EQ(first.version, empty.version + 1);
  EXPECT_EQ(second.version, empty.version + 2);
}

TEST_F(FrameGraphTest, the_newest_version_is_found_from_any_other) {
  graph.begin();
  const ImageRef empty = graph.create_image(image_desc("masks"));
  EXPECT_EQ(graph.newest(empty).version, empty.version);
  const ImageRef first = graph.add_pass("a", "test").write(empty, Access::compute_write);
  const ImageRef second = graph.add_pass("b", "test").write(first, Access::compute_write);
  for (const ImageRef any : {empty, first, second}) {
    EXPECT_EQ(graph.newest(any).resource, second.resource);
    EXPECT_EQ(graph.newest(any).version, second.version);
  }
  graph.begin();
  EXPECT_ASSERT((void)graph.newest(empty), "another frame");
}

TEST_F(FrameGraphTest, writing_with_a_stale_handle_asserts) {
  graph.begin();
  const ImageRef empty = graph.create_image(image_desc("masks"));
  (void)graph.add_pass("a", "test").write(empty, Access::compute_write);
  PassBuilder late = graph.add_pass("late", "test");
  EXPECT_ASSERT((void)late.write(empty, Access::compute_write), "pass 'late', resource 'masks': this handle is stale");
}

TEST_F(FrameGraphTest, reading_a_replaced_version_asserts) {
  graph.begin();
  const ImageRef first = graph.add_pass("a", "test").write(graph.create_image(image_desc("m")), Access::compute_write);
  (void)graph.add_pass("b", "test").write(first, Access::compute_write);
  PassBuilder late = graph.add_pass("late", "test");
  EXPECT_ASSERT(late.read(first, Access::compute_read), "stale");
}

TEST_F(FrameGraphTest, a_handle_of_another_frame_asserts) {
  graph.begin();
  const BufferRef old = graph.create_buffer(buffer_desc("lights"));
  graph.begin();
  (void)graph.create_buffer(buffer_desc("lights"));
  PassBuilder pass = graph.add_pass("a", "test");
  EXPECT_ASSERT((void)pass.write(old, Access::compute_write), "another frame");
  EXPECT_ASSERT((void)graph.desc(old), "another frame");
  EXPECT_ASSERT(pass.read(ImageRef{}, Access::compute_read), "names no resource");
}

TEST_F(FrameGraphTest, reading_a_transient_that_nobody_wrote_asserts) {
  graph.begin();
  const ImageRef image = graph.create_image(image_desc("masks"));
  PassBuilder pass = graph.add_pass("a", "test");
  EXPECT_ASSERT(pass.read(image, Access::compute_read), "no pass has written");
}

TEST_F(FrameGraphTest, an_access_must_fit_the_call_and_the_kind_of_resource) {
  graph.begin();
  const ImageRef image = graph.create_image(image_desc("masks"));
  const BufferRef buffer = graph.create_buffer(buffer_desc("lights"));
  PassBuilder pass = graph.add_pass("a", "test");
  EXPECT_ASSERT((void)pass.write(image, Access::compute_read), "writes nothing");
  EXPECT_ASSERT(pass.read(image, Access::compute_write), "is no read");
  EXPECT_ASSERT((void)pass.write(buffer, Access::color_target), "no access color_target");
  EXPECT_ASSERT(pass.read(image, Access::indirect_read), "no access indirect_read");
}

TEST_F(FrameGraphTest, accesses_that_need_two_layouts_cannot_be_had_in_one_pass) {
  graph.begin();
  const ImageRef image = graph.add_pass("a", "test").write(graph.create_image(image_desc("m")), Access::compute_write);
  PassBuilder pass = graph.add_pass("b", "test");
  pass.read(image, Access::compute_read);
  EXPECT_ASSERT(pass.read(image, Access::compute_storage_read), "cannot be had in one pass");
  EXPECT_ASSERT((void)pass.write(image, Access::color_target), "cannot be had in one pass");
}

TEST_F(FrameGraphTest, a_pass_that_was_followed_by_another_takes_no_more_declarations) {
  graph.begin();
  const ImageRef image = graph.create_image(image_desc("masks"));
  PassBuilder first = graph.add_pass("first", "test");
  (void)graph.add_pass("second", "test");
  EXPECT_ASSERT((void)first.write(image, Access::compute_write), "before the next pass is added");
}

TEST_F(FrameGraphTest, one_object_is_imported_once_a_frame) {
  const gpu::BufferHandle buffer = make_buffer(buffer_desc("lights"), gpu::BufferUsage::storage);
  graph.begin();
  (void)graph.import_buffer("lights", buffer, Access::none, Access::none);
  EXPECT_ASSERT((void)graph.import_buffer("again", buffer, Access::none, Access::none), "imported once a frame");
}

TEST_F(FrameGraphTest, stages_of_a_frame_come_in_order) {
  auto commands = device->begin_frame();
  EXPECT_ASSERT(graph.execute(**commands), "needs a successful compile");
  graph.begin();
  ASSERT_TRUE(graph.compile().ok());
  EXPECT_ASSERT((void)graph.add_pass("late", "test"), "between FrameGraph::begin and FrameGraph::compile");
  graph.execute(**commands);
  EXPECT_ASSERT(graph.execute(**commands), "once a frame");
  ASSERT_TRUE(device->submit_frame().ok());
}

TEST_F(FrameGraphTest, descriptions_are_those_of_the_transient_or_of_the_import) {
  const gpu::ImageHandle target = make_image(image_desc("target", 17), gpu::ImageUsage::color_target);
  graph.begin();
  EXPECT_EQ(graph.desc(graph.create_image(image_desc("mine", 33))).width, 33u);
  EXPECT_EQ(graph.desc(graph.create_buffer(buffer_desc("mine", 48))).size, 48u);
  EXPECT_EQ(graph.desc(graph.import_image("target", target, Access::none, Access::none)).width, 17u);
}

TEST_F(FrameGraphTest, captures_of_a_pass_end_with_the_next_frame) {
  auto token = std::make_shared<int>(1);
  graph.begin();
  graph.add_pass("a", "test").execute([token](PassContext&) {});
  EXPECT_EQ(token.use_count(), 2);
  graph.begin();
  EXPECT_EQ(token.use_count(), 1);
}

TEST_F(FrameGraphTest, describe_tells_one_line_a_pass) {
  const gpu::ImageHandle target = make_image(image_desc("target"), gpu::ImageUsage::color_target);
  graph.begin();
  PassBuilder write = graph.add_pass("find", "lights");
  const ImageRef masks = write.write(graph.create_image(image_desc("masks")), Access::compute_write);
  PassBuilder shade = graph.add_pass("shade", "lighting");
  shade.read(masks, Access::fragment_read);
  (void)shade.write(graph.import_image("target", target, Access::none, Access::present), Access::color_target);
  PassBuilder unused = graph.add_pass("unused", "lights");
  (void)unused.write(graph.create_buffer(buffer_desc("spare")), Access::compute_write);
  ASSERT_TRUE(graph.compile().ok());
  EXPECT_EQ(graph.describe(),
            "find [lights]; writes masks compute_write; barriers masks none after fragment_read>compute_write\n"
            "shade [lighting]; reads masks fragment_read; writes target color_target; barriers masks "
            "compute_write>fragment_read, target none>color_target\n"
            "unused [lights]; writes spare compute_write; culled\n"
            "end of frame; barriers target color_target>present\n");
}

}  // namespace
}  // namespace gloam::test
