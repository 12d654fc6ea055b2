// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/core/assert.h"
#include "modules/grass/growth/blade_types.h"

namespace gloam {
namespace {

constexpr std::string_view kText =
    R"(# Blade types of grass: one line a type, 1 to 16 types. Text after '#' is a comment.
#
# name       a word
# share      probability of the type; shares are relative to their sum; > 0
# length     factor on gloam.grass.height, above 0, at most 10
# width      factor on gloam.grass.width, above 0, at most 10
# stiffness  0 (limp) to 1 (stiff)
# taper      width at the tip over width at the root, 0 to 1
# damping=   optional: factor on gloam.grass.damping, 0 to 100, e.g. damping=2; otherwise 1
# stem       2 to 32 control points, each forward,up without spaces; the first is 0,0; up is never negative.
#            The stem is the smooth curve of these points (a quadratic B-spline) and ends in the last one. A point
#            that is given twice is a kink. Only the shape counts: the length is scaled.
#
# name     share  length  width  stiffness  taper  stem
upright    0.36   1.00    0.90   0.35       0.12   0,0  0.01,0.4  0.05,0.75  0.12,1
arched     0.28   1.10    1.00   0.22       0.10   0,0  0.02,0.45  0.2,0.85  0.55,0.95
nodding    0.18   1.25    0.85   0.28       0.08   0,0  0.03,0.5  0.12,0.85  0.3,1  0.5,0.92  0.6,0.7
s_shaped   0.12   0.90    1.10   0.28       0.15   0,0  -0.15,0.3  0,0.55  0.22,0.72  0.16,1
broken     0.06   0.80    1.15   0.18       0.20   0,0  0.02,0.3  0.04,0.5  0.1,0.62  0.24,0.62  0.42,0.5  0.58,0.3
)";

}  // namespace

std::string_view builtin_blade_types_text() { return kText; }

std::vector<BladeType> builtin_blade_types() {
  Result<std::vector<BladeType>> types = parse_blade_types(kText, "built-in blade types");
  GLOAM_ASSERT(types.ok(), "the built-in blade types are valid");
  return std::move(*types);
}

}  // namespace gloam
