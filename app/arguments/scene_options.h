#pragma once
#include <functional>

#include <CLI/CLI.hpp>

#include "engine/scene/scene_description.h"
#include "engine/scene/scene_names.h"

namespace nacre {

// A scene from the command line: that of a state file, over which the options win that are given.
class SceneOptions {
public:
    // What the help says of options that all commands have.
    struct Help {
        std::string material, onto, light, environment, exposure, show, layer, state;
    };

    // Options are bound to this object, which has to stay where it is.
    void addTo(CLI::App& command, const Help& help);

    // One more option, whose value has a type that CLI11 knows.
    template <class Value, class Field>
    CLI::Option* add(CLI::App& command, const std::string& name, Field SceneDescription::*field,
                     const std::string& help)
    {
        return command.add_option_function<Value>(
            name,
            [this, field](const Value& value) {
                given_.push_back([field, value](SceneDescription& scene) { scene.*field = value; });
            },
            help);
    }

    // One whose text `parse` understands.
    template <class Field, class Parse>
    CLI::Option* addParsed(CLI::App& command, const std::string& name, Field SceneDescription::*field, Parse parse,
                           const std::string& help)
    {
        return command.add_option_function<std::string>(
            name,
            [this, field, parse](const std::string& text) {
                given_.push_back([field, parse, text](SceneDescription& scene) { scene.*field = parse(text); });
            },
            help);
    }

    CLI::Option* addFlag(CLI::App& command, const std::string& name, std::optional<bool> SceneDescription::*field,
                         const std::string& help);

    // Throws Error where the state file or a value is not understood.
    SceneDescription description() const;

    std::filesystem::path fits; // of fitted models
    std::string device;

private:
    std::filesystem::path state_;
    std::vector<std::function<void(SceneDescription&)>> given_;
};

} // namespace nacre
