// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tests/modules/shadows/support/final_lists/classify.h"

// Classification with filters other than the standard one, each of which needs its own pipelines.

namespace gloam {
namespace {

using Way = test::ClassifyWay;
struct ClassifyFilters : test::ClassifyShadowsWays {};

TEST_P(ClassifyFilters, never_contradict_the_filter) { run(); }

INSTANTIATE_TEST_SUITE_P(
    Of, ClassifyFilters,
    ::testing::Values(
        Way{"hard_with_hardware_bias", {{"shadows.filter", "hard"}, {"shadows.bias", "hardware"}}, 12},
        Way{"pcf_of_16_bits", {{"shadows.filter", "pcf"}, {"shadows.depth", "d16"}}, 12},
        Way{"pcss_12", {{"shadows.filter", "pcss"}, {"shadows.kernel", "12"}}, 12},
        Way{"chs_4_of_mean_depths", {{"shadows.kernel", "4"}, {"shadows.mip_operator", "average"}}, 12},
        Way{"chs_16_square_without_receiver_plane",
            {{"shadows.kernel", "16"}, {"shadows.kernel_shape", "square"}, {"shadows.receiver_plane", "off"}},
            12},
        Way{"chs_8_without_mips", {{"shadows.mips", "off"}}, 12}),
    test::name_of_way);

}  // namespace
}  // namespace gloam
