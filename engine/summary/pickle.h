#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace patina {

/// Thrown for a pickle that is damaged or more than a state dict; what() continues "it cannot be used: ".
class BadPickle : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct PickleItems;
struct PickleDictionary;

/// A class or function by name. It is only ever compared, never looked up.
struct PickleName {
  std::string_view module, name;
  bool operator==(const PickleName&) const = default;
};

/// A tensor's memory, as the pickle describes it (torch.save's persistent ids).
struct PickleStorage {
  std::string_view type;  ///< "FloatStorage"
  std::string_view key;
  std::int64_t elements = 0;
};

/// A view of a storage; nothing has been checked but that the numbers are there.
struct PickleTensor {
  PickleStorage storage;
  std::int64_t offset = 0;  ///< in elements
  std::vector<std::int64_t> shape, strides;
};

/// None, a truth value, a whole number, a text (or a number of more than 64 bits as its bytes), a name, a
/// storage, a tensor, a tuple or list, or a dictionary.
using PickleValue = std::variant<std::monostate, bool, std::int64_t, std::string_view, PickleName,
                                 std::shared_ptr<const PickleStorage>, std::shared_ptr<const PickleTensor>,
                                 PickleItems*, PickleDictionary*>;

struct PickleItems {
  std::vector<PickleValue> values;
};

struct PickleDictionary {
  std::vector<std::pair<PickleValue, PickleValue>> entries;
};

/// Reads pickles of protocol 2 as torch.save writes state dicts, one after another in the same bytes. It runs
/// nothing: of what a pickle may call it knows collections.OrderedDict and torch._utils' _rebuild_tensor,
/// _rebuild_tensor_v2 and _rebuild_parameter, and answers them with the values above; anything else is
/// refused by name. Opcodes: Python's Lib/pickletools.py; those of protocol 2 that state dicts need.
/// Texts and names point into the bytes, containers belong to the reader: both must outlive the values.
/// Memory is bounded by a small multiple of the bytes.
class PickleReader {
 public:
  explicit PickleReader(std::string_view bytes) : bytes_(bytes) {}

  /// The next pickle's value. @throws BadPickle
  PickleValue load();

  /// Where the last one ended.
  std::size_t position() const { return position_; }

 private:
  // Each executes the opcode if it is one of its kind.
  bool push_constant(char opcode);
  bool push_number(char opcode);
  bool push_text(char opcode);
  bool remember(char opcode);
  bool collect_tuple(char opcode);
  bool fill_container(char opcode);
  bool call(char opcode);

  PickleValue pop();
  std::vector<PickleValue> pop_to_mark();
  PickleItems* new_items(std::vector<PickleValue> values);
  void put(std::uint64_t slot);
  void get(std::uint64_t slot);
  void set_entries(std::vector<PickleValue> keys_and_values);
  PickleValue apply(const PickleName& function, const PickleItems& arguments);

  std::string_view take(std::uint64_t count);
  std::uint64_t take_unsigned(std::size_t count);
  std::string_view take_line();

  std::string_view bytes_;
  std::size_t position_ = 0;
  std::vector<PickleValue> stack_;
  std::map<std::uint64_t, PickleValue> memo_;
  std::vector<std::size_t> marks_;
  std::deque<PickleItems> items_;
  std::deque<PickleDictionary> dictionaries_;
};

}  // namespace patina
