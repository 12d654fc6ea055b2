// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/hash.h"
#include "modules/glare/components.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/gather_yardstick.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/harness/once.h"
#include "sandbox/session/session.h"

// Time that glare adds to a frame, against the gather pass: the module's passes, and what tone mapping takes longer
// because it adds the scattered light.

namespace gloam {
namespace {

constexpr const char* kGlareScene = "builtin:plain";
constexpr int kGlareRounds = 25;
constexpr int kGlareWarmUp = 3;

struct GlareCost {
  std::vector<double> passes_ns;                        ///< of the module
  std::vector<double> with_ns;                          ///< of the module and tone mapping
  std::vector<double> tone_map_ns;                      ///< without glare
  std::vector<double> frame_with_ns, frame_without_ns;  ///< GPU time of whole frames
  std::vector<double> gather_ns;
  std::uint64_t hash = 0;  ///< of the picture with glare
  std::uint64_t without_hash = 0;
  std::uint64_t gather_hash = 0;

  [[nodiscard]] std::uint64_t all_hash() const { return hash_of_both(hash, gather_hash); }
};

double passes_ns(const FrameSample& sample, std::string_view module, std::string_view name) {
  double sum = 0.0;
  for (const PassTime& pass : sample.report.passes)
    if (pass.module == module && (name.empty() || pass.name == name)) sum += pass.ms * kNsPerMs;
  return sum;
}

Result<FrameSample> draw_with_glare(Session& session, const ViewSettings& view, float share, std::uint64_t& hash) {
  if (session.camera != kNoEntity && session.world.try_get<Glare>(session.camera) != nullptr)
    session.world.get<Glare>(session.camera).share = share;
  session.world.set_resource(DefaultGlare{share});
  auto sample = session.render_frame({view, {}});
  if (!sample) return sample.error();
  const auto picture = session.renderer->read_picture(view.id);
  if (!picture) return picture.error();
  hash = hash_bytes(std::as_bytes(std::span(picture->rgba)));
  return sample;
}

/// Frames with glare, frames without it and gather passes, in turn.
Result<GlareCost> measure_glare_cost(BenchContext& context) {
  auto opened = context.open_builtin(context.scene_or(kGlareScene));
  if (!opened) return opened.error();
  Session& session = **opened;
  const std::uint32_t width = context.options().width, height = context.options().height;
  const ViewSettings view = session.view_settings(width, height, "none");
  auto yardstick = GatherYardstick::create(*session.device, width, height);
  if (!yardstick) return yardstick.error();
  GlareCost cost;
  for (int i = -kGlareWarmUp; i < kGlareRounds; ++i) {
    const auto with = draw_with_glare(session, view, kUsualGlare, cost.hash);
    if (!with) return with.error();
    const auto without = draw_with_glare(session, view, 0.0f, cost.without_hash);
    if (!without) return without.error();
    const auto start = std::chrono::steady_clock::now();
    GLOAM_TRY((*yardstick)->draw());
    const double gather = std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count();
    if (i < 0) continue;
    cost.passes_ns.push_back(passes_ns(*with, "glare", ""));
    cost.with_ns.push_back(cost.passes_ns.back() + passes_ns(*with, "lighting", "tone_map"));
    cost.tone_map_ns.push_back(passes_ns(*without, "lighting", "tone_map"));
    cost.frame_with_ns.push_back(with->report.gpu_ms * kNsPerMs);
    cost.frame_without_ns.push_back(without->report.gpu_ms * kNsPerMs);
    cost.gather_ns.push_back(gather);
  }
  const auto gathered = (*yardstick)->picture_hash();
  if (!gathered) return gathered.error();
  cost.gather_hash = *gathered;
  if (cost.hash == cost.without_hash) return Error{ErrorKind::failed, "frames with and without glare are equal"};
  return cost;
}

std::vector<double> difference_of(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> apart;
  for (std::size_t i = 0; i < a.size(); ++i) apart.push_back(a[i] - b[i]);
  return apart;
}

}  // namespace

void add_glare_benches(BenchRegistry& registry) {
  const auto shared = std::make_shared<Once<GlareCost>>();
  const auto add = [&](const char* id, const char* unit, std::optional<double> bar, auto value) {
    BenchRow row{.id = id, .unit = unit, .bar = bar};
    row.run = [=](BenchContext& context) -> Result<BenchValue> {
      const auto cost = shared->get([&] { return measure_glare_cost(context); });
      if (!cost) return cost.error();
      BenchValue result = value(**cost);
      result.scene = context.scene_or(kGlareScene);
      return result;
    };
    registry.add(std::move(row));
  };
  using C = GlareCost;
  add("glare.frame_over_gathers", "ratio", 0.15,
      [](const C& c) { return ratio_of(difference_of(c.with_ns, c.tone_map_ns), c.gather_ns, c.all_hash()); });
  add("glare.frame.added_over_gathers", "ratio", std::nullopt, [](const C& c) {
    return ratio_of(difference_of(c.frame_with_ns, c.frame_without_ns), c.gather_ns, c.all_hash());
  });
  add("glare.frame.passes_ms", "ms", std::nullopt, [](const C& c) { return per_item(c.passes_ns, kNsPerMs, c.hash); });
  add("glare.frame.tone_map_added_ms", "ms", std::nullopt, [](const C& c) {
    return per_item(difference_of(difference_of(c.with_ns, c.passes_ns), c.tone_map_ns), kNsPerMs, c.hash);
  });
  add("glare.frame.gather48_ms", "ms", std::nullopt,
      [](const C& c) { return per_item(c.gather_ns, kNsPerMs, c.gather_hash); });
}

}  // namespace gloam
