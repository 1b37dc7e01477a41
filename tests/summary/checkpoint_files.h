#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace patina {

/// A tensor of a checkpoint to be written, and the lies that may be told about it.
struct WrittenTensor {
  std::string name;
  std::vector<std::int64_t> shape, strides;
  std::string key = "0";
  std::int64_t storage_elements = 0;
  std::int64_t offset = 0;
  std::string storage_type = "FloatStorage";
};

/// Pieces of a pickle of protocol 2.
namespace pickled {
std::string text(std::string_view value);
std::string number(std::int64_t value);  ///< of 32 bits, or of up to 64 as LONG1
std::string tuple(const std::vector<std::string>& items);
std::string name(std::string_view module, std::string_view name);
std::string call(const std::string& function, const std::string& arguments);
std::string tensor(const WrittenTensor& tensor, bool legacy, const std::string& rebuild);
/// An OrderedDict, with its version numbers as torch.save writes them.
std::string state_dict(const std::vector<std::string>& keys_and_values);
std::string complete(const std::string& value);  ///< PROTO value STOP
}  // namespace pickled

/// A state dict's pickle.
std::string state_dict_pickle(const std::vector<WrittenTensor>& tensors, bool legacy = false,
                              const std::string& rebuild = "_rebuild_tensor_v2");

/// A zip archive of stored entries. Its check sums are zero: nothing reads them.
std::string zip_of(const std::map<std::string, std::string>& entries);

/// torch.save's layouts around a pickle. @param storages  numbers by key
std::string zip_checkpoint(const std::string& pickle,
                           const std::map<std::string, std::vector<float>>& storages);
std::string legacy_checkpoint(const std::string& pickle,
                              const std::map<std::string, std::vector<float>>& storages);

}  // namespace patina
