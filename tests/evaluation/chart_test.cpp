#include "evaluation/charts/chart_report.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include <gtest/gtest.h>

#include "engine/files/whole_file.h"
#include "evaluation/charts/chart_tables.h"
#include "tests/support/temp_folder.h"

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

TEST(ChartPlots, AreOneAChartAndNameWhatTheyDraw)
{
    const std::vector<Plot> plots = plotsOf(chartRows());
    ASSERT_EQ(plots.size(), 3u);
    EXPECT_EQ(plots[0].name, "a___b___c_-normals");
    EXPECT_NE(plots[0].script.find("set title 'a, \"b\" <c>: normals, error against time'"), std::string::npos);
    EXPECT_NE(plots[0].script.find("table = 'normals.csv'; first = 0; last = 3"), std::string::npos);
    EXPECT_EQ(plots[1].name, "ball-brdf-bytes");
    EXPECT_EQ(plots[2].name, "ball-brdf-time");
}

TEST(ChartPlots, QuotesEndNoString)
{
    EXPECT_EQ(quoted("it's `date`\n"), "'it''s `date` '");
}

TEST(ChartPlots, WithoutGnuplotScriptsAreWrittenAndSayWhatIsMissing)
{
    const TempFolder folder;
    const std::vector<Plot> plots = plotsOf(chartRows());
    const std::string path = std::getenv("PATH");
    setenv("PATH", folder.path().c_str(), 1);
    const std::string missing = drawPlots(folder.path(), plots);
    setenv("PATH", path.c_str(), 1);
    EXPECT_NE(missing.find("gnuplot-nox"), std::string::npos) << missing;
    EXPECT_TRUE(std::filesystem::exists(folder / "ball-brdf-time.gp"));
    EXPECT_EQ(plotFigure(folder.path(), plots.front()), "");
}

TEST(ChartPlots, AreDrawnFromTheTables)
{
    const TempFolder folder;
    const ChartRows rows = chartRows();
    writeTextFile(folder / kNormalTable, csvOf(rows.normals));
    writeTextFile(folder / kBrdfTable, csvOf(rows.brdf));
    const std::vector<Plot> plots = plotsOf(rows);
    ASSERT_EQ(drawPlots(folder.path(), plots), "");
    const std::string svg = readTextFile(folder / (plots.front().name + ".svg"));
    EXPECT_NE(svg.find("consensus, 12 lights"), std::string::npos) << "on the front";
    EXPECT_EQ(svg.find("ransac, 12 lights"), std::string::npos) << "dominated";
    EXPECT_NE(svg.find("the program's default"), std::string::npos);
    EXPECT_EQ(drawPlots(folder.path(), {{"wrong", "plot nothing"}}).find("gnuplot cannot draw wrong.gp"), 0u);
}

TEST(Chart, LeavesOutWhatAnAxisCannotShow)
{
    Chart chart{"t", "x", "y", false, {{"s", "zero", 0, 1}, {"s", "nan", 1, std::nan("")}, {"s", "good", 1, 1}}};
    EXPECT_EQ(frontOf(chart), (std::vector<char>{0, 0, 1}));
}

TEST(Chart, MoreIsBetterOfDecibels)
{
    Chart chart{"t", "bytes", "dB", false, {{"s", "a", 1, 40}, {"s", "b", 2, 30}}};
    EXPECT_EQ(frontOf(chart), (std::vector<char>{1, 0}));
    chart.isError = true;
    EXPECT_EQ(frontOf(chart), (std::vector<char>{1, 1}));
}

TEST(ChartDefault, IsBeatenByWhatIsATenthBetterInBoth)
{
    Chart chart{"t", "s", "degrees", true, {{"m", "usual", 10, 2, true}}};
    chart.points.push_back({"m", "faster alone", 1, 1.81});
    chart.points.push_back({"m", "better alone", 9.1, 1});
    EXPECT_TRUE(clearlyBetter(chart).empty());
    EXPECT_NE(describeDefault(chart).find("no other setting"), std::string::npos);
    chart.points.push_back({"m", "both", 8.9, 1.79});
    EXPECT_EQ(clearlyBetter(chart), (std::vector<size_t>{3}));
    EXPECT_NE(describeDefault(chart).find("m, both"), std::string::npos);
    // 20 log10(1 / 0.9) = 0.915 dB are a tenth of the error.
    chart.isError = false;
    chart.points = {{"m", "usual", 10, 30, true}, {"m", "a", 1, 30.9}, {"m", "b", 1, 30.93}};
    EXPECT_EQ(clearlyBetter(chart), (std::vector<size_t>{2}));
    chart.points.front().isDefault = false;
    EXPECT_TRUE(describeDefault(chart).empty());
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
    EXPECT_NE(csvOf(rows.normals).find(",ransac,12,,,,,,,no,no,\"too few, alas\"\n"), std::string::npos);
    EXPECT_NE(csvOf(rows.brdf).find("ball,local-linear,25,9,8,7,RGBA32F,8064,2.5000,32.5000,yes,no,yes\n"),
              std::string::npos);
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
    const TempFolder folder;
    const std::string html = reportOf(rows, {"1 < 2"}, folder.path());
    EXPECT_EQ(countOf(html, "<tr class="), rows.normals.size() + rows.brdf.size());
    EXPECT_EQ(html.find("src="), std::string::npos);
    EXPECT_EQ(html.find("href="), std::string::npos);
    EXPECT_NE(html.find("1 &lt; 2"), std::string::npos);
    expectWellFormed(html.substr(html.find("<h1>"), html.find("</body>") - html.find("<h1>")));
    EXPECT_EQ(countOf(reportOf({}, {}, folder.path()), "</html>"), 1u) << "nothing finished is a report as well";
}

} // namespace
} // namespace nacre
