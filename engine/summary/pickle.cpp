#include "engine/summary/pickle.h"

#include <algorithm>
#include <iterator>

namespace patina {
namespace {

/// The value as a T, which BadPickle says it should be.
template <typename T>
const T& as(const PickleValue& value, const char* what) {
  if (const T* held = std::get_if<T>(&value)) return *held;
  throw BadPickle(std::string("its pickle has no ") + what + " where one belongs");
}

std::string printable_name(const PickleName& name) {
  std::string text = std::string(name.module.substr(0, 60)) + "." + std::string(name.name.substr(0, 60));
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < ' ' || c >= 0x7f; }, '?');
  return text;
}

std::vector<std::int64_t> numbers(const PickleValue& value) {
  constexpr std::size_t kMaxDimensions = 8;
  const PickleItems& items = *as<PickleItems*>(value, "tuple");
  if (items.values.size() > kMaxDimensions) throw BadPickle("it has a tensor of more than 8 dimensions");
  std::vector<std::int64_t> numbers;
  for (const PickleValue& number : items.values) numbers.push_back(as<std::int64_t>(number, "number"));
  return numbers;
}

std::shared_ptr<const PickleStorage> storage_of(const PickleItems& id) {
  constexpr std::size_t kWithoutView = 5;
  if (id.values.size() < kWithoutView || as<std::string_view>(id.values[0], "text") != "storage" ||
      (id.values.size() > kWithoutView && !std::holds_alternative<std::monostate>(id.values[kWithoutView])))
    throw BadPickle("its pickle refers to something that is not a whole storage");
  const auto& type = as<PickleName>(id.values[1], "storage type");
  if (type.module != "torch") throw BadPickle("its pickle has a storage of type " + printable_name(type));
  return std::make_shared<PickleStorage>(PickleStorage{type.name, as<std::string_view>(id.values[2], "text"),
                                                       as<std::int64_t>(id.values[4], "number")});
}

std::shared_ptr<const PickleTensor> tensor_of(const PickleItems& arguments) {
  if (arguments.values.size() < 4) throw BadPickle("its pickle rebuilds a tensor from too little");
  const auto& storage = as<std::shared_ptr<const PickleStorage>>(arguments.values[0], "storage");
  return std::make_shared<PickleTensor>(
      PickleTensor{*storage, as<std::int64_t>(arguments.values[1], "number"), numbers(arguments.values[2]),
                   numbers(arguments.values[3])});
}

}  // namespace

PickleValue PickleReader::load() {
  stack_.clear();
  memo_.clear();
  marks_.clear();
  for (;;) {
    const char opcode = take(1).front();
    if (opcode == '\x80') {  // PROTO
      if (take_unsigned(1) != 2) throw BadPickle("its pickle is not of protocol 2, as torch.save's are");
    } else if (opcode == '.') {  // STOP
      return pop();
    } else if (!push_constant(opcode) && !push_number(opcode) && !push_text(opcode) && !remember(opcode) &&
               !collect_tuple(opcode) && !fill_container(opcode) && !call(opcode)) {
      throw BadPickle("its pickle is more than a state dict of tensors (opcode " +
                      std::to_string(static_cast<unsigned char>(opcode)) + ")");
    }
  }
}

bool PickleReader::push_constant(char opcode) {
  switch (opcode) {
    case 'N':
      stack_.emplace_back(std::monostate());
      return true;
    case '\x88':  // NEWTRUE
    case '\x89':  // NEWFALSE
      stack_.emplace_back(opcode == '\x88');
      return true;
    case ')':
    case ']':
      stack_.emplace_back(new_items({}));
      return true;
    case '}':
      stack_.emplace_back(&dictionaries_.emplace_back());
      return true;
    default:
      return false;
  }
}

bool PickleReader::push_number(char opcode) {
  switch (opcode) {
    case 'J':  // BININT, signed
      stack_.emplace_back(std::int64_t{static_cast<std::int32_t>(take_unsigned(4))});
      return true;
    case 'K':  // BININT1
    case 'M':  // BININT2
      stack_.emplace_back(static_cast<std::int64_t>(take_unsigned(opcode == 'K' ? 1 : 2)));
      return true;
    case '\x8a': {  // LONG1, signed and as short as it can be
      const std::string_view digits = take(take_unsigned(1));
      if (digits.size() > 8) {
        stack_.emplace_back(digits);
        return true;
      }
      std::uint64_t number = !digits.empty() && (digits.back() & '\x80') ? ~std::uint64_t{0} : 0;
      for (auto digit = digits.rbegin(); digit != digits.rend(); ++digit)
        number = number << 8 | static_cast<unsigned char>(*digit);
      stack_.emplace_back(static_cast<std::int64_t>(number));
      return true;
    }
    default:
      return false;
  }
}

bool PickleReader::push_text(char opcode) {
  switch (opcode) {
    case 'U':  // SHORT_BINSTRING, from Python 2
      stack_.emplace_back(take(take_unsigned(1)));
      return true;
    case 'T':  // BINSTRING
    case 'X':  // BINUNICODE
      stack_.emplace_back(take(take_unsigned(4)));
      return true;
    case 'c': {  // GLOBAL
      const std::string_view module = take_line();
      stack_.emplace_back(PickleName{module, take_line()});
      return true;
    }
    default:
      return false;
  }
}

bool PickleReader::remember(char opcode) {
  switch (opcode) {
    case 'q':  // BINPUT
    case 'r':  // LONG_BINPUT
      put(take_unsigned(opcode == 'q' ? 1 : 4));
      return true;
    case 'h':  // BINGET
    case 'j':  // LONG_BINGET
      get(take_unsigned(opcode == 'h' ? 1 : 4));
      return true;
    default:
      return false;
  }
}

