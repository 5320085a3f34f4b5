// The bytes of a file.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace lkao::scene {

// Memory that nobody fills with zeros first: half of the time to read a large file would go into that.
struct FileBytes {
  std::unique_ptr<char[]> data;
  std::size_t size = 0;

  std::string_view view() const { return {data.get(), size}; }
};

// Throws std::runtime_error with the fault alone: missing, a directory, unreadable.
FileBytes read_file(const std::string& path);
// Throws also for what is there but no file: a device may have no end.
FileBytes read_regular_file(const std::string& path);

}  // namespace lkao::scene
