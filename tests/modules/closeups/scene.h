// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "modules/closeups/components.h"
#include "modules/closeups/pairs/views.h"
#include "modules/shadows/atlas/view_faces.h"
#include "tests/modules/shadows/support/final_lists/deferred_scene.h"
#include "tests/support/worse.h"

namespace gloam::test {

/// A subtree of meshes: one close-up subject.
struct Figure {
  Entity root;
  std::vector<Entity> parts;
  std::vector<MeshInstance> meshes;  ///< by part
};

/// Visibility of a light at the pixels of a frame, from its final lists.
struct SeenLight {
  static constexpr float kUnknown = -1.0f;  ///< the tile has no final list
  std::vector<float> pixels;
  std::vector<std::uint32_t> slots;  ///< by tile: the slot of the light's entry; GLOAM_NO_ROOM if it has no entry
};

/// One frame with its final lists.
struct CloseupShot {
  ReadFinalLists lists;
  LinearPicture light;
  Picture picture;
  GeometryPicture geometry;
  CloseupViews views;
};

/// Differences of two visibilities, summed over pixels.
struct SeenDifference {
  std::size_t pixels = 0;
  std::size_t more_than_half = 0;
  double sum = 0.0;
  double worst = 0.0;
  void add(float a, float b) {
    const double off = std::abs(static_cast<double>(a) - static_cast<double>(b));
    ++pixels;
    sum += off;
    worst = worse(worst, off);
    more_than_half += off <= 0.5 ? 0 : 1;
  }
  [[nodiscard]] double mean() const { return pixels == 0 ? 0.0 : sum / static_cast<double>(pixels); }
  [[nodiscard]] double half_share() const {
    return pixels == 0 ? 0.0 : static_cast<double>(more_than_half) / static_cast<double>(pixels);
  }
};

/// Base class of tests that draw frames with close-up subjects.
class CloseupScene : public DeferredShadowsTest {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(DeferredShadowsTest::SetUp());
    if (IsSkipped()) return;
    settings.width = 160, settings.height = 96;
  }

  /// Far boxes fix the bounds of all casters, and with them a sun's cascades.
  void put_far_boxes() {
    for (const double side : {-1.0, 1.0})
      put(shapes_[0], glm::scale(at(4.5 * side, 2.0 + 1.5 * side, 4.0 * side), dvec3(0.2)));
  }
  [[nodiscard]] Figure subject_of(std::vector<Entity> parts, float priority = 1.0f) {
    Figure figure{world.create(WorldTransform{}, CloseupSubject{true, priority}), std::move(parts), {}};
    things.push_back(figure.root);
    for (const Entity part : figure.parts) {
      world.add(part, Parent{figure.root});
      world.add(part, LocalMatrix{world.get<WorldTransform>(part).matrix});
      figure.meshes.push_back(world.get<MeshInstance>(part));
    }
    return figure;
  }
  /// A figure one metre tall (legs, trunk, arms, head) that stands at `feet`.
  [[nodiscard]] Figure put_figure(const dvec3& feet, double scale = 1.0, double turn = 0.4) {
    const dmat4 stand = glm::scale(glm::rotate(at(feet.x, feet.y, feet.z), turn, dvec3(0.0, 1.0, 0.0)), dvec3(scale));
    const auto part = [&](std::uint32_t mesh, const dvec3& center, const dvec3& size) {
      return put(mesh, glm::scale(glm::translate(stand, center), size));
    };
    return subject_of({part(shapes_[0], dvec3(-0.1, 0.2, 0.0), dvec3(0.1, 0.4, 0.12)),
                       part(shapes_[0], dvec3(0.12, 0.2, 0.0), dvec3(0.1, 0.4, 0.12)),
                       part(shapes_[0], dvec3(0.0, 0.58, 0.0), dvec3(0.34, 0.38, 0.2)),
                       part(shapes_[0], dvec3(0.0, 0.66, 0.1), dvec3(0.8, 0.06, 0.06)),
                       part(shapes_[1], dvec3(0.0, 0.88, 0.0), dvec3(0.22))});
  }
  [[nodiscard]] Figure put_block(const dvec3& center, const dvec3& size, float priority = 1.0f) {
    return subject_of({put(shapes_[0], glm::scale(at(center.x, center.y, center.z), size))}, priority);
  }
  void place_part(const Figure& figure, std::size_t part, const dmat4& matrix) {
    world.get<LocalMatrix>(figure.parts[part]).matrix = matrix;
    world.mark_changed<LocalMatrix>(figure.parts[part]);
  }
  void hide(const Figure& figure) {
    for (const Entity part : figure.parts) world.remove<MeshInstance>(part);
  }
  void show(const Figure& figure) {
    for (std::size_t i = 0; i < figure.parts.size(); ++i) world.add(figure.parts[i], MeshInstance(figure.meshes[i]));
  }

