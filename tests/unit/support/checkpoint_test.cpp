#include "littoral/support/checkpoint.hpp"

#include <cstring>
#include <limits>

#include "support_test.hpp"

namespace littoral::support {
namespace {

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

std::vector<double> awkward_doubles() {
  using limits = std::numeric_limits<double>;
  double payload_nan = 0.0;
  const std::uint64_t bits = 0x7ff8000000abcdefULL;
  std::memcpy(&payload_nan, &bits, sizeof bits);
  return {0.0,           -0.0,          1.0 / 3.0,    limits::denorm_min(), -limits::denorm_min(),
          limits::max(), limits::min(), -payload_nan, limits::infinity(),   -limits::infinity(),
          payload_nan};
}

TEST(CheckpointTest, ReadsBackBitForBit) {
  const TemporaryFolder folder;
  const std::string path = folder / "sub/a.h5";
  const std::vector<std::int64_t> wide = {std::numeric_limits<std::int64_t>::min(), -1, 0,
                                          std::numeric_limits<std::int64_t>::max()};
  const std::vector<std::int32_t> narrow = {std::numeric_limits<std::int32_t>::min(), 7};
  const std::vector<std::uint8_t> bytes = {0, 1, 255};
  const std::string text("line\n\0 and \xc3\xa9", 12);
  CheckpointWriter writer(path);
  writer.put("particles/x", awkward_doubles());
  writer.put("particles/none", std::vector<double>{});
  writer.put("wide", wide);
  writer.put("narrow", narrow);
  writer.put("flags", bytes);
  writer.put("time", 0.1);
  writer.put("window", std::int64_t{1} << 53);
  writer.put("text", text);
  writer.put("empty text", std::string());
  writer.commit();

  const CheckpointReader reader(path);
  EXPECT_TRUE(same_bits(reader.doubles("particles/x"), awkward_doubles()));
  EXPECT_TRUE(reader.doubles("particles/none").empty());
  EXPECT_EQ(reader.int64s("wide"), wide);
  EXPECT_EQ(reader.int32s("narrow"), narrow);
  EXPECT_EQ(reader.bytes("flags"), bytes);
  EXPECT_EQ(reader.number("time"), 0.1);
  EXPECT_EQ(reader.integer("window"), std::int64_t{1} << 53);
  EXPECT_EQ(reader.text("text"), text);
  EXPECT_EQ(reader.text("empty text"), "");
  EXPECT_TRUE(reader.has("particles/x"));
  EXPECT_TRUE(reader.has("particles"));
  EXPECT_FALSE(reader.has("particles/y"));
  EXPECT_FALSE(reader.has("no/such/group"));
}

TEST(CheckpointTest, LargerThanAnyBuffer) {
  const TemporaryFolder folder;
  std::vector<double> values(1000003);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = 1.0 / static_cast<double>(i + 1);
  CheckpointWriter writer(folder / "a.h5");
  writer.put("x", values);
  writer.put("y", values);
  writer.commit();
  const CheckpointReader reader(folder / "a.h5");
  EXPECT_TRUE(same_bits(reader.doubles("x"), values));
  EXPECT_TRUE(same_bits(reader.doubles("y"), values));
}

// HDF5 grows an image by a megabyte at a time; a file holds what it uses, and can be read.
TEST(CheckpointTest, SmallFieldsMakeASmallFile) {
  const TemporaryFolder folder;
  CheckpointWriter writer(folder / "a.h5");
  writer.put("x", awkward_doubles());
  writer.commit();
  EXPECT_LT(std::filesystem::file_size(folder / "a.h5"), 16384U);
  EXPECT_TRUE(same_bits(CheckpointReader(folder / "a.h5").doubles("x"), awkward_doubles()));
}

TEST(CheckpointTest, NothingUnderTheFinalNameBeforeCommit) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.h5";
  {
    CheckpointWriter writer(path);
    writer.put("x", 1.0);
    writer.commit();
  }
  const std::string good = content(path);
  {
    CheckpointWriter writer(path);
    writer.put("x", 2.0);
  }
  EXPECT_EQ(content(path), good);
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));
}

