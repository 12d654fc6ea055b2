// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "modules/shadows/filter/cookies.h"
#include "tests/modules/shadows/support/final_lists/reader.h"
#include "tests/modules/shadows/support/hard_shadows.h"
#include "tests/support/scale.h"

namespace gloam::test {

/// Random numbers.
struct Dice {
  explicit Dice(std::uint32_t seed) : random(seed) {}
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  bool one_in(unsigned count) { return random() % count == 0; }
  template <class T, std::size_t N>
  T one_of(const T (&items)[N]) {
    return items[random() % N];
  }
  dvec3 in_box(const dvec3& low, const dvec3& high) {
    return {between(low.x, high.x), between(low.y, high.y), between(low.z, high.z)};
  }
  dvec3 direction() {
    const dvec3 d = in_box(dvec3(-1.0), dvec3(1.0));
    return glm::length(d) < 0.01 ? dvec3(0.0, -1.0, 0.0) : glm::normalize(d);
  }
  std::mt19937 random;
};

/// Compares frames drawn with shadows.mode=deferred and monolithic, which must give the same picture. Also reads final
/// lists.
class DeferredShadowsTest : public HardShadows {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(HardShadows::SetUp());
    if (IsSkipped()) return;
    environment().exposure_ev100 = 1.0f;
    environment().sky_zenith = vec3(0.05f, 0.1f, 0.2f);
    environment().sky_horizon = vec3(0.1f);
    environment().sky_ground = vec3(0.02f);
    settings = look_at(dvec3(0.3, 2.2, 3.4), dvec3(0.0, 0.3, 0.0), 64, 48);
    set("shadows.visibility_bits", "8");
    set("shadows.atlas", "1024");
    set("shadows.mode", "deferred");
    make_shapes();
  }
  void TearDown() override {
    if (reader != nullptr) reader->wanted = false;
    HardShadows::TearDown();
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
    reader = added;
    return made;
  }

