#include "method/gl_device.h"

#include <cstdlib>
#include <string>

#include <fmt/format.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

namespace lkao::method {
namespace {

void limit_threads() {
  const int thread_count = tbb::this_task_arena::max_concurrency();
  if (thread_count == tbb::info::default_concurrency()) return;
  // Mesa's llvmpipe: 0 is the calling thread alone.
  setenv("LP_NUM_THREADS", std::to_string(thread_count == 1 ? 0 : thread_count).c_str(), 0);
}

}  // namespace

const Setting& device_setting() {
  static const Setting setting = word_setting("gl", "What OpenGL draws with: auto takes hardware where there is any",
                                              kDeviceWords, gl::Device::automatic);
  return setting;
}

gl::Device prepare_device(const Settings& settings) {
  limit_threads();
  return settings.value(device_setting(), kDeviceWords);
}

nlohmann::ordered_json device_keys(const gl::HeadlessContext& context) {
  return {{"renderer", context.renderer()}, {"version", context.version()}, {"software", context.is_software()}};
}

std::string device_text(const gl::HeadlessContext& context) {
  return fmt::format("{} ({})", context.renderer(), context.version());
}

}  // namespace lkao::method
