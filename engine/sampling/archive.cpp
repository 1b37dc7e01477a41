#include "engine/sampling/archive.h"

#include <cstring>

namespace patina {
namespace {

template <typename Vector>
void serialise_vector(Archive& archive, Vector& vector) {
  using Scalar = typename Vector::Scalar;
  vector.resize(archive.count(vector.size(), sizeof(Scalar)));
  archive.raw(vector.data(), sizeof(Scalar) * static_cast<std::size_t>(vector.size()));
}

}  // namespace

void Archive::raw(void* data, std::size_t size) {
  if (size == 0) return;
  if (!reading_) {
    bytes_.append(static_cast<const char*>(data), size);
    return;
  }
  if (size > bytes_.size() - place_) throw ArchiveError("it ends too early");
  std::memcpy(data, bytes_.data() + place_, size);
  place_ += size;
}

Eigen::Index Archive::count(Eigen::Index written, std::size_t element_bytes) {
  auto number = static_cast<std::uint64_t>(written);
  raw(&number, sizeof number);
  if (reading_ && number > (bytes_.size() - place_) / element_bytes) throw ArchiveError("it ends too early");
  return static_cast<Eigen::Index>(number);
}

void Archive::expect_end() const {
  if (place_ != bytes_.size()) throw ArchiveError("it is longer than it should be");
}

void serialise(Archive& archive, bool& flag) {
  auto byte = static_cast<unsigned char>(flag);
  archive.raw(&byte, 1);
  if (byte > 1) throw ArchiveError("a flag is neither yes nor no");
  flag = byte == 1;
}

void serialise(Archive& archive, Eigen::VectorXd& vector) { serialise_vector(archive, vector); }
void serialise(Archive& archive, Eigen::VectorXi& vector) { serialise_vector(archive, vector); }

void serialise(Archive& archive, Eigen::MatrixXd& matrix) {
  const Eigen::Index rows = archive.count(matrix.rows(), sizeof(double));
  Eigen::Map<Eigen::VectorXd> flat(matrix.data(), matrix.size());
  Eigen::VectorXd elements = flat;
  archive(elements);
  if (!archive.reading()) return;
  if (rows == 0 ? elements.size() != 0 : elements.size() % rows != 0)
    throw ArchiveError("a matrix is not a rectangle");
  matrix = elements.reshaped(rows, rows == 0 ? 0 : elements.size() / rows);
}

}  // namespace patina
