// Files of results say what made them, and read back as they were.
#include "tools/lab/results/result_text.hpp"

#include <gmock/gmock.h>

#include <limits>

namespace aisle::lab {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const Provenance kBuild{"4c2e91a", "GCC 12.2.0", "Release", "-O2", "avx2"};

TEST(ResultText, HasTheCommitTheBuildTheSeedAndTheParametersInItsHead) {
  const Row head = head_of("aisle drive", kBuild, {{"seed", 3}, {"parameters", "local.wang.alpha=0.1"}});
  EXPECT_EQ(csv_head(head, {"t_s", "v_mps"}),
            "# made_by: aisle drive\n# commit: 4c2e91a\n# compiler: GCC 12.2.0\n# build_type: Release\n# flags: -O2\n"
            "# vectors: avx2\n# seed: 3\n# parameters: local.wang.alpha=0.1\nt_s,v_mps\n");
  EXPECT_EQ(Row::parse(jsonl_head(head))["head"], head);
}

TEST(ResultText, WritesNumbersThatReadBackTheSame) {
  const double value = 0.1 + 0.2;
  const Row row{{"x_m", value}};
  EXPECT_EQ(std::stod(csv_line(row, {"x_m"})), value);
  EXPECT_EQ(Row::parse(jsonl_line(row))["x_m"].get<double>(), value);
}

TEST(ResultText, QuotesWhatWouldBreakARowOfCsv) {
  EXPECT_EQ(csv_line({{"a", "collinear,line-of-sight"}, {"b", "say \"no\""}, {"c", nullptr}, {"d", true}},
                     {"a", "b", "c", "missing", "d"}),
            "\"collinear,line-of-sight\",\"say \"\"no\"\"\",,,true\n");
}

TEST(ResultText, HasAColumnForEachKeyOfAnyRow) {
  const std::vector<Row> rows{{{"a", 1}, {"b", 2}}, {{"a", 3}, {"c", 4}}};
  EXPECT_THAT(columns_of(rows), ElementsAre("a", "b", "c"));
  EXPECT_THAT(csv_text({{"seed", 1}}, rows), HasSubstr("a,b,c\n1,2,\n3,,4\n"));
}

TEST(ResultText, HasNoNumbersThatJsonLacks) {
  EXPECT_TRUE(finite(std::numeric_limits<double>::infinity()).is_null());
  EXPECT_EQ(finite(0.5), Row(0.5));
}

TEST(Provenance, NamesCompilerAndVectorsOfThisProgram) {
  const Provenance mine = provenance();
  EXPECT_FALSE(mine.commit.empty());
  EXPECT_THAT(mine.compiler, HasSubstr("."));
  EXPECT_THAT(mine.vectors, testing::AnyOf("avx2", "sse2", "default", "off"));
}

}  // namespace
}  // namespace aisle::lab