TEST(CheckpointTest, DiskFullLeavesTheOldOne) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.h5";
  write_text(path, "old");
  std::filesystem::create_symlink("/dev/full", path + ".part");
  CheckpointWriter writer(path);
  writer.put("x", std::vector<double>(100000, 1.0));
  EXPECT_EQ(message_of<IoError>([&] { writer.commit(); }),
            path + ".part: cannot write: No space left on device.");
  EXPECT_EQ(content(path), "old");
}

TEST(CheckpointTest, UnwritablePathIsFoundAtOnce) {
  const TemporaryFolder folder;
  write_text(folder / "file", "x");
  EXPECT_CONTAINS(message_of<IoError>([&] { CheckpointWriter(folder / "file/a.h5"); }),
                  "cannot make the folder");
}

TEST(CheckpointTest, DatasetGivenTwice) {
  const TemporaryFolder folder;
  CheckpointWriter writer(folder / "a.h5");
  writer.put("x", 1.0);
  EXPECT_CONTAINS(message_of<IoError>([&] { writer.put("x", 2.0); }), "cannot write dataset 'x'");
}

TEST(CheckpointTest, WrongFilesAreNamed) {
  const TemporaryFolder folder;
  const auto refusal = [](const std::string& path) {
    return message_of<IoError>([&] { CheckpointReader reader(path); });
  };
  EXPECT_CONTAINS(refusal(folder / "none.h5"), "none.h5: cannot open: No such file.");
  EXPECT_CONTAINS(refusal(folder / ""), "is a folder; expected a checkpoint");
  write_text(folder / "text.h5", "no HDF5 at all");
  EXPECT_CONTAINS(refusal(folder / "text.h5"), "is no checkpoint (not an HDF5 file)");
  write_text(folder / "empty.h5", "");
  EXPECT_CONTAINS(refusal(folder / "empty.h5"), "is no checkpoint");
  {
    CheckpointWriter writer(folder / "cut.h5");
    writer.put("x", std::vector<double>(10000, 1.0));
    writer.commit();
  }
  std::filesystem::resize_file(folder / "cut.h5", 20000);
  EXPECT_CONTAINS(refusal(folder / "cut.h5"), "cut.h5: cannot open: truncated file");
}

TEST(CheckpointTest, WrongDatasetsAreNamed) {
  const TemporaryFolder folder;
  CheckpointWriter writer(folder / "a.h5");
  writer.put("x", std::vector<double>{1, 2});
  writer.put("n", std::int64_t{3});
  writer.put("s", std::string("text"));
  writer.commit();
  const CheckpointReader reader(folder / "a.h5");
  EXPECT_CONTAINS(message_of<IoError>([&] { reader.doubles("y"); }), "a.h5: dataset 'y' is missing");
  EXPECT_CONTAINS(message_of<IoError>([&] { reader.int64s("x"); }),
                  "'x' has another type; expected an array of 64-bit");
  EXPECT_CONTAINS(message_of<IoError>([&] { reader.number("x"); }),
                  "'x' has another type; expected one double");
  EXPECT_CONTAINS(message_of<IoError>([&] { reader.int64s("n"); }),
                  "'n' has another type; expected an array");
  EXPECT_CONTAINS(message_of<IoError>([&] { reader.number("s"); }), "'s' has another type");
  EXPECT_CONTAINS(message_of<IoError>([&] { reader.text("n"); }), "'n' has another type; expected a text");
}

TEST(CheckpointTest, Hdf5ItselfStaysSilent) {
  ::testing::internal::CaptureStderr();
  EXPECT_THROW(CheckpointReader("none.h5"), IoError);
  const TemporaryFolder folder;
  CheckpointWriter writer(folder / "a.h5");
  writer.put("x", 1.0);
  EXPECT_THROW(writer.put("x", 1.0), IoError);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace littoral::support
