#include "c_api/errors.h"

#include <cstdio>
#include <new>

#include "lkao/progress.h"

namespace lkao::c_api {
namespace {

// An array, so that there is room for a message where memory is out, and nothing to destroy when the thread ends.
thread_local char last_error[1024] = "";

lkao_status fail(lkao_status status, const char* function, const char* message) {
  std::snprintf(last_error, sizeof(last_error), "%s: %s", function, message);
  // One line, whatever an exception out of a callback says.
  for (char& c : last_error) {
    if (c == '\n') c = ' ';
  }
  return status;
}

}  // namespace

void refuse(const std::string& message) { throw Error(LKAO_ERROR_INVALID_ARGUMENT, message); }

lkao_status handle_exception(const char* function) noexcept {
  try {
    throw;
  } catch (const Error& error) {
    return fail(error.status(), function, error.what());
  } catch (const std::invalid_argument& error) {
    return fail(LKAO_ERROR_INVALID_ARGUMENT, function, error.what());
  } catch (const std::out_of_range& error) {
    return fail(LKAO_ERROR_INVALID_ARGUMENT, function, error.what());
  } catch (const std::bad_alloc&) {
    return fail(LKAO_ERROR_OUT_OF_MEMORY, function, "out of memory");
  } catch (const std::length_error&) {
    return fail(LKAO_ERROR_OUT_OF_MEMORY, function, "more than fits into memory");
  } catch (const Cancelled& error) {
    return fail(LKAO_ERROR_CANCELLED, function, error.what());
  } catch (const std::exception& error) {
    return fail(LKAO_ERROR_INTERNAL, function, error.what());
  } catch (...) {
    return fail(LKAO_ERROR_INTERNAL, function, "an exception of an unknown type");
  }
}

}  // namespace lkao::c_api

const char* lkao_last_error(void) { return lkao::c_api::last_error; }

const char* lkao_status_name(lkao_status status) {
  switch (status) {
    case LKAO_OK:
      return "LKAO_OK";
    case LKAO_ERROR_INVALID_ARGUMENT:
      return "LKAO_ERROR_INVALID_ARGUMENT";
    case LKAO_ERROR_INVALID_HANDLE:
      return "LKAO_ERROR_INVALID_HANDLE";
    case LKAO_ERROR_UNSUPPORTED:
      return "LKAO_ERROR_UNSUPPORTED";
    case LKAO_ERROR_OUT_OF_MEMORY:
      return "LKAO_ERROR_OUT_OF_MEMORY";
    case LKAO_ERROR_CANCELLED:
      return "LKAO_ERROR_CANCELLED";
    case LKAO_ERROR_INTERNAL:
      return "LKAO_ERROR_INTERNAL";
    default:
      return "unknown status";
  }
}