  [[nodiscard]] CloseupShot shot() {
    reader->wanted = true;
    draw();
    reader->wanted = false;
    if (HasFatalFailure()) return {};
    CloseupShot taken{reader->read(),
                      linear(settings.id.value),
                      picture(settings.id.value),
                      value_of(renderer->read_geometry(world, settings.id)),
                      {}};
    if (const auto* views = world.try_view_resource<CloseupViews>(settings.id)) taken.views = *views;
    std::size_t bad = 0;
    for (const float channel : taken.light.rgba) bad += std::isfinite(channel) && channel >= 0.0f ? 0 : 1;
    EXPECT_EQ(bad, 0u) << "light is finite and not negative";
    return taken;
  }
  /// A shot after one frame that determines the buffer sizes.
  [[nodiscard]] CloseupShot second_shot() {
    draw();
    return shot();
  }

  [[nodiscard]] SeenLight seen(const ReadFinalLists& lists, Entity light) const {
    const std::size_t width = settings.width;
    SeenLight found{std::vector<float>(width * settings.height, 0.0f),
                    std::vector<std::uint32_t>(lists.texels.size(), GLOAM_NO_ROOM)};
    const auto in = [&](const std::vector<Entity>& lights) {
      return static_cast<std::uint32_t>(std::find(lights.begin(), lights.end(), light) - lights.begin());
    };
    const bool directional = in(lists.directional) < lists.directional.size();
    const std::uint32_t index = directional ? in(lists.directional) : in(lists.local);
    for (std::uint32_t tile = 0; tile < lists.texels.size(); ++tile) {
      std::uint32_t word = GLOAM_NO_ROOM << 10;
      for (const std::uint32_t entry : lists.run(tile, directional))
        if ((entry & 1023u) == index) word = entry;
      const std::uint32_t slot = found.slots[tile] = word >> 10;
      TileVisibility stored;
      if (slot < GLOAM_NO_ROOM) stored = lists.visibility(word);
      for (std::uint32_t pixel = 0; pixel < GLOAM_SLOT_PIXELS; ++pixel) {
        const std::uint32_t x = tile % lists.tiles.x * 8 + pixel % 8, y = tile / lists.tiles.x * 8 + pixel / 8;
        if (x >= settings.width || y >= settings.height) continue;
        float& to = found.pixels[std::size_t{y} * width + x];
        if (slot < GLOAM_NO_ROOM)
          to = static_cast<float>(stored.steps[pixel]) / static_cast<float>(lists.most());
        else
          to = slot == GLOAM_ALL_LIT ? 1.0f : 0.0f;
        if (!lists.complete(tile)) to = SeenLight::kUnknown;
      }
    }
    return found;
  }
  /// 0 if the module is not asked to count.
  [[nodiscard]] double counted(const std::string& name) const {
    const FrameReport report = renderer->report();
    const auto at = report.counters.find(name);
    return at == report.counters.end() ? 0.0 : at->second;
  }
  /// Whether the light clearly reaches the surface; elsewhere the visibility in the lists is undefined.
  [[nodiscard]] bool gives(const GeometryPicture& geometry, std::size_t pixel, Entity light) const {
    if (geometry.is_sky(pixel)) return false;
    const dmat4& node = world.get<WorldTransform>(light).matrix;
    const GeometryTexel texel = geometry.texel(pixel);
    const auto x = static_cast<std::uint32_t>(pixel % settings.width);
    const auto y = static_cast<std::uint32_t>(pixel / settings.width);
    const dvec3 from = geometry.position(x, y) + geometry.view.position - dvec3(node[3]);
    const Light& what = world.get<Light>(light);
    const dvec3 forward = -glm::normalize(dvec3(node[2]));
    const dvec3 along = what.kind == LightKind::directional ? forward : glm::normalize(from);
    if (what.kind != LightKind::directional && glm::length(from) > 0.99 * static_cast<double>(what.range_m))
      return false;
    if (what.kind == LightKind::spot &&
        glm::dot(along, forward) < std::cos(0.99 * static_cast<double>(what.outer_angle)))
      return false;
    return glm::dot(dvec3(texel.normal), along) < -0.02 && glm::dot(dvec3(texel.face_normal), along) < -0.02;
  }
  [[nodiscard]] bool in_tiles(std::size_t pixel, const TileRange& tiles) const {
    const uvec2 tile(pixel % settings.width / 8, pixel / settings.width / 8);
    return tile.x >= tiles.begin.x && tile.y >= tiles.begin.y && tile.x < tiles.end.x && tile.y < tiles.end.y;
  }
  [[nodiscard]] bool has_closeup_pass() const {
    const FrameReport report = renderer->report();
    return std::ranges::any_of(report.passes, [](const PassTime& pass) {
      return pass.name.starts_with("closeup") || pass.name.starts_with("shadow_map_closeup") ||
             pass.module == "closeups";
    });
  }

