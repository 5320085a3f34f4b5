// Structs of callers with older and with newer headers, by one that has grown.
#include "c_api/versioned.h"

#include <cstddef>

#include <gtest/gtest.h>

namespace lkao::c_api {
namespace {

struct Grown {
  std::size_t size;
  int first, second;
  int third, fourth;  // came later
};

}  // namespace

template <>
inline constexpr std::size_t kFirstSize<Grown> = offsetof(Grown, third);

namespace {

constexpr Grown kDefaults{sizeof(Grown), 1, 2, 3, 4};

TEST(Versioned, OlderCallersGetDefaultsForWhatTheyDoNotKnow) {
  const Grown old{offsetof(Grown, third), 10, 20, -30, -40};
  const Grown now = read(&old, kDefaults, "old");
  EXPECT_EQ(now.size, sizeof(Grown));
  EXPECT_EQ(now.first, 10);
  EXPECT_EQ(now.second, 20);
  EXPECT_EQ(now.third, 3);
  EXPECT_EQ(now.fourth, 4);
  const Grown between{offsetof(Grown, fourth), 10, 20, 30, -40};
  EXPECT_EQ(read(&between, kDefaults, "between").third, 30);
  EXPECT_EQ(read(&between, kDefaults, "between").fourth, 4);
}

TEST(Versioned, OlderCallersAreWrittenNoMoreThanTheyHave) {
  const Grown value{sizeof(Grown), 10, 20, 30, 40};
  Grown old{offsetof(Grown, third), 1, 2, 3, 4};
  write(value, &old);
  EXPECT_EQ(old.size, offsetof(Grown, third));
  EXPECT_EQ(old.first, 10);
  EXPECT_EQ(old.second, 20);
  EXPECT_EQ(old.third, 3);
  EXPECT_EQ(old.fourth, 4);
}

TEST(Versioned, NewerCallersKeepWhatTheLibraryDoesNotKnow) {
  struct {
    Grown grown;
    int fifth;
  } newer{kDefaults, 0};
  newer.grown.size = sizeof(newer);
  write(Grown{sizeof(Grown), 10, 20, 30, 40}, &newer.grown);
  EXPECT_EQ(newer.grown.size, sizeof(newer));
  EXPECT_EQ(newer.grown.fourth, 40);
  EXPECT_EQ(newer.fifth, 0);
}

TEST(Versioned, AnOmittedStructIsTheDefaults) {
  EXPECT_EQ(read_or_defaults<Grown>(nullptr, kDefaults, "none").fourth, 4);
  EXPECT_THROW(read<Grown>(nullptr, kDefaults, "none"), Error);
}

TEST(Versioned, SizesThatAreNoneAreRefused) {
  for (const std::size_t size : {std::size_t{0}, sizeof(std::size_t), offsetof(Grown, third) - 1,
                                 sizeof(Grown) + kLargestUnknown + 1, ~std::size_t{0}}) {
    const Grown wrong{size, 1, 2, 3, 4};
    EXPECT_THROW(check_size(&wrong, "wrong"), Error) << size;
  }
}

}  // namespace
}  // namespace lkao::c_api
