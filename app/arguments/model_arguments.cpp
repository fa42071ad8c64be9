#include "app/arguments/model_arguments.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/files/error.h"
#include "engine/files/text_files.h"

namespace nacre {

void InterpolationArguments::addTo(CLI::App& command)
{
    command
        .add_option("--interpolation", method,
                    "Interpolation between samples: local-linear, or paper (mean of the nearest in raw angles)")
        ->capture_default_str()
        ->group("BRDF");
    command.add_option("--k", k, "Number of nearest samples; auto chooses it, and the metric, by held-out lights")
        ->option_text("N|auto")
        ->capture_default_str()
        ->group("BRDF");
    command
        .add_option("--unseen", unseen,
                    "What stands where nothing was measured: prior (over published materials, given what was; for "
                    "local-linear in half-difference coordinates) or nearest (samples)")
        ->capture_default_str()
        ->group("BRDF");
}

InterpolationOptions InterpolationArguments::options(int threads) const
{
    InterpolationOptions options;
    options.method = interpolationMethodFromName(method);
    options.threads = threads;
    options.automatic = k == "auto";
    if (unseen != "prior" && unseen != "nearest") {
        throw Error("", "--unseen " + unseen + " is unknown", "prior or nearest", Error::kUsage);
    }
    options.completed = unseen == "prior" && options.method == InterpolationMethod::localLinear;
    if (!options.automatic) {
        if (k.empty() || k.size() > 6 || k.find_first_not_of("0123456789") != std::string::npos) {
            throw Error("", "--k " + k + " is not understood", "a number of samples, or auto", Error::kUsage);
        }
        options.k = std::stoi(k);
    }
    return options;
}

void LadderArguments::addTo(CLI::App& command)
{
    command
        .add_option("--tolerance", tolerance,
                    "Least PSNR of the model against the interpolated samples, e.g. 45dB: the smallest that has it is "
                    "kept (default: the full table)")
        ->option_text("DB");
    command
        .add_option("--budget-bytes", budget,
                    "Largest size of the model without its coverage, e.g. 64KiB: the best below it is kept")
        ->option_text("BYTES")
        ->group("BRDF");
}

LadderOptions LadderArguments::options(int threads) const
{
    LadderOptions options;
    options.threads = threads;
    if (!tolerance.empty()) {
        const bool unit = tolerance.size() > 2 && tolerance.ends_with("dB");
        const auto value = parseNumber(unit ? tolerance.substr(0, tolerance.size() - 2) : tolerance);
        if (!value || !(*value > 0) || *value > 200) {
            throw Error("", "--tolerance " + tolerance + " is not understood", "decibels above 0, e.g. 45dB",
                        Error::kUsage);
        }
        options.toleranceDecibels = *value;
    }
    if (!budget.empty()) {
        const size_t digits = std::min(budget.find_first_not_of("0123456789"), budget.size());
        const std::string unit = budget.substr(digits);
        const double factor = unit.empty() || unit == "B" ? 1
                              : unit == "kB"              ? 1e3
                              : unit == "MB"              ? 1e6
                              : unit == "KiB"             ? 1024
                              : unit == "MiB"             ? 1048576
                                                          : 0;
        const auto value = parseNumber(budget.substr(0, digits));
        if (!value || factor == 0 || *value * factor < 1 || *value * factor > 1e12) {
            throw Error("", "--budget-bytes " + budget + " is not understood", "a number of bytes, e.g. 65536 or 64KiB",
                        Error::kUsage);
        }
        options.budgetBytes = static_cast<size_t>(*value * factor);
    }
    return options;
}

void ResidualArguments::addTo(CLI::App& command)
{
    command
        .add_option("--cast-shadows", shadows,
                    "Shadows of the object on itself: auto finds a height that casts them and keeps it where it "
                    "predicts held-out photographs better, off does not")
        ->option_text("auto|off [" + shadows + "]")
        ->capture_default_str();
    command
        .add_option("--residual", choice,
                    "Residual layer, for what the BRDF cannot explain on this object: auto keeps it where it predicts "
                    "held-out photographs better, difference always")
        ->option_text("auto|difference|none [" + choice + "]")
        ->capture_default_str();
}

ResidualOptions ResidualArguments::options(const LadderOptions& ladder) const
{
    ResidualOptions options{.choice = ResidualChoice::automatic,
                            .toleranceDecibels = ladder.toleranceDecibels,
                            .budgetBytes = ladder.budgetBytes,
                            .threads = ladder.threads};
    if (choice == "difference" || choice == "none") {
        options.choice = choice == "none" ? ResidualChoice::none : ResidualChoice::difference;
    } else if (choice != "auto") {
        throw Error("", "--residual " + choice + " is not known", "auto, difference or none", Error::kUsage);
    }
    return options;
}

bool ResidualArguments::castShadows() const
{
    if (shadows != "auto" && shadows != "off") {
        throw Error("", "--cast-shadows " + shadows + " is no choice", "auto or off", Error::kUsage);
    }
    return shadows == "auto";
}

std::string describe(const CastShadowReport& report)
{
    if (!report.whyNot.empty() || report.castShare == 0) {
        return report.whyNot.empty() ? "" : fmt::format("shadows      none: {}\n", report.whyNot);
    }
    const std::string judged =
        fmt::format("photographs left out: {:.1f} dB without, {:.1f} dB with the shadows that a height casts",
                    report.psnr, report.shadowedPsnr);
    return fmt::format("shadows      {:.1f} % of what faces a light lies in one; {}{}\n", 100 * report.castShare,
                       judged,
                       report.areKept ? "" : fmt::format(": not kept, {:.1f} dB more are asked for", kShadowMargin));
}

std::string describe(const ResidualReport& report)
{
    if (report.choice == ResidualChoice::none) {
        return {};
    }
    if (!report.whyNot.empty()) {
        return fmt::format("layer        none: {}\n", report.whyNot);
    }
    const std::string judged =
        fmt::format("photographs left out one by one: {:.1f} dB by the BRDF, {:.1f} dB with a layer",
                    report.fit.brdfPsnr, report.fit.layerPsnr);
    if (report.components == 0) {
        return fmt::format("layer        none: {}; {:.1f} dB more are asked for\n", judged, kResidualMargin);
    }
    return fmt::format(
        "layer        {} components, {:.1f} KiB, {:.1f} dB of the photographs kept; {}, which trusts the "
        "BRDF by {:.0f} %\n",
        report.components, static_cast<double>(report.bytes) / 1024, report.capturedPsnr, judged,
        100 * report.fit.trust);
}

nlohmann::json documentOf(const CastShadowReport& report)
{
    return {{"kept", report.areKept},
            {"castShare", report.castShare},
            {"leftOutWithout", report.psnr},
            {"leftOutWith", report.shadowedPsnr},
            {"whyNot", report.whyNot}};
}

nlohmann::json documentOf(const ResidualReport& report)
{
    return {{"components", report.components},
            {"bytes", report.bytes},
            {"trust", report.fit.trust},
            {"leftOutByBrdf", report.fit.brdfPsnr},
            {"leftOutWithLayer", report.fit.layerPsnr},
            {"capturedPsnr", report.capturedPsnr},
            {"whyNot", report.whyNot}};
}

} // namespace nacre
