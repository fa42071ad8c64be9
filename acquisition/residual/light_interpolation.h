#pragma once
#include <span>

#include <Eigen/Core>
#include <glm/vec3.hpp>

namespace nacre {

// Kriging with a known mean of 0 over the directions of lights (Rasmussen, Williams, Gaussian Processes for Machine
// Learning, 2006): linear in what was observed, so that one matrix serves all pixels. Far from all nodes it says 0.

// [node, light]: factors of lightCovariance with each node, for an observation of 1 under that light (Eq. 2.25).
Eigen::MatrixXd interpolationFactors(std::span<const glm::vec3> nodes);

// [light, other light]: what the other lights' observations say of each light's, by the interpolation of them alone; 0
// on the diagonal (Eq. 5.12).
Eigen::MatrixXd leaveOneOutWeights(std::span<const glm::vec3> nodes);

} // namespace nacre
