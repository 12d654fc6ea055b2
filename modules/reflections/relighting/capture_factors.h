// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/ecs/world.h"
#include "modules/reflections/captures.h"
#include "modules/reflections/relighting/light_states.h"

namespace gloam {

/// How the light of one capture has changed since.
struct CaptureFactor {
  /// First of the capture's factors among CaptureFactors::cells(), one for each cell of its image; −1: all are 1.
  std::int32_t first = -1;
  /// Estimated share of the capture's light, 0…1, that lies in the wrong place although its sum is right: lamps that
  /// dim or move apart from the others. 0: all lamps have changed alike. 1 where a factor is at its limit, and where
  /// what was dark is lit.
  float error = 0.0f;
};

inline constexpr float kMostCaptureFactor = 64.0f;
/// A capture is outdated if its error is greater.
inline constexpr float kMostCaptureError = 0.25f;

/// Factors of all captures of a world. The lights of the world are compared with those at capture in each update; only
/// if they differ from the update before, captures are looked at, and of the lights only those that have changed since
/// the capture.
class CaptureFactors {
 public:
  /// Brings the factors up to date. The captures are of this world.
  void update(const World& world, const ReflectionCaptures& captures);

  /// Factors of the part that lamps cause (linear RGB, w: 1): their illuminance now as a share of that at capture,
  /// without shadows; 0…kMostCaptureFactor. The mean over a capture is right also where parts of it were dark; a
  /// capture without any light has none.
  [[nodiscard]] std::span<const vec4> cells() const { return cells_; }
  /// By layer. Proxies with an image of their own (fires, image files with named lights) have none: see
  /// own_light().
  [[nodiscard]] std::span<const CaptureFactor> proxies() const { return proxies_; }
  [[nodiscard]] std::span<const CaptureFactor> probes() const { return probes_; }
  /// Notes that a capture shows its proxy as it is since the last update, with the lamps of that moment. row: layer of
  /// the proxy; for a probe the number of proxies plus its layer. The next update sees it.
  void note_recapture(std::size_t row);
  /// Notes that all proxies, or all probes, show again what they showed when they were baked.
  void forget_proxy_recaptures() { forget_recaptures(0, proxies_.size()); }
  void forget_probe_recaptures() { forget_recaptures(proxies_.size(), recaptures_.size()); }
  /// Captures of this row that were noted since the captures were put into the world.
  [[nodiscard]] bool recaptured(std::size_t row) const { return row < recaptures_.size() && recaptures_[row].noted; }

  /// Proxies and probes whose error is above kMostCaptureError.
  [[nodiscard]] std::size_t outdated() const { return outdated_; }
  /// Illuminances that were computed, of one light on one cell, since the object was made.
  [[nodiscard]] std::uint64_t evaluations() const { return evaluations_; }
  /// Changes whenever a factor may have changed.
  [[nodiscard]] std::uint64_t version() const { return version_; }

 private:
  struct Changed {
    CapturedLightState then;   ///< emits nothing: added since
    CapturedLightState now;    ///< emits nothing: no longer there
    std::size_t captured = 0;  ///< index into ReflectionCaptures::lights; their number: added since
    friend bool operator==(const Changed&, const Changed&) = default;
  };
  struct Surfaces;  ///< of one capture
  /// A lamp as a capture was or would be made under it.
  struct Lamp {
    CapturedLightState state;
    dvec3 lux = dvec3(0.0);  ///< its illuminance of all cells together
  };
  [[nodiscard]] static std::uint32_t lamp_index(const Lamp& lamp) { return lamp.state.light.index; }
  /// What a capture would be if it were made now. Without cells if nothing has changed.
  struct Today {
    std::vector<vec3> lux;                             ///< CapturedParts::lamps_lux
    std::vector<std::pair<std::size_t, dvec3>> lamps;  ///< index into `changed_` and Lamp::lux
    float lit = 0.0f;                                  ///< CapturedParts::lit
  };
  /// A capture that was made after the bake.
  struct Recapture {
    bool noted = false;
    std::vector<vec3> lux;  ///< CapturedParts::lamps_lux
    std::vector<Lamp>
        lamps;  ///< by entity index: those that differ from ReflectionCaptures::lights, also if they emit nothing
    float lit = 0.0f;  ///< CapturedParts::lit
  };
  [[nodiscard]] static std::vector<Changed> changed_lights(const World& world, const ReflectionCaptures& captures);
  void forget_recaptures(std::size_t first, std::size_t end);
  void update_all(const World& world, const ReflectionCaptures& captures);
  [[nodiscard]] CaptureFactor factor_of(const Surfaces& surfaces, const CapturedParts& parts, std::size_t row);
  /// Of the capture's cells; empty: the light emitted nothing.
  [[nodiscard]] std::span<const float> units_then(const Surfaces& surfaces, const Changed& light);

  std::vector<CaptureFactor> proxies_;
  std::vector<CaptureFactor> probes_;
  std::vector<vec4> cells_;
  std::vector<Changed> changed_;
  std::vector<std::uint32_t> changed_entities_;  ///< indices of their entities, ascending
  /// By captured light: its unit illuminances at capture in all cells of all captures; NaN: not computed yet.
  std::vector<std::vector<float>> units_;
  std::vector<Recapture> recaptures_;  ///< by row
  std::vector<Today> today_;           ///< by row
  bool recaptures_changed_ = false;
  std::size_t all_cells_ = 0;
  std::size_t outdated_ = 0;
  std::uint64_t evaluations_ = 0;
  std::uint64_t version_ = 0;
  std::uint64_t captures_version_ = 0;
  std::uint64_t places_version_ = 0;
};

/// Whether a proxy shows a light of its own, which dims it as a whole and without which it vanishes (proxy_dim): a
/// fire, or an image file with named lights.
[[nodiscard]] bool own_light(const IbrProxy& proxy);

}  // namespace gloam
