// aisle_lab._native: the few functions that python/aisle_lab calls. Thin: each turns Python values into the tools' own,
// calls them without Python's lock, and turns the outcome back.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <functional>

namespace aisle::python {

void bind_maps(pybind11::module_& module);
void bind_planning(pybind11::module_& module);
void bind_driving(pybind11::module_& module);

/// True once Ctrl-C was pressed; to be asked without Python's lock, which it takes for a moment. Asks Python at most
/// every `period_calls` calls. The exception itself is left pending for raise_if_interrupted().
std::function<bool()> interruption(int period_calls);

/// Throws the KeyboardInterrupt that interruption() saw. Called with Python's lock.
void raise_if_interrupted();

}  // namespace aisle::python
