// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <functional>
#include <string>
#include <utility>

#include "sandbox/selftest/checks.h"

namespace gloam {
namespace {

/// The picture of a scene, drawn in two ways.
using DrawPair = std::function<Result<std::pair<TestPicture, TestPicture>>(SelfTestContext&)>;

Status compare(SelfTestContext& context, StabilityCheck& check, const std::string& words, const DrawPair& draw) {
  const auto pair = draw(context);
  if (!pair) return pair.error();
  add_case(check, mean_difference(pair->first, pair->second), words);
  return {};
}

/// A scene drawn with two sets of knobs. builtin: the name of a built-in scene; empty: `scene`.
Result<std::pair<TestPicture, TestPicture>> draw_both(SelfTestContext& context, const std::string& scene,
                                                      const std::vector<KnobOverride>& first,
                                                      const std::vector<KnobOverride>& second) {
  const auto draw = [&](const std::vector<KnobOverride>& knobs) -> Result<TestPicture> {
    if (scene.starts_with("builtin:"))
      return context.draw_builtin(scene, {.width = 192, .height = 108, .knobs = knobs});
    const EffectScene& own = effect_scene(scene);
    TestView view = view_of(own);
    view.knobs.insert(view.knobs.end(), knobs.begin(), knobs.end());
    return context.draw(own.make(), {}, view);
  };
  auto one = draw(first);
  if (!one) return one.error();
  auto two = draw(second);
  if (!two) return two.error();
  return std::pair(std::move(one).value(), std::move(two).value());
}

/// Two ways to compute the same, chosen by knobs.
struct TwoWays {
  const char* name;
  const char* sentence;
  double bound;
  const char* advice;
  bool quick;
  std::vector<const char*> scenes;
  std::vector<KnobOverride> first;
  std::vector<KnobOverride> second;
};

const std::vector<TwoWays>& two_ways() {
  static const std::vector<TwoWays> all = {
      {"equal.tiled_brute",
       "light lists against all lights at each pixel",
       0.0,
       "Use lights.culling=brute",
       true,
       {"builtin:lanterns", "builtin:many_lights"},
       {{"shadows.mode", "off"}},
       {{"shadows.mode", "off"}, {"lights.culling", "brute"}}},
      {"equal.deferred_monolithic",
       "shadows before shading against shadows during shading",
       0.1,
       "Use shadows.mode=monolithic",
       true,
       {"lamp", "spot", "sun", "builtin:shadows"},
       {{"shadows.mode", "deferred"}},
       {{"shadows.mode", "monolithic"}}},
      {"equal.classified_filtered",
       "tiles that are known to be lit or unlit against filtering each pixel",
       0.1,
       "Use shadows.classify=off",
       false,
       {"lamp", "sun", "builtin:shadows"},
       {{"shadows.classify", "on"}},
       {{"shadows.classify", "off"}}},
      {"equal.proxy_tiles_naive",
       "proxies by tile against all proxies at each pixel",
       0.02,
       "Use ibr.loop=naive",
       false,
       {"builtin:wet_street", "room"},
       {{"ibr.loop", "tiles"}},
       {{"ibr.loop", "naive"}}},
      {"equal.blade_groups",
       "blades in groups of 64 against blades one by one",
       0.02,
       "Use grass.group=blade",
       false,
       {"lawn"},
       {{"grass.group", "64"}},
       {{"grass.group", "blade"}}},
  };
  return all;
}

void add_two_ways(std::vector<SelfTestCheck>& checks) {
  for (const TwoWays& ways : two_ways())
    checks.push_back(
        {{.name = ways.name, .sentence = ways.sentence, .unit = kLevels, .bound = ways.bound, .advice = ways.advice},
         ways.quick,
         [&ways](SelfTestContext& context, StabilityCheck& check) -> Status {
           for (const char* scene : ways.scenes) {
             if (context.quick() && scene != ways.scenes.front()) break;
             GLOAM_TRY(compare(context, check, scene,
                               [&](SelfTestContext& own) { return draw_both(own, scene, ways.first, ways.second); }));
           }
           return {};
         }});
}

/// Every effect scene, or those of the quick self-test, against the same scene drawn in another way.
SelfTestCheck each_scene(StabilityCheck check, bool quick, bool symmetric_only,
                         std::function<Result<TestPicture>(SelfTestContext&, const EffectScene&)> other) {
  const auto run = [=](SelfTestContext& context, StabilityCheck& result) -> Status {
    for (const EffectScene& scene : effect_scenes()) {
      if ((context.quick() && !scene.quick) || (symmetric_only && !scene.symmetric)) continue;
      const auto first = context.draw(scene);
      if (!first) return first.error();
      const auto second = other(context, scene);
      if (!second) return second.error();
      add_case(result, mean_difference(*first, *second), std::string(scene.name));
    }
    return {};
  };
  return {std::move(check), quick, run};
}

}  // namespace

void add_invariance_checks(std::vector<SelfTestCheck>& checks) {
  add_two_ways(checks);
  checks.push_back(each_scene({.name = "equal.twice",
                               .sentence = "the same frame drawn twice",
                               .unit = kLevels,
                               .bound = 0.0,
                               .advice = "Report the device: it computes something else each time"},
                              true, false, [](SelfTestContext& context, const EffectScene& scene) {
                                return context.draw(scene, Placement());
                              }));
  checks.push_back(each_scene({.name = "equal.one_thread",
                               .sentence = "the frame made by one thread against all threads",
                               .unit = kLevels,
                               .bound = 0.0,
                               .advice = "Use --threads 1, and report the machine"},
                              false, false, [](SelfTestContext& context, const EffectScene& scene) {
                                TestView view = view_of(scene);
                                view.threads = 1;
                                return context.draw(scene.make(), {}, view);
                              }));
  checks.push_back(
      each_scene({.name = "equal.in_flight",
                  .sentence = "frames drawn without a wait between them against frames that are waited for",
                  .unit = kLevels,
                  .bound = 0.0,
                  .advice = "Use --in-flight 1, and report the device"},
                 false, false, [](SelfTestContext& context, const EffectScene& scene) {
                   TestView view = view_of(scene);
                   view.in_flight = gpu::Device::kFramesInFlight;
                   return context.draw(scene.make(), {}, view);
                 }));
  checks.push_back(each_scene({.name = "equal.turned",
                               .sentence = "the scene turned by 90 degrees",
                               .unit = kLevels,
                               .bound = 0.5,
                               .advice = "Report the device and the scene"},
                              true, true, [](SelfTestContext& context, const EffectScene& scene) {
                                return context.draw(scene, {.turned = 90.0 * kOneDegree});
                              }));
  checks.push_back(each_scene({.name = "equal.mirrored",
                               .sentence = "the scene in a mirror",
                               .unit = kLevels,
                               .bound = 1.0,
                               .advice = "Report the device and the scene"},
                              false, true,
                              [](SelfTestContext& context, const EffectScene& scene) -> Result<TestPicture> {
                                const auto drawn = context.draw(scene, {.mirrored = true});
                                if (!drawn) return drawn;
                                return drawn->flipped();
                              }));
}

}  // namespace gloam
