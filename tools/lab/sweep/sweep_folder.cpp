#include "tools/lab/sweep/sweep_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <system_error>

#include "common/config/reader.hpp"
#include "common/process/output_file.hpp"

namespace aisle::lab {
namespace {

constexpr const char* kJsonLines = "results.jsonl";
constexpr const char* kCsv = "results.csv";
constexpr const char* kLock = ".lock";

std::FILE* open_to_append(const std::filesystem::path& file) {
  std::FILE* opened = std::fopen(file.c_str(), "a");
  if (opened == nullptr) throw config::BadEnvironment(file.string() + ": cannot be written");
  return opened;
}

void write(std::FILE* file, const std::string& text, const std::filesystem::path& folder) {
  if (std::fwrite(text.data(), 1, text.size(), file) != text.size() || std::fflush(file) != 0)
    throw config::BadEnvironment(folder.string() + ": cannot be written; is the disk full?");
}

/// The folder, which is there now.
std::filesystem::path made(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw config::BadEnvironment(folder.string() + ": cannot be made: " + error.message());
  return folder;
}

/// The text under a key of a head; "?" where there is none.
std::string plain(const char* key, const Row& head) {
  const Row value = head.value(key, Row());
  return value.is_string() ? value.get<std::string>() : "?";
}

/// A row has its trial's place in the sweep.
bool is_row_of(const Row& line, const Row& head) {
  if (!line.is_object() || !line.contains("trial") || !line["trial"].is_number_unsigned()) return false;
  const Row trials = head.value("trials", Row());
  return !trials.is_number_integer() || line["trial"] < trials;
}

/// Files of other programs have the same names: nothing that a sweep did not write is written over. A sweep begins with
/// the head of results.jsonl, which may have been cut off, and then writes results.csv.
void check_begun(const std::filesystem::path& folder, const std::string& jsonl_text, const Row& head) {
  const auto refuse = [&](const char* name) {
    throw config::BadInput((folder / name).string() + ": is not of a sweep: choose another --out, or remove the file");
  };
  if (jsonl_head(head).compare(0, jsonl_text.size(), jsonl_text) != 0) refuse(kJsonLines);
  if (std::filesystem::exists(folder / kCsv)) refuse(kCsv);
}

/// The head of a file must be that of this sweep, made by this program.
void check_head(const Row& there, const Row& head, const std::filesystem::path& file) {
  const auto differs = [&](const char* key) { return there.value(key, Row()) != head.value(key, Row()); };
  if (!there.contains("sweep"))
    throw config::BadInput(file.string() + ": is not of a sweep: choose another --out, or remove the file");
  if (differs("sweep"))
    throw config::BadInput(file.string() + ": holds another sweep: choose another --out, or remove the folder");
  if (differs("commit"))
    throw config::BadInput(
        fmt::format("{}: was begun with commit {}, and this program is {}: go on with that one, or "
                    "choose another --out",
                    file.string(), plain("commit", there), plain("commit", head)));
}

}  // namespace

FileLock::FileLock(const std::filesystem::path& file)
    : descriptor_(open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0644)) {
  if (descriptor_ < 0) throw config::BadEnvironment(file.string() + ": cannot be written");
  if (flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;

  close(descriptor_);
  throw config::BadEnvironment(file.parent_path().string() + ": another sweep writes there now: choose another --out");
}

FileLock::~FileLock() { close(descriptor_); }

SweepFolder::SweepFolder(const std::filesystem::path& folder, const Row& head, const std::vector<std::string>& columns)
    : folder_(made(folder)), lock_(folder / kLock), columns_(columns) {
  const std::filesystem::path jsonl = folder / kJsonLines, csv = folder / kCsv;

  // What is kept is never written again: a cut-off line at the end goes.
  const std::size_t whole_bytes = read_kept(head);
  jsonl_ = open_to_append(jsonl);
  std::filesystem::resize_file(jsonl, whole_bytes);
  if (whole_bytes == 0) write(jsonl_, jsonl_head(head), folder);

  std::string as_csv = csv_head(head, columns);
  for (const auto& [trial, row] : kept_) as_csv += csv_line(row, columns);
  process::write_output_file(csv, as_csv);
  csv_ = open_to_append(csv);
}

SweepFolder::~SweepFolder() {
  if (jsonl_ != nullptr) std::fclose(jsonl_);
  if (csv_ != nullptr) std::fclose(csv_);
}

std::size_t SweepFolder::read_kept(const Row& head) {
  const std::filesystem::path file = folder_ / kJsonLines;
  std::ifstream in(file);
  const std::string text{std::istreambuf_iterator<char>(in), {}};

  std::size_t number = 0, begin = 0;
  for (std::size_t end = 0; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
    const Row line = Row::parse(text.substr(begin, end - begin), nullptr, false);
    ++number;
    const bool is_head = line.is_object() && line.contains("head") && line["head"].is_object();
    if (number == 1 ? !is_head : !is_row_of(line, head))
      throw config::BadInput(fmt::format("{}:{}: is no row of a sweep: the file is damaged", file.string(), number));

    if (number == 1) {
      check_head(line["head"], head, file);
    } else {
      kept_[line["trial"].get<std::size_t>()] = line;
    }
  }

  if (begin == 0) check_begun(folder_, text, head);
  return begin;
}

void SweepFolder::append(const Row& row) {
  write(jsonl_, jsonl_line(row), folder_);
  write(csv_, csv_line(row, columns_), folder_);
}

}  // namespace aisle::lab
