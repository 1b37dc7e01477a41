#include <charconv>
#include <cmath>
#include <fstream>

#include "engine/error.h"
#include "engine/io/append_file.h"
#include "engine/io/chain_csv.h"

namespace patina {
namespace {

constexpr int kPaddedDigits = 12;  ///< room to patch num_samples in place

/// Shortest text that reads back as the same double; not-finite values as CmdStan spells them.
void put(std::string& line, double value) {
  if (std::isnan(value)) {
    line += "nan";
  } else if (std::isinf(value)) {
    line += value > 0 ? "inf" : "-inf";
  } else {
    char text[32];
    line.append(text, std::to_chars(text, text + sizeof text, value).ptr);
  }
}

std::string padded(std::int64_t number) {
  std::string digits = std::to_string(number);
  digits.resize(kPaddedDigits, ' ');
  return digits;
}

std::string header_before_samples(const ChainCsvHeader& header) {
  return "# stan_version_major = 2\n# stan_version_minor = 31\n# stan_version_patch = 0\n# model = " +
         header.model + "\n# method = sample (Default)\n#   sample\n#     num_samples = ";
}

std::string header_after_samples(const ChainCsvHeader& header) {
  std::string text = "\n#     num_warmup = " + std::to_string(header.num_warmup) +
                     "\n#     save_warmup = 1\n#     thin = 1 (Default)\n#     algorithm = hmc (Default)\n"
                     "#       hmc\n#         engine = static\n#         metric = diag_e (Default)\n"
                     "#         max_depth = 10\n# id = " +
                     std::to_string(header.id) + "\n# random\n#   seed = " + std::to_string(header.seed) +
                     "\nlp__,accept_stat__,stepsize__,treedepth__,n_leapfrog__,divergent__,energy__";
  for (const std::string& name : header.names) text += "," + name;
  return text + "\n";
}

std::int64_t samples_offset(const ChainCsvHeader& header) {
  return static_cast<std::int64_t>(header_before_samples(header).size());
}

std::string header_text(const ChainCsvHeader& header) {
  return header_before_samples(header) + padded(header.num_samples) + header_after_samples(header);
}

/// @throws UserError unless the file begins as that header does, num_samples left aside
void check_header(const std::filesystem::path& file, ChainCsvHeader header) {
  const std::string expected = header_text(header);
  std::string found(expected.size(), '\0');
  std::ifstream(file, std::ios::binary).read(found.data(), static_cast<std::streamsize>(found.size()));
  const auto offset = static_cast<std::size_t>(samples_offset(header));
  if (found.replace(offset, kPaddedDigits, expected, offset, kPaddedDigits) != expected)
    throw UserError(
        file.string() +
        " is not the chain file that was written here: restore it from a copy, or start a new run.");
}

}  // namespace

struct ChainCsvWriter::State {
  AppendFile file;
  std::int64_t samples_offset = 0;
  std::int64_t rows_after_warmup = 0;
  bool adapted = false, sampling = false;

  template <typename... Arguments>
  explicit State(const Arguments&... arguments) : file(arguments...) {}
};

ChainCsvWriter::ChainCsvWriter(const std::filesystem::path& file, const ChainCsvHeader& header)
    : state_(std::make_unique<State>(file)) {
  state_->samples_offset = samples_offset(header);
  state_->sampling = header.num_warmup == 0;
  state_->file.append(header_text(header));
}

ChainCsvWriter::ChainCsvWriter(const std::filesystem::path& file, const ChainCsvHeader& header,
                               const ChainCsvPlace& place) {
  check_header(file, header);
  state_ = std::make_unique<State>(file, place.bytes);
  state_->samples_offset = samples_offset(header);
  state_->rows_after_warmup = place.rows_after_warmup;
  state_->adapted = place.adapted;
  state_->sampling = place.adapted || header.num_warmup == 0;
  state_->file.patch(state_->samples_offset, padded(header.num_samples));
}

ChainCsvWriter::~ChainCsvWriter() = default;
ChainCsvWriter::ChainCsvWriter(ChainCsvWriter&&) noexcept = default;

void ChainCsvWriter::append(const ChainCsvRow& row) {
  std::string line;
  for (const double value : {row.lp, row.accept_stat, row.stepsize}) {
    put(line, value);
    line += ',';
  }
  // Readers take integer text only in treedepth__ and divergent__.
  line +=
      std::to_string(row.treedepth) + "," + std::to_string(row.n_leapfrog) + (row.divergent ? ",1," : ",0,");
  put(line, row.energy);
  for (const double value : row.values) {
    line += ',';
    put(line, value);
  }
  line += '\n';
  state_->file.append(line);
  state_->rows_after_warmup += state_->sampling;
}

void ChainCsvWriter::adaptation_terminated(double step_size,
                                           const std::vector<double>& inverse_metric_diagonal) {
  std::string block = "# Adaptation terminated\n# Step size = ";
  put(block, step_size);
  block += "\n# Diagonal elements of inverse mass matrix:\n#";
  for (std::size_t i = 0; i < inverse_metric_diagonal.size(); ++i) {
    block += i == 0 ? " " : ", ";
    put(block, inverse_metric_diagonal[i]);
  }
  state_->file.append(block + "\n");
  state_->adapted = state_->sampling = true;
}

void ChainCsvWriter::close() {
  // First, for it needs no room: on a full disk the count is right even where the footer does not fit.
  state_->file.patch(state_->samples_offset, padded(state_->rows_after_warmup));
  state_->file.append("#\n");
}

ChainCsvPlace ChainCsvWriter::place() const {
  return {state_->file.size(), state_->rows_after_warmup, state_->adapted};
}

void ChainCsvWriter::sync() { state_->file.sync(); }

}  // namespace patina
