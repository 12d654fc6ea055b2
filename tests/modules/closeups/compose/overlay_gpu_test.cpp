// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "modules/closeups/components.h"
#include "modules/closeups/compose/frame.h"
#include "tests/modules/shadows/support/final_lists/deferred_scene.h"
#include "tests/modules/shadows/support/held_faces.h"

// Close-up subjects as forward-lit surfaces see them: the overlay.

namespace gloam::test {
namespace {

/// Records which overlay copies the frames make. Added after all other modules.
class CopyReader final : public Module {
 public:
  [[nodiscard]] std::string_view name() const override { return "copy_reader"; }
  void register_components(World&) const override {}
  void scene_keys(KeyRegistry&) const override {}
  [[nodiscard]] Demand demand(const World&, const RenderView*) const override { return {true, "always"}; }
  void add_passes(FrameBuilder& frame, PassPhase phase) override {
    if (phase != PassPhase::visualize) return;
    const auto* closeups = frame.find<CloseupFrame>();
    copies.clear();
    if (closeups != nullptr) copies.assign(closeups->overlay.faces().begin(), closeups->overlay.faces().end());
  }

  std::vector<OverlayFace> copies;  ///< of the last frame
};

/// Mip 0 of a face.
struct FaceDepths {
  std::uint32_t size = 0;
  std::vector<float> depths;
  float most = 0.0f;  ///< greatest depth
  [[nodiscard]] float at(std::uint32_t x, std::uint32_t y) const { return depths[std::size_t{y} * size + x]; }
};

class CloseupOverlayFrames : public DeferredShadowsTest {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(DeferredShadowsTest::SetUp());
    if (IsSkipped()) return;
    set("shadows.filter", "hard");
    put_room();
    put(shapes_[0], glm::scale(glm::rotate(at(-0.6, 0.3, -0.4), 0.4, dvec3(0.0, 1.0, 0.0)), dvec3(0.4, 0.6, 0.4)));
    // Far boxes fix the bounds of all casters, and with them a sun's cascades.
    for (const double side : {-1.0, 1.0})
      put(shapes_[0], glm::scale(at(4.0 * side, 2.0 + 1.5 * side, -2.5), dvec3(0.2)));
    subject_ = put(shapes_[1], glm::scale(at(0.2, 0.75, 0.3), dvec3(0.5, 0.7, 0.5)));
    world.add(subject_, CloseupSubject{true});
  }
  [[nodiscard]] SharedRenderer& shared() override {
    static CopyReader* added = nullptr;
    static SharedRenderer made([this] {
      ModuleList modules = make_modules();
      auto last = std::make_unique<CopyReader>();
      added = last.get();
      modules.push_back(std::move(last));
      return modules;
    }());
    copies_ = added;
    return made;
  }

  /// A pane above the floor, which receives the shadows, too.
  void put_pane() { pane_entity_ = put(pane_, glm::scale(flat_pane(), dvec3(2.4))); }
  [[nodiscard]] static dmat4 flat_pane() { return flat(0.12); }
  void put_lamp(LightKind kind) {
    if (kind == LightKind::point) put_light(point(), dvec3(0.9, 1.6, 0.9), dvec3(0.0, -1.0, 0.0), 128);
    if (kind == LightKind::spot) put_light(spot(45.0), dvec3(-0.5, 2.0, 1.0), dvec3(0.3, -1.0, -0.4), 128);
    Light made = sun();
    made.intensity = 2.0f;
    if (kind == LightKind::directional) put_light(made, dvec3(0.0), dvec3(0.4, -1.0, -0.3), 256);
  }
  void draw_twice() {
    draw();
    draw();
  }
  [[nodiscard]] std::vector<float> atlas() {
    const ImageBytes image = value_of(renderer->read_image(world, settings.id, "shadow_atlas"));
    std::vector<float> texels(image.bytes.size() / sizeof(float));
    std::memcpy(texels.data(), image.bytes.data(), image.bytes.size());
    return texels;
  }
  /// atlas: read while it had the size that it has now.
  [[nodiscard]] FaceDepths face_in(const std::vector<float>& atlas, const AtlasSquare& square) const {
    const std::uint32_t side = world.view_resource<ViewFaces>(ViewId{0}).atlas.size();
    FaceDepths face{.size = square.size, .depths = {}};
    for (std::uint32_t i = 0; i < square.size * square.size; ++i) {
      const uvec2 texel = square.origin + uvec2(i % square.size, i / square.size);
      face.depths.push_back(atlas[std::size_t{texel.y} * side * 3 / 2 + texel.x]);
      face.most = std::max(face.most, face.depths.back());
    }
    return face;
  }
  [[nodiscard]] bool has_pass(std::string_view name) const {
    return std::ranges::any_of(renderer->report().passes, [&](const PassTime& pass) { return pass.name == name; });
  }

