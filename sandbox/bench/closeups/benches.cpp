// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/hash.h"
#include "sandbox/bench/closeups/case.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/harness/once.h"
#include "sandbox/bench/shadows/case.h"
#include "sandbox/bench/shadows/phases.h"
#include "sandbox/bench/shadows/variant.h"

// Error of close-up subjects' shadows against traced shadows, compared with standard maps that have as many texels.
//
// Equal texels: one side has standard maps alone, the other has standard maps and close-up maps. First, the density of
// standard maps alone rises in steps of 2^⅛ until they have at least as many texels as the other side. Face sizes are
// powers of two, so this may be more than 5 % too many. Then the density of the standard maps beside close-ups falls
// instead, until that side has at most as many texels as standard maps alone. The closer of the two results is used. If
// the texels still missing on the side with close-ups are enough for a higher closeups.texels_per_pixel, the close-up
// maps get them.

namespace gloam {
namespace {

constexpr const char* kMostPairs = "16";
constexpr std::uint32_t kCloseUpSamples = 256;  // as ShadowCase::traced
constexpr double kSeen = 0.02;                  // a pixel counts if a subject changes its visibility by more
constexpr double kPenumbra = 0.02;              // a pixel is in a penumbra if its traced visibility is 0.02 … 0.98

/// Sums over pixels and lights.
struct MeanError {
  double difference = 0.0;
  double penumbra_difference = 0.0;
  std::uint64_t pixels = 0;
  std::uint64_t penumbra_pixels = 0;
  std::uint64_t hash = 0;  ///< of the visibilities, drawn and traced
  [[nodiscard]] double mean() const { return difference / static_cast<double>(std::max<std::uint64_t>(pixels, 1)); }
  [[nodiscard]] double penumbra_mean() const {
    return penumbra_difference / static_cast<double>(std::max<std::uint64_t>(penumbra_pixels, 1));
  }
};

struct CloseupErrors {
  MeanError with;
  MeanError standard;
  double texels = 0.0;
  double texels_standard = 0.0;
  double pairs = 0.0;
  [[nodiscard]] std::uint64_t hash() const { return hash_of_both(with.hash, standard.hash); }
};

/// The pixels at which close-up subjects change a light's visibility.
struct LitBySubject {
  std::uint32_t layer = 0;
  std::vector<std::uint8_t> seen;
};

/// A close-up subject and the lights of its pairs.
struct DrawnSubject {
  std::uint32_t index = 0;
  std::vector<Entity> lights;
};

std::vector<DrawnSubject> drawn_subjects(const CloseupViews& views) {
  std::vector<DrawnSubject> subjects;
  for (const CloseupView& pair : views.pairs) {
    auto at = std::ranges::find(subjects, pair.subject_index, &DrawnSubject::index);
    if (at == subjects.end()) at = subjects.insert(at, {pair.subject_index, {}});
    at->lights.push_back(pair.light);
  }
  return subjects;
}

/// Marks the pixels whose visibility changes without the subject. facing: pixels to which the light can give anything.
void mark_changes(const TracedVisibility& all, const TracedVisibility& without, std::uint32_t layer,
                  const std::vector<std::uint8_t>& facing, LitBySubject& light) {
  const std::size_t first = layer * without.pixels(), from = light.layer * all.pixels();
  for (std::size_t pixel = 0; pixel < all.pixels(); ++pixel) {
    if (facing[pixel] == 0 || !without.is_judged(first + pixel) || !all.is_judged(from + pixel)) continue;
    const int change = without.visibility[first + pixel] - all.visibility[from + pixel];
    if (std::abs(change) > kSeen * 255.0) light.seen[pixel] = 1;
  }
}

/// Finds these pixels for each light of the pairs, by tracing without each subject. The receivers are the surfaces of
/// the frame, subjects included.
Result<std::vector<LitBySubject>> find_pixels(Session& session, const GeometryPicture& geometry,
                                              const std::vector<DrawnSubject>& subjects, const TracedVisibility& all) {
  std::vector<LitBySubject> lights;
  for (const DrawnSubject& subject : subjects) {
    const std::vector<Entity> casters = session.world.resource<CloseupSubjects>().subjects[subject.index].casters;
    const WithoutMeshes absent(session.world, casters);
    const auto without = trace_lights(session, geometry, subject.lights, kCloseUpSamples);
    if (!without) return without.error();
    for (std::uint32_t layer = 0; layer < without->lights.size(); ++layer) {
      const auto in_all = all.layer_of(without->lights[layer]);
      if (!in_all) continue;
      auto at = std::ranges::find(lights, *in_all, &LitBySubject::layer);
      if (at == lights.end()) at = lights.insert(at, {*in_all, std::vector<std::uint8_t>(all.pixels(), 0)});
      const auto facing = pixels_that_face(session.world, geometry, without->lights[layer]);
      mark_changes(all, *without, layer, facing, *at);
    }
  }
  return lights;
}

/// Measures with the current knobs, in a frame without fallback tiles.
Result<MeanError> measure_error(ShadowCase& shadows, const ShadowVariant& variant, const TracedVisibility& all,
                                const std::vector<LitBySubject>& lights) {
  if (auto frame = draw_settled(shadows, variant); !frame) return frame.error();
  MeanError error;
  Hasher hasher;
  for (const LitBySubject& light : lights) {
    const auto drawn = shadows.drawn(all.lights[light.layer]);
    if (!drawn) return drawn.error();
    const auto traced = all.layer(light.layer);
    hasher.bytes(std::as_bytes(std::span(*drawn))).bytes(std::as_bytes(traced));
    for (std::size_t pixel = 0; pixel < traced.size(); ++pixel) {
      if (light.seen[pixel] == 0 || (*drawn)[pixel] < 0.0f) continue;
      const double right = traced[pixel] / 255.0;
      const double difference = std::abs(static_cast<double>((*drawn)[pixel]) - right);
      error.difference += difference;
      ++error.pixels;
      if (right < kPenumbra || right > 1.0 - kPenumbra) continue;
      error.penumbra_difference += difference;
      ++error.penumbra_pixels;
    }
  }
  error.hash = hasher.digest();
  return error;
}

/// Raises closeups.texels_per_pixel as far as the total does not exceed the texels of standard maps alone.
Status spend_the_rest(ShadowCase& shadows, EqualTexels& texels) {
  for (const char* density : {"4", "2"}) {
    GLOAM_TRY(shadows.set("closeups.texels_per_pixel", density));
    GLOAM_TRY(use_closeups(shadows, texels, kMostPairs));
    if (const auto frame = draw_settled(shadows, {"deferred", "on", kMostPairs}); !frame) return frame.error();
    const std::uint64_t total = map_texels(shadows.session()).total();
    if (total > texels.standard) continue;
    texels.with = total;
    return {};
  }
  shadows.set_back("closeups.texels_per_pixel");
  return {};
}

Result<CloseupErrors> measure_close_up_errors(Session& session, const Options& options) {
  ShadowCase shadows(session, options.width, options.height);
  auto texels = find_equal_texels(shadows, kMostPairs);
  if (!texels) return texels.error();
  GLOAM_TRY(spend_the_rest(shadows, *texels));
  const ShadowVariant with{"deferred", "on", kMostPairs};
  GLOAM_TRY(use_closeups(shadows, *texels, kMostPairs));
  auto frame = draw_settled(shadows, with);
  if (!frame) return frame.error();
  CloseupErrors errors;
  errors.texels = static_cast<double>(texels->with);
  errors.texels_standard = static_cast<double>(texels->standard);
  errors.pairs = counter_of(frame->report, "closeups.pairs");

  const ViewId view = session.view_settings(options.width, options.height, "none").id;
  const CloseupViews& views = session.world.view_resource<CloseupViews>(view);
  const std::vector<DrawnSubject> subjects = drawn_subjects(views);
  if (errors.pairs != static_cast<double>(views.pairs.size()))
    return Error{ErrorKind::failed, "copies of standard maps find no room: a pair is not drawn"};
  std::vector<Entity> lights;
  for (const CloseupView& pair : views.pairs) lights.push_back(pair.light);
  const auto geometry = session.renderer->read_geometry(session.world, view);
  if (!geometry) return geometry.error();
  const auto all = trace_lights(session, *geometry, lights, kCloseUpSamples);
  if (!all) return all.error();
  const auto pixels = find_pixels(session, *geometry, subjects, *all);
  if (!pixels) return pixels.error();

  const auto drawn = measure_error(shadows, with, *all, *pixels);
  if (!drawn) return drawn.error();
  GLOAM_TRY(use_standard(shadows, *texels));
  const auto standard = measure_error(shadows, kClassified, *all, *pixels);
  if (!standard) return standard.error();
  errors.with = *drawn;
  errors.standard = *standard;
  return errors;
}

double over(double a, double b) { return b > 0.0 ? a / b : 0.0; }

}  // namespace

void add_closeup_benches(BenchRegistry& registry) {
  const auto shared = std::make_shared<Once<CloseupErrors>>();
  const auto add = [&](const char* id, const char* unit, std::optional<double> bar,
                       std::function<BenchValue(const CloseupErrors&)> value) {
    BenchRow row;
    row.id = std::string("closeups.") + id;
    row.unit = unit;
    row.bar = bar;
    row.run = [shared, value = std::move(value)](BenchContext& context) -> Result<BenchValue> {
      const auto errors = shared->get([&]() -> Result<CloseupErrors> {
        auto opened = open_closeups(context, 1);
        if (!opened) return opened.error();
        return measure_close_up_errors(*opened->session, context.options());
      });
      if (!errors) return errors.error();
      BenchValue result = value(**errors);
      result.scene = context.scene_or(kCloseupScene);
      return result;
    };
    registry.add(std::move(row));
  };
  using E = CloseupErrors;
  add("error_over_standard", "ratio", 0.5,
      [](const E& e) { return single_value(over(e.with.mean(), e.standard.mean()), e.hash()); });
  add("error_penumbra_over_standard", "ratio", std::nullopt,
      [](const E& e) { return single_value(over(e.with.penumbra_mean(), e.standard.penumbra_mean()), e.hash()); });
  add("error", "visibility", std::nullopt, [](const E& e) { return single_value(e.with.mean(), e.with.hash); });
  add("error_standard", "visibility", std::nullopt,
      [](const E& e) { return single_value(e.standard.mean(), e.standard.hash); });
  add("error_pixels", "pixels and lights", std::nullopt,
      [](const E& e) { return single_value(static_cast<double>(e.with.pixels), e.with.hash); });
  add("error_pairs", "pairs", std::nullopt, [](const E& e) { return single_value(e.pairs, e.with.hash); });
  add("texels", "texels", std::nullopt, [](const E& e) { return single_value(e.texels, e.with.hash); });
  add("texels_standard", "texels", std::nullopt,
      [](const E& e) { return single_value(e.texels_standard, e.standard.hash); });
}

}  // namespace gloam
