// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Frame graph: mips and layers of an image that passes use as such.
#include "engine/gpu/subresources.h"

#include <gmock/gmock.h>

#include "tests/frame/graph_fixture.h"
#include "tests/support/expect_assert.h"

namespace gloam::test {
namespace {

using gpu::ImageRange;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

gpu::ImageDesc mipped(std::uint32_t mips, std::uint32_t layers = 1) {
  gpu::ImageDesc desc = image_desc("image");
  desc.mips = mips;
  desc.layers = layers;
  return desc;
}
ImageRange mip(std::uint32_t m) { return {.first_mip = m, .mip_count = 1}; }
ImageRange layer(std::uint32_t l) { return {.first_layer = l, .layer_count = 1}; }

class SubresourceTest : public GraphFixture {
 public:
  /// Adds a pass that writes a range.
  [[nodiscard]] ImageRef write(FrameGraph& g, ImageRef image, Access access, const ImageRange& range) {
    PassBuilder pass = g.add_pass("write", "test");
    return pass.write(image, access, range);
  }
  void read(FrameGraph& g, ImageRef image, Access access, const ImageRange& range = {}) {
    PassBuilder pass = g.add_pass("read", "test");
    pass.read(image, access, range);
    pass.keep();
  }
};

TEST_F(SubresourceTest, a_pass_reads_one_mip_and_writes_the_next_of_one_image) {
  const auto kernel = device->create_pipeline(gpu::ComputePipelineDesc{.name = "kernel"}).value();
  run_frame([&](FrameGraph& g) {
    ImageRef image = write(g, g.create_image(mipped(3)), Access::compute_write, mip(0));
    for (std::uint32_t m = 1; m < 3; ++m) {
      PassBuilder pass = g.add_pass("halve", "test");
      pass.read(image, Access::compute_read, mip(m - 1));
      const ImageRef next = pass.write(image, Access::compute_write, mip(m));
      pass.execute([=](PassContext& context) {
        context.commands().bind_pipeline(kernel);
        context.commands().bind(std::array{
            gpu::Binding{0, gpu::Binding::Sampled{{.image = context.image(image), .first_mip = m - 1, .mip_count = 1}}},
            gpu::Binding{1, gpu::Binding::Storage{{.image = context.image(next), .first_mip = m, .mip_count = 1}}}});
        context.commands().dispatch(1, 1, 1);
      });
      image = next;
    }
    read(g, image, Access::fragment_read);
  });
  EXPECT_THAT(texts("barrier"),
              ElementsAre("barrier 'image' none|fragment_read|compute_read>compute_write",
                          "barrier 'image' mips 0+1 layers 0+1 compute_write>compute_read|fragment_read",
                          "barrier 'image' mips 1+1 layers 0+1 compute_write>compute_read|fragment_read",
                          "barrier 'image' mips 2+1 layers 0+1 compute_write>fragment_read"));
}

TEST_F(SubresourceTest, passes_that_write_different_layers_stand_without_barriers_between_them) {
  for (const Access access : {Access::color_target, Access::compute_write}) {
    device->forget_commands();
    run_frame([&](FrameGraph& g) {
      ImageRef image = g.create_image(mipped(1, 6));
      for (std::uint32_t l = 0; l < 6; ++l) image = write(g, image, access, layer(l));
      read(g, image, Access::fragment_read);
    });
    EXPECT_EQ(texts("barrier").size(), 2u) << name_of(access);
  }
}

TEST_F(SubresourceTest, mips_of_an_import_that_are_written_apart_do_not_wait_for_each_other) {
  const gpu::ImageHandle kept = make_image(mipped(4), gpu::ImageUsage::sampled | gpu::ImageUsage::color_target);
  run_frame([&](FrameGraph& g) {
    ImageRef image = g.import_image("kept", kept, Access::none, Access::fragment_read);
    for (std::uint32_t m = 0; m < 3; ++m) image = write(g, image, Access::color_target, mip(m));
  });
  EXPECT_THAT(texts("barrier"), ElementsAre("barrier 'image' mips 0+3 layers 0+1 none>color_target",
                                            "barrier 'image' mips 0+3 layers 0+1 color_target>fragment_read, "
                                            "'image' mips 3+1 layers 0+1 none>fragment_read"));
  device->forget_commands();
  run_frame([&](FrameGraph& g) {
    ImageRef image = g.import_image("kept", kept, Access::fragment_read, Access::fragment_read);
    read(g, image, Access::fragment_read, mip(1));
    image = write(g, image, Access::color_target, mip(0));
    image = write(g, image, Access::color_target, mip(1));
  });
  EXPECT_THAT(texts("barrier"), ElementsAre("barrier 'image' mips 0+1 layers 0+1 fragment_read>color_target",
                                            "barrier 'image' mips 1+1 layers 0+1 fragment_read>color_target",
                                            "barrier 'image' mips 0+2 layers 0+1 color_target>fragment_read"));
}

TEST_F(SubresourceTest, writers_of_parts_that_nobody_reads_are_culled) {
  std::vector<std::string> ran;
  run_frame([&](FrameGraph& g) {
    ImageRef image = g.create_image(mipped(2, 2));
    for (std::uint32_t l = 0; l < 2; ++l) {
      PassBuilder pass = g.add_pass("write", "test");
      image = pass.write(image, Access::compute_write, layer(l));
      pass.execute([&ran, l](PassContext&) { ran.push_back("layer " + std::to_string(l)); });
    }
    read(g, image, Access::compute_read, {.first_mip = 1, .mip_count = 1, .first_layer = 1, .layer_count = 1});
  });
  EXPECT_THAT(ran, ElementsAre("layer 1"));
}

TEST_F(SubresourceTest, ranges_belong_to_the_structure) {
  std::vector<std::uint64_t> hashes;
  for (const std::uint32_t m : {0u, 1u, 0u}) {
    run_frame([&](FrameGraph& g) {
      read(g, write(g, g.create_image(mipped(2)), Access::compute_write, mip(m)), Access::compute_read, mip(m));
    });
    hashes.push_back(graph.plan_hash());
  }
  EXPECT_NE(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

TEST_F(SubresourceTest, a_range_of_everything_is_the_whole_image) {
  std::vector<std::uint64_t> hashes;
  for (const ImageRange& range : {ImageRange{}, ImageRange{0, 2, 0, 3}, ImageRange{0, 0, 0, 3}}) {
    run_frame([&](FrameGraph& g) {
      read(g, write(g, g.create_image(mipped(2, 3)), Access::compute_write, range), Access::compute_read, range);
    });
    hashes.push_back(graph.plan_hash());
  }
  EXPECT_THAT(hashes, testing::Each(hashes[0]));
}

TEST_F(SubresourceTest, the_description_names_mips_and_layers) {
  run_frame([&](FrameGraph& g) {
    read(g, write(g, g.create_image(mipped(2)), Access::compute_write, mip(1)), Access::compute_read, mip(1));
  });
  EXPECT_THAT(graph.describe(), HasSubstr("read [test]; reads image mips 1+1 layers 0+1 compute_read; barriers image "
                                          "mips 1+1 layers 0+1 compute_write>compute_read"));
}

TEST_F(SubresourceTest, misuse_asserts_with_a_sentence) {
  graph.begin();
  const ImageRef image = write(graph, graph.create_image(mipped(3)), Access::compute_write, mip(0));
  EXPECT_ASSERT(read(graph, image, Access::compute_read, mip(3)), "a range begins inside its image");
  EXPECT_ASSERT(read(graph, image, Access::compute_read, {.first_mip = 2, .mip_count = 2}), "ends inside its image");
  PassBuilder pass = graph.add_pass("pass", "test");
  pass.read(image, Access::compute_read, {.first_mip = 0, .mip_count = 2});
  EXPECT_ASSERT((void)pass.write(image, Access::compute_write, mip(1)), "in one pass are equal or disjoint");
  pass.keep();
  EXPECT_ASSERT((void)graph.compile(), "resource 'image': mip 1 of layer 0 is read that no pass has written");
}

TEST(subresources, values_are_kept_by_mip_and_layer_and_joined_when_they_are_equal) {
  gpu::Subresources<int> values(2, 3);
  values.set({1, 1, 0, 2}, 7);
  const auto all = [&] {
    std::vector<int> list;
    values.visit(values.all(), [&](int v) { list.push_back(v); });
    return list;
  };
  EXPECT_THAT(all(), ElementsAre(0, 0, 0, 7, 7, 0));
  values.update({0, 2, 1, 1}, [](int& v) { ++v; });
  EXPECT_THAT(all(), ElementsAre(0, 1, 0, 7, 8, 0));
  values.set(values.all(), 5);
  EXPECT_THAT(all(), ElementsAre(5));
}

}  // namespace
}  // namespace gloam::test
