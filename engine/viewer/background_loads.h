#pragma once
#include <atomic>
#include <exception>
#include <set>
#include <thread>

#include "engine/viewer/scene_source.h"

namespace nacre {

// Reads in the background, so that the window goes on. One job at a time: a new one takes the place of the last.
class Loader {
public:
    struct Progress {
        std::atomic<float> share{0}; // that is done; 0 where that is not known
        std::atomic<bool> isCancelled{false};
    };
    // Runs in the background. Answers what is to be done with the result, by the thread that calls finish().
    using Job = std::function<std::function<void()>(Progress&)>;

    // `wake` is called from the background when a job has ended.
    explicit Loader(std::function<void()> wake) : wake_(std::move(wake)) {}
    ~Loader();
    Loader(const Loader&) = delete;
    Loader& operator=(const Loader&) = delete;

    void start(std::string name, Job job);
    // The result of a job that is cancelled is thrown away when it comes.
    void cancel();

    bool isBusy() const { return current_ != nullptr; }
    const std::string& name() const { return name_; }
    float share() const { return current_ ? current_->progress.share.load() : 0.0f; }

    // Takes over what has ended, if anything; throws what the job threw. True where something was taken over.
    bool finish();

private:
    struct Task {
        Progress progress;
        std::atomic<bool> hasEnded{false};
        std::function<void()> takeOver;
        std::exception_ptr problem;
        std::thread thread;
    };

    std::function<void()> wake_;
    std::string name_;
    std::unique_ptr<Task> current_;
    std::vector<std::unique_ptr<Task>> abandoned_; // cancelled, still running
};

// What a window reads while it goes on: scenes that its state asks for, photographs, materials for small pictures.
class BackgroundLoads {
public:
    // `shown`: the state whose scene is there already. Photographs are read from the start.
    BackgroundLoads(const SceneSource& source, const ViewState& shown, std::function<void()> wake);

    // Starts reading where the state has come to ask for something else than what is shown, `scene`.
    void follow(const ViewState& wanted, const Choices& choices, const LoadedScene& scene);
    // Another surface, with its own choices and without photographs.
    void open(const std::filesystem::path& folder);
    // What busy() answers; answers its name.
    std::string cancel();

    struct Scene {
        ViewState state;
        LoadedScene scene;
        std::optional<Choices> choices; // of another surface that was opened
    };
    struct Done {
        std::optional<Scene> scene; // the one that is shown from now on
        bool photographs = false;   // are there now
        std::string problem;        // with either; what is shown stays
        std::optional<std::pair<std::string, std::shared_ptr<const Material>>> material; // and its specification
    };
    // What has been read since; begins the next material of the choices.
    Done finish(const Choices& choices);

    const ViewState& shown() const { return shown_; }
    // What is shown stays, whatever the state asked for.
    void keep(const ViewState& state) { requested_ = state; }

    bool readsScene() const { return sceneLoader_.isBusy(); }
    bool readsPhotographs() const { return photographLoader_.isBusy(); }
    const Loader* busy() const; // what the user may cancel; null: nothing is read
    const Photographs* photographs() const { return photographsAreRead_ ? source_.photographs.get() : nullptr; }

private:
    void readNextMaterial(const Choices& choices);

    const SceneSource& source_;
    ViewState shown_, requested_;
    bool photographsAreRead_ = false;
    std::set<std::string> triedMaterials_;
    Done done_;
    Loader sceneLoader_; // gone first: its jobs refer to what is above
    Loader photographLoader_;
    Loader materialLoader_;
};

} // namespace nacre
