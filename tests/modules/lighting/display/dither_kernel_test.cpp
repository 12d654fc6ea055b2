// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "modules/lighting/reference/kernel_checks.h"
#include "tests/support/kernel.h"

namespace gloam {
namespace {

class DitherKernel : public test::KernelTest {};

TEST_F(DitherKernel, rounds_as_double_precision_does) { expect_holds(lighting_kernel_checks()); }

}  // namespace
}  // namespace gloam
