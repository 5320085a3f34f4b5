// The deferred renderer: every kind of G-buffer is right at lkao's defaults.
#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/program.h"

namespace lkao::test {
namespace {

class Deferred : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    // llvmpipe draws in the calling thread: LeakSanitizer cannot stop its own ones at the end of the process.
    setenv("LP_NUM_THREADS", "0", 0);
  }
};

struct Row {
  std::string kind, offset;
  double off_share = 1, mean_error = 1;
};

// Of the file that begins with lines of '#' and the names of its columns.
std::vector<Row> rows_of(const std::string& csv) {
  std::vector<Row> rows;
  std::size_t begin = csv.find("mean_error\n") + 11;
  for (std::size_t end = 0; (end = csv.find('\n', begin)) != std::string::npos; begin = end + 1) {
    std::vector<std::string> cells;
    for (std::size_t first = begin, last = 0; first <= end; first = last + 1) {
      last = std::min(csv.find(',', first), end);
      cells.push_back(csv.substr(first, last - first));
    }
    rows.push_back({cells.at(0), cells.at(1), std::stod(cells.at(3)), std::stod(cells.at(4))});
  }
  return rows;
}

TEST_F(Deferred, EveryKindOfGBufferIsRightAtDefaults) {
  const ProgramResult result = run_program(
      {"builtin:box", "--radius", "1", "--width", "96", "--height", "72", "--rays", "64", "--csv", path("kinds.csv")});
  if (result.err.find("EGL offers no") != std::string::npos) GTEST_SKIP() << result.err;
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::vector<Row> rows = rows_of(read_file("kinds.csv"));
  EXPECT_EQ(rows.size(), 34u);
  for (const Row& row : rows) {
    if (row.offset == "automatic") {
      const bool is_whole = row.kind != "half resolution";
      EXPECT_LT(row.off_share, is_whole ? 1e-3 : 0.01) << row.kind;
      // Normals of another last bit turn the pattern: other rays. At half resolution pixels are mixed of others.
      EXPECT_LT(row.mean_error, (is_whole ? 2.5 : 5) / 255) << row.kind;
    } else if (row.kind == "depth of 24 bits") {
      EXPECT_GT(row.off_share, 0.2) << "the offset of the query would do, and the comparison shows nothing";
    }
  }
  EXPECT_THAT(result.out, testing::HasSubstr("positions in the world: positions"));
}

TEST_F(Deferred, BadInputIsOneLine) {
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"builtin:cornell"}, {"model.ply"}, {"--csv", path("no/such/file")}}) {
    const ProgramResult result = run_program(arguments);
    EXPECT_NE(result.exit_code, 0);
    EXPECT_THAT(result.err, testing::StartsWith("deferred: "));
  }
}

}  // namespace
}  // namespace lkao::test
