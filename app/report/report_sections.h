#pragma once
#include <string>

#include "app/report/acquire_report.h"

namespace nacre {

// Parts of an acquisition's page, as HTML.

std::string paragraph(const std::string& text, const std::string& kind = "");
std::string heading(const std::string& text);

// Where the lights stand, and how they were calibrated.
std::string lightSection(const ReportSubject& subject);
// How the observations under each light were judged.
std::string verdictSection(const ReportSubject& subject);
// How well every photograph is predicted.
std::string predictionSection(const ReportSubject& subject);

} // namespace nacre
