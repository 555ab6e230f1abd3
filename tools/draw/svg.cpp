#include "tools/draw/svg.hpp"

#include <fmt/format.h>

namespace aisle::draw {
namespace {

/// A blank before attributes, if there are any.
std::string after_blank(std::string_view attributes) {
  return attributes.empty() ? "" : fmt::format(" {}", attributes);
}

}  // namespace

std::string Px::text() const { return is_whole_ ? fmt::format("{:.0f}", value_) : fmt::format("{:.1f}", value_); }

Px operator+(Px a, Px b) {
  Px sum(a.value_ + b.value_);
  sum.is_whole_ = a.is_whole_ && b.is_whole_;
  return sum;
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '&':
        out += "&amp;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }

  return out;
}

std::string rect(Px x, Px y, Px width, Px height, std::string_view attributes) {
  return fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"{}/>", x.text(), y.text(), width.text(),
                     height.text(), after_blank(attributes));
}

std::string circle(Px x, Px y, Px radius, std::string_view attributes) {
  return fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\"{}/>", x.text(), y.text(), radius.text(),
                     after_blank(attributes));
}

std::string path(std::string_view d, std::string_view attributes) {
  return fmt::format("<path d=\"{}\"{}/>", d, after_blank(attributes));
}

std::string path(std::string_view d, std::string_view attributes, std::string_view title) {
  return fmt::format("<path d=\"{}\"{}><title>{}</title></path>", d, after_blank(attributes), escaped(title));
}

std::string polyline(const std::vector<PointPx>& points, std::string_view attributes) {
  std::string list;
  for (const PointPx p : points) list += fmt::format("{:.1f},{:.1f} ", p.x, p.y);
  return fmt::format("<polyline points=\"{}\"{}/>", list, after_blank(attributes));
}

std::string text(Px x, Px y, std::string_view attributes, std::string_view words) {
  return fmt::format("<text x=\"{}\" y=\"{}\"{}>{}</text>", x.text(), y.text(), after_blank(attributes),
                     escaped(words));
}

std::string moved(Px x, Px y, std::string_view content) {
  return fmt::format("<g transform=\"translate({} {})\">{}</g>", x.text(), y.text(), content);
}

std::string path_along(const std::vector<PointPx>& points) {
  std::string d;
  for (const PointPx p : points) d += fmt::format("{}{:.1f} {:.1f}", d.empty() ? "M" : "L", p.x, p.y);
  return d;
}

/// Definitions come before the background, since it may use them.
std::string document(const Page& page, std::string_view body) {
  const std::string width = page.width.text(), height = page.height.text();
  const std::string size =
      page.fills_container ? std::string{} : fmt::format("width=\"{}\" height=\"{}\" ", width, height);

  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" {}viewBox=\"0 0 {} {}\"{}>\n{}<rect width=\"100%\" height=\"100%\" "
      "fill=\"{}\"/>\n{}</svg>\n",
      size, width, height, after_blank(page.attributes), page.definitions, page.background, body);
}

}  // namespace aisle::draw
