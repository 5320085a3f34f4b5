#include "reference/embree_error.h"

#include <stdexcept>

#include <fmt/format.h>

namespace lkao::reference {
namespace {

const char* text_of(RTCError error) {
  switch (error) {
    case RTC_ERROR_OUT_OF_MEMORY:
      return "out of memory";
    case RTC_ERROR_UNSUPPORTED_CPU:
      return "this CPU is not supported";
    case RTC_ERROR_INVALID_ARGUMENT:
      return "invalid argument";
    case RTC_ERROR_INVALID_OPERATION:
      return "invalid operation";
    default:
      return "unknown error";
  }
}

[[noreturn]] void fail(const char* step, RTCError error) {
  throw std::runtime_error(fmt::format("Embree, {}: {}", step, text_of(error)));
}

}  // namespace

scene::embree::Device make_device(const char* config) {
  scene::embree::Device device(rtcNewDevice(config));
  if (!device) fail("new device", rtcGetDeviceError(nullptr));
  return device;
}

void check(RTCDevice device, const char* step) {
  const RTCError error = rtcGetDeviceError(device);
  if (error != RTC_ERROR_NONE) fail(step, error);
}

}  // namespace lkao::reference
