// The query against an exact oracle where arithmetic is hardest.
#include <ostream>

#include <gtest/gtest.h>

#include "check.h"

namespace lkao::tests {

// The tests' names must not hold addresses.
void PrintTo(const NamedCase& tested, std::ostream* out) { *out << tested.name; }

namespace {

class AwkwardTriangles : public testing::TestWithParam<NamedCase> {};
class AwkwardPlaces : public testing::TestWithParam<NamedCase> {};

TEST_P(AwkwardTriangles, AreAnsweredExactly) { check(GetParam().name, GetParam().make()); }
TEST_P(AwkwardPlaces, AreAnsweredExactly) { check(GetParam().name, GetParam().make()); }

std::string name_of(const testing::TestParamInfo<NamedCase>& tested) { return tested.param.name; }

INSTANTIATE_TEST_SUITE_P(HardCases, AwkwardTriangles, testing::ValuesIn(triangle_cases()), name_of);
INSTANTIATE_TEST_SUITE_P(HardCases, AwkwardPlaces, testing::ValuesIn(space_cases()), name_of);

}  // namespace
}  // namespace lkao::tests
