#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "sph/core/error.hpp"
#include "sph/output/series.hpp"
#include "state_fixture.hpp"

namespace sph::test {
namespace {

std::string contents(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

/// A series is written by rank 0 alone; here every rank writes its own.
class SeriesTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path file() const {
    return scratch_.path() / ("series" + std::to_string(comm_.rank()) + ".csv");
  }

 private:
  decomp::Comm comm_{MPI_COMM_WORLD};
  ScratchDirectory scratch_{comm_};
};

TEST_F(SeriesTest, WritesHeaderAndShortestNumbers) {
  Series series(file(), {"y", "speed"}, {"", "m/s"});
  series.add(0, 0, {0.1, -0.0});
  series.add(10, 0.30000000000000004, {1e-300, 1.0 / 3});
  EXPECT_EQ(contents(file()),
            "step,t [s],y,speed [m/s]\n0,0,0.1,-0\n10,0.30000000000000004,1e-300,0.3333333333333333\n");
  EXPECT_EQ(series.bytes(), std::filesystem::file_size(file()));
}

TEST_F(SeriesTest, NumbersReadBackToTheSameBits) {
  Series series(file(), {"x"}, {"m"});
  std::vector<double> values;
  for (std::uint64_t k = 0; k < 1000; ++k) values.push_back(awkward(k));
  for (double value : values) series.add(1, 2, {value});
  std::istringstream in(contents(file()));
  std::string line;
  std::getline(in, line);
  for (double value : values) {
    std::getline(in, line);
    const std::string text = line.substr(line.rfind(',') + 1);
    // strtod and not stod, which takes a subnormal for an error.
    const double back = std::strtod(text.c_str(), nullptr);
    if (std::isnan(value))
      EXPECT_TRUE(std::isnan(back)) << text;
    else
      EXPECT_EQ(std::bit_cast<std::uint64_t>(back), std::bit_cast<std::uint64_t>(value)) << text;
  }
}

TEST_F(SeriesTest, EveryRowIsOnDiskWhenAddReturns) {
  Series series(file(), {"x"}, {"m"});
  series.add(1, 0.5, {2});
  EXPECT_EQ(contents(file()), "step,t [s],x [m]\n1,0.5,2\n");
}

TEST_F(SeriesTest, ResumedRunEndsWithTheSameFile) {
  std::string whole;
  std::uint64_t hash_of_whole = 0;
  {
    Series series(file(), {"x"}, {"m"});
    for (int step = 0; step < 20; ++step) series.add(step, 0.1 * step, {1.0 / (step + 1)});
    whole = contents(file());
    hash_of_whole = series.hash();
  }
  std::uint64_t at_checkpoint = 0, hash_at_checkpoint = 0;
  {
    Series series(file(), {"x"}, {"m"});
    for (int step = 0; step < 15; ++step) {
      series.add(step, 0.1 * step, {1.0 / (step + 1)});
      if (step != 11) continue;
      at_checkpoint = series.bytes();
      hash_at_checkpoint = series.hash();
    }
  }
  Series series(file(), at_checkpoint, hash_at_checkpoint);
  EXPECT_EQ(series.bytes(), at_checkpoint);
  for (int step = 12; step < 20; ++step) series.add(step, 0.1 * step, {1.0 / (step + 1)});
  EXPECT_EQ(contents(file()), whole);
  EXPECT_EQ(series.hash(), hash_of_whole);
}

TEST_F(SeriesTest, RefusesAnotherContentOfTheSameLength) {
  std::uint64_t bytes = 0, hash = 0;
  {
    Series series(file(), {"x"}, {"m"});
    series.add(1, 0.5, {2});
    series.add(2, 1.0, {3});
    bytes = series.bytes();
    hash = series.hash();
  }
  const std::string right = contents(file());
  std::string digit = right, swapped = right, merged = right;
  digit[digit.size() - 2] = '4';
  std::swap(swapped[0], swapped[1]);
  merged[merged.find('\n')] = ',';
  for (const std::string& wrong : {digit, swapped, merged, std::string(right.size(), 'x')}) {
    std::ofstream(file(), std::ios::binary) << wrong;
    EXPECT_THROW(Series(file(), bytes, hash), InputError) << wrong;
    EXPECT_EQ(contents(file()), wrong) << "it is left as it was";
    EXPECT_NO_THROW(Series(file(), bytes, {})) << "older checkpoints have no hash";
  }
  std::ofstream(file(), std::ios::binary) << right << "3,1.5,4\n";
  EXPECT_EQ(Series(file(), bytes, hash).hash(), hash);
  EXPECT_EQ(contents(file()), right);
}

TEST_F(SeriesTest, RefusesAFileThatIsMissingOrTooShort) {
  EXPECT_THROW(Series(file(), 10, {}), InputError);
  { const Series series(file(), {"x"}, {"m"}); }
  EXPECT_THROW(Series(file(), 18, {}), InputError);
  EXPECT_NO_THROW(Series(file(), 17, {}));
}

TEST_F(SeriesTest, SaysWhyItCannotWrite) {
  try {
    const Series series(file() / "below", {"x"}, {"m"});
    FAIL() << "no error";
  } catch (const OutputError& error) {
    EXPECT_NE(std::string(error.what()).find("No such file or directory"), std::string::npos) << error.what();
  }
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP();
  try {
    const Series series("/dev/full", {"x"}, {"m"});
    FAIL() << "no error";
  } catch (const OutputError& error) {
    EXPECT_NE(std::string(error.what()).find("No space left on device"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace sph::test