  /// Visibility of a light from standard maps that hold all casters.
  [[nodiscard]] std::vector<float> monolithic(Entity lamp) {
    set("shadows.mode", "monolithic");
    settings.visualizer = "shadow:" + names_.at(lamp);
    draw();
    settings.visualizer = "none";
    const ImageBytes image = value_of(renderer->read_image(world, settings.id, "shadow_visibility"));
    set("shadows.mode", "deferred");
    std::vector<float> values(image.bytes.size() / sizeof(float));
    std::memcpy(values.data(), image.bytes.data(), image.bytes.size());
    return values;
  }
  [[nodiscard]] static double steps_apart(const Picture& a, const Picture& b) {
    int worst = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i) worst = std::max(worst, std::abs(int{a.rgba[i]} - int{b.rgba[i]}));
    return worst;
  }
  /// Share of pixels with a channel of light that differs by more than 10 %.
  [[nodiscard]] static double differing(const LinearPicture& a, const LinearPicture& b) {
    std::size_t off = 0;
    for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
      bool differs = false;
      for (std::size_t c = 0; c < 3; ++c)
        differs |= std::abs(a.rgba[i + c] - b.rgba[i + c]) > 0.1f * std::max(a.rgba[i + c], b.rgba[i + c]) + 1e-3f;
      off += differs ? 1 : 0;
    }
    return static_cast<double>(off) / (static_cast<double>(a.rgba.size()) / 4.0);
  }

  static void expect_fallback_listed_once(const ReadFinalLists& lists, const std::string& what) {
    EXPECT_EQ(lists.counters.fallback_tiles, lists.fallback_tiles.size()) << what;
    const std::set<std::uint32_t> once(lists.fallback_tiles.begin(), lists.fallback_tiles.end());
    EXPECT_EQ(once.size(), lists.fallback_tiles.size()) << what;
    std::size_t incomplete = 0;
    for (std::uint32_t tile = 0; tile < lists.texels.size(); ++tile) {
      const std::uint32_t word = tile / lists.tiles.x << 16 | tile % lists.tiles.x;
      EXPECT_EQ(lists.complete(tile), !once.contains(word)) << what << ", tile " << tile;
      incomplete += lists.complete(tile) ? 0 : 1;
    }
    EXPECT_EQ(incomplete, once.size()) << what;
  }
  /// Entries must ascend, and each slot must belong to one entry and lie inside the buffers.
  static void expect_slots_are_one_entrys(const ReadFinalLists& lists, const std::string& what) {
    std::set<std::uint32_t> taken;
    for (std::uint32_t tile = 0; tile < lists.texels.size(); ++tile)
      for (const bool directional : {false, true}) {
        std::int64_t last = -1;
        for (const std::uint32_t entry : lists.run(tile, directional)) {
          const std::uint32_t slot = entry >> 10;
          EXPECT_GT(std::int64_t{entry & 1023u}, last) << what;
          last = entry & 1023u;
          if (slot == GLOAM_ALL_LIT || slot == GLOAM_ALL_UNLIT) continue;
          EXPECT_LT(slot, lists.slot_capacity) << what;
          EXPECT_TRUE(taken.insert(slot).second) << what << ", slot " << slot;
        }
      }
    EXPECT_LE(taken.size(), lists.counters.slots) << what;
  }
  /// Checks only the faces of the frame: the rest of the atlas holds data of earlier frames.
  void expect_finite_maps(const std::string& what) {
    const auto image = renderer->read_image(world, settings.id, "shadow_atlas");
    if (!image.ok()) return;  // a frame without lights
    std::vector<float> texels(image->bytes.size() / sizeof(float));
    std::memcpy(texels.data(), image->bytes.data(), texels.size() * sizeof(float));
    const std::size_t row = static_cast<std::size_t>(std::sqrt(1.5 * static_cast<double>(texels.size())) + 0.5);
    std::size_t bad = 0;
    for (const ShadowFace& face : world.view_resource<ViewFaces>(settings.id).faces)
      for (std::uint32_t y = 0; y < face.square.size; ++y)
        for (std::uint32_t x = 0; x < face.square.size; ++x) {
          const float depth = texels[(face.square.origin.y + y) * row + face.square.origin.x + x];
          bad += depth >= 0.0f && depth <= 1.0f ? 0 : 1;
        }
    EXPECT_EQ(bad, 0u) << what;
  }
};

}  // namespace gloam::test
