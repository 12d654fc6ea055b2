// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>

#include <exception>

#include "engine/core/assert.h"
#include "sandbox/output/pictures/image_io.h"

namespace gloam {

Status write_exr(const std::string& path, std::uint32_t width, std::uint32_t height, std::span<const float> rgba) {
  GLOAM_ASSERT(rgba.size() == std::size_t{width} * height * 4 && !rgba.empty(), "a picture has four floats a pixel");
  try {
    Imf::Header header(static_cast<int>(width), static_cast<int>(height));
    header.compression() = Imf::ZIPS_COMPRESSION;
    Imf::FrameBuffer frame;
    constexpr const char* kChannels[] = {"R", "G", "B"};
    for (std::size_t channel = 0; channel < 3; ++channel) {
      header.channels().insert(kChannels[channel], Imf::Channel(Imf::FLOAT));
      // OpenEXR takes a char* but does not write through it.
      char* const base = const_cast<char*>(reinterpret_cast<const char*>(rgba.data() + channel));
      frame.insert(kChannels[channel],
                   Imf::Slice(Imf::FLOAT, base, 4 * sizeof(float), std::size_t{width} * 4 * sizeof(float)));
    }
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(frame);
    file.writePixels(static_cast<int>(height));
  } catch (const std::exception& fault) {
    return Error{ErrorKind::failed, path + ": cannot be written: " + fault.what()};
  }
  return {};
}

}  // namespace gloam
