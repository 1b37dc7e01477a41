#pragma once

#include <Eigen/Core>

#include <concepts>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace patina {

/// Bytes that are not what an archive of these types can be: one clause that says why.
struct ArchiveError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Values as bytes and back, exactly: numbers as this machine keeps them, lengths before what they count. One
/// function serves both directions, so that they cannot disagree:
///   void serialise(Archive& archive, Thing& thing) { archive(thing.width, thing.height); }
/// or a member `serialise(Archive&)` where the fields are private. Read bytes are not believed: what runs
/// over the end is an ArchiveError before it is memory.
class Archive {
 public:
  Archive() = default;  ///< to write
  /// To read. @param bytes  what take_bytes() of a written archive yielded
  explicit Archive(std::string bytes) : bytes_(std::move(bytes)), reading_(true) {}

  bool reading() const { return reading_; }

  /// Writes the values, or reads them in place. @throws ArchiveError
  template <typename... T>
  void operator()(T&... values) {
    (serialise(*this, values), ...);
  }

  /// Writes `size` bytes, or fills them. @throws ArchiveError where as many are not left
  void raw(void* data, std::size_t size);

  /// Writes a number of elements, or returns the one that was written.
  /// @param element_bytes  the least that each takes, at least 1 @throws ArchiveError where they are not left
  Eigen::Index count(Eigen::Index written, std::size_t element_bytes);

  /// @throws ArchiveError if bytes are left over
  void expect_end() const;

  std::string take_bytes() { return std::move(bytes_); }

 private:
  std::string bytes_;
  std::size_t place_ = 0;
  bool reading_ = false;
};

template <typename T>
requires std::integral<T> || std::floating_point<T>
void serialise(Archive& archive, T& number) { archive.raw(&number, sizeof number); }

/// @throws ArchiveError for a byte that is neither 0 nor 1
void serialise(Archive& archive, bool& flag);

template <typename T>
requires requires(T& thing, Archive& archive) { thing.serialise(archive); }
void serialise(Archive& archive, T& thing) { thing.serialise(archive); }

template <typename T>
void serialise(Archive& archive, std::vector<T>& list) {
  list.resize(static_cast<std::size_t>(archive.count(static_cast<Eigen::Index>(list.size()), 1)));
  for (T& element : list) archive(element);
}

template <typename T>
void serialise(Archive& archive, std::optional<T>& value) {
  bool is_there = value.has_value();
  archive(is_there);
  if (!is_there) return;
  if (!value) value.emplace();
  archive(*value);
}

void serialise(Archive& archive, Eigen::VectorXd& vector);
void serialise(Archive& archive, Eigen::VectorXi& vector);
void serialise(Archive& archive, Eigen::MatrixXd& matrix);

}  // namespace patina
