// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/metrics/linear_error.h"

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "engine/core/assert.h"

namespace gloam {
namespace {

Status check_finite(const LinearPixels& pixels, const std::string& which) {
  for (std::size_t i = 0; i < pixels.count(); ++i) {
    for (std::size_t channel = 0; channel < 3; ++channel) {
      if (std::isfinite(pixels.rgba[i * 4 + channel])) continue;
      return Error{ErrorKind::failed, which + " cannot be judged: pixel " + std::to_string(i % pixels.width) + "," +
                                          std::to_string(i / pixels.width) + " is not a finite number"};
    }
  }
  return {};
}

}  // namespace

Result<RmsError> rms_error(const LinearPixels& reference, const LinearPixels& test) {
  GLOAM_ASSERT(reference.whole() && test.whole(), "a picture has four numbers a pixel and at least one pixel");
  GLOAM_ASSERT(reference.same_size(test), "pictures of different sizes cannot be compared");
  GLOAM_TRY(check_finite(reference, "the reference"));
  GLOAM_TRY(check_finite(test, "the picture"));
  RmsError error;
  error.map.resize(reference.count());
  double sum = 0.0;
  for (std::size_t i = 0; i < error.map.size(); ++i) {
    double square = 0.0;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const double difference =
          static_cast<double>(test.rgba[i * 4 + channel]) - static_cast<double>(reference.rgba[i * 4 + channel]);
      square += difference * difference;
    }
    sum += square / 3.0;
    error.map[i] = static_cast<float>(std::sqrt(square / 3.0));
  }
  error.rmse = std::sqrt(sum / static_cast<double>(error.map.size()));
  error.pixels = statistics_of(error.map);
  return error;
}

Result<ErrorStatistics> temporal_error(std::span<const LinearPixels> reference, std::span<const LinearPixels> test) {
  GLOAM_ASSERT(reference.size() == test.size(), "sequences of different lengths cannot be compared");
  for (std::size_t frame = 0; frame < reference.size(); ++frame) {
    for (const LinearPixels* pixels : {&reference[frame], &test[frame]}) {
      GLOAM_ASSERT(pixels->whole(), "a picture has four numbers a pixel and at least one pixel");
      GLOAM_ASSERT(pixels->same_size(reference[0]), "pictures of different sizes cannot be compared");
    }
    GLOAM_TRY(check_finite(reference[frame], "frame " + std::to_string(frame) + " of the reference"));
    GLOAM_TRY(check_finite(test[frame], "frame " + std::to_string(frame)));
  }
  std::vector<float> errors;
  for (std::size_t frame = 1; frame < reference.size(); ++frame) {
    const auto change = [frame](std::span<const LinearPixels> frames, std::size_t at) {
      return static_cast<double>(frames[frame].rgba[at]) - static_cast<double>(frames[frame - 1].rgba[at]);
    };
    for (std::size_t i = 0; i < reference[0].count(); ++i) {
      double square = 0.0;
      for (std::size_t channel = 0; channel < 3; ++channel) {
        const double difference = change(test, i * 4 + channel) - change(reference, i * 4 + channel);
        square += difference * difference;
      }
      errors.push_back(static_cast<float>(std::sqrt(square / 3.0)));
    }
  }
  return statistics_of(errors);
}

double psnr_db(const EncodedPixels& reference, const EncodedPixels& test) {
  GLOAM_ASSERT(reference.whole() && test.whole(), "a picture has four numbers a pixel and at least one pixel");
  GLOAM_ASSERT(reference.same_size(test), "pictures of different sizes cannot be compared");
  double sum = 0.0;
  for (std::size_t i = 0; i < reference.count(); ++i) {
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const double difference =
          (static_cast<double>(test.rgba[i * 4 + channel]) - reference.rgba[i * 4 + channel]) / 255.0;
      sum += difference * difference;
    }
  }
  if (sum == 0.0) return std::numeric_limits<double>::infinity();
  return -10.0 * std::log10(sum / (3.0 * static_cast<double>(reference.count())));
}

}  // namespace gloam
