#include "cli/part_method.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace lkao::cli {
namespace {

using method::Answered, method::Method, method::Task;

class PartRecorder final : public Method {
 public:
  PartRecorder(std::unique_ptr<Method> method, PartWriter& writer)
      : Method(method->abilities()), method_(std::move(method)), writer_(writer) {}

  std::string device() const override { return method_->device(); }
  void prepare(const Task& task) override {
    scene_ = fingerprint_of(task.occluders.mesh());
    method_->prepare(task);
  }
  double build_seconds() const override { return method_->build_seconds(); }

  Answered answer(std::span<const Receiver> receivers, const QueryOutputs& outputs,
                  std::uint64_t first_index) override {
    const std::size_t first = writer_.part().first_of(receivers.size());
    const std::size_t count = writer_.part().end_of(receivers.size()) - first;
    PartAnswers answers{.scene = scene_,
                        .receivers = fingerprint_of(receivers),
                        .report = {},
                        .occlusion = std::vector<float>(count),
                        .bent_normals = std::vector<glm::vec3>(outputs.bent_normals.empty() ? 0 : count)};
    const Answered answered = method_->answer(
        receivers.subspan(first, count),
        {.occlusion = answers.occlusion, .bent_normals = answers.bent_normals, .mask_words = {}}, first_index + first);
    answers.report = answered.report;
    writer_.write(answers);
    constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
    std::ranges::fill(outputs.occlusion, kNone);
    std::ranges::fill(outputs.bent_normals, glm::vec3(kNone));
    return answered;
  }

  method::Remarks remarks() const override { return method_->remarks(); }

 private:
  std::unique_ptr<Method> method_;
  PartWriter& writer_;
  std::uint64_t scene_ = 0;
};

class PartPlayer final : public Method {
 public:
  PartPlayer(const method::Abilities& abilities, std::vector<PartReader> parts)
      : Method(abilities), parts_(std::move(parts)) {}

  void prepare(const Task& task) override { scene_ = fingerprint_of(task.occluders.mesh()); }

  Answered answer(std::span<const Receiver> receivers, const QueryOutputs& outputs, std::uint64_t) override {
    const std::uint64_t asked = fingerprint_of(receivers);
    Answered answered;
    for (PartReader& reader : parts_) {
      const Part& part = reader.header().part;
      const std::size_t first = part.first_of(receivers.size()), count = part.end_of(receivers.size()) - first;
      const PartAnswers answers = reader.read(count);
      if (answers.scene != scene_ || answers.receivers != asked) reader.fail("the scene has changed since");
      put(answers, first, outputs);
      answered.report += answers.report;
    }
    return answered;
  }

 private:
  static void put(const PartAnswers& answers, std::size_t first, const QueryOutputs& outputs) {
    std::ranges::copy(answers.occlusion, outputs.occlusion.subspan(first).begin());
    if (!outputs.bent_normals.empty()) {
      std::ranges::copy(answers.bent_normals, outputs.bent_normals.subspan(first).begin());
    }
  }

  std::vector<PartReader> parts_;
  std::uint64_t scene_ = 0;
};

void check_same_run(const PartReader& first, const PartReader& other) {
  const PartHeader &a = first.header(), &b = other.header();
  if (a.part.count == b.part.count && a.arguments == b.arguments) return;
  throw std::runtime_error(fmt::format("'{}' and '{}' are parts of different runs", first.path(), other.path()));
}

}  // namespace

std::unique_ptr<Method> record_part(std::unique_ptr<Method> method, PartWriter& writer) {
  return std::make_unique<PartRecorder>(std::move(method), writer);
}

std::unique_ptr<Method> replay_parts(const method::Abilities& abilities, const std::vector<std::string>& paths) {
  return std::make_unique<PartPlayer>(abilities, open_parts(paths));
}

std::vector<PartReader> open_parts(const std::vector<std::string>& paths) {
  std::vector<PartReader> parts;
  parts.reserve(paths.size());
  for (const std::string& path : paths) parts.emplace_back(path);
  const auto number_of = [](const PartReader& part) { return part.header().part.number; };
  std::ranges::sort(parts, {}, number_of);
  for (std::size_t k = 1; k < parts.size(); ++k) {
    check_same_run(parts.front(), parts[k]);
    if (number_of(parts[k - 1]) < number_of(parts[k])) continue;
    throw std::runtime_error(
        fmt::format("'{}' and '{}' are the same part of a run", parts[k - 1].path(), parts[k].path()));
  }
  const int count = parts.front().header().part.count;
  for (int number = 1; number <= count; ++number) {
    const auto index = static_cast<std::size_t>(number - 1);
    if (index < parts.size() && number_of(parts[index]) == number) continue;
    throw std::runtime_error(fmt::format("part {} of {} is missing", number, count));
  }
  return parts;
}

}  // namespace lkao::cli
