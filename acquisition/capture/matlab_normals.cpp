#include "acquisition/capture/matlab_normals.h"

#include <cmath>
#include <memory>

#include <glm/geometric.hpp>
#include <matio.h>

#include "engine/files/error.h"

namespace nacre {

namespace {

using MatFile = std::unique_ptr<mat_t, decltype(&Mat_Close)>;
using MatVariable = std::unique_ptr<matvar_t, decltype(&Mat_VarFree)>;

double valueAt(const matvar_t& variable, size_t index)
{
    return variable.class_type == MAT_C_SINGLE ? static_cast<const float*>(variable.data)[index]
                                               : static_cast<const double*>(variable.data)[index];
}

bool isNormalArray(const matvar_t& variable)
{
    return variable.rank == 3 && variable.dims[2] == 3 &&
           (variable.class_type == MAT_C_DOUBLE || variable.class_type == MAT_C_SINGLE) && variable.data;
}

// Column-major: index = row + height * (column + width * channel).
NormalMap mapOf(const matvar_t& variable)
{
    const size_t height = variable.dims[0], width = variable.dims[1];
    NormalMap map(static_cast<int>(width), static_cast<int>(height));
    for (size_t y = 0; y < height; ++y) {
        for (size_t x = 0; x < width; ++x) {
            glm::dvec3 n;
            for (int c = 0; c < 3; ++c) {
                n[c] = valueAt(variable, y + height * (x + width * c));
            }
            const double size = glm::length(n);
            if (std::isfinite(size) && size > 0.5) {
                map.normals[y * width + x] = glm::vec3(n / size);
                map.confidence[y * width + x] = 1;
            }
        }
    }
    return map;
}

} // namespace

NormalMap loadTrueNormals(const std::filesystem::path& file)
{
    if (file.extension() != ".mat") {
        return loadNormalMap(file);
    }
    const MatFile mat(Mat_Open(file.c_str(), MAT_ACC_RDONLY), &Mat_Close);
    const char* expected = "a MATLAB file with a real h x w x 3 array of normals";
    if (!mat) {
        throw Error(file, "cannot be read", expected);
    }
    while (true) {
        const MatVariable variable(Mat_VarReadNext(mat.get()), &Mat_VarFree);
        if (!variable) {
            throw Error(file, "holds no normals", expected);
        }
        if (isNormalArray(*variable)) {
            return mapOf(*variable);
        }
    }
}

} // namespace nacre
