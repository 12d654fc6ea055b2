// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/views/view_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "engine/gpu/recording/device.h"
#include "engine/render/renderer_options.h"
#include "engine/render/views/read_picture.h"
#include "engine/render/views/view_checks.h"
#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class ViewStoreTest : public ::testing::Test {
 protected:
  void TearDown() override { EXPECT_THAT(device_->faults(), IsEmpty()); }
  [[nodiscard]] static ViewRequest request(std::uint32_t id, std::uint32_t width = 64, std::uint32_t height = 40) {
    ViewRequest request;
    request.settings.id = ViewId{id};
    request.settings.width = width;
    request.settings.height = height;
    return request;
  }
  /// A submitted frame of world 1 with these views.
  void draw(const std::vector<ViewRequest>& requests) {
    for (const ViewRequest& request : requests) ASSERT_TRUE(views_.prepare(1, request).ok());
    views_.commit(requests);
    views_.free_idle_images();
  }

  std::unique_ptr<gpu::RecordingDevice> device_ = gpu::make_recording_device();
  ViewStore views_{*device_};
};

TEST_F(ViewStoreTest, images_are_kept_while_the_size_stays) {
  draw({request(0)});
  const gpu::ImageHandle lit = views_.at(ViewId{0}).lit;
  draw({request(0)});
  EXPECT_EQ(views_.at(ViewId{0}).lit, lit);
  draw({request(0, 65)});
  EXPECT_NE(views_.at(ViewId{0}).lit, lit);
  EXPECT_EQ(device_->desc(views_.at(ViewId{0}).lit).width, 65u);
}

TEST_F(ViewStoreTest, a_view_with_a_target_has_no_picture) {
  draw({request(0)});
  EXPECT_TRUE(views_.at(ViewId{0}).picture);
  ViewRequest with_target = request(0);
  with_target.target.light = LightTarget{};
  draw({with_target});
  EXPECT_FALSE(views_.at(ViewId{0}).picture);
  EXPECT_TRUE(views_.at(ViewId{0}).lit);
}

TEST_F(ViewStoreTest, views_that_are_not_drawn_lose_their_images_and_their_request) {
  draw({request(0), request(1)});
  for (std::uint32_t frame = 1; frame < kFramesUntilRelease; ++frame) draw({request(0)});
  EXPECT_NE(views_.find(ViewId{1}), nullptr);
  draw({request(0)});
  EXPECT_EQ(views_.find(ViewId{1}), nullptr);
  EXPECT_NE(views_.find(ViewId{0}), nullptr);
  views_.release_view(ViewId{0});
  EXPECT_EQ(views_.find(ViewId{0}), nullptr);
  EXPECT_THAT(views_.last_requests(), IsEmpty());
}

TEST_F(ViewStoreTest, the_views_that_a_world_drew_last_go_with_it) {
  ASSERT_TRUE(views_.prepare(1, request(0)).ok());
  ASSERT_TRUE(views_.prepare(2, request(1)).ok());
  views_.release_world(1);
  EXPECT_EQ(views_.find(ViewId{0}), nullptr);
  EXPECT_NE(views_.find(ViewId{1}), nullptr);
}

TEST_F(ViewStoreTest, companions_that_are_not_drawn_are_reported_once) {
  const ViewId companion{7};
  EXPECT_THAT(views_.take_idle_companions(std::vector{companion}), IsEmpty());
  for (std::uint32_t frame = 1; frame < kFramesUntilRelease; ++frame)
    EXPECT_THAT(views_.take_idle_companions({}), IsEmpty());
  EXPECT_THAT(views_.take_idle_companions({}), SizeIs(1));
  EXPECT_THAT(views_.take_idle_companions({}), IsEmpty());
}

TEST_F(ViewStoreTest, pictures_of_views_that_were_not_drawn_cannot_be_read) {
  const auto absent = read_picture(views_, ViewId{3}, *device_);
  ASSERT_FALSE(absent.ok());
  EXPECT_EQ(absent.error().kind, ErrorKind::usage);
  EXPECT_THAT(absent.error().message, HasSubstr("view 3: read_picture needs a view"));
  ASSERT_TRUE(views_.prepare(1, request(3)).ok());
  const auto picture = read_picture(views_, ViewId{3}, *device_);
  ASSERT_FALSE(picture.ok());
  EXPECT_THAT(picture.error().message, HasSubstr("its frames were given up"));
  views_.commit(std::vector{request(3)});
  views_.set_lit(ViewId{3}, false, 1.0f);
  EXPECT_ASSERT((void)read_linear(views_, ViewId{3}, *device_), "needs a frame drawn with ViewRequest::keep_linear");
}

TEST_F(ViewStoreTest, ids_are_checked_before_a_frame) {
  check_ids(std::vector{request(0), request(1)});
  EXPECT_ASSERT(check_ids(std::vector{request(2), request(2)}), "view 2 is requested twice");
  EXPECT_ASSERT(check_ids(std::vector{request(CompanionViews::kFirstId)}), "are for companions");
}

// Hard case: further.size_largest
TEST_F(ViewStoreTest, sizes_up_to_the_limit_are_accepted) {
  EXPECT_TRUE(check_size(request(0, kMostViewPixels, 1).settings).ok());
  const Status wide = check_size(request(5, kMostViewPixels + 1, 1).settings);
  ASSERT_FALSE(wide.ok());
  EXPECT_EQ(wide.error().kind, ErrorKind::usage);
  EXPECT_THAT(wide.error().message, HasSubstr("view 5 is 16385x1 pixels"));
}

TEST_F(ViewStoreTest, an_acquired_target_gives_the_view_its_size) {
  gpu::ImageDesc desc;
  desc.name = "swapchain";
  desc.module = "test";
  desc.format = gpu::Format::bgra8_srgb;
  desc.width = 31;
  desc.height = 17;
  desc.usage = gpu::ImageUsage::color_target;
  const gpu::ImageHandle image = device_->create_image(desc).value();
  ViewRequest wanted = request(0);
  wanted.target.acquire = [&]() -> Result<gpu::ImageHandle> { return image; };
  ASSERT_TRUE(acquire_target(*device_, wanted).ok());
  EXPECT_EQ(wanted.settings.width, 31u);
  EXPECT_EQ(wanted.settings.height, 17u);
  check_target(*device_, wanted);
  wanted.settings.height = 18;
  EXPECT_ASSERT(check_target(*device_, wanted), "must have one size");
  device_->destroy(image);
}

}  // namespace
}  // namespace gloam
