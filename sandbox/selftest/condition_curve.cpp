// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/selftest/condition_curve.h"

#include <utility>

#include "engine/core/text/formatted.h"

namespace gloam {
namespace {

Status run_condition(SelfTestContext& context, StabilityCheck& check, const ConditionCurve& curve) {
  auto usual = curve.usual ? curve.usual(context) : Result<TestPicture>(TestPicture());
  if (!usual) return usual.error();
  for (std::size_t i = 0; i < curve.values.size(); ++i) {
    const double value = curve.values[i];
    const bool inside = value >= check.promised->low && value <= check.promised->high;
    const bool is_end = i == 0 || i + 1 == curve.values.size();
    if (context.quick() && (!inside || (!is_end && i % 3 != 0))) continue;
    const auto error = curve.error_at(context, *usual, value);
    if (!error) return error.error();
    add_point(check, value, *error, formatted("%g %s", value, curve.axis_unit));
  }
  return {};
}

}  // namespace

StabilityCheck curve_check(const char* name, const char* sentence, const char* unit, double bound, const char* advice,
                           const char* axis, StabilityRange promised) {
  return {.name = name,
          .kind = StabilityKind::curve,
          .sentence = sentence,
          .unit = unit,
          .bound = bound,
          .advice = advice,
          .axis = axis,
          .promised = promised};
}

Result<double> difference(const Result<TestPicture>& drawn, const TestPicture& usual) {
  if (!drawn) return drawn.error();
  return mean_difference(*drawn, usual);
}

void add_curve(ConditionCurve curve, std::vector<SelfTestCheck>& checks) {
  const StabilityCheck check = curve.check;
  const bool quick = curve.quick;
  checks.push_back({check, quick, [own = std::move(curve)](SelfTestContext& context, StabilityCheck& result) {
                      return run_condition(context, result, own);
                    }});
}

}  // namespace gloam
