#include "engine/target/mesh_raster.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include "engine/files/parallel_for.h"
#include "engine/target/mesh_passes.h"
#include "engine/target/relief.h"

namespace nacre {
namespace {

glm::vec3 normalOfSample(const glm::vec4& sample)
{
    return {sample.x, sample.y, std::sqrt(std::max(0.0f, 1 - sample.x * sample.x - sample.y * sample.y))};
}

// What the relief's picture has there beside the normal.
void takeFrom(const Surface& front, size_t from, size_t pixel, Surface& surface)
{
    surface.normals.confidence[pixel] = front.normals.confidence[from];
    surface.labels[pixel] = front.labels[from];
    for (size_t c = 0; c < 3 && !front.albedo.values.empty(); ++c) {
        surface.albedo.values[3 * pixel + c] = front.albedo.values[3 * from + c];
    }
}

void resolvePixel(const glm::vec4* first, size_t pitch, int samplesPerSide, size_t pixel, const Surface* front,
                  Surface& surface)
{
    const glm::vec4* nearest = nullptr;
    int covered = 0;
    for (int k = 0; k < samplesPerSide * samplesPerSide; ++k) {
        const glm::vec4& sample = first[k / samplesPerSide * pitch + k % samplesPerSide];
        if (sample.w > 0) {
            ++covered;
            nearest = !nearest || sample.z > nearest->z ? &sample : nearest;
        }
    }
    if (2 * covered < samplesPerSide * samplesPerSide || !nearest) {
        return;
    }
    glm::vec3 normal(0);
    float height = 0, count = 0;
    for (int k = 0; k < samplesPerSide * samplesPerSide; ++k) {
        const glm::vec4& sample = first[k / samplesPerSide * pitch + k % samplesPerSide];
        const bool isSamePart = front ? sample.w > 0 : sample.w == nearest->w;
        // What is farther behind is another surface, and the mean with it would be a normal that neither has.
        if (isSamePart && nearest->z - sample.z <= kSameSurface) {
            normal += normalOfSample(sample);
            height += sample.z;
            ++count;
        }
    }
    surface.normals.normals[pixel] = glm::normalize(normal);
    surface.normals.confidence[pixel] = 1;
    surface.height.values[pixel] = height / count;
    if (front) {
        takeFrom(*front, static_cast<size_t>(nearest->w - 0.5f), pixel, surface);
    } else {
        surface.labels[pixel] = static_cast<uint8_t>(nearest->w - 0.5f);
    }
}

// Samples of shaders/mesh_view.frag (x, y of the normal, height, label + 1; 0 = nothing), samplesPerSide each way in a
// pixel, to normals, heights and labels. A pixel takes the label of its nearest sample and the mean of the samples that
// lie on the same surface; it has data where at least half of it is covered. Of the relief of `front`, unless null,
// each has what its nearest sample's pixel has there.
Surface resolvedSurface(const glm::vec4* samples, int width, int height, int samplesPerSide, const Surface* front)
{
    Surface surface;
    surface.normals = NormalMap(width, height);
    surface.height = Image(width, height, 1);
    surface.labels.assign(surface.height.pixelCount(), Surface::kNoMaterial);
    if (front && !front->albedo.values.empty()) {
        surface.albedo = Image(width, height, 3, 1.0f);
    }
    const size_t pitch = static_cast<size_t>(width) * samplesPerSide;
    parallelFor(height, 32, 0, [&](size_t top, size_t bottom) {
        for (size_t y = top; y < bottom; ++y) {
            for (size_t x = 0; x < static_cast<size_t>(width); ++x) {
                resolvePixel(samples + (y * pitch + x) * samplesPerSide, pitch, samplesPerSide, y * width + x, front,
                             surface);
            }
        }
    });
    return surface;
}

constexpr VkDeviceSize kLargestTarget = 512 << 20; // bytes of samples

int samplesPerSideFor(const Context& context, int width, int height)
{
    const VkDeviceSize bytes = VkDeviceSize{4} * width * height * sizeof(glm::vec4);
    const uint32_t side = 2 * static_cast<uint32_t>(std::max(width, height));
    const bool fits = side <= context.limits().maxImageDimension2D &&
                      side <= context.limits().maxViewportDimensions[0] &&
                      bytes <= std::min(kLargestTarget, context.largestAllocation());
    return fits ? 2 : 1;
}

VkExtent3D extentOf(int width, int height, int samplesPerSide)
{
    return {static_cast<uint32_t>(width * samplesPerSide), static_cast<uint32_t>(height * samplesPerSide), 1};
}

// The part of the picture that a box of the mesh's axes lies in.
VkRect2D boundsOf(const std::array<glm::vec3, 2>& box, const MeshView& view)
{
    glm::dvec2 low(std::numeric_limits<double>::max()), high(-low);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 at(box[corner & 1].x, box[corner >> 1 & 1].y, box[corner >> 2].z);
        const glm::dvec2 pixel(view.pixelPoint(at));
        low = glm::min(low, pixel);
        high = glm::max(high, pixel);
    }
    const glm::dvec2 most(view.width, view.height);
    const glm::dvec2 first = glm::clamp(glm::floor(low), glm::dvec2(0), most);
    const glm::dvec2 size = glm::clamp(glm::ceil(high), first, most) - first;
    return {.offset = {static_cast<int32_t>(first.x), static_cast<int32_t>(first.y)},
            .extent = {static_cast<uint32_t>(size.x), static_cast<uint32_t>(size.y)}};
}

} // namespace

