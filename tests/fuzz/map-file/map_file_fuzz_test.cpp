// Map files with bytes changed, cut, doubled and spliced: each is read, or refused in one line. AISLE_FUZZ_RUNS sets
// how many.
#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "common/config/reader.hpp"
#include "common/grid/formats/map_file.hpp"

namespace aisle::grid {
namespace {

namespace fs = std::filesystem;

class Mutator {
 public:
  explicit Mutator(unsigned seed) : random_(seed) {}

  std::string operator()(std::string text, const std::vector<std::string>& tokens) {
    for (int i = pick(1, 6); i > 0; --i) mutate(text, tokens);
    return text;
  }

 private:
  int pick(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  std::size_t place(const std::string& text) {
    return static_cast<std::size_t>(pick(0, static_cast<int>(text.size())));
  }

  void mutate(std::string& text, const std::vector<std::string>& tokens) {
    const std::size_t at = place(text);
    const auto length = static_cast<std::size_t>(pick(1, 12));
    switch (pick(0, 6)) {
      case 0:
        if (at < text.size()) text[at] = static_cast<char>(pick(0, 255));
        break;
      case 1:
        if (at < text.size()) text[at] = static_cast<char>(text[at] ^ (1 << pick(0, 7)));
        break;
      case 2:
        text.erase(at, length);
        break;
      case 3:
        text.insert(at, text.substr(place(text), length));
        break;
      case 4:
        text.resize(at);
        break;
      case 5:
        text.insert(at, tokens[static_cast<std::size_t>(pick(0, static_cast<int>(tokens.size()) - 1))]);
        break;
      default:
        text.insert(at, std::string(length, static_cast<char>(pick(0, 255))));
        break;
    }
  }
  std::mt19937 random_;
};

class MapFileFuzz : public ::testing::Test {
 protected:
  MapFileFuzz() {
    std::string pattern = (fs::temp_directory_path() / "aisle-fuzz-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
    const char* runs = std::getenv("AISLE_FUZZ_RUNS");
    runs_ = runs != nullptr ? std::atoi(runs) : 1500;
  }
  ~MapFileFuzz() override { fs::remove_all(folder_); }

  void write(const std::string& name, const std::string& content) const {
    std::ofstream(folder_ / name, std::ios::binary) << content;
  }

  /// Damages `seed`, stores it as `name`, and reads the map `file`.
  void run(const std::string& seed, const std::string& name, const std::string& file,
           const std::vector<std::string>& tokens) const {
    int refused = 0;
    for (int i = 0; i < runs_; ++i) {
      const std::string damaged = Mutator(static_cast<unsigned>(i))(seed, tokens);
      write(name, damaged);
      try {
        const OccupancyGrid grid = read_map_file(folder_ / file);
        ASSERT_EQ(grid.cells().size(), grid.geometry().cells()) << "seed " << i;
        ASSERT_TRUE(std::all_of(grid.cells().begin(), grid.cells().end(),
                                [](Occupancy cell) { return cell <= Occupancy::kUnknown; }));
        ASSERT_GT(grid.geometry().resolution_m, 0.0) << "seed " << i;
        ASSERT_TRUE(geometry::is_finite(grid.geometry().origin_in_map)) << "seed " << i;
      } catch (const config::BadInput& bad) {
        ++refused;
        ASSERT_EQ(std::string(bad.what()).find('\n'), std::string::npos) << "seed " << i << ": " << bad.what();
      }
    }
    EXPECT_GT(refused, runs_ / 10);
  }

  fs::path folder_;
  int runs_;
  const std::vector<std::string> numbers_{"0",     "-1",   "65536", "4294967296", "99999999999999999999",
                                          "1e308", ".nan", ".inf",  "\r\n",       "\xEF\xBB\xBF",
                                          "#",     " "};
};

constexpr const char* kYaml =
    "image: room.pgm\nmode: trinary\nresolution: 0.05\norigin: [-1.0, 2.5, 0.0]\nnegate: 0\noccupied_thresh: "
    "0.65\nfree_thresh: 0.196\n";

TEST_F(MapFileFuzz, MovingAi) {
  run("type octile\nheight 4\nwidth 6\nmap\n..@@..\n......\n.TTSGW\nO.....\n", "a.map", "a.map", numbers_);
}

TEST_F(MapFileFuzz, TextGrid) { run("..##..\n......\n.???.#\n", "a.txt", "a.txt", numbers_); }

TEST_F(MapFileFuzz, RosYaml) {
  write("room.pgm", "P5 3 2 255\nabcdef");
  std::vector<std::string> tokens = numbers_;
  tokens.insert(tokens.end(), {"../", "&a ", "*a", "- ", "[", "{", ": ", "---\n", "!!binary ", "image: ", "origin: "});
  run(kYaml, "room.yaml", "room.yaml", tokens);
}

TEST_F(MapFileFuzz, BinaryPgm) {
  write("room.yaml", kYaml);
  run("P5\n# comment\n6 4\n255\n" + std::string(24, '\xFE'), "room.pgm", "room.yaml", numbers_);
}

TEST_F(MapFileFuzz, PlainPgm) {
  write("room.yaml", kYaml);
  run("P2\n# comment\n3 2\n255\n0 254 205\n254 254 0\n", "room.pgm", "room.yaml", numbers_);
}

TEST_F(MapFileFuzz, Png) {
  std::string yaml = kYaml;
  write("room.yaml", yaml.replace(yaml.find("pgm"), 3, "png"));
  std::vector<std::uint8_t> pixels(16 * 16 * 2, 254);
  for (std::size_t i = 0; i < pixels.size(); i += 7) pixels[i] = static_cast<std::uint8_t>(i);
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = png.height = 16;
  png.format = PNG_FORMAT_GA;
  ASSERT_NE(png_image_write_to_file(&png, (folder_ / "seed.png").c_str(), 0, pixels.data(), 0, nullptr), 0);
  std::ifstream in(folder_ / "seed.png", std::ios::binary);
  run(std::string((std::istreambuf_iterator<char>(in)), {}), "room.png", "room.yaml",
      {"IDAT", "IEND", "PLTE", "tRNS", std::string("\0\0\0\x0d", 4)});
}

}  // namespace
}  // namespace aisle::grid
