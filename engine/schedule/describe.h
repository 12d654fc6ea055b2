// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>

#include "engine/schedule/system.h"

namespace gloam {

/// Describes the systems of one stage, one line per system in order of registration, e.g. `view z_bins (lights): reads
/// LightDepth, ZBinParams; writes ZBins; waits for light_bounds`. Systems for which `runs` is false are listed as
/// disabled.
[[nodiscard]] std::string describe_stage(std::span<const std::unique_ptr<System>> systems, Stage stage,
                                         const std::function<bool(const System&)>& runs);

}  // namespace gloam
