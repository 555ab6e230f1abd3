#include "tools/lab/experiments.hpp"

#include <fstream>
#include <iterator>
#include <system_error>

#include "common/config/reader.hpp"
#include "common/process/output_file.hpp"
#include "common/scenario/data_path.hpp"
#include "tools/lab/page/markdown.hpp"
#include "tools/lab/papers/commit.hpp"

namespace aisle::lab {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPictures = "experiments";  // beside the page

/// Empty when the reference data is not there.
fs::path reference_data(const fs::path& maps) {
  try {
    return scenario::find_named_file("data:queries/den520d.q", maps / "any.yaml").parent_path().parent_path();
  } catch (const config::BadInput&) {
    return {};
  }
}

/// The same experiments with their places filled in; makes the folder of the pictures.
Experiments placed(Experiments experiments) {
  const fs::path pictures = experiments.page.parent_path() / kPictures;
  std::error_code failure;
  fs::create_directories(pictures, failure);
  if (failure) throw config::BadEnvironment(pictures.string() + ": cannot be made: " + failure.message());
  process::check_writable(experiments.page);

  experiments.global.commit = experiments.local.commit = experiments.tracking.commit = source_commit();
  experiments.global.data = reference_data(experiments.maps);
  experiments.tracking.people = experiments.global.data / "pedestrians";
  experiments.global.maps = experiments.local.maps = experiments.maps;
  experiments.papers.pictures = experiments.global.pictures = experiments.local.pictures =
      experiments.tracking.pictures = pictures;
  experiments.papers.pictures_from_page = experiments.global.pictures_from_page = experiments.local.pictures_from_page =
      experiments.tracking.pictures_from_page = kPictures;
  return experiments;
}

const char* name_of(Section section) {
  switch (section) {
    case Section::kPapers:
      return "papers";
    case Section::kGlobalPlanning:
      return "global planning";
    case Section::kLocalPlanning:
      return "local planning";
    case Section::kObstacleTracking:
      break;
  }
  return "obstacle tracking";
}

constexpr Section kOrder[] = {Section::kPapers, Section::kGlobalPlanning, Section::kLocalPlanning,
                              Section::kObstacleTracking};

/// The names of the sections behind this one.
std::vector<std::string> behind(Section section) {
  std::vector<std::string> names;
  for (const Section other : kOrder)
    if (other > section) names.emplace_back(name_of(other));
  return names;
}

FilledPage run(const Experiments& experiments, Section section, const Progress& progress) {
  switch (section) {
    case Section::kPapers:
      return papers_section(experiments.papers, progress);
    case Section::kGlobalPlanning:
      return global_section(experiments.global, progress);
    case Section::kLocalPlanning:
      return local_section(experiments.local, progress);
    case Section::kObstacleTracking:
      break;
  }
  return tracking_section(experiments.tracking, progress);
}

std::string content_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

}  // namespace

std::vector<std::string> write_section(const Experiments& experiments, Section section, const Progress& progress) {
  const FilledPage written = run(placed(experiments), section, progress);
  const std::string page = with_section(content_of(experiments.page), name_of(section), written.text, behind(section));
  process::write_output_file(experiments.page, page);
  return written.refuted;
}

std::vector<std::string> write_page(const Experiments& experiments, const Progress& progress) {
  const Experiments all = placed(experiments);
  if (all.global.data.empty())
    throw config::BadEnvironment("the whole page needs the reference data: set AISLE_DATA to its folder");
  std::string page;
  std::vector<std::string> refuted;
  for (const Section section : kOrder) {
    const FilledPage written = run(all, section, progress);
    page = with_section(page, name_of(section), written.text);
    refuted.insert(refuted.end(), written.refuted.begin(), written.refuted.end());
  }
  process::write_output_file(all.page, page);
  return refuted;
}

}  // namespace aisle::lab
