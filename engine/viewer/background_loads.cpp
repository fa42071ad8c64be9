#include "engine/viewer/background_loads.h"

#include <utility>

#include <fmt/format.h>

#include "engine/files/error.h"
#include "engine/materials/material_specification.h"

namespace nacre {

namespace {

// Whether what is loaded for one state serves the other.
bool sharesScene(const ViewState& a, const ViewState& b)
{
    return loadedPart(a) == loadedPart(b) && a.wipe.material == b.wipe.material && a.environment == b.environment;
}

// By what differs from what is loaded.
std::string nameOfLoading(const ViewState& wanted, const ViewState& loaded)
{
    std::filesystem::path named = wanted.material.empty() ? wanted.surface : std::filesystem::path(wanted.material);
    if (wanted.environment != loaded.environment) {
        named = wanted.environment;
    } else if (!wanted.onto.empty() && wanted.onto != loaded.onto) {
        named = wanted.onto;
    } else if (wanted.wipe.material != loaded.wipe.material) {
        named = wanted.wipe.material;
    }
    return fmt::format("reading {}", named.filename().string());
}

} // namespace

Loader::~Loader()
{
    cancel();
    for (const auto& task : abandoned_) {
        task->thread.join();
    }
}

void Loader::start(std::string name, Job job)
{
    cancel();
    name_ = std::move(name);
    current_ = std::make_unique<Task>();
    Task& task = *current_;
    task.thread = std::thread([&task, job = std::move(job), this] {
        try {
            task.takeOver = job(task.progress);
        } catch (...) {
            task.problem = std::current_exception();
        }
        task.hasEnded = true;
        wake_();
    });
}

void Loader::cancel()
{
    if (current_) {
        current_->progress.isCancelled = true;
        abandoned_.push_back(std::move(current_));
    }
}

bool Loader::finish()
{
    std::erase_if(abandoned_, [](const std::unique_ptr<Task>& task) {
        const bool hasEnded = task->hasEnded;
        if (hasEnded) {
            task->thread.join();
        }
        return hasEnded;
    });
    if (!current_ || !current_->hasEnded) {
        return false;
    }
    const std::unique_ptr<Task> task = std::move(current_);
    task->thread.join();
    if (task->problem) {
        std::rethrow_exception(task->problem);
    }
    task->takeOver();
    return true;
}

BackgroundLoads::BackgroundLoads(const SceneSource& source, const ViewState& shown, std::function<void()> wake)
    : source_(source), shown_(shown), requested_(shown), sceneLoader_(wake), photographLoader_(wake),
      materialLoader_(wake)
{
    if (source_.photographs) {
        photographLoader_.start("reading photographs", [this](Loader::Progress& progress) {
            source_.photographs->load([&](float share) { progress.share = share; }, progress.isCancelled);
            return [this] { done_.photographs = photographsAreRead_ = true; };
        });
    }
}

void BackgroundLoads::follow(const ViewState& wanted, const Choices& choices, const LoadedScene& scene)
{
    if (sharesScene(wanted, requested_)) {
        return;
    }
    requested_ = wanted;
    if (sharesScene(requested_, shown_)) {
        sceneLoader_.cancel();
        return;
    }
    sceneLoader_.start(nameOfLoading(requested_, shown_),
                       [this, state = requested_, choices, before = shown_, scene](Loader::Progress&) {
                           const LoadedScene loaded = loadScene(source_, state, choices, before, scene);
                           return [this, state, loaded] { done_.scene = Scene{state, loaded, {}}; };
                       });
}

void BackgroundLoads::open(const std::filesystem::path& folder)
{
    sceneLoader_.start(fmt::format("reading {}", folder.filename().string()), [this, folder](Loader::Progress&) {
        Choices choices = choicesOfSurface(folder);
        addTargets(choices, source_.shapes);
        ViewState state;
        state.surface = folder;
        resolveCaptured(state, choices.captured);
        const LoadedScene loaded = loadScene(source_, state, choices, {}, {});
        return [this, opened = Scene{state, loaded, choices}] {
            done_.scene = opened;
            requested_ = opened.state;
            triedMaterials_.clear();
            photographLoader_.cancel();
            photographsAreRead_ = false; // they are another surface's
        };
    });
}

const Loader* BackgroundLoads::busy() const
{
    return readsScene() ? &sceneLoader_ : readsPhotographs() ? &photographLoader_ : nullptr;
}

std::string BackgroundLoads::cancel()
{
    Loader& loader = readsScene() ? sceneLoader_ : photographLoader_;
    loader.cancel();
    return loader.name();
}

BackgroundLoads::Done BackgroundLoads::finish(const Choices& choices)
{
    try {
        if (!sceneLoader_.finish()) {
            photographLoader_.finish();
        }
    } catch (const Error& e) {
        done_.problem = e.what();
    }
    try {
        materialLoader_.finish();
    } catch (const Error&) {
        // The list does without this picture; choosing the material says what is wrong with it.
    }
    if (done_.scene) {
        shown_ = done_.scene->state;
    }
    readNextMaterial(done_.scene && done_.scene->choices ? *done_.scene->choices : choices);
    return std::exchange(done_, {});
}

void BackgroundLoads::readNextMaterial(const Choices& choices)
{
    for (const MaterialChoice& choice : choices.materials) {
        const std::string specification = choice.specification;
        if (materialLoader_.isBusy() || !triedMaterials_.insert(specification).second) {
            continue;
        }
        const std::string named = specification.empty() ? choices.surface.string() : specification;
        materialLoader_.start("", [this, specification, named](Loader::Progress&) {
            const auto material =
                std::make_shared<const Material>(loadMaterial(named, fitsFolderFrom(source_.inputs.fits)));
            return [this, specification, material] { done_.material.emplace(specification, material); };
        });
    }
}

} // namespace nacre
