// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sandbox/bench/closeups/case.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/once.h"
#include "sandbox/bench/shadows/case.h"
#include "sandbox/bench/shadows/phases.h"
#include "sandbox/bench/shadows/variant.h"

// How far shadows of close-up subjects are off traced ones, against standard maps with as many texels.
//
// Equal texels: standard maps alone get more texels a pixel, in steps of 2^⅛, until they have no less than the standard
// maps and the close-up maps of the other side together. Where faces of powers of two make that more than 5 % too much,
// standard maps beside close-ups get fewer instead, until both have no more than standard maps alone; the nearer of the
// two is taken. What is then still missing to as many texels as the standard maps alone have goes to the close-up maps,
// if that is enough for twice as many along a side.

namespace gloam {
namespace {

constexpr const char* kMostPairs = "16";
constexpr std::uint32_t kSamples = 256;  // as ShadowCase::traced
constexpr double kSeen = 0.02;           // change of visibility that a subject must make at a pixel
constexpr double kPenumbra = 0.02;       // traced visibility in one: 0.02 … 0.98

/// Over pixels and lights.
struct MeanError {
  double difference = 0.0;
  double penumbra_difference = 0.0;
  std::uint64_t pixels = 0;
  std::uint64_t penumbra_pixels = 0;
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
};

/// Pixels of a light from which subjects keep some of it.
struct LitBySubject {
  std::uint32_t layer = 0;
  std::vector<std::uint8_t> seen;
};

/// A subject with the lights that it is drawn with.
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

/// facing: pixels that the light gives anything.
void mark_changes(const TracedVisibility& all, const TracedVisibility& without, std::uint32_t layer,
                  const std::vector<std::uint8_t>& facing, LitBySubject& light) {
  const std::size_t first = layer * without.pixels(), from = light.layer * all.pixels();
  for (std::size_t pixel = 0; pixel < all.pixels(); ++pixel) {
    if (facing[pixel] == 0 || !without.is_judged(first + pixel) || !all.is_judged(from + pixel)) continue;
    const int change = without.visibility[first + pixel] - all.visibility[from + pixel];
    if (std::abs(change) > kSeen * 255.0) light.seen[pixel] = 1;
  }
}

/// By light of the pairs. The surfaces are those of the frame, with the subjects.
Result<std::vector<LitBySubject>> find_pixels(Session& session, const GeometryPicture& geometry,
                                              const std::vector<DrawnSubject>& subjects, const TracedVisibility& all) {
  std::vector<LitBySubject> lights;
  for (const DrawnSubject& subject : subjects) {
    const std::vector<Entity> casters = session.world.resource<CloseupSubjects>().subjects[subject.index].casters;
    const WithoutMeshes absent(session.world, casters);
    const auto without = trace_lights(session, geometry, subject.lights, kSamples);
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

/// With the knobs as they are, after frames until every tile has its lights.
Result<MeanError> measure_error(ShadowCase& shadows, const ShadowVariant& variant, const TracedVisibility& all,
                                const std::vector<LitBySubject>& lights) {
  if (auto frame = draw_settled(shadows, variant); !frame) return frame.error();
  MeanError error;
  for (const LitBySubject& light : lights) {
    const auto drawn = shadows.drawn(all.lights[light.layer]);
    if (!drawn) return drawn.error();
    const auto traced = all.layer(light.layer);
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
  return error;
}

/// Gives close-up maps the texels that are missing to equal.
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

Result<CloseupErrors> measure_errors(Session& session, const Options& options) {
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
  const auto all = trace_lights(session, *geometry, lights, kSamples);
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
                       std::function<double(const CloseupErrors&)> value) {
    BenchRow row;
    row.id = std::string("closeups.") + id;
    row.unit = unit;
    row.bar = bar;
    row.run = [shared, value = std::move(value)](BenchContext& context) -> Result<BenchValue> {
      const auto errors = shared->get([&]() -> Result<CloseupErrors> {
        auto opened = open_closeups(context, 1);
        if (!opened) return opened.error();
        return measure_errors(*opened->session, context.options());
      });
      if (!errors) return errors.error();
      BenchValue result;
      result.value = value(**errors);
      result.scene = context.scene_or(kCloseupScene);
      return result;
    };
    registry.add(std::move(row));
  };
  using E = CloseupErrors;
  add("error_over_standard", "ratio", 0.5, [](const E& e) { return over(e.with.mean(), e.standard.mean()); });
  add("error_penumbra_over_standard", "ratio", std::nullopt,
      [](const E& e) { return over(e.with.penumbra_mean(), e.standard.penumbra_mean()); });
  add("error", "visibility", std::nullopt, [](const E& e) { return e.with.mean(); });
  add("error_standard", "visibility", std::nullopt, [](const E& e) { return e.standard.mean(); });
  add("error_pixels", "pixels and lights", std::nullopt, [](const E& e) { return static_cast<double>(e.with.pixels); });
  add("error_pairs", "pairs", std::nullopt, [](const E& e) { return e.pairs; });
  add("texels", "texels", std::nullopt, [](const E& e) { return e.texels; });
  add("texels_standard", "texels", std::nullopt, [](const E& e) { return e.texels_standard; });
}

}  // namespace gloam
