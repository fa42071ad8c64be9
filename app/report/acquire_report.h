#pragma once
#include <filesystem>

#include "evaluation/held_out/capture_review.h"

namespace nacre {

// What a report is made of; all are referred to.
struct ReportSubject {
    const Capture& capture;
    const Acquisition& acquisition;
    const CaptureReview& review;
};

// One page for people: photographs, lights, verdicts, normals, the BRDF's coverage and model, and how well every
// photograph is predicted. It needs no other file, no network and no script.
std::string reportOf(const ReportSubject& subject);

// `folder` is made where it is missing.
void saveReport(const std::filesystem::path& folder, const std::string& html);

} // namespace nacre
