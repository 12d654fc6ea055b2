// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/render/module.h"
#include "engine/render/readback/capture.h"
#include "modules/grass/lod/residency.h"
#include "shaders/grass/drawing/pose_shared.h"
#include "shaders/grass/grass_shared.h"
#include "shaders/grass/lod/lod_shared.h"

namespace gloam {

/// The grass of one frame, read back from the GPU.
struct GrassReading {
  std::vector<ResidentPatch> patches;  ///< of the patch rows
  float range_m = 0.0f;                ///< distance of key 255
  shaders::GrassDraws draws{};
  std::vector<std::uint32_t> blades;      ///< of the live blades: patch row · 256 + index in the patch, sorted by key
  std::vector<std::uint32_t> bins;        ///< 257 words: exclusive prefix sum over the keys
  std::vector<vec4> knots;                ///< 16 a master
  std::vector<shaders::GrassPose> poses;  ///< of the live blades, in the order of `blades`
};

/// Reads the grass of frames of one view. Must come after the other modules.
class GrassProbe final : public Module {
 public:
  [[nodiscard]] std::string_view name() const override { return "grass_probe"; }
  void register_components(World&) const override {}
  void scene_keys(KeyRegistry&) const override {}
  [[nodiscard]] Demand demand(const World&, const RenderView*) const override { return {true, "benches"}; }
  void add_passes(FrameBuilder& frame, PassPhase phase) override;
  void release() override { copies_.reset(); }

  /// The simulation's constants in the last frame; frame_steps is 0 if no patch was in view.
  [[nodiscard]] const shaders::GrassSteps& steps() const { return steps_; }
  /// The next frame copies its grass.
  void want() { wanted_ = true; }
  /// The grass of the frame after the last call of want(), which must have ended. Empty if no patch was in view.
  [[nodiscard]] GrassReading take();

 private:
  bool wanted_ = false;
  shaders::GrassSteps steps_{};
  GrassReading reading_;
  std::unique_ptr<Captures> copies_;
};

}  // namespace gloam
