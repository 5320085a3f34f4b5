// Files of parts: the answers to a share of a run's receivers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "lkao/ambient_occlusion.h"
#include "scene/mesh.h"

namespace lkao::cli {

// Part `number`, from 1, of `count`. Of every batch of receivers it has the share [first_of, first_of of the next one).
struct Part {
  int number = 1;
  int count = 1;

  std::size_t first_of(std::size_t receiver_count) const;
  std::size_t end_of(std::size_t receiver_count) const;
};

// What a file of a part says of itself: one line of JSON at its start.
struct PartHeader {
  Part part;
  std::vector<std::string> arguments;  // of the run: its subcommand first, without --part and what tells how to run
};

// The answers to a share of a batch. `scene` and `receivers` are fingerprints of what was asked about.
struct PartAnswers {
  std::uint64_t scene = 0;
  std::uint64_t receivers = 0;  // of the whole batch
  QueryReport report;           // of the share
  std::vector<float> occlusion;
  std::vector<glm::vec3> bent_normals;  // as many, or none
};

std::uint64_t fingerprint_of(const scene::Mesh& mesh);
std::uint64_t fingerprint_of(std::span<const Receiver> receivers);

class PartWriter {
 public:
  // Throws std::runtime_error with one line where `path` cannot be written to.
  PartWriter(std::string path, const PartHeader& header);

  const Part& part() const { return part_; }
  void write(const PartAnswers& answers);
  // Throws std::runtime_error where not everything could be written.
  void close();

 private:
  std::string path_;
  Part part_;
  std::ofstream file_;
};

class PartReader {
 public:
  // Throws std::runtime_error with one line naming the file where it is none of this program's parts.
  explicit PartReader(std::string path);

  const std::string& path() const { return path_; }
  const PartHeader& header() const { return header_; }
  // The next answers, to a share of so many receivers. Throws std::runtime_error where there are no such.
  PartAnswers read(std::size_t count);
  // Throws std::runtime_error, naming the file.
  [[noreturn]] void fail(const std::string& fault) const;

 private:
  std::string path_;
  std::ifstream file_;
  PartHeader header_;
};

}  // namespace lkao::cli