  /// Change of depth over two texels of a surface that recedes one metre per metre across.
  [[nodiscard]] static float slack_of(const ShadowFace& face, float depth) {
    const auto texels = static_cast<float>(face.square.size);
    return 2.0f * (face.tan_half > 0.0f ? depth * 2.0f * face.tan_half / texels
                                        : 2.0f * face.half_extent_m / texels / face.far_m);
  }
  /// Depths of the subject within one texel of a texel.
  struct Around {
    float low = 2.0f;
    float high = 0.0f;
    [[nodiscard]] bool contains(float depth, float slack) const {
      return depth >= low - slack && depth <= high + slack;
    }
  };
  [[nodiscard]] static bool shows(const FaceDepths& face, const FaceDepths& without, std::uint32_t x, std::uint32_t y) {
    return face.at(x, y) > without.at(x, y) * 1.0001f + 1e-6f * face.most;
  }
  [[nodiscard]] static Around around(const FaceDepths& face, const FaceDepths& without, std::uint32_t x,
                                     std::uint32_t y) {
    Around found;
    for (std::uint32_t i = 0; i < 9; ++i) {
      const std::uint32_t nx = x + i % 3 - 1, ny = y + i / 3 - 1;
      if (!shows(face, without, nx, ny)) continue;
      found = {std::min(found.low, face.at(nx, ny)), std::max(found.high, face.at(nx, ny))};
    }
    return found;
  }
  /// Every texel of `a` that shows the subject must have it in `b` within one texel, with a depth in the range found
  /// there. Up to a tenth of the texels are exceptions, at outlines, where surfaces are steep and drawn maps are biased
  /// by the slope: there the depth ranges within one texel must overlap.
  static std::size_t expect_within_a_texel(const FaceDepths& a, const FaceDepths& b, const FaceDepths& without,
                                           const ShadowFace& face, const std::string& what) {
    std::size_t shown = 0, off = 0, apart = 0;
    for (std::uint32_t y = 1; y + 1 < a.size; ++y)
      for (std::uint32_t x = 1; x + 1 < a.size; ++x) {
        if (!shows(a, without, x, y)) continue;
        ++shown;
        const Around own = around(a, without, x, y), other = around(b, without, x, y);
        const float depth = a.at(x, y), slack = slack_of(face, depth);
        off += other.contains(depth, slack) ? 0 : 1;
        apart += other.low <= own.high + slack && own.low <= other.high + slack ? 0 : 1;
      }
    EXPECT_EQ(apart, 0u) << what << ", of " << shown;
    EXPECT_LE(off, shown / 10) << what << ", of " << shown;
    return shown;
  }
  void expect_transferred_as_drawn(LightKind kind, const char* standard) {
    put_lamp(kind);
    put_pane();
    set("closeups.standard", standard);
    draw_twice();
    const std::vector<OverlayFace> copies = copies_->copies;
    ASSERT_FALSE(copies.empty());
    EXPECT_EQ(counter("closeups.pairs"), 1.0);
    EXPECT_TRUE(has_pass("closeup_transfer"));
    const std::vector<float> with_copies = atlas();
    set("closeups.max_pairs", "0");
    draw_twice();
    const std::vector<float> drawn = atlas();
    std::size_t shown = 0;
    for (const OverlayFace& overlaid : copies) {
      const FaceDepths copy = face_in(with_copies, overlaid.copy), without = face_in(with_copies, overlaid.face.square),
                       with = face_in(drawn, overlaid.face.square);
      const std::string what = std::string(standard) + " face " + std::to_string(overlaid.face.index);
      shown += expect_within_a_texel(copy, with, without, overlaid.face, what + ", not more");
      shown += expect_within_a_texel(with, copy, without, overlaid.face, what + ", not less");
      EXPECT_TRUE(std::string_view(standard) == "transfer" || copy.depths == with.depths) << what;
    }
    EXPECT_GT(shown, 100u);
  }
  /// Share of pixels whose light differs by more than 10 %.
  [[nodiscard]] static double differing(const LinearPicture& a, const LinearPicture& b) {
    std::size_t off = 0;
    for (std::size_t i = 0; i < a.rgba.size(); i += 4)
      off += std::abs(a.rgba[i] - b.rgba[i]) > 0.1f * std::max(a.rgba[i], b.rgba[i]) + 1e-3f ? 1 : 0;
    return static_cast<double>(off) / (static_cast<double>(a.rgba.size()) / 4.0);
  }

