// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/jobs/pool/site_costs.h"

#include <gtest/gtest.h>

#include <memory>

namespace gloam {
namespace {

TEST(site_costs, knows_nothing_at_first) {
  const auto costs = std::make_unique<SiteCosts>();
  EXPECT_EQ(costs->recall(SiteCosts::site(typeid(int), 0)), kUnknownCost);
}

TEST(site_costs, recalls_what_it_learnt_and_follows_a_change) {
  const auto costs = std::make_unique<SiteCosts>();
  const SiteCosts::Site site = SiteCosts::site(typeid(int), 0);
  costs->learn(site, 100.0f);
  EXPECT_FLOAT_EQ(costs->recall(site), 100.0f);
  for (int i = 0; i < 30; ++i) costs->learn(site, 7.0f);
  EXPECT_NEAR(costs->recall(site), 7.0f, 0.01f);
}

TEST(site_costs, tells_types_and_salts_apart) {
  const auto costs = std::make_unique<SiteCosts>();
  costs->learn(SiteCosts::site(typeid(int), 0), 1.0f);
  EXPECT_EQ(costs->recall(SiteCosts::site(typeid(long), 0)), kUnknownCost);
  EXPECT_EQ(costs->recall(SiteCosts::site(typeid(int), 1)), kUnknownCost);
}

}  // namespace
}  // namespace gloam
