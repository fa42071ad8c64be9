#include "engine/target/mesh_raster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include "engine/files/parallel_for.h"
#include "engine/gpu/buffer.h"
#include "engine/gpu/pass.h"
#include "engine/target/normal_map_scale.h"
#include "mesh_view_frag.h"
#include "mesh_view_vert.h"
#include "shared/mesh_layout.h"

namespace nacre {
namespace {

// Within a pixel the height of one surface changes by less, up to 79 degrees; what is farther behind is another one,
// and the mean with it would be a normal that neither has.
constexpr float kSameSurface = 5; // pixels

glm::vec3 normalOfSample(const glm::vec4& sample)
{
    return {sample.x, sample.y, std::sqrt(std::max(0.0f, 1 - sample.x * sample.x - sample.y * sample.y))};
}

void resolvePixel(const glm::vec4* first, size_t pitch, int samplesPerSide, size_t pixel, Surface& surface)
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
        if (sample.w == nearest->w && nearest->z - sample.z <= kSameSurface) {
            normal += normalOfSample(sample);
            height += sample.z;
            ++count;
        }
    }
    surface.normals.normals[pixel] = glm::normalize(normal);
    surface.normals.confidence[pixel] = 1;
    surface.height.values[pixel] = height / count;
    surface.labels[pixel] = static_cast<uint8_t>(nearest->w - 0.5f);
}

// Samples of shaders/mesh_view.frag (x, y of the normal, height, label + 1; 0 = nothing), samplesPerSide each way in a
// pixel, to normals, heights and labels. A pixel takes the label of its nearest sample and the mean of the samples that
// lie on the same surface; it has data where at least half of it is covered.
Surface resolvedSurface(const glm::vec4* samples, int width, int height, int samplesPerSide)
{
    Surface surface;
    surface.normals = NormalMap(width, height);
    surface.height = Image(width, height, 1);
    surface.labels.assign(surface.height.pixelCount(), Surface::kNoMaterial);
    const size_t pitch = static_cast<size_t>(width) * samplesPerSide;
    parallelFor(height, 32, 0, [&](size_t top, size_t bottom) {
        for (size_t y = top; y < bottom; ++y) {
            for (size_t x = 0; x < static_cast<size_t>(width); ++x) {
                resolvePixel(samples + (y * pitch + x) * samplesPerSide, pitch, samplesPerSide, y * width + x, surface);
            }
        }
    });
    return surface;
}

constexpr size_t kTrianglesPerUpload = 1 << 17;    // 18 MiB of vertices
constexpr VkDeviceSize kLargestTarget = 512 << 20; // bytes of samples

// One corner of a triangle as shaders/mesh_view.vert reads it.
struct MeshVertex {
    glm::vec3 point;
    glm::vec3 normal;
    glm::vec4 tangent;
    glm::vec2 uv;
};

VkVertexInputAttributeDescription attribute(int location, VkFormat format, size_t offset)
{
    return {.location = static_cast<uint32_t>(location),
            .binding = 0,
            .format = format,
            .offset = static_cast<uint32_t>(offset)};
}

const std::array kAttributes = {attribute(kMeshPoint, VK_FORMAT_R32G32B32_SFLOAT, offsetof(MeshVertex, point)),
                                attribute(kMeshNormal, VK_FORMAT_R32G32B32_SFLOAT, offsetof(MeshVertex, normal)),
                                attribute(kMeshTangent, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(MeshVertex, tangent)),
                                attribute(kMeshUv, VK_FORMAT_R32G32_SFLOAT, offsetof(MeshVertex, uv))};
const VertexInput kVertices{
    .shader = mesh_view_vert, .stride = sizeof(MeshVertex), .attributes = kAttributes, .depthFormat = kDepthFormat};
constexpr std::array kMeshBindings = {ShaderBinding{kBindingMeshNormalMap, kTextureInput}};
static_assert(kConstantMeshMapped == 0, "the first of the constants");

constexpr ImageUse kDepthTested{
    VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};

Texture uploadNormalMap(const Context& context, const NormalMap& map)
{
    std::vector<glm::vec4> texels(map.normals.size());
    for (size_t i = 0; i < texels.size(); ++i) {
        // Where the map has nothing the mesh's own normal stays.
        texels[i] = map.confidence[i] > 0 ? glm::vec4(map.normals[i], 0) : glm::vec4(0, 0, 1, 0);
    }
    const VkExtent3D extent{static_cast<uint32_t>(map.width), static_cast<uint32_t>(map.height), 1};
    return uploadTexture(context, VK_IMAGE_TYPE_2D, extent, kFloatFormat, texels);
}

} // namespace

