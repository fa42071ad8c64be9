// Materials found on objects whose labels are known.
#include <algorithm>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "acquisition/chain/acquire.h"
#include "acquisition/segmentation/label_regions.h"
#include "assets/synth/synth_capture.h"
#include "engine/files/measures.h"
#include "engine/scene/reference.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"

namespace nacre {
namespace {

const Progress kSilent = [](const std::string&, double) {};

// White and black plastic of one chromaticity, the black glossier, and a red one: bumps, cast shadows, highlights.
SynthOptions threeMaterials()
{
    SynthOptions synth;
    synth.width = synth.height = 128;
    synth.material = "ggx:diffuse=0.7,0.7,0.7;specular=0.04,0.04,0.04;alpha=0.3";
    synth.patches = {"ggx:diffuse=0.03,0.03,0.03;specular=0.04,0.04,0.04;alpha=0.1",
                     "ggx:diffuse=0.6,0.12,0.08;specular=0.04,0.04,0.04;alpha=0.15"};
    synth.noise = 0.005;
    synth.giveLights = true;
    synth.sphereSize = 48; // not looked at
    return synth;
}

struct Synthesised {
    SynthScene scene;
    Capture capture;
};

Synthesised synthesise(const TempFolder& folder, const SynthOptions& options)
{
    Synthesised made{makeSynthScene(options), {}};
    writeSynthCapture(folder / "capture", made.scene, true);
    made.capture = loadCapture(folder / "capture");
    return made;
}

AcquireOptions finding(size_t count = 0)
{
    AcquireOptions options;
    options.segment = {SegmentSource::found, {}, count};
    options.normals.method = NormalMethod::consensus; // the quickest that survives highlights
    options.bake.size = {24, 8, 8};
    return options;
}

// Share of the true inner pixels whose found label is the one that most of their material have.
double agreement(const Segmentation& found, const SynthScene& truth)
{
    const LabelGrid grid{truth.options.width, truth.options.height, truth.view.mask};
    const std::vector<uint8_t> inner = innerPixels(grid, kBorder, truth.labels);
    std::map<int, std::map<int, size_t>> pairs;
    std::set<int> taken;
    size_t compared = 0, agreeing = 0;
    for (size_t i = 0; i < inner.size(); ++i) {
        if (inner[i]) {
            ++pairs[truth.labels[i]][found.labels[i]];
            ++compared;
        }
    }
    for (const auto& [label, counts] : pairs) {
        const auto most = std::max_element(counts.begin(), counts.end(),
                                           [](const auto& a, const auto& b) { return a.second < b.second; });
        agreeing += taken.insert(most->first).second ? most->second : 0; // no two materials share a label
    }
    return static_cast<double>(agreeing) / static_cast<double>(compared);
}

TEST(SegmentationSlow, WhiteBlackAndRedAreThreeMaterialsWhateverTheNoise)
{
    for (const double noise : {0.002, 0.005, 0.02}) {
        const TempFolder folder;
        SynthOptions synth = threeMaterials();
        synth.noise = noise;
        const Synthesised made = synthesise(folder, synth);
        const Acquisition result = acquire(made.capture, finding(), kSilent);
        EXPECT_EQ(result.segmentation.regions.size(), 3u) << noise;
        const double share = agreement(result.segmentation, made.scene);
        RecordProperty("agreement_at_noise_" + std::to_string(noise), std::to_string(share));
        EXPECT_GE(share, 0.97) << noise;
        EXPECT_EQ(result.surface.materials.size(), 3u);
        EXPECT_EQ(result.surface.materials[0].name, "bumpy-1");
    }
}

TEST(SegmentationSlow, OneMaterialIsNotSplitByShadowsHighlightsOrAMetalsShine)
{
    for (const char* material : {"lambert:0.6,0.5,0.4", "ggx:diffuse=0.5,0.3,0.2;specular=0.04,0.04,0.04;alpha=0.05",
                                 "ggx:diffuse=0.1,0.1,0.3;specular=0.1,0.1,0.1;alpha=0.2",
                                 "ggx:diffuse=0.02,0.02,0.02;specular=0.04,0.04,0.04;alpha=0.1",
                                 "ggx:diffuse=0.01,0.01,0.01;specular=0.9,0.6,0.3;alpha=0.3"}) {
        const TempFolder folder;
        SynthOptions synth = threeMaterials();
        synth.width = synth.height = 96;
        synth.material = material;
        synth.patches.clear();
        const Acquisition result = acquire(synthesise(folder, synth).capture, finding(), kSilent);
        EXPECT_EQ(result.segmentation.regions.size(), 1u) << material;
        EXPECT_EQ(result.surface.materials.at(0).name, "bumpy") << material;
    }
}

TEST(Segmentation, GlossAloneTellsMaterialsWhereItShows)
{
    const TempFolder folder;
    SynthOptions synth = threeMaterials();
    synth.material = "lambert:0.4,0.4,0.4";
    synth.patches = {"ggx:diffuse=0.4,0.4,0.4;specular=0.08,0.08,0.08;alpha=0.25"};
    synth.shape = SynthShape::sphere;
    const Synthesised made = synthesise(folder, synth);
    const Acquisition result = acquire(made.capture, finding(), kSilent);
    EXPECT_EQ(result.segmentation.regions.size(), 2u);
    const double share = agreement(result.segmentation, made.scene);
    RecordProperty("agreement", std::to_string(share));
    // No light's half vector comes near the normals of the outer part, which takes the nearest label.
    EXPECT_GE(share, 0.8);
}

// PSNR in dB of the surface under its own light 7 against that photograph.
double roundTrip(const Acquisition& result, const Capture& capture)
{
    const Scene scene{result.surface, {result.surface.lights[7].light}};
    const Image photograph = loadPhotograph(capture.photographs[7].exposures.front().file, capture.curve);
    std::vector<float> values = photograph.values;
    return radiancePsnr(renderReference(scene), photograph, capture.mask, quantile(values, 0.99));
}

TEST(SegmentationSlow, ThreeMaterialsRenderThePhotographBetterThanOne)
{
    const TempFolder folder;
    SynthOptions synth = threeMaterials();
    synth.width = synth.height = 96;
    synth.shadows = false; // of which no BRDF knows
    const Capture capture = synthesise(folder, synth).capture;
    AcquireOptions options = finding(), one = finding();
    one.segment = {SegmentSource::none, {}, 0};
    options.normals.method = one.normals.method = NormalMethod::exemplar;
    options.bake.size = one.bake.size = {};
    const double several = roundTrip(acquire(capture, options, kSilent), capture);
    const double single = roundTrip(acquire(capture, one, kSilent), capture);
    RecordProperty("psnr_three", std::to_string(several));
    RecordProperty("psnr_one", std::to_string(single));
    EXPECT_GT(several, single + 3); // a factor of two in the mean squared error
}

TEST(SegmentationSlow, LabelsOfAPictureAreUsedAndAlbedoHasAMeanOfOneInEach)
{
    const TempFolder folder;
    const Synthesised made = synthesise(folder, threeMaterials());
    AcquireOptions options = finding();
    options.segment = {SegmentSource::picture, folder / "capture" / "truth" / "labels.png", 0};
    const Acquisition result = acquire(made.capture, options, kSilent);
    ASSERT_EQ(result.surface.materials.size(), 3u);
    EXPECT_EQ(result.surface.materials[0].name, "bumpy-85"); // 255 / 3: the first material, white
    EXPECT_EQ(result.surface.materials[1].name, "bumpy-170");
    std::vector<glm::dvec3> sum(3, glm::dvec3(0));
    std::vector<double> count(3, 0);
    size_t differing = 0;
    for (size_t i = 0; i < result.surface.labels.size(); ++i) {
        const uint8_t label = result.surface.labels[i];
        const int x = static_cast<int>(i) % result.surface.albedo.width;
        const int y = static_cast<int>(i) / result.surface.albedo.width;
        if (label != Surface::kNoMaterial && result.surface.albedo.rgb(x, y) != glm::vec3(0)) {
            differing += label != made.scene.labels[i];
            sum[label] += glm::dvec3(result.surface.albedo.rgb(x, y));
            ++count[label];
        }
    }
    EXPECT_LT(differing, made.scene.view.seen.size() / 200); // slivers at the rim went to their neighbours
    for (int m = 0; m < 3; ++m) {
        EXPECT_NEAR(sum[m].x / count[m], 1, 1e-4) << m; // float sums
        EXPECT_NEAR(sum[m].z / count[m], 1, 1e-4) << m;
    }
}

TEST(SegmentationSlow, OneAskedForIsNoneAndTheCapturesLabelsAreTheDefault)
{
    EXPECT_EQ(segmentOptionsFrom("auto:1").source, SegmentSource::none);
    EXPECT_EQ(segmentOptionsFrom("").source, SegmentSource::asCaptured);
    EXPECT_EQ(segmentOptionsFrom("auto:7").count, 7u);
    for (const char* wrong : {"auto:0", "auto:", "auto:-2", "auto:2.5", "auto:65", "auto:x"}) {
        expectError([&] { segmentOptionsFrom(wrong); }, {"segmentation", wrong}, Error::kUsage);
    }
    const TempFolder folder;
    SynthOptions synth = threeMaterials();
    synth.width = synth.height = 48;
    synth.lights = 12;
    Synthesised made = synthesise(folder, synth);
    AcquireOptions options = finding();
    options.segment = {};
    EXPECT_EQ(acquire(made.capture, options, kSilent).surface.materials.size(), 1u);
    made.capture.labelsFile = folder / "capture" / "truth" / "labels.png";
    EXPECT_EQ(acquire(made.capture, options, kSilent).surface.materials.size(), 3u);
    options.segment = {SegmentSource::none, {}, 0};
    EXPECT_EQ(acquire(made.capture, options, kSilent).surface.materials.size(), 1u);
}

TEST(Segmentation, AsManyAreFoundAsAreAskedForAndNoMoreThanPixels)
{
    const TempFolder folder;
    SynthOptions synth = threeMaterials();
    synth.lights = 12;
    const Capture capture = synthesise(folder, synth).capture;
    EXPECT_EQ(acquire(capture, finding(2), kSilent).surface.materials.size(), 2u);
    synth.width = synth.height = 8; // 41 pixels of the object at most
    synth.shape = SynthShape::sphere;
    const TempFolder other;
    const Capture tiny = synthesise(other, synth).capture;
    expectError([&] { acquire(tiny, finding(kMostMaterials), kSilent); }, {"64 materials", "pixels"});
}

TEST(SegmentationSlow, SameBytesForOneAndTwoThreadsAndAnyBudget)
{
    const TempFolder folder;
    SynthOptions synth = threeMaterials();
    synth.width = synth.height = 48;
    synth.lights = 12;
    const Capture capture = synthesise(folder, synth).capture;
    AcquireOptions one = finding(), two = finding();
    one.normals.method = two.normals.method = NormalMethod::automatic;
    one.setThreads(1);
    two.setThreads(2);
    two.byteBudget = 64 << 10; // many blocks
    const Acquisition a = acquire(capture, one, kSilent), b = acquire(capture, two, kSilent);
    EXPECT_GT(a.surface.materials.size(), 1u);
    EXPECT_EQ(a.surface.labels, b.surface.labels);
    EXPECT_EQ(a.surface.normals.normals, b.surface.normals.normals);
    EXPECT_EQ(a.surface.albedo.values, b.surface.albedo.values);
    ASSERT_EQ(a.surface.materials.size(), b.surface.materials.size());
    for (size_t m = 0; m < a.surface.materials.size(); ++m) {
        EXPECT_EQ(a.surface.materials[m].table.values, b.surface.materials[m].table.values);
    }
}

} // namespace
} // namespace nacre
