#include "common/grid/formats/map_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <set>

#include "common/config/reader.hpp"
#include "tests/support/places.hpp"
#include "tests/unit/grid/random_grid.hpp"

namespace aisle::grid {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kYaml =
    "image: room.pgm\nresolution: 0.05\norigin: [-1.0, 2.5, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: "
    "0.196\n";

class MapFile : public ::testing::Test {
 protected:
  MapFile() {
    std::string pattern = (fs::temp_directory_path() / "aisle-map-file-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
  }
  ~MapFile() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::string& content) const {
    std::ofstream(folder_ / name, std::ios::binary) << content;
    return folder_ / name;
  }
  /// Three columns, two rows; on top: free, occupied, unknown; below: unknown, free, free.
  static std::string pgm() {
    return std::string("P5\n# made by hand\n3 2\n255\n") + "\xFE" + std::string(1, '\0') + "\xCD" + "\xCD\xFE\xFE";
  }

  /// The one line of the refusal; fails the test when the file is read after all.
  static std::string refusal(const fs::path& file, const MapFileOptions& options = {}) {
    try {
      read_map_file(file, options);
    } catch (const config::BadInput& bad) {
      EXPECT_THAT(bad.what(), HasSubstr(file.parent_path().string())) << "names the file";
      EXPECT_THAT(bad.what(), Not(HasSubstr("\n"))) << "one line";
      return bad.what();
    }
    ADD_FAILURE() << "was read: " << file;
    return {};
  }
  std::string yaml_refusal(const std::string& from, const std::string& to) const {
    std::string text = kYaml;
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos);
    write("room.pgm", pgm());
    return refusal(write("room.yaml", text.replace(at, from.size(), to)));
  }

  fs::path folder_;
};

std::string drawn(const OccupancyGrid& grid) {
  std::string text;
  for (int y = grid.geometry().height - 1; y >= 0; --y) {
    for (int x = 0; x < grid.geometry().width; ++x) text += ".#?"[static_cast<int>(grid.at({x, y}))];
    text += '\n';
  }
  return text;
}

TEST_F(MapFile, ReadsARosMapWithItsFirstRowOnTop) {
  write("room.pgm", pgm());
  const OccupancyGrid grid = read_map_file(write("room.yaml", kYaml));
  EXPECT_EQ(drawn(grid), ".#?\n?..\n");
  EXPECT_EQ(grid.geometry(), (Geometry{3, 2, 0.05, {-1.0, 2.5}}));
}

TEST_F(MapFile, ReadsPlainPgmAnd16Bits) {
  write("room.pgm", "P2 3 2 # plain\n 100\n100 0 80\n80 100 100\n");
  EXPECT_EQ(drawn(read_map_file(write("room.yaml", kYaml))), ".#?\n?..\n");
  std::string deep = "P5 3 2 65535\n";
  for (const int v : {65535, 0, 52600, 52600, 65535, 65535})
    deep += {static_cast<char>(v >> 8), static_cast<char>(v & 255)};
  write("room.pgm", deep);
  EXPECT_EQ(drawn(read_map_file(folder_ / "room.yaml")), ".#?\n?..\n");
}

