#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace patina {

/// A table of text: comments "# key = value", a line of column names, then rows; no cell holds a comma or a
/// line break.
struct TableFile {
  std::vector<std::pair<std::string, std::string>> header;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;

  /// The value of a key; empty if there is none.
  std::string value(const std::string& key) const;
};

/// Commas and line breaks of cells and header values become semicolons and spaces.
void write_table(const std::filesystem::path& file, const TableFile& table);

/// Nothing if there is no such file. @throws UserError for a row that has not a cell for each column
std::optional<TableFile> read_table(const std::filesystem::path& file);

/// Reads back to the same number; "nan", "inf".
std::string exact_text(double value);

/// @throws UserError for what is not a number
double parse_number(const std::string& text);

/// Numbers separated by spaces, and back.
std::string numbers_text(const std::vector<double>& values);
std::vector<double> parse_numbers(const std::string& text);

}  // namespace patina
