// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/relighting/capture_factors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include "engine/ecs/view.h"
#include "engine/scene/components.h"
#include "modules/reflections/culling/placed.h"

namespace gloam {
namespace {

constexpr double kBlack = 1e-6;       // factor below which the light that is left is rounding
constexpr double kLeastShare = 0.02;  // of the mean light of a capture, added to each cell
constexpr double kMostAdded = 2.0;    // factor for the light of cells that lay in the dark
constexpr double kTurned = 0.5;       // share of its distance by which a light must move to light a surface differently
constexpr double kUsualAlbedo = 0.3;  // of surfaces whose light is not in the capture

double luminance(const dvec3& color) { return glm::dot(color, dvec3(0.2126, 0.7152, 0.0722)); }

/// 0: the light shines on the surface as before. 1: from quite another place.
double turned(const CapturedLightState& then, const CapturedLightState& now, const dvec3& center) {
  if (then.kind != now.kind || then.emitted == vec3(0.0f)) return 1.0;
  const double turn = 0.5 * glm::length(now.direction - then.direction) / kTurned;
  const double distance = std::min(glm::length(then.position - center), glm::length(now.position - center));
  const double moved = glm::length(now.position - then.position);
  const double share = moved > 0.0 ? moved / std::max(kTurned * distance, 1e-9) : 0.0;
  return std::min(std::max(turn, share), 1.0);
}

/// A change of one lamp as a cell of a capture sees it, lux.
struct Change {
  dvec3 then = dvec3(0.0);
  dvec3 now = dvec3(0.0);
};

/// Light of all cells of a capture.
struct CellSums {
  dvec3 then = dvec3(0.0);
  dvec3 now = dvec3(0.0);
};

/// One channel of a cell's factor. mean_then, mean_now: of all cells; a share of them keeps cells that were nearly dark
/// from factors without bounds.
double factor_channel(double then, double now, double mean_then, double mean_now) {
  if (!(mean_then > 0.0)) return 1.0;
  const double factor = (now + kLeastShare * mean_now) / (then + kLeastShare * mean_then);
  return std::min(factor > kBlack ? factor : 0.0, static_cast<double>(kMostCaptureFactor));
}

/// Sums up how lamps of a capture have changed, and makes its factors.
class LightShares {
 public:
  explicit LightShares(const CapturedParts& parts) : parts_(parts) {
    for (const vec3& lux : parts.lamps_lux) then_ += dvec3(lux);
  }
  /// change: sum over all cells. turned: turned().
  void add(const Change& change, double turned) { changes_.push_back({change, turned}); }
  /// Appends the capture's factors.
  [[nodiscard]] CaptureFactor finish(std::span<const CellSums> sums, std::vector<vec4>& cells) const {
    CaptureFactor result;
    if (changes_.empty()) return result;
    const auto count = static_cast<double>(sums.size());
    dvec3 now(0.0), shown(0.0);
    for (const CellSums& sum : sums) now += glm::max(sum.now, dvec3(0.0));
    std::vector<dvec3> factors;
    bool limited = false, all_1 = true;
    for (const CellSums& sum : sums) {
      dvec3& factor = factors.emplace_back();
      for (int c = 0; c < 3; ++c)
        factor[c] = factor_channel(sum.then[c], std::max(sum.now[c], 0.0), then_[c] / count, now[c] / count);
      shown += factor * sum.then;
    }
    for (dvec3& factor : factors)
      for (int c = 0; c < 3; ++c) {
        // What lay in the dark cannot show its light: the other cells do.
        if (shown[c] > 0.0) factor[c] *= std::clamp(now[c] / shown[c], 1.0, kMostAdded);
        factor[c] = std::min(factor[c], static_cast<double>(kMostCaptureFactor));
        limited = limited || factor[c] >= static_cast<double>(kMostCaptureFactor);
        if (std::abs(factor[c] - 1.0) < 1e-6) factor[c] = 1.0;
        all_1 = all_1 && factor[c] == 1.0;
      }
    result.error = error(now, limited);
    if (all_1) return result;
    result.first = static_cast<std::int32_t>(cells.size());
    for (const dvec3& factor : factors) cells.emplace_back(vec3(factor), 1.0f);
    return result;
  }

