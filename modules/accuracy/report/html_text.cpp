// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/report/html_text.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/core/text/formatted.h"

namespace gloam {

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default: {
        const bool forbidden = (code < 0x20 && c != '\t' && c != '\n' && c != '\r') || code == 0x7f;
        result += forbidden ? std::string("\xEF\xBF\xBD") : std::string(1, c);
      }
    }
  }
  return result;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[bits >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string ratio_text(const LedgerRow& row) {
  if (row.is_default) return "1";
  const double width = row.ratio_high - row.ratio_low;
  const auto reads_as_one = [](double bound) { return bound != 1.0 && formatted("%.2f", bound) == "1.00"; };
  const bool fine = (width > 0.0 && width < 0.01) || reads_as_one(row.ratio_low) || reads_as_one(row.ratio_high);
  const int digits = fine ? 3 : 2;
  return formatted("%.*f (%.*f–%.*f)", digits, row.ratio, digits, row.ratio_low, digits, row.ratio_high);
}

std::string number_text(double value) {
  if (value == 0.0) return "0";
  const double size = std::abs(value);
  if (!std::isfinite(value) || size < 1e-4 || size >= 1e6) return formatted("%.2g", value);
  const int digits = std::clamp(2 - static_cast<int>(std::floor(std::log10(size))), 0, 6);
  return formatted("%.*f", digits, value);
}

std::string ms_text(double ms) { return number_text(ms) + " ms"; }

std::optional<double> flip_error(const LedgerRow& row) {
  if (!row.flip) return std::nullopt;
  return std::max(row.flip->mean, row.reference_noise);
}

std::string_view visibility_words(const ErrorPair& flip) {
  if (flip.mean < 0.01) return flip.p99 < 0.1 ? "nobody sees it side by side" : "seen only at its worst places";
  if (flip.mean < 0.03) return "seen at most when flipping between the pictures";
  if (flip.mean < 0.1) return "seen when flipping between the pictures";
  return "seen at once";
}

std::string error_text_of(const LedgerRow& row) {
  const std::optional<double> error = row.error();
  if (!error) return "no reference";
  if (row.counted && row.counted->p99)
    return number_text(*error) + " (p99 " + number_text(*row.counted->p99) + ") " + row.counted->unit;
  if (row.counted) return number_text(*error) + " " + row.counted->unit;
  if (!row.flip) return number_text(*error) + " cd/m² RMSE" + (row.below_noise ? ", at most (noise)" : "");
  if (*error == 0.0) return "0 FLIP: equal to the reference";
  return number_text(*error) + (row.below_noise ? " FLIP at most (noise): " : " FLIP: ") +
         std::string(visibility_words({*error, row.flip->p99}));
}

std::string error_words(const LedgerRow& row) {
  const std::optional<double> error = row.error();
  if (!error || row.counted || !row.flip) return "error " + error_text_of(row);
  if (*error == 0.0)
    return std::string("equal to the ") + (row.reference_kind == kWholeFrameKind ? "exact frame" : "reference") +
           " (error 0)";
  return std::string(visibility_words({*error, row.flip->p99})) + " (error " + number_text(*error) + " FLIP" +
         (row.below_noise ? " at most, by the reference’s noise" : "") + ", p99 " + number_text(row.flip->p99) + ")";
}

std::string sentence(std::string_view text) {
  std::string result(text);
  if (!result.empty() && result[0] >= 'a' && result[0] <= 'z') result[0] = static_cast<char>(result[0] - 'a' + 'A');
  return result;
}

std::string reference_text(const LedgerRow& row) {
  const bool named = row.reference_name.find(row.reference_kind) != std::string::npos;
  return named ? row.reference_name : row.reference_kind + ", " + row.reference_name;
}

std::string_view module_of(std::string_view knob) { return knob.substr(0, knob.find('.')); }

}  // namespace gloam
