#pragma once
#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

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

} // namespace nacre
