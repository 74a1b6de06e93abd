// Names of modes by their direction, as measured buildings are described: L (along x), T (along y), R (about z),
// V (along z), each counted from the lowest frequency: L1, T1, L2, ...
#pragma once

#include <string>
#include <vector>

#include "models/model.hpp"

namespace nsframe {

// Where a mode moves: kinetic energy of the levels' mean translations and of their rotation about z, in the order
// x, y, rotation, z; not normalised.
Eigen::Vector4d directional_energy(const Model& model, const Structure& structure, const VectorX& shape);

// `shapes`: columns in the structure's free DOFs.
std::vector<std::string> name_modes(const Model& model, const Structure& structure, const MatrixX& shapes);

// Participation (effective mass over total mass) in x, y and z of one mass-normalised mode.
Vector3 participation(const Model& model, const Structure& structure, const VectorX& shape);

}  // namespace nsframe
