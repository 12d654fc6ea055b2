// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tests/modules/shadows/support/final_lists/classify.h"

// Classification where casters are close to receivers, to borders of maps and to borders of light.

namespace gloam {
namespace {

using Way = test::ClassifyWay;
struct ClassifyClose : test::ClassifyShadowsWays {};

TEST_P(ClassifyClose, never_contradict_the_filter) { run(); }

INSTANTIATE_TEST_SUITE_P(Of, ClassifyClose, ::testing::Values(Way{"standard", {}, 48, {80, 64}, true}),
                         test::name_of_way);

}  // namespace
}  // namespace gloam
