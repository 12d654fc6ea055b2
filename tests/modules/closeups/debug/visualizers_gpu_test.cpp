// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "modules/closeups/components.h"
#include "modules/closeups/debug/visualizers.h"
#include "modules/shadows/views/faces.h"
#include "tests/modules/shadows/support/final_lists/deferred_scene.h"

// Close-up visualizers and pixel picking, checked against projections computed from the camera's lens.

namespace gloam::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

/// A projected point: pixels, and distance in front of the camera.
struct Projected {
  double x = 0.0;
  double y = 0.0;
  double ahead_m = 0.0;
};

class CloseupViewsTest : public DeferredShadowsTest {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(DeferredShadowsTest::SetUp());
    if (IsSkipped()) return;
    set("shadows.filter", "hard");
    settings = look_at(dvec3(0.3, 2.2, 3.4), dvec3(0.0, 0.3, 0.0), 150, 109);
    put_room();
    put(shapes_[0], glm::scale(glm::rotate(at(-0.6, 0.3, -0.4), 0.4, dvec3(0.0, 1.0, 0.0)), dvec3(0.4, 0.6, 0.4)));
    world.add(put(shapes_[1], glm::scale(at(0.2, 0.75, 0.3), dvec3(0.4))), CloseupSubject{true});
  }
  void put_lamp(LightKind kind) {
    if (kind == LightKind::point) put_light(point(), dvec3(0.9, 1.9, 0.9), dvec3(0.0, -1.0, 0.0), 128);
    if (kind == LightKind::spot) put_light(spot(45.0), dvec3(-0.5, 2.0, 1.0), dvec3(0.3, -1.0, -0.4), 128);
    if (kind == LightKind::directional) put_light(sun(), dvec3(0.0), dvec3(0.4, -1.0, -0.3), 256);
  }
  void take_lamps_away() {
    for (const Entity lamp : std::exchange(lamps, {})) world.remove<Light>(lamp);
  }
  /// Draws a few frames, so that pairs exist and buffer sizes have settled.
  [[nodiscard]] Picture shown(const std::string& view) {
    settings.visualizer = view;
    for (int i = 0; i < 3; ++i) draw();
    return picture();
  }
  [[nodiscard]] const std::vector<CloseupView>& pairs() { return world.view_resource<CloseupViews>(settings.id).pairs; }
  [[nodiscard]] ImageBytes image(std::string_view name) {
    return value_of(renderer->read_image(world, settings.id, name));
  }
  template <class F>
  void for_pixels(F&& function) const {
    for (std::uint32_t y = 0; y < settings.height; ++y)
      for (std::uint32_t x = 0; x < settings.width; ++x) function(x, y, std::size_t{y} * settings.width + x);
  }

  [[nodiscard]] dvec3 in_camera(const dvec3& point) const {
    return dvec3(glm::inverse(settings.world_from_camera) * dvec4(point, 1.0));
  }
  /// Projects a point given in camera axes; it must be in front of the camera.
  [[nodiscard]] Projected projected(const dvec3& p) const {
    const double half = settings.camera.orthographic ? static_cast<double>(settings.camera.half_height_m)
                                                     : -p.z * std::tan(0.5 * settings.camera.fov_y);
    const double scale = 0.5 * settings.height / half;
    return {0.5 * settings.width + p.x * scale, 0.5 * settings.height - p.y * scale, -p.z};
  }
  /// Calls function(Projected) in steps of half a pixel along the part of a frustum's edge that is in front of the
  /// camera.
  template <class F>
  void walk(dvec3 from, dvec3 to, F&& function) const {
    from = in_camera(from);
    to = in_camera(to);
    const double near = static_cast<double>(settings.camera.near_m);
    if (from.z > -near && to.z > -near) return;
    if (from.z > -near) std::swap(from, to);
    if (to.z > -near) to = glm::mix(from, to, (-near - from.z) / (to.z - from.z));
    const Projected a = projected(from), b = projected(to);
    const double steps = std::ceil(2.0 * std::max(std::abs(a.x - b.x), std::abs(a.y - b.y))) + 1.0;
    for (double i = 0.0; i <= steps; i += 1.0) {
      const double t = i / steps;
      const double ahead = settings.camera.orthographic ? glm::mix(a.ahead_m, b.ahead_m, t)
                                                        : 1.0 / glm::mix(1.0 / a.ahead_m, 1.0 / b.ahead_m, t);
      function(Projected{glm::mix(a.x, b.x, t), glm::mix(a.y, b.y, t), ahead});
    }
  }
  template <class F>
  void walk_edges(const ShadowFace& face, F&& function) const {
    const double side = face.square.size, x[] = {0.0, side, side, 0.0}, y[] = {0.0, 0.0, side, side};
    for (int i = 0; i < 4; ++i) {
      const int j = (i + 1) % 4;
      for (const float along : {face.near_m, face.far_m})
        walk(unproject(face, x[i], y[i], along), unproject(face, x[j], y[j], along), function);
      walk(unproject(face, x[i], y[i], face.near_m), unproject(face, x[i], y[i], face.far_m), function);
    }
  }

  /// Expected pixels of visualizer closeup_frusta for a single pair.
  enum class Line : std::uint8_t { none, close, hidden, clear };
  [[nodiscard]] std::vector<Line> lines_of(const ShadowFace& face) {
    const GeometryPicture geometry = value_of(renderer->read_geometry(world, settings.id));
    std::vector<Line> found(std::size_t{settings.width} * settings.height, Line::none);
    const auto raise = [&](int x, int y, Line to) {
      if (x < 0 || y < 0 || x >= static_cast<int>(settings.width) || y >= static_cast<int>(settings.height)) return;
      Line& line = found[static_cast<std::size_t>(y) * settings.width + static_cast<std::size_t>(x)];
      line = std::max(line, to);
    };
    walk_edges(face, [&](const Projected& p) {
      if (!(std::abs(p.x) < 1e4 && std::abs(p.y) < 1e4)) return;
      const int x = static_cast<int>(std::floor(p.x)), y = static_cast<int>(std::floor(p.y));
      for (int i = 0; i < 25; ++i) raise(x + i % 5 - 2, y + i / 5 - 2, Line::close);
      // Only points near a pixel's centre require that the pixel is drawn.
      if (std::max(std::abs(p.x - x - 0.5), std::abs(p.y - y - 0.5)) > 0.3) return;
      if (x < 0 || y < 0 || x >= static_cast<int>(settings.width) || y >= static_cast<int>(settings.height)) return;
      const float depth = geometry.depth[static_cast<std::size_t>(y) * settings.width + static_cast<std::size_t>(x)];
      const double surface = depth > 0.0f ? static_cast<double>(geometry.view.view_depth(depth)) : 1e9;
      if (p.ahead_m < 0.97 * surface) raise(x, y, Line::clear);
      if (p.ahead_m > 1.03 * surface) raise(x, y, Line::hidden);
    });
    return found;
  }
  struct Met {
    std::size_t clear = 0, hidden = 0, tinted = 0, framed = 0, untouched = 0, wrong = 0;
  };
  /// Checks every pixel of the visualizer's image, and that the picture is unchanged where nothing is drawn over it.
  Met expect_frustum_and_tiles(const std::string& what) {
    const Picture lit = shown("none"), over = shown("closeup_frusta");
    const ImageBytes named = image("closeup_frusta");
    Met met;
    EXPECT_EQ(pairs().size(), 1u) << what;
    if (pairs().size() != 1) return met;
    const CloseupView pair = pairs()[0];
    const std::vector<Line> lines = lines_of(pair.face);
    const uvec2 low = pair.tiles.begin * kShadowTile,
                high = glm::min(pair.tiles.end * kShadowTile, uvec2(settings.width, settings.height)) - 1u;
    for_pixels([&](std::uint32_t x, std::uint32_t y, std::size_t i) {
      const double opacity = std::to_integer<int>(named.bytes[4 * i + 3]) / 255.0;
      const bool inside = x >= low.x && y >= low.y && x <= high.x && y <= high.y;
      const bool rim = inside && (x == low.x || y == low.y || x == high.x || y == high.y);
      const double below = rim ? 0.7 : inside ? 0.16 : 0.0;
      // Opacity of the line alone.
      const double line = 1.0 - (1.0 - opacity) / (1.0 - below);
      bool right = true;
      if (lines[i] == Line::none) {
        right = std::abs(opacity - below) < 0.003;
        ++(rim ? met.framed : inside ? met.tinted : met.untouched);
      }
      if (lines[i] == Line::none && !inside) right = right && std::memcmp(&lit.rgba[4 * i], &over.rgba[4 * i], 4) == 0;
      if (lines[i] == Line::hidden) right = line > 0.15 && (++met.hidden > 0);
      if (lines[i] == Line::clear) right = line > 0.7 && (++met.clear > 0);
      met.wrong += right ? 0 : 1;
    });
    EXPECT_EQ(met.wrong, 0u) << what;
    expect_color_of(pair.pair, lines, over, what);
    return met;
  }
  /// The brightest channel of the pair's colour must be the brightest channel of its lines.
  static void expect_color_of(Entity pair, const std::vector<Line>& lines, const Picture& over,
                              const std::string& what) {
    const vec3 color = closeup_color(pair);
    const int most = color.x >= color.y && color.x >= color.z ? 0 : color.y >= color.z ? 1 : 2;
    std::size_t other = 0, all = 0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (lines[i] != Line::clear) continue;
      const std::uint8_t* p = &over.rgba[4 * i];
      ++all;
      other += p[most] == std::max({p[0], p[1], p[2]}) ? 0 : 1;
    }
    EXPECT_LE(other, all / 10) << what;
  }

  [[nodiscard]] std::vector<float> texels_shown() {
    const ImageBytes named = image("closeup_texels");
    std::vector<float> values;
    for (std::size_t i = 0; i < named.bytes.size(); i += 8) {
      std::uint16_t half = 0;
      std::memcpy(&half, &named.bytes[i], sizeof(half));
      values.push_back(glm::unpackHalf1x16(half));
    }
    return values;
  }
  [[nodiscard]] dvec3 on_floor(std::uint32_t x, std::uint32_t y) const {
    const Ray r = ray(x, y);
    return r.origin - r.direction * (r.origin.y / r.direction.y);
  }
  /// Texels between two points of the floor.
  [[nodiscard]] static glm::dvec2 apart(const ShadowFace& face, const dvec3& a, const dvec3& b) {
    const auto from = project(face, a), to = project(face, b);
    return from && to ? glm::dvec2(to->x - from->x, to->y - from->y) : glm::dvec2(0.0);
  }
  /// Texels per pixel side, from the positions of the neighbouring pixels; negative: outside. unsure: too near to the
  /// sides of the frustum.
  struct Density {
    double texels = -1.0;
    bool unsure = false;
  };
  [[nodiscard]] Density density(std::uint32_t x, std::uint32_t y) {
    Density most;
    for (const CloseupView& pair : pairs()) {
      const uvec2 tile(x / kShadowTile, y / kShadowTile);
      const auto& [begin, end] = pair.tiles;
      if (tile.x < begin.x || tile.y < begin.y || tile.x >= end.x || tile.y >= end.y) continue;
      const auto there = project(pair.face, on_floor(x, y));
      if (!there) continue;
      const double side = pair.face.square.size, near = pair.face.near_m, far = pair.face.far_m;
      const double within = std::min({there->x, there->y, side - there->x, side - there->y}) / side;
      const double deep = std::min(there->along_m - near, far - there->along_m) / far;
      most.unsure = most.unsure || std::abs(within) < 1e-3 || std::abs(deep) < 1e-3;
      if (within < 0.0 || deep < 0.0) continue;
      const glm::dvec2 u = 0.5 * apart(pair.face, on_floor(x - 1, y), on_floor(x + 1, y));
      const glm::dvec2 v = 0.5 * apart(pair.face, on_floor(x, y - 1), on_floor(x, y + 1));
      most.texels = std::max(most.texels, std::sqrt(std::abs(u.x * v.y - u.y * v.x)));
    }
    return most;
  }
  /// Checks every pixel that shows the floor. Returns how many are in a frustum.
  std::size_t expect_texels_of_the_floor(const std::string& what) {
    static_cast<void>(shown("closeup_texels"));
    const std::vector<float> texels = texels_shown();
    const GeometryPicture geometry = value_of(renderer->read_geometry(world, settings.id));
    std::size_t in = 0, out = 0, wrong = 0;
    for_pixels([&](std::uint32_t x, std::uint32_t y, std::size_t i) {
      if (x == 0 || y == 0 || geometry.is_sky(i)) return;
      if (std::abs((geometry.position(x, y) + geometry.view.position).y) > 1e-3) return;
      const Density wanted = density(x, y);
      if (wanted.unsure) return;
      const bool inside = wanted.texels >= 0.0;
      ++(inside ? in : out);
      wrong += (inside ? std::abs(texels[i] - wanted.texels) < 0.05 * wanted.texels : texels[i] == -1.0f) ? 0 : 1;
    });
    EXPECT_EQ(wrong, 0u) << what << ", of " << in << " and " << out;
    EXPECT_GT(out, 100u) << what;
    return in;
  }

  [[nodiscard]] std::vector<std::string> pick(uvec2 pixel) {
    std::vector<std::string> lines = value_of(renderer->pick(world, settings.id, pixel.x, pixel.y));
    const auto first =
        std::ranges::find_if(lines, [](const std::string& l) { return l.starts_with("close-up pairs of the tile: "); });
    return {first, lines.end()};
  }
};

