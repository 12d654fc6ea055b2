// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/types.h"

#include <gtest/gtest.h>

#include "engine/gpu/image_size.h"

#include <set>

namespace gloam::gpu {
namespace {

TEST(Types, every_format_has_a_name_of_its_own_and_a_size) {
  std::set<std::string_view> names;
  for (int i = 0; i <= static_cast<int>(Format::d32_float); ++i) {
    const auto format = static_cast<Format>(i);
    EXPECT_TRUE(names.insert(name_of(format)).second) << name_of(format);
    EXPECT_EQ(bytes_per_texel(format) == 0, format == Format::undefined) << name_of(format);
  }
  EXPECT_EQ(name_of(Format::rgb10a2_unorm), "rgb10a2_unorm");
  EXPECT_EQ(bytes_per_texel(Format::rgb32_float), 12u);
  EXPECT_EQ(bytes_per_texel(Format::rgba16_float), 8u);
  EXPECT_EQ(name_of(Format::r16_unorm), "r16_unorm");
  EXPECT_EQ(bytes_per_texel(Format::r16_unorm), 2u);
}

TEST(Types, mips_of_volumes_halve_all_three_sides) {
  const ImageDesc desc = {
      .format = Format::r16_float, .width = 5, .height = 3, .mips = 3, .shape = ImageShape::volume, .depth = 4};
  EXPECT_EQ(mip_bytes(desc, 0), 5u * 3 * 4 * 2);
  EXPECT_EQ(mip_bytes(desc, 1), 2u * 1 * 2 * 2);
  EXPECT_EQ(image_bytes(desc), 120u + 8 + 2);
  EXPECT_EQ(full_mip_count(desc), 3u);
}

TEST(Types, only_the_depth_format_is_depth) {
  EXPECT_TRUE(is_depth(Format::d32_float));
  EXPECT_FALSE(is_depth(Format::r32_float));
}

TEST(Types, accesses_that_change_memory_are_writes) {
  EXPECT_TRUE(is_write(Access::transfer_write));
  EXPECT_TRUE(is_write(Access::compute_write));
  EXPECT_TRUE(is_write(Access::fragment_write));
  EXPECT_TRUE(is_write(Access::color_target));
  EXPECT_TRUE(is_write(Access::depth_target));
  for (const Access read : {Access::none, Access::transfer_read, Access::host_read, Access::vertex_input,
                            Access::indirect_read, Access::uniform_read, Access::vertex_read, Access::fragment_read,
                            Access::compute_read, Access::compute_storage_read, Access::depth_test, Access::present}) {
    EXPECT_FALSE(is_write(read)) << name_of(read);
  }
}

TEST(Types, names_match_their_enumerators) {
  EXPECT_EQ(name_of(Access::none), "none");
  EXPECT_EQ(name_of(Access::compute_storage_read), "compute_storage_read");
  EXPECT_EQ(name_of(Access::present), "present");
  EXPECT_EQ(name_of(DeviceType::cpu), "cpu");
}

}  // namespace
}  // namespace gloam::gpu
