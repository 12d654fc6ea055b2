// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "engine/core/result.h"
#include "engine/render/readback/picture.h"

namespace gloam {

/// The picture with fewer pixels, each the mean light of the area it covers. width: 1…picture.width. Keeps the aspect
/// ratio.
[[nodiscard]] Picture shrunk(const Picture& picture, std::uint32_t width);

/// Pictures in a folder: NAME.png, and small/NAME.jpg for pages that embed them, at most 480 pixels wide. Pictures of
/// few pixels have no small file.
class PictureFolder {
 public:
  explicit PictureFolder(std::string folder) : folder_(std::move(folder)) {}

  /// Does nothing if the folder has the name: equal names mean equal pictures.
  [[nodiscard]] Status save(const std::string& name, const Picture& picture) const;
  [[nodiscard]] bool has(const std::string& name) const;
  /// The bytes of the small file, or of the PNG if there is none.
  [[nodiscard]] std::optional<std::string> small_file(const std::string& name) const;

 private:
  [[nodiscard]] std::string full_path(const std::string& name) const { return folder_ + "/" + name + ".png"; }
  [[nodiscard]] std::string small_path(const std::string& name) const { return folder_ + "/small/" + name + ".jpg"; }

  std::string folder_;
};

}  // namespace gloam
