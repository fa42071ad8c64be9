#include "engine/brdf/brdf_models.h"

#include <charconv>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "engine/files/error.h"

namespace nacre {
namespace {

constexpr const char* kAbcHeader = "name,kD_r,kD_g,kD_b,A_r,A_g,A_b,B,C,ior";
constexpr const char* kSgdHeader = "name,rhoD_r,rhoD_g,rhoD_b,rhoS_r,rhoS_g,rhoS_b,alpha_r,alpha_g,alpha_b,p_r,p_g,p_b,"
                                   "F0_r,F0_g,F0_b,F1_r,F1_g,F1_b,kap_r,kap_g,kap_b,lambda_r,lambda_g,lambda_b,"
                                   "c_r,c_g,c_b,k_r,k_g,k_b,theta0_r,theta0_g,theta0_b,error_r,error_g,error_b";

struct FitRow {
    std::string name;
    std::vector<float> numbers;

    glm::vec3 rgb(size_t first) const { return {numbers[first], numbers[first + 1], numbers[first + 2]}; }
};

std::vector<std::string> splitAtCommas(const std::string& line)
{
    std::vector<std::string> fields;
    std::istringstream stream(line);
    for (std::string field; std::getline(stream, field, ',');) {
        fields.push_back(field);
    }
    return fields;
}

// Excel and Windows end lines with a carriage return.
bool readLine(std::istream& stream, std::string& line)
{
    if (!std::getline(stream, line)) {
        return false;
    }
    if (!line.empty() && line.back() == '\r') {
        line.pop_back();
    }
    return true;
}

FitRow parseFit(const std::filesystem::path& csv, int lineNumber, const std::string& line, size_t columns)
{
    std::vector<std::string> fields = splitAtCommas(line);
    if (fields.size() != columns) {
        throw Error(csv, fmt::format("line {} has {} fields", lineNumber, fields.size()), fmt::format("{}", columns));
    }
    FitRow row{fields[0], {}};
    for (size_t i = 1; i < fields.size(); ++i) {
        float number = 0;
        const char* end = fields[i].data() + fields[i].size();
        auto [stop, problem] = std::from_chars(fields[i].data(), end, number);
        if (problem != std::errc() || stop != end) {
            throw Error(csv, fmt::format("line {}: \"{}\" is no number", lineNumber, fields[i]),
                        "plain decimal numbers");
        }
        row.numbers.push_back(number);
    }
    return row;
}

std::vector<FitRow> loadFits(const std::filesystem::path& csv, const std::string& header)
{
    std::ifstream stream(csv);
    std::string line;
    if (!stream || !readLine(stream, line)) {
        throw Error(csv, "cannot be read", "a table of published fits");
    }
    if (line != header) {
        throw Error(csv, "has another header", fmt::format("\"{}\"", header));
    }
    size_t columns = splitAtCommas(header).size();
    std::vector<FitRow> rows;
    for (int lineNumber = 2; readLine(stream, line); ++lineNumber) {
        if (!line.empty()) {
            rows.push_back(parseFit(csv, lineNumber, line, columns));
        }
    }
    if (rows.empty()) {
        throw Error(csv, "holds no fit", "one material a line");
    }
    return rows;
}

} // namespace

std::vector<NamedBrdf> loadAbcFits(const std::filesystem::path& csv)
{
    std::vector<NamedBrdf> fits;
    for (const FitRow& r : loadFits(csv, kAbcHeader)) {
        fits.push_back({r.name, AbcModel{r.rgb(0), r.rgb(3), r.numbers[6], r.numbers[7], r.numbers[8]}});
    }
    return fits;
}

std::vector<NamedBrdf> loadSgdFits(const std::filesystem::path& csv)
{
    std::vector<NamedBrdf> fits;
    for (const FitRow& r : loadFits(csv, kSgdHeader)) {
        fits.push_back({r.name, SgdModel{.rhoD = r.rgb(0),
                                         .rhoS = r.rgb(3),
                                         .alpha = r.rgb(6),
                                         .p = r.rgb(9),
                                         .F0 = r.rgb(12),
                                         .F1 = r.rgb(15),
                                         .kap = r.rgb(18),
                                         .lambda = r.rgb(21),
                                         .c = r.rgb(24),
                                         .k = r.rgb(27),
                                         .theta0 = r.rgb(30)}});
    }
    return fits;
}

} // namespace nacre
