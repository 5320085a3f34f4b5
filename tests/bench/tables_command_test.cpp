// lkao-bench tables, on pictures so small that its speeds mean nothing.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/program.h"

namespace lkao::test::tables_command_test {
namespace {

class TablesCommand : public ProgramTest {};

TEST_F(TablesCommand, ExactTablesAreExactAndEveryCaseIsWritten) {
  const std::string out =
      expect_success({"tables", "--scenes", "wall", "--resolutions", "32", "--rays", "64", "--width", "16", "--height",
                      "12", "--planes", "100", "--csv", path("tables.csv")})
          .out;
  EXPECT_THAT(out, testing::HasSubstr("no ray differs from the exact kernel"));
  const std::string csv = read_file("tables.csv");
  EXPECT_THAT(csv, testing::StartsWith("# processor: "));
  EXPECT_THAT(csv, testing::HasSubstr("\nscene,radius,receivers,rays,resolution,addressing,masks,node_masks,"));
  int row_count = 0;
  for (std::size_t at = csv.find("\nwall,"); at != std::string::npos; at = csv.find("\nwall,", at + 1)) ++row_count;
  EXPECT_EQ(row_count, 2 * 2 * 2 * 2);  // radii, addressings, masks, node masks
  EXPECT_THAT(csv, testing::ContainsRegex("64,32,slices,exact,outline,"));
}

TEST_F(TablesCommand, BadInputIsOneLine) {
  expect_rejected({"tables", "--scenes", "cornell"}, {"cornell"});
  expect_rejected({"tables", "--masks", "some"}, {"--masks", "some"});
  expect_rejected({"tables", "--addressings", "cube,ball"}, {"--addressings", "ball"});
}

}  // namespace
}  // namespace lkao::test::tables_command_test
