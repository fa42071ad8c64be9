#include <algorithm>
#include <cstring>
#include <functional>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/arguments/destinations.h"
#include "app/commands/commands.h"
#include "engine/brdf/brdf_tabulation.h"
#include "engine/files/error.h"
#include "engine/files/measures.h"
#include "engine/files/stopwatch.h"
#include "engine/gpu/floor_pass.h"
#include "engine/gpu/renderer.h"
#include "evaluation/rendering/bench_surfaces.h"

namespace nacre {

namespace {

constexpr int kCapturedLights = 36; // of the residual layer

struct BenchArguments {
    std::vector<std::string> sizes = {"1280x720", "1920x1080", "3840x2160"};
    std::vector<int> lights = {1, 4, 16, 256};
    int repeats = 15;
    int mostDirectLights = 16; // a direct frame under more takes seconds
    float alpha = LambertGgx{}.alpha;
    bool shadows = false; // of direct frames
    int residual = 40;    // components
    bool bake = false;    // instead of frames
    std::string device;
    std::filesystem::path json;
    bool force = false;
};

double milliseconds(const std::function<void()>& call)
{
    return 1000 * secondsOf(call);
}

struct Measured {
    double ms = 0;       // median of the wall clock around the call, which returns once the device is done
    double perFloor = 0; // median of its ratio to the floor drawn right after it
};

// The first two rounds are warm-up, in which shaders are compiled.
Measured measured(int repeats, const std::function<void()>& call, const std::function<void()>& floor)
{
    std::vector<float> times, ratios;
    for (int i = -2; i < repeats; ++i) {
        const double time = milliseconds(call), under = floor ? milliseconds(floor) : 1;
        if (i >= 0) {
            times.push_back(static_cast<float>(time));
            ratios.push_back(static_cast<float>(time / under));
        }
    }
    return {quantile(times, 0.5), quantile(ratios, 0.5)};
}

class Bench {
public:
    explicit Bench(const BenchArguments& arguments)
        : arguments_(arguments),
          context_(arguments.device), material_{"rough", tabulatedBrdf(LambertGgx{.alpha = arguments.alpha}), {}}
    {
    }

    nlohmann::ordered_json run()
    {
        results_["device"] = context_.info().name;
        results_["driver"] = context_.info().driver;
        results_["materialGgxAlpha"] = arguments_.alpha;
        results_["repeats"] = arguments_.repeats;
        for (const std::string& text : arguments_.sizes) {
            const PictureSize size = sizeFromArgument("--size", text);
            requirePictureSize(context_, size.width, size.height);
            fmt::print("\n{}x{}, ms (times the floor)\n", size.width, size.height);
            measureSize(size, fmt::format("{}x{}", size.width, size.height));
        }
        return results_;
    }

private:
    void measureSize(const PictureSize& size, const std::string& prefix)
    {
        std::vector<char> from(size_t{4} * size.width * size.height, 1), to(from.size());
        record(prefix + ".memoryCopyMs", "memory copy of a picture", {},
               [&] { std::memcpy(to.data(), from.data(), from.size()); });
        for (const bool modulated : {false, true}) {
            const Surface surface = benchSurface(size, material_, modulated);
            const std::string kind = modulated ? "modulated" : "plain";
            FloorPass pass(context_, surface);
            const auto floor = [&] { pass.draw(); };
            record(fmt::format("{}.{}.floorMs", prefix, kind),
                   modulated ? "floor: normals, albedo, label" : "floor: normals", {}, floor);
            measureRenderer(surface, fmt::format("{}.{}", prefix, kind), floor);
        }
    }

