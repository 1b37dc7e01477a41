#include <charconv>
#include <cmath>
#include <cstdio>

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

/// Two decimals are enough for a clock.
std::string seconds_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  return text;
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

}  // namespace

struct ChainCsvWriter::State {
  AppendFile file;
  std::int64_t samples_offset = 0;
  std::int64_t rows_after_warmup = 0;
  bool sampling = false;

  explicit State(const std::filesystem::path& path) : file(path) {}
};

ChainCsvWriter::ChainCsvWriter(const std::filesystem::path& file, const ChainCsvHeader& header)
    : state_(std::make_unique<State>(file)) {
  const std::string before = header_before_samples(header);
  state_->samples_offset = static_cast<std::int64_t>(before.size());
  state_->sampling = header.num_warmup == 0;
  state_->file.append(before + padded(header.num_samples) + header_after_samples(header));
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
  state_->sampling = true;
}

void ChainCsvWriter::close(double warmup_seconds, double sampling_seconds) {
  // First, for it needs no room: on a full disk the count is right even where the footer does not fit.
  state_->file.patch(state_->samples_offset, padded(state_->rows_after_warmup));
  state_->file.append("#\n#  Elapsed Time: " + seconds_text(warmup_seconds) +
                      " seconds (Warm-up)\n#                " + seconds_text(sampling_seconds) +
                      " seconds (Sampling)\n#                " +
                      seconds_text(warmup_seconds + sampling_seconds) + " seconds (Total)\n#\n");
}

}  // namespace patina
