// Runs in parts, and lkao merge: the parts together are the whole, bit for bit.
#include <fmt/format.h>

#include "cli/program.h"
#include "cli/small_mesh.h"

namespace lkao::test {
namespace {

class Parts : public ProgramTest {
 protected:
  // Rendering 96 x 64 pixels at 1024 rays takes several batches.
  Arguments render(const Arguments& more = {}) const {
    Arguments arguments = {"render",        "builtin:wall",  "-o",
                           path("out.exr"), "--radius",      "2",
                           "--size",        "96x64",         "--samples",
                           "1024",          "--seed",        "7",
                           "--falloff",     "linear",        "--eye=-1,1.5,-2",
                           "--quiet",       "--bent-normals"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  Arguments bake(const Arguments& more = {}) const {
    Arguments arguments = {"bake", path("square.ply"), "-o", path("out.ply"), "--radius", "5", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  std::string part(const std::string& output, int number, int count) const {
    return path(fmt::format("{}.{}of{}.part", output, number, count));
  }
  // Makes all parts, out of order, and `output` of them.
  void run_in_parts(const Arguments& run, const std::string& output, int count) const {
    Arguments merge = {"merge", "--quiet"};
    for (int k = 0; k < count; ++k) {
      const int number = (k + count / 2) % count + 1;
      Arguments arguments = run;
      arguments.insert(arguments.end(), {"--part", fmt::format("{}/{}", number, count)});
      expect_success(arguments);
      merge.push_back(part(output, number, count));
    }
    expect_success(merge);
  }
};

TEST_F(Parts, OfARenderingAreTheWhole) {
  expect_success(render());
  const std::string whole = read_file("out.exr");
  for (const int count : {1, 2, 7}) {
    std::filesystem::remove(path("out.exr"));
    run_in_parts(render(), "out.exr", count);
    EXPECT_TRUE(read_file("out.exr") == whole) << count << " parts";
  }
}

TEST_F(Parts, OfABakeAreTheWhole) {
  write_file("square.ply", roofed_square_ply());
  for (const Arguments& options :
       {Arguments{}, Arguments{"--per", "face"}, Arguments{"--filter", "least-squares", "--per", "corner"}}) {
    expect_success(bake(options));
    const std::string whole = read_file("out.ply");
    std::filesystem::remove(path("out.ply"));
    run_in_parts(bake(options), "out.ply", 3);
    EXPECT_TRUE(read_file("out.ply") == whole);
  }
}

TEST_F(Parts, MorePartsThanReceivers) {
  write_file("square.ply", roofed_square_ply());
  expect_success(bake());
  const std::string whole = read_file("out.ply");
  run_in_parts(bake(), "out.ply", 10);  // of 9 corners
  EXPECT_TRUE(read_file("out.ply") == whole);
}

TEST_F(Parts, APartWritesNothingElse) {
  expect_success(render({"--preview", path("out.png"), "--part", "2/3", "--json", path("out.json")}));
  EXPECT_EQ(files(), (std::vector<std::string>{"out.exr.2of3.part", "out.json"}));
  EXPECT_EQ(read_json("out.json")["part"], 2);
  EXPECT_EQ(read_json("out.json")["output"], part("out.exr", 2, 3));
  EXPECT_GT(read_json("out.json")["rays"], 0);
}

TEST_F(Parts, AMergeMayHaveAnotherOutput) {
  expect_success(render({"--part", "1/1", "--threads", "1"}));
  expect_success({"merge", part("out.exr", 1, 1), "-o", path("other.exr"), "--json", path("out.json"), "--quiet"});
  EXPECT_EQ(files(), (std::vector<std::string>{"other.exr", "out.exr.1of1.part", "out.json"}));
  EXPECT_EQ(read_json("out.json")["width"], 96);
  expect_rejected({"merge", part("out.exr", 1, 1), "-o", part("out.exr", 1, 1)}, {"out.exr.1of1.part"});
}

TEST_F(Parts, OfOtherRunsAreRefused) {
  expect_success(render({"--part", "1/2"}));
  expect_success(render({"--part", "2/3"}));
  expect_rejected({"merge", part("out.exr", 1, 2)}, {"part 2 of 2 is missing"});
  expect_rejected({"merge", part("out.exr", 1, 2), part("out.exr", 1, 2)}, {"same part"});
  expect_rejected({"merge", part("out.exr", 1, 2), part("out.exr", 2, 3)}, {"different runs"});
  expect_rejected({"merge", path("nothing.part")}, {"nothing.part"});
  expect_rejected({"merge"}, {"part"});
  for (const char* bytes : {"", "{}\n", "a file of another kind", "{\"format\": \"lkao part\"}\n", "[1, 2]\n"}) {
    expect_rejected({"merge", write_file("bad.part", bytes)}, {"bad.part", "it is no part"});
  }
}

TEST_F(Parts, CutOffFilesAreRefused) {
  expect_success(render({"--part", "1/1"}));
  const std::string whole = read_file("out.exr.1of1.part");
  const std::size_t header = whole.find('\n') + 1;
  for (const std::size_t size : {header, header + 8, header + 72, header + 1000, whole.size() - 1}) {
    expect_rejected({"merge", write_file("cut.part", whole.substr(0, size))}, {"cut.part", "cut off"});
  }
}

TEST_F(Parts, OfASceneThatHasChangedAreRefused) {
  write_file("square.ply", roofed_square_ply());
  expect_success(bake({"--part", "1/1"}));
  std::string other = roofed_square_ply();
  other[other.find("end_header") + 13] ^= 1;  // in the lowest bits of a coordinate
  write_file("square.ply", other);
  expect_rejected({"merge", part("out.ply", 1, 1)}, {"out.ply.1of1.part", "changed"});
}

TEST_F(Parts, BadNumbersAreRefused) {
  for (const char* text : {"", "1", "0/2", "3/2", "1/0", "-1/2", "1/70000", "a/b", "1/2/3"}) {
    expect_rejected(render({"--part", text}), {"--part"});
  }
  expect_rejected(render({"--part", "1/2", "--reference"}), {"--part", "--reference"});
}

}  // namespace
}  // namespace lkao::test
