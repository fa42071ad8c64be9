#include "engine/viewer/loader.h"

#include <utility>

namespace nacre {

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

} // namespace nacre
