// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "engine/render/knobs/knob_table.h"
#include "modules/accuracy/module.h"
#include "tests/support/temporary_folder.h"

namespace gloam::test {

inline constexpr std::uint32_t kSide = 4;

inline constexpr IntegerKnob<std::uint32_t> kSamples{.name = "fake.samples",
                                                     .meaning = "",
                                                     .min = 1,
                                                     .max = 64,
                                                     .default_value = 4,
                                                     .exact = 64,
                                                     .ledger_values = {1, 4, 16}};
inline constexpr OnOffKnob kCount{.name = "fake.count", .meaning = ""};

/// A fake renderer: "samples" makes the picture brighter by 1/samples and costs that many milliseconds; no value of
/// "look" is more right than another. Of three methods, "c" draws another picture.
class FakeSubject final : public CostSubject {
 public:
  FakeSubject() {
    knobs_.add(declaration_of(kSamples, "fake"));
    knobs_.add({.name = "fake.look", .module = "fake", .choices = {"warm", "cold"}});
    knobs_.add(declaration_of(kCount, "fake"));
    knobs_.add(
        {.name = "fake.taste", .module = "fake", .choices = {"warm", "cold"}, .taste = "a look", .is_look = true});
    knobs_.add(
        {.name = "fake.method", .module = "fake", .choices = {"a", "b", "c"}, .exact = "a", .same_picture = true});
  }

  [[nodiscard]] KnobRegistry& knobs() override { return knobs_; }
  [[nodiscard]] std::vector<ReferenceInfo> references() const override { return references_; }
  [[nodiscard]] std::vector<MeasureInfo> measures() const override { return measures_; }
  [[nodiscard]] FrameCounters counters() override {
    if (!knobs_.value(kCount)) return {};
    return {{"fake.work", static_cast<double>(knobs_.value(kSamples))}};
  }
  [[nodiscard]] Result<FrameCost> draw(std::int32_t index) override {
    ++frames_drawn;
    indices.push_back(index);
    index_ = index;
    version_drawn_ = knobs_.version();
    if (fail_after > 0 && frames_drawn > fail_after) return Error{ErrorKind::failed, "the device is lost"};
    counted_frames += knobs_.value(kCount) ? 1 : 0;
    const double gpu_ms = knobs_.value(kSamples) + slower_by * frames_drawn;
    return FrameCost{.cpu_ms = 1.0, .gpu_ms = gpu_ms, .modules = {{"other", 7.0, 7.0}, {"fake", 0.5, gpu_ms / 2.0}}};
  }
  [[nodiscard]] std::uint32_t frames_to_rest() override { return rest; }
  [[nodiscard]] Status settle_memory() override {
    frames_before_settling.push_back(frames_drawn);
    return {};
  }
  [[nodiscard]] Result<std::uint64_t> gpu_bytes() override { return std::uint64_t{knobs_.value(kSamples)} * 100; }
  [[nodiscard]] Result<FramePictures> read() override { return pictures(brightness()); }
  [[nodiscard]] Result<FramePictures> draw_reference(const ReferenceInfo& info, const FramePictures& frame,
                                                     std::uint32_t samples) override {
    expect_last_frame_of_knobs();
    if (info.name == kModelName) {
      ++models_drawn;
      return pictures(0.5 + 0.1 / samples);
    }
    ++references_drawn;
    return reference(frame, samples);
  }

  [[nodiscard]] Result<std::optional<MovedDistance>> measure_distance(const ReferenceInfo&, std::uint32_t) override {
    expect_last_frame_of_knobs();
    return distance ? distance(brightness()) : std::nullopt;
  }
  [[nodiscard]] std::string no_effect_reason(const Knob& knob) override { return reasons[knob.name]; }

  [[nodiscard]] double brightness() const {
    const double error = 1.0 / knobs_.value(kSamples);
    // The exact value does not flicker; the others do.
    const double wrong = knobs_.text(*knobs_.find("fake.method")) == "c" ? 0.01 : 0.0;
    return 0.25 + wrong + (knobs_.value(kSamples) == 64 ? 0.0 : error * (index_ % 2 == 0 ? 0.5 : 0.25));
  }
  static FramePictures pictures(double brightness) {
    const auto encoded = static_cast<std::uint8_t>(std::lround(255.0 * brightness));
    return {.linear = {kSide, kSide, std::vector<float>(kSide * kSide * 4, static_cast<float>(brightness))},
            .picture = {kSide, kSide, std::vector<std::uint8_t>(kSide * kSide * 4, encoded)}};
  }

  static constexpr const char* kModelName = "no model";  ///< ReferenceInfo::model_name; it has a brightness of 0.5
  int models_drawn = 0;
  int frames_drawn = 0;
  std::vector<int> frames_before_settling;  ///< for each call
  int counted_frames = 0;
  int references_drawn = 0;
  std::vector<std::int32_t> indices;  ///< of all drawn frames
  std::uint32_t rest = 0;             ///< frames_to_rest
  int fail_after = 0;
  double slower_by = 0.0;  ///< ms by which each frame is slower than the one before
  std::vector<ReferenceInfo> references_;
  std::vector<MeasureInfo> measures_;
  std::function<Result<FramePictures>(const FramePictures&, std::uint32_t)> reference;
  std::function<std::optional<MovedDistance>(double brightness)> distance;
  std::map<std::string, std::string> reasons;

 private:
  /// References and distances are computed from the last frame, which must have been drawn with the knobs as they are.
  void expect_last_frame_of_knobs() const { EXPECT_EQ(version_drawn_, knobs_.version()); }

  KnobRegistry knobs_;
  std::uint64_t version_drawn_ = 0;
  std::int32_t index_ = 0;
};

class Progress final : public CostProgress {
 public:
  void measuring(const std::string& knob, const std::string& value, std::size_t done, std::size_t total) override {
    lines.push_back(knob + "=" + value + " " + std::to_string(done) + "/" + std::to_string(total));
  }
  void finished(const LedgerRow&, bool resumed) override { ++(resumed ? found : measured); }

  Status picture(const std::string& name, const Picture& picture) override {
    const auto [known, added] = pictures.emplace(name, picture.rgba);
    EXPECT_TRUE(added || known->second == picture.rgba) << "one name for two pictures: " << name;
    return {};
  }
  bool has_picture(const std::string& name) override { return name != lost; }

  std::vector<std::string> lines;
  std::map<std::string, std::vector<std::uint8_t>> pictures;
  std::string lost;  ///< name of a picture that an earlier run left and that is gone
  int measured = 0;
  int found = 0;
};

class MeasureCosts : public ::testing::Test {
 protected:
  MeasureCosts() {
    request_.header = {.scene = "s", .scene_hash = "h", .width = kSide, .height = kSide, .frames = 5, .samples = 64};
    request_.knobs = {"fake.samples"};
    request_.folder = folder_.path();
  }
  Ledger measure() {
    progress_ = {};
    auto ledger = measure_costs(request_, subject_, progress_);
    EXPECT_TRUE(ledger.ok()) << ledger.error().message;
    return ledger.ok() ? *ledger : Ledger{};
  }
  void judge_by(ReferenceInfo reference) { subject_.references_ = {std::move(reference)}; }

  TestFolder folder_;
  CostRequest request_;
  FakeSubject subject_;
  Progress progress_;
};

}  // namespace gloam::test
