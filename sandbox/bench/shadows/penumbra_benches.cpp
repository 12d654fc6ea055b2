// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/hash.h"
#include "engine/scene/resources.h"
#include "modules/lights/components.h"
#include "modules/shadows/atlas/view_faces.h"
#include "modules/shadows/components.h"
#include "modules/shadows/knobs.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/harness/once.h"
#include "sandbox/scenes/lamps/penumbra.h"

// Drawn width of the penumbra of a disc light and a straight edge against the analytic width: by height of the edge,
// resolution of the map and field of view of the light.

namespace gloam {
namespace {

constexpr const char* kPenumbraScene = "builtin:penumbra";
constexpr std::array<double, 5> kHeights_m = {0.1, 0.3, 1.0, 3.0, 10.0};
constexpr std::array<const char*, 5> kHeightNames = {"0.1m", "0.3m", "1m", "3m", "10m"};
constexpr std::array<std::uint32_t, 3> kResolutions = {512, 1024, 2048};
constexpr std::array<float, 2> kOuterAngles = {0.35f, 0.7f};
constexpr std::uint32_t kPenumbraColumns = 512;
constexpr std::uint32_t kPenumbraRows = 8;
constexpr double kEnoughTexels = 8.0;
constexpr double kLow = 0.1, kHigh = 0.9;

/// Share of a disc of radius 1 on one side of a line at signed distance u from its centre.
double disc_share(double u) {
  u = std::clamp(u, -1.0, 1.0);
  return 0.5 + (std::asin(u) + u * std::sqrt(1.0 - u * u)) / std::numbers::pi;
}

/// Width of a disc's penumbra between the visibilities kLow and kHigh, as a share of its full width.
double measured_share_of_disc() {
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (disc_share(middle) < kHigh ? low : high) = middle;
  }
  return low;  // from -low to low, of a width of 2
}

/// The column (interpolated) at which a rising row of visibilities first reaches `share`; NaN if it never does.
double crossing(const std::vector<double>& row, double share) {
  for (std::size_t i = 1; i < row.size(); ++i)
    if (row[i - 1] < share && row[i] >= share)
      return static_cast<double>(i - 1) + (share - row[i - 1]) / (row[i] - row[i - 1]);
  return std::nan("");
}

struct Setting {
  double height_m = 1.0;
  std::uint32_t resolution = 1024;
  float outer_angle = 0.5f;
};

struct Penumbra {
  double analytic_m = 0.0;
  double drawn_m = 0.0;
  double texel_m = 0.0;    ///< width of a texel of mip 0 at the floor
  std::uint64_t hash = 0;  ///< of the drawn visibilities
  [[nodiscard]] bool fine() const { return analytic_m >= kEnoughTexels * texel_m; }
  /// Relative to the analytic width if that is at least kEnoughTexels wide. Otherwise in texels: 2 texels count 0.1,
  /// the bar.
  [[nodiscard]] double deviation() const {
    const double off = std::abs(drawn_m - analytic_m);
    return fine() ? off / analytic_m : 0.1 * off / (2.0 * texel_m);
  }
};

/// Looks straight down onto the edge's shadow, from below the sheet.
ViewSettings view_below(const Setting& setting, double half_width_m) {
  ViewSettings settings;
  settings.width = kPenumbraColumns;
  settings.height = kPenumbraRows;
  settings.follow_camera = false;
  settings.world_from_camera =
      dmat4(dvec4(1, 0, 0, 0), dvec4(0, 0, -1, 0), dvec4(0, 1, 0, 0), dvec4(0.0, 0.5 * setting.height_m, 0.0, 1.0));
  settings.camera.orthographic = true;
  settings.camera.half_width_m = static_cast<float>(half_width_m);
  settings.camera.half_height_m = static_cast<float>(half_width_m * kPenumbraRows / kPenumbraColumns);
  settings.camera.near_m = static_cast<float>(0.1 * setting.height_m);
  settings.camera.far_m = static_cast<float>(setting.height_m);
  settings.visualizer = "shadow:lamp";
  return settings;
}

Result<Penumbra> measure_penumbra(Session& session, const Setting& setting) {
  World& world = session.world;
  const auto lamp = world.resource<SceneNames>().find("light", "lamp");
  if (!lamp) return lamp.error();
  const auto sheet = world.resource<SceneNames>().find("mesh", "sheet");
  if (!sheet) return sheet.error();
  auto& light = world.get<Light>(*lamp);
  light.outer_angle = setting.outer_angle;
  light.inner_angle = 0.9f * setting.outer_angle;
  world.get<ShadowCaster>(*lamp).resolution = setting.resolution;
  world.get<LocalTransform>(*sheet).translation.y = setting.height_m;

  Penumbra penumbra;
  penumbra.analytic_m = setting.height_m * light.width_m / (kPenumbraLampHeight_m - setting.height_m);
  const double rim = 1.0 + static_cast<double>(ShadowSettings{}.kernel_rim);
  penumbra.texel_m = 2.0 * rim * std::tan(setting.outer_angle) * kPenumbraLampHeight_m / setting.resolution;
  const double half_width_m = 1.2 * penumbra.analytic_m + 6.0 * penumbra.texel_m;
  const ViewRequest request{view_below(setting, half_width_m), {}};
  if (auto frame = session.render_frame(request); !frame) return frame.error();
  const auto image = session.renderer->read_image(world, request.settings.id, "shadow_visibility");
  if (!image) return image.error();
  std::vector<float> visibility(std::size_t{kPenumbraColumns} * kPenumbraRows);
  std::memcpy(visibility.data(), image->bytes.data(), visibility.size() * sizeof(float));
  penumbra.hash = hash_bytes(image->bytes);
  std::vector<double> row(kPenumbraColumns, 0.0);
  for (std::size_t i = 0; i < visibility.size(); ++i)
    row[i % kPenumbraColumns] += static_cast<double>(visibility[i]) / kPenumbraRows;
  const double columns = crossing(row, kHigh) - crossing(row, kLow);
  penumbra.drawn_m = columns * 2.0 * half_width_m / kPenumbraColumns / measured_share_of_disc();
  return penumbra;
}

struct Widths {
  std::array<Penumbra, kHeights_m.size()> standard;  ///< 1024 texels, the narrower light
  double worst = 0.0;
  double spread = 1.0;     ///< widest over narrowest by resolution and field of view, of edges that are fine in all
  std::uint64_t hash = 0;  ///< of all drawn visibilities
};

Result<Widths> measure_all(BenchContext& context) {
  auto session = context.open_builtin(kPenumbraScene);
  if (!session) return session.error();
  const auto lamp = (*session)->world.resource<SceneNames>().find("light", "lamp");
  if (!lamp) return lamp.error();
  if (!(*session)->world.has<ShadowCaster>(*lamp)) (*session)->world.add<ShadowCaster>(*lamp, {});
  Widths widths;
  for (std::size_t h = 0; h < kHeights_m.size(); ++h) {
    double narrowest = 1e30, widest = 0.0;
    bool fine = true;
    for (const std::uint32_t resolution : kResolutions) {
      for (const float angle : kOuterAngles) {
        const auto penumbra = measure_penumbra(**session, {kHeights_m[h], resolution, angle});
        if (!penumbra) return penumbra.error();
        widths.hash = hash_of_both(widths.hash, penumbra->hash);
        if (resolution == 1024 && angle == kOuterAngles[0]) widths.standard[h] = *penumbra;
        widths.worst = std::isfinite(penumbra->drawn_m) ? std::max(widths.worst, penumbra->deviation()) : 1e9;
        narrowest = std::min(narrowest, penumbra->drawn_m);
        widest = std::max(widest, penumbra->drawn_m);
        fine = fine && penumbra->fine();
      }
    }
    if (fine) widths.spread = std::max(widths.spread, widest / narrowest);
  }
  return widths;
}

template <class Value>
BenchRow width_row(std::string id, std::string unit, std::shared_ptr<Once<Widths>> shared, Value value) {
  BenchRow row;
  row.id = "shadows.penumbra." + std::move(id);
  row.unit = std::move(unit);
  row.run = [shared = std::move(shared), value](BenchContext& context) -> Result<BenchValue> {
    const auto widths = shared->get([&] { return measure_all(context); });
    if (!widths) return widths.error();
    BenchValue result = value(**widths);
    result.scene = kPenumbraScene;
    return result;
  };
  return row;
}

}  // namespace

void add_shadow_penumbra_benches(BenchRegistry& registry) {
  const auto shared = std::make_shared<Once<Widths>>();
  for (std::size_t h = 0; h < kHeights_m.size(); ++h) {
    const std::string id = std::string("width.") + kHeightNames[h];
    registry.add(width_row(id + ".drawn", "m", shared,
                           [h](const Widths& w) { return single_value(w.standard[h].drawn_m, w.standard[h].hash); }));
    registry.add(width_row(id + ".analytic", "m", shared, [h](const Widths& w) {
      return single_value(w.standard[h].analytic_m, hash_of_number(w.standard[h].analytic_m));
    }));
  }
  BenchRow worst = width_row("worst_deviation", "share of width", shared,
                             [](const Widths& w) { return single_value(w.worst, w.hash); });
  worst.bar = 0.1;
  registry.add(std::move(worst));
  BenchRow spread = width_row("widest_over_narrowest", "ratio", shared,
                              [](const Widths& w) { return single_value(w.spread, w.hash); });
  spread.bar = 1.1;
  registry.add(std::move(spread));
}

}  // namespace gloam
