#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace patina {

/// A column of numbers that grows at its end, in chunks: unlike a vector it never copies what is there, nor
/// has room for twice as much as it holds.
template <typename T>
class ChunkedColumn {
 public:
  std::size_t size() const { return size_; }

  const T& operator[](std::size_t index) const { return chunks_[index / kChunk][index % kChunk]; }

  void push_back(T value) {
    if (size_ % kChunk == 0) chunks_.push_back(std::make_unique<T[]>(kChunk));
    chunks_.back()[size_++ % kChunk] = value;
  }

 private:
  static constexpr std::size_t kChunk = 4096;

  std::vector<std::unique_ptr<T[]>> chunks_;
  std::size_t size_ = 0;
};

}  // namespace patina
