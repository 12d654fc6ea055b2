// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/math/srgb.h"
#include "modules/shadows/debug/final_list_views.h"

#include <gmock/gmock.h>

#include <cmath>
#include <set>

#include "engine/ecs/view.h"
#include "tests/modules/shadows/support/final_lists/scene.h"

namespace gloam {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;

int encoded(double linear) { return static_cast<int>(std::lround(255.0 * linear_to_srgb(linear))); }

/// As shaders/common/heat.glsl.
dvec3 heat(double share) {
  const dvec3 stops[] = {dvec3(0.0),        {0.02, 0.05, 0.6}, {0.0, 0.45, 0.6},
                         {0.05, 0.5, 0.05}, {0.8, 0.6, 0.0},   {0.8, 0.02, 0.02}};
  if (share > 1.0) return dvec3(1.0);
  const int low = std::min(static_cast<int>(5.0 * share), 4);
  return glm::mix(stops[low], stops[low + 1], 5.0 * share - low);
}

const dvec3 kMagenta(0.8, 0.0, 0.8);
const dvec3 kYellow(0.75, 0.9, 0.2);
const dvec3 kBlue(0.02, 0.1, 0.6);

dvec3 green(double visibility) { return glm::mix(dvec3(0.0, 0.05, 0.0), dvec3(0.05, 0.8, 0.05), visibility); }

class FinalListViews : public test::FinalListScene {
 protected:
  [[nodiscard]] Picture drawn_view(const std::string& view) {
    static_cast<void>(lists(view));
    return picture();
  }
  /// Whether a pixel shows a linear colour, drawn with this opacity over black. Pixels on the grid of tiles are darker.
  [[nodiscard]] static bool shows(const Picture& p, std::uint32_t x, std::uint32_t y, const dvec3& color,
                                  double opacity) {
    const std::uint8_t* t = &p.rgba[4 * (std::size_t{y} * p.width + x)];
    const double grid = x % 8 == 0 || y % 8 == 0 ? 0.6 : 1.0;
    int off = 0;
    for (int c = 0; c < 3; ++c) off = std::max(off, std::abs(t[c] - encoded(color[c] * opacity * grid)));
    return off <= 2;
  }
  [[nodiscard]] static bool is_black(const Picture& p, std::uint32_t x, std::uint32_t y) {
    return shows(p, x, y, dvec3(0.0), 1.0);
  }
  template <class F>
  void for_pixels(F&& function) const {
    for (std::uint32_t y = 0; y < settings.height; ++y)
      for (std::uint32_t x = 0; x < settings.width; ++x) function(x, y);
  }
  /// Whether a pixel shows what a count visualizer draws for a tile with `count` lights, of which `stored` have a slot.
  [[nodiscard]] static bool shows_counts(const Picture& p, std::uint32_t x, std::uint32_t y, bool slots, int count,
                                         int stored) {
    if (!slots) return shows(p, x, y, heat(count / 31.0), 1.0);
    if (stored > 0) return shows(p, x, y, heat(stored / 10.0), 0.75);
    return is_black(p, x, y) || (count == 0 && shows(p, x, y, 0.25 * kBlue, 0.75));
  }
  /// Compares both count visualizers with the lists of the same frame. Returns the numbers of slots that occurred, −1
  /// for tiles without a list.
  std::set<int> expect_counts_of_lists() {
    std::set<int> met;
    for (const bool slots : {false, true}) {
      const test::ReadFinalLists read = lists(slots ? "visibility_slots" : "lights_final");
      const Picture p = picture();
      int wrong = 0;
      for_pixels([&](std::uint32_t x, std::uint32_t y) {
        const std::uint32_t tile = tile_of(x, y);
        int count = 0, stored = 0;
        for (const bool directional : {false, true})
          for (const std::uint32_t entry : read.run(tile, directional)) {
            ++count;
            stored += entry >> 10 != GLOAM_ALL_LIT ? 1 : 0;
          }
        const bool complete = read.complete(tile);
        met.insert(complete ? stored : -1);
        wrong += (complete ? shows_counts(p, x, y, slots, count, stored) : shows(p, x, y, kMagenta, slots ? 0.95 : 1.0))
                     ? 0
                     : 1;
      });
      EXPECT_EQ(wrong, 0) << (slots ? "visibility_slots" : "lights_final");
    }
    return met;
  }
  enum class State { dark, lit, slot, left_out, fallback };
  /// Compares visualizer light_list with the final lists, and with the same visualizer of early lists. Returns the
  /// states that occurred.
  std::set<State> expect_states_of_lists(const std::string& name) {
    set("shadows.mode", "monolithic");
    const Picture early = name == "sun" ? Picture{} : drawn_view("light_list:" + name);
    set("shadows.mode", "deferred");
    const test::ReadFinalLists read = lists("light_list:" + name);
    const Picture p = picture();
    std::set<State> met;
    int wrong = 0;
    for_pixels([&](std::uint32_t x, std::uint32_t y) {
      const std::uint32_t tile = tile_of(x, y);
      // Without early lists of the light, an entry in the final list proves that it was a candidate.
      const auto entry = entry_of(read, tile, name);
      const bool held = early.width > 0 ? !is_black(early, x, y) : entry.has_value() || !is_black(p, x, y);
      State state = State::dark;
      if (held) state = !read.complete(tile) ? State::fallback : !entry ? State::left_out : State::slot;
      dvec3 color = state == State::fallback ? kMagenta : state == State::left_out ? kBlue : dvec3(0.0);
      if (state == State::slot) {
        const test::TileVisibility seen = read.visibility(*entry);
        if (seen.all_lit) state = State::lit;
        color = seen.all_lit ? kYellow : green(static_cast<double>(seen.steps[y % 8 * 8 + x % 8]) / read.most());
      }
      met.insert(state);
      wrong += shows(p, x, y, color, 0.75) ? 0 : 1;
    });
    EXPECT_EQ(wrong, 0) << name;
    return met;
  }
  /// Compares visualizer "shadow:NAME" with shadow maps, where the light illuminates the surface.
  void expect_visibility_of_maps(const std::string& name) {
    set("shadows.mode", "monolithic");
    const std::vector<float> maps = visibility(name);
    set("shadows.mode", "deferred");
    const std::vector<float> shown = visibility(name);
    int wrong = 0, unreached = 0;
    for_pixels([&](std::uint32_t x, std::uint32_t y) {
      const std::size_t at = std::size_t{y} * settings.width + x;
      unreached += (shown[at] < 0.0f) == (maps[at] < 0.0f) ? 0 : 1;
      if (shows_wall(x, y)) wrong += std::abs(shown[at] - maps[at]) < 1e-6f ? 0 : 1;
    });
    EXPECT_EQ(wrong, 0) << name;
    EXPECT_EQ(unreached, 0) << name;
  }
  /// Cosine between the surface's normal and the way to the light.
  [[nodiscard]] double cosine_to(const std::string& name, const GeometryPicture& geometry, std::uint32_t x,
                                 std::uint32_t y) {
    const Entity lamp = named(name);
    const dmat4& node = world.get<WorldTransform>(lamp).matrix;
    const dvec3 to_light = world.get<Light>(lamp).kind == LightKind::directional
                               ? dvec3(node[2])
                               : dvec3(node[3]) - geometry.position(x, y) - geometry.view.position;
    const std::size_t at = std::size_t{y} * settings.width + x;
    return glm::dot(dvec3(geometry.texel(at).normal), glm::normalize(to_light));
  }
  /// Compares visualizer "shadow:NAME" with the final lists where the surface faces the light; elsewhere it must be
  /// dark.
  void expect_visibility_of_lists(const std::string& name) {
    const test::ReadFinalLists read = lists();
    const std::vector<float> shown = visibility(name);
    const GeometryPicture geometry = test::value_of(renderer->read_geometry(world, settings.id));
    int wrong = 0, seen = 0, lit_behind = 0;
    for_pixels([&](std::uint32_t x, std::uint32_t y) {
      const std::size_t at = std::size_t{y} * settings.width + x;
      if (shown[at] < 0.0f) return;
      const double cosine = cosine_to(name, geometry, x, y);
      if (cosine < -1e-3) lit_behind += shown[at] == 0.0f ? 0 : 1;
      if (cosine < 1e-3) return;
      const auto entry = entry_of(read, tile_of(x, y), name);
      const test::TileVisibility held = entry ? read.visibility(*entry) : test::TileVisibility{};
      const float steps = static_cast<float>(held.steps[y % 8 * 8 + x % 8]) / static_cast<float>(read.most());
      wrong += std::abs(shown[at] - (held.all_lit ? 1.0f : steps)) < 1e-6f ? 0 : 1;
      seen += shown[at] > 0.0f ? 1 : 0;
    });
    EXPECT_EQ(wrong, 0) << name;
    EXPECT_EQ(lit_behind, 0) << name;
    EXPECT_GT(seen, 100) << name;
  }
};

TEST_F(FinalListViews, show_what_the_lists_of_every_tile_hold) {
  const std::set<int> met = expect_counts_of_lists();
  EXPECT_TRUE(met.contains(0));
  EXPECT_TRUE(met.contains(1));
  EXPECT_GE(*met.rbegin(), 2);
  using enum State;
  EXPECT_EQ(expect_states_of_lists("lamp"), (std::set{dark, lit, slot, left_out}));
  EXPECT_THAT(expect_states_of_lists("near"), IsSupersetOf({dark, lit, slot}));
  EXPECT_EQ(expect_states_of_lists("plain"), (std::set{dark, lit}));
  EXPECT_TRUE(expect_states_of_lists("sun").contains(slot));
  for (const char* light : {"lamp", "near", "sun"}) {
    expect_visibility_of_lists(light);
    expect_visibility_of_maps(light);
  }
  EXPECT_THAT(warnings, IsEmpty());
}

TEST_F(FinalListViews, name_tiles_that_found_no_room) {
  for (const char* limit : {"0", "20"}) {
    set("shadows.slot_limit", limit);
    const std::set<int> met = expect_counts_of_lists();
    EXPECT_TRUE(met.contains(-1));
    EXPECT_TRUE(met.contains(0));
    EXPECT_EQ(*met.rbegin() > 0, std::string(limit) != "0");
    EXPECT_TRUE(expect_states_of_lists("lamp").contains(State::fallback));
    for (const char* light : {"lamp", "sun"}) expect_visibility_of_maps(light);
  }
}

TEST_F(FinalListViews, are_right_without_local_lights_directional_lights_and_surfaces) {
  for (const char* gone : {"plain", "lamp", "near"}) remove_light(gone);
  EXPECT_TRUE(expect_counts_of_lists().contains(1));
  EXPECT_TRUE(expect_states_of_lists("sun").contains(State::slot));
  expect_visibility_of_lists("sun");
  remove_light("sun");
  put("other", point(), dvec3(1.4, 0.4, 1.0));
  EXPECT_TRUE(expect_counts_of_lists().contains(1));
  EXPECT_TRUE(expect_states_of_lists("other").contains(State::slot));
  expect_visibility_of_lists("other");
  std::vector<Entity> surfaces;
  world.view<const MeshInstance>().each([&](Entity e, const MeshInstance&) { surfaces.push_back(e); });
  for (const Entity e : surfaces) world.destroy(e);
  for (const char* view : {"lights_final", "visibility_slots", "light_list:other"}) {
    const Picture p = drawn_view(view);
    int shown = 0;
    for_pixels([&](std::uint32_t x, std::uint32_t y) { shown += is_black(p, x, y) ? 0 : 1; });
    EXPECT_EQ(shown, 0) << view;
  }
}

TEST_F(FinalListViews, say_why_there_is_nothing_to_show) {
  for (const auto& [knob, value, back] :
       {std::tuple("shadows.visibility_bits", "exact", "8"), {"lights.culling", "brute", "tiled"}}) {
    set(knob, value);
    static_cast<void>(drawn_view("visibility_slots"));
    static_cast<void>(drawn_view("visibility_slots"));
    EXPECT_THAT(
        warnings,
        ElementsAre(std::string("view visibility_slots shows the picture as it is: there are no final lists with ") +
                    knob + "=" + value));
    warnings.clear();
    set(knob, back);
  }
  for (const char* view : {"visibility_slots", "lights_final", "shadow:lamp", "shadow_atlas", "light_list:lamp"})
    EXPECT_TRUE(renderer->check_visualizer(world, view).ok()) << view;
  for (const char* light : {"lamp", "near", "plain"}) world.get<ShadowCaster>(named(light)).enabled = false;
  world.get<ShadowCaster>(named("sun")).enabled = false;
  static_cast<void>(drawn_view("lights_final"));
  EXPECT_THAT(warnings, ElementsAre("view lights_final shows the picture as it is: no light casts shadows"));
  set("shadows.mode", "monolithic");
  EXPECT_THAT(renderer->check_visualizer(world, "visibility_slots").error().message,
              HasSubstr("needs shadows.mode=deferred"));
  EXPECT_TRUE(renderer->check_visualizer(world, "shadow:lamp").ok());
  set("shadows.mode", "off");
  EXPECT_THAT(renderer->check_visualizer(world, "shadow:lamp").error().message,
              HasSubstr("needs shadows.mode=monolithic|deferred"));
}

TEST_F(FinalListViews, have_a_name_once_and_a_legend_that_the_font_can_write) {
  std::set<std::string> names;
  for (const VisualizerInfo& view : renderer->visualizers()) {
    EXPECT_TRUE(names.insert(view.name).second) << view.name;
    EXPECT_TRUE(std::all_of(view.legend.begin(), view.legend.end(), [](char c) { return c >= ' ' && c <= '~'; }))
        << view.name;
  }
  for (const VisualizerInfo& view : final_list_visualizers()) EXPECT_TRUE(names.contains(view.name));
  for (const char* name : {"visibility_slots", "lights_final", "light_list", "shadow"})
    EXPECT_TRUE(names.contains(name)) << name;
}

TEST_F(FinalListViews, of_a_light_out_of_view_are_dark_and_say_so_once) {
  put("behind", point(), dvec3(0.0, 0.0, 40.0));
  for (int frame = 0; frame < 2; ++frame) {
    const Picture p = drawn_view("light_list:behind");
    int shown = 0;
    for_pixels([&](std::uint32_t x, std::uint32_t y) { shown += is_black(p, x, y) ? 0 : 1; });
    EXPECT_EQ(shown, 0);
  }
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("light_list:behind shows no tile")));
}

}  // namespace
}  // namespace gloam