// One target and what is drawn to it.
class MeshRaster::Passes {
public:
    Passes(const Context& context, const Mesh& mesh, int width, int height, int samplesPerSide)
        : context_(context), mesh_(mesh),
          samplesPerSide_(samplesPerSide), extent_{static_cast<uint32_t>(width * samplesPerSide),
                                                   static_cast<uint32_t>(height * samplesPerSide), 1},
          target_(makeTarget(context, extent_, kFloatFormat)),
          depth_(context,
                 {.extent = extent_, .format = kDepthFormat, .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT}),
          vertices_(context,
                    3 * std::min(std::max<size_t>(mesh.triangleCount(), 1), kTrianglesPerUpload) * sizeof(MeshVertex),
                    VK_BUFFER_USAGE_VERTEX_BUFFER_BIT),
          samples_(context, VkDeviceSize{extent_.width} * extent_.height * sizeof(glm::vec4),
                   VK_BUFFER_USAGE_TRANSFER_DST_BIT),
          nearest_(makeSampler(context, VK_FILTER_NEAREST)), noMap_(uploadNormalMap(context, NormalMap(1, 1))),

          pipelines_(context, {.fragmentShader = mesh_view_frag,
                               .bindings = kMeshBindings,
                               .pushConstantBytes = sizeof(MeshConstants),
                               .targetFormat = kFloatFormat,
                               .vertices = &kVertices})
    {
    }

    void drawParts(const MeshView& view)
    {
        view_ = view;
        maps_.clear(); // they are made for the size at which they are seen
        isEmpty_ = true;
        for (size_t part = 0; part < mesh_.parts.size(); ++part) {
            const MeshPart& drawn = mesh_.parts[part];
            const Texture* map = normalMapOf(drawn);
            const size_t label = std::min<size_t>(part, Surface::kNoMaterial - 1);
            for (size_t first = 0; first < drawn.indexCount; first += 3 * kTrianglesPerUpload) {
                const size_t count = std::min(3 * kTrianglesPerUpload, drawn.indexCount - first);
                fillVertices(drawn.firstIndex + first, count);
                context_.run([&](VkCommandBuffer commands) {
                    record(commands, static_cast<uint32_t>(count), static_cast<float>(label + 1), map);
                });
                isEmpty_ = false;
            }
        }
    }

    // x, y of the normal, height, label + 1 (0 = nothing) of each sample.
    const glm::vec4* read()
    {
        context_.run([&](VkCommandBuffer commands) {
            imageBarrier(commands, target_.image(), kDrawnTo, kCopiedFrom);
            const VkBufferImageCopy copy{.imageSubresource = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .layerCount = 1},
                                         .imageExtent = extent_};
            vkCmdCopyImageToBuffer(commands, target_.image(), kCopiedFrom.layout, samples_.get(), 1, &copy);
            makeVisibleToHost(commands, samples_);
        });
        return static_cast<const glm::vec4*>(samples_.mapped());
    }

    int samplesPerSide() const { return samplesPerSide_; }
    const Context& context() const { return context_; }