    void measureRenderer(const Surface& surface, const std::string& prefix, const std::function<void()>& floor)
    {
        Renderer renderer(context_);
        renderer.setSurface(surface);
        renderer.setDisplay({.toneCurve = isPlain(surface) ? kToneSrgb : kToneFilmic});
        const BallSize size = renderer.ballSizes()[0];
        results_[prefix + ".ballTexels"] = size.radiance;
        results_[prefix + ".ballTexelsShown"] = size.display;
        for (const int lights : arguments_.lights) {
            const std::string name = fmt::format("{}.{}lights", prefix, lights);
            int turn = 0;
            renderer.setPath(RenderPath::ball);
            record(name + ".ballRebuildMs", fmt::format("ball rebuild, {} lights", lights), floor, [&] {
                renderer.setLights(benchLights(lights, ++turn));
                renderer.updateBalls();
            });
            record(name + ".ballFrameMs", fmt::format("ball frame, {} lights", lights), floor, [&] {
                renderer.forgetPicture();
                renderer.drawPicture();
            });
            results_[prefix + ".ballDeviceMiB"] = static_cast<double>(renderer.deviceBytes()) / 1048576.0;
            if (lights <= arguments_.mostDirectLights) {
                renderer.setPath(RenderPath::direct);
                record(name + ".directFrameMs", fmt::format("direct frame, {} lights", lights), floor, [&] {
                    renderer.forgetPicture();
                    renderer.drawPicture();
                });
            }
        }
        if (arguments_.residual > 0) {
            measureResidual(renderer, surface, prefix);
        }
        if (arguments_.shadows) {
            measureShadows(renderer, surface, prefix, floor);
        }
    }

    // Frames with a residual layer, each beside the same frame without one; the layer costs the same under any lights.
    void measureResidual(Renderer& without, Surface surface, const std::string& prefix)
    {
        const int lights = arguments_.lights.front();
        const double before = static_cast<double>(without.deviceBytes());
        const int toneCurve = isPlain(surface) ? kToneSrgb : kToneFilmic;
        surface.residual = benchResidual(surface, arguments_.residual, kCapturedLights);
        Renderer with(context_);
        with.setSurface(std::move(surface), without.ballSizes());
        with.setDisplay({.toneCurve = toneCurve});
        for (const RenderPath path : {RenderPath::ball, RenderPath::direct}) {
            if (path == RenderPath::direct && lights > arguments_.mostDirectLights) {
                continue;
            }
            for (Renderer* renderer : {&with, &without}) {
                renderer->setLights(benchLights(lights, 0));
                renderer->setPath(path);
            }
            const auto draw = [](Renderer& renderer) {
                renderer.forgetPicture();
                renderer.drawPicture();
            };
            const bool isBall = path == RenderPath::ball;
            const Measured found = measured(
                isBall ? arguments_.repeats : slowRepeats(), [&] { draw(with); }, [&] { draw(without); });
            const std::string name =
                fmt::format("{}.{}lights.residual{}Frame", prefix, lights, isBall ? "Ball" : "Direct");
            results_[name + "Ms"] = found.ms;
            results_[name + "PerFrameWithout"] = found.perFloor;
            fmt::print("  {:<36}{:9.2f}  ({:.2f} times the frame without)\n",
                       fmt::format("{} frame, {} components", isBall ? "ball" : "direct", arguments_.residual),
                       found.ms, found.perFloor);
        }
        results_[prefix + ".residualDeviceMiB"] = (static_cast<double>(with.deviceBytes()) - before) / 1048576.0;
    }

    int slowRepeats() const { return std::max(1, arguments_.repeats / 5); }

    void measureShadows(Renderer& renderer, Surface surface, const std::string& prefix,
                        const std::function<void()>& floor)
    {
        const NormalMap& normals = surface.normals;
        const Image height = wavyHeight(normals.width, normals.height);
        const double before = static_cast<double>(renderer.deviceBytes());
        record(prefix + ".horizonBakeMs", "horizons, baked once", {},
               [&] { surface.horizon = horizonMap(normals, height); });
        const std::vector<BallSize> sizes = renderer.ballSizes();
        renderer.setSurface(std::move(surface), sizes);
        for (const int lights : arguments_.lights) {
            if (lights <= arguments_.mostDirectLights) {
                renderer.setLights(benchLights(lights, 0));
                record(fmt::format("{}.{}lights.shadowedDirectFrameMs", prefix, lights),
                       fmt::format("direct frame, {} lights, shadows", lights), floor, [&] {
                           renderer.forgetPicture();
                           renderer.drawPicture();
                       });
            }
        }
        results_[prefix + ".horizonDeviceMiB"] = (static_cast<double>(renderer.deviceBytes()) - before) / 1048576.0;
    }

