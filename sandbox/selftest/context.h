// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "engine/gpu/device.h"
#include "engine/render/kernel_check/kernel_lab.h"
#include "engine/render/knobs/knobs.h"
#include "sandbox/options.h"
#include "sandbox/selftest/changed_shaders.h"
#include "sandbox/selftest/scenes.h"
#include "sandbox/session/session.h"

namespace gloam {

struct TestPicture {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> rgba;  ///< as shown
  std::vector<float> light;        ///< linear, four values a pixel

  /// Mean of the light's three channels, cd/m².
  [[nodiscard]] double mean_light() const;
  /// The picture seen in a mirror.
  [[nodiscard]] TestPicture flipped() const;
};

/// Mean difference of the shown colours, 0…255. Infinite if the sizes differ.
[[nodiscard]] double mean_difference(const TestPicture& a, const TestPicture& b);

/// How a picture is drawn.
struct TestView {
  std::uint32_t width = 144;  ///< pixels
  std::uint32_t height = 96;
  std::vector<KnobOverride> knobs = {};
  std::uint32_t frames = 3;  ///< the last one is the picture
  double time_s = 0.0;       ///< of the first frame
  double dt_s = 1.0 / 60.0;
  double pause_s = 0.0;         ///< between the first frame and the second, beside dt_s
  std::uint32_t threads = 0;    ///< 0: one per core
  std::uint32_t in_flight = 1;  ///< frames that may be unfinished at a time
};
[[nodiscard]] TestView view_of(const EffectScene& scene);

/// Draws pictures of test scenes, each with a renderer of its own on one device.
class SelfTestContext {
 public:
  /// shaders: in place of those of the program.
  SelfTestContext(const Options& options, LogSink& log, std::shared_ptr<gpu::Device> device,
                  std::vector<ChangedShader> shaders = {});
  ~SelfTestContext();
  SelfTestContext(const SelfTestContext&) = delete;
  SelfTestContext& operator=(const SelfTestContext&) = delete;

  [[nodiscard]] bool quick() const { return options_.quick; }
  [[nodiscard]] Result<TestPicture> draw(const TestScene& scene, const Placement& placement, const TestView& view);
  /// The scene at its usual place, drawn once; with --out it is written to DIR/pictures.
  [[nodiscard]] Result<TestPicture> draw(const EffectScene& scene);
  [[nodiscard]] Result<TestPicture> draw(const EffectScene& scene, const Placement& placement);
  [[nodiscard]] Result<TestPicture> draw_builtin(const std::string& name, const TestView& view);
  /// Against what the module that declares `knob` states as its reference (Module::references): the mean difference of
  /// linear light over the mean light of the reference, or of the shown colours if that is all it gives, or its
  /// distance, such as millimetres.
  [[nodiscard]] Result<double> reference_error(const TestScene& scene, const TestView& view, const std::string& knob,
                                               std::uint32_t samples);
  /// Counters of the last picture's last frame.
  [[nodiscard]] const std::map<std::string, double>& counters() const { return counters_; }
  /// Where kernels are run alone, with the same shaders.
  [[nodiscard]] KernelLab& lab() { return lab_; }
  /// Values of all pictures so far that are not finite, and the first scene that had one.
  [[nodiscard]] std::size_t non_finite() const { return non_finite_; }
  [[nodiscard]] const std::string& first_non_finite() const { return first_non_finite_; }
  [[nodiscard]] std::size_t pictures() const { return pictures_; }

 private:
  [[nodiscard]] Result<std::string> write_scene(const TestScene& scene, const Placement& placement) const;
  [[nodiscard]] Options options_for(const std::string& path, const TestView& view) const;
  [[nodiscard]] Result<std::unique_ptr<Session>> open(const Options& options);
  [[nodiscard]] Result<TestPicture> draw_file(const std::string& path, const TestView& view);

  const Options& options_;
  LogSink& log_;
  std::shared_ptr<gpu::Device> device_;
  std::vector<ChangedShader> shaders_;
  KernelLab lab_;
  std::string folder_;                                       ///< of the scenes' files; removed at the end
  std::map<std::string, std::optional<TestPicture>> usual_;  ///< by name of the effect scene
  std::map<std::string, double> counters_;
  std::size_t pictures_ = 0;
  std::size_t non_finite_ = 0;
  std::string first_non_finite_;
};

}  // namespace gloam
