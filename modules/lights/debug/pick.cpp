// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/debug/pick.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <optional>

#include "engine/core/text/formatted.h"
#include "engine/scene/resources.h"
#include "modules/lights/bins/z_bins.h"
#include "modules/lights/masks/tile_light_masks.h"
#include "modules/lights/outputs.h"
#include "modules/lights/selection/light_list.h"

namespace gloam {
namespace {

using Indices = std::vector<std::uint32_t>;

std::string pair_text(uvec2 v) { return std::to_string(v.x) + "," + std::to_string(v.y); }

std::string range_text(const ZBin& bin) {
  return bin.begin < bin.end ? "[" + std::to_string(bin.begin) + "," + std::to_string(bin.end) + ")" : "no light";
}

std::vector<std::uint32_t> words_of(const Captures& copies, std::string_view name) {
  const std::span<const std::byte> bytes = copies.bytes(name);
  std::vector<std::uint32_t> words(bytes.size() / sizeof(std::uint32_t));
  if (!words.empty()) std::memcpy(words.data(), bytes.data(), words.size() * sizeof(std::uint32_t));
  return words;
}

/// Whether a light contributes at a camera-relative point. Mirrors local_illuminance in lights_api.glsl.
bool reaches(const shaders::LocalLight& light, const dvec3& point) {
  const dvec3 offset = dvec3(light.position) - point;
  const double d2 = std::max(glm::dot(offset, offset), 1e-30);
  const double cosine = glm::dot(-offset, dvec3(light.direction)) / std::sqrt(d2);
  return d2 * static_cast<double>(light.inverse_range_squared) < 1.0 &&
         cosine * static_cast<double>(light.spot_scale) + static_cast<double>(light.spot_offset) > 0.0;
}

constexpr std::size_t kMostContributions = 16;

/// The illuminance that a light adds at a surface.
struct Contribution {
  std::string light;
  double lux = 0.0;
};

class PickLines {
 public:
  PickLines(FrameBuilder& frame, const PickedPixel& pixel, const Captures& copies)
      : pixel_(pixel),
        copies_(copies),
        view_(frame.view()),
        names_(frame.world().resource<SceneNames>()),
        visible_(frame.world().view_resource<VisibleLights>(view_.id)),
        masks_(frame.world().try_view_resource<TileLightMasks>(view_.id)),
        bins_(frame.world().try_view_resource<ZBins>(view_.id)),
        tile_(pixel.x / GLOAM_SHADOW_TILE, pixel.y / GLOAM_SHADOW_TILE) {}

  std::vector<std::string> take(bool tiled) {
    if (pixel_.depth > 0.0f) add_contributions();
    if (tiled && masks_ != nullptr && bins_ != nullptr) {
      add_places();
      add_cpu_lists();
      add_gpu_lists();
    } else {
      say("no light lists: every pixel evaluates all " + std::to_string(visible_.block.local_count) + " local lights");
    }
    if (pixel_.depth > 0.0f) add_reaching();
    if (!visible_.directional_entities.empty()) {
      std::string line = "directional lights: ";
      for (std::size_t i = 0; i < visible_.directional_entities.size(); ++i)
        line += (i == 0 ? "" : ", ") + std::string(names_.name_of(visible_.directional_entities[i]));
      say(line);
    }
    return std::move(lines_);
  }

 private:
  void say(std::string line) { lines_.push_back(std::move(line)); }

  /// "2 lights: 3 lamp, 7": indices into the sorted lights, followed by the name if the scene has one.
  [[nodiscard]] std::string list_text(const Indices& lights) const {
    std::string text = std::to_string(lights.size()) + (lights.size() == 1 ? " light" : " lights");
    for (std::size_t i = 0; i < lights.size(); ++i) {
      text += (i == 0 ? ": " : ", ") + std::to_string(lights[i]);
      const std::string_view name = lights[i] < visible_.local_entities.size()
                                        ? names_.name_of(visible_.local_entities[lights[i]])
                                        : std::string_view();
      if (!name.empty()) text += " " + std::string(name);
    }
    return text;
  }

  void add_places() {
    const std::uint32_t columns = (view_.width + GLOAM_SHADOW_TILE - 1) / GLOAM_SHADOW_TILE;
    tile_at_ = std::size_t{tile_.y} * columns + tile_.x;
    const vec2 bounds = copies_.item<vec2>("lights.depth_bounds", tile_at_);
    say("shadow tile " + pair_text(tile_) + " of tile group " + pair_text(tile_ / uvec2(GLOAM_TILE_GROUP)) +
        ", mask tile " + pair_text(mask_tile()));
    if (pixel_.depth > 0.0f) {
      const std::uint32_t bin = z_bin_of(pixel_.view_depth_m, bins_->params);
      say("zBin " + std::to_string(bin) + " of the pixel: standard " + range_text(bins_->bins[bin]) + ", ranged " +
          range_text(bins_->bins[bins_->params.count + bin]));
    }
    if (bounds.y <= 0.0f) {
      say("the tile shows only sky");
      return;
    }
    const float nearest = view_.view_depth(bounds.y), farthest = view_.view_depth(bounds.x);
    const std::uint32_t first = z_bin_of(nearest, bins_->params), last = z_bin_of(farthest, bins_->params);
    say(formatted("view depths of the tile %.4f to %.4f m", static_cast<double>(nearest),
                  static_cast<double>(farthest)));
    range_ = z_bin_range(*bins_, nearest, farthest);
    say("zBins " + std::to_string(first) + " to " + std::to_string(last) +
        " of the tile: " + (last - first > 1 ? "ranged " : "standard ") + range_text(*range_));
  }