    void record(const std::string& name, const std::string& words, const std::function<void()>& floor,
                const std::function<void()>& call)
    {
        const bool isSlow = name.ends_with("irectFrameMs") || name.ends_with("horizonBakeMs");
        const int repeats = isSlow ? slowRepeats() : arguments_.repeats;
        const Measured found = measured(repeats, call, floor);
        results_[name] = found.ms;
        if (floor) {
            results_[name.substr(0, name.size() - 2) + "PerFloor"] = found.perFloor;
        }
        fmt::print("  {:<36}{:9.2f}{}\n", words, found.ms, floor ? fmt::format("  ({:.2f})", found.perFloor) : "");
    }

    const BenchArguments& arguments_;
    Context context_;
    Material material_;
    nlohmann::ordered_json results_;
};

nlohmann::ordered_json runBakeBench()
{
    const BakeBenchmark bench = benchmarkBake(0);
    const double ratio = bench.bake / bench.bareQueries;
    fmt::print("{} texels from {} samples, k = {}\n  {:<32}{:9.0f}\n  {:<32}{:9.0f}  ({:.2f})\n", bench.texels,
               bench.samples, bench.k, "nearest neighbours alone, ms", 1e3 * bench.bareQueries, "bake, ms",
               1e3 * bench.bake, ratio);
    return {{"bakeTexels", bench.texels}, {"bakeSamples", bench.samples},
            {"bakeNeighbours", bench.k},  {"bareQueriesMs", 1e3 * bench.bareQueries},
            {"bakeMs", 1e3 * bench.bake}, {"bakePerBareQueries", ratio}};
}

void runBench(const BenchArguments& arguments)
{
    requireSummary(arguments.json, arguments.force);
    if (arguments.repeats < 1 || arguments.repeats > 1000) {
        throw Error("", fmt::format("--repeats {} is out of range", arguments.repeats), "1 to 1000", Error::kUsage);
    }
    for (const int count : arguments.lights) {
        if (count < 1 || count > 100000) {
            throw Error("", fmt::format("--lights {} is out of range", count), "1 to 100000", Error::kUsage);
        }
    }
    if (arguments.residual < 0 || arguments.residual > kMostResidualComponents) {
        throw Error("", fmt::format("--residual-components {} is out of range", arguments.residual),
                    fmt::format("0 to {}", kMostResidualComponents), Error::kUsage);
    }
    const nlohmann::ordered_json results = arguments.bake ? runBakeBench() : Bench(arguments).run();
    writeSummary(arguments.json, results);
}

} // namespace

void addBenchCommand(CLI::App& app)
{
    auto arguments = std::make_shared<BenchArguments>();
    CLI::App* command = app.add_subcommand("bench", "What frames cost on this machine, against their floors");
    command->add_option("--size", arguments->sizes, "Sizes of the frames, WxH (default: 1280x720 1920x1080 3840x2160)");
    command->add_option("--lights", arguments->lights, "Numbers of lights (default: 1 4 16 256)");
    command
        ->add_option("--repeats", arguments->repeats,
                     "Number of frames behind each median; a fifth of it for slow ones")
        ->capture_default_str();
    command
        ->add_option("--most-direct-lights", arguments->mostDirectLights,
                     "Largest number of lights that are drawn directly")
        ->capture_default_str();
    command->add_option("--alpha", arguments->alpha, "GGX roughness of the material")
        ->check(CLI::Range(0.001f, 1.0f))
        ->capture_default_str();
    command->add_flag("--shadows", arguments->shadows, "Direct frames with cast shadows as well");
    command
        ->add_option("--residual-components", arguments->residual,
                     "Number of components of a residual layer, drawn beside frames without (0: none)")
        ->capture_default_str();
    command->add_flag("--bake", arguments->bake,
                      "Table from a million samples, against the search for their neighbours alone, instead of frames");
    command->add_option(
        "--device", arguments->device,
        "Vulkan device: number or part of its name in nacre info (default: $NACRE_DEVICE, else the best)");
    command->add_option("--json", arguments->json, "File for the figures as JSON")->option_text("OUT.json");
    command->add_flag("--force", arguments->force, "Replacement of an existing output");
    command->footer("Example:\n  nacre bench --size 1920x1080 --json bench.json");
    command->callback([arguments] { runBench(*arguments); });
}

} // namespace nacre
