// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/math/types.h"
#include "sandbox/options.h"
#include "sandbox/session/session.h"

namespace gloam {

/// Times along an animation that --path measures, or positions on a path through cameras.
inline constexpr std::uint32_t kPathTimes = 5;

/// A view whose rows are measured.
struct MeasuredCamera {
  Options options;      ///< of its camera and time
  std::string towards;  ///< the camera that the path leads to from options.camera; empty: the view is at the camera
  double part = 0.0;    ///< of the way to `towards`, 0…1
  /// For the ledger: "court", or "court to lawn, 0.5 of the way".
  [[nodiscard]] std::string name() const;
};

/// Each camera of --cameras, at one time. With --path: each at kPathTimes times of the scene's longest animation; in a
/// scene without animations, kPathTimes positions on a path through the cameras of --cameras, or through all of the
/// scene, in that order. At least one. A usage error names the valid cameras, or says that there is no path.
[[nodiscard]] Result<std::vector<MeasuredCamera>> measured_cameras(const Options& options, const Session& session);

/// The pose between two cameras: positions lie on a line, and the orientation turns evenly by the shortest way. Scales
/// and mirrors of the matrices are left out. part: 0…1.
[[nodiscard]] dmat4 pose_between(const dmat4& from, const dmat4& to, double part);

/// Sets the session's camera. On a path, the camera that the path comes from moves to its place, with what is attached
/// to it. Its angle of view changes evenly if both cameras are of one kind; all else is as that camera has it.
[[nodiscard]] Status place_camera(const MeasuredCamera& camera, Session& session);

}  // namespace gloam
