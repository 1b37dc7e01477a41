#pragma once

#include <ATen/core/Tensor.h>

#include "engine/summary/tensor_index.h"

namespace patina {

/// @return a new float32 tensor of the place's shape   @throws UserError if the file has become shorter
at::Tensor read_tensor(const RandomAccessFile& file, const TensorPlace& place);

/// A file of named float32 tensors in any layout that --network takes. Only its headers are read before a
/// tensor is asked for.
class WeightsFile {
 public:
  /// @throws UserError for a file that is none, is larger than 600 MB, or contradicts the hash in its name
  explicit WeightsFile(const std::filesystem::path& file);

  const std::filesystem::path& path() const { return file_.path(); }
  const TensorIndex& index() const { return index_; }

  /// @param name  one of index().tensors
  at::Tensor read(const std::string& name) const { return read_tensor(file_, index_.tensors.at(name)); }

 private:
  RandomAccessFile file_;
  TensorIndex index_;
};

}  // namespace patina
