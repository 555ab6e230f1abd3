#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace aisle::draw {

/// A place or a length in a picture, in pixels; x to the right, y down. An int prints as it is ("60"), a double to a
/// tenth ("60.0"), so that layout by hand stays whole and measured places stay short.
class Px {
 public:
  /// Implicit on purpose: rect(10, 20.5, ...) says which numbers are whole.
  Px(int whole) : value_(whole), is_whole_(true) {}
  Px(double value) : value_(value), is_whole_(false) {}

  /// As it stands in an attribute.
  std::string text() const;

  friend Px operator+(Px a, Px b);  // whole when both are

 private:
  double value_;
  bool is_whole_;
};

/// A corner of a line, in pixels.
struct PointPx {
  double x;
  double y;
};

/// Text as it may stand between tags and in attributes: < > & " are replaced, control characters become blanks.
std::string escaped(std::string_view text);

// One element each. `attributes` is written as it is, e.g. fill="none" stroke="#3e4c59".
std::string rect(Px x, Px y, Px width, Px height, std::string_view attributes);
std::string circle(Px x, Px y, Px radius, std::string_view attributes);
std::string path(std::string_view d, std::string_view attributes);

/// With a `title` inside, which browsers show under the pointer.
std::string path(std::string_view d, std::string_view attributes, std::string_view title);

/// A line through all the points.
std::string polyline(const std::vector<PointPx>& points, std::string_view attributes);

/// `words` are escaped. @pre `attributes` may be empty
std::string text(Px x, Px y, std::string_view attributes, std::string_view words);

/// `content`, moved by (x, y).
std::string moved(Px x, Px y, std::string_view content);

/// "M x y L x y", the `d` of a path along the points; empty for none.
std::string path_along(const std::vector<PointPx>& points);

/// How a whole picture looks.
struct Page {
  Px width{0};
  Px height{0};
  std::string attributes{};   // of the root, e.g. the font
  std::string definitions{};  // patterns and clips, before the background
  std::string background{"#f5f7fa"};
  bool fills_container{false};  // no size of its own: as wide as what shows it
};

/// An SVG file's text: the background, then `body`.
std::string document(const Page& page, std::string_view body);

}  // namespace aisle::draw
