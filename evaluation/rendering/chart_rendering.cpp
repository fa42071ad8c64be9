#include "evaluation/rendering/chart_rendering.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include <fmt/format.h>

#include "engine/files/error.h"
#include "engine/files/measures.h"
#include "engine/files/stopwatch.h"
#include "engine/gpu/renderer.h"
#include "engine/scene/reference.h"
#include "evaluation/rendering/bench_surfaces.h"

namespace nacre {

namespace {

struct Box {
    int left = 0, top = 0, width = 0, height = 0;
};

// Around the pixels that have a material; the whole picture where none has.
Box objectBox(const Surface& surface)
{
    const int width = surface.normals.width, height = surface.normals.height;
    int left = width, top = height, right = -1, bottom = -1;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            if (surface.labels[surface.normals.index(x, y)] != Surface::kNoMaterial) {
                left = std::min(left, x), right = std::max(right, x);
                top = std::min(top, y), bottom = std::max(bottom, y);
            }
        }
    }
    return right < 0 ? Box{0, 0, width, height} : Box{left, top, right - left + 1, bottom - top + 1};
}

// Wall clock around a call that returns once the device is done.
template <class Call> float milliseconds(Call&& call)
{
    return static_cast<float>(1000 * secondsOf(call));
}

// One setting: a renderer of its own, so that settings can take turns, frame by frame.
class Contender {
public:
    Contender(const Context& context, const Surface& surface, const std::vector<BallSize>& measured,
              const RenderingSetting& setting)
        : setting_(setting), renderer_(context)
    {
        const bool hasOwnSize = setting.isBall && setting.size.display > 0;
        renderer_.setSurface(surface, hasOwnSize ? std::vector<BallSize>(measured.size(), setting.size) : measured);
        renderer_.setPath(setting.isBall ? RenderPath::ball : RenderPath::direct);
    }

    // False where that path cannot draw the surface: too sharp a highlight for any ball, or no room for balls so large.
    bool canDraw()
    {
        try {
            return renderer_.pathTaken() == (setting_.isBall ? RenderPath::ball : RenderPath::direct);
        } catch (const Error&) {
            return false;
        }
    }

    const RenderingSetting& setting() const { return setting_; }

    Image picture(std::span<const Light> lights, const Display& display)
    {
        steady_.clear(), moved_.clear();
        renderer_.setLights(lights);
        renderer_.setDisplay(display);
        return renderer_.picture();
    }

    void drawRound(size_t lights, int turn)
    {
        moved_.push_back(milliseconds([&] {
            renderer_.setLights(benchLights(static_cast<int>(lights), turn));
            renderer_.drawPicture();
        }));
        steady_.push_back(milliseconds([&] {
            renderer_.forgetPicture();
            renderer_.drawPicture();
        }));
    }

    double steadyMs() { return quantile(steady_, 0.5); }
    double movedMs() { return quantile(moved_, 0.5); }

private:
    RenderingSetting setting_;
    Renderer renderer_;
    std::vector<float> steady_, moved_; // ms of every round
};

// The frames of one capture. Settings take turns, so that what else the machine does slows all of them alike.
class FrameMeasurement {
public:
    FrameMeasurement(const Context& context, Surface surface, const RenderingChoices& choices)
        : choices_(choices), scene_{std::move(surface), {}, {0, 0, 1}}
    {
        for (const uint8_t label : scene_.surface.labels) {
            mask_.push_back(label != Surface::kNoMaterial);
        }
        std::vector<BallSize> measured;
        for (const Material& material : scene_.surface.materials) {
            measured.push_back(measuredBallSize(material.table));
            hasBall_ = hasBall_ && measured.back().radiance > 0;
        }
        for (const RenderingSetting& setting : choices.settings) {
            auto contender = std::make_unique<Contender>(context, scene_.surface, measured, setting);
            if (contender->canDraw()) {
                contenders_.push_back(std::move(contender));
            }
        }
    }