bool PickleReader::collect_tuple(char opcode) {
  if (opcode == '(') {  // MARK
    marks_.push_back(stack_.size());
    return true;
  }
  std::vector<PickleValue> values;
  if (opcode == 't') {
    values = pop_to_mark();
  } else if (opcode >= '\x85' && opcode <= '\x87') {  // TUPLE1, TUPLE2, TUPLE3
    for (char i = '\x85'; i <= opcode; ++i) values.push_back(pop());
    std::ranges::reverse(values);
  } else {
    return false;
  }
  stack_.emplace_back(new_items(std::move(values)));
  return true;
}

bool PickleReader::fill_container(char opcode) {
  if (opcode == 'a' || opcode == 'e') {  // APPEND, APPENDS
    std::vector<PickleValue> values;
    if (opcode == 'e')
      values = pop_to_mark();
    else
      values.push_back(pop());
    if (stack_.empty()) throw BadPickle("its pickle is damaged");
    std::ranges::move(values, std::back_inserter(as<PickleItems*>(stack_.back(), "list")->values));
    return true;
  }
  if (opcode == 'u') {  // SETITEMS
    set_entries(pop_to_mark());
    return true;
  }
  if (opcode != 's') return false;  // SETITEM
  PickleValue value = pop(), key = pop();
  set_entries({std::move(key), std::move(value)});
  return true;
}

bool PickleReader::call(char opcode) {
  switch (opcode) {
    case 'Q': {  // BINPERSID
      const PickleValue id = pop();
      stack_.emplace_back(storage_of(*as<PickleItems*>(id, "tuple")));
      return true;
    }
    case 'R': {  // REDUCE
      const PickleValue arguments = pop(), function = pop();
      stack_.push_back(apply(as<PickleName>(function, "function"), *as<PickleItems*>(arguments, "tuple")));
      return true;
    }
    case 'b': {  // BUILD: a state dict's version numbers, of which nothing is needed
      const PickleValue state = pop();
      as<PickleDictionary*>(state, "dictionary");
      if (stack_.empty()) throw BadPickle("its pickle is damaged");
      as<PickleDictionary*>(stack_.back(), "dictionary");
      return true;
    }
    default:
      return false;
  }
}

PickleValue PickleReader::apply(const PickleName& function, const PickleItems& arguments) {
  if (function == PickleName{"collections", "OrderedDict"} && arguments.values.empty())
    return &dictionaries_.emplace_back();
  if (function == PickleName{"torch._utils", "_rebuild_tensor"} ||
      function == PickleName{"torch._utils", "_rebuild_tensor_v2"})
    return tensor_of(arguments);
  if (function == PickleName{"torch._utils", "_rebuild_parameter"} && !arguments.values.empty())
    return as<std::shared_ptr<const PickleTensor>>(arguments.values.front(), "tensor");
  throw BadPickle("its pickle calls " + printable_name(function) + ", which no dictionary of tensors needs");
}

void PickleReader::set_entries(std::vector<PickleValue> keys_and_values) {
  if (stack_.empty() || keys_and_values.size() % 2 != 0) throw BadPickle("its pickle is damaged");
  PickleDictionary* dictionary = as<PickleDictionary*>(stack_.back(), "dictionary");
  for (std::size_t i = 0; i < keys_and_values.size(); i += 2)
    dictionary->entries.emplace_back(std::move(keys_and_values[i]), std::move(keys_and_values[i + 1]));
}

PickleValue PickleReader::pop() {
  const std::size_t floor = marks_.empty() ? 0 : marks_.back();
  if (stack_.size() <= floor) throw BadPickle("its pickle is damaged");
  PickleValue value = std::move(stack_.back());
  stack_.pop_back();
  return value;
}

std::vector<PickleValue> PickleReader::pop_to_mark() {
  if (marks_.empty()) throw BadPickle("its pickle is damaged");
  const auto begin = stack_.begin() + static_cast<std::ptrdiff_t>(marks_.back());
  marks_.pop_back();
  std::vector<PickleValue> values(std::make_move_iterator(begin), std::make_move_iterator(stack_.end()));
  stack_.erase(begin, stack_.end());
  return values;
}

PickleItems* PickleReader::new_items(std::vector<PickleValue> values) {
  return &items_.emplace_back(PickleItems{std::move(values)});
}

void PickleReader::put(std::uint64_t slot) {
  if (stack_.empty()) throw BadPickle("its pickle is damaged");
  memo_[slot] = stack_.back();
}

void PickleReader::get(std::uint64_t slot) {
  const auto remembered = memo_.find(slot);
  if (remembered == memo_.end()) throw BadPickle("its pickle is damaged");
  stack_.push_back(remembered->second);
}

std::string_view PickleReader::take(std::uint64_t count) {
  if (count > bytes_.size() - position_) throw BadPickle("its pickle ends too early");
  const std::string_view taken = bytes_.substr(position_, static_cast<std::size_t>(count));
  position_ += taken.size();
  return taken;
}

std::uint64_t PickleReader::take_unsigned(std::size_t count) {
  std::uint64_t number = 0;
  const std::string_view digits = take(count);
  for (auto digit = digits.rbegin(); digit != digits.rend(); ++digit)
    number = number << 8 | static_cast<unsigned char>(*digit);
  return number;
}

std::string_view PickleReader::take_line() {
  const std::size_t end = bytes_.find('\n', position_);
  if (end == std::string_view::npos) throw BadPickle("its pickle ends too early");
  const std::string_view line = take(end - position_);
  take(1);
  return line;
}

}  // namespace patina
