// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/modules/shadows/support/final_lists/deferred_scene.h"

namespace gloam::test {

inline constexpr std::uint32_t kTilePixels = GLOAM_SHADOW_TILE;  // pixels of a tile's side

/// Compares final lists with and without classification, and with visualizer "shadow" at each pixel.
class ClassifyShadowsTest : public DeferredShadowsTest {
 protected:
  /// Pixels of a tile that the light certainly illuminates, shadows apart.
  [[nodiscard]] std::vector<std::size_t> certain_pixels(const ReadFinalLists& lists, const GeometryPicture& geometry,
                                                        const TileLight& of) const {
    std::vector<std::size_t> found;
    const Entity entity = of.directional ? lists.directional[of.light] : lists.local[of.light];
    const uvec2 first = uvec2(of.tile % lists.tiles.x, of.tile / lists.tiles.x) * kTilePixels;
    for (std::uint32_t i = 0; i < GLOAM_SLOT_PIXELS; ++i) {
      const uvec2 pixel = first + uvec2(i % kTilePixels, i / kTilePixels);
      if (pixel.x >= geometry.view.width || pixel.y >= geometry.view.height) continue;
      const std::size_t at_pixel = std::size_t{pixel.y} * geometry.view.width + pixel.x;
      if (!geometry.is_sky(at_pixel) && gives(entity, geometry, pixel, at_pixel)) found.push_back(i);
    }
    return found;
  }
  [[nodiscard]] bool gives(Entity entity, const GeometryPicture& geometry, uvec2 pixel, std::size_t at_pixel) const {
    const Light& what = world.get<Light>(entity);
    const dmat4& node = world.get<WorldTransform>(entity).matrix;
    const dvec3 shines = -glm::normalize(dvec3(node[2])), normal(geometry.texel(at_pixel).normal);
    if (what.kind == LightKind::directional) return glm::dot(normal, -shines) > 1e-2;
    const dvec3 offset = dvec3(node[3]) - geometry.view.position - geometry.position(pixel.x, pixel.y);
    const double distance = glm::length(offset);
    if (distance < 1e-3 || distance > 0.98 * static_cast<double>(what.range_m)) return false;
    const dvec3 to_light = offset / distance;
    const double limit = std::cos(0.98 * static_cast<double>(what.outer_angle));
    if (what.kind == LightKind::spot && glm::dot(-to_light, shines) < limit) return false;
    return glm::dot(normal, to_light) > 1e-2;
  }

