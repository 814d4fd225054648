#include "framework/execution/guard.h"

#include <new>

namespace plaza {
namespace {

InternalError foreign(const std::string& message, const FaultContext& context) {
  InternalError error(message);
  error.add_context(context);
  return error;
}

}  // namespace

void rethrow_with_context(const std::string& component, std::optional<std::int64_t> frame) {
  const FaultContext context{.component = component, .frame = frame, .camera = {}};
  try {
    throw;
  } catch (Error& error) {
    error.add_context(context);
    throw;
  } catch (const std::bad_alloc&) {
    throw foreign("out of memory", context);
  } catch (const std::exception& error) {
    throw foreign(error.what(), context);
  } catch (...) {
    throw foreign("threw something that is not a std::exception", context);
  }
}

std::string describe(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const Error& e) {
    const std::string place = to_string(e.context());
    return place.empty() ? e.what() : place + ": " + e.what();
  } catch (const std::exception& e) {
    return e.what();
  } catch (...) {
    return "an exception that is not a std::exception";
  }
}

}  // namespace plaza
