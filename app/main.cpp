#include <cstdio>
#include <exception>

#include "app/commands.h"
#include "engine/scene/error.h"

namespace {

int runCommandLine(int argc, char** argv)
{
    CLI::App app("Nacre measures materials from photographs under a moving light and relights them.");
    app.set_version_flag("--version", "nacre " NACRE_VERSION);
    app.require_subcommand(1);
    nacre::addAcquireCommand(app);
    nacre::addNormalsCommand(app);
    nacre::addRenderCommand(app);
    nacre::addSynthCommand(app);
    nacre::addInfoCommand(app);
    nacre::addCompareCommand(app);
    nacre::addDemoCommand(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        return app.exit(e) == 0 ? 0 : nacre::Error::kUsage;
    }
    return 0;
}

} // namespace

int main(int argc, char** argv)
{
    try {
        return runCommandLine(argc, argv);
    } catch (const nacre::Error& e) {
        std::fprintf(stderr, "nacre: %s\n", e.what());
        return e.exitCode();
    } catch (const std::exception& e) {
        std::fprintf(stderr, "nacre: internal error: %s\n", e.what());
        return 70;
    }
}