TEST_F(CloseupViewsTest, lines_lie_where_the_frustum_is_and_its_tiles_are_tinted) {
  for (const LightKind kind : {LightKind::spot, LightKind::point, LightKind::directional}) {
    take_lamps_away();
    put_lamp(kind);
    const std::string what = "light " + std::to_string(static_cast<int>(kind));
    const Met met = expect_frustum_and_tiles(what);
    EXPECT_GT(met.clear, 20u) << what;
    EXPECT_GT(met.hidden, 0u) << what;
    EXPECT_GT(met.tinted, 100u) << what;
    EXPECT_GT(met.framed, 20u) << what;
    EXPECT_GT(met.untouched, 100u) << what;
  }
}

TEST_F(CloseupViewsTest, lines_are_cut_at_the_near_plane_and_right_for_orthographic_cameras) {
  put_lamp(LightKind::spot);
  // With the camera inside the frustum.
  const ViewId id = settings.id;
  settings = look_at(dvec3(0.3, 0.9, 0.9), dvec3(0.1, 0.2, -0.6), 150, 109);
  settings.id = id;
  EXPECT_GT(expect_frustum_and_tiles("close").clear, 20u);
  settings = look_at(dvec3(0.3, 2.2, 3.4), dvec3(0.0, 0.3, 0.0), 150, 109);
  settings.id = id;
  settings.camera.orthographic = true;
  settings.camera.half_height_m = 1.6f;
  EXPECT_GT(expect_frustum_and_tiles("orthographic").clear, 20u);
  EXPECT_GT(expect_texels_of_the_floor("orthographic"), 50u);
}

