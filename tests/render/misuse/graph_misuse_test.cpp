// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Frame graphs as a careless module declares them: each kind of misuse, and the sentence that names it.
#include "engine/frame/frame_graph.h"
#include "engine/frame/transfers/readback.h"
#include "tests/render/misuse/careless_host.h"

namespace gloam {
namespace {

using gpu::Access;
using enum gpu::ImageUsage;

class GraphMisuse : public ::testing::Test {
 protected:
  GraphMisuse() { graph_.begin(); }
  [[nodiscard]] ImageRef transient() {
    return graph_.create_image(
        {.name = "light", .module = "test", .format = gpu::Format::rgba16_float, .width = 8, .height = 8});
  }
  [[nodiscard]] gpu::ImageHandle made(gpu::ImageUsage usage) {
    return device_
        ->create_image({.name = "host", .format = gpu::Format::rgba8_unorm, .width = 8, .height = 8, .usage = usage})
        .value();
  }

  std::unique_ptr<gpu::RecordingDevice> device_ = gpu::make_recording_device();
  FrameGraph graph_{*device_};
};

TEST_F(GraphMisuse, a_handle_of_another_frame_or_of_nothing) {
  const ImageRef old = transient();
  graph_.begin();
  PassBuilder pass = graph_.add_pass("late", "test");
  EXPECT_ASSERT((void)pass.write(old, Access::compute_write), "this handle is of another frame");
  EXPECT_ASSERT((void)pass.write(ImageRef(), Access::compute_write), "this handle names no resource");
}

TEST_F(GraphMisuse, an_old_version_of_a_resource) {
  const ImageRef first = transient();
  PassBuilder writer = graph_.add_pass("writer", "test");
  (void)writer.write(first, Access::compute_write);
  PassBuilder reader = graph_.add_pass("reader", "test");
  EXPECT_ASSERT(reader.read(first, Access::compute_read), "pass 'reader', resource 'light': this handle is stale");
}

TEST_F(GraphMisuse, a_transient_that_no_pass_has_written) {
  PassBuilder pass = graph_.add_pass("reader", "test");
  EXPECT_ASSERT(pass.read(transient(), Access::compute_read), "a transient is read that no pass has written");
}

TEST_F(GraphMisuse, an_access_that_the_resource_cannot_have) {
  PassBuilder pass = graph_.add_pass("pass", "test");
  EXPECT_ASSERT(pass.read(transient(), Access::compute_write), "compute_write is no read");
  EXPECT_ASSERT((void)pass.write(transient(), Access::compute_read), "compute_read writes nothing");
  EXPECT_ASSERT(pass.read(transient(), Access::indirect_read), "this kind of resource has no access indirect_read");
}

TEST_F(GraphMisuse, an_import_that_was_destroyed_comes_twice_or_lacks_the_usage) {
  const gpu::ImageHandle image = made(sampled);
  EXPECT_ASSERT((void)graph_.import_image("host", image, Access::none, Access::color_target),
                "import 'host': the usage of image \"host\" does not allow color_target");
  EXPECT_ASSERT((void)graph_.import_image("host", image, Access::host_read, Access::none),
                "import 'host': images have no access host_read");
  (void)graph_.import_image("host", image, Access::none, Access::fragment_read);
  EXPECT_ASSERT((void)graph_.import_image("again", image, Access::none, Access::fragment_read),
                "an image is imported once a frame: 'again'");
  const gpu::ImageHandle gone = made(sampled);
  device_->destroy(gone);
  EXPECT_ASSERT((void)graph_.import_image("gone", gone, Access::none, Access::fragment_read),
                "this image is not alive");
  EXPECT_ASSERT((void)graph_.import_image("null", {}, Access::none, Access::fragment_read),
                "an import needs a living image: 'null'");
}

TEST_F(GraphMisuse, a_pass_that_uses_what_it_has_not_declared) {
  const ImageRef target = graph_.import_image("target", made(storage), Access::none, Access::compute_write);
  const ImageRef other = transient();
  PassBuilder pass = graph_.add_pass("pass", "test");
  (void)pass.write(target, Access::compute_write);
  pass.execute([other](PassContext& context) { (void)context.image(other); });
  ASSERT_TRUE(graph_.compile().ok());
  gpu::CommandList& commands = **device_->begin_frame();
  EXPECT_ASSERT(graph_.execute(commands), "pass 'pass' uses resource 'light' that it did not declare");
}

TEST_F(GraphMisuse, calls_in_a_wrong_order) {
  gpu::CommandList& commands = **device_->begin_frame();
  EXPECT_ASSERT(graph_.execute(commands), "execute needs a successful compile before it");
  ASSERT_TRUE(graph_.compile().ok());
  EXPECT_ASSERT((void)graph_.add_pass("late", "test"), "declarations come between FrameGraph::begin");
  EXPECT_ASSERT(graph_.free_memory(), "a compiled frame is executed before its memory is freed");
  EXPECT_ASSERT((void)device_->begin_frame(), "begin_frame needs the frame before it to be submitted");
}

TEST_F(GraphMisuse, a_readback_beyond_the_image) {
  Readback readback(*device_);
  const ImageRef image =
      graph_.import_image("host", made(transfer_source), Access::transfer_read, Access::transfer_read);
  EXPECT_ASSERT((void)readback.read_image(graph_, image, 1), "image 'host' has no such mip or layer");
}

}  // namespace
}  // namespace gloam
