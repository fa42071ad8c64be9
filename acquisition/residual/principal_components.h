#pragma once
#include <Eigen/Core>

namespace nacre {

// Orthonormal columns, most energetic first, that span the rows of X best in the least-squares sense: its right
// singular vectors, by subspace iteration (Halko, Martinsson, Tropp, Finding Structure with Randomness, 2011,
// algorithm 4.4). No mean is subtracted. The same for the same X; signs are such that each column's largest entry is
// positive.
Eigen::MatrixXf principalComponents(const Eigen::MatrixXf& rows, int most);

} // namespace nacre