private:
    // Null: the part has none. Maps of several parts are uploaded once, at the size at which they are seen.
    const Texture* normalMapOf(const MeshPart& part)
    {
        if (!part.normalMap) {
            return nullptr;
        }
        const auto [at, isNew] = maps_.try_emplace(part.normalMap.get());
        if (isNew) {
            const double samplesPerUnit = view_.pixelsPerUnit * samplesPerSide_;
            at->second = uploadNormalMap(context_, seenNormalMap(mesh_, part, samplesPerUnit));
        }
        return &at->second;
    }

    void fillVertices(size_t firstIndex, size_t count)
    {
        auto* vertices = static_cast<MeshVertex*>(vertices_.mapped());
        const glm::mat3 turn(view_.turn);
        parallelFor(count, 1 << 14, 0, [&](size_t first, size_t last) {
            for (size_t i = first; i < last; ++i) {
                const uint32_t v = mesh_.indices[firstIndex + i];
                const glm::dvec3 p = view_.pixelPoint(mesh_.positions[v]);
                MeshVertex vertex{{samplesPerSide_ * p.x, samplesPerSide_ * p.y, p.z}, turn * mesh_.normals[v], {}, {}};
                if (!mesh_.tangents.empty()) {
                    const glm::vec4& tangent = mesh_.tangents[v];
                    vertex.tangent = glm::vec4(turn * glm::vec3(tangent), tangent.w);
                    vertex.uv = mesh_.uvs[v];
                }
                vertices[i] = vertex;
            }
        });
    }

    void beginRendering(VkCommandBuffer commands)
    {
        imageBarrier(commands, target_.image(), isEmpty_ ? kUnused : kDrawnTo, kDrawnTo);
        imageBarrier(commands, depth_.image(), isEmpty_ ? kUnused : kDepthTested, kDepthTested,
                     VK_IMAGE_ASPECT_DEPTH_BIT);
        const VkAttachmentLoadOp load = isEmpty_ ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
        const VkRenderingAttachmentInfo color{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                              .imageView = target_.view(),
                                              .imageLayout = kDrawnTo.layout,
                                              .loadOp = load,
                                              .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                                              .clearValue = {.color = {.float32 = {0, 0, 0, 0}}}};
        const VkRenderingAttachmentInfo depth{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                              .imageView = depth_.view(),
                                              .imageLayout = kDepthTested.layout,
                                              .loadOp = load,
                                              .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                                              .clearValue = {.depthStencil = {.depth = 1}}};
        const VkRect2D area{.extent = {extent_.width, extent_.height}};
        const VkRenderingInfo info{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                   .renderArea = area,
                                   .layerCount = 1,
                                   .colorAttachmentCount = 1,
                                   .pColorAttachments = &color,
                                   .pDepthAttachment = &depth};
        vkCmdBeginRendering(commands, &info);
        const VkViewport viewport{
            .width = static_cast<float>(extent_.width), .height = static_cast<float>(extent_.height), .maxDepth = 1};
        vkCmdSetViewport(commands, 0, 1, &viewport);
        vkCmdSetScissor(commands, 0, 1, &area);
    }

    void record(VkCommandBuffer commands, uint32_t vertexCount, float label, const Texture* map)
    {
        // A little beyond the nearest and the farthest, which rounding would clip.
        const auto reach = static_cast<float>(1.001 * (view_.nearest - view_.farthest) + 1);
        const MeshConstants constants{{extent_.width, extent_.height},
                                      static_cast<float>(view_.nearest) + 0.0005f * reach,
                                      1.001f * reach,
                                      static_cast<float>(samplesPerSide_),
                                      label};
        const Pipeline& pipeline = pipelines_.with({map != nullptr});
        beginRendering(commands);
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.get());
        const ShaderInput input = textureInput(kBindingMeshNormalMap, nearest_, map ? *map : noMap_);
        const VkWriteDescriptorSet write{.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                         .dstBinding = input.binding,
                                         .descriptorCount = 1,
                                         .descriptorType = kTextureInput,
                                         .pImageInfo = &input.image};
        context_.pushDescriptorSet(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.layout(), 0, 1, &write);
        vkCmdPushConstants(commands, pipeline.layout(), pipeline.constantStages(), 0, sizeof(constants), &constants);
        const VkBuffer buffer = vertices_.get();
        const VkDeviceSize offset = 0;
        vkCmdBindVertexBuffers(commands, 0, 1, &buffer, &offset);
        vkCmdDraw(commands, vertexCount, 1, 0, 0);
        vkCmdEndRendering(commands);
    }

    const Context& context_;
    const Mesh& mesh_;
    MeshView view_;
    int samplesPerSide_;
    VkExtent3D extent_;
    Texture target_;
    Texture depth_;
    Buffer vertices_;
    Buffer samples_; // read back
    Sampler nearest_;
    Texture noMap_;       // the shader has a place for one
    Pipelines pipelines_; // without and with a normal map
    std::map<const NormalMap*, Texture> maps_;
    bool isEmpty_ = true;
};

namespace {

int samplesPerSideFor(const Context& context, int width, int height)
{
    const VkDeviceSize bytes = VkDeviceSize{4} * width * height * sizeof(glm::vec4);
    const uint32_t side = 2 * static_cast<uint32_t>(std::max(width, height));
    const bool fits = side <= context.limits().maxImageDimension2D &&
                      side <= context.limits().maxViewportDimensions[0] &&
                      bytes <= std::min(kLargestTarget, context.largestAllocation());
    return fits ? 2 : 1;
}

} // namespace

MeshRaster::MeshRaster(const Context& context, std::shared_ptr<const Mesh> mesh, int width, int height)
    : mesh_(std::move(mesh))
{
    requirePictureSize(context, width, height);
    passes_ = std::make_unique<Passes>(context, *mesh_, width, height, samplesPerSideFor(context, width, height));
}

MeshRaster::~MeshRaster() = default;

Surface MeshRaster::draw(const MeshView& view, bool isCoarse)
{
    if (isCoarse && !coarse_) {
        coarse_ = std::make_unique<Passes>(passes_->context(), *mesh_, view.width, view.height, 1);
    }
    Passes& passes = isCoarse ? *coarse_ : *passes_;
    passes.drawParts(view);
    Surface surface = resolvedSurface(passes.read(), view.width, view.height, passes.samplesPerSide());
    for (const MeshPart& part : mesh_->parts) {
        if (surface.parts.size() < Surface::kNoMaterial) {
            surface.parts.push_back(part.name);
        }
    }
    return surface;
}

Surface rasterisedMesh(const Context& context, const Mesh& mesh, const MeshView& view)
{
    const std::shared_ptr<const Mesh> borrowed(std::shared_ptr<const Mesh>(), &mesh);
    return MeshRaster(context, borrowed, view.width, view.height).draw(view);
}

} // namespace nacre
