#include "evaluation/charts/chart_report.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <gtest/gtest.h>

#include "evaluation/charts/chart_default.h"
#include "evaluation/charts/chart_labels.h"
#include "evaluation/charts/chart_tables.h"

namespace nacre {
namespace {

NormalRow normalRow(NormalMethod method, double seconds, double degrees)
{
    NormalRow row;
    row.capture = "a, \"b\" <c>";
    row.setting.method = method;
    row.photographs = 12;
    row.seconds = seconds;
    row.hasTruth = true;
    row.error.mean = degrees;
    return row;
}

ChartRows chartRows()
{
    ChartRows rows;
    rows.normals = {normalRow(NormalMethod::leastSquares, 0.1, 4), normalRow(NormalMethod::consensus, 1, 2),
                    normalRow(NormalMethod::ransac, 2, 3), normalRow(NormalMethod::automatic, 9, 1.5)};
    for (const BrdfSetting& setting : brdfSettings({})) {
        const double seconds = 0.1 * setting.k;
        rows.brdf.push_back({"ball", setting, {9, 8, 7}, 504 * bytesPerTexel(setting.format), seconds, 30 + seconds});
    }
    return rows;
}

// Tags nest, attributes are quoted, and no bare ampersand is left: all that our writer could get wrong.
void expectWellFormed(const std::string& xml)
{
    std::vector<std::string> open;
    for (size_t at = 0; (at = xml.find('<', at)) != std::string::npos; ++at) {
        const size_t end = xml.find('>', at);
        ASSERT_NE(end, std::string::npos);
        const std::string tag = xml.substr(at + 1, end - at - 1);
        ASSERT_EQ(tag.find('<'), std::string::npos) << tag;
        ASSERT_EQ(std::count(tag.begin(), tag.end(), '"') % 2, 0) << tag;
        const std::string name = tag.substr(0, tag.find(' '));
        if (tag[0] == '/') {
            ASSERT_FALSE(open.empty());
            ASSERT_EQ(tag.substr(1), open.back());
            open.pop_back();
        } else if (tag.back() != '/') {
            open.push_back(name);
        }
    }
    EXPECT_TRUE(open.empty());
    for (size_t at = 0; (at = xml.find('&', at)) != std::string::npos; ++at) {
        EXPECT_LT(xml.find(';', at), at + 6) << xml.substr(at, 20);
    }
}

size_t countOf(const std::string& text, const std::string& part)
{
    size_t count = 0;
    for (size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) {
        ++count;
    }
    return count;
}

TEST(ChartSvg, IsWellFormedAndDrawsFrontDominatedAndDefault)
{
    for (const NamedChart& chart : chartsOf(chartRows())) {
        expectWellFormed(svgOf(chart.chart));
    }
    const std::string svg = svgOf(chartsOf(chartRows()).front().chart);
    EXPECT_NE(svg.find("a, &quot;b&quot; &lt;c&gt;"), std::string::npos);
    // Beside one of each in the legend: three of four on the front, ransac dominated by consensus, auto the default.
    EXPECT_EQ(countOf(svg, "fill=\"#0072b2\""), 4u);
    EXPECT_EQ(countOf(svg, "fill=\"#b4b4b4\""), 2u);
    EXPECT_EQ(countOf(svg, "stroke=\"#d55e00\""), 2u);
    EXPECT_EQ(svg.find(">ransac, 12 lights<"), std::string::npos);
    EXPECT_NE(svg.find(">consensus, 12 lights<"), std::string::npos);
}

TEST(ChartSvg, LeavesOutWhatAnAxisCannotShow)
{
    Chart chart{"t", {"x", true, true}, {"y", false, false}, {{"s", "zero", 0, 1}, {"s", "nan", 1, std::nan("")}}};
    expectWellFormed(svgOf(chart));
    EXPECT_NE(svgOf(chart).find("nothing was measured"), std::string::npos);
    chart.points.push_back({"s", "good", 1, 1});
    EXPECT_EQ(frontOf(chart), (std::vector<char>{0, 0, 1}));
    const std::string svg = svgOf(chart);
    expectWellFormed(svg);
    EXPECT_EQ(svg.find("nan"), std::string::npos) << "of one point as well an axis has a length";
    EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(ChartSvg, MoreIsBetterWhereTheAxisSaysSo)
{
    Chart chart{"t", {"bytes", true, true}, {"dB", false, false}, {{"s", "a", 1, 40}, {"s", "b", 2, 30}}};
    EXPECT_EQ(frontOf(chart), (std::vector<char>{1, 0}));
    chart.y.isLessBetter = true;
    EXPECT_EQ(frontOf(chart), (std::vector<char>{1, 1}));
}

TEST(ChartDefault, IsBeatenByWhatIsATenthBetterInBoth)
{
    Chart chart{"t", {"s", true, true}, {"degrees", true, true}, {{"m", "usual", 10, 2, true}}};
    chart.points.push_back({"m", "faster alone", 1, 1.81});
    chart.points.push_back({"m", "better alone", 9.1, 1});
    EXPECT_TRUE(clearlyBetter(chart).empty());
    EXPECT_NE(describeDefault(chart).find("no other setting"), std::string::npos);
    chart.points.push_back({"m", "both", 8.9, 1.79});
    EXPECT_EQ(clearlyBetter(chart), (std::vector<size_t>{3}));
    EXPECT_NE(describeDefault(chart).find("m, both"), std::string::npos);
    // 20 log10(1 / 0.9) = 0.915 dB are a tenth of the error.
    chart.y = {"dB", false, false};
    chart.points = {{"m", "usual", 10, 30, true}, {"m", "a", 1, 30.9}, {"m", "b", 1, 30.93}};
    EXPECT_EQ(clearlyBetter(chart), (std::vector<size_t>{2}));
    chart.points.front().isDefault = false;
    EXPECT_TRUE(describeDefault(chart).empty());
}

TEST(ChartLabels, NeverOverlapEachOtherWhatIsTakenOrTheFrame)
{
    std::vector<LabelAnchor> anchors;
    std::vector<LabelBox> taken;
    for (int i = 0; i < 14; ++i) {
        anchors.push_back({100 + 7.0 * i, 150 + 5.0 * (i % 3), "local-linear " + std::to_string(i)});
        taken.push_back({anchors.back().x - 5, anchors.back().y - 5, 10, 10});
    }
    const LabelBox frame{0, 0, 500, 300};
    const std::vector<PlacedLabel> placed = placeLabels(anchors, taken, frame);
    EXPECT_GE(placed.size(), 10u) << "there is room for most";
    for (size_t i = 0; i < placed.size(); ++i) {
        const LabelBox& box = placed[i].box;
        EXPECT_GE(std::min(box.x, box.y), 0);
        EXPECT_LE(box.x + box.width, 500);
        EXPECT_LE(box.y + box.height, 300);
        for (size_t j = 0; j < i; ++j) {
            EXPECT_FALSE(overlap(box, placed[j].box)) << i << " " << j;
        }
        EXPECT_TRUE(std::none_of(taken.begin(), taken.end(), [&](const LabelBox& t) { return overlap(box, t); }));
    }
}

TEST(ChartAxis, TicksLieWithinAndTellTheirValues)
{
    const ChartScale log({0.03, 12}, true), narrow({1000, 1000}, true), linear({28.31, 39.2}, false);
    for (const ChartScale& scale : {log, narrow, linear}) {
        EXPECT_GE(scale.ticks().size(), 2u);
        EXPECT_LE(scale.ticks().size(), 10u);
        for (const double tick : scale.ticks()) {
            EXPECT_GE(scale.position(tick), 0);
            EXPECT_LE(scale.position(tick), 1);
        }
    }
    EXPECT_NEAR(log.position(0.6), 0.5, 1e-9) << "the geometric mean of 0.03 and 12";
    EXPECT_NEAR(linear.position(33.755), 0.5, 1e-9);
    EXPECT_EQ(tickText(0.05), "0.05");
    EXPECT_EQ(tickText(1500000), "1.5M");
    EXPECT_EQ(tickText(20000), "20k");
}

// Fields outside quotes.
size_t fieldsOf(const std::string& line)
{
    size_t fields = 1;
    bool quoted = false;
    for (const char c : line) {
        quoted ^= c == '"';
        fields += c == ',' && !quoted;
    }
    return fields;
}

TEST(ChartCsv, HasALineASettingWithEveryField)
{
    ChartRows rows = chartRows();
    rows.normals[2].refusal = "too few, alas";
    for (const auto& [csv, count] :
         {std::pair(csvOf(rows.normals), rows.normals.size()), std::pair(csvOf(rows.brdf), rows.brdf.size())}) {
        std::istringstream lines(csv);
        std::string line, heading;
        std::getline(lines, heading);
        size_t found = 0;
        while (std::getline(lines, line)) {
            EXPECT_EQ(fieldsOf(line), fieldsOf(heading)) << line;
            ++found;
        }
        EXPECT_EQ(found, count);
    }
    EXPECT_NE(csvOf(rows.normals).find("\"a, \"\"b\"\" <c>\",consensus,12,1.0000,2.0000,"), std::string::npos);
    EXPECT_NE(csvOf(rows.normals).find(",ransac,12,,,,,,,no,\"too few, alas\"\n"), std::string::npos);
    EXPECT_NE(csvOf(rows.brdf).find("ball,local-linear,25,9,8,7,RGBA32F,8064,2.5000,32.5000,yes\n"), std::string::npos);
}

TEST(ChartSettings, AreAllCombinationsAndOneIsTheDefault)
{
    const ChartChoices choices;
    EXPECT_EQ(normalSettings(choices, 82).size(), 7u * 4);
    EXPECT_EQ(normalSettings(choices, 12).size(), 7u * 2) << "all, and 6 of 12: 12 of 12 are all";
    const std::vector<BrdfSetting> brdf = brdfSettings(choices);
    EXPECT_EQ(brdf.size(), 3u * 2 * 5 * 3);
    EXPECT_EQ(std::count_if(brdf.begin(), brdf.end(), [](const BrdfSetting& s) { return isDefault(s); }), 1);
    const auto normals = normalSettings(choices, 82);
    EXPECT_EQ(std::count_if(normals.begin(), normals.end(), [](const NormalSetting& s) { return isDefault(s); }), 1);
}

TEST(ChartReport, StandsAloneAndHasEverySetting)
{
    const ChartRows rows = chartRows();
    const std::string html = reportOf(rows, {"1 < 2"});
    EXPECT_EQ(countOf(html, "<svg "), 3u);
    EXPECT_EQ(countOf(html, "<tr class="), rows.normals.size() + rows.brdf.size());
    EXPECT_EQ(html.find("src="), std::string::npos);
    EXPECT_EQ(html.find("href="), std::string::npos);
    EXPECT_NE(html.find("1 &lt; 2"), std::string::npos);
    expectWellFormed(html.substr(html.find("<h1>"), html.find("</body>") - html.find("<h1>")));
    EXPECT_EQ(countOf(reportOf({}, {}), "</html>"), 1u) << "nothing finished is a report as well";
}

} // namespace
} // namespace nacre
