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

/// One channel of a cell's factor. mean_then, mean_now: of all cells; a share of them keeps cells that were nearly dark
/// from factors without bounds.
double factor_channel(double then, double now, double mean_then, double mean_now) {
  if (!(mean_then > 0.0)) return 1.0;
  const double factor = (now + kLeastShare * mean_now) / (then + kLeastShare * mean_then);
  return std::min(factor > kBlack ? factor : 0.0, static_cast<double>(kMostCaptureFactor));
}

/// Sums up how lamps have changed since a capture was made, and makes its factors.
class LightShares {
 public:
  /// then, now: illuminance of each cell. lit, unlit: of CapturedParts.
  LightShares(std::span<const vec3> then, std::span<const dvec3> now, double lit, double unlit)
      : then_(then), now_(now), lit_(lit), unlit_(unlit) {
    for (const vec3& lux : then) all_then_ += dvec3(lux);
    for (const dvec3& lux : now) all_now_ += lux;
  }
  /// change: sum over all cells. turned: turned().
  void add(const Change& change, double turned) { changes_.push_back({change, turned}); }
  /// Appends the capture's factors.
  [[nodiscard]] CaptureFactor finish(std::vector<vec4>& cells) const {
    CaptureFactor result;
    const auto count = static_cast<double>(then_.size());
    dvec3 shown(0.0);
    std::vector<dvec3> factors;
    bool limited = false, all_1 = true;
    for (std::size_t cell = 0; cell < then_.size(); ++cell) {
      dvec3& factor = factors.emplace_back();
      const dvec3 then(then_[cell]);
      for (int c = 0; c < 3; ++c)
        factor[c] = factor_channel(then[c], now_[cell][c], all_then_[c] / count, all_now_[c] / count);
      shown += factor * then;
    }
    for (dvec3& factor : factors)
      for (int c = 0; c < 3; ++c) {
        // What lay in the dark cannot show its light: the other cells do.
        if (shown[c] > 0.0) factor[c] *= std::clamp(all_now_[c] / shown[c], 1.0, kMostAdded);
        factor[c] = std::min(factor[c], static_cast<double>(kMostCaptureFactor));
        limited = limited || factor[c] >= static_cast<double>(kMostCaptureFactor);
        if (std::abs(factor[c] - 1.0) < 1e-6) factor[c] = 1.0;
        all_1 = all_1 && factor[c] == 1.0;
      }
    result.error = error(limited);
    if (all_1) return result;
    result.first = static_cast<std::int32_t>(cells.size());
    for (const dvec3& factor : factors) cells.emplace_back(vec3(factor), 1.0f);
    return result;
  }
  /// CapturedParts::lit of a capture that is made now.
  [[nodiscard]] double lit_now() const {
    double elsewhere = 0.0;
    for (const Share& share : changes_) elsewhere += share.turned * luminance(share.change.now);
    // What lay in the dark has no light that a factor could scale.
    return std::max(lit_ * luminance(mean_factor()),
                    kUsualAlbedo / std::numbers::pi * elsewhere / static_cast<double>(then_.size()));
  }

 private:
  struct Share {
    Change change;
    double turned = 0.0;
  };
  [[nodiscard]] dvec3 mean_factor() const {
    dvec3 factor(1.0);
    for (int c = 0; c < 3; ++c) factor[c] = all_then_[c] > 0.0 ? all_now_[c] / all_then_[c] : 1.0;
    return factor;
  }
  /// CaptureFactor::error.
  [[nodiscard]] float error(bool limited) const {
    const double lux = luminance(all_now_);
    if (!(lux > kBlack * luminance(all_then_))) return 0.0f;
    const dvec3 factor = mean_factor();
    dvec3 left = all_then_;
    double misplaced = 0.0;
    for (const Share& share : changes_) {
      const dvec3 scaled = factor * share.change.then;
      left -= share.change.then;
      misplaced += (1.0 - share.turned) * luminance(glm::abs(share.change.now - scaled)) +
                   share.turned * luminance(share.change.now + scaled);
    }
    misplaced += luminance(glm::abs(dvec3(1.0) - factor) * glm::max(left, dvec3(0.0)));
    const double lit = lit_now(), all = lit + unlit_;
    const double share = limited || !(luminance(all_then_) > 0.0) ? 1.0 : std::min(misplaced / (2.0 * lux), 1.0);
    return all > 0.0 ? static_cast<float>(share * lit / all) : 0.0f;
  }

  std::span<const vec3> then_;
  std::span<const dvec3> now_;
  double lit_ = 0.0;
  double unlit_ = 0.0;
  dvec3 all_then_ = dvec3(0.0);
  dvec3 all_now_ = dvec3(0.0);
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
  if (same_places && changed == changed_ && !recaptures_changed_) return;
  if (!same_places) units_.assign(captures.lights.size(), {});
  if (captures_version_ != captures.version || recaptures_.size() != proxies + probes)
    recaptures_.assign(proxies + probes, {});
  recaptures_changed_ = false;
  today_.assign(proxies + probes, {});
  captures_version_ = captures.version;
  places_version_ = places_version;
  changed_ = std::move(changed);
  changed_entities_.clear();
  for (const Changed& light : changed_) changed_entities_.push_back(light.now.light.index);
  std::ranges::sort(changed_entities_);
  ++version_;
  all_cells_ = proxies * kProxyCells * kProxyCells + probes * kProbeCells * kProbeCells;
  proxies_.assign(proxies, {});
  probes_.assign(probes, {});
  cells_.clear();
  outdated_ = 0;
  const bool noted = std::ranges::any_of(recaptures_, &Recapture::noted);
  if (noted || !changed_.empty()) update_all(world, captures);
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
    proxies_[i] = factor_of(surfaces, captures.proxy_parts[i], i);
  }
  for (std::size_t i = 0; i < probes_.size() && i < captures.probe_parts.size(); ++i) {
    const WorldTransform* transform = world.try_get<WorldTransform>(captures.probe_entities[i]);
    if (transform == nullptr) continue;
    const Surfaces surfaces{.patches = probe_patches(dvec3(transform->matrix[3]), captures.probe_parts[i].surfaces),
                            .first = proxies_.size() * kProxyCells * kProxyCells + i * kProbeCells * kProbeCells,
                            .only_lights = {},
                            .named = false};
    probes_[i] = factor_of(surfaces, captures.probe_parts[i], proxies_.size() + i);
  }
  for (const std::vector<CaptureFactor>* all : {&proxies_, &probes_})
    outdated_ += static_cast<std::size_t>(
        std::ranges::count_if(*all, [](const CaptureFactor& one) { return one.error > kMostCaptureError; }));
}

