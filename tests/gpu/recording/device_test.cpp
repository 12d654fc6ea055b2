// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/recording/device.h"

#include <gmock/gmock.h>

#include <array>

#include "tests/support/expect_assert.h"

namespace gloam::gpu {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class RecordingDeviceTest : public testing::Test {
 public:
  RecordingDeviceTest() { begin(); }
  void begin() { commands = device->begin_frame().value(); }
  void next_frame() {
    ASSERT_TRUE(device->submit_frame().ok());
    begin();
  }
  BufferHandle buffer(const char* name, std::uint64_t size = 64, MemoryKind memory = MemoryKind::device) {
    return device
        ->create_buffer({.name = name,
                         .module = "test",
                         .size = size,
                         .usage = BufferUsage::transfer_source | BufferUsage::transfer_target | BufferUsage::storage,
                         .memory = memory})
        .value();
  }
  ImageDesc image_desc(const char* name) const {
    return {.name = name,
            .module = "test",
            .format = Format::rgba8_unorm,
            .width = 4,
            .height = 4,
            .usage = ImageUsage::transfer_source | ImageUsage::transfer_target | ImageUsage::sampled |
                     ImageUsage::storage | ImageUsage::color_target};
  }
  ImageHandle image(const char* name) { return device->create_image(image_desc(name)).value(); }
  void barrier(BufferHandle handle, Access before, Access after) {
    const BufferBarrier b{.buffer = handle, .before = before, .after = after};
    commands->barrier({&b, 1}, {});
  }
  void barrier(ImageHandle handle, Access before, Access after, AccessMask also_before = 0) {
    const ImageBarrier b{.image = handle, .before = before, .after = after, .also_before = also_before};
    commands->barrier({}, {&b, 1});
  }
  void dispatch(Binding binding) {
    commands->bind_pipeline(kernel);
    commands->bind({&binding, 1});
    commands->dispatch(1, 1, 1);
  }
  [[nodiscard]] const std::vector<std::string>& faults() const { return device->faults(); }