    std::vector<RenderingRow> measure(size_t lights, const std::function<bool()>& isStopped)
    {
        scene_.lights = benchLights(static_cast<int>(lights), 0);
        const Frame radiance = renderReference(scene_);
        const Display display{automaticExposure(radiance), kToneSrgb};
        const Image reference = displayCodes(radiance, display);
        std::vector<RenderingRow> rows;
        for (const auto& contender : contenders_) {
            RenderingRow& row = rows.emplace_back();
            row.setting = contender->setting();
            row.lights = lights;
            row.isDefault = isDefault(row.setting);
            row.psnr = picturePsnr(contender->picture(scene_.lights, display), reference, mask_);
        }
        drawRounds(lights, isStopped);
        for (size_t i = 0; i < rows.size(); ++i) {
            rows[i].steadyMs = contenders_[i]->steadyMs();
            rows[i].movedMs = contenders_[i]->movedMs();
        }
        return rows;
    }

private:
    // Of slow frames fewer are enough.
    void drawRounds(size_t lights, const std::function<bool()>& isStopped)
    {
        constexpr double kLongest = 15; // seconds
        constexpr int kFewest = 3;
        const Stopwatch watch;
        for (int round = 0; round < choices_.repeats; ++round) {
            const double seconds = watch.seconds();
            if ((round >= kFewest && seconds > kLongest) || (round > 0 && isStopped())) {
                return;
            }
            for (const auto& contender : contenders_) {
                contender->drawRound(lights, round + 1);
            }
        }
    }

    // The automatic path takes the measured ball where there is one.
    bool isDefault(const RenderingSetting& setting) const
    {
        return hasBall_ ? setting == RenderingSetting{true, {}} : !setting.isBall;
    }

    const RenderingChoices& choices_;
    Scene scene_;
    std::vector<uint8_t> mask_;
    bool hasBall_ = true;
    std::vector<std::unique_ptr<Contender>> contenders_;
};

} // namespace

Surface tiledSurface(const Surface& surface, int width, int height)
{
    const Box box = objectBox(surface);
    Surface tiled;
    tiled.normals = NormalMap(width, height);
    tiled.labels.resize(tiled.normals.normals.size());
    tiled.materials = surface.materials;
    const bool hasAlbedo = !surface.albedo.values.empty();
    if (hasAlbedo) {
        tiled.albedo = Image(width, height, 3);
    }
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const int fromX = box.left + x % box.width, fromY = box.top + y % box.height;
            const size_t to = tiled.normals.index(x, y), from = surface.normals.index(fromX, fromY);
            tiled.normals.normals[to] = surface.normals.normals[from];
            tiled.normals.confidence[to] = surface.normals.confidence[from];
            tiled.labels[to] = surface.labels[from];
            if (hasAlbedo) {
                tiled.albedo.setRgb(x, y, surface.albedo.rgb(fromX, fromY));
            }
        }
    }
    return tiled;
}

size_t countSettings(const RenderingChoices& choices)
{
    return choices.settings.size() * choices.lights.size();
}

void measureRendering(const Capture& capture, const AcquireOptions& options, const RenderingChoices& choices,
                      const std::string& device, const ChartObserver& observer, std::vector<RenderingRow>& rows)
{
    const size_t all = countSettings(choices);
    size_t done = 0;
    observer.progress("a surface to draw", done, all);
    const Context context(device);
    const Acquisition acquisition = acquire(capture, options, [](const std::string&, double) {});
    FrameMeasurement frames(context, tiledSurface(acquisition.surface, choices.width, choices.height), choices);
    for (const size_t lights : choices.lights) {
        if (observer.isStopped()) {
            return;
        }
        observer.progress(fmt::format("frames under {} lights", lights), done, all);
        for (RenderingRow& row : frames.measure(lights, observer.isStopped)) {
            row.capture = capture.name;
            rows.push_back(std::move(row));
        }
        done += choices.settings.size();
    }
}

} // namespace nacre