TEST_F(MapFile, ReadsPngWithTransparentPixelsUnknown) {
  const auto save = [&](std::uint32_t format, const std::vector<std::uint8_t>& pixels) {
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = 3;
    png.height = 2;
    png.format = format;
    ASSERT_NE(png_image_write_to_file(&png, (folder_ / "room.png").c_str(), 0, pixels.data(), 0, nullptr), 0);
  };
  std::string yaml = kYaml;
  yaml.replace(yaml.find("pgm"), 3, "png");
  write("room.yaml", yaml);
  save(PNG_FORMAT_GRAY, {254, 0, 205, 205, 254, 254});
  EXPECT_EQ(drawn(read_map_file(folder_ / "room.yaml")), ".#?\n?..\n");
  save(PNG_FORMAT_RGB, {254, 254, 254, 0, 0, 0, 205, 205, 205, 205, 205, 205, 254, 254, 254, 254, 254, 254});
  EXPECT_EQ(drawn(read_map_file(folder_ / "room.yaml")), ".#?\n?..\n");
  save(PNG_FORMAT_GA, {254, 255, 0, 255, 254, 0, 0, 0, 254, 255, 254, 255});
  EXPECT_EQ(drawn(read_map_file(folder_ / "room.yaml")), ".#?\n?..\n");

  std::ifstream in(folder_ / "room.png", std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(in)), {});
  for (std::size_t i = 0; i < whole.size() - 4; i += 3) {
    write("room.png", whole.substr(0, i));
    EXPECT_THAT(refusal(folder_ / "room.yaml"), HasSubstr("room.png"));
  }
  std::string huge = whole;
  huge.replace(16, 8, std::string("\x00\x01\x00\x00\x00\x01\x00\x00", 8));
  write("room.png", huge);
  EXPECT_THAT(refusal(folder_ / "room.yaml"), HasSubstr("room.png"));
}

TEST_F(MapFile, KnowsModesAndNegate) {
  const std::string shades = "P5 5 1 255\n" + std::string("\x00\x40\x80\xCD\xFE", 5);
  write("room.pgm", shades);
  const auto with = [&](const std::string& mode, const std::string& negate) {
    std::string yaml = kYaml;
    yaml.replace(yaml.find("negate: 0"), 9, "mode: " + mode + "\nnegate: " + negate);
    return drawn(read_map_file(write("room.yaml", yaml)));
  };
  EXPECT_EQ(with("trinary", "0"), "##??.\n");
  EXPECT_EQ(with("trinary", "1"), ".??##\n");
  EXPECT_EQ(with("scale", "0"), "##??.\n");
  EXPECT_EQ(with("scale", "1"), ".??##\n");
  write("room.pgm", "P5 5 1 255\n" + std::string("\x00\x13\x32\x42\xFF", 5));
  EXPECT_EQ(with("raw", "0"), "..?#?\n") << "percent, and what is beyond 100 is unknown";
}

TEST_F(MapFile, ReadsMovingAiAndTextGrids) {
  MapFileOptions options;
  options.moving_ai_cell_m = 2.0;
  options.subdivide = 2;
  const OccupancyGrid grid =
      read_map_file(write("a.map", "type octile\nheight 2\nwidth 4\nmap\n.GS@\nOTW.\n"), options);
  EXPECT_EQ(drawn(grid), "......##\n......##\n######..\n######..\n");
  EXPECT_EQ(grid.geometry(), (Geometry{8, 4, 1.0, {0.0, 0.0}}));
  EXPECT_EQ(drawn(read_map_file(write("a.txt", "\xEF\xBB\xBF#.?\r\n...\r\n\r\n"))), "#.?\n...\n")
      << "byte order mark, CRLF";
  EXPECT_EQ(drawn(read_map_file(write("b.map", "type octile\r\nheight 1\r\nwidth 2\r\nmap\r\n.@\r\n"))), ".#\n");
}

TEST_F(MapFile, ReadsYamlWithCrlfAndByteOrderMark) {
  write("room.pgm", pgm());
  std::string crlf = "\xEF\xBB\xBF";
  for (const char c : std::string(kYaml)) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(drawn(read_map_file(write("room.yaml", crlf))), ".#?\n?..\n");
}

