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

/// How far a chain file has been written: with it, and the bytes themselves, another writer can go on.
struct ChainCsvPlace {
  std::int64_t bytes = 0;              ///< without a footer
  std::int64_t rows_after_warmup = 0;  ///< to be counted in num_samples
  bool adapted = false;                ///< the comment block after warm-up is there
  bool operator==(const ChainCsvPlace&) const = default;
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
  /// Goes on with a file, of the same header but for num_samples, where another writer was at `place`: what
  /// lies behind is cut off, num_samples becomes what is asked for now. @throws UserError for a file that is
  /// shorter or begins with another header
  ChainCsvWriter(const std::filesystem::path& file, const ChainCsvHeader& header, const ChainCsvPlace& place);
  ~ChainCsvWriter();
  ChainCsvWriter(ChainCsvWriter&&) noexcept;

  void append(const ChainCsvRow& row);
  /// The comment block between warm-up and sampling.
  void adaptation_terminated(double step_size, const std::vector<double>& inverse_metric_diagonal);
  /// The footer, an empty comment; patches num_samples to the rows written. It has no times, so that the same
  /// draws are the same bytes.
  void close();

  ChainCsvPlace place() const;  ///< not to be asked after close()

  /// Waits until all of it is on the disk. @throws UserError
  void sync();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Reads a chain file that may still be growing; each call to read_new() yields the whole lines added since,
/// or so many of them that the rest can wait for the next call.
class ChainCsvReader {
 public:
  explicit ChainCsvReader(std::filesystem::path file);
  ~ChainCsvReader();
  ChainCsvReader(ChainCsvReader&&) noexcept;

  struct Row {
    ChainCsvRow row;
    bool warmup = false;
  };
  /// @param enough  rows after which it stops, or a few hundred later
  /// @throws UserError for a file that is not a chain file (the line and why)
  std::vector<Row> read_new(std::size_t enough = std::numeric_limits<std::size_t>::max());
  std::int64_t bytes_read() const;
  const ChainCsvHeader& header() const;  ///< valid once a header line has been read
  bool has_header() const;
  bool closed() const;  ///< it ends with a footer, for now: a writer that goes on takes the footer away

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace patina
