#pragma once
#include <span>
#include <vector>

#include <Eigen/Core>
#include <glm/vec2.hpp>

namespace nacre {

// Smoothing thin-plate splines over the plane of lights, affine part free (Wahba, Spline Models for Observational Data,
// 1990, Eq. 2.4.24). They are linear in what was observed, so that one matrix serves all pixels.

// [term, light]: the spline's factors of each node's kernel, of 1, x and y, for an observation of 1 under that light.
// The nodes must not lie on a line; without a penalty the spline goes through what was observed.
Eigen::MatrixXd splineFactors(std::span<const glm::vec2> nodes, double penalty);

// What the factors count at a point: each node's kernel, then 1, x and y.
Eigen::RowVectorXd splineTerms(std::span<const glm::vec2> nodes, const glm::vec2& point);

// [light, other light]: what the other lights' observations say of each light's, by the spline through them alone; 0 on
// the diagonal. Lights inside the others' hull by the closed form (Wahba, Eq. 4.2.9), those at its edge by a spline
// without them, asked as ResidualLights asks beyond the hull.
Eigen::MatrixXd leaveOneOutWeights(std::span<const glm::vec2> nodes, double penalty);

} // namespace nacre
