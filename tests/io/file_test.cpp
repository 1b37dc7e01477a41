#include "engine/io/file.h"

#include <stdlib.h>
#include <sys/stat.h>

#include "tests/io/file_size_limit.h"
#include "tests/io/folder_test.h"

namespace patina {
namespace {

class File : public FolderTest {
 protected:
  int entries() const {
    return static_cast<int>(std::distance(std::filesystem::directory_iterator(folder_), {}));
  }
};

TEST_F(File, WhatIsWrittenReadsBackByteForByte) {
  std::string bytes;
  for (unsigned i = 0; i < 300'000; ++i) bytes += static_cast<char>(i * 7919 >> 3);
  write_file_atomically(folder_ / "a.bin", bytes);
  EXPECT_TRUE(read_file(folder_ / "a.bin") == bytes);
  EXPECT_TRUE(slurp(folder_ / "a.bin") == bytes);
  write_file_atomically(folder_ / "a.bin", "");
  EXPECT_EQ(read_file(folder_ / "a.bin"), "");
  EXPECT_EQ(entries(), 1) << "a temporary file is left";
}

TEST_F(File, LargerThanItsLimitIsRefused) {
  const auto path = file("a.bin", std::string(1000, 'x'));
  EXPECT_EQ(read_file(path, 1000).size(), 1000u);
  EXPECT_NE(user_error([&] { read_file(path, 999); }).find("999 bytes"), std::string::npos);
  // A file whose size the system gives as 0 is measured while it is read.
  EXPECT_NE(user_error([&] { read_file("/proc/self/maps", 10); }), "");
}

TEST_F(File, ThatCannotBeWrittenIsAUserErrorAndTheOldOneStays) {
  EXPECT_NE(user_error([&] { write_file_atomically(folder_ / "no" / "a", "x"); }).find("No such file"),
            std::string::npos);
  EXPECT_NE(user_error([&] { write_file_atomically(folder_, "x"); }), "");
  const auto path = file("a", "old");
  {
    const FileSizeLimit limit(4096);
    EXPECT_NE(user_error([&] { write_file_atomically(path, std::string(5000, 'x')); }).find("disk is full"),
              std::string::npos);
  }
  EXPECT_EQ(slurp(path), "old");
  EXPECT_EQ(entries(), 1) << "a temporary file is left";
}

TEST_F(File, Sha256KnowsThePublishedAnswers) {
  // FIPS 180-2, appendix B, and the empty message.
  EXPECT_EQ(sha256_hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_hex("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256_hex(std::string(1'000'000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(DataDirectory, IsTheEnvironmentsChoiceOrBesideTheExecutable) {
  ::unsetenv("PATINA_DATA");
  const auto beside = std::filesystem::canonical("/proc/self/exe").parent_path().parent_path();
  EXPECT_EQ(data_directory(), beside / "share/patina");
  ::setenv("PATINA_DATA", "", 1);
  EXPECT_EQ(data_directory(), beside / "share/patina");
  ::setenv("PATINA_DATA", "/somewhere/else", 1);
  EXPECT_EQ(data_directory(), "/somewhere/else");
  ::unsetenv("PATINA_DATA");
}

}  // namespace
}  // namespace patina
