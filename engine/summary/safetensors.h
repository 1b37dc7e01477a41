#pragma once

#include <ATen/core/Tensor.h>

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace patina {

/// What a .safetensors file holds: float32 tensors by name, and its free-form metadata.
struct SafeTensors {
  std::map<std::string, at::Tensor> tensors;
  std::map<std::string, std::string> metadata;
};

/// Reads all of a .safetensors file. Everything the header claims is checked against the file's size before
/// anything is allocated.
/// @throws UserError for a file that is not one, is larger than 600 MB, or holds a tensor that is not float32
SafeTensors read_safetensors(const std::filesystem::path& file);

/// Writes contiguous float32 tensors. @throws UserError if the file cannot be written
void write_safetensors(const std::filesystem::path& file, const SafeTensors& contents);

}  // namespace patina
