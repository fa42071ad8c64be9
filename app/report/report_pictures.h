#pragma once
#include <string>
#include <vector>

#include "acquisition/chain/acquire.h"
#include "engine/files/whole_file.h"

namespace nacre {

struct ReportPicture {
    std::string data; // as the address of an <img>
    std::string caption;
};

// Pictures as text within a page, each written into a temporary folder on the way.
class ReportPictures {
public:
    ReportPicture photograph(const Image& picture, const std::string& caption); // JPEG

    // Normals, confidence, and labels where there are several materials; cut to the object.
    std::vector<ReportPicture> ofSurface(const Capture& capture, const Acquisition& acquisition);
    // Each on a sphere under one light from the upper left.
    std::vector<ReportPicture> ofMaterials(const std::vector<Material>& materials);

private:
    ReportPicture png(const Image& picture, const std::string& caption);

    TemporaryFolder folder_;
};

} // namespace nacre
