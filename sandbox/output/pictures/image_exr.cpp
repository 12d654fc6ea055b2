// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>

#include <algorithm>
#include <exception>
#include <string>

#include "engine/core/assert.h"
#include "sandbox/output/file_io.h"
#include "sandbox/output/pictures/image_io.h"

namespace gloam {
namespace {

/// Collects a file in memory, so that it is written as a whole.
class BytesStream final : public Imf::OStream {
 public:
  BytesStream() : Imf::OStream("memory") {}
  void write(const char* from, int count) override {
    const auto size = static_cast<std::size_t>(count);
    bytes_.resize(std::max(bytes_.size(), at_ + size));
    std::copy_n(from, size, bytes_.begin() + static_cast<std::ptrdiff_t>(at_));
    at_ += size;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t at) override { at_ = at; }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

}  // namespace

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
    BytesStream bytes;
    {
      Imf::OutputFile file(bytes, header);
      file.setFrameBuffer(frame);
      file.writePixels(static_cast<int>(height));
    }
    return write_file(path, bytes.bytes());
  } catch (const std::exception& fault) {
    return Error{ErrorKind::failed, path + ": cannot be written: " + fault.what()};
  }
}

}  // namespace gloam
