// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <compare>
#include <cstring>
#include <map>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "engine/render/frame_builder.h"
#include "engine/render/module.h"
#include "engine/render/readback/capture.h"
#include "modules/lights/outputs.h"
#include "modules/shadows/outputs.h"
#include "shaders/lights/lights_shared.h"
#include "shaders/shadows/final_lists_shared.h"

namespace gloam::test {

/// Visibility of a light at the pixels of a tile, in steps, row by row.
struct TileVisibility {
  bool all_lit = false;
  std::array<std::uint8_t, GLOAM_SLOT_PIXELS> steps{};
  bool operator==(const TileVisibility&) const = default;
};

/// A light and a tile.
struct TileLight {
  std::uint32_t tile = 0;
  bool directional = false;
  std::uint32_t light = 0;
  auto operator<=>(const TileLight&) const = default;
};

/// A frame's final lists. Words are decoded here as final_lists_shared.h documents them, independently of the module.
struct ReadFinalLists {
  std::uint32_t frames = 0;  ///< 0: the frame had no final lists
  uvec2 tiles = uvec2(0);
  std::vector<uvec4> texels;
  std::vector<std::uint32_t> entries;
  std::vector<std::uint32_t> words;
  std::vector<std::uint32_t> fallback_tiles;
  shaders::ShadowListCounters counters{};
  shaders::ShadowListCommands commands{};
  std::uint32_t bits = 8;
  std::uint32_t slot_capacity = 0;
  std::uint32_t pair_capacity = 0;
  bool always_complete = false;
  std::vector<Entity> local;        ///< by an entry's light index
  std::vector<Entity> directional;  ///< the same

  [[nodiscard]] bool complete(std::uint32_t tile) const { return texels[tile].y != GLOAM_NO_FINAL_LIST; }
  [[nodiscard]] std::uint32_t most() const { return (1u << bits) - 1; }
  /// Words of one run of a tile's entries.
  [[nodiscard]] std::span<const std::uint32_t> run(std::uint32_t tile, bool of_directional) const {
    if (!complete(tile)) return {};
    const uvec4 t = texels[tile];
    const std::size_t first = of_directional ? t.x : t.y, count = of_directional ? t.z >> 16 : t.z & 0xFFFFu;
    return count == 0 ? std::span<const std::uint32_t>() : std::span(entries).subspan(first, count);
  }
  [[nodiscard]] TileVisibility visibility(std::uint32_t entry) const {
    const std::uint32_t slot = entry >> 10;
    if (slot == GLOAM_ALL_LIT) return {.all_lit = true};
    TileVisibility found;
    const std::size_t per_slot = bits * 2;
    for (std::size_t pixel = 0; pixel < GLOAM_SLOT_PIXELS; ++pixel) {
      const std::size_t bit = pixel * bits;
      const std::uint32_t word = words.at(slot * per_slot + bit / 32);
      found.steps[pixel] = static_cast<std::uint8_t>(word >> bit % 32 & most());
    }
    return found;
  }
  /// All entries of all tiles.
  [[nodiscard]] std::map<TileLight, TileVisibility> all() const {
    std::map<TileLight, TileVisibility> found;
    for (std::uint32_t tile = 0; tile < texels.size(); ++tile)
      for (const bool of_directional : {false, true})
        for (const std::uint32_t entry : run(tile, of_directional))
          found.emplace(TileLight{tile, of_directional, entry & 1023u}, visibility(entry));
    return found;
  }
};

/// Reads the final lists of frames. Must come after the other modules.
class FinalListReader final : public Module {
 public:
  [[nodiscard]] std::string_view name() const override { return "final_list_reader"; }
  void register_components(World&) const override {}
  void scene_keys(KeyRegistry&) const override {}
  [[nodiscard]] Demand demand(const World&, const RenderView*) const override { return {true, "always"}; }
  void add_passes(FrameBuilder& frame, PassPhase phase) override {
    if (phase != PassPhase::visualize || !wanted) return;
    const ShadowsOutputs* shadows = frame.find<ShadowsOutputs>();
    read_ = {};
    copies_.reset();
    if (shadows == nullptr || !shadows->final_lists) return;
    const FinalLists& lists = *shadows->final_lists;
    note(frame, lists);
    copies_ = std::make_unique<Captures>(frame.services().device);
    const auto copy = [&](const char* what, auto ref) {
      static_cast<void>(frame.check(copies_->add(frame.graph(), what, ref)));
    };
    copy("tiles", lists.tiles);
    copy("entries", lists.entries);
    copy("words", lists.visibilities[0]);
    if (lists.visibilities[1].resource != lists.visibilities[0].resource) copy("more words", lists.visibilities[1]);
    copy("fallback", lists.fallback_tiles);
    copy("counters", lists.counters);
    copy("commands", lists.commands);
  }
  void release() override { copies_.reset(); }

  /// The lists of the last frame, which must have ended.
  [[nodiscard]] const ReadFinalLists& read() {
    if (copies_ == nullptr) return read_;
    copies_->finish();
    take("tiles", read_.texels);
    take("entries", read_.entries);
    take("words", read_.words);
    std::vector<std::uint32_t> more;
    take("more words", more);
    read_.words.insert(read_.words.end(), more.begin(), more.end());
    take("fallback", read_.fallback_tiles);
    read_.counters = copies_->item<shaders::ShadowListCounters>("counters", 0);
    read_.commands = copies_->item<shaders::ShadowListCommands>("commands", 0);
    read_.fallback_tiles.resize(std::min<std::size_t>(read_.fallback_tiles.size(), read_.commands.fallback_draw.y));
    read_.frames = 1;
    copies_.reset();
    return read_;
  }

  bool wanted = false;

 private:
  void note(FrameBuilder& frame, const FinalLists& lists) {
    const gpu::ImageDesc& tiles = frame.graph().desc(lists.tiles);
    read_.tiles = {tiles.width, tiles.height};
    read_.bits = lists.visibility_bits;
    read_.slot_capacity = lists.slot_capacity;
    read_.pair_capacity = lists.pair_capacity;
    read_.always_complete = lists.always_complete;
    const auto& visible = frame.world().view_resource<VisibleLights>(frame.view().id);
    const auto local = local_lights(visible), directional = directional_lights(visible);
    read_.local.assign(local.begin(), local.end());
    read_.directional.assign(directional.begin(), directional.end());
  }
  template <class T>
  void take(std::string_view what, std::vector<T>& items) const {
    const std::span<const std::byte> bytes = copies_->bytes(what);
    items.resize(bytes.size() / sizeof(T));
    if (!items.empty()) std::memcpy(items.data(), bytes.data(), items.size() * sizeof(T));
  }

  ReadFinalLists read_;
  std::unique_ptr<Captures> copies_;
};

}  // namespace gloam::test
