// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <stdexcept>

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
  constexpr std::uint32_t kTimed = gpu::Device::kTimestampsPerFrame - 1;
  const std::uint32_t count = kTimed + 10;
  run_frame([&](FrameGraph& g) {
    for (std::uint32_t i = 0; i < count; ++i) g.add_pass("p", "test").keep();
  });
  const std::vector<PassTime> times = graph.pass_times();
  ASSERT_EQ(times.size(), count);
  EXPECT_GT(times[kTimed - 1].ms, 0.0);
  EXPECT_EQ(times[kTimed].ms, 0.0);
}

TEST_F(ExecuteTest, passes_with_barriers_beyond_the_last_timestamp_run_untimed) {
  constexpr std::uint32_t kTimed = gpu::Device::kTimestampsPerFrame / 2;
  run_frame([&](FrameGraph& g) {
    BufferRef words = g.create_buffer(buffer_desc("words"));
    for (std::uint32_t i = 0; i < kTimed + 10; ++i) {
      PassBuilder pass = g.add_pass("p", "test");
      words = pass.write(words, Access::compute_write);
      pass.keep();
    }
  });
  const std::vector<PassTime> times = graph.pass_times();
  ASSERT_EQ(times.size(), kTimed + 10);
  EXPECT_GT(times[kTimed - 1].ms, 0.0);
  EXPECT_EQ(times[kTimed].ms, 0.0);
  EXPECT_EQ(times[kTimed].begin_ns, 0u);
}

TEST_F(ExecuteTest, a_pass_begins_after_its_barriers_and_otherwise_where_the_last_one_ended) {
  run_frame([&](FrameGraph& g) {
    PassBuilder a = g.add_pass("a", "test");
    const BufferRef words = a.write(g.create_buffer(buffer_desc("words")), Access::compute_write);
    PassBuilder b = g.add_pass("b", "test");
    b.read(words, Access::compute_read);
    b.keep();
    g.add_pass("c", "test").keep();
  });
  const std::vector<PassTime> times = graph.pass_times();
  ASSERT_EQ(times.size(), 3u);
  // The recording device's clock advances by 1 µs per timestamp.
  EXPECT_EQ(times[0].end_ns - times[0].begin_ns, 1000u);
  EXPECT_EQ(times[1].begin_ns - times[0].end_ns, 1000u) << "the barrier of b lies between";
  EXPECT_EQ(times[2].begin_ns, times[1].end_ns);
  std::vector<std::string> order;
  for (const gpu::RecordedCommand& command : device->commands())
    if (command.name == "barrier" || command.name == "write_timestamp") order.push_back(command.name);
  EXPECT_THAT(order, ElementsAre("barrier", "write_timestamp", "write_timestamp", "barrier", "write_timestamp",
                                 "write_timestamp", "write_timestamp"));
}

TEST_F(ExecuteTest, every_completed_frame_has_its_times_once) {
  const auto frame_with = [&](std::uint32_t passes) {
    run_frame([&](FrameGraph& g) {
      for (std::uint32_t i = 0; i < passes; ++i) g.add_pass("p", "test").keep();
    });
  };
  EXPECT_THAT(graph.take_times(), IsEmpty());
  for (const std::uint32_t passes : {1u, 2u, 3u}) frame_with(passes);
  const std::vector<GpuFrameTimes> times = graph.take_times();
  ASSERT_EQ(times.size(), 3u);
  for (std::uint32_t i = 0; i < 3; ++i) {
    EXPECT_EQ(times[i].frame, i);
    EXPECT_EQ(times[i].passes.size(), i + 1);
    EXPECT_DOUBLE_EQ(times[i].gpu_ms, 0.001 * (i + 1));
  }
  EXPECT_THAT(graph.take_times(), IsEmpty());
  for (std::uint32_t i = 0; i < 9; ++i) frame_with(1);
  const std::vector<GpuFrameTimes> last = graph.take_times();
  ASSERT_EQ(last.size(), 4u);
  EXPECT_EQ(last.back().frame, 11u);
  EXPECT_EQ(graph.pass_times().size(), 1u);
}

/// A frame whose second pass writes to `out` inside rendering and then calls `stop`.
class StoppedFrames : public ExecuteTest {
 public:
  void declare(const PassFunction& stop) {
    graph.begin();
    graph.add_pass("before", "test").keep();
    PassBuilder pass = graph.add_pass("stops", "test");
    target = pass.write(graph.import_image("kept", image, Access::none, Access::transfer_read), Access::color_target);
    pass.execute([this, stop](PassContext& context) {
      gpu::RenderingDesc rendering{.width = 8, .height = 8};
      rendering.colors.push_back({.view = {.image = context.image(target)}});
      context.commands().begin_rendering(rendering);
      stop(context);
    });
    PassBuilder after = graph.add_pass("after", "test");
    after.keep();
    after.execute([this](PassContext&) { ran_after = true; });
    ASSERT_TRUE(graph.compile().ok());
  }
  gpu::ImageHandle image =
      make_image(image_desc("kept"), gpu::ImageUsage::color_target | gpu::ImageUsage::transfer_source);
  ImageRef target;
  bool ran_after = false;
};

TEST_F(StoppedFrames, an_exception_leaves_with_the_name_of_its_pass_at_hand) {
  auto commands = device->begin_frame();
  declare([](PassContext&) { throw std::runtime_error("no luck"); });
  EXPECT_EQ(graph.recording(), "");
  EXPECT_THROW(graph.execute(**commands), std::runtime_error);
  EXPECT_EQ(graph.recording(), "stops");
  ASSERT_TRUE(device->abandon_frame().ok());
  EXPECT_FALSE(ran_after);
  EXPECT_THAT(graph.pass_times(), IsEmpty());
  run_frame([](FrameGraph& g) { g.add_pass("good", "test").keep(); });
  EXPECT_EQ(graph.recording(), "");
  EXPECT_EQ(graph.pass_times().size(), 1u);
}

TEST_F(StoppedFrames, a_pass_that_fails_stops_the_frame_with_its_first_error) {
  auto commands = device->begin_frame();
  declare([](PassContext& context) {
    context.fail({ErrorKind::input, "first"});
    context.fail({ErrorKind::failed, "second"});
  });
  graph.execute(**commands);
  ASSERT_FALSE(graph.recorded().ok());
  EXPECT_EQ(graph.recorded().error().message, "first");
  EXPECT_EQ(graph.recorded().error().kind, ErrorKind::input);
  EXPECT_EQ(graph.recording(), "stops");
  EXPECT_FALSE(ran_after);
  ASSERT_TRUE(device->abandon_frame().ok());
  run_frame([](FrameGraph& g) { g.add_pass("good", "test").keep(); });
  EXPECT_TRUE(graph.recorded().ok());
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