std::span<const float> CaptureFactors::units_then(const Surfaces& surfaces, const Changed& light) {
  if (light.captured >= units_.size() || light.then.emitted == vec3(0.0f)) return {};
  std::vector<float>& all = units_[light.captured];
  if (all.empty()) all.assign(all_cells_, std::numeric_limits<float>::quiet_NaN());
  const std::span<float> units = std::span(all).subspan(surfaces.first, surfaces.patches.size());
  for (std::size_t cell = 0; cell < units.size(); ++cell) {
    if (!std::isnan(units[cell])) continue;
    units[cell] = static_cast<float>(unit_illuminance(light.then, surfaces.patches[cell]));
    ++evaluations_;
  }
  return units;
}

CaptureFactor CaptureFactors::factor_of(const Surfaces& surfaces, const CapturedParts& parts, std::size_t row) {
  const std::size_t cells = surfaces.patches.size();
  if (cells == 0 || parts.lamps_lux.size() != cells) return {};
  std::vector<dvec3> now(parts.lamps_lux.begin(), parts.lamps_lux.end());
  Today& today = today_[row];
  std::vector<Change> changes;
  for (std::size_t i = 0; i < changed_.size(); ++i) {
    const Changed& light = changed_[i];
    if (!surfaces.counts(light.captured < units_.size() ? light.then.light : light.now.light)) continue;
    Change& all = changes.emplace_back();
    const std::span<const float> units = units_then(surfaces, light);
    const dvec3 emitted_then(light.then.emitted), emitted_now(light.now.emitted);
    const bool stays = !units.empty() && light.then.same_place(light.now);
    const dvec3 change = (stays ? emitted_now : dvec3(0.0)) - emitted_then;
    double sum = 0.0;
    for (std::size_t cell = 0; cell < units.size(); ++cell) {
      const auto unit = static_cast<double>(units[cell]);
      now[cell] += unit * change;
      sum += unit;
    }
    all = {sum * emitted_then, stays ? sum * emitted_now : dvec3(0.0)};
    if (!stays && light.now.emitted != vec3(0.0f))
      for (std::size_t cell = 0; cell < cells; ++cell) {
        const dvec3 lux = unit_illuminance(light.now, surfaces.patches[cell]) * emitted_now;
        ++evaluations_;
        now[cell] += lux;
        all.now += lux;
      }
    today.lamps.emplace_back(i, all.now);
  }
  for (dvec3& lux : now) lux = glm::max(lux, dvec3(0.0));
  const Recapture& before = recaptures_[row];
  LightShares shares(before.noted ? before.lux : parts.lamps_lux, now,
                     static_cast<double>(before.noted ? before.lit : parts.lit), static_cast<double>(parts.unlit));
  const dvec3 center = surfaces.patches[cells / 2].center;
  for (std::size_t i = 0, lamp = 0; i < changed_.size() && lamp < changes.size(); ++i) {
    const Changed& light = changed_[i];
    if (!surfaces.counts(light.captured < units_.size() ? light.then.light : light.now.light)) continue;
    Change change = changes[lamp++];
    CapturedLightState then = light.then;
    const auto past = std::ranges::lower_bound(before.lamps, light.now.light.index, {}, &lamp_index);
    if (past != before.lamps.end() && past->state.light == light.now.light) then = past->state, change.then = past->lux;
    shares.add(change, turned(then, light.now, center));
  }
  // Lamps that are as at the bake, but were not when the capture was made.
  for (const Lamp& past : before.lamps)
    if (!std::ranges::binary_search(changed_entities_, past.state.light.index)) shares.add({past.lux, dvec3(0.0)}, 1.0);
  today.lux.assign(now.begin(), now.end());
  today.lit = static_cast<float>(shares.lit_now());
  return shares.finish(cells_);
}

void CaptureFactors::note_recapture(std::size_t row) {
  if (row >= today_.size() || today_[row].lux.empty()) return;
  const Today& today = today_[row];
  Recapture& made = recaptures_[row];
  made = {.noted = true, .lux = today.lux, .lamps = {}, .lit = today.lit};
  for (const auto& [index, lux] : today.lamps) made.lamps.push_back({changed_[index].now, lux});
  std::ranges::sort(made.lamps, {}, &lamp_index);
  // Before the next update, it is not asked for a second time.
  CaptureFactor& noted = row < proxies_.size() ? proxies_[row] : probes_[row - proxies_.size()];
  if (noted.error > kMostCaptureError) --outdated_;
  noted.error = 0.0f;
  recaptures_changed_ = true;
}

void CaptureFactors::forget_recaptures(std::size_t first, std::size_t end) {
  for (std::size_t row = first; row < std::min(end, recaptures_.size()); ++row) {
    recaptures_changed_ = recaptures_changed_ || recaptures_[row].noted;
    recaptures_[row] = {};
  }
}

}  // namespace gloam
