// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <string>
#include <vector>

#include "engine/core/text/formatted.h"
#include "sandbox/selftest/checks.h"

namespace gloam {
namespace {

/// An effect against the reference that its module states.
struct ReferenceCase {
  const char* name;
  const char* scene;
  const char* knob;
  const char* sentence;
  const char* unit;
  double bound;
  const char* advice;
  bool quick;
  std::vector<KnobOverride> knobs = {};  ///< so that the error is that of one kernel
};

constexpr const char* kOfLight = "of the light";

const std::vector<ReferenceCase>& references() {
  static const std::vector<ReferenceCase> all = {
      {"traced.lamp", "lamp", "shadows.filter", "shadows of a lamp with width against rays traced in double precision",
       kOfLight, 0.005, "Try shadows.near=all and shadows.texels_per_pixel=6", true},
      {"traced.spot", "spot", "shadows.filter", "shadows of a spot light against traced rays", kOfLight, 0.004,
       "Try shadows.texels_per_pixel=6", false},
      {"traced.sun", "sun", "shadows.filter", "shadows of a sun against traced rays", kOfLight, 0.002,
       "Try shadows.texels_per_pixel=6", false},
      {"traced.puddle", "puddle", "reflections.tiers", "reflections against traced rays", kOfLight, 0.004,
       "Try reflections.mode=planar", false},
      {"accumulated.lens", "lens", "dof.resolution", "depth of field against many pinhole pictures over the lens",
       kOfLight, 0.06, "Try dof.resolution=full", false},
      {"traced.smoke", "smoke", "particles.lighting", "lit particles against light at each pixel with traced shadows",
       kOfLight, 0.005, "Try particles.lighting=pixel", false},
      {"double.blades",
       "lawn",
       "grass.iterations",
       "three iterations of a blade by its CPU twin against 64 in steps an eighth as long",
       "mm at the tip",
       10.4,  // blades that begin within the ball spring out of it, and still swing after the second; with one
              // iteration 10.6. Both sides run on the CPU, so no device needs room
       "Try grass.iterations=8",
       true,
       {{"grass.masters", "1:1"}}},
      {"double.tone_curve", "lamp", "lighting.tone_map_table", "the tone curve against the CPU's in double precision",
       kLevels, 0.5, "Try lighting.tone_map_table=exact", true},
  };
  return all;
}

void add_reference(const ReferenceCase& own, std::vector<SelfTestCheck>& checks) {
  StabilityCheck check = kernel_stability(own);
  checks.push_back({std::move(check), own.quick, [own](SelfTestContext& context, StabilityCheck& result) -> Status {
                      const EffectScene& scene = effect_scene(own.scene);
                      TestView view = view_of(scene);
                      view.knobs.insert(view.knobs.end(), own.knobs.begin(), own.knobs.end());
                      const auto error =
                          context.reference_error(scene.make(), view, own.knob, context.quick() ? 64 : 256);
                      if (!error) return error.error();
                      add_case(result, *error, own.scene);
                      return {};
                    }});
}

Status count_missing_lights(SelfTestContext& context, StabilityCheck& check) {
  for (const char* scene : {"builtin:lanterns", "builtin:many_lights"}) {
    if (context.quick() && check.curve.empty() && !check.worst_case.empty()) break;
    const auto drawn =
        context.draw_builtin(scene, {.width = 320, .height = 180, .knobs = {{"lights.check", "on"}}, .frames = 2});
    if (!drawn) return drawn.error();
    const auto found = context.counters().find("lights.culling_errors");
    if (found == context.counters().end()) return Error{ErrorKind::failed, "no light lists were checked"};
    add_case(check, found->second, scene);
  }
  return {};
}

/// Draws the usual pictures, too, if no check before has drawn them.
Status count_non_finite(SelfTestContext& context, StabilityCheck& check) {
  for (const EffectScene& scene : effect_scenes()) {
    if (context.quick() && !scene.quick) continue;
    const auto drawn = context.draw(scene);
    if (!drawn) return drawn.error();
  }
  const std::string all = std::to_string(context.pictures()) + " pictures";
  add_case(check, static_cast<double>(context.non_finite()),
           context.non_finite() > 0 ? context.first_non_finite() : all);
  return {};
}

/// A lamp a centimetre over the floor. At 10⁶ cd its light does not fit into half floats. Light is scaled by the
/// exposure before it is stored, so that at −100 EV, with 10⁹ cd, it does not fit into floats either: numbers between
/// the two are rounded to the greatest half or to infinity, as the device likes.
Status count_non_finite_glare(SelfTestContext& context, StabilityCheck& check) {
  struct Glare {
    double candela, exposure;
  };
  for (const Glare& glare : {Glare{1e6, 0.0}, Glare{1e9, -100.0}}) {
    TestScene scene = bare_floor();
    scene.keys()["gloam.exposure"] = glare.exposure;
    scene.light("point", {0.0, 0.01, 0.0}, glare.candela, {{"range", 9.0}});
    const std::size_t before = context.non_finite();
    const auto drawn = context.draw(scene, {}, {.knobs = {{"shadows.mode", "off"}}});
    if (!drawn) return drawn.error();
    const std::size_t middle = 4 * (drawn->height / 2 * drawn->width + drawn->width / 2);
    const std::size_t not_white = drawn->rgba[middle] < 255 ? 1 : 0;
    add_case(check, static_cast<double>(context.non_finite() - before + not_white),
             formatted("%g cd at %g EV", glare.candela, glare.exposure));
  }
  return {};
}

}  // namespace

void add_count_checks(std::vector<SelfTestCheck>& checks) {
  checks.push_back({{.name = "lists.missing_lights",
                     .kind = StabilityKind::kernel,
                     .sentence = "lights that reach a pixel but are missing in its tile's list, by brute force",
                     .unit = "lights",
                     .bound = 0.0,
                     .advice = "Use lights.culling=brute, and report the device: its light lists are wrong"},
                    true,
                    &count_missing_lights});
  for (const ReferenceCase& own : references()) add_reference(own, checks);
}

void add_finite_check(std::vector<SelfTestCheck>& checks) {
  checks.push_back({{.name = "finite.glare",
                     .kind = StabilityKind::kernel,
                     .sentence = "values of pictures of a lamp of 10⁶ cd and more, a centimetre over a floor, that are "
                                 "not finite, or not white at the lamp",
                     .unit = "values",
                     .bound = 0.0,
                     .advice = "Raise the exposure of scenes with lamps as bright as this one, and report the device"},
                    true,
                    &count_non_finite_glare});
  checks.push_back({{.name = "finite",
                     .kind = StabilityKind::kernel,
                     .sentence = "values of all pictures of this run that are not finite",
                     .unit = "values",
                     .bound = 0.0,
                     .advice = "Report the device and the scene"},
                    true,
                    &count_non_finite});
}

}  // namespace gloam
