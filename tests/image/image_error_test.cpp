#include <csignal>

#include <sys/resource.h>

#include <functional>
#include <random>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "image/image.h"
#include "temporary_folder.h"

namespace lkao::image {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

const Image kGrey{2, 2, {"occlusion"}, {0.5f, 0.5f, 0.5f, 0.5f}};

// The message of the error thrown; it must be one line, and nothing may be printed.
std::string error_of(const std::function<void()>& action) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  std::string message = "nothing was thrown";
  try {
    action();
  } catch (const std::runtime_error& error) {
    message = error.what();
  }
  EXPECT_THAT(testing::internal::GetCapturedStdout(), IsEmpty());
  EXPECT_THAT(testing::internal::GetCapturedStderr(), IsEmpty());
  EXPECT_THAT(message, Not(HasSubstr("\n")));
  return message;
}

std::string write_error(const std::string& path, const Image& image = kGrey) {
  return error_of([&] { write_image(path, image); });
}

std::string read_error(const std::string& path) {
  return error_of([&] { read_image(path); });
}

TEST(WriteImageError, NamesAnUnknownOrMissingEnding) {
  const TemporaryFolder folder;
  EXPECT_EQ(write_error(folder / "out.tiff"),
            "cannot write '" + (folder / "out.tiff") + "': images of type '.tiff' are not supported; use .exr or .png");
  EXPECT_THAT(write_error(folder / "out"), AllOf(HasSubstr(folder / "out"), HasSubstr("no ending")));
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(WriteImageError, NamesAFolderThatIsMissing) {
  const TemporaryFolder folder;
  EXPECT_EQ(write_error(folder / "none/out.exr"),
            "cannot write '" + (folder / "none/out.exr") + "': there is no folder '" + (folder / "none") + "'");
}

TEST(WriteImageError, NamesADirectoryAsTarget) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "out.exr");
  EXPECT_THAT(write_error(folder / "out.exr"), EndsWith("is a directory"));
  EXPECT_THAT(folder.names(), ElementsAre("out.exr"));
}

TEST(WriteImageError, NamesAFolderThatTakesNoFiles) {
  // Not even from the superuser.
  EXPECT_THAT(write_error("/proc/out.exr"), StartsWith("cannot write '/proc/out.exr': "));
}

TEST(WriteImageError, NamesWhatIsWrongWithTheImage) {
  const TemporaryFolder folder;
  const auto error = [&](const Image& image) { return write_error(folder / "out.png", image); };
  EXPECT_THAT(error({0, 2, {"Y"}, {}}), EndsWith("the image is empty"));
  EXPECT_THAT(error({2, 2, {"Y"}, {1, 2, 3}}), EndsWith("the image has 3 values instead of 4"));
  EXPECT_THAT(error({1, 1, {"Y", "Y"}, {1, 2}}), EndsWith("two channels have the same name"));
  EXPECT_THAT(error({1, 1, {"Y", ""}, {1, 2}}), EndsWith("a channel has no name"));
  EXPECT_THAT(error({1, 1, {"a", "b", "c", "d", "e"}, {1, 2, 3, 4, 5}}), HasSubstr("at most 4 channels"));
  EXPECT_THAT(folder.names(), IsEmpty());
}

// While it lives, files of this process cannot grow past a number of bytes: a disk that is full.
class FullDisk {
 public:
  explicit FullDisk(rlim_t byte_count) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{byte_count, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  void (*handler_)(int);
  rlimit before_;
};

TEST(WriteImageError, AFullDiskLeavesWhatWasThere) {
  Image noise{64, 64, {"occlusion"}, std::vector<float>(64 * 64)};
  std::mt19937 random(1);
  for (float& value : noise.pixels) value = static_cast<float>(random() % 10000) / 10000;
  for (const std::string name : {"out.exr", "out.png"}) {
    const TemporaryFolder folder;
    put(folder / name, "before");
    std::string message;
    try {
      const FullDisk full(1000);
      write_image(folder / name, noise);
    } catch (const std::runtime_error& error) {
      message = error.what();
    }
    EXPECT_EQ(message, "cannot write '" + (folder / name) + "': File too large");
    EXPECT_EQ(bytes_of(folder / name), "before");
    EXPECT_THAT(folder.names(), ElementsAre(name));
  }
}

TEST(CheckImagePath, ThrowsAsWritingWouldAndLeavesNothing) {
  const TemporaryFolder folder;
  EXPECT_EQ(error_of([&] { check_image_path(folder / "out.jpg"); }), write_error(folder / "out.jpg"));
  EXPECT_EQ(error_of([&] { check_image_path(folder / "none/out.exr"); }), write_error(folder / "none/out.exr"));
  put(folder / "old.exr", "before");
  EXPECT_NO_THROW(check_image_path(folder / "old.exr"));
  EXPECT_NO_THROW(check_image_path(folder / "new.png"));
  EXPECT_THAT(folder.names(), ElementsAre("old.exr"));
  EXPECT_EQ(bytes_of(folder / "old.exr"), "before");
}

TEST(ReadImageError, NamesAMissingFileAndADirectory) {
  const TemporaryFolder folder;
  EXPECT_EQ(read_error(folder / "none.exr"), "cannot read '" + (folder / "none.exr") + "': there is no such file");
  std::filesystem::create_directory(folder / "sub.exr");
  EXPECT_EQ(read_error(folder / "sub.exr"), "cannot read '" + (folder / "sub.exr") + "': is a directory");
}

TEST(ReadImageError, NamesAFileThatIsNoImage) {
  const TemporaryFolder folder;
  for (const std::string name : {"text.exr", "text.png", "text.txt", "text"}) {
    put(folder / name, "this is no image\n");
    EXPECT_THAT(read_error(folder / name), StartsWith("cannot read '" + (folder / name) + "': "));
    put(folder / name, "");
    EXPECT_THAT(read_error(folder / name), StartsWith("cannot read '" + (folder / name) + "': "));
  }
}

TEST(ReadImageError, NamesATruncatedFile) {
  const TemporaryFolder folder;
  Image image{61, 47, {"occlusion"}, {}};
  for (int i = 0; i < 61 * 47; ++i) image.pixels.push_back(static_cast<float>(i % 251) / 251);
  for (const std::string name : {"whole.exr", "whole.png"}) {
    write_image(folder / name, image);
    const std::string bytes = bytes_of(folder / name);
    const std::string cut = folder / ("cut." + name.substr(6));
    for (const std::size_t share : {10u, 50u, 90u}) {
      put(cut, bytes.substr(0, bytes.size() * share / 100));
      EXPECT_THAT(read_error(cut), StartsWith("cannot read '" + cut + "': ")) << share << " %";
    }
  }
}

TEST(ReadImageError, NamesADamagedPng) {
  const TemporaryFolder folder;
  write_image(folder / "whole.png", {61, 47, {"Y"}, std::vector<float>(61 * 47, 0.25f)});
  const std::string whole = bytes_of(folder / "whole.png");
  // Past the signature, each byte is guarded by a checksum or by the structure of the file.
  for (std::size_t i = 8; i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    put(folder / "damaged.png", damaged);
    EXPECT_THAT(read_error(folder / "damaged.png"), StartsWith("cannot read '")) << "byte " << i;
  }
}

}  // namespace
}  // namespace lkao::image
