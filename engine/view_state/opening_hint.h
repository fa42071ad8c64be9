#pragma once

namespace nacre {

// What a window says when it opens, until the user begins or a while has passed. Times are seconds since then.
class OpeningHint {
public:
    static constexpr double kSeconds = 8, kFadeSeconds = 1;
    static constexpr double kStepSeconds = 0.1; // in which it fades

    // It need not stay any longer.
    void leave(double now);
    // 1, then down to 0.
    float opacity(double now) const;
    // Seconds until it may look otherwise, of one that is seen.
    double rest(double now) const;

private:
    double fadesAt_ = kSeconds;
};

} // namespace nacre
