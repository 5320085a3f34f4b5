// lkao-bench patterns, with so few receivers and rays that its errors mean nothing.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/program.h"

namespace lkao::test::patterns_command_test {
namespace {

class PatternsCommand : public ProgramTest {};

TEST_F(PatternsCommand, MeasuresEveryKindWithEveryFalloff) {
  const ProgramResult result = run_program({"patterns", "--scenes", "sphere", "--receivers", "8", "--reference-rays",
                                            "64", "--seeds", "1", "--csv", path("patterns.csv")});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, testing::HasSubstr("| fibonacci |"));
  const std::string csv = read_file("patterns.csv");
  EXPECT_THAT(csv, testing::StartsWith("# processor: "));
  EXPECT_THAT(csv, testing::HasSubstr("\nscene,pattern,falloff,rays,rotation,tilt,rmse,bias,neighbour_correlation,"
                                      "independent_rmse\n"));
  EXPECT_THAT(csv, testing::HasSubstr("\nsphere,paper,constant,1024,1,0,"));
  EXPECT_THAT(csv, testing::HasSubstr("\nsphere,lloyd,steps,128,0.125,0.05,"));
}

TEST_F(PatternsCommand, BadInputIsOneLine) {
  expect_rejected({"patterns", "--scenes", "cornell"}, {"cornell"});
  expect_rejected({"patterns", "--seeds", "0"}, {"--seeds"});
  expect_rejected({"patterns", "--image", path("a.png"), "--image-scene", "cornell"}, {"cornell"});
}

}  // namespace
}  // namespace lkao::test::patterns_command_test
