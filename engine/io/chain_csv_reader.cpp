#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <limits>
#include <string_view>

#include "engine/error.h"
#include "engine/io/chain_csv.h"

namespace patina {
namespace {

constexpr std::array<std::string_view, 7> kStatisticNames{
    "lp__", "accept_stat__", "stepsize__", "treedepth__", "n_leapfrog__", "divergent__", "energy__"};
constexpr std::size_t kStatistics = kStatisticNames.size();
constexpr std::size_t kChunk = 1u << 16;        ///< bytes read at a time
constexpr std::size_t kLongestLine = 1u << 20;  ///< bytes; a chain file's lines are far shorter

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> cells;
  for (;;) {
    const auto comma = line.find(',');
    cells.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

bool parse_number(std::string_view cell, double& value) {
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return error == std::errc{} && end == cell.data() + cell.size();
}

/// Text from an untrusted file that is safe to show in a terminal.
std::string printable(std::string_view text) {
  std::string result(text);
  std::ranges::replace_if(
      result, [](unsigned char c) { return c < 0x20 || c >= 0x7F; }, '?');
  return result;
}

/// The value behind "key = " in a comment, if it is that key's line.
bool comment_value(std::string_view line, std::string_view key, std::string& value) {
  const auto begin = line.find_first_not_of("# ");
  if (begin == std::string_view::npos || !line.substr(begin).starts_with(key)) return false;
  line.remove_prefix(begin + key.size());
  if (!line.starts_with(" = ")) return false;
  value = line.substr(3, line.find_last_not_of(' ') - 2);
  return true;
}

template <typename Integer>
void comment_integer(std::string_view line, std::string_view key, Integer& number) {
  std::string text;
  if (comment_value(line, key, text)) std::from_chars(text.data(), text.data() + text.size(), number);
}

}  // namespace

struct ChainCsvReader::State {
  std::filesystem::path path;
  ChainCsvHeader header;
  /// Bytes read, whole lines only: a half last line is read again next time, for a writer whose disk is full
  /// takes it back and may write another.
  std::streamoff offset = 0;
  std::int64_t lines = 0;  ///< read before this one
  std::int64_t rows = 0;
  bool has_header = false, adapted = false, closed = false;

  [[noreturn]] void refuse(const std::string& why) const {
    throw UserError("The chain file " + path.filename().string() + " cannot be read, line " +
                    std::to_string(lines + 1) + ": " + why + "; restore it from a copy or start a new run.");
  }

  void read_comment(std::string_view line) {
    if (!has_header) {
      comment_value(line, "model", header.model);
      comment_integer(line, "id", header.id);
      comment_integer(line, "seed", header.seed);
      comment_integer(line, "num_warmup", header.num_warmup);
      comment_integer(line, "num_samples", header.num_samples);
    }
    adapted |= line == "# Adaptation terminated";
  }

  void read_names(std::string_view line) {
    const auto cells = split(line);
    if (cells.size() < kStatistics ||
        !std::equal(kStatisticNames.begin(), kStatisticNames.end(), cells.begin()))
      refuse("it does not begin with lp__ ... energy__");
    for (std::size_t i = kStatistics; i < cells.size(); ++i) header.names.emplace_back(cells[i]);
    has_header = true;
  }

  int count(double number, const char* column) {
    if (!(number >= 0 && number < std::numeric_limits<int>::max()))
      refuse(std::string(column) + " is out of range");
    return static_cast<int>(number);
  }

  Row read_row(std::string_view line) {
    const auto cells = split(line);
    if (cells.size() != kStatistics + header.names.size()) refuse("it has the wrong number of columns");
    std::vector<double> numbers(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (!parse_number(cells[i], numbers[i]))
        refuse("'" + printable(cells[i].substr(0, 40)) + "' is not a number");
    Row row;
    row.row.lp = numbers[0];
    row.row.accept_stat = numbers[1];
    row.row.stepsize = numbers[2];
    row.row.treedepth = count(numbers[3], "treedepth__");
    row.row.n_leapfrog = count(numbers[4], "n_leapfrog__");
    row.row.divergent = numbers[5] != 0;
    row.row.energy = numbers[6];
    row.row.values.assign(numbers.begin() + kStatistics, numbers.end());
    // A file without a warm-up has no adaptation block either.
    row.warmup = !adapted && rows < header.num_warmup;
    ++rows;
    return row;
  }

  void read_line(std::string_view line, std::vector<Row>& rows_out) {
    if (line.empty()) return;
    if (line.front() == '#')
      read_comment(line);
    else if (!has_header)
      read_names(line);
    else
      rows_out.push_back(read_row(line));
  }

  /// Takes the whole lines of the bytes at offset. @return their length
  std::size_t read_lines(std::string_view bytes, std::vector<Row>& rows_out) {
    std::size_t begin = 0;
    for (auto end = bytes.find('\n'); end != std::string_view::npos; end = bytes.find('\n', begin)) {
      const std::string_view line = bytes.substr(begin, end - begin);
      closed = has_header && line == "#";
      if (closed) break;  // not taken: a writer that goes on with the chain puts rows in its place
      read_line(line, rows_out);
      ++lines;
      offset += static_cast<std::streamoff>(end + 1 - begin);
      begin = end + 1;
    }
    return begin;
  }

  /// Goes on where the last whole line ended, also after what was thrown. @throws UserError
  void read_on(std::size_t enough, std::vector<Row>& rows_out) {
    std::ifstream stream(path, std::ios::binary);
    if (!stream) throw UserError("Cannot open the chain file " + path.string() + ": check its permissions.");
    stream.seekg(offset);
    closed = false;
    std::string unread;  // always begins at `offset`
    for (;;) {
      const std::size_t kept = unread.size();
      unread.resize(kept + kChunk);
      stream.read(unread.data() + kept, kChunk);
      if (stream.bad()) throw UserError("Cannot read the chain file " + path.string() + ": try a copy.");
      unread.resize(kept + static_cast<std::size_t>(stream.gcount()));
      if (unread.size() == kept) return;
      unread.erase(0, read_lines(unread, rows_out));
      if (closed || rows_out.size() >= enough) return;
      if (unread.size() > kLongestLine) refuse("it is too long");
    }
  }
};

ChainCsvReader::ChainCsvReader(std::filesystem::path file) : state_(std::make_unique<State>()) {
  state_->path = std::move(file);
}

ChainCsvReader::~ChainCsvReader() = default;
ChainCsvReader::ChainCsvReader(ChainCsvReader&&) noexcept = default;

std::vector<ChainCsvReader::Row> ChainCsvReader::read_new(std::size_t enough) {
  constexpr int kLooks = 3;
  std::vector<Row> rows;
  for (int look = 1;; ++look) {
    try {
      state_->read_on(enough, rows);
      return rows;
    } catch (const UserError&) {
      // While a writer takes rows back and puts others in their place, one look may see some of either.
      if (look == kLooks) throw;
    }
  }
}

std::int64_t ChainCsvReader::bytes_read() const { return state_->offset; }
const ChainCsvHeader& ChainCsvReader::header() const { return state_->header; }
bool ChainCsvReader::has_header() const { return state_->has_header; }
bool ChainCsvReader::closed() const { return state_->closed; }

}  // namespace patina