  /// Columns and rows of facets of opaque balls.
  [[nodiscard]] virtual uvec2 ball_facets() const { return uvec2(24, 12); }
  // Meshes of about one metre.
  void make_shapes() {
    Material leaf = exact_material(170, 180, 160, 255, 0), skin = leaf, grid = leaf, glass = leaf;
    leaf.double_sided = grid.double_sided = true;
    skin.subsurface = true;
    grid.alpha_mode = AlphaMode::mask;
    grid.base_color_texture.texture =
        scene.texture(4, 1, {255, 255, 255, 255, 255, 255, 255, 0, 255, 255, 255, 255, 255, 255, 255, 0}, true);
    glass.alpha_mode = AlphaMode::blend;
    glass.base_color.a = 0.4f;
    const auto mesh = [&](Primitive shape) { return scene.mesh(std::move(shape)); };
    plane_ = mesh(quad(1.0f, stone));
    pane_ = mesh(quad(0.5f, scene.material(glass)));
    shapes_ = {mesh(test::box(vec3(0.5f), stone)),
               mesh(round_ball(0.5f, ball_facets().x, ball_facets().y, stone)),
               mesh(quad(0.5f, stone)),
               mesh(quad(0.5f, scene.material(leaf))),
               mesh(test::box(vec3(0.5f), scene.material(skin))),
               mesh(quad(0.5f, scene.material(grid))),
               mesh(test::box(vec3(0.5f, 0.5f, 0.004f), stone)),
               mesh(ball(0.5f, scene.material(skin)))};
  }
  Entity put(std::uint32_t mesh, const dmat4& matrix) {
    return things.emplace_back(scene.draw(mesh, glm::translate(dmat4(1.0), origin) * matrix));
  }
  Entity put_light(const Light& what, const dvec3& position, const dvec3& direction = dvec3(0.0, -1.0, 0.0),
                   std::uint32_t resolution = 64, bool casts = true) {
    const Entity entity = light(what, origin + position, direction);
    names_[entity] = "lamp " + std::to_string(named_++);
    world.resource<SceneNames>().add("light", names_[entity], entity);
    world.add(entity, ShadowCaster{casts, resolution});
    lamps.push_back(entity);
    things.push_back(entity);
    return entity;
  }
  void clear_scene() {
    for (const Entity entity : things) world.destroy(entity);
    things.clear();
    lamps.clear();
  }
  /// Adds a floor and a wall.
  void put_room() {
    put(plane_, flat(0.0) * glm::scale(dmat4(1.0), dvec3(3.0)));
    put(plane_, at(0.0, 1.0, -2.0) * glm::scale(dmat4(1.0), dvec3(3.0)));
  }
  /// Adds a row of spots with a cookie above the room.
  void put_cookies(int count) {
    Cookies cookies;
    cookies.texels.push_back(resampled_cookie(
        Image{"quarters", 2, 2, {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255}}));
    cookies.version = static_cast<std::uint64_t>(count) + 1;
    const std::uint32_t name = world.resource<SceneStrings>().intern("quarters.png");
    cookies.layers[name] = 0;
    world.set_resource(std::move(cookies));
    for (int i = 0; i < count; ++i) {
      Light made = spot(35.0, 0.05f);
      made.intensity = 4.0f;
      made.cookie = name;
      put_light(made, dvec3(-1.0 + 0.45 * i, 1.7, 0.3), dvec3(0.1 * i - 0.2, -1.0, -0.3));
    }
  }
  void put_pillars() {
    put_room();
    for (int i = 0; i < 5; ++i)
      put(shapes_[0], glm::scale(at(-1.2 + 0.6 * i, 0.4, -0.3 - 0.2 * (i % 2)), dvec3(0.2, 0.8, 0.2)));
    put(shapes_[1], glm::scale(at(0.2, 0.9, 0.5), dvec3(0.5)));
  }
  void put_glass() {
    put(pane_, glm::scale(at(0.2, 0.7, 1.0), dvec3(1.6, 1.0, 1.0)));
    put(pane_, glm::rotate(at(-0.7, 0.5, 0.4), 0.7, dvec3(0.0, 1.0, 0.0)));
  }
  /// Adds a light of each kind.
  void put_three_lights() {
    put_light(point(0.08f), dvec3(0.5, 1.4, 0.9), dvec3(0.0, -1.0, 0.0), 128);
    put_light(spot(40.0, 0.1f), dvec3(-0.9, 1.8, 0.8), dvec3(0.4, -1.0, -0.6), 128);
    Light made = sun(0.05f);
    made.intensity = 1.0f;
    put_light(made, dvec3(0.0), dvec3(0.5, -1.0, -0.4), 256);
  }
  void put_things(Dice& dice, int count) {
    for (int i = 0; i < count; ++i) {
      dvec3 size(dice.between(0.1, 0.8), dice.between(0.1, 0.8), dice.between(0.1, 0.8));
      if (dice.one_in(6)) size.x = -size.x;
      const dmat4 place = glm::translate(dmat4(1.0), dice.in_box(dvec3(-1.4, 0.0, -1.4), dvec3(1.4, 1.3, 1.4)));
      put(shapes_[dice.random() % shapes_.size()],
          glm::scale(glm::rotate(place, dice.between(0.0, 3.1), dice.direction()), size));
    }
  }
  [[nodiscard]] static Light random_light(Dice& dice) {
    const float width = dice.one_of({0.0f, 0.0f, 0.02f, 0.1f, 0.4f});
    Light made = dice.one_in(2) ? point(width) : spot(dice.one_of({8.0, 25.0, 45.0, 59.0, 75.0}), width);
    made.intensity = static_cast<float>(dice.between(1.0, 8.0));
    made.range_m = dice.one_of({1.0f, 2.5f, 5.0f, 12.0f});
    made.color = vec3(dvec3(0.7) + 0.3 * dice.direction());
    return made;
  }
  void put_lights(Dice& dice, int count) {
    for (int i = 0; i < count; ++i)
      put_light(random_light(dice), dice.in_box(dvec3(-1.6, 0.1, -1.6), dvec3(1.6, 2.2, 1.6)),
                dice.direction() - dvec3(0.0, 0.6, 0.0), dice.one_of({32u, 64u, 128u}), !dice.one_in(7));
  }
  void put_suns(Dice& dice, int count) {
    for (int i = 0; i < count; ++i) {
      Light made = sun(dice.one_of({0.0f, 0.01f, 0.1f}));
      made.intensity = static_cast<float>(dice.between(0.5, 2.0));
      put_light(made, dvec3(0.0), dice.direction() - dvec3(0.0, 1.5, 0.0), 128, !dice.one_in(5));
    }
  }
  void random_camera(Dice& dice, std::uint32_t width, std::uint32_t height) {
    const dvec3 eye = dice.in_box(dvec3(-2.5, 0.2, 0.5), dvec3(2.5, 2.5, 3.5));
    const ViewId id = settings.id;
    settings = look_at(origin + eye, origin + dice.in_box(dvec3(-0.5, 0.0, -0.8), dvec3(0.5, 0.9, 0.3)), width, height);
    settings.id = id;
    settings.camera.near_m = dice.one_of({0.01f, 0.1f, 0.5f});
    settings.camera.fov_y = static_cast<float>(dice.between(0.4, 1.6));
    settings.camera.orthographic = dice.one_in(5);
    settings.camera.half_height_m = static_cast<float>(dice.between(0.5, 2.0));
    if (dice.one_in(2))
      settings.world_from_camera =
          settings.world_from_camera * glm::rotate(dmat4(1.0), dice.between(-3.1, 3.1), dvec3(0.0, 0.0, 1.0));
  }
  /// A room, casters, lights and maybe directional lights, from a random camera.
  void random_scene(std::uint32_t seed, std::uint32_t width = 64, std::uint32_t height = 48) {
    clear_scene();
    Dice dice(seed);
    if (!dice.one_in(6)) put_room();
    if (dice.one_in(2))
      put(shapes_[0], glm::scale(glm::rotate(at(dice.between(-1.0, 1.0), 0.3, -0.5), dice.between(0.2, 1.2),
                                             dvec3(1.0, 0.3, dice.between(-1.0, 1.0))),
                                 dvec3(1.5, 0.05, 1.2)));
    put_things(dice, 3 + static_cast<int>(dice.random() % 8));
    put_lights(dice, 1 + static_cast<int>(dice.random() % 7));
    put_suns(dice, static_cast<int>(dice.random() % 3));
    random_camera(dice, width, height);
  }

