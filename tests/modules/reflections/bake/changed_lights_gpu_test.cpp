// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "tests/modules/reflections/support/lamp_hall.h"

namespace gloam::test {
namespace {

/// The mean light of the floor with captures that were kept while lights changed is compared with that of new captures.
struct ChangedHall : LampHall {
  /// Floor light of kept captures over that of new ones, after `change`.
  [[nodiscard]] double kept_over_new(const char* tiers, const std::function<void()>& change) {
    capture_again();
    set("reflections.tiers", tiers);
    const double before = floor_light();
    change();
    const double kept = floor_light();
    capture_again();
    const double renewed = floor_light();
    EXPECT_GT(std::abs(renewed / before - 1.0), 0.2) << "the change is seen";
    return kept / renewed;
  }
  void judge(const std::string& what, const std::function<void()>& change, const std::function<void()>& undo) {
    for (const char* tiers : {"cube", "ibr+cube", "all"}) {
      const double ratio = kept_over_new(tiers, change);
      undo();
      RecordProperty(what + ", " + tiers, std::to_string(ratio));
      EXPECT_GT(ratio, 0.87) << what << ", " << tiers;
      EXPECT_LT(ratio, 1.15) << what << ", " << tiers;
    }
  }
  void judge_all(const std::string& scene_name) {
    judge(
        scene_name + "lights x 0.5", [&] { scale_lamps(0.5f); }, [&] { scale_lamps(2.0f); });
    judge(
        scene_name + "lights x 2", [&] { scale_lamps(2.0f); }, [&] { scale_lamps(0.5f); });
    judge(
        scene_name + "lights moved by 12 m", [&] { move_lamps(12.0); }, [&] { move_lamps(-12.0); });
    std::vector<Entity> more;
    judge(
        scene_name + "lights added",
        [&] {
          for (const double z : {-3.0, 3.0}) more.push_back(lamp({5.0, 3.0, z}, 600.0f));
        },
        [&] {
          for (const Entity entity : more) world.destroy(entity);
          more.clear();
        });
    judge(
        scene_name + "lights destroyed",
        [&] {
          for (const Entity entity : lamps) world.destroy(entity);
        },
        [&] {
          lamps.clear();
          for (const double x : {-8.0, -3.0})
            for (const double z : {-3.0, 3.0}) lamps.push_back(lamp({x, 3.5, z}, 400.0f));
        });
  }
};

// Hard case: reflections.lights_changed
TEST_F(ChangedHall, kept_captures_follow_lights_that_dim_brighten_move_come_and_go) { judge_all(""); }

// Hard case: reflections.lights_changed_emission
TEST_F(ChangedHall, kept_captures_follow_lights_beside_panels_that_shine) {
  add_panels();
  judge_all("panels, ");
}

}  // namespace
}  // namespace gloam::test
