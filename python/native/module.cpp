#include <algorithm>
#include <exception>
#include <memory>
#include <string>

#include "common/config/reader.hpp"
#include "python/native/bindings.hpp"
#include "tools/lab/papers/commit.hpp"

namespace aisle::python {
namespace py = pybind11;

/// The last answer is kept: once interrupted, always interrupted.
std::function<bool()> interruption(int period_calls) {
  auto calls = std::make_shared<int>(0);
  auto seen = std::make_shared<bool>(false);
  return [=] {
    if (*seen || ++*calls % period_calls != 0) return *seen;

    const py::gil_scoped_acquire lock;
    return *seen = PyErr_CheckSignals() != 0;
  };
}

void raise_if_interrupted() {
  if (PyErr_Occurred() != nullptr) throw py::error_already_set();
}

namespace {

/// The line without the dashes of the flag that it may begin with: in Python that is an argument.
std::string without_dashes(const std::string& line) {
  return line.substr(std::min(line.find_first_not_of('-'), line.size()));
}

/// One clear line for what a person got wrong: ValueError. What the machine does not give: OSError.
void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const config::BadInput& error) {
    PyErr_SetString(PyExc_ValueError, without_dashes(error.what()).c_str());
  } catch (const config::BadEnvironment& error) {
    PyErr_SetString(PyExc_OSError, error.what());
  }
}

}  // namespace
}  // namespace aisle::python

PYBIND11_MODULE(_native, module) {
  namespace py = pybind11;
  py::register_exception_translator(&aisle::python::translate);

  module.def("commit", &aisle::lab::source_commit);
  aisle::python::bind_maps(module);
  aisle::python::bind_planning(module);
  aisle::python::bind_driving(module);
}
