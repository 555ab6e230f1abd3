// A researcher's own map in any of its forms, with what is asked there.
#include "tools/lab/planning/subject.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>

#include "common/config/reader.hpp"

namespace aisle::lab {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class SubjectTest : public testing::Test {
 protected:
  SubjectTest() : folder_(std::filesystem::temp_directory_path() / ("aisle-subject-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~SubjectTest() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }

  static std::string refusal(const SubjectOrders& orders) {
    try {
      read_subject(orders);
    } catch (const config::BadInput& error) {
      return error.what();
    }
    return "accepted";
  }

  std::filesystem::path folder_;
};

TEST_F(SubjectTest, OfATextMapHasItsStartAndGoalUnlessOthersAreGiven) {
  const auto map = write("hall.txt", "S..?\r\n.#.T\r\n\r\n");
  const Subject drawn = read_subject({map});
  ASSERT_EQ(drawn.queries.size(), 1U);
  EXPECT_EQ(drawn.queries[0].start_in_map, (geometry::Point2{0.5, 1.5}));
  EXPECT_EQ(drawn.queries[0].goal_in_map, (geometry::Point2{3.5, 0.5}));
  EXPECT_EQ(drawn.grid.geometry().height, 2);
  EXPECT_FALSE(drawn.grid.is_free({3, 1})) << "unknown";

  const Subject given = read_subject({map, 0.5, Place{{1.2, 0.7}, 1.5}});
  EXPECT_EQ(given.queries[0].start_in_map, (geometry::Point2{1.2, 0.7}));
  EXPECT_EQ(given.start_yaw_rad, 1.5);
  EXPECT_EQ(given.queries[0].goal_in_map, (geometry::Point2{1.75, 0.25})) << "cells of half a metre";
}

TEST_F(SubjectTest, OfAPictureNeedsItsResolution) {
  // 3 x 2 pixels: dark is occupied, light free, what lies between unknown; row 0 on top.
  const auto map = write("hall.pgm", std::string("P5 3 2 255\n") + "\xff\xff\x80" + std::string("\0", 1) + "\xff\xff");
  const std::optional<Place> start = Place{{0.1, 0.15}}, goal = Place{{0.25, 0.05}};
  const Subject subject = read_subject({map, 0.1, start, goal});
  const grid::Geometry& geometry = subject.grid.geometry();
  EXPECT_EQ(geometry.width, 3);
  EXPECT_EQ(geometry.resolution_m, 0.1);
  EXPECT_EQ(subject.grid.at({0, 0}), grid::Occupancy::kOccupied);
  EXPECT_EQ(subject.grid.at({0, 1}), grid::Occupancy::kFree);
  EXPECT_EQ(subject.grid.at({2, 1}), grid::Occupancy::kUnknown);

  EXPECT_THAT(refusal({map, 0.0, start, goal}),
              AllOf(HasSubstr("hall.pgm"), HasSubstr("give --resolution, e.g. 0.05")));
  EXPECT_THAT(refusal({map, 0.1, start}), AllOf(HasSubstr("hall.pgm"), HasSubstr("give --goal X,Y")));
}

TEST_F(SubjectTest, OfMovingAiAsksEachScenario) {
  const auto map = write("a.map", "type octile\nheight 2\nwidth 3\nmap\n...\n..@\n");
  const auto scen = write("a.scen", "version 1\n0 a.map 3 2 0 0 2 0 2\n0 a.map 3 2 0 1 2 0 2.41\n");
  EXPECT_EQ(read_subject({map, 0.0, {}, {}, scen}).queries.size(), 2U);
  EXPECT_EQ(read_subject({map, 2.0, {}, {}, scen, 1}).queries[0].optimum_m, 4.0) << "cells of two metres";
  EXPECT_THAT(refusal({map, 0.0, Place{{0.5, 0.5}}, {}, scen}), HasSubstr("leave out --start and --goal"));
}

TEST_F(SubjectTest, ThatCannotBeReadIsRefusedWithTheFileAndThePlace) {
  EXPECT_THAT(refusal({write("a.bmp", "x")}), HasSubstr("ending '.bmp' is no known map: .png or .pgm"));
  EXPECT_THAT(refusal({folder_ / "none.txt"}), HasSubstr("none.txt"));
  EXPECT_THAT(refusal({write("x.txt", "S.T\n.x.\n")}), HasSubstr("x.txt: line 2, column 2: 'x' is not one of #.?ST"));
  EXPECT_THAT(refusal({write("two.txt", "S.T\nS..\n")}), HasSubstr("two.txt:2: a second 'S'"));
  EXPECT_THAT(refusal({write("short.txt", "S.T\n..\n")}), HasSubstr("short.txt:2: is not as long"));
  EXPECT_THAT(refusal({write("s.txt", "...\n..T\n")}), HasSubstr("give --start X,Y in metres"));
  EXPECT_THAT(refusal({write("r.yaml", "image: a.pgm\n"), 0.05}), HasSubstr("leave out --resolution"));
  EXPECT_THAT(refusal({write("broken.png", "no picture"), 0.05}), HasSubstr("broken.png"));
}

}  // namespace
}  // namespace aisle::lab
