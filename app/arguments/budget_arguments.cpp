#include "app/arguments/budget_arguments.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/files/error.h"
#include "engine/files/text_files.h"

namespace nacre {
using Json = nlohmann::json;

void BudgetArguments::addTo(CLI::App& command)
{
    CLI::Option* option =
        command
            .add_option("--budget-time", time,
                        "Try what gives better surfaces in so much time, e.g. 2s, 500ms, 1min, judge them by every "
                        "seventh photograph, and keep the best; the surface is that of the kept options, but how many "
                        "are tried depends on the machine")
            ->option_text("TIME");
    for (const char* chosen : {"--normals", "--lights-given", "--interpolation", "--k", "--table-size"}) {
        option->excludes(command.get_option(chosen));
    }
}

std::optional<double> BudgetArguments::seconds() const
{
    if (time.empty()) {
        return std::nullopt;
    }
    constexpr double kLongest = 1e6;
    const size_t digits = std::min(time.find_first_not_of("0123456789."), time.size());
    const std::string unit = time.substr(digits);
    const double factor = unit.empty() || unit == "s" ? 1 : unit == "ms" ? 1e-3 : unit == "min" ? 60 : 0;
    const std::optional<double> value = parseNumber(time.substr(0, digits));
    if (!value || !(*value * factor > 0) || *value * factor > kLongest) {
        throw Error("", "--budget-time " + time + " is not understood", "a time above 0, e.g. 2s, 500ms or 1min",
                    Error::kUsage);
    }
    return *value * factor;
}

std::string describe(const BudgetResult& found, double budgetSeconds)
{
    std::string text =
        fmt::format("budget       {:g} s: {} candidates judged by {} photographs, {} not tried, {:.2f} s in all\n",
                    budgetSeconds, found.trials.size(), found.judges, found.untried, found.seconds);
    for (const BudgetTrial& trial : found.trials) {
        text += fmt::format("             {:6.2f} s  {}  {}\n", trial.seconds,
                            trial.psnr ? fmt::format("{:6.2f} dB", *trial.psnr) : trial.refusal,
                            commandLineOf(trial.candidate));
    }
    text += fmt::format("kept         {}{}{}\n", commandLineOf(found.kept), found.comment.empty() ? "" : "; ",
                        found.comment);
    return found.seconds > budgetSeconds
               ? text + fmt::format("warning: it took {:.2f} s, more than the budget\n", found.seconds)
               : text;
}

Json documentOf(const BudgetResult& found, double budgetSeconds)
{
    Json tried = Json::array();
    for (const BudgetTrial& trial : found.trials) {
        tried.push_back({{"options", commandLineOf(trial.candidate)}, {"seconds", trial.seconds}});
        if (trial.psnr) {
            tried.back()["heldOutPsnr"] = *trial.psnr;
        } else {
            tried.back()["refusal"] = trial.refusal;
        }
    }
    return {{"budgetSeconds", budgetSeconds}, {"seconds", found.seconds}, {"kept", commandLineOf(found.kept)},
            {"comment", found.comment},       {"untried", found.untried}, {"tried", tried}};
}

} // namespace nacre
