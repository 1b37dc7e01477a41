#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "engine/io/random_access_file.h"

namespace patina {

/// Where a float32 tensor lies in its file, row-major and contiguous; it lies within the file.
struct TensorPlace {
  std::vector<std::int64_t> shape;
  std::uint64_t begin = 0;
  std::uint64_t bytes = 0;
};

/// What a file of named tensors holds, before any of it is read. Nothing here needs libtorch.
struct TensorIndex {
  std::map<std::string, TensorPlace> tensors;
  std::map<std::string, std::string> metadata;
};

/// The size of the largest network file that is read: VGG-19 with its classifier has 575 MB.
constexpr std::uint64_t kMaxNetworkBytes = 600'000'000;

/// A .safetensors file: 8-byte little-endian header length, JSON header, raw data.
/// @throws UserError for a file that is not one, or holds a tensor that is not float32 or outside the file
TensorIndex index_safetensors(const RandomAccessFile& file);

/// A PyTorch checkpoint of a state dict (torch.save), as a zip archive or in the layout before PyTorch 1.6.
/// Its pickles are parsed, never executed (engine/summary/pickle.h).
/// @throws UserError as above, and for pickles that are more than a dictionary of tensors
TensorIndex index_checkpoint(const RandomAccessFile& file);

/// Either, by the file's first bytes.
TensorIndex index_tensors(const RandomAccessFile& file);

/// Checks what PyTorch writes into the names of published checkpoints, "vgg19-dcbb9e9d.pth": the first
/// digits of the file's SHA-256. Files with other names pass.
/// @throws UserError if they differ
void check_hash_in_name(const RandomAccessFile& file);

/// A name from an untrusted file, fit for a one-line message: cut after 80 bytes, control characters as '?'.
std::string printable(std::string name);

/// @throws UserError "The network file NAME cannot be used: WHY; ..."
[[noreturn]] void refuse_network(const std::filesystem::path& file, const std::string& why);

}  // namespace patina