  /// World box of the subject.
  struct SubjectBox {
    dvec3 low;
    dvec3 high;
    /// Whether the segment from `from` to `to` passes through the box.
    [[nodiscard]] bool cuts(const dvec3& from, const dvec3& to) const {
      double begin = 0.0, end = 1.0;
      for (int axis = 0; axis < 3; ++axis) {
        const double way = to[axis] - from[axis];
        if (std::abs(way) < 1e-12) {
          if (from[axis] < low[axis] || from[axis] > high[axis]) return false;
          continue;
        }
        const double a = (low[axis] - from[axis]) / way, b = (high[axis] - from[axis]) / way;
        begin = std::max(begin, std::min(a, b));
        end = std::min(end, std::max(a, b));
      }
      return begin <= end;
    }
  };
  static constexpr SubjectBox kSubject{dvec3(-0.05, 0.4, 0.05), dvec3(0.45, 1.1, 0.55)};

  /// Whether the camera sees the point, by its matrices in double precision.
  [[nodiscard]] bool in_view(const dvec3& point) const {
    const RenderView view = make_view(settings, 0);
    const dvec4 clip = dmat4(view.clip_from_relative) * dvec4(point - view.position, 1.0);
    return clip.w > static_cast<double>(view.near_m) && std::abs(clip.x) < clip.w && std::abs(clip.y) < clip.w;
  }
  /// Whether the subject's box is between the light and a point of the pane that the camera sees and the light reaches.
  [[nodiscard]] bool shades_pane(const dmat4& pane, Entity lamp) const {
    const Light& what = world.get<Light>(lamp);
    const dmat4& node = world.get<WorldTransform>(lamp).matrix;
    const dvec3 forward = -glm::normalize(dvec3(node[2]));
    for (int i = 0; i < 21 * 21; ++i) {
      const dvec3 point = dvec3(pane * dvec4(-0.5 + 0.05 * (i % 21), -0.5 + 0.05 * (i / 21), 0.0, 1.0));
      const dvec3 from = what.kind == LightKind::directional ? point - 20.0 * forward : dvec3(node[3]);
      const double cosine = glm::dot(glm::normalize(point - from), forward);
      if (what.kind == LightKind::spot && cosine < std::cos(static_cast<double>(what.outer_angle))) continue;
      if (in_view(point) && kSubject.cuts(point, from)) return true;
    }
    return false;
  }

