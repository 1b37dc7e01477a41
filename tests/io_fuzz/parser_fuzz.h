#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <random>
#include <string>

#include "engine/error.h"
#include "tests/io/folder_test.h"
#include "tests/io/images.h"

// Random changes of good files, under the address and undefined-behaviour sanitizers: every parser must take
// them or throw UserError, and do nothing else. --gtest_random_seed=N tries other changes.
namespace patina {

/// A source of changed copies of a file's bytes.
class Mutator {
 public:
  explicit Mutator(unsigned salt)
      : generator_(static_cast<unsigned>(GTEST_FLAG_GET(random_seed)) * 977 + salt) {}

  std::string changed(std::string bytes) {
    for (std::size_t changes = 1 + below(2) * below(4); changes > 0 && !bytes.empty(); --changes)
      change(bytes);
    return bytes;
  }
  std::size_t below(std::size_t limit) { return generator_() % limit; }

 private:
  void change(std::string& bytes) {
    // Headers are short and decide most: half of all changes fall into the first bytes.
    const std::size_t at = below(below(2) ? bytes.size() : std::min<std::size_t>(bytes.size(), 128));
    const std::size_t length = std::min(below(40), bytes.size() - at);
    switch (below(9)) {  // mostly in place: a shift of everything behind is what parsers refuse at once
      case 0:
      case 4:
      case 5:
        bytes[at] = static_cast<char>(generator_());
        break;
      case 1:
      case 6:
        bytes[at] = "\xFF\x7F\x80\x01\n,#-\"{"[below(10)];
        break;
      case 2:
        bytes.resize(at);
        break;
      case 3:
        bytes.erase(at, length);
        break;
      case 7:
        bytes.insert(below(bytes.size()), bytes.substr(at, length));
        break;
      default:
        std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), std::min<std::size_t>(length, 4),
                    below(2) ? '\xFF' : '\0');
    }
  }
  std::mt19937 generator_;
};

class ParserFuzz : public FolderTest {
 protected:
  /// Feeds changed copies of good bytes to a parser, which must take some and refuse some: a fuzz that stops
  /// at the front door tries nothing.
  template <typename Parse>
  void fuzz(const std::string& good, int rounds, unsigned salt, Parse&& parse) {
    ASSERT_NO_THROW(parse(file("good", good)));
    Mutator mutator(salt);
    int taken = 0;
    for (int round = 0; round < rounds; ++round) {
      const auto path = file("changed", with_png_checksums(mutator.changed(good)));
      try {
        parse(path);
        ++taken;
      } catch (const UserError& error) {
        ASSERT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos);
      }
    }
    EXPECT_GT(taken, rounds / 100) << "the changes are too wild";
    EXPECT_LT(taken, rounds - rounds / 100) << "the changes are too tame";
    std::cout << taken << " of " << rounds << " changed files were taken\n";
  }
};

}  // namespace patina