TEST_F(CloseupViewsTest, texels_are_those_between_places_of_neighbouring_pixels_in_the_map) {
  for (const LightKind kind : {LightKind::spot, LightKind::point, LightKind::directional}) {
    take_lamps_away();
    put_lamp(kind);
    EXPECT_GT(expect_texels_of_the_floor("light " + std::to_string(static_cast<int>(kind))), 50u);
  }
  put_lamp(LightKind::spot);
  put_lamp(LightKind::point);
  EXPECT_GT(expect_texels_of_the_floor("the finest of several"), 50u);
  EXPECT_EQ(pairs().size(), 3u);
}

TEST_F(CloseupViewsTest, without_a_pair_the_picture_is_as_it_is_and_why_is_said) {
  put_lamp(LightKind::spot);
  set("closeups.max_pairs", "0");
  const Picture lit = shown("none");
  for (const char* view : {"closeup_frusta", "closeup_texels"}) EXPECT_EQ(shown(view).rgba, lit.rgba) << view;
  set("closeups.max_pairs", "8");
  set("shadows.visibility_bits", "exact");
  warnings.clear();
  const Picture exact = shown("none");
  EXPECT_EQ(shown("closeup_frusta").rgba, exact.rgba);
  EXPECT_THAT(warnings, ElementsAre("view closeup_frusta shows the picture as it is: the frame has no final lists"));
  set("shadows.mode", "monolithic");
  EXPECT_THAT(renderer->check_visualizer(world, "closeup_texels").error().message,
              HasSubstr("needs shadows.mode=deferred"));
}