  CopyReader* copies_ = nullptr;
  Entity subject_, pane_entity_;
};

// Against points of the pane and the box of the subject: the overlay must be there if the box is between such a point
// and the light.
TEST_F(CloseupOverlayFrames, copies_are_made_only_for_surfaces_that_the_subject_may_shade) {
  settings.width = 48, settings.height = 40;
  put_pane();
  for (const LightKind kind : {LightKind::point, LightKind::spot, LightKind::directional}) {
    for (const Entity lamp : std::exchange(lamps, {})) world.remove<Light>(lamp);
    put_lamp(kind);
    draw_twice();
    Dice dice(41);
    int shaded = 0, spared = 0;
    for (int i = 0; i < 24; ++i) {
      // Every second one near the subject.
      const dvec3 center = i % 2 == 0 ? dice.in_box(dvec3(-1.6, 0.05, -1.6), dvec3(1.6, 2.0, 2.0))
                                      : dice.in_box(dvec3(-0.6, 0.05, -0.5), dvec3(0.9, 0.8, 0.9));
      const dmat4 turned = glm::rotate(glm::translate(dmat4(1.0), center), dice.between(0.0, 3.1), dice.direction());
      const dmat4 pane = glm::scale(turned, dvec3(dice.between(0.1, 0.6)));
      place(pane_entity_, pane);
      draw();
      const bool needed = shades_pane(pane, lamps.back()), there = has_pass("closeup_transfer");
      EXPECT_TRUE(!needed || there) << "pane " << i;
      EXPECT_EQ(there, has_pass("shadow_overlay_copy"));
      EXPECT_EQ(there, !copies_->copies.empty());
      EXPECT_EQ(counter("closeups.pairs"), 1.0);
      shaded += needed ? 1 : 0;
      spared += there ? 0 : 1;
    }
    std::printf("shaded %d, spared %d of 24\n", shaded, spared);
    EXPECT_GT(shaded, 2);
    EXPECT_GT(spared, 5);
  }
}

TEST_F(CloseupOverlayFrames, copies_are_made_only_for_pairs_whose_shadow_a_surface_may_show) {
  settings.width = 160, settings.height = 120;
  const Entity near = put_light(spot(45.0), dvec3(-0.5, 2.0, 1.0), dvec3(0.3, -1.0, -0.4), 128);
  put_light(spot(45.0), dvec3(1.5, 2.0, 1.0), dvec3(-0.6, -1.0, -0.4), 128);
  pane_entity_ = put(pane_, glm::scale(at(0.65, 0.1, -0.2) * flat(0.0), dvec3(0.35)));
  draw();
  const LinearPicture monolithic = frame("monolithic").light;
  for (const char* batch : {"1", "2"}) {
    set("closeups.batch", batch);
    static_cast<void>(frame("deferred"));
    const LinearPicture deferred = frame("deferred").light;
    EXPECT_EQ(counter("closeups.pairs"), 2.0);
    ASSERT_FALSE(copies_->copies.empty());
    for (const OverlayFace& copy : copies_->copies) EXPECT_EQ(copy.face.light, near);
    EXPECT_LT(differing(deferred, monolithic), 0.02) << batch;
  }
}

TEST_F(CloseupOverlayFrames, a_lamps_faces_hold_what_drawing_the_subject_gives) {
  expect_transferred_as_drawn(LightKind::point, "transfer");
}
TEST_F(CloseupOverlayFrames, a_spots_face_holds_what_drawing_the_subject_gives) {
  expect_transferred_as_drawn(LightKind::spot, "transfer");
}
TEST_F(CloseupOverlayFrames, a_suns_faces_hold_what_drawing_the_subject_gives) {
  expect_transferred_as_drawn(LightKind::directional, "transfer");
}
TEST_F(CloseupOverlayFrames, a_subject_drawn_apart_gives_a_lamps_faces_to_the_bit) {
  expect_transferred_as_drawn(LightKind::point, "draw");
}
TEST_F(CloseupOverlayFrames, a_subject_drawn_apart_gives_a_spots_face_to_the_bit) {
  expect_transferred_as_drawn(LightKind::spot, "draw");
}
TEST_F(CloseupOverlayFrames, a_subject_drawn_apart_gives_a_suns_faces_to_the_bit) {
  expect_transferred_as_drawn(LightKind::directional, "draw");
}

TEST_F(CloseupOverlayFrames, subjects_that_share_the_map_share_faces) {
  const Entity second = put(shapes_[0], glm::scale(at(0.6, 0.5, -0.2), dvec3(0.3, 0.9, 0.3)));
  world.add(second, CloseupSubject{true});
  put_lamp(LightKind::point);
  put_lamp(LightKind::spot);
  put_pane();
  for (const char* batch : {"1", "4"}) {
    set("closeups.batch", batch);
    set("closeups.standard", "draw");
    draw_twice();
    EXPECT_EQ(counter("closeups.pairs"), 4.0);
    const std::vector<OverlayFace> copies = copies_->copies;
    const std::vector<float> with_copies = atlas();
    set("closeups.max_pairs", "0");
    draw_twice();
    const std::vector<float> standard = atlas();
    set("closeups.max_pairs", "8");
    for (const OverlayFace& overlaid : copies)
      EXPECT_EQ(face_in(with_copies, overlaid.copy).depths, face_in(standard, overlaid.face.square).depths) << batch;
    set("closeups.standard", "transfer");
    draw_twice();
    EXPECT_EQ(counter("closeups.pairs"), 4.0);
  }
}

TEST_F(CloseupOverlayFrames, maps_of_sixteen_bits_hold_the_subject) {
  set("shadows.depth", "d16");
  put_lamp(LightKind::spot);
  put_pane();
  draw();
  const LinearPicture monolithic = frame("monolithic").light;
  const LinearPicture deferred = frame("deferred").light;
  EXPECT_TRUE(has_pass("closeup_transfer"));
  EXPECT_LT(differing(deferred, monolithic), 0.02);
}

TEST_F(CloseupOverlayFrames, standard_faces_are_kept_without_the_subject) {
  for (const LightKind kind : {LightKind::point, LightKind::spot, LightKind::directional}) put_lamp(kind);
  set("shadows.atlas", "2048");
  draw_twice();
  EXPECT_FALSE(has_pass("closeup_transfer")) << "nobody looks at standard maps";
  EXPECT_FALSE(has_pass("shadow_overlay_copy"));
  const std::vector<FaceTexels> before = held_faces(*renderer, world);
  put_pane();
  for (int i = 0; i < 4; ++i) {
    world.get<WorldTransform>(subject_).matrix[3].x += 0.03;
    draw();
    EXPECT_EQ(counter("closeups.pairs"), 3.0);
    EXPECT_TRUE(has_pass("closeup_transfer"));
    EXPECT_EQ(counter("shadows.faces_drawn"), 0.0) << i;
    EXPECT_EQ(counter("shadows.texels_drawn"), 0.0) << i;
  }
  const std::vector<FaceTexels> after = held_faces(*renderer, world);
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t f = 0; f < before.size(); ++f) EXPECT_TRUE(before[f] == after[f]) << f;
}

