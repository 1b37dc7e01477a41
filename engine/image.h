#pragma once

#include <cassert>
#include <cstddef>
#include <vector>

namespace patina {

/// A plain float image: rows from the top, channels interleaved. The owner says what the numbers mean
/// (sRGB in [0,1], linear radiance, a unit normal, centimetres ...). Crosses threads freely.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<float> pixels;  ///< height * width * channels

  Image() = default;
  Image(int width_, int height_, int channels_)
      : width(width_), height(height_), channels(channels_),
        pixels(static_cast<std::size_t>(width_) * height_ * channels_) {}

  bool empty() const { return pixels.empty(); }
  float& at(int row, int column, int channel) { return pixels[index(row, column, channel)]; }
  float at(int row, int column, int channel) const { return pixels[index(row, column, channel)]; }

 private:
  std::size_t index(int row, int column, int channel) const {
    assert(row >= 0 && row < height && column >= 0 && column < width && channel >= 0 && channel < channels);
    return (static_cast<std::size_t>(row) * width + column) * channels + channel;
  }
};

}  // namespace patina
