// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/kept_frames/digest_commands.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "engine/gpu/recording/device.h"
#include "engine/render/kept_frames/kept_frames.h"

namespace gloam {
namespace {

/// Takes any command.
class NoCommands final : public gpu::CommandList {
 public:
  void begin_label(std::string_view) override {}
  void end_label() override {}
  void write_timestamp(std::uint32_t) override {}
  void barrier(std::span<const gpu::BufferBarrier>, std::span<const gpu::ImageBarrier>) override {}
  void copy_buffer(gpu::BufferHandle, std::uint64_t, gpu::BufferHandle, std::uint64_t, std::uint64_t) override {}
  void copy_buffer_to_image(gpu::BufferHandle, std::uint64_t, gpu::ImageHandle, std::uint32_t, std::uint32_t,
                            std::uint32_t) override {}
  void copy_rows_to_image(gpu::BufferHandle, std::uint64_t, gpu::ImageHandle, std::uint32_t, std::uint32_t,
                          std::uint32_t) override {}
  void copy_image_to_buffer(gpu::ImageHandle, std::uint32_t, std::uint32_t, gpu::BufferHandle, std::uint64_t) override {
  }
  void fill_buffer(gpu::BufferHandle, std::uint64_t, std::uint64_t, std::uint32_t) override {}
  void clear_color_image(gpu::ImageHandle, std::array<std::uint32_t, 4>, gpu::ImageRange) override {}
  void blit(gpu::ImageHandle, gpu::ImageHandle, gpu::ImagePart, gpu::ImagePart) override {}
  void begin_rendering(const gpu::RenderingDesc&) override {}
  void end_rendering() override {}
  void set_viewport(float, float, float, float) override {}
  void set_scissor(std::int32_t, std::int32_t, std::uint32_t, std::uint32_t) override {}
  void set_depth_bias(float, float) override {}
  void bind_pipeline(gpu::PipelineHandle) override {}
  void bind(std::span<const gpu::Binding>) override {}
  void bind_set(std::uint32_t, gpu::ResourceSetHandle) override {}
  void push_constants(std::span<const std::byte>) override {}
  void bind_vertex_stream(std::uint32_t, gpu::BufferHandle, std::uint64_t) override {}
  void bind_indices(gpu::BufferHandle, std::uint64_t) override {}
  void draw(std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t) override {}
  void draw_indexed(std::uint32_t, std::uint32_t, std::uint32_t, std::int32_t, std::uint32_t) override {}
  void draw_indirect(gpu::BufferHandle, std::uint64_t) override {}
  void draw_indexed_indirect(gpu::BufferHandle, std::uint64_t, std::uint32_t) override {}
  void dispatch(std::uint32_t, std::uint32_t, std::uint32_t) override {}
  void dispatch_indirect(gpu::BufferHandle, std::uint64_t) override {}
  void* begin_native(std::optional<std::uint64_t>) override { return nullptr; }
  void end_native() override {}
};

class DigestCommandsTest : public testing::Test {
 protected:
  using Recorded = std::function<void(gpu::CommandList&)>;

  gpu::BufferHandle buffer(gpu::MemoryKind memory) {
    return device_
        ->create_buffer(
            {.name = "data",
             .module = "test",
             .size = 256,
             .usage = gpu::BufferUsage::transfer_source | gpu::BufferUsage::transfer_target | gpu::BufferUsage::storage,
             .memory = memory})
        .value();
  }
  gpu::ImageHandle image() {
    return device_
        ->create_image({.name = "texels",
                        .module = "test",
                        .format = gpu::Format::rgba8_unorm,
                        .width = 4,
                        .height = 4,
                        .usage = gpu::ImageUsage::transfer_source | gpu::ImageUsage::transfer_target |
                                 gpu::ImageUsage::sampled | gpu::ImageUsage::color_target})
        .value();
  }
  /// An upload buffer with this byte at all places from `offset` to `end`, and others elsewhere.
  gpu::BufferHandle uploaded(std::uint8_t value, std::size_t offset, std::size_t end) {
    const gpu::BufferHandle made = buffer(gpu::MemoryKind::upload);
    const std::span<std::byte> bytes = device_->mapped(made);
    std::memset(bytes.data(), ++noise_, bytes.size());
    std::memset(bytes.data() + offset, value, end - offset);
    return made;
  }
  FrameDigest digest(const Recorded& record) { return known_digest(record).value(); }
  std::optional<FrameDigest> known_digest(const Recorded& record) {
    NoCommands next;
    DigestCommands commands(next, *device_, [this](gpu::ImageHandle image, gpu::BufferHandle buffer) {
      return image ? image == kept_image_ : buffer == kept_buffer_;
    });
    record(commands);
    return commands.digest();
  }
  void expect_all_differ(const std::vector<Recorded>& variants) {
    for (std::size_t i = 0; i < variants.size(); ++i) {
      EXPECT_EQ(digest(variants[i]), digest(variants[i])) << i;
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_NE(digest(variants[i]).inputs, digest(variants[j]).inputs) << i << " and " << j;
    }
  }