TEST_F(CloseupViewsTest, colours_of_neighbouring_pairs_differ) {
  for (std::uint32_t i = 0; i < 200; ++i)
    for (std::uint32_t j = i + 1; j < i + 8; ++j)
      EXPECT_GT(glm::distance(closeup_color(Entity{i, 1}), closeup_color(Entity{j, 1})), 0.2f) << i << ' ' << j;
}

TEST_F(CloseupViewsTest, picking_tells_the_pairs_of_the_tile_with_map_size_and_texels) {
  put_lamp(LightKind::spot);
  static_cast<void>(shown("closeup_texels"));
  const std::vector<float> texels = texels_shown();
  ASSERT_EQ(pairs().size(), 1u);
  const CloseupView pair = pairs()[0];
  std::optional<uvec2> in, beside, away;
  for_pixels([&](std::uint32_t x, std::uint32_t y, std::size_t i) {
    const uvec2 tile(x / kShadowTile, y / kShadowTile);
    const bool inside = tile.x >= pair.tiles.begin.x && tile.y >= pair.tiles.begin.y && tile.x < pair.tiles.end.x &&
                        tile.y < pair.tiles.end.y;
    (texels[i] >= 0.0f ? in : inside ? beside : away) = uvec2(x, y);
  });
  ASSERT_TRUE(in && beside && away);
  settings.visualizer = "none";
  draw();
  EXPECT_THAT(pick(*away), ElementsAre("close-up pairs of the tile: 0 of 1"));
  const std::string size = std::to_string(pair.face.square.size), map = " and lamp 0: map " + size + "x" + size + ", ";
  const std::vector<std::string> outside = pick(*beside), lines = pick(*in);
  ASSERT_EQ(outside.size(), 2u);
  EXPECT_THAT(outside[1], HasSubstr(map + "outside its frustum"));
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0], "close-up pairs of the tile: 1 of 1");
  const std::string start = map + "in its frustum, ";
  const std::size_t number = lines[1].find(start);
  ASSERT_NE(number, std::string::npos) << lines[1];
  const double shown_texels = texels[std::size_t{in->y} * settings.width + in->x];
  EXPECT_NEAR(std::stod(lines[1].substr(number + start.size())), shown_texels, 0.01 * shown_texels);
  set("closeups.max_pairs", "0");
  draw();
  EXPECT_THAT(pick(*in), Not(Contains(HasSubstr("close-up"))));
}

}  // namespace
}  // namespace gloam::test