  /// The pictures of one frame.
  struct Drawn {
    LinearPicture light;
    Picture picture;
  };
  [[nodiscard]] Drawn frame(const char* mode) {
    set("shadows.mode", mode);
    draw();
    if (HasFatalFailure()) return {};
    Drawn drawn{linear(settings.id.value), picture(settings.id.value)};
    return drawn;
  }
  /// Draws one more frame and reads its final lists.
  [[nodiscard]] ReadFinalLists lists() {
    reader->wanted = true;
    draw();
    reader->wanted = false;
    return reader->read();
  }
  static void expect_finite(const Drawn& drawn, const std::string& what) {
    std::size_t bad = 0;
    for (const float channel : drawn.light.rgba) bad += std::isfinite(channel) && channel >= 0.0f ? 0 : 1;
    EXPECT_EQ(bad, 0u) << what;
  }
  /// Expects that channels differ by at most 1/255. The same limit holds for linear light before the tone curve,
  /// relative to its value, unless it is too dark or too bright to show.
  static void expect_same(const Drawn& a, const Drawn& b, const std::string& what) {
    ASSERT_EQ(a.picture.rgba.size(), b.picture.rgba.size()) << what;
    ASSERT_EQ(a.light.rgba.size(), b.light.rgba.size()) << what;
    int worst = 0;
    for (std::size_t i = 0; i < a.picture.rgba.size(); ++i)
      worst = std::max(worst, std::abs(int{a.picture.rgba[i]} - int{b.picture.rgba[i]}));
    EXPECT_LE(worst, 1) << what << ": steps of 255";
    std::size_t off = 0, first = 0;
    for (std::size_t i = 0; i < a.light.rgba.size(); ++i) {
      const float x = a.light.rgba[i], y = b.light.rgba[i];
      if (std::abs(x - y) <= (std::max(x, y) + 1e-3f) / 255.0f) continue;
      if (off++ == 0) first = i;
    }
    EXPECT_EQ(off, 0u) << what << ": light of " << a.light.rgba.size() << " channels; first at pixel "
                       << first / 4 % a.light.width << ',' << first / 4 / a.light.width << ": " << a.light.rgba[first]
                       << " and " << b.light.rgba[first];
  }
  /// Draws both modes and compares them. Returns the deferred frame.
  Drawn expect_deferred_is_monolithic(const std::string& what) {
    const Drawn monolithic = frame("monolithic");
    reader->wanted = true;
    Drawn deferred = frame("deferred");
    reader->wanted = false;
    if (HasFatalFailure()) return deferred;
    expect_ordered(reader->read(), what);
    expect_finite(monolithic, what + ", monolithic");
    expect_finite(deferred, what + ", deferred");
    expect_same(deferred, monolithic, what);
    return deferred;
  }
  /// Expects that entries ascend by light, that no two entries share a slot, and that no values of unfinished lists are
  /// left.
  static void expect_ordered(const ReadFinalLists& lists, const std::string& what) {
    std::vector<bool> taken(lists.slot_capacity, false);
    std::size_t slots = 0, wrong = 0, incomplete = 0;
    for (std::uint32_t tile = 0; tile < lists.texels.size(); ++tile) {
      incomplete += lists.complete(tile) ? 0 : 1;
      for (const bool directional : {false, true}) {
        std::int64_t last = -1;
        for (const std::uint32_t entry : lists.run(tile, directional)) {
          const std::uint32_t light_index = entry & 1023u, slot = entry >> 10;
          wrong += light_index > last && light_index < (directional ? lists.directional : lists.local).size() ? 0 : 1;
          last = light_index;
          if (slot == GLOAM_ALL_LIT) continue;
          const bool good = slot < lists.slot_capacity && slot < lists.counters.slots && !taken[slot];
          wrong += good ? 0 : 1;
          if (good) taken[slot] = true;
          ++slots;
        }
      }
    }
    EXPECT_EQ(wrong, 0u) << what << ": entries";
    EXPECT_EQ(incomplete, lists.counters.fallback_tiles) << what;
    EXPECT_TRUE(!lists.always_complete || incomplete == 0) << what;
    EXPECT_LE(slots, lists.counters.slots) << what;
  }
  [[nodiscard]] static bool is_one_color(const Picture& picture) {
    for (std::size_t i = 4; i < picture.rgba.size(); ++i)
      if (picture.rgba[i] != picture.rgba[i - 4]) return false;
    return true;
  }

  FinalListReader* reader = nullptr;
  dvec3 origin = dvec3(0.0);  ///< world position of the scene's origin
  std::vector<Entity> lamps;
  std::unordered_map<Entity, std::string> names_;
  std::vector<std::uint32_t> shapes_;
  std::uint32_t plane_ = 0;
  std::uint32_t pane_ = 0;
  int named_ = 0;
};

}  // namespace gloam::test