TEST_F(CloseupOverlayFrames, a_pane_under_the_subject_is_dark_where_it_is_with_standard_maps) {
  settings.width = 160, settings.height = 120;
  put_pane();
  for (const LightKind kind : {LightKind::spot, LightKind::point, LightKind::directional}) {
    for (const Entity lamp : std::exchange(lamps, {})) world.remove<Light>(lamp);
    put_lamp(kind);
    draw();
    const LinearPicture monolithic = frame("monolithic").light;
    const dmat4 there = world.get<WorldTransform>(subject_).matrix;
    place(subject_, at(0.0, -50.0, 0.0) * there);
    const double without = differing(frame("deferred").light, monolithic);
    place(subject_, there);
    EXPECT_GT(without, 0.03) << "its shadow shows";
    for (const char* standard : {"transfer", "draw"}) {
      set("closeups.standard", standard);
      const LinearPicture deferred = frame("deferred").light;
      EXPECT_EQ(counter("closeups.pairs"), 1.0);
      EXPECT_LT(differing(deferred, monolithic), 0.2 * without) << standard;
    }
  }
}

TEST_F(CloseupOverlayFrames, tiles_without_a_list_see_the_subject) {
  put_lamp(LightKind::spot);
  draw();
  const LinearPicture monolithic = frame("monolithic").light;
  static_cast<void>(frame("deferred"));
  draw();
  EXPECT_FALSE(has_pass("closeup_transfer"));
  set("shadows.slot_limit", "1");
  for (int i = 0; i < 2; ++i) {
    // Also in the first frame, whose pairs were announced before fallback tiles were known.
    const LinearPicture deferred = frame("deferred").light;
    EXPECT_GT(counter("shadows.fallback_tiles"), 0.0);
    EXPECT_EQ(counter("closeups.pairs"), 1.0);
    EXPECT_TRUE(has_pass("closeup_transfer")) << i;
    EXPECT_LT(differing(deferred, monolithic), 0.03) << i;
  }
}