  std::unique_ptr<RecordingDevice> device = make_recording_device();
  PipelineHandle kernel = device->create_pipeline(ComputePipelineDesc{.name = "kernel", .module = "test"}).value();
  CommandList* commands = nullptr;
};

TEST_F(RecordingDeviceTest, commands_are_written_down_in_order_with_their_numbers) {
  const BufferHandle target = buffer("target");
  commands->begin_label("pass");
  commands->fill_buffer(target, 4, 8, 3);
  commands->end_label();
  std::vector<std::string> texts;
  for (const RecordedCommand& command : device->commands()) texts.push_back(command.text);
  EXPECT_THAT(texts, ElementsAre("begin_label pass", "fill_buffer 'target'+4, 8 bytes of 3", "end_label"));
  device->forget_commands();
  EXPECT_THAT(device->commands(), IsEmpty());
  EXPECT_THAT(faults(), IsEmpty());
}

TEST_F(RecordingDeviceTest, copies_move_bytes_between_buffers_and_images) {
  const BufferHandle source = buffer("source", 64, MemoryKind::upload);
  const BufferHandle target = buffer("target", 64, MemoryKind::readback);
  const ImageHandle picture = image("picture");
  for (std::size_t i = 0; i < 64; ++i) device->mapped(source)[i] = static_cast<std::byte>(i);
  barrier(picture, Access::none, Access::transfer_write);
  commands->copy_buffer_to_image(source, 0, picture, 0, 0, 1);
  barrier(picture, Access::transfer_write, Access::transfer_read);
  commands->copy_image_to_buffer(picture, 0, 0, target, 0);
  EXPECT_EQ(device->mapped(target)[63], std::byte{63});
  EXPECT_THAT(faults(), IsEmpty());
}

TEST_F(RecordingDeviceTest, a_read_without_a_barrier_after_a_write_is_a_fault) {
  const BufferHandle a = buffer("a");
  commands->fill_buffer(a, 0, 64, 0);
  commands->copy_buffer(a, 0, buffer("b"), 0, 64);
  EXPECT_THAT(faults(), ElementsAre(HasSubstr("buffer 'a' is used as transfer_read but its last barrier left it ready "
                                              "for transfer_write")));
}

TEST_F(RecordingDeviceTest, an_image_without_a_barrier_is_a_fault) {
  commands->clear_color_image(image("picture"), {});
  EXPECT_THAT(faults(), ElementsAre(HasSubstr("'picture' is used as transfer_write")));
}

TEST_F(RecordingDeviceTest, a_binding_must_fit_the_state_of_the_image) {
  const ImageHandle picture = image("picture");
  barrier(picture, Access::none, Access::compute_write);
  dispatch({0, Binding::Storage{.view = {.image = picture}}});
  EXPECT_THAT(faults(), IsEmpty());
  dispatch({0, Binding::Sampled{.view = {.image = picture}}});
  EXPECT_THAT(faults(), ElementsAre(HasSubstr("dispatch: image 'picture' is used as uniform_read|compute_read")));
}

TEST_F(RecordingDeviceTest, mips_and_layers_are_tracked_as_such) {
  ImageDesc desc = image_desc("picture");
  desc.mips = 2;
  desc.layers = 2;
  const ImageHandle picture = device->create_image(desc).value();
  const ImageBarrier first{.image = picture, .after = Access::compute_read, .range = {.mip_count = 1}};
  const ImageBarrier second{
      .image = picture, .after = Access::compute_write, .range = {.first_mip = 1, .first_layer = 1}};
  commands->barrier({}, std::array{first, second});
  dispatch({0, Binding::Sampled{.view = {.image = picture, .mip_count = 1}}});
  dispatch({0, Binding::Storage{.view = {.image = picture, .first_mip = 1, .first_layer = 1}}});
  EXPECT_THAT(faults(), IsEmpty());
  dispatch({0, Binding::Storage{.view = {.image = picture, .first_mip = 1}}});
  EXPECT_THAT(faults(), ElementsAre(HasSubstr("'picture' mips 1+1 is used as compute_storage_read|compute_write but "
                                              "its last barrier left it ready for nothing")));
  commands->barrier({}, std::array{first, first});
  EXPECT_THAT(faults().at(1), HasSubstr("a part of one image appears twice in one call"));
  const ImageBarrier outside{.image = picture, .after = Access::compute_read, .range = {.first_layer = 2}};
  commands->barrier({}, {&outside, 1});
  EXPECT_THAT(faults().back(), HasSubstr("'picture' layers 2+0 reaches past its end"));
}

TEST_F(RecordingDeviceTest, a_barrier_that_starts_from_another_layout_is_a_fault) {
  const ImageHandle picture = image("picture");
  barrier(picture, Access::none, Access::transfer_write);
  barrier(picture, Access::color_target, Access::fragment_read);
  EXPECT_THAT(faults(), ElementsAre(HasSubstr("'picture' is said to be in color_target but its last barrier left it")));
}

TEST_F(RecordingDeviceTest, a_barrier_waits_for_every_access_since_the_one_before) {
  const BufferHandle a = buffer("a");
  const BufferBarrier both{
      .buffer = a, .before = Access::none, .after = Access::compute_read, .also_after = mask_of(Access::transfer_read)};
  commands->barrier({&both, 1}, {});
  dispatch({0, Binding::BufferRange{.buffer = a}});
  commands->copy_buffer(a, 0, buffer("b"), 0, 64);
  barrier(a, Access::compute_read, Access::transfer_write);
  EXPECT_THAT(faults(), ElementsAre(HasSubstr("waits for compute_read but not for its earlier transfer_read")));
}

TEST_F(RecordingDeviceTest, two_labels_that_write_need_a_barrier_between_them) {
  const BufferHandle a = buffer("a");
  barrier(a, Access::none, Access::transfer_write);
  const auto fill_under = [&](const char* label) {
    commands->begin_label(label);
    commands->fill_buffer(a, 0, 4, 0);
    commands->fill_buffer(a, 4, 4, 0);
    commands->end_label();
  };
  fill_under("first");
  EXPECT_THAT(faults(), IsEmpty());
  fill_under("second");
  EXPECT_THAT(faults(), testing::Contains(HasSubstr("was written under an earlier label")));
}

TEST_F(RecordingDeviceTest, images_of_shared_memory_take_turns) {
  const std::vector<ImageDesc> descs = {image_desc("a"), image_desc("b")};
  const std::vector<ImageHandle> images = device->create_aliased_images(descs).value();
  barrier(images[0], Access::none, Access::transfer_write);
  commands->clear_color_image(images[0], {});
  barrier(images[1], Access::none, Access::compute_write, mask_of(Access::transfer_write));
  dispatch({0, Binding::Storage{.view = {.image = images[1]}}});
  EXPECT_THAT(faults(), IsEmpty());
  commands->clear_color_image(images[0], {});
  EXPECT_THAT(faults(), ElementsAre(HasSubstr("'a' has lost its memory")));
  barrier(images[0], Access::none, Access::transfer_write, mask_of(Access::transfer_write));
  EXPECT_THAT(faults().back(), HasSubstr("not for its earlier compute_write"));
}

TEST_F(RecordingDeviceTest, accesses_are_forgotten_once_their_frame_must_have_ended) {
  const BufferHandle a = buffer("a");
  barrier(a, Access::none, Access::transfer_write);
  commands->fill_buffer(a, 0, 64, 0);
  for (std::uint32_t i = 0; i < Device::kFramesInFlight; ++i) next_frame();
  barrier(a, Access::transfer_write, Access::transfer_read);
  ASSERT_TRUE(device->submit_frame().ok());
  ASSERT_TRUE(device->wait_idle().ok());
  begin();
  commands->fill_buffer(a, 0, 64, 0);
  EXPECT_THAT(faults(), IsEmpty());
}

TEST_F(RecordingDeviceTest, dead_objects_and_ranges_outside_are_faults) {
  const BufferHandle a = buffer("a");
  const BufferHandle dead = buffer("dead");
  device->destroy(dead);
  commands->fill_buffer(dead, 0, 4, 0);
  commands->fill_buffer(a, 60, 8, 0);
  commands->copy_buffer(a, 0, a, 32, 4);
  dispatch({3, Binding::BufferRange{.buffer = a, .offset = 32, .size = 64}});
  device->destroy(dead);
  EXPECT_THAT(faults(),
              ElementsAre("fill_buffer: a buffer that is not alive", "fill_buffer: out of the range of buffer 'a'",
                          "copy_buffer: copies nothing, or a buffer into itself",
                          "bind: binding 3 reaches past the end of buffer 'a'", "destroy: a buffer that is not alive"));
  EXPECT_EQ(device->validation_messages(), faults().size());
}

TEST_F(RecordingDeviceTest, commands_in_the_wrong_place_are_faults) {
  commands->draw(3, 1, 0, 0);
  commands->begin_rendering({.width = 4, .height = 4});
  commands->fill_buffer(buffer("a"), 0, 4, 0);
  EXPECT_THAT(faults(),
              ElementsAre("draw: only allowed between begin and end of rendering", "draw: no pipeline is bound",
                          "fill_buffer: not allowed between begin and end of rendering"));
}

TEST_F(RecordingDeviceTest, memory_and_pipelines_are_counted_by_module) {
  (void)buffer("a", 100);
  const ImageHandle picture = image("picture");
  const std::vector<ImageDesc> shared = {image_desc("x"), image_desc("y")};
  (void)device->create_aliased_images(shared).value();
  ASSERT_EQ(device->memory().size(), 1u);
  EXPECT_EQ(device->memory()[0].module, "test");
  EXPECT_EQ(device->memory()[0].bytes, 100u + 64 + 64);
  device->destroy(picture);
  EXPECT_EQ(device->memory()[0].bytes, 100u + 64);
  EXPECT_EQ(device->pipeline_count("test"), 1u);
  device->destroy(kernel);
  EXPECT_EQ(device->pipeline_count("test"), 0u);
}

TEST_F(RecordingDeviceTest, equal_sampler_descriptions_give_one_sampler) {
  const SamplerHandle linear = device->create_sampler({}).value();
  EXPECT_EQ(device->create_sampler({}).value(), linear);
  EXPECT_NE(device->create_sampler({.min_filter = Filter::nearest}).value(), linear);
}

TEST_F(RecordingDeviceTest, a_failure_can_be_asked_for_once) {
  device->fail_next_creation({.message = "no memory"});
  const auto failed = device->create_buffer({.name = "a", .size = 4});
  ASSERT_FALSE(failed.ok());
  EXPECT_EQ(failed.error().message, "no memory");
  EXPECT_TRUE(device->create_buffer({.name = "a", .size = 4}).ok());
}

TEST_F(RecordingDeviceTest, frames_complete_at_once_and_keep_their_timestamps_for_a_while) {
  commands->write_timestamp(0);
  commands->write_timestamp(1);
  next_frame();
  EXPECT_EQ(device->completed_frames(), 1u);
  const std::vector<std::uint64_t> stamps = device->timestamps(0);
  ASSERT_EQ(stamps.size(), Device::kTimestampsPerFrame);
  EXPECT_LT(stamps[0], stamps[1]);
  EXPECT_EQ(stamps[2], 0u);
  for (int i = 0; i < 8; ++i) next_frame();
  EXPECT_THAT(device->timestamps(0), IsEmpty());
}

TEST_F(RecordingDeviceTest, an_abandoned_frame_leaves_objects_in_the_states_of_the_frame_before) {
  const BufferHandle words = buffer("words");
  const ImageHandle picture = image("picture");
  const ImageHandle other = image("other");
  barrier(words, Access::none, Access::compute_write);
  barrier(picture, Access::none, Access::color_target);
  next_frame();
  barrier(words, Access::compute_write, Access::transfer_read);
  barrier(picture, Access::color_target, Access::transfer_read);
  barrier(other, Access::none, Access::color_target);
  commands->begin_label("half recorded");
  RenderingDesc rendering{.width = 4, .height = 4};
  rendering.colors.push_back({.view = {.image = other}});
  commands->begin_rendering(rendering);
  ASSERT_TRUE(device->abandon_frame().ok());
  EXPECT_EQ(device->frame_number(), 2u);
  EXPECT_EQ(device->completed_frames(), 2u);
  EXPECT_THAT(device->timestamps(1), IsEmpty());
  begin();
  barrier(words, Access::compute_write, Access::transfer_read);
  barrier(picture, Access::color_target, Access::transfer_read);
  EXPECT_THAT(faults(), IsEmpty());
  barrier(other, Access::color_target, Access::transfer_read);
  EXPECT_THAT(faults(), ElementsAre(HasSubstr("'other' is said to be in color_target")));
}

TEST_F(RecordingDeviceTest, support_of_a_format_can_be_withdrawn) {
  using enum ImageUsage;
  EXPECT_TRUE(device->supports(Format::rgba8_unorm, sampled | storage | color_target));
  EXPECT_FALSE(device->supports(Format::rgba8_unorm, depth_target));
  EXPECT_FALSE(device->supports(Format::d32_float, depth_target | storage));
  EXPECT_TRUE(device->supports_blit(Format::rgba8_unorm));
  EXPECT_FALSE(device->supports_blit(Format::r32_uint));
  device->withdraw_support(Format::rgba8_unorm, storage, true);
  EXPECT_FALSE(device->supports(Format::rgba8_unorm, sampled | storage));
  EXPECT_TRUE(device->supports(Format::rgba8_unorm, sampled));
  EXPECT_FALSE(device->supports_blit(Format::rgba8_unorm));
  const auto made = device->create_image(image_desc("picture"));
  ASSERT_FALSE(made.ok());
  EXPECT_THAT(made.error().message, HasSubstr("\"picture\" of module \"test\" could not be made: the device cannot use "
                                              "rgba8_unorm in that way (transfer_source, transfer_target, sampled, "
                                              "storage, color_target)"));
}

TEST_F(RecordingDeviceTest, misuse_asserts) {
  EXPECT_ASSERT((void)device->begin_frame(), "needs the frame before it to be submitted");
  EXPECT_ASSERT((void)device->mapped(buffer("a")), "device memory is not mapped");
  EXPECT_ASSERT((void)device->desc(BufferHandle{}), "not alive");
  EXPECT_ASSERT((void)device->create_buffer({.name = "empty"}), "at least one byte");
}

TEST_F(RecordingDeviceTest, a_host_that_records_natively_gets_no_command_buffer_and_has_the_list_to_itself) {
  EXPECT_EQ(commands->begin_native(7), nullptr);
  commands->end_native();
  EXPECT_THAT(faults(), IsEmpty());
  static_cast<void>(commands->begin_native({}));
  commands->fill_buffer(buffer("a"), 0, 16, 0);
  EXPECT_THAT(faults(), ElementsAre(HasSubstr("before the host's native commands have ended")));
  commands->end_native();
  commands->dispatch(1, 1, 1);
  EXPECT_THAT(faults().back(), HasSubstr("no pipeline is bound"));
}

}  // namespace
}  // namespace gloam::gpu
