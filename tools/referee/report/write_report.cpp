#include "tools/referee/report/write_report.hpp"

#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>

#include "tools/referee/report/fleet_svg.hpp"
#include "tools/referee/report/report_json.hpp"
#include "tools/referee/report/speeds_svg.hpp"

namespace aisle::referee {
namespace {

/// Under a temporary name, then renamed.
void write_whole(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::path temporary = file;
  temporary += ".part";

  std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
  out << text;
  out.close();

  if (!out) throw std::system_error(errno, std::generic_category(), "cannot write " + temporary.string());

  std::filesystem::rename(temporary, file);
}

}  // namespace

void write_report(const RunReport& report, const Walls& walls, const std::filesystem::path& folder,
                  const std::vector<fleet::Zone>& zones) {
  std::filesystem::create_directories(folder);
  write_whole(folder / "report.json", to_json(report).dump(2) + "\n");
  write_whole(folder / "fleet.svg", fleet_svg(report, walls, zones));
  write_whole(folder / "speeds.svg", speeds_svg(report));
}

}  // namespace aisle::referee
