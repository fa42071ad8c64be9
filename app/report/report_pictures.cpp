#include "app/report/report_pictures.h"

#include "app/report/debug_pictures.h"
#include "evaluation/charts/html_page.h"
#include "evaluation/held_out/capture_review.h"
#include "shared/false_colour.h"

namespace nacre {

namespace {
constexpr int kSide = 480; // pixels, of pictures that show the surface
}

ReportPicture ReportPictures::photograph(const Image& picture, const std::string& caption)
{
    const std::filesystem::path file = folder_.path() / "picture.jpg";
    saveImage(file, picture, PixelType::uint8);
    return {dataUri(file, "jpeg"), caption};
}

ReportPicture ReportPictures::png(const Image& picture, const std::string& caption)
{
    const std::filesystem::path file = folder_.path() / "picture.png";
    saveImage(file, picture, PixelType::uint8);
    return {dataUri(file, "png"), caption};
}

std::vector<ReportPicture> ReportPictures::ofSurface(const Capture& capture, const Acquisition& acquisition)
{
    const NormalMap& normals = acquisition.surface.normals;
    Image colours(normals.width, normals.height, 3), confidence(normals.width, normals.height, 3),
        labels(normals.width, normals.height, 3);
    for (int y = 0; y < normals.height; ++y) {
        for (int x = 0; x < normals.width; ++x) {
            const size_t i = normals.index(x, y);
            const uint8_t label = acquisition.surface.labels[i];
            confidence.setRgb(x, y, glm::vec3(normals.confidence[i]));
            if (normals.confidence[i] > 0) {
                colours.setRgb(x, y, 0.5f * normals.normals[i] + 0.5f);
            }
            if (label != Surface::kNoMaterial) {
                labels.setRgb(x, y, labelColour(label));
            }
        }
    }
    std::vector<ReportPicture> pictures{
        png(thumbnailOf(colours, capture, kSide), "normals: red, green, blue are (x, y, z), -1 to 1"),
        png(thumbnailOf(confidence, capture, kSide), "confidence: black 0, white 1")};
    if (acquisition.surface.materials.size() > 1) {
        pictures.push_back(png(thumbnailOf(labels, capture, kSide), "materials"));
    }
    return pictures;
}

std::vector<ReportPicture> ReportPictures::ofMaterials(const std::vector<Material>& materials)
{
    std::vector<ReportPicture> pictures;
    for (const Material& material : materials) {
        pictures.push_back(png(ballPicture(material.table), material.name + " on a sphere, lit from the upper left"));
    }
    return pictures;
}

} // namespace nacre
