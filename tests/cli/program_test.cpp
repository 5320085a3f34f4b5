// The program as a whole: help, and what an interruption leaves behind.
#include "cli/program.h"

#include <chrono>
#include <csignal>
#include <thread>

#include <gmock/gmock.h>

#include "lkao/isa.h"
#include "lkao/version.h"

namespace lkao::test {
namespace {

class Program : public ProgramTest {
 protected:
  // Starts a rendering that takes minutes, and sends it a signal once it has claimed its outputs.
  int interrupt(int signal, std::chrono::milliseconds delay) const {
    RunningProgram program({"render", "builtin:wall", "--size", "4096x4096", "--samples", "1024", "--radius", "10",
                            "-o", path("out.exr"), "--preview", path("out.png"), "--json", path("out.json"),
                            "--quiet"});
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (files().size() < 3 && std::chrono::steady_clock::now() < give_up) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    EXPECT_EQ(files().size(), 3u) << "no output was claimed";
    std::this_thread::sleep_for(delay);
    program.send(signal);
    return program.wait();
  }
};

// The other tests run what it does in their own process.
TEST_F(Program, IsAProcessOfItsOwn) {
  const auto expect_same = [&](Arguments arguments, const Arguments& more, const std::string& output) {
    SCOPED_TRACE(testing::PrintToString(arguments));
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(expect_same_as_process(arguments, output), 0);
  };
  const Arguments render = {"render", "builtin:wall", "--size", "32x24", "-o", path("out.exr")};
  const Arguments bake = {"bake", "builtin:wall", "-o", path("out.ply")};
  const Arguments rays = {"--radius", "1", "--samples", "64", "--quiet"};
  expect_same(render, rays, "out.exr");
  expect_same(bake, rays, "out.ply");
  expect_same({"simplify", path("out.ply"), "-o", path("chain.json")}, {"--radius", "1", "--quiet"}, "chain.1.ply");
  expect_same({"compare", path("out.exr"), path("out.exr")}, {"--json", path("out.json")}, "out.json");
  expect_same({"info", path("out.ply")}, {}, "");
  expect_same({"--version"}, {}, "");
  for (const char* part : {"1/2", "2/2"}) {
    Arguments arguments = bake;
    arguments.insert(arguments.end(), {"--part", part});
    expect_same(arguments, rays, std::string("out.ply.") + part[0] + "of2.part");
  }
  expect_same({"merge", path("out.ply.1of2.part"), path("out.ply.2of2.part"), "--quiet"}, {}, "out.ply");

  EXPECT_EQ(expect_same_as_process({"info", path("nowhere.ply")}), 2);
  EXPECT_EQ(expect_same_as_process({"render", "builtin:wall"}), 2);
}

TEST_F(Program, HelpNamesTheSubcommands) {
  const std::string help = expect_success({"--help"}).out;
  for (const char* name : {"render", "bake", "compare", "info", "simplify"})
    EXPECT_NE(help.find(name), std::string::npos) << name;
  EXPECT_EQ(expect_success({}).out, help);
}

TEST_F(Program, EverySubcommandHasHelp) {
  for (const char* name : {"render", "bake", "compare", "info", "simplify"}) {
    const std::string help = expect_success({name, "--help"}).out;
    for (const char* option : {"--threads", "--json"}) EXPECT_NE(help.find(option), std::string::npos) << name;
  }
}

TEST_F(Program, VersionIsPrinted) {
  const std::string report = expect_success({"--version"}).out;
  EXPECT_THAT(report, testing::StartsWith(std::string("lkao ") + version() + "\n"));
  EXPECT_THAT(report, testing::ContainsRegex("Embree [34]\\.[0-9]+\\.[0-9]+"));
  for (const std::string& isa : available_isas()) EXPECT_THAT(report, testing::HasSubstr(isa));
}

TEST_F(Program, AFullDiskUnderStdoutIsAnError) {
  const ProgramResult result = run_program({"info", "--json", "/dev/full"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("/dev/full"), std::string::npos) << result.err;
}

TEST_F(Program, InterruptionLeavesNoFileBehind) {
  EXPECT_EQ(interrupt(SIGINT, std::chrono::milliseconds(0)), 130);
  EXPECT_EQ(files(), std::vector<std::string>{});
  EXPECT_EQ(interrupt(SIGINT, std::chrono::milliseconds(500)), 130);
  EXPECT_EQ(files(), std::vector<std::string>{});
  EXPECT_EQ(interrupt(SIGTERM, std::chrono::milliseconds(100)), 143);
  EXPECT_EQ(files(), std::vector<std::string>{});
}

}  // namespace
}  // namespace lkao::test