 private:
  struct Share {
    Change change;
    double turned = 0.0;
  };
  /// CaptureFactor::error. now: sum over all cells.
  [[nodiscard]] float error(const dvec3& now, bool limited) const {
    const double lux = luminance(now), cells = static_cast<double>(parts_.lamps_lux.size());
    if (!(lux > kBlack * luminance(then_))) return 0.0f;
    dvec3 factor(1.0), left = then_;
    for (int c = 0; c < 3; ++c) factor[c] = then_[c] > 0.0 ? now[c] / then_[c] : 1.0;
    double misplaced = 0.0, elsewhere = 0.0;
    for (const Share& share : changes_) {
      const dvec3 scaled = factor * share.change.then;
      left -= share.change.then;
      misplaced += (1.0 - share.turned) * luminance(glm::abs(share.change.now - scaled)) +
                   share.turned * luminance(share.change.now + scaled);
      elsewhere += share.turned * luminance(share.change.now);
    }
    misplaced += luminance(glm::abs(dvec3(1.0) - factor) * glm::max(left, dvec3(0.0)));
    // What lay in the dark has no light that a factor could scale.
    const double lit = std::max(static_cast<double>(parts_.lit) * luminance(factor),
                                kUsualAlbedo / std::numbers::pi * elsewhere / cells);
    const double all = lit + static_cast<double>(parts_.unlit);
    const double share = limited || !(luminance(then_) > 0.0) ? 1.0 : std::min(misplaced / (2.0 * lux), 1.0);
    return all > 0.0 ? static_cast<float>(share * lit / all) : 0.0f;
  }

  const CapturedParts& parts_;
  dvec3 then_ = dvec3(0.0);  ///< sum over all cells, lux
  std::vector<Share> changes_;
};

}  // namespace

struct CaptureFactors::Surfaces {
  std::vector<LitPatch> patches;    ///< of its cells
  std::size_t first = 0;            ///< number of its first cell among those of all captures
  std::vector<Entity> only_lights;  ///< if `named`: the lights that count
  bool named = false;

