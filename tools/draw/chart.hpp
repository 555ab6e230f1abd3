#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tools/draw/svg.hpp"

namespace aisle::draw {

/// The least step of 1, 2 or 5 times a power of ten that divides `span` into at most `most` parts. @pre
/// both > 0
double round_step(double span, int most);

/// Axes of one curve over time: t from 0 to duration_s (seconds), values from low to high. What lies
/// beyond is drawn at the edge.
struct Chart {
  int left_px{0};
  int top_px{0};
  int width_px{0};
  int height_px{0};
  double duration_s{1.0};
  double low{0.0};
  double high{1.0};

  /// Pixels of a moment and of a value.
  double x(double t_s) const;
  double y(double value) const;

  /// The lower and the right edge of the box.
  int bottom_px() const { return top_px + height_px; }
  int right_px() const { return left_px + width_px; }
};

/// The box in which the curves are drawn.
std::string chart_box(const Chart& chart);

/// A line across the chart at `value`, with the value to one digit after the point on its left.
std::string value_line(const Chart& chart, double value, std::string_view stroke, std::string_view text_attributes);

/// The value of a curve at one moment.
struct Sample {
  double t_s;
  double value;
};

/// The `d` of the curve through the samples.
std::string curve(const Chart& chart, const std::vector<Sample>& samples);

}  // namespace aisle::draw
