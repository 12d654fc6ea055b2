// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/debug/pick.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <utility>

#include "engine/core/text/formatted.h"
#include "engine/scene/resources.h"
#include "modules/lights/outputs.h"
#include "modules/shadows/outputs.h"
#include "shaders/shadows/final_lists_shared.h"

namespace gloam {
namespace {

static_assert(kShadowTile * kShadowTile == GLOAM_SLOT_PIXELS);

using Words = std::vector<std::uint32_t>;

void append_words(Words& words, std::span<const std::byte> bytes) {
  const std::size_t first = words.size();
  words.resize(first + bytes.size() / sizeof(std::uint32_t));
  if (!bytes.empty()) std::memcpy(words.data() + first, bytes.data(), (words.size() - first) * sizeof(std::uint32_t));
}

/// All directional lights of the view, or all local ones.
struct LightRun {
  const char* kind;
  std::span<const Entity> lights;
};

class PickLines {
 public:
  PickLines(FrameBuilder& frame, const PickedPixel& pixel, const Captures& copies, const FinalLists& lists)
      : copies_(copies),
        names_(frame.world().resource<SceneNames>()),
        lists_(lists),
        local_{"local", local_lights(frame.world().view_resource<VisibleLights>(frame.view().id))},
        directional_{"directional", directional_lights(frame.world().view_resource<VisibleLights>(frame.view().id))},
        visible_(frame.world().view_resource<VisibleLights>(frame.view().id)),
        at_(pixel),
        pixel_((pixel.y % kShadowTile) * kShadowTile + pixel.x % kShadowTile) {
    const std::uint32_t columns = (frame.view().width + kShadowTile - 1) / kShadowTile;
    tile_ = std::size_t{pixel.y / kShadowTile} * columns + pixel.x / kShadowTile;
    append_words(entries_, copies.bytes("shadows.final_entries"));
    append_words(visibilities_, copies.bytes("shadows.visibilities"));
    append_words(visibilities_, copies.bytes("shadows.visibilities_1"));
  }

  std::vector<std::string> take() {
    if (copies_.item<vec2>("shadows.depth_bounds", tile_).y <= 0.0f) {
      say("final list: none, the tile shows only sky");
      return std::move(lines_);
    }
    const FinalList list = decode_final_list(copies_.item<uvec4>("shadows.final_tiles", tile_));
    if (!list.complete) {
      say("final list: none, a buffer was full: the tile is shaded from shadow maps");
      return std::move(lines_);
    }
    const std::uint32_t count = list.directional_count + list.local_count;
    say("final list: " + std::to_string(count) + (count == 1 ? " light" : " lights"));
    Words left_out_directional(directional_.lights.size());
    for (std::uint32_t i = 0; i < left_out_directional.size(); ++i) left_out_directional[i] = i;
    add_run(directional_, list.directional_first, list.directional_count, left_out_directional);
    Words left_out_local = early_lights();
    add_run(local_, list.local_first, list.local_count, left_out_local);
    add_left_out(left_out_directional, left_out_local);
    return std::move(lines_);
  }

 private:
  void say(std::string line) { lines_.push_back(std::move(line)); }

  /// "local 3 lamp": kind, index among the lights of its kind, and the name if the scene has one.
  [[nodiscard]] std::string light_text(const LightRun& run, std::uint32_t light) const {
    const std::string_view name = light < run.lights.size() ? names_.name_of(run.lights[light]) : std::string_view();
    return std::string(run.kind) + " " + std::to_string(light) + (name.empty() ? "" : " " + std::string(name));
  }

  /// `lux`: before shadows.
  [[nodiscard]] std::string state_text(FinalEntry entry, double lux) const {
    if (entry.slot == GLOAM_ALL_LIT) return formatted("lit as a whole, %.4g lx", lux);
    const auto visibility =
        static_cast<double>(decode_visibility(entry, pixel_, visibilities_, lists_.visibility_bits));
    return formatted("slot %u, visibility %.4f, %.4g lx", entry.slot, visibility, visibility * lux);
  }

  [[nodiscard]] double illuminance(const LightRun& run, std::uint32_t light) const {
    if (at_.depth <= 0.0f || light >= run.lights.size()) return 0.0;
    return &run == &directional_ ? directional_illuminance_at(visible_, light, at_.normal)
                                 : local_illuminance_at(visible_, light, at_.position, at_.normal);
  }

  /// Adds a line per entry, and removes its light from `left_out`.
  void add_run(const LightRun& run, std::uint32_t first, std::uint32_t count, Words& left_out) {
    for (std::uint32_t i = first; i < first + count && i < entries_.size(); ++i) {
      const FinalEntry entry = decode_final_entry(entries_[i]);
      say("  " + light_text(run, entry.light) + ": " + state_text(entry, illuminance(run, entry.light)));
      std::erase(left_out, entry.light);
    }
  }

  void add_left_out(const Words& directional, const Words& local) {
    std::string text;
    for (const std::uint32_t light : directional) text += (text.empty() ? "" : ", ") + light_text(directional_, light);
    for (const std::uint32_t light : local) text += (text.empty() ? "" : ", ") + light_text(local_, light);
    if (!text.empty()) say("left out, no pixel of the tile sees them: " + text);
  }

  /// The local lights of the tile's early list, from the readbacks of the lights module.
  [[nodiscard]] Words early_lights() const {
    if (copies_.bytes("lights.tile_lists").empty()) return {};
    const TileList list = decode_tile_list(copies_.item<uvec2>("lights.tile_lists", tile_));
    if (!list.has_list) return {};
    Words words;
    append_words(words, copies_.bytes("lights.early_lists"));
    return decode_light_list(words, list.slot, list.count);
  }

  const Captures& copies_;
  const SceneNames& names_;
  const FinalLists& lists_;
  LightRun local_;
  LightRun directional_;
  const VisibleLights& visible_;
  const PickedPixel& at_;
  std::uint32_t pixel_;  ///< index in the tile, row by row
  std::size_t tile_ = 0;
  Words entries_, visibilities_;
  std::vector<std::string> lines_;
};

}  // namespace

Status add_shadow_pick_copies(FrameBuilder& frame, Captures& copies) {
  const FinalLists* lists = find_final_lists(frame);
  if (lists == nullptr) return {};
  GLOAM_TRY(copies.add(frame.graph(), "shadows.depth_bounds", frame.get<GeometryOutputs>().depth_bounds));
  GLOAM_TRY(copies.add(frame.graph(), "shadows.final_tiles", lists->tiles));
  GLOAM_TRY(copies.add(frame.graph(), "shadows.final_entries", lists->entries));
  GLOAM_TRY(copies.add(frame.graph(), "shadows.visibilities", lists->visibilities[0]));
  if (lists->visibilities[1].resource == lists->visibilities[0].resource) return {};
  return copies.add(frame.graph(), "shadows.visibilities_1", lists->visibilities[1]);
}

std::vector<std::string> shadow_pick_lines(FrameBuilder& frame, const PickedPixel& pixel, const Captures& copies) {
  const FinalLists* lists = find_final_lists(frame);
  if (lists == nullptr) return {};
  return PickLines(frame, pixel, copies, *lists).take();
}

}  // namespace gloam
