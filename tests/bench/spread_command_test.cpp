// lkao-bench spread, on files made by hand.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/program.h"

namespace lkao::test::spread_command_test {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kHeading = "scene,radius,samples,isa,method,ratio_best,group,threads\n";

class SpreadCommand : public ProgramTest {
 protected:
  // Two bounded cells and an unbounded one with AVX2, and rows that must not count.
  std::string write_run(const std::string& name, const std::string& commit, const std::string& first,
                        const std::string& second, const std::string& third) const {
    return write_file(name, "# processor: Abacus\n# commit: " + commit + "\n" + kHeading +
                                "wall,1,128,avx2,lkao_simd," + first + ",bounded,1\n" +
                                "wall,1,128,avx2,lkao_single,0.5,bounded,1\n" +
                                "wall,1,128,avx2,embree8_coherent,1,bounded,1\n" + "wall,2,128,avx2,lkao_simd," +
                                second + ",bounded,1\n" + "wall,inf,128,avx2,lkao_simd," + third + ",unbounded,1\n");
  }
};

TEST_F(SpreadCommand, MeansOfRunsAndWorstCell) {
  const std::string a = write_run("a.csv", "aaa", "1", "4", "3");
  const std::string b = write_run("b.csv", "aaa", "2", "4.5", "3");
  const std::string c = write_run("c.csv", "bbb", "2", "8", "3");
  const std::string out = expect_success({"spread", a, b, c}).out;
  EXPECT_THAT(out,
              ContainsRegex(R"(avx2 +1 +bounded +2 \| +2\.000 +3\.000 +4\.000 \| +2\.000 +3\.000 +4\.000 +66\.7%)"));
  EXPECT_THAT(out, HasSubstr("1.00 (run 1: wall, radius 1, 128 rays)"));
  EXPECT_THAT(out, ContainsRegex(R"(unbounded +1 \| +3\.000 +3\.000 +3\.000 \| +3\.000 +3\.000 +3\.000 +0\.0%)"));
  EXPECT_THAT(out, HasSubstr("3.00 (run 1: wall, radius inf, 128 rays)"));
  EXPECT_THAT(out, ContainsRegex(R"(all +3 \| +2\.289 +3\.000 +3\.634)"));  // cube roots of 12, 27, 48
}

TEST_F(SpreadCommand, SaysWhereRunsAreFrom) {
  const std::string a = write_run("a.csv", "aaa", "1", "4", "3");
  const std::string b = write_run("b.csv", "bbb", "1", "4", "3");
  const std::string out = expect_success({"spread", a, b}).out;
  EXPECT_THAT(out, testing::StartsWith("# processor: Abacus\n# commit: aaa\n# commit: bbb\nGeometric means"));
}

TEST_F(SpreadCommand, TakesAnyMethod) {
  const std::string a = write_run("a.csv", "aaa", "1", "4", "3");
  const std::string out = expect_success({"spread", a, "--method", "lkao_single"}).out;
  EXPECT_THAT(out, ContainsRegex(R"(bounded +1 \| +0\.500 \| +0\.500)"));
  EXPECT_THAT(out, Not(HasSubstr("unbounded")));
}

TEST_F(SpreadCommand, ReadsWhatRaysWrites) {
  expect_success({"rays", "--scenes", "sphere", "--tiles", "1", "--rounds", "1", "--samples", "64", "--radius",
                  "0.5,inf", "--isa", "sse4,avx2", "--csv", path("rays.csv")});
  const std::string out = expect_success({"spread", path("rays.csv"), path("rays.csv")}).out;
  EXPECT_THAT(out, ContainsRegex(R"(avx2 +1 all +2 \|)"));
  EXPECT_THAT(out, ContainsRegex(R"(sse4 +1 unbounded +1 \|)"));
  EXPECT_THAT(out, Not(ContainsRegex(R"([1-9]%)")));
}

TEST_F(SpreadCommand, BadInputIsOneLine) {
  const std::string good = write_run("good.csv", "aaa", "1", "4", "3");
  const std::string fewer = write_file("fewer.csv", std::string(kHeading) + "wall,1,128,avx2,lkao_simd,1,bounded,1\n");
  const std::string no_group = write_file("no_group.csv",
                                          "scene,radius,samples,isa,method,ratio_best,threads\n"
                                          "wall,1,128,avx2,lkao_simd,1,1\n");
  const std::string short_row = write_file("short.csv", std::string(kHeading) + "wall,1,128\n");
  const std::string empty = write_file("empty.csv", kHeading);
  expect_rejected({"spread"}, {"files"});
  expect_rejected({"spread", path("nowhere.csv")}, {"nowhere.csv", "cannot be read"});
  expect_rejected({"spread", good, fewer}, {"good.csv", "fewer.csv", "wall, radius 2, 128 rays"});
  expect_rejected({"spread", no_group}, {"no_group.csv", "'group'"});
  expect_rejected({"spread", short_row}, {"short.csv", "wall,1,128"});
  expect_rejected({"spread", empty}, {"empty.csv", "has no rows"});
  expect_rejected({"spread", write_run("zero.csv", "aaa", "0", "4", "3")}, {"zero.csv", "ratio_best", "'0'"});
  expect_rejected({"spread", write_run("word.csv", "aaa", "fast", "4", "3")}, {"word.csv", "'fast'"});
  expect_rejected({"spread", good, "--method", "lkao_magic"}, {"good.csv", "lkao_magic"});
}

}  // namespace
}  // namespace lkao::test::spread_command_test
