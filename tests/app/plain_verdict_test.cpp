#include "app/report/plain_verdict.h"

#include <gtest/gtest.h>

namespace nacre {
namespace {

TEST(PlainVerdict, IsGoodWhereNoCheckObjects)
{
    NormalEstimate estimate;
    EXPECT_EQ(plainVerdict(estimate), "Good: no check objects.");
    estimate.report.figures = {{FindingCode::unexplained, 0.034, 0.09}};
    estimate.report.findings = {{FindingCode::methodChosen, "auto: exemplar"}};
    EXPECT_EQ(plainVerdict(estimate),
              "Good: the normals explain the photographs to 3 % of their brightness, and no check objects.");
}

TEST(PlainVerdict, NamesEachReasonOnce)
{
    NormalEstimate estimate;
    estimate.rig.warnings = {{FindingCode::lightsIllPlaced, "a"}};
    estimate.report.findings = {{FindingCode::lightsTurned, "b"}, {FindingCode::axesMixed, "c"}};
    EXPECT_EQ(plainVerdict(estimate), "Doubtful: the lights do not surround the object; the lights' directions do not "
                                      "fit the photographs.");
}

// So that no warning is without a reason: codes come before noMethod's, which is the last warning.
TEST(PlainVerdict, HasAReasonForEveryWarning)
{
    for (int code = 0; code <= static_cast<int>(FindingCode::noMethod); ++code) {
        NormalEstimate estimate;
        estimate.report.findings = {{static_cast<FindingCode>(code), ""}};
        EXPECT_EQ(plainVerdict(estimate).rfind("Doubtful: ", 0), 0u) << code;
    }
}

} // namespace
} // namespace nacre
