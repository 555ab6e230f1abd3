#include "common/process/exit_code.hpp"

#include <cstdio>
#include <exception>
#include <new>

#include "common/config/reader.hpp"

namespace aisle::process {
namespace {

/// The one line on stderr; returns `code`.
int say(const std::string& program, const char* what, int code) {
  std::fprintf(stderr, "%s: %s\n", program.c_str(), what);
  return code;
}

}  // namespace

/// From the special to the general: a handler that matches first wins.
int run_guarded(const std::string& program, const std::function<int()>& body) {
  try {
    return body();
  } catch (const config::BadInput& error) {
    return say(program, error.what(), kBadInput);
  } catch (const config::BadEnvironment& error) {
    return say(program, error.what(), kEnvironment);
  } catch (const std::bad_alloc&) {
    return say(program, "out of memory", kEnvironment);
  } catch (const std::exception& error) {
    return say(program, error.what(), kNegative);
  }
}

}  // namespace aisle::process
