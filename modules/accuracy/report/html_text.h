// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "modules/accuracy/outputs.h"

// Texts of the report.

namespace gloam {

/// For HTML text and quoted attributes. Control characters other than tab and line breaks, which HTML does not allow,
/// become U+FFFD.
[[nodiscard]] std::string escaped(std::string_view text);

/// Base64 (RFC 4648, section 4) of the bytes.
[[nodiscard]] std::string base64(std::string_view bytes);

/// "0.71 (0.70–0.73)", to the digit that the interval justifies, and so that it is read as below or above 1; "1" for
/// the default.
[[nodiscard]] std::string ratio_text(const LedgerRow& row);
/// Three significant digits: "0.0123", "12.3", "1230", "4.1e-06", "0".
[[nodiscard]] std::string number_text(double value);
/// "12.3 ms"
[[nodiscard]] std::string ms_text(double ms);

/// Mean FLIP, at least the reference's noise; nullopt without FLIP.
[[nodiscard]] std::optional<double> flip_error(const LedgerRow& row);
/// Who sees an error: "nobody sees it side by side", "seen at once". FLIP; a small mean may hide places whose error is
/// seen, which the 99th percentile tells.
[[nodiscard]] std::string_view visibility_words(const ErrorPair& flip);
/// The row's error with its unit, and in words if it is FLIP; "no reference" without one.
[[nodiscard]] std::string error_text_of(const LedgerRow& row);

/// The row's error in words, then its number: "seen at once (error 0.2 FLIP)".
[[nodiscard]] std::string error_words(const LedgerRow& row);
/// The text with a capital first letter.
[[nodiscard]] std::string sentence(std::string_view text);
/// The reference of the row's error: "brute force, exact lists"; of a name that says the kind, the name.
[[nodiscard]] std::string reference_text(const LedgerRow& row);

/// The part of a knob's name before the first point.
[[nodiscard]] std::string_view module_of(std::string_view knob);

}  // namespace gloam
