#include "services/map/core/journal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "common/config/reader.hpp"
#include "tests/unit/map/temporary_folder.hpp"

namespace aisle::map {
namespace {

using fleet::MapEdit;
using ::testing::HasSubstr;

JournalEntry entry(std::uint64_t revision) {
  MapEdit edit{"edit-" + std::to_string(revision),
               "site",
               MapEdit::Action::kUnblock,
               MapEdit::Shape::kPolygon,
               {{0.1, 1e-300}, {-2.5, 3.0}, {1.0 / 3.0, 7.0}},
               0.25};
  return {revision, edit, 42, "dispatcher", 1234567890123456789, {}};
}

class JournalFile : public ::testing::Test {
 protected:
  std::unique_ptr<Journal> open(const std::string& map_id = "site", std::uint64_t base_hash = 7,
                                const Journal::Options& options = {}) const {
    return std::make_unique<Journal>(file(), map_id, base_hash, options);
  }
  std::filesystem::path file() const { return folder_.path() / "site.journal"; }
  template <class Error>
  std::string refusal(const std::string& map_id = "site", std::uint64_t base_hash = 7) const {
    try {
      open(map_id, base_hash);
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr(file().string()));
      return error.what();
    }
    ADD_FAILURE() << "was opened";
    return {};
  }
  testing::TemporaryFolder folder_;
};

TEST_F(JournalFile, KeepsEveryFieldOverAReopening) {
  {
    const auto journal = open();
    EXPECT_TRUE(journal->entries().empty());
    journal->append(entry(2));
    journal->append(entry(3));
  }
  const std::vector<JournalEntry> entries = open()->entries();
  ASSERT_EQ(entries.size(), 2U);
  EXPECT_EQ(entries[1].revision, 3U);
  EXPECT_EQ(entries[1].edit, entry(3).edit);
  EXPECT_EQ(entries[1].changed_cells, 42U);
  EXPECT_EQ(entries[1].source_id, "dispatcher");
  EXPECT_EQ(entries[1].stamp_ns, 1234567890123456789);
}

TEST_F(JournalFile, TakesAnEditIdOnce) {
  const auto journal = open();
  journal->append(entry(2));
  JournalEntry again = entry(2);
  again.revision = 3;
  EXPECT_THROW(journal->append(again), JournalError);
  EXPECT_EQ(journal->entries().size(), 1U);
}

TEST_F(JournalFile, RefusesAnotherMapAndAnotherContentOfTheMapFile) {
  open();
  EXPECT_THAT(refusal<config::BadInput>("annex"), HasSubstr("belongs to map 'site', not to 'annex'"));
  EXPECT_THAT(refusal<config::BadInput>("site", 8), HasSubstr("another content of the map file"));
  EXPECT_NO_THROW(open());
}

TEST_F(JournalFile, RefusesAFileThatIsNoJournal) {
  std::ofstream(file()) << std::string(5000, 'x');
  EXPECT_THAT(refusal<config::BadInput>(), HasSubstr("is not a journal"));
}

TEST_F(JournalFile, RefusesAFolderThatIsNotThere) {
  EXPECT_THROW(Journal(folder_.path() / "none" / "site.journal", "site", 7, {}), config::BadEnvironment);
  EXPECT_THROW(Journal(folder_.path(), "site", 7, {}), config::BadEnvironment);
}

TEST_F(JournalFile, BelongsToOneProcessAtATime) {
  const auto journal = open();
  EXPECT_THAT(refusal<config::BadEnvironment>(), HasSubstr("another process"));
}

TEST_F(JournalFile, SaysWhenItIsFullAndKeepsWhatItHas) {
  Journal::Options options;
  options.max_bytes = 80000;
  const auto journal = open("site", 7, options);
  std::uint64_t revision = 2;
  const auto fill = [&] {
    for (; revision < 5000; ++revision) journal->append(entry(revision));
  };
  EXPECT_THROW(fill(), JournalError);
  EXPECT_GT(revision, 50U);
  EXPECT_EQ(journal->entries().size(), revision - 2);
  EXPECT_THROW(journal->append(entry(revision)), JournalError) << "still full, still there";
}

}  // namespace
}  // namespace aisle::map
