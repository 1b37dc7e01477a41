#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace patina {

/// A column of numbers that grows at its end, in chunks: unlike a vector it never copies what is there, nor
/// has room for twice as much as it holds.
template <typename T>
class ChunkedColumn {
 public:
  std::size_t size() const { return size_; }

  const T& operator[](std::size_t index) const { return chunks_[index / kChunk][index % kChunk]; }

  /// The elements from `first` on that lie side by side: the rest of its chunk.
  std::span<const T> run(std::size_t first) const {
    const std::size_t end = std::min(size_, (first / kChunk + 1) * kChunk);
    return {&chunks_[first / kChunk][first % kChunk], end - first};
  }

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
