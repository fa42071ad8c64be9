#pragma once
#include <optional>
#include <string>

#include <CLI/CLI.hpp>
#include <nlohmann/json_fwd.hpp>

#include "evaluation/charts/budget_search.h"

namespace nacre {

// How long an acquisition may take: --budget-time.
struct BudgetArguments {
    std::string time; // "2s", "500ms", "1min"; a number alone is seconds

    // `command` has the options that the search chooses, which may not be given beside it.
    void addTo(CLI::App& command);
    std::optional<double> seconds() const; // empty where it was not asked for; throws usage Errors
};

// What was tried, what it took and what is kept: a line each.
std::string describe(const BudgetResult& found, double budgetSeconds);
nlohmann::json documentOf(const BudgetResult& found, double budgetSeconds);

} // namespace nacre
