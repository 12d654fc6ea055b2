// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include "engine/frame/pass_timer.h"
#include "tests/frame/graph_fixture.h"
#include "tests/support/expect_assert.h"

namespace gloam::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class ExecuteTest : public GraphFixture {
 public:
  gpu::BufferHandle out =
      make_buffer(buffer_desc("out"), gpu::BufferUsage::transfer_target | gpu::BufferUsage::storage);
};

TEST_F(ExecuteTest, live_passes_run_in_order_of_declaration_and_culled_ones_do_not) {
  std::vector<std::string> ran;
  run_frame([&](FrameGraph& g) {
    const auto note = [&](const char* name) { return [&ran, name](PassContext&) { ran.push_back(name); }; };
    PassBuilder a = g.add_pass("a", "test");
    const BufferRef scratch = a.write(g.create_buffer(buffer_desc("scratch")), Access::compute_write);
    a.execute(note("a"));
    PassBuilder b = g.add_pass("b", "test");
    (void)b.write(g.create_buffer(buffer_desc("unused")), Access::compute_write);
    b.execute(note("b"));
    PassBuilder c = g.add_pass("c", "test");
    c.read(scratch, Access::compute_read);
    (void)c.write(g.import_buffer("out", out, Access::none, Access::none), Access::compute_write);
    c.execute(note("c"));
  });
  EXPECT_THAT(ran, ElementsAre("a", "c"));
  EXPECT_THAT(texts("begin_label"), ElementsAre("begin_label a", "begin_label c"));
}

TEST_F(ExecuteTest, a_pass_has_one_barrier_call_for_all_its_resources) {
  run_frame([&](FrameGraph& g) {
    PassBuilder a = g.add_pass("a", "test");
    const BufferRef buffer = a.write(g.create_buffer(buffer_desc("buffer")), Access::compute_write);
    const ImageRef image = a.write(g.create_image(image_desc("image")), Access::compute_write);
    PassBuilder b = g.add_pass("b", "test");
    b.read(buffer, Access::compute_read);
    b.read(image, Access::compute_read);
    b.keep();
  });
  EXPECT_THAT(texts("barrier"),
              ElementsAre("barrier 'buffer' none|compute_read>compute_write, 'image' none|compute_read>compute_write",
                          "barrier 'buffer' compute_write>compute_read, 'image' compute_write>compute_read"));
}

TEST_F(ExecuteTest, passes_get_the_objects_they_declared) {
  gpu::BufferHandle given;
  std::uint64_t transient_size = 0;
  run_frame([&](FrameGraph& g) {
    PassBuilder pass = g.add_pass("a", "test");
    const BufferRef before = g.import_buffer("out", out, Access::none, Access::none);
    const BufferRef after = pass.write(before, Access::transfer_write);
    const BufferRef scratch = pass.write(g.create_buffer(buffer_desc("scratch", 512)), Access::transfer_write);
    pass.execute([&, before, after, scratch](PassContext& context) {
      given = context.buffer(after);
      EXPECT_EQ(context.buffer(before), given);
      transient_size = device->desc(context.buffer(scratch)).size;
      context.commands().fill_buffer(context.buffer(scratch), 0, 512, 7);
    });
  });
  EXPECT_EQ(given, out);
  EXPECT_EQ(transient_size, 512u);
}

TEST_F(ExecuteTest, using_what_was_not_declared_asserts) {
  run_frame([&](FrameGraph& g) {
    const BufferRef secret =
        g.add_pass("a", "test").write(g.create_buffer(buffer_desc("secret")), Access::compute_write);
    PassBuilder b = g.add_pass("b", "test");
    b.keep();
    b.execute([secret](PassContext& context) {
      EXPECT_ASSERT((void)context.buffer(secret), "pass 'b' uses resource 'secret' that it did not declare");
    });
  });
}

TEST_F(ExecuteTest, times_and_counts_of_the_newest_completed_frame) {
  EXPECT_THAT(graph.pass_times(), IsEmpty());
  EXPECT_EQ(graph.gpu_ms(), 0.0);
  const auto compute = device->create_pipeline(gpu::ComputePipelineDesc{.name = "kernel", .module = "test"}).value();
  const auto paint = device->create_pipeline(gpu::GraphicsPipelineDesc{.name = "paint", .module = "test"}).value();
  run_frame([&](FrameGraph& g) {
    PassBuilder a = g.add_pass("a", "lights");
    a.keep();
    a.execute([&](PassContext& context) {
      context.commands().bind_pipeline(compute);
      context.commands().dispatch(1, 2, 3);
      context.commands().dispatch(1, 1, 1);
    });
    PassBuilder b = g.add_pass("b", "shadows");
    b.keep();
    b.execute([&](PassContext& context) {
      context.commands().begin_rendering({.width = 8, .height = 8});
      context.commands().bind_pipeline(paint);
      context.commands().draw(3, 1, 0, 0);
      context.commands().end_rendering();
    });
  });
  const std::vector<PassTime> times = graph.pass_times();
  ASSERT_EQ(times.size(), 2u);
  EXPECT_EQ(times[0].name, "a");
  EXPECT_EQ(times[0].module, "lights");
  EXPECT_EQ(times[0].dispatches, 2u);
  EXPECT_EQ(times[0].draws, 0u);
  EXPECT_EQ(times[1].dispatches, 0u);
  EXPECT_EQ(times[1].draws, 1u);
  // The recording device's clock advances by 1 µs per timestamp; two adjacent passes need three timestamps.
  EXPECT_DOUBLE_EQ(times[0].ms, 0.001);
  EXPECT_DOUBLE_EQ(times[1].ms, 0.001);
  EXPECT_DOUBLE_EQ(graph.gpu_ms(), 0.002);
}

TEST_F(ExecuteTest, passes_beyond_the_last_timestamp_run_untimed) {
  const std::uint32_t count = frame::PassTimer::kPassesTimed + 10;
  run_frame([&](FrameGraph& g) {
    for (std::uint32_t i = 0; i < count; ++i) g.add_pass("p", "test").keep();
  });
  const std::vector<PassTime> times = graph.pass_times();
  ASSERT_EQ(times.size(), count);
  EXPECT_GT(times[frame::PassTimer::kPassesTimed - 1].ms, 0.0);
  EXPECT_EQ(times[frame::PassTimer::kPassesTimed].ms, 0.0);
}

TEST_F(ExecuteTest, an_import_is_tracked_from_frame_to_frame) {
  const gpu::ImageHandle image =
      make_image(image_desc("kept"), gpu::ImageUsage::transfer_target | gpu::ImageUsage::transfer_source);
  for (int frame = 0; frame < 3; ++frame) {
    run_frame([&](FrameGraph& g) {
      const Access before = frame == 0 ? Access::none : Access::transfer_read;
      PassBuilder pass = g.add_pass("clear", "test");
      const ImageRef after =
          pass.write(g.import_image("kept", image, before, Access::transfer_read), Access::transfer_write);
      pass.execute([after](PassContext& context) { context.commands().clear_color_image(context.image(after), {}); });
    });
  }
  EXPECT_THAT(texts("barrier").back(), HasSubstr("'kept' transfer_write>transfer_read"));
}

}  // namespace
}  // namespace gloam::test
