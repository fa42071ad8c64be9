#pragma once
#include <CLI/CLI.hpp>

namespace nacre {

// Each adds one subcommand, whose callback runs it; errors are thrown to main.
void addInfoCommand(CLI::App& app);
void addRenderCommand(CLI::App& app);
void addViewCommand(CLI::App& app);
void addTargetCommand(CLI::App& app);
void addMaterialsCommand(CLI::App& app);
void addTransferCommand(CLI::App& app);
void addSynthCommand(CLI::App& app);
void addAcquireCommand(CLI::App& app);
void addNormalsCommand(CLI::App& app);
void addCalibrateCommand(CLI::App& app);
void addBrdfCommand(CLI::App& app);
void addCompareCommand(CLI::App& app);
void addImportCommand(CLI::App& app);
void addExportCommand(CLI::App& app);
void addStressCommand(CLI::App& app);
void addEvaluateCommand(CLI::App& app);
void addChartCommand(CLI::App& app);
void addDemoCommand(CLI::App& app);
void addBenchCommand(CLI::App& app);

// All of them, in the order and under the headings of --help.
void addCommands(CLI::App& app);

} // namespace nacre
