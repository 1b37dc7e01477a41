#include <charconv>
#include <fstream>
#include <limits>
#include <string_view>

#include "engine/error.h"
#include "engine/io/chain_csv.h"

namespace patina {
namespace {

constexpr std::size_t kStatistics = 7;          ///< lp__ ... energy__
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
  std::string pending;        ///< a line whose end has not been written yet
  std::streamoff offset = 0;  ///< bytes taken from the file, pending included
  std::int64_t line_number = 0;
  std::int64_t rows = 0;
  bool has_header = false, adapted = false, closed = false;

  [[noreturn]] void refuse(const std::string& why) const {
    throw UserError("The chain file " + path.filename().string() + " cannot be read, line " +
                    std::to_string(line_number) + ": " + why +
                    "; restore it from a copy or start a new run.");
  }

  void read_comment(std::string_view line) {
    comment_value(line, "model", header.model);
    comment_integer(line, "id", header.id);
    comment_integer(line, "seed", header.seed);
    comment_integer(line, "num_warmup", header.num_warmup);
    comment_integer(line, "num_samples", header.num_samples);
    adapted |= line == "# Adaptation terminated";
    closed |= has_header && line == "#";
  }

  void read_names(std::string_view line) {
    const auto cells = split(line);
    if (cells.size() < kStatistics || cells[0] != "lp__" || cells[6] != "energy__")
      refuse("it does not begin with lp__ ... energy__");
    for (std::size_t i = kStatistics; i < cells.size(); ++i) header.names.emplace_back(cells[i]);
    has_header = true;
  }

  Row read_row(std::string_view line) {
    const auto cells = split(line);
    if (cells.size() != kStatistics + header.names.size()) refuse("it has the wrong number of columns");
    std::vector<double> numbers(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (!parse_number(cells[i], numbers[i]))
        refuse("'" + std::string(cells[i].substr(0, 40)) + "' is not a number");
    Row row;
    row.row.lp = numbers[0];
    row.row.accept_stat = numbers[1];
    row.row.stepsize = numbers[2];
    if (!(numbers[4] >= 0 && numbers[4] < std::numeric_limits<int>::max()))
      refuse("n_leapfrog__ is out of range");
    row.row.n_leapfrog = static_cast<int>(numbers[4]);
    row.row.divergent = numbers[5] != 0;
    row.row.energy = numbers[6];
    row.row.values.assign(numbers.begin() + kStatistics, numbers.end());
    // A file without a warm-up has no adaptation block either.
    row.warmup = !adapted && rows < header.num_warmup;
    ++rows;
    return row;
  }

  void read_line(std::string_view line, std::vector<Row>& rows_out) {
    ++line_number;
    if (line.empty()) return;
    if (line.front() == '#')
      read_comment(line);
    else if (!has_header)
      read_names(line);
    else
      rows_out.push_back(read_row(line));
  }
};

ChainCsvReader::ChainCsvReader(std::filesystem::path file) : state_(std::make_unique<State>()) {
  state_->path = std::move(file);
}

ChainCsvReader::~ChainCsvReader() = default;
ChainCsvReader::ChainCsvReader(ChainCsvReader&&) noexcept = default;

std::vector<ChainCsvReader::Row> ChainCsvReader::read_new() {
  std::ifstream stream(state_->path, std::ios::binary);
  if (!stream)
    throw UserError("Cannot open the chain file " + state_->path.string() + ": check its permissions.");
  stream.seekg(state_->offset);
  std::vector<Row> rows;
  std::string chunk(1 << 16, '\0');
  for (;;) {
    stream.read(chunk.data(), static_cast<std::streamsize>(chunk.size()));
    const auto count = stream.gcount();
    if (count <= 0) return rows;
    state_->offset += count;
    std::string_view fresh(chunk.data(), static_cast<std::size_t>(count));
    for (auto end = fresh.find('\n'); end != std::string_view::npos; end = fresh.find('\n')) {
      state_->pending.append(fresh.substr(0, end));
      state_->read_line(state_->pending, rows);
      state_->pending.clear();
      fresh.remove_prefix(end + 1);
    }
    state_->pending.append(fresh);
    if (state_->pending.size() > kLongestLine) state_->refuse("it is too long");
  }
}

const ChainCsvHeader& ChainCsvReader::header() const { return state_->header; }
bool ChainCsvReader::has_header() const { return state_->has_header; }
bool ChainCsvReader::closed() const { return state_->closed; }

}  // namespace patina
