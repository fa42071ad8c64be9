#include "assets/synth/orthographic_view.h"

#include <algorithm>

#include "engine/files/parallel_for.h"

namespace nacre {

glm::dvec2 OrthographicView::planePoint(uint32_t pixel) const
{
    double halfSide = 0.5 * std::min(normals.width, normals.height);
    double x = pixel % normals.width + 0.5;
    double y = pixel / normals.width + 0.5; // row 0 is the top
    return {(x - 0.5 * normals.width) / halfSide, (0.5 * normals.height - y) / halfSide};
}

OrthographicView viewOf(const BumpySolid& solid, int width, int height, int threads)
{
    OrthographicView view;
    view.normals = NormalMap(width, height);
    view.depth.assign(view.normals.normals.size(), 0.0);
    view.mask.assign(view.depth.size(), 0);
    parallelFor(height, 8, threads, [&](size_t first, size_t last) {
        for (uint32_t pixel = first * width; pixel < last * width; ++pixel) {
            glm::dvec2 p = view.planePoint(pixel);
            if (std::optional<double> z = solid.depthTowardsCamera(p.x, p.y)) {
                view.mask[pixel] = 1;
                view.depth[pixel] = *z;
                view.normals.normals[pixel] = glm::vec3(solid.normal({p, *z}));
                view.normals.confidence[pixel] = 1.0f;
            }
        }
    });
    for (uint32_t pixel = 0; pixel < view.mask.size(); ++pixel) {
        if (view.mask[pixel]) {
            view.seen.push_back(pixel);
        }
    }
    return view;
}

} // namespace nacre
