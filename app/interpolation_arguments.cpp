#include "app/interpolation_arguments.h"

#include "engine/scene/error.h"

namespace nacre {

void InterpolationArguments::addTo(CLI::App& command)
{
    command
        .add_option("--interpolation", method,
                    "Between samples: local-linear, or paper (mean of the nearest in raw angles)")
        ->capture_default_str();
    command
        .add_option("--k", k,
                    "Nearest samples that are used; auto finds k and the metric that predict held-out lights best")
        ->option_text("N|auto")
        ->capture_default_str();
}

InterpolationOptions InterpolationArguments::options(int threads) const
{
    InterpolationOptions options;
    options.method = interpolationMethodFromName(method);
    options.threads = threads;
    options.automatic = k == "auto";
    if (!options.automatic) {
        if (k.empty() || k.size() > 6 || k.find_first_not_of("0123456789") != std::string::npos) {
            throw Error("", "--k " + k + " is not understood", "a number of samples, or auto", Error::kUsage);
        }
        options.k = std::stoi(k);
    }
    return options;
}

} // namespace nacre
