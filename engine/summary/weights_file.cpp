#include "engine/summary/weights_file.h"

#include <ATen/ops/empty.h>

namespace patina {

at::Tensor read_tensor(const RandomAccessFile& file, const TensorPlace& place) {
  at::Tensor tensor = at::empty(place.shape, at::kFloat);
  file.read(place.begin, place.bytes, tensor.data_ptr());
  return tensor;
}

WeightsFile::WeightsFile(const std::filesystem::path& file) : file_(file, kMaxNetworkBytes) {
  check_hash_in_name(file_);
  index_ = index_tensors(file_);
}

}  // namespace patina
