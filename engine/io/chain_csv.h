#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace patina {

/// What a chain file says about itself; the dialect is CmdStan's.
struct ChainCsvHeader {
  std::string model;  ///< "patina_leather"
  int id = 1;         ///< chain number from 1
  std::uint64_t seed = 0;
  int num_warmup = 0;
  int num_samples = 0;             ///< asked for; patched in place when the chain is closed with fewer
  std::vector<std::string> names;  ///< parameter columns
};

/// One row.
struct ChainCsvRow {
  double lp = 0, accept_stat = 0, stepsize = 0;
  int n_leapfrog = 1;
  bool divergent = false;
  double energy = 0;
  std::vector<double> values;  ///< one per name
  int treedepth = 1;           ///< 1 for kernels without trees
};

/// Appends whole lines, each flushed to the operating system: a kill -9 loses at most the line in flight.
/// Numbers are written so that they read back exactly. @throws UserError where writing fails ("the disk is
/// full ...")
class ChainCsvWriter {
 public:
  ChainCsvWriter(const std::filesystem::path& file, const ChainCsvHeader& header);
  ~ChainCsvWriter();
  ChainCsvWriter(ChainCsvWriter&&) noexcept;

  void append(const ChainCsvRow& row);
  /// The comment block between warm-up and sampling.
  void adaptation_terminated(double step_size, const std::vector<double>& inverse_metric_diagonal);
  /// The footer with times; patches num_samples to the rows written.
  void close(double warmup_seconds, double sampling_seconds);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Reads a chain file that may still be growing; each call to read_new() yields the whole lines added since.
class ChainCsvReader {
 public:
  explicit ChainCsvReader(std::filesystem::path file);
  ~ChainCsvReader();
  ChainCsvReader(ChainCsvReader&&) noexcept;

  struct Row {
    ChainCsvRow row;
    bool warmup = false;
  };
  /// @throws UserError for a file that is not a chain file (the line and why)
  std::vector<Row> read_new();
  const ChainCsvHeader& header() const;  ///< valid once a header line has been read
  bool has_header() const;
  bool closed() const;  ///< the footer has been read

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace patina