TEST_F(MapFile, RefusesWhatIsMissingOrEmpty) {
  EXPECT_THAT(refusal(folder_ / "none.yaml"), HasSubstr("no such file"));
  EXPECT_THAT(refusal(folder_ / "none.map"), HasSubstr("no such file"));
  EXPECT_THAT(refusal(write("a.yaml", "")), HasSubstr("is empty"));
  EXPECT_THAT(refusal(write("a.map", "")), HasSubstr("is empty"));
  EXPECT_THAT(refusal(write("a.txt", "")), HasSubstr("is empty"));
  EXPECT_THAT(refusal(write("b.txt", "\n\n")), HasSubstr("no cells"));
  EXPECT_THAT(refusal(write("a.bmp", "BM")), AllOf(HasSubstr(".bmp"), HasSubstr(".yaml")));
  fs::create_directory(folder_ / "d.yaml");
  EXPECT_THAT(refusal(folder_ / "d.yaml"), HasSubstr("is not a file"));
  EXPECT_THAT(refusal(write("room.yaml", kYaml)), HasSubstr("room.pgm"));
  write("room.pgm", "");
  EXPECT_THAT(refusal(folder_ / "room.yaml"), AllOf(HasSubstr("room.pgm"), HasSubstr("is empty")));
}

TEST_F(MapFile, RefusesBadKeysByNameValueAndLimit) {
  EXPECT_THAT(yaml_refusal("0.05", "-0.05"), AllOf(HasSubstr("resolution"), HasSubstr("-0.05")));
  EXPECT_THAT(yaml_refusal("0.05", "0"), HasSubstr("resolution"));
  EXPECT_THAT(yaml_refusal("0.05", ".nan"), HasSubstr("resolution"));
  EXPECT_THAT(yaml_refusal("-1.0, 2.5", ".nan, 2.5"), HasSubstr("origin"));
  EXPECT_THAT(yaml_refusal("-1.0, 2.5", "1e308, 2.5"), HasSubstr("origin"));
  EXPECT_THAT(yaml_refusal("-1.0, 2.5, 0.0", "-1.0, 2.5"), HasSubstr("origin"));
  EXPECT_THAT(yaml_refusal("2.5, 0.0", "2.5, 0.3"), AllOf(HasSubstr("origin"), HasSubstr("yaw"), HasSubstr("0.3")));
  EXPECT_THAT(yaml_refusal("negate: 0", "negate: 2"), HasSubstr("negate"));
  EXPECT_THAT(yaml_refusal("negate: 0", "negate: 0\nmode: cubic"), AllOf(HasSubstr("mode"), HasSubstr("cubic")));
  EXPECT_THAT(yaml_refusal("free_thresh: 0.196", "free_thresh: 0.9"), HasSubstr("free_thresh"));
  EXPECT_THAT(yaml_refusal("occupied_thresh: 0.65", "occupied_thresh: 65"), HasSubstr("occupied_thresh"));
  EXPECT_THAT(yaml_refusal("negate: 0\n", ""), HasSubstr("negate"));
  EXPECT_THAT(yaml_refusal("image: room.pgm\n", ""), HasSubstr("image"));
  EXPECT_THAT(yaml_refusal("resolution", "resolutoin"), AllOf(HasSubstr("resolutoin"), HasSubstr("resolution")));
}

TEST_F(MapFile, KeepsImagesWithinTheFolder) {
  std::ofstream(folder_.parent_path() / "aisle-map-file-outside.pgm", std::ios::binary) << pgm();
  EXPECT_THAT(yaml_refusal("room.pgm", "../aisle-map-file-outside.pgm"), HasSubstr("outside"));
  EXPECT_THAT(yaml_refusal("room.pgm", "/etc/passwd"), HasSubstr("outside"));
  fs::create_symlink("/etc/passwd", folder_ / "link.pgm");
  EXPECT_THAT(yaml_refusal("room.pgm", "link.pgm"), HasSubstr("outside"));
  fs::remove(folder_.parent_path() / "aisle-map-file-outside.pgm");
  fs::create_directory(folder_ / "images");
  write("images/room.pgm", pgm());
  std::string yaml = kYaml;
  EXPECT_EQ(drawn(read_map_file(write("below.yaml", yaml.replace(yaml.find("room"), 4, "images/room")))), ".#?\n?..\n");
}

