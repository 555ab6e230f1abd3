#pragma once

#include <pybind11/numpy.h>

#include <vector>

namespace aisle::python {

/// A copy: (n,).
inline pybind11::array_t<double> array_of(const std::vector<double>& values) {
  return pybind11::array_t<double>(static_cast<pybind11::ssize_t>(values.size()), values.data());
}

/// A copy, row by row: (n / columns, columns).
inline pybind11::array_t<double> array_of(const std::vector<double>& values, pybind11::ssize_t columns) {
  const auto rows = static_cast<pybind11::ssize_t>(values.size()) / columns;
  return pybind11::array_t<double>({rows, columns}, values.data());
}

}  // namespace aisle::python
