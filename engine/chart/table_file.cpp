#include "engine/chart/table_file.h"

#include <algorithm>
#include <charconv>
#include <sstream>

#include "engine/error.h"
#include "engine/io/file.h"

namespace patina {
namespace {

constexpr std::size_t kLargest = std::size_t{256} << 20;  // bytes

std::string one_cell(std::string text) {
  std::ranges::replace(text, ',', ';');
  std::ranges::replace(text, '\n', ' ');
  return text;
}

void append_row(std::string& text, const std::vector<std::string>& cells) {
  for (std::size_t i = 0; i < cells.size(); ++i) text += (i > 0 ? "," : "") + one_cell(cells[i]);
  text += '\n';
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::size_t begin = 0;
  for (;;) {
    const std::size_t comma = line.find(',', begin);
    cells.push_back(line.substr(begin, comma - begin));
    if (comma == std::string::npos) return cells;
    begin = comma + 1;
  }
}

void read_comment(const std::string& line, TableFile& table) {
  const std::size_t equals = line.find(" = ");
  if (equals == std::string::npos || equals < 2) return;
  table.header.emplace_back(line.substr(2, equals - 2), line.substr(equals + 3));
}

}  // namespace

std::string TableFile::value(const std::string& key) const {
  const auto found = std::ranges::find(header, key, &std::pair<std::string, std::string>::first);
  return found == header.end() ? "" : found->second;
}

void write_table(const std::filesystem::path& file, const TableFile& table) {
  std::string text;
  for (const auto& [key, value] : table.header) {
    std::string line = value;
    std::ranges::replace(line, '\n', ' ');
    text += "# " + key + " = " + line + "\n";
  }
  append_row(text, table.columns);
  for (const std::vector<std::string>& row : table.rows) append_row(text, row);
  write_file_atomically(file, text);
}

std::optional<TableFile> read_table(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return std::nullopt;
  std::istringstream lines(read_file(file, kLargest));
  TableFile table;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("#")) {
      read_comment(line, table);
    } else if (table.columns.empty()) {
      table.columns = split(line);
    } else if (table.rows.push_back(split(line)); table.rows.back().size() != table.columns.size()) {
      throw UserError("Row " + std::to_string(table.rows.size()) + " of " + file.string() +
                      " has not as many cells as there are columns: remove the file to begin anew.");
    }
  }
  return table;
}

std::string exact_text(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

double parse_number(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size())
    throw UserError("'" + text +
                    "' stands in a chart's file where a number should: remove the file to begin anew.");
  return value;
}

std::string numbers_text(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : " ") + exact_text(value);
  return text;
}

std::vector<double> parse_numbers(const std::string& text) {
  std::istringstream words(text);
  std::vector<double> values;
  for (std::string word; words >> word;) values.push_back(parse_number(word));
  return values;
}

}  // namespace patina