  std::unique_ptr<gpu::RecordingDevice> device_ = gpu::make_recording_device();
  gpu::ImageHandle kept_image_;  ///< outlive their frames
  gpu::BufferHandle kept_buffer_;
  std::uint8_t noise_ = 100;
};

TEST_F(DigestCommandsTest, what_the_cpu_has_written_counts_by_its_bytes_wherever_it_lies) {
  const auto bind = [](gpu::BufferHandle from, std::uint64_t offset, std::uint64_t size) -> Recorded {
    return [=](gpu::CommandList& commands) {
      const gpu::Binding binding{3, gpu::Binding::BufferRange{from, offset, size}};
      commands.bind({&binding, 1});
    };
  };
  const gpu::BufferHandle first = uploaded(7, 0, 64), elsewhere = uploaded(7, 128, 192), other = uploaded(8, 0, 64);
  EXPECT_EQ(digest(bind(first, 0, 64)), digest(bind(elsewhere, 128, 64)));
  EXPECT_NE(digest(bind(first, 0, 64)), digest(bind(other, 0, 64)));
  EXPECT_NE(digest(bind(first, 0, 64)), digest(bind(first, 0, 32)));
  const gpu::BufferHandle kept = buffer(gpu::MemoryKind::device);
  const auto copy = [&](gpu::BufferHandle from, std::uint64_t offset) -> Recorded {
    return [=](gpu::CommandList& commands) { commands.copy_buffer(from, offset, kept, 0, 64); };
  };
  EXPECT_EQ(digest(copy(first, 0)), digest(copy(elsewhere, 128)));
  EXPECT_NE(digest(copy(first, 0)), digest(copy(other, 0)));
  // Texels of four rows of four pixels, and two rows of them.
  const gpu::ImageHandle target = image();
  const auto texels = [&](gpu::BufferHandle from, std::uint64_t offset, bool rows) -> Recorded {
    return [=](gpu::CommandList& commands) {
      if (rows)
        commands.copy_rows_to_image(from, offset, target, 0, 0, 2);
      else
        commands.copy_buffer_to_image(from, offset, target, 0, 0, 1);
    };
  };
  const gpu::BufferHandle half = uploaded(7, 0, 32);
  EXPECT_EQ(digest(texels(first, 0, false)), digest(texels(elsewhere, 128, false)));
  EXPECT_NE(digest(texels(first, 0, false)), digest(texels(half, 0, false)));
  EXPECT_EQ(digest(texels(first, 0, true)), digest(texels(half, 0, true)));
  EXPECT_NE(digest(texels(first, 0, true)), digest(texels(other, 0, true)));
}

TEST_F(DigestCommandsTest, where_results_go_for_the_cpu_does_not_count) {
  const gpu::BufferHandle from = buffer(gpu::MemoryKind::device), also = buffer(gpu::MemoryKind::device);
  const gpu::BufferHandle one = buffer(gpu::MemoryKind::readback), two = buffer(gpu::MemoryKind::readback);
  const auto copy = [&](gpu::BufferHandle source, gpu::BufferHandle target) -> Recorded {
    return [=](gpu::CommandList& commands) { commands.copy_buffer(source, 0, target, 0, 64); };
  };
  EXPECT_EQ(digest(copy(from, one)), digest(copy(from, two)));
  EXPECT_NE(digest(copy(from, one)), digest(copy(also, one)));
}

TEST_F(DigestCommandsTest, every_other_argument_counts) {
  const gpu::BufferHandle a = buffer(gpu::MemoryKind::device), b = buffer(gpu::MemoryKind::device);
  const gpu::ImageHandle x = image(), y = image();
  using List = gpu::CommandList;
  expect_all_differ({[](List&) {},
                     [=](List& c) { c.copy_buffer(a, 0, b, 0, 64); },
                     [=](List& c) { c.copy_buffer(b, 0, a, 0, 64); },
                     [=](List& c) { c.copy_buffer(a, 16, b, 0, 64); },
                     [=](List& c) { c.copy_buffer(a, 0, b, 16, 64); },
                     [=](List& c) { c.copy_buffer(a, 0, b, 0, 32); },
                     [=](List& c) { c.copy_image_to_buffer(x, 0, 0, a, 0); },
                     [=](List& c) { c.copy_image_to_buffer(y, 0, 0, a, 0); },
                     [=](List& c) { c.fill_buffer(a, 0, 64, 0); },
                     [=](List& c) { c.fill_buffer(a, 0, 64, 1); },
                     [=](List& c) { c.fill_buffer(b, 0, 64, 1); },
                     [=](List& c) {
                       c.clear_color_image(x, {0, 0, 0, 0}, {});
                     },
                     [=](List& c) {
                       c.clear_color_image(x, {0, 0, 1, 0}, {});
                     },
                     [=](List& c) {
                       c.clear_color_image(y, {0, 0, 1, 0}, {});
                     },
                     [=](List& c) { c.blit(x, y, {}, {}); },
                     [=](List& c) { c.blit(y, x, {}, {}); },
                     [=](List& c) {
                       c.blit(x, y, {}, {1, 0});
                     },
                     [](List& c) { c.set_viewport(0, 0, 8, 8); },
                     [](List& c) { c.set_viewport(0, 0, 8, 9); },
                     [](List& c) { c.set_scissor(0, 0, 8, 8); },
                     [](List& c) { c.set_scissor(0, 1, 8, 8); },
                     [](List& c) { c.set_depth_bias(1, 0); },
                     [](List& c) { c.set_depth_bias(0, 1); },
                     [](List& c) {
                       c.bind_pipeline({1, 1});
                     },
                     [](List& c) {
                       c.bind_pipeline({1, 2});
                     },
                     [](List& c) {
                       c.bind_set(1, {1, 1});
                     },
                     [](List& c) {
                       c.bind_set(2, {1, 1});
                     },
                     [](List& c) {
                       c.bind_set(1, {1, 2});
                     },
                     [](List& c) { c.push(1.0f); },
                     [](List& c) { c.push(2.0f); },
                     [=](List& c) { c.bind_vertex_stream(0, a, 0); },
                     [=](List& c) { c.bind_vertex_stream(1, a, 0); },
                     [=](List& c) { c.bind_vertex_stream(0, a, 16); },
                     [=](List& c) { c.bind_indices(a, 0); },
                     [=](List& c) { c.bind_indices(b, 0); },
                     [](List& c) { c.draw(3, 1, 0, 0); },
                     [](List& c) { c.draw(3, 1, 0, 1); },
                     [](List& c) { c.draw_indexed(3, 1, 0, 0, 0); },
                     [](List& c) { c.draw_indexed(3, 1, 0, 1, 0); },
                     [=](List& c) { c.draw_indirect(a, 0); },
                     [=](List& c) { c.draw_indexed_indirect(a, 0, 1); },
                     [=](List& c) { c.draw_indexed_indirect(a, 0, 2); },
                     [](List& c) { c.dispatch(1, 1, 1); },
                     [](List& c) { c.dispatch(1, 2, 1); },
                     [](List& c) { c.dispatch(1, 1, 1), c.dispatch(1, 1, 1); },
                     [=](List& c) { c.dispatch_indirect(a, 0); },
                     [=](List& c) { c.dispatch_indirect(b, 0); }});
}

TEST_F(DigestCommandsTest, bindings_and_targets_count) {
  const gpu::ImageHandle x = image(), y = image();
  const auto sampled = [](gpu::ImageView view, gpu::SamplerHandle sampler) -> Recorded {
    return [=](gpu::CommandList& commands) {
      const gpu::Binding binding{1, gpu::Binding::Sampled{view, sampler}};
      commands.bind({&binding, 1});
    };
  };
  const auto stored = [](gpu::ImageView view) -> Recorded {
    return [=](gpu::CommandList& commands) {
      const gpu::Binding binding{1, gpu::Binding::Storage{view}};
      commands.bind({&binding, 1});
    };
  };
  const auto rendering = [](gpu::ImageView view, gpu::LoadOp load, float clear) -> Recorded {
    return [=](gpu::CommandList& commands) {
      gpu::RenderingDesc desc;
      desc.colors.push_back({view, load, {0, 0, clear, 0}});
      desc.width = desc.height = 4;
      commands.begin_rendering(desc);
    };
  };
  using enum gpu::LoadOp;
  expect_all_differ({sampled({x}, {1, 1}), sampled({y}, {1, 1}), sampled({x}, {2, 1}), sampled({x, 0, 1}, {1, 1}),
                     stored({x}), stored({y}), rendering({x}, clear, 0), rendering({y}, clear, 0),
                     rendering({x}, load, 0), rendering({x}, clear, 1)});
}

TEST_F(DigestCommandsTest, places_of_what_outlives_frames_are_no_inputs) {
  kept_image_ = image();
  kept_buffer_ = buffer(gpu::MemoryKind::device);
  const gpu::ImageHandle x = image();
  const gpu::BufferHandle a = buffer(gpu::MemoryKind::device);
  const auto record = [](gpu::ImageHandle shown, gpu::BufferHandle filled, std::uint64_t offset) -> Recorded {
    return [=](gpu::CommandList& commands) {
      commands.clear_color_image(shown, {0, 0, 0, 0}, {});
      commands.fill_buffer(filled, offset, 16, 0);
    };
  };
  const FrameDigest kept = digest(record(kept_image_, kept_buffer_, 0));
  EXPECT_NE(kept.inputs, digest(record(x, kept_buffer_, 0)).inputs);
  EXPECT_NE(kept.inputs, digest(record(kept_image_, a, 0)).inputs);
  EXPECT_NE(kept.inputs, digest(record(kept_image_, kept_buffer_, 16)).inputs);
  const gpu::ImageHandle image_before = std::exchange(kept_image_, image());
  const gpu::BufferHandle buffer_before = std::exchange(kept_buffer_, buffer(gpu::MemoryKind::device));
  const FrameDigest swapped = digest(record(kept_image_, kept_buffer_, 0));
  EXPECT_EQ(kept.inputs, swapped.inputs);
  EXPECT_NE(kept.whole, swapped.whole);
  EXPECT_NE(image_before, kept_image_);
  EXPECT_NE(buffer_before, kept_buffer_);
}

TEST_F(DigestCommandsTest, native_commands_count_by_their_revision_and_are_unknown_without_one) {
  const auto native = [](std::optional<std::uint64_t> revision) -> Recorded {
    return [=](gpu::CommandList& commands) {
      commands.dispatch(1, 1, 1);
      static_cast<void>(commands.begin_native(revision));
      commands.end_native();
    };
  };
  const Recorded none = [](gpu::CommandList& commands) { commands.dispatch(1, 1, 1); };
  expect_all_differ({none, native(0), native(1), native(2)});
  EXPECT_EQ(known_digest(native({})), std::nullopt);
}

TEST(KeptFramesTest, inputs_repeat_and_places_may_alternate) {
  KeptFrames frames;
  const FrameDigest even{1, 10}, odd{1, 11}, other{2, 10};
  for (const FrameDigest& digest : {even, odd, even, odd}) {
    EXPECT_FALSE(frames.repeats(digest));
    frames.add(digest);
  }
  EXPECT_TRUE(frames.repeats(even));
  EXPECT_FALSE(frames.repeats(odd));
  frames.add(even);
  EXPECT_TRUE(frames.repeats(odd));
  frames.add(other);  // something has changed
  for (const FrameDigest& digest : {even, odd, even, odd}) {
    EXPECT_FALSE(frames.repeats(digest));
    frames.add(digest);
  }
  EXPECT_TRUE(frames.repeats(even));
  frames.restart();
  EXPECT_FALSE(frames.repeats(even));
}

TEST(KeptFramesTest, inputs_that_alternate_do_not_repeat) {
  KeptFrames frames;
  for (int i = 0; i < 12; ++i) {
    const FrameDigest digest{i % 2 == 0 ? 1u : 2u, 10};
    EXPECT_FALSE(frames.repeats(digest)) << i;
    frames.add(digest);
  }
}

}  // namespace
}  // namespace gloam