TEST_F(CloseupOverlayFrames, a_pair_without_room_for_copies_is_left_to_the_standard_map) {
  put_light(spot(45.0), dvec3(-0.5, 2.0, 1.0), dvec3(0.3, -1.0, -0.4), 1024);
  put_pane();
  draw();
  const Drawn monolithic = frame("monolithic");
  const Drawn deferred = frame("deferred");
  EXPECT_EQ(counter("closeups.pairs"), 0.0);
  EXPECT_EQ(counter("closeups.skipped"), 1.0);
  EXPECT_EQ(counter("closeups.tiles"), 0.0);
  EXPECT_FALSE(has_pass("closeup_compose"));
  expect_same(deferred, monolithic, "no room");
  world.destroy(pane_entity_);
  std::erase(things, pane_entity_);
  draw_twice();
  EXPECT_EQ(counter("closeups.pairs"), 1.0) << "nobody looks at the standard map";
  EXPECT_EQ(counter("closeups.skipped"), 0.0);
}

TEST_F(CloseupOverlayFrames, a_face_that_comes_back_to_where_a_copy_lay_is_drawn_again) {
  put_light(spot(45.0), dvec3(-0.5, 2.0, 1.0), dvec3(0.3, -1.0, -0.4), 512);
  std::vector<Entity> others;
  // These lights do not reach the subject; their maps fill the atlas.
  for (int i = 0; i < 3; ++i)
    others.push_back(put_light(spot(20.0), dvec3(-1.2 + 0.1 * i, 0.6, 0.4), dvec3(-0.5, -1.0, -0.8), 512));
  draw_twice();
  const std::vector<FaceTexels> before = held_faces(*renderer, world);
  ASSERT_EQ(before.size(), 4u);
  for (const Entity other : others) world.get<ShadowCaster>(other).enabled = false;
  put_pane();
  for (int i = 0; i < 3; ++i) draw();
  ASSERT_EQ(copies_->copies.size(), 1u);
  world.destroy(pane_entity_);
  std::erase(things, pane_entity_);
  for (const Entity other : others) world.get<ShadowCaster>(other).enabled = true;
  draw();
  EXPECT_EQ(counter("shadows.faces_drawn"), 1.0) << "where the copy lay";
  EXPECT_EQ(counter("shadows.faces_cached"), 3.0);
  const std::vector<FaceTexels> after = held_faces(*renderer, world);
  ASSERT_EQ(after.size(), 4u);
  for (std::size_t f = 0; f < after.size(); ++f) EXPECT_TRUE(before[f] == after[f]) << f;
}

}  // namespace
}  // namespace gloam::test
