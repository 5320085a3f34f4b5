// lkao-bench bake, on small scenes.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/program.h"

namespace lkao::test::bake_command_test {
namespace {

class BakeCommand : public ProgramTest {};

TEST_F(BakeCommand, MeasuresEveryKindOfValue) {
  expect_success({"bake", "builtin:wall", "--rays", "64", "--smoothness", "0.5", "--csv", path("bake.csv")});
  const std::string csv = read_file("bake.csv");
  EXPECT_THAT(csv, testing::HasSubstr("\nscene,triangles,vertices,radius,values,per,smoothness,rays,seconds,rmse,mae,"
                                      "bias\nwall,"));
  for (const char* row : {",on-vertex,vertex,,", ",corners,vertex,,", ",corners,corner,,", ",least-squares,vertex,0.5,",
                          ",least-squares,corner,0.5,"}) {
    EXPECT_THAT(csv, testing::HasSubstr(row));
  }
}

TEST_F(BakeCommand, BadInputIsOneLine) {
  expect_rejected({"bake", "builtin:cornell"}, {"cornell"});
  expect_rejected({"bake", "builtin:wall", "--rays", "1025"}, {"--rays"});
}

}  // namespace
}  // namespace lkao::test::bake_command_test
