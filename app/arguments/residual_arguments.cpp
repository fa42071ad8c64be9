#include "app/arguments/residual_arguments.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/files/error.h"

namespace nacre {

void ResidualArguments::addTo(CLI::App& command)
{
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

nlohmann::json documentOf(const ResidualReport& report)
{
    return {{"components", report.components},
            {"bytes", report.bytes},
            {"trust", report.fit.trust},
            {"penalty", report.fit.penalty},
            {"leftOutByBrdf", report.fit.brdfPsnr},
            {"leftOutWithLayer", report.fit.layerPsnr},
            {"capturedPsnr", report.capturedPsnr},
            {"whyNot", report.whyNot}};
}

} // namespace nacre