  /// Expects that the view's lists with and without classification do not contradict each other.
  void expect_no_contradiction(const std::string& what) {
    set("shadows.classify", "off");
    const ReadFinalLists off = lists();
    set("shadows.classify", "on");
    const ReadFinalLists on = lists();
    ASSERT_EQ(off.frames + on.frames, 2u) << what;
    ASSERT_EQ(on.local, off.local);
    ASSERT_EQ(on.directional, off.directional);
    ASSERT_EQ(off.counters.fallback_tiles + on.counters.fallback_tiles, 0u) << what;
    EXPECT_EQ(off.counters.lit_at_once + off.counters.unlit_at_once, 0u) << what;
    expect_sums(off, what + ", off");
    expect_sums(on, what + ", on");
    const GeometryPicture geometry = value_of(renderer->read_geometry(world, settings.id));
    const auto filtered = off.all(), classified = on.all();
    std::ostringstream wrong;
    for (const auto& [place, visibility] : classified) {
      const auto other = filtered.find(place);
      if (other == filtered.end()) {
        // When the light illuminates no pixel, the filter drops it, but classification may keep it.
        if (!visibility.all_lit || !certain_pixels(on, geometry, place).empty())
          tell(wrong, place, "not in");
        else
          ++harmless;
      } else if (!(other->second == visibility)) {
        tell(wrong, place, "otherwise in");
      }
    }
    for (const auto& [place, visibility] : filtered)
      if (!classified.contains(place)) tell(wrong, place, "only in");
    EXPECT_EQ(wrong.str(), "") << what;
    lit += on.counters.lit_at_once;
    unlit += on.counters.unlit_at_once;
    open += on.counters.pairs;
    candidates += on.counters.candidates;
  }
  static void tell(std::ostringstream& out, const TileLight& place, const char* how) {
    out << (place.directional ? "sun " : "lamp ") << place.light << " of tile " << place.tile << ' ' << how
        << " what the filter finds\n";
  }
  /// Expects that every tile light has exactly one result.
  static void expect_sums(const ReadFinalLists& lists, const std::string& what) {
    const auto& c = lists.counters;
    EXPECT_EQ(c.candidates, c.unshadowed + c.lit_at_once + c.unlit_at_once + c.pairs) << what;
    EXPECT_EQ(c.pairs, c.lit_by_filter + c.unlit_by_filter + c.slots) << what;
    std::size_t listed = 0, slots = 0;
    for (std::uint32_t tile = 0; tile < lists.texels.size(); ++tile)
      for (const bool directional : {false, true})
        for (const std::uint32_t entry : lists.run(tile, directional)) {
          ++listed;
          slots += entry >> 10 < GLOAM_NO_ROOM ? 1 : 0;
        }
    EXPECT_EQ(listed, c.unshadowed + c.lit_at_once + c.lit_by_filter + c.slots) << what;
    EXPECT_EQ(slots, c.slots) << what;
  }
  /// Expects that the lists agree with what a fragment shader finds at each pixel.
  void expect_same_as_view(const std::string& what) {
    set("shadows.mode", "deferred");
    set("shadows.classify", "on");
    const ReadFinalLists on = lists();
    const GeometryPicture geometry = value_of(renderer->read_geometry(world, settings.id));
    const auto found = on.all();
    set("shadows.mode", "monolithic");
    for (const bool directional : {false, true}) {
      const std::vector<Entity>& kind = directional ? on.directional : on.local;
      for (std::uint32_t i = 0; i < kind.size(); ++i) {
        settings.visualizer = "shadow:" + names_.at(kind[i]);
        draw();
        settings.visualizer = "none";
        const ImageBytes image = value_of(renderer->read_image(world, settings.id, "shadow_visibility"));
        std::vector<float> seen(image.bytes.size() / sizeof(float));
        std::memcpy(seen.data(), image.bytes.data(), image.bytes.size());
        expect_light_as_seen(on, found, geometry, {0, directional, i}, seen, what);
      }
    }
    set("shadows.mode", "deferred");
  }
  void expect_light_as_seen(const ReadFinalLists& on, const std::map<TileLight, TileVisibility>& found,
                            const GeometryPicture& geometry, TileLight place, const std::vector<float>& seen,
                            const std::string& what) {
    const std::uint32_t width = geometry.view.width;
    std::size_t off = 0;
    std::string first;
    for (place.tile = 0; place.tile < on.texels.size(); ++place.tile) {
      const auto entry = found.find(place);
      for (const std::size_t i : certain_pixels(on, geometry, place)) {
        const std::uint32_t x = place.tile % on.tiles.x * kTilePixels + static_cast<std::uint32_t>(i) % kTilePixels;
        const std::uint32_t y = place.tile / on.tiles.x * kTilePixels + static_cast<std::uint32_t>(i) / kTilePixels;
        const float visible = seen[std::size_t{y} * width + x];
        const auto steps = static_cast<std::uint32_t>(std::lround(visible * static_cast<float>(on.most())));
        const std::uint32_t listed = entry == found.end()    ? 0
                                     : entry->second.all_lit ? on.most()
                                                             : entry->second.steps[i];
        ++compared;
        if (visible < 0.0f || listed == steps) continue;
        if (off++ == 0)
          first = std::to_string(x) + "," + std::to_string(y) + ": " + std::to_string(listed) + " listed, " +
                  std::to_string(steps) + " seen";
      }
    }
    EXPECT_EQ(off, 0u) << what << (place.directional ? ", sun " : ", lamp ") << place.light << " at " << first;
  }
  /// Builds a scene in which small differences decide whether classification is right.
  void close_scene(std::uint32_t seed, uvec2 size) {
    clear_scene();
    Dice dice(seed);
    const std::uint32_t kind = seed % 6;
    const double half = kind == 4 ? 400.0 : 2.5;
    put(plane_, flat(0.0) * glm::scale(dmat4(1.0), dvec3(half)));
    const auto thing = [&](std::size_t shape, const dvec3& place, const dvec3& size_m, double turn, const dvec3& axis) {
      put(shapes_[shape], glm::scale(glm::rotate(glm::translate(dmat4(1.0), place), turn, axis), size_m));
    };
    for (int i = 0; i < 10; ++i) {
      const dvec3 on_floor(dice.between(-1.2, 1.2), 0.0, dice.between(-1.2, 1.2));
      const double large = dice.between(0.1, 0.5), small = dice.between(0.02, 0.1);
      const dvec3 up(0.0, 1.0, 0.0);
      // Sheets and boxes millimetres above the floor.
      if (kind == 0)
        thing(dice.one_in(2) ? 3 : 6, on_floor + up * dice.between(0.001, 0.012), dvec3(large), 1.5707963,
              dvec3(1, 0, 0));
      // Small casters under wide lights.
      if (kind == 1)
        thing(dice.random() % 2, on_floor + up * dice.between(0.1, 1.5),
              dvec3(small, dice.one_in(3) ? 0.6 : small, small), 0.5, up);
      // Slanted plates above each other, some of them much larger than everything near them.
      if (kind == 2 && i < 4) {
        const double turn = dice.between(0.8, 2.3), apart = dice.between(0.003, 0.05), wide = i == 0 ? 1.5 : large;
        const dvec3 axis = glm::normalize(dvec3(1.0, 0.4 * dice.between(-1.0, 1.0), 0.0));
        thing(3, on_floor + up * 0.3, dvec3(wide), turn, axis);
        thing(3, on_floor + up * (0.3 + apart), dvec3(wide * 1.3), turn + dice.between(-0.02, 0.02), axis);
      }
      // Casters all around low lamps.
      if (kind == 3)
        thing(dice.random() % 2, on_floor + up * dice.between(0.0, 0.8), dvec3(large * 0.5), 0.7 * i,
              dvec3(0.6, 0.8, 0.0));
      // A plain with boxes near and far.
      if (kind == 4)
        thing(0, on_floor * dice.between(1.0, 12.0) + up * large,
              dvec3(large, 6.0 * large, large) * dice.between(0.5, 4.0), 0.4 * i, up);
      // Subsurface casters next to opaque ones.
      if (kind == 5) thing(i % 3 == 0 ? 4 : i % 3 == 1 ? 7 : 1, on_floor * 0.5 + up * 0.15, dvec3(0.3), 0.3 * i, up);
    }
    if (kind == 4 && dice.one_in(2)) put(plane_, flat(4.0) * glm::scale(dmat4(1.0), dvec3(half)));
    for (int i = 0; i < 3 && kind != 4; ++i) {
      Light made = dice.one_in(2) || kind == 3 ? point() : spot(dice.between(20.0, 70.0));
      made.width_m = kind == 1 ? dice.one_of({0.2f, 0.5f, 1.0f}) : dice.one_of({0.0f, 0.03f, 0.1f, 0.3f});
      const double height = kind == 3 ? dice.between(0.1, 0.5) : dice.between(0.5, 2.2);
      const dvec3 position(dice.between(-1.0, 1.0), height, dice.between(-1.0, 1.0));
      put_light(made, position, dvec3(0.4 * dice.between(-1.0, 1.0), -1.0, 0.3) - 0.3 * position,
                dice.one_of({64u, 256u, 512u}));
    }
    for (int i = 0; i < 3 && kind == 4; ++i)
      put_light(sun(dice.one_of({0.0f, 0.01f, 0.05f, 0.2f})), dvec3(0.0),
                dvec3(dice.between(-1.0, 1.0), -dice.between(0.2, 1.5), dice.between(-1.0, 1.0)),
                dice.one_of({64u, 256u}));
    const dvec3 eye(dice.between(-1.5, 1.5), kind == 4 ? dice.between(0.5, 6.0) : dice.between(0.2, 1.2),
                    dice.between(0.3, 1.6));
    settings =
        look_at(eye, kind == 4 ? dvec3(eye.x, 0.0, -8.0) : dice.in_box(dvec3(-0.5, 0.0, -0.5), dvec3(0.5, 0.1, 0.2)),
                size.x, size.y);
  }
  void print(const char* what) const {
    std::printf("%-40s %llu candidates: %llu lit, %llu unlit at once, %llu open; %llu harmless, %llu compared\n", what,
                count(candidates), count(lit), count(unlit), count(open), count(harmless), count(compared));
  }
  static unsigned long long count(std::uint64_t number) { return number; }