  [[nodiscard]] uvec2 mask_tile() const { return uvec2(pixel_.x / GLOAM_LIGHT_TILE, pixel_.y / GLOAM_LIGHT_TILE); }

  void add_cpu_lists() {
    const uvec2 at = mask_tile();
    const std::size_t first = (std::size_t{at.y} * masks_->tiles.x + at.x) * GLOAM_MASK_WORDS;
    Indices lights = decode_light_mask(std::span(masks_->words).subspan(first, GLOAM_MASK_WORDS));
    say("mask tile: " + list_text(lights));
    if (!range_) return;
    std::erase_if(lights, [&](std::uint32_t i) { return i < range_->begin || i >= range_->end; });
    say("candidates (mask and zBins): " + list_text(lights));
  }

  void add_gpu_lists() {
    if (!range_) return;
    const TileList list = decode_tile_list(copies_.item<uvec2>("lights.tile_lists", tile_at_));
    constexpr std::uint32_t kGroupPixels = GLOAM_SHADOW_TILE * GLOAM_TILE_GROUP;
    const std::uint32_t group_columns = (view_.width + kGroupPixels - 1) / kGroupPixels;
    const uvec2 group = tile_ / uvec2(GLOAM_TILE_GROUP);
    const std::vector<std::uint32_t> masks = words_of(copies_, "lights.group_masks");
    const std::size_t first = (std::size_t{group.y} * group_columns + group.x) * GLOAM_MASK_WORDS;
    say("approximate search, tile group: " +
        list_text(decode_light_mask(std::span(masks).subspan(first, GLOAM_MASK_WORDS))));
    say("approximate search, tile: " + std::to_string(list.approx_count));
    if (list.has_list) {
      say("accurate search: " +
          list_text(decode_light_list(words_of(copies_, "lights.early_lists"), list.slot, list.count)));
      say("slot " + std::to_string(list.slot));
    } else {
      say("accurate search: " + std::to_string(list.count) +
          " lights; no slot was left: the tile uses its group's mask");
    }
  }

  void add_reaching() {
    Indices lights;
    for (std::uint32_t i = 0; i < visible_.block.local_count; ++i)
      if (reaches(visible_.block.local[i], dvec3(pixel_.position))) lights.push_back(i);
    say("local lights in range of the pixel: " + list_text(lights));
  }

  /// The brightest first.
  void add_contributions() {
    std::vector<Contribution> lights;
    double sum = 0.0;
    const auto add = [&](double lux, Entity entity, const std::string& number) {
      const std::string_view name = names_.name_of(entity);
      if (lux > 0.0) lights.push_back({name.empty() ? number : std::string(name), lux});
      sum += lux;
    };
    for (std::uint32_t i = 0; i < visible_.block.directional_count; ++i)
      add(directional_illuminance_at(visible_, i, pixel_.normal), visible_.directional_entities[i],
          "directional " + std::to_string(i));
    for (std::uint32_t i = 0; i < visible_.block.local_count; ++i)
      add(local_illuminance_at(visible_, i, pixel_.position, pixel_.normal), visible_.local_entities[i],
          "local " + std::to_string(i));
    std::ranges::stable_sort(lights, std::ranges::greater(), &Contribution::lux);
    std::string line = formatted("illuminance before shadows %.4g lx", sum);
    for (std::size_t i = 0; i < std::min(lights.size(), kMostContributions); ++i) {
      line += (i == 0 ? ": " : ", ") + lights[i].light;
      line += formatted(" %.4g lx (%.1f %%)", lights[i].lux, 100.0 * lights[i].lux / sum);
    }
    if (lights.size() > kMostContributions)
      line += " and " + std::to_string(lights.size() - kMostContributions) + " more";
    say(line);
  }

  const PickedPixel& pixel_;
  const Captures& copies_;
  const RenderView& view_;
  const SceneNames& names_;
  const VisibleLights& visible_;
  const TileLightMasks* masks_;
  const ZBins* bins_;
  uvec2 tile_;
  std::size_t tile_at_ = 0;
  std::optional<ZBin> range_;  ///< sorted lights at the tile's depths; none if the tile shows only sky
  std::vector<std::string> lines_;
};

}  // namespace

Status add_light_pick_copies(FrameBuilder& frame, Captures& copies) {
  const LightsOutputs* lights = frame.find<LightsOutputs>();
  if (lights == nullptr || !lights->has_lists()) return {};
  GLOAM_TRY(copies.add(frame.graph(), "lights.depth_bounds", frame.get<GeometryOutputs>().depth_bounds));
  GLOAM_TRY(copies.add(frame.graph(), "lights.group_masks", lights->group_masks));
  GLOAM_TRY(copies.add(frame.graph(), "lights.tile_lists", lights->tile_lists));
  return copies.add(frame.graph(), "lights.early_lists", lights->early_lists);
}

std::vector<std::string> light_pick_lines(FrameBuilder& frame, const PickedPixel& pixel, const Captures& copies) {
  const LightsOutputs* lights = frame.find<LightsOutputs>();
  return PickLines(frame, pixel, copies).take(lights != nullptr && lights->has_lists());
}

}  // namespace gloam
