// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "tests/modules/reflections/support/lamp_hall.h"

namespace gloam::test {
namespace {

/// The mean light of the floor with captures that were kept while lights changed is compared with that of new captures.
struct ChangedHall : LampHall {
  using Lights = std::array<double, 3>;
  static constexpr std::array<const char*, 3> kTiers = {"cube", "ibr+cube", "all"};

  /// Floor light with each choice of tiers.
  [[nodiscard]] Lights floor_lights() {
    Lights lights;
    for (std::size_t i = 0; i < kTiers.size(); ++i) {
      set("reflections.tiers", kTiers[i]);
      lights[i] = floor_light();
    }
    return lights;
  }
  /// Compares kept captures with new ones after `change`. Captures do not depend on the tiers that show them.
  void judge(const std::string& what, const std::function<void()>& change, const std::function<void()>& undo) {
    capture_again();
    const Lights before = floor_lights();
    change();
    const Lights kept = floor_lights();
    capture_again();
    const Lights renewed = floor_lights();
    undo();
    for (std::size_t i = 0; i < kTiers.size(); ++i) {
      const std::string name = what + ", " + kTiers[i];
      EXPECT_GT(std::abs(renewed[i] / before[i] - 1.0), 0.2) << name << ": the change is seen";
      const double ratio = kept[i] / renewed[i];
      RecordProperty(name, std::to_string(ratio));
      EXPECT_GT(ratio, 0.87) << name;
      EXPECT_LT(ratio, 1.15) << name;
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