// Read back, and made a surface.
class MeshRaster::Samples {
public:
    Samples(const Context& context, const Mesh& mesh, int width, int height, int samplesPerSide)
        : context_(context), front_(mesh.front.get()),
          target_(makeTarget(context, extentOf(width, height, samplesPerSide), kFloatFormat)),
          passes_(context, mesh, MeshPasses::Draws::samples, target_, samplesPerSide, kCopiedFrom),
          readback_(context, VkDeviceSize{target_.extent().width} * target_.extent().height * sizeof(glm::vec4),
                    VK_BUFFER_USAGE_TRANSFER_DST_BIT)
    {
    }

    Surface draw(const MeshView& view)
    {
        passes_.draw(view);
        context_.run([&](VkCommandBuffer commands) {
            const VkBufferImageCopy copy{.imageSubresource = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .layerCount = 1},
                                         .imageExtent = target_.extent()};
            vkCmdCopyImageToBuffer(commands, target_.image(), kCopiedFrom.layout, readback_.get(), 1, &copy);
            makeVisibleToHost(commands, readback_);
        });
        return resolvedSurface(static_cast<const glm::vec4*>(readback_.mapped()), view.width, view.height,
                               passes_.samplesPerSide(), front_);
    }

private:
    const Context& context_;
    const Surface* front_;
    Texture target_;
    MeshPasses passes_;
    Buffer readback_;
};

// Left on the device.
class MeshRaster::Pixels {
public:
    Pixels(const Context& context, const Mesh& mesh, int width, int height)
        : pixels_(std::make_shared<PixelTextures>(
              PixelTextures{.normals = makeTarget(context, extentOf(width, height, 1), MeshPasses::kPackedFormat)})),
          passes_(context, mesh, MeshPasses::Draws::packedNormals, pixels_->normals, 1, kSampled)
    {
    }

    VkExtent3D extent() const { return pixels_->normals.extent(); }

    std::shared_ptr<const PixelTextures> draw(const MeshView& view, const std::array<glm::vec3, 2>& box)
    {
        passes_.draw(view);
        pixels_->shown = boundsOf(box, view);
        return pixels_;
    }

private:
    std::shared_ptr<PixelTextures> pixels_;
    MeshPasses passes_;
};

MeshRaster::MeshRaster(const Context& context, std::shared_ptr<const Mesh> mesh, int width, int height)
    : context_(context), mesh_(std::move(mesh)), width_(width), height_(height)
{
    requirePictureSize(context, width, height);
    box_ = {glm::vec3(std::numeric_limits<float>::max()), glm::vec3(std::numeric_limits<float>::lowest())};
    for (const uint32_t index : mesh_->indices) {
        box_ = {glm::min(box_[0], mesh_->positions[index]), glm::max(box_[1], mesh_->positions[index])};
    }
}

MeshRaster::~MeshRaster() = default;

Surface MeshRaster::draw(const MeshView& view, bool isCoarse)
{
    std::unique_ptr<Samples>& samples = isCoarse ? coarse_ : samples_;
    if (!samples) {
        samples = std::make_unique<Samples>(context_, isCoarse ? coarseMesh() : *mesh_, width_, height_,
                                            isCoarse ? 1 : samplesPerSideFor(context_, width_, height_));
    }
    Surface surface = samples->draw(view);
    if (mesh_->front) {
        return surface;
    }
    for (const MeshPart& part : mesh_->parts) {
        if (surface.parts.size() < Surface::kNoMaterial) {
            surface.parts.push_back(part.name);
        }
    }
    return surface;
}

const Mesh& MeshRaster::coarseMesh()
{
    if (!coarseMesh_) {
        coarseMesh_ = mesh_->front ? coarseRelief(mesh_) : mesh_;
    }
    return *coarseMesh_;
}

std::shared_ptr<const PixelTextures> MeshRaster::drawPixels(const MeshView& view)
{
    const VkExtent3D wanted = extentOf(view.width, view.height, 1);
    if (!pixels_ || pixels_->extent().width != wanted.width || pixels_->extent().height != wanted.height) {
        pixels_ = std::make_unique<Pixels>(context_, coarseMesh(), view.width, view.height);
    }
    return pixels_->draw(view, box_);
}

Surface rasterisedMesh(const Context& context, const Mesh& mesh, const MeshView& view)
{
    const std::shared_ptr<const Mesh> borrowed(std::shared_ptr<const Mesh>(), &mesh);
    return MeshRaster(context, borrowed, view.width, view.height).draw(view);
}

} // namespace nacre
