// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <sstream>
#include <string>
#include <utility>

#include "engine/core/env.h"
#include "tests/support/scale.h"

namespace gloam::test {

/// Checks a RapidCheck property (a callable that draws with *rc::gen… and uses RC_ASSERT) on scaled(count) cases,
/// inside a GoogleTest body. The seed is fixed, so that runs repeat, unless the environment variable RC_PARAMS ("seed=…
/// max_size=…") is set.
template <class Testable>
void check_property(int count, Testable&& property) {
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  const rc::detail::TestMetadata metadata{std::string(info->test_suite_name()) + "/" + info->name(), info->name()};
  rc::detail::TestParams params = rc::detail::configuration().testParams;
  if (!environment_text("RC_PARAMS")) params.seed = 20240621;
  params.maxSuccess = scaled(count);
  const auto result = rc::detail::checkTestable(std::forward<Testable>(property), metadata, params);
  if (result.template is<rc::detail::SuccessResult>()) return;
  std::ostringstream text;
  rc::detail::printResultMessage(result, text);
  ADD_FAILURE() << text.str();
}

}  // namespace gloam::test
