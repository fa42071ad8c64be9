#include "app/commands/commands.h"

#include <utility>
#include <vector>

namespace nacre {

void addCommands(CLI::App& app)
{
    using Adders = std::vector<void (*)(CLI::App&)>;
    const std::pair<const char*, Adders> groups[] = {
        {"Measure",
         {addAcquireCommand, addNormalsCommand, addCalibrateCommand, addMaterialsCommand, addBrdfCommand,
          addImportCommand, addExportCommand}},
        {"Render", {addRenderCommand, addTransferCommand, addTargetCommand}},
        {"Look", {addViewCommand, addInfoCommand}},
        {"Judge", {addEvaluateCommand, addChartCommand, addStressCommand, addBenchCommand, addCompareCommand}},
        {"Make", {addSynthCommand, addDemoCommand}},
    };
    for (const auto& [heading, adders] : groups) {
        for (const auto add : adders) {
            add(app);
            app.get_subcommands({}).back()->group(heading);
        }
    }
}

} // namespace nacre