  std::uint64_t lit = 0, unlit = 0, open = 0, candidates = 0, harmless = 0, compared = 0;
};

/// A test parameter: knobs that differ from the defaults. Making other pipelines takes longer than drawing all scenes.
struct ClassifyWay {
  const char* name;
  std::vector<std::pair<const char*, const char*>> knobs;
  int scenes = 20;
  uvec2 size = uvec2(64, 48);
  bool close = false;  ///< scenes of close_scene() instead of random_scene()
  uvec2 ball_facets = uvec2(24, 12);
};
inline std::string name_of_way(const ::testing::TestParamInfo<ClassifyWay>& way) { return way.param.name; }

class ClassifyShadowsWays : public ClassifyShadowsTest, public ::testing::WithParamInterface<ClassifyWay> {
 protected:
  [[nodiscard]] uvec2 ball_facets() const override { return GetParam().ball_facets; }
  void run() {
    for (const auto& [knob, value] : GetParam().knobs) set(knob, value);
    const int count = scaled(GetParam().scenes);
    for (int seed = 0; seed < count; ++seed) {
      if (GetParam().close)
        close_scene(static_cast<std::uint32_t>(seed), GetParam().size);
      else
        random_scene(static_cast<std::uint32_t>(seed) * 977u + 3u, GetParam().size.x, GetParam().size.y);
      ASSERT_NO_FATAL_FAILURE(expect_no_contradiction("seed " + std::to_string(seed)));
      if (HasFailure()) return;
    }
    print(GetParam().name);
    EXPECT_GT(lit + unlit, 0u) << "nothing was classified";
  }
};

}  // namespace gloam::test
