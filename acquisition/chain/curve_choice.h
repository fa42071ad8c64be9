#pragma once
#include "acquisition/chain/acquire_options.h"

namespace nacre {

// The capture, with the transfer curve that its photographs tell where neither files nor user do: photographs of 8 bits
// are read as linear and as sRGB, calibrated and reconciled each way, and what is assumed gives way where Lambert's law
// explains the other far better. Reads the photographs twice then.
Capture withToldCurve(const Capture& capture, const AcquireOptions& options);

// Warnings that a wrong curve explains as well begin with it, where the curve is assumed.
void nameAssumedCurve(const Capture& capture, std::vector<Finding>& findings);

} // namespace nacre