  [[nodiscard]] bool counts(Entity light) const {
    return !named || std::ranges::find(only_lights, light) != only_lights.end();
  }
};

bool own_light(const IbrProxy& proxy) {
  return proxy.kind == IbrProxyKind::fire || (proxy.texture != 0 && proxy.lights != 0);
}

std::vector<CaptureFactors::Changed> CaptureFactors::changed_lights(const World& world,
                                                                    const ReflectionCaptures& captures) {
  const std::vector<CapturedLightState>& then = captures.lights;
  std::vector<Changed> changed;
  std::size_t found = 0;
  world.view<const Light, const WorldTransform>().each(
      [&](Entity entity, const Light& light, const WorldTransform& transform) {
        CapturedLightState now = light_state(entity, light, transform.matrix);
        const auto at = std::lower_bound(then.begin(), then.end(), entity,
                                         [](const CapturedLightState& a, Entity b) { return a.light.index < b.index; });
        const bool known = at != then.end() && at->light == entity;
        found += known ? 1 : 0;
        if (known && *at == now) return;
        if (!known && now.emitted == vec3(0.0f)) return;
        Changed next{.then = {}, .now = now, .captured = then.size()};
        if (known) next.then = *at, next.captured = static_cast<std::size_t>(at - then.begin());
        changed.push_back(next);
      });
  if (found < then.size())
    for (std::size_t i = 0; i < then.size(); ++i) {
      const Entity light = then[i].light;
      if (world.alive(light) && world.has<Light>(light) && world.has<WorldTransform>(light)) continue;
      if (then[i].emitted == vec3(0.0f)) continue;
      Changed next{.then = then[i], .now = {}, .captured = i};
      next.now.light = light;
      changed.push_back(next);
    }
  std::ranges::sort(changed, [](const Changed& a, const Changed& b) {
    return std::pair(a.captured, a.now.light.index) < std::pair(b.captured, b.now.light.index);
  });
  return changed;
}

void CaptureFactors::update(const World& world, const ReflectionCaptures& captures) {
  const ProxySet* places = world.try_resource<ProxySet>();
  const std::uint64_t places_version = places == nullptr ? 0 : places->version;
  std::vector<Changed> changed = changed_lights(world, captures);
  const std::size_t proxies = captures.proxy_entities.size(), probes = captures.probe_entities.size();
  const bool same_places = version_ != 0 && captures_version_ == captures.version &&
                           places_version == places_version_ && proxies_.size() == proxies &&
                           probes_.size() == probes && units_.size() == captures.lights.size();
  if (same_places && changed == changed_) return;
  if (!same_places) units_.assign(captures.lights.size(), {});
  captures_version_ = captures.version;
  places_version_ = places_version;
  changed_ = std::move(changed);
  ++version_;
  all_cells_ = proxies * kProxyCells * kProxyCells + probes * kProbeCells * kProbeCells;
  proxies_.assign(proxies, {});
  probes_.assign(probes, {});
  cells_.clear();
  outdated_ = 0;
  if (!changed_.empty()) update_all(world, captures);
}

void CaptureFactors::update_all(const World& world, const ReflectionCaptures& captures) {
  for (std::size_t i = 0; i < proxies_.size() && i < captures.proxy_parts.size(); ++i) {
    const Entity entity = captures.proxy_entities[i];
    const IbrProxy* proxy = world.try_get<IbrProxy>(entity);
    const WorldTransform* transform = world.try_get<WorldTransform>(entity);
    PlacedProxy placed;
    if (proxy == nullptr || transform == nullptr || own_light(*proxy)) continue;
    if (place_proxy(entity, *proxy, transform->matrix, placed) != ProxyPlacement::placed) continue;
    Surfaces surfaces{.patches = proxy_patches(placed, captures.proxy_parts[i].surface_m),
                      .first = i * kProxyCells * kProxyCells,
                      .only_lights = {},
                      .named = proxy->lights != 0};
    if (surfaces.named)
      for (const CapturedProxyLight& light : captures.proxy_lights)
        if (light.layer == i) surfaces.only_lights.push_back(light.light);
    proxies_[i] = factor_of(surfaces, captures.proxy_parts[i]);
  }
  for (std::size_t i = 0; i < probes_.size() && i < captures.probe_parts.size(); ++i) {
    const WorldTransform* transform = world.try_get<WorldTransform>(captures.probe_entities[i]);
    if (transform == nullptr) continue;
    const Surfaces surfaces{.patches = probe_patches(dvec3(transform->matrix[3]), captures.probe_parts[i].surfaces),
                            .first = proxies_.size() * kProxyCells * kProxyCells + i * kProbeCells * kProbeCells,
                            .only_lights = {},
                            .named = false};
    probes_[i] = factor_of(surfaces, captures.probe_parts[i]);
  }
  for (const std::vector<CaptureFactor>* all : {&proxies_, &probes_})
    outdated_ += static_cast<std::size_t>(
        std::ranges::count_if(*all, [](const CaptureFactor& one) { return one.error > kMostCaptureError; }));
}

double CaptureFactors::unit_then(const Surfaces& surfaces, const Changed& light, std::size_t cell) {
  if (light.captured >= units_.size() || light.then.emitted == vec3(0.0f)) return 0.0;
  std::vector<float>& units = units_[light.captured];
  if (units.empty()) units.assign(all_cells_, std::numeric_limits<float>::quiet_NaN());
  float& unit = units[surfaces.first + cell];
  if (std::isnan(unit)) {
    unit = static_cast<float>(unit_illuminance(light.then, surfaces.patches[cell]));
    ++evaluations_;
  }
  return static_cast<double>(unit);
}

CaptureFactor CaptureFactors::factor_of(const Surfaces& surfaces, const CapturedParts& parts) {
  const std::size_t cells = surfaces.patches.size();
  if (cells == 0 || parts.lamps_lux.size() != cells) return {};
  std::vector<CellSums> sums(cells);
  for (std::size_t cell = 0; cell < cells; ++cell)
    sums[cell] = {dvec3(parts.lamps_lux[cell]), dvec3(parts.lamps_lux[cell])};
  LightShares shares(parts);
  for (const Changed& light : changed_) {
    if (!surfaces.counts(light.captured < units_.size() ? light.then.light : light.now.light)) continue;
    const bool elsewhere = !light.then.same_place(light.now) || light.then.emitted == vec3(0.0f);
    Change all;
    for (std::size_t cell = 0; cell < cells; ++cell) {
      const double unit = unit_then(surfaces, light, cell);
      double today = unit;
      if (light.now.emitted == vec3(0.0f)) {
        today = 0.0;
      } else if (elsewhere) {
        today = unit_illuminance(light.now, surfaces.patches[cell]);
        ++evaluations_;
      }
      const Change change{unit * dvec3(light.then.emitted), today * dvec3(light.now.emitted)};
      sums[cell].now += change.now - change.then;
      all.then += change.then, all.now += change.now;
    }
    shares.add({all.then, all.now}, turned(light.then, light.now, surfaces.patches[cells / 2].center));
  }
  return shares.finish(sums, cells_);
}

}  // namespace gloam