TEST_F(MapFile, RefusesImagesThatAreNotWhole) {
  const fs::path yaml = write("room.yaml", kYaml);
  const auto with = [&](const std::string& image) {
    write("room.pgm", image);
    return refusal(yaml);
  };
  EXPECT_THAT(with("P6 3 2 255\nxxxxxx"), HasSubstr("P5"));
  EXPECT_THAT(with("\xEF\xBB\xBF" + pgm()), HasSubstr("P5"));
  EXPECT_THAT(with("P5 100000 100000 255\nxxxxxx"), HasSubstr("100000 x 100000"));
  EXPECT_THAT(with("P5 4294967297 1 255\nx"), HasSubstr("width"));
  EXPECT_THAT(with("P5 99999999999999999999999999 1 255\nx"), HasSubstr("width"));
  EXPECT_THAT(with("P5 8000 8000 255\nxxxxxx"), HasSubstr("cut off"));
  EXPECT_THAT(with("P2 8000 8000 255\n1 2 3"), HasSubstr("cut off"));
  EXPECT_THAT(with("P5 0 2 255\n"), HasSubstr("width"));
  EXPECT_THAT(with("P5 -3 2 255\n"), HasSubstr("width"));
  EXPECT_THAT(with("P5 3 2 0\nxxxxxx"), HasSubstr("grey"));
  EXPECT_THAT(with("P5\r\n3 2\r\n255\r\nxxxxxx"), HasSubstr("CRLF"));
  EXPECT_THAT(with("P2 1 1 255\n300"), HasSubstr("300"));
}

TEST_F(MapFile, RefusesDamagedTextMaps) {
  const auto moving_ai = [&](const std::string& text) { return refusal(write("a.map", text)); };
  EXPECT_THAT(moving_ai("P5 3 2 255\n"), HasSubstr("Moving AI"));
  EXPECT_THAT(moving_ai("type octile\nheight 2\nwidth -1\nmap\n..\n..\n"), HasSubstr("width"));
  EXPECT_THAT(moving_ai("type octile\nheight nan\nwidth 2\nmap\n..\n..\n"), HasSubstr("height"));
  EXPECT_THAT(moving_ai("type octile\nheight 99999999999999\nwidth 2\nmap\n..\n"), HasSubstr("height"));
  EXPECT_THAT(moving_ai("type octile\nheight 100000\nwidth 100000\nmap\n..\n"), HasSubstr("tiles"));
  EXPECT_THAT(moving_ai("type octile\nheight 3\nwidth 2\nmap\n..\n..\n"), HasSubstr("2 rows"));
  EXPECT_THAT(moving_ai("type octile\nheight 2\nwidth 2\nmap\n..\n.\n"), HasSubstr("line 6"));
  EXPECT_THAT(moving_ai("type octile\nheight 2\nwidth 2\nmap\n..\n.x\n"),
              AllOf(HasSubstr("line 6, column 2"), HasSubstr("'x'")));
  EXPECT_THAT(refusal(write("a.txt", "..\n.\xFF\n")), HasSubstr("byte 255"));
  EXPECT_THAT(refusal(write("a.txt", "..\n...\n")), HasSubstr("line 2"));
  MapFileOptions options;
  options.subdivide = 65;
  EXPECT_THAT(refusal(write("a.txt", "..\n"), options), HasSubstr("subdivide"));
  options.subdivide = 64;
  EXPECT_THAT(refusal(write("a.txt", std::string(20000, '.')), options), HasSubstr("tiles"));
  options.moving_ai_cell_m = std::nan("");
  EXPECT_THAT(refusal(write("a.txt", "..\n"), options), HasSubstr("cell size"));
}

