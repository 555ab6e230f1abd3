// What counts in the tables of the papers' fused drives.
#include "tools/lab/driving/fusion_tables.hpp"

#include <gmock/gmock.h>

namespace aisle::lab {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A drive of one moment at this speed that arrived, so far from the wall and from a mover.
DriveFigures driven(double speed_mps, double gap_m, double mover_gap_m = 1e9) {
  DriveFigures figures;
  DrivePoint point;
  point.linear_mps = speed_mps;
  point.gap_m = gap_m;
  point.mover_gap_m = mover_gap_m;
  figures.points = {point};
  figures.encounters.movers.resize(1);
  return figures;
}

TEST(FusionTables, CompareDrivesThatBothMetTheMover) {
  const DriveFigures met = driven(1.0, 0.3, 1.0), far = driven(1.0, 0.3, 3.0);
  EXPECT_TRUE(are_comparable(met, met, {1, 0}));
  EXPECT_FALSE(are_comparable(met, far, {1, 0}));
  EXPECT_FALSE(are_comparable(far, met, {1, 0}));
  EXPECT_TRUE(are_comparable(far, far, {}));

  DriveFigures lost = met;
  lost.result.goals_assigned = 1;
  EXPECT_FALSE(are_comparable(met, lost, {1, 0})) << "it never arrived";
}

TEST(FusionTables, CallADriveSlowerNearThingsOnlyWhereItWasNear) {
  EXPECT_TRUE(is_slower_near(driven(0.4, 0.3), driven(0.7, 0.3)));
  EXPECT_FALSE(is_slower_near(driven(0.7, 0.3), driven(0.4, 0.3)));
  EXPECT_FALSE(is_slower_near(driven(0.4, 2.0), driven(0.7, 0.3))) << "a mean of nothing is no speed";
}

TEST(FusionTables, SayOfACurveThatNoMoverWasMet) {
  EXPECT_THAT(curve_figures(driven(1.0, 0.3, 3.0), {1, 0}), HasSubstr(", met no mover"));
  EXPECT_THAT(curve_figures(driven(1.0, 0.3, 1.0), {1, 0}), Not(HasSubstr("met no mover")));
  EXPECT_THAT(curve_figures(driven(1.0, 0.3, 3.0), {0, 1}), Not(HasSubstr("met no mover"))) << "there was none";
}

}  // namespace
}  // namespace aisle::lab
