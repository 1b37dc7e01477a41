#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "engine/io/chain_csv.h"
#include "tests/io/folder_test.h"

namespace patina {

/// Chain files for tests: two parameters and a choice; every number of a row follows from its index.
class ChainCsvFile : public FolderTest {
 protected:
  static ChainCsvHeader header(int num_warmup, int num_samples) {
    return {"patina_leather", 3, 18446744073709551615u, num_warmup, num_samples, {"light", "rough", "cells"}};
  }
  static ChainCsvRow row(int index) {
    const double x = index;
    return {-x / 7,   1 / (x + 1), 0.1 * x, index % 5 + 1, index % 3 == 0, x / 7, {x / 3, 1e-300 * x, x},
            index % 4};
  }
  std::filesystem::path path() const { return folder_ / "chain-3.csv"; }
};

inline bool same(const ChainCsvRow& a, const ChainCsvRow& b) {
  return a.lp == b.lp && a.accept_stat == b.accept_stat && a.stepsize == b.stepsize &&
         a.n_leapfrog == b.n_leapfrog && a.divergent == b.divergent && a.energy == b.energy &&
         a.values == b.values && a.treedepth == b.treedepth;
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

}  // namespace patina
