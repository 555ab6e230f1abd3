// A sweep that was ended goes on where it was, and never mixes two of them.
#include "tools/lab/sweep/sweep_folder.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>
#include <iterator>

#include "common/config/reader.hpp"

namespace aisle::lab {
namespace {

using testing::HasSubstr;

const Row kHead{{"commit", "4c2e91a"}, {"sweep", "abc"}};
const std::vector<std::string> kColumns{"trial", "length_m"};

class SweepFolderTest : public testing::Test {
 protected:
  SweepFolderTest() : folder_(std::filesystem::temp_directory_path() / ("aisle-folder-" + std::to_string(getpid()))) {}
  ~SweepFolderTest() override { std::filesystem::remove_all(folder_); }

  std::string text(const char* name) const {
    std::ifstream in(folder_ / name);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  void write_two_rows() {
    SweepFolder folder(folder_, kHead, kColumns);
    folder.append({{"trial", 0}, {"length_m", 1.5}});
    folder.append({{"trial", 1}, {"length_m", 2.5}});
  }

  std::string refusal(const Row& head) {
    try {
      SweepFolder folder(folder_, head, kColumns);
    } catch (const std::exception& error) {
      return error.what();
    }
    return "accepted";
  }

  std::filesystem::path folder_;
};

TEST_F(SweepFolderTest, HoldsTheSameRowsAsCsvAndAsJsonLines) {
  write_two_rows();
  EXPECT_EQ(text("results.csv"), "# commit: 4c2e91a\n# sweep: abc\ntrial,length_m\n0,1.5\n1,2.5\n");
  EXPECT_EQ(text("results.jsonl"),
            "{\"head\":{\"commit\":\"4c2e91a\",\"sweep\":\"abc\"}}\n{\"trial\":0,\"length_m\":1.5}\n"
            "{\"trial\":1,\"length_m\":2.5}\n");
}

TEST_F(SweepFolderTest, GoesOnWhereItWasAndDropsALineThatWasCutOff) {
  write_two_rows();
  std::filesystem::resize_file(folder_ / "results.jsonl", text("results.jsonl").size() - 4);
  {
    SweepFolder folder(folder_, kHead, kColumns);
    EXPECT_EQ(folder.kept().size(), 1U);
    EXPECT_EQ(folder.kept().count(0), 1U);
    folder.append({{"trial", 1}, {"length_m", 2.5}});
  }
  EXPECT_EQ(text("results.csv"), "# commit: 4c2e91a\n# sweep: abc\ntrial,length_m\n0,1.5\n1,2.5\n");
}

TEST_F(SweepFolderTest, IsRefusedForAnotherSweepAnotherCommitOrADamagedFile) {
  write_two_rows();
  EXPECT_THAT(refusal({{"commit", "4c2e91a"}, {"sweep", "abd"}}), HasSubstr("holds another sweep"));
  EXPECT_THAT(refusal({{"commit", "77"}, {"sweep", "abc"}}), HasSubstr("begun with commit 4c2e91a"));
  std::ofstream(folder_ / "results.jsonl", std::ios::app) << "{\"trial\": 2, \"len\n";
  EXPECT_THAT(refusal(kHead), HasSubstr("results.jsonl:4: is no row of a sweep"));
}

TEST_F(SweepFolderTest, WritesOverNothingThatIsNotOfASweep) {
  std::filesystem::create_directories(folder_);
  const auto write = [&](const char* name, const std::string& text) { std::ofstream(folder_ / name) << text; };

  write("results.csv", "mine\n");
  EXPECT_THAT(refusal(kHead), HasSubstr("results.csv: is not of a sweep"));
  EXPECT_EQ(text("results.csv"), "mine\n");

  std::filesystem::remove(folder_ / "results.csv");
  for (const char* mine : {"mine", "{\"head\":{\"commit\":\"4c2e91a\"}}\n{\"trial\":0}\n"}) {
    write("results.jsonl", mine);
    EXPECT_THAT(refusal(kHead), HasSubstr("results.jsonl: is not of a sweep")) << mine;
    EXPECT_EQ(text("results.jsonl"), mine);
  }

  write("results.jsonl", "{\"head\":{\"comm");
  EXPECT_EQ(refusal(kHead), "accepted") << "a sweep that was ended while it wrote its head";
  EXPECT_THAT(text("results.csv"), HasSubstr("# sweep: abc"));
}

TEST_F(SweepFolderTest, NamesTheLineThatIsDamagedWhateverStandsThere) {
  const Row head{{"commit", "4c2e91a"}, {"sweep", "abc"}, {"trials", 2}};
  const std::string good = jsonl_head(head);
  std::filesystem::create_directories(folder_);
  for (const std::string& text :
       {std::string("{\"head\":5}\n"), good + "{\"trial\":\"x\"}\n", good + "{\"trial\":-1}\n",
        good + "{\"trial\":2}\n", good + "[0]\n", good + "\xff\n"}) {
    std::ofstream(folder_ / "results.jsonl") << text;
    EXPECT_THAT(refusal(head), HasSubstr(": is no row of a sweep: the file is damaged")) << text;
  }

  std::ofstream(folder_ / "results.jsonl") << "{\"head\":{\"sweep\":\"abc\",\"commit\":7}}\n";
  EXPECT_THAT(refusal(head), HasSubstr("was begun with commit ?"));
}

TEST_F(SweepFolderTest, IsForOneProcessAtATime) {
  SweepFolder folder(folder_, kHead, kColumns);
  EXPECT_THAT(refusal(kHead), HasSubstr("another sweep writes there now"));
}

}  // namespace
}  // namespace aisle::lab