TEST_F(MapFile, RefusesEveryFileThatIsCutOff) {
  const std::string image = "P5\n40 30\n255\n" + std::string(1200, '\xFE');
  const std::string moving_ai = "type octile\nheight 16\nwidth 16\nmap\n" + [] {
    std::string rows;
    for (int i = 0; i < 16; ++i) rows += "................\n";
    return rows;
  }();
  write("room.yaml", kYaml);
  for (std::size_t part = 0; part < 16; ++part) {
    write("room.pgm", image.substr(0, image.size() * part / 16));
    refusal(folder_ / "room.yaml");
    refusal(write("cut.map", moving_ai.substr(0, moving_ai.size() * part / 16)));
  }
  write("room.pgm", pgm());
  for (std::size_t part = 0; part < 16; ++part) {
    const std::string cut = std::string(kYaml).substr(0, std::string(kYaml).size() * part / 16);
    if (cut.find("free_thresh: 0.1") != std::string::npos) continue;  // a shorter number is a number
    refusal(write("cut.yaml", cut));
  }
}

TEST_F(MapFile, WrittenAndReadAgainIsTheSame) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    const OccupancyGrid grid = testing::random_grid(random);
    write_ros_map(grid, folder_ / "saved.yaml");
    const OccupancyGrid again = read_map_file(folder_ / "saved.yaml");
    ASSERT_EQ(again.geometry(), grid.geometry()) << "seed " << seed;
    ASSERT_EQ(again.cells(), grid.cells()) << "seed " << seed;
  }
  int files = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder_)) ++files;
  EXPECT_EQ(files, 2) << "older images and temporary files are gone";
}

TEST_F(MapFile, AFailedSaveLeavesTheOldMap) {
  if (::geteuid() == 0) {
    std::mt19937 random(1);
    const OccupancyGrid grid = testing::random_grid(random);
    EXPECT_THROW(write_ros_map(grid, folder_ / "none" / "saved.yaml"), std::system_error);
    fs::create_directories(folder_ / "saved.yaml" / "in-the-way");
    EXPECT_THROW(write_ros_map(grid, folder_ / "saved.yaml"), std::system_error);
    for (const auto& entry : fs::directory_iterator(folder_))
      EXPECT_THAT(entry.path().string(), Not(HasSubstr(".tmp")));
    return;
  }
  std::mt19937 random(1);
  const OccupancyGrid grid = testing::random_grid(random);
  write_ros_map(grid, folder_ / "saved.yaml");
  fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THROW(write_ros_map(testing::random_grid(random), folder_ / "saved.yaml"), std::system_error);
  fs::permissions(folder_, fs::perms::owner_all);
  EXPECT_EQ(read_map_file(folder_ / "saved.yaml").cells(), grid.cells());
}

/// Maps that others made; only where the data lies beside the sources.
TEST(MapFileData, ReadsTheMapsOfOthers) {
  const char* set = std::getenv("AISLE_DATA");
  const fs::path data = set != nullptr ? fs::path(set) : test_support::source_folder() / ".." / "shared" / "data";
  if (!fs::exists(data / "ros")) GTEST_SKIP() << "no data in " << data << ": set AISLE_DATA to test with real maps";
  const Geometry depot = read_map_file(data / "ros" / "nav2_depot.yaml").geometry();
  EXPECT_EQ(depot.width, 604);
  EXPECT_EQ(depot.height, 307);
  for (const char* folder : {"ros", "movingai"}) {
    for (const auto& entry : fs::directory_iterator(data / folder)) {
      if (entry.path().extension() != ".yaml" && entry.path().extension() != ".map") continue;
      const OccupancyGrid grid = read_map_file(entry.path());
      std::size_t free = 0;
      for (const Occupancy cell : grid.cells()) free += cell == Occupancy::kFree ? 1 : 0;
      EXPECT_GT(free, grid.cells().size() / 20) << entry.path();
      EXPECT_LT(free, grid.cells().size()) << entry.path();
    }
  }
}

}  // namespace
}  // namespace aisle::grid
