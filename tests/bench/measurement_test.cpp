#include "bench/measurement.h"

#include <optional>
#include <stdexcept>

#include <gtest/gtest.h>

namespace lkao::bench {
namespace {

const Columns kColumns = {{"scene", "{}", -6}, kBar, {"seconds", "{:.2f}", 8, "time"}, {"rays", "{}", 5}};
const Columns kCsvColumns = {{"scene"}, {"rays"}, {"seconds", "{:.3g}"}};

TEST(Measurement, IsACsvRowAndATableRow) {
  const Measurement measurement = {{"scene", "wall"}, {"rays", 128}, {"seconds", 1.2345}};
  EXPECT_EQ(csv_heading(kCsvColumns), "scene,rays,seconds\n");
  EXPECT_EQ(csv_row(kCsvColumns, measurement), "wall,128,1.23\n");
  EXPECT_EQ(table_heading(kColumns), "scene  |     time  rays\n");
  EXPECT_EQ(table_row(kColumns, measurement), "wall   |     1.23   128\n");
}

TEST(Measurement, SaysWhatIsNotKnown) {
  const Measurement measurement = {{"scene", "wall"}, {"rays", std::optional<int>()}, {"seconds", Value()}};
  EXPECT_EQ(csv_row(kCsvColumns, measurement), "wall,,\n");
  EXPECT_EQ(table_row(kColumns, measurement), "wall   |        -     -\n");
}

TEST(Measurement, NeedsAValueForEveryColumn) {
  EXPECT_THROW(csv_row(kCsvColumns, {{"scene", "wall"}}), std::logic_error);
}

}  // namespace
}  // namespace lkao::bench
