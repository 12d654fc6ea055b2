// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/modules/shadows/support/final_lists/reader.h"
#include "tests/modules/shadows/support/hard_shadows.h"

namespace gloam::test {

/// A wall with boxes in front of it, sky beside it, and four lights: there are tiles that a light lights as a whole,
/// partly and not at all. Also reads the frame's final lists. The picture is so dark that visualizers are drawn over
/// black.
class FinalListScene : public HardShadows {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(HardShadows::SetUp());
    if (IsSkipped()) return;
    environment().exposure_ev100 = 40.0f;
    set("shadows.mode", "deferred");
    set("shadows.visibility_bits", "8");
    set("shadows.filter", "pcf");
    set("shadows.atlas", "1024");
    settings = look_at(dvec3(2.9, 0.3, 3.0), dvec3(3.0, 0.0, 0.0), 101, 63);
    thing(quad(4.0f, stone));
    put_box(dvec3(1.6, 0.1, 0.5), dvec3(0.25, 0.25, 0.1));
    put_box(dvec3(2.7, -0.2, 0.3), dvec3(0.3, 0.6, 0.1));
    put("lamp", point(), dvec3(1.4, 0.4, 1.0));
    Light near = point();
    near.range_m = 1.2f;
    put("near", near, dvec3(2.9, 0.1, 0.9));
    put("sun", sun(), dvec3(0.0), dvec3(0.4, -0.3, -1.0));
    world.get<ShadowCaster>(put("plain", spot(40.0), dvec3(2.2, 0.0, 2.0), dvec3(0.0, 0.0, -1.0))).enabled = false;
  }
  [[nodiscard]] SharedRenderer& shared() override {
    static FinalListReader* added = nullptr;
    static SharedRenderer made([this] {
      ModuleList modules = make_modules();
      auto last = std::make_unique<FinalListReader>();
      added = last.get();
      modules.push_back(std::move(last));
      return modules;
    }());
    reader_ = added;
    return made;
  }
  Entity put(const std::string& name, const Light& what, const dvec3& position,
             const dvec3& direction = dvec3(0.0, 0.0, -1.0)) {
    const Entity entity = things.emplace_back(light(what, position, direction));
    world.resource<SceneNames>().add("light", name, entity);
    world.add(entity, ShadowCaster{true, 128});
    return entity;
  }
  void put_box(const dvec3& center, const dvec3& half) {
    box(center, half);
    boxes_.push_back({center, half});
  }

  /// Draws the frame with a visualizer, and reads its final lists.
  [[nodiscard]] ReadFinalLists lists(const std::string& view = "none") {
    settings.visualizer = view;
    reader_->wanted = true;
    draw();
    reader_->wanted = false;
    settings.visualizer = "none";
    return reader_->read();
  }
  /// The image that visualizer "shadow:NAME" writes.
  [[nodiscard]] std::vector<float> visibility(const std::string& name) {
    settings.visualizer = "shadow:" + name;
    draw();
    settings.visualizer = "none";
    const ImageBytes image = value_of(renderer->read_image(world, settings.id, "shadow_visibility"));
    std::vector<float> values(image.bytes.size() / sizeof(float));
    std::memcpy(values.data(), image.bytes.data(), image.bytes.size());
    return values;
  }
  [[nodiscard]] Entity named(const std::string& name) {
    return value_of(world.resource<SceneNames>().find("light", name));
  }
  /// The light's entry in a tile's list; none when it has none.
  [[nodiscard]] std::optional<std::uint32_t> entry_of(const ReadFinalLists& lists, std::uint32_t tile,
                                                      const std::string& name) {
    for (const bool directional : {false, true})
      for (const std::uint32_t entry : lists.run(tile, directional))
        if ((directional ? lists.directional : lists.local).at(entry & 1023u) == named(name)) return entry;
    return std::nullopt;
  }
  [[nodiscard]] std::uint32_t tile_of(std::uint32_t x, std::uint32_t y) const {
    return y / 8 * ((settings.width + 7) / 8) + x / 8;
  }
  /// Whether a pixel shows the wall. All lights are in front of it.
  [[nodiscard]] bool shows_wall(std::uint32_t x, std::uint32_t y) const {
    const Ray r = ray(x, y);
    const dvec3 point = r.origin - r.direction * (r.origin.z / r.direction.z);
    return std::max(std::abs(point.x), std::abs(point.y)) < 3.99 && !is_hidden(r.origin, point);
  }
  void remove_light(const std::string& name) {
    std::erase(things, named(name));
    world.destroy(named(name));
  }

 private:
  struct Box {
    dvec3 center;
    dvec3 half;
  };
  /// Whether a box lies between two points.
  [[nodiscard]] bool is_hidden(const dvec3& from, const dvec3& to) const {
    return std::any_of(boxes_.begin(), boxes_.end(), [&](const Box& b) {
      double enter = 0.0, leave = 1.0;
      for (int axis = 0; axis < 3; ++axis) {
        const double one = (b.center[axis] - b.half[axis] - from[axis]) / (to[axis] - from[axis]);
        const double other = (b.center[axis] + b.half[axis] - from[axis]) / (to[axis] - from[axis]);
        enter = std::max(enter, std::min(one, other));
        leave = std::min(leave, std::max(one, other));
      }
      return enter < leave;
    });
  }

  std::vector<Box> boxes_;
  FinalListReader* reader_ = nullptr;
};

}  // namespace gloam::test
