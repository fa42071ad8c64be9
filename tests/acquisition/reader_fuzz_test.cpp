// Every reader, given its own small files after seeded damage: it reads them, or says in one line which file is wrong.
#include <cstring>
#include <functional>
#include <random>

#include <gtest/gtest.h>

#include "acquisition/brdf/cornell_samples.h"
#include "acquisition/capture/capture.h"
#include "acquisition/capture/capture_maps.h"
#include "engine/brdf/rgl_brdf.h"
#include "engine/exchange/gltf_file.h"
#include "engine/files/error.h"
#include "engine/files/whole_file.h"
#include "engine/lights/environment.h"
#include "engine/lights/light_files.h"
#include "engine/materials/merl_file.h"
#include "engine/rti/hsh_file.h"
#include "engine/rti/ptm_file.h"
#include "engine/rti/rti_web.h"
#include "engine/scene/scene_description.h"
#include "engine/surface/surface.h"
#include "engine/target/mesh_file.h"
#include "tests/support/expect_error.h"
#include "tests/support/hsh_file.h"
#include "tests/support/temp_folder.h"
#include "tests/support/tensor_file.h"
#include "tests/support/write_capture.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

constexpr int kInputs = 1000;

using Random = std::mt19937;

struct FuzzedReader {
    fs::path file; // below the test's folder, as it is damaged
    fs::path read; // what is read: the file, or the folder that it lies in
    std::function<void(const fs::path&)> reader;
};

template <class Value> void appendTo(std::string& bytes, const Value& value)
{
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// MATLAB 5.0 MAT-File Format, 2019, 1-5: one array of doubles, 2 x 2 x 3.
std::string matFile()
{
    std::string bytes = "MATLAB 5.0 MAT-file";
    bytes.resize(124, ' ');
    bytes += std::string("\0\1IM", 4);
    std::string array;
    for (const uint32_t word : {6u, 8u, 6u, 0u, 5u, 12u, 2u, 2u, 3u, 0u, 1u, 1u, uint32_t{'n'}, 0u, 9u, 96u}) {
        appendTo(array, word);
    }
    for (int i = 0; i < 12; ++i) {
        appendTo(array, i < 8 ? 0.0 : 1.0);
    }
    appendTo(bytes, uint32_t{14});
    appendTo(bytes, static_cast<uint32_t>(array.size()));
    return bytes + array;
}

std::string ptmBytes()
{
    return "PTM_1.2\nPTM_FORMAT_LRGB\n2\n2\n1 1 1 1 1 1\n0 0 0 0 0 128\n" + std::string(4 * 9, '\x40');
}

// numpy.save of a 4 x 3 array.
std::string npyFile()
{
    std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (4, 3), }";
    header.resize(117, ' ');
    std::string bytes = std::string("\x93NUMPY\1\0v\0", 10) + header + "\n";
    for (int i = 0; i < 12; ++i) {
        appendTo(bytes, static_cast<float>(i));
    }
    return bytes;
}

// One triangle, as scanners write it.
std::string plyFile()
{
    std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                        "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    for (const float v : {0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f}) {
        appendTo(bytes, v);
    }
    bytes += '\3';
    for (const int32_t i : {0, 1, 2}) {
        appendTo(bytes, i);
    }
    return bytes;
}

std::string stlFile()
{
    std::string bytes(80, ' ');
    appendTo(bytes, uint32_t{1});
    for (const float v : {0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f}) {
        appendTo(bytes, v);
    }
    return bytes + std::string(2, '\0');
}

constexpr const char* kObj = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\nusemtl m\n"
                             "f 1/1/1 2/2/1 3/3/1\n";
// The buffer: positions, texture coordinates.
constexpr const char* kGltf =
    R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}],
    "materials": [{"normalTexture": {"index": 0, "scale": 0.5}}], "textures": [{"source": 0}],
    "images": [{"uri": "a.png"}], "buffers": [{"byteLength": 60, "uri": "data:application/octet-stream;base64,
AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
    {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}]})";

void writeMeshes(const TempFolder& folder, std::vector<FuzzedReader>& readers)
{
    const auto mesh = [](const fs::path& file) { loadMesh(file); };
    const auto add = [&](const char* name, const std::string& bytes, const char* read) {
        writeText(folder / "m" / name, bytes);
        readers.push_back({folder / "m" / name, folder / "m" / read, mesh});
    };
    saveNormalMap(folder / "m" / "a.png", sphereNormalMap(16));
    std::string gltf = kGltf;
    gltf.erase(gltf.find(",\nAAAA") + 1, 1);
    add("a.mtl", "newmtl m\nmap_Bump -bm 1.0 a.png\n", "a.obj");
    add("a.obj", kObj, "a.obj");
    add("a.ply", plyFile(), "a.ply");
    add("a.stl", stlFile(), "a.stl");
    add("a.gltf", gltf, "a.gltf");
    saveGlb(folder / "m" / "a.glb", {.name = "ball", .mesh = sphereMesh(1)});
    readers.push_back({folder / "m" / "a.glb", folder / "m" / "a.glb", mesh});
}

RtiPicture smallRti(RtiBasis basis)
{
    RtiPicture picture;
    picture.basis = basis;
    for (size_t k = 0; k < rtiTermCount(basis); ++k) {
        picture.terms.emplace_back(8, 6, 3, 0.1f * static_cast<float>(k));
    }
    return picture;
}

void writeRtiWeb(const TempFolder& folder, std::vector<FuzzedReader>& readers)
{
    fs::create_directory(folder / "w");
    saveRtiWeb(folder / "w", smallRti(RtiBasis::ptm), {});
    for (const auto& entry : fs::directory_iterator(folder / "w")) {
        readers.push_back({entry.path(), folder / "w", [](const fs::path& f) { loadRtiWeb(f); }});
    }
}

std::string merlStart()
{
    std::string bytes;
    for (const int32_t side : {90, 90, 180}) {
        appendTo(bytes, side);
    }
    return bytes + std::string(1000, '\0');
}

// Writes the whole files.
std::vector<FuzzedReader> writeReaders(const TempFolder& folder)
{
    std::vector<FuzzedReader> readers;
    const auto add = [&](const fs::path& file, const std::function<void(const fs::path&)>& reader) {
        readers.push_back({folder / file, folder / file, reader});
    };
    const auto picture = [](const fs::path& file) { loadPhotograph(file, TransferCurve::srgb); };
    for (const char* name : {"a.png", "a.jpg", "a.exr", "a.tif", "a.tga", "a.bmp", "a.hdr"}) {
        const bool isFloat = std::strcmp(name, "a.exr") == 0 || std::strcmp(name, "a.hdr") == 0;
        saveImage(folder / name, testPicture(1), isFloat ? PixelType::float32 : PixelType::uint8);
        add(name, picture);
    }
    const auto addText = [&](const fs::path& file, const std::string& text, const auto& reader) {
        writeText(folder / file, text);
        add(file, reader);
    };
    addText("a.lp", "2\nphoto 1.png 0.1 0.2 0.9 1\nphoto 2.png 0 0 1 1\n", [](const fs::path& f) { loadLpList(f); });
    addText("a.txt", directionLines(4), [](const fs::path& f) { loadLightFile(f); });
    addText("a.npy", npyFile(), [](const fs::path& f) { loadLightFile(f); });
    addText("a.yml", "%YAML:1.0\nL: !!opencv-matrix\n  rows: 2\n  cols: 3\n  data: [ 0., 0., 1., 1., 0., 1. ]\n",
            [](const fs::path& f) { loadLightFile(f); });
    addText("i.txt", "1 2 3\n4 5 6\n", [](const fs::path& f) { loadIrradiances(f); });
    addText(
        "a.json",
        R"({"format": "nacre lights", "version": 1, "lights": [{"direction": [0, 0, 1], "irradiance": [1, 2, 3]}]})",
        [](const fs::path& f) { loadLightFile(f); });
    addText("s.json", R"({"format": "nacre scene", "version": 1, "onto": "make:sphere", "light": ["captured:3"]})",
            [](const fs::path& f) { sceneFromFile(f); });
    addText("a.mat", matFile(), [](const fs::path& f) { loadTrueNormals(f); });
    addText("a.ptm", ptmBytes(), [](const fs::path& f) { loadPtm(f); });
    addText("a.rti", hshBytes(smallRti(RtiBasis::hsh)), [](const fs::path& f) { loadHsh(f); });
    addText("a.brdf", "# gloss\n2\n400 700\n0 0 0 0 0.3 0.2\n0.5 1 0.5 3 0.1 0.2\n",
            [](const fs::path& f) { loadCornellMeasurements(f); });
    addText("a.csv", "file,x,y,z\na.png,0,0,1\nb.png,1,0,1\n", [](const fs::path& f) { loadLightFile(f); });
    addText("a.bsdf", tensorFile(1, "rgb"), [](const fs::path& f) { RglBrdf{f}; });
    addText("a.binary", merlStart(), [](const fs::path& f) { loadMerl(f, {4, 4, 4}); });
    saveImage(folder / "env.exr", Image(8, 4, 3, 1.0f), PixelType::half);
    add("env.exr", [](const fs::path& f) { loadEnvironment(f); });

    fs::create_directory(folder / "m");
    writeMeshes(folder, readers);
    writeRtiWeb(folder, readers);
    Surface surface = transferredSurface(sphereNormalMap(16), {"m", BrdfTable({5, 4, 3}, {kHalfDifference, 0.4f}), {}});
    saveSurface(folder / "s.nacre", surface, false);
    for (const auto& entry : fs::recursive_directory_iterator(folder / "s.nacre")) {
        if (entry.is_regular_file()) {
            readers.push_back({entry.path(), folder / "s.nacre", [](const fs::path& f) { loadSurface(f); }});
        }
    }
    writeDiligentFolder(folder / "d", 4);
    writeText(folder / "j" / "capture.json", R"({"format": "nacre capture", "version": 1, "photographs":
        ["../d/001.png", {"file": "../d/002.png"}, "../d/003.png"], "mask": "../d/mask.png", "crop": [0, 0, 4, 4]})");
    for (const char* name :
         {"d/filenames.txt", "d/light_directions.txt", "d/mask.png", "d/002.png", "j/capture.json"}) {
        const fs::path file = folder / name;
        readers.push_back({file, file.parent_path(), [](const fs::path& f) { loadCapture(f); }});
    }
    return readers;
}

size_t below(Random& random, size_t end)
{
    return end > 0 ? random() % end : 0;
}

std::string inUtf16(const std::string& text)
{
    std::string wide = "\xff\xfe";
    for (const char c : text) {
        wide += {c, '\0'};
    }
    return wide;
}

std::string withOtherNumber(std::string text, Random& random)
{
    constexpr const char* kNumbers[] = {"1e999", "-1", "99999999999999999999", "0", "nan", "4294967296", "2147483647"};
    const size_t first = text.find_first_of("0123456789", below(random, text.size()));
    if (first != std::string::npos) {
        const size_t last = std::min(text.find_first_not_of("0123456789.", first), text.size());
        text.replace(first, last - first, kNumbers[below(random, std::size(kNumbers))]);
    }
    return text;
}

std::string damaged(std::string bytes, const std::string& other, Random& random)
{
    const size_t a = below(random, bytes.size()), b = below(random, bytes.size()), from = std::min(a, b),
                 length = std::max(a, b) - from;
    switch (below(random, 9)) {
    case 0:
        return bytes.substr(0, a);
    case 1:
        for (int i = 0; i < 4 && !bytes.empty(); ++i) {
            bytes[below(random, bytes.size())] = static_cast<char>(random());
        }
        return bytes;
    case 2: // shuffled
        return bytes.substr(length) + bytes.substr(0, length);
    case 3:
        return bytes.erase(from, length);
    case 4:
        return bytes.insert(from, bytes.substr(from, length));
    case 5:
        return withOtherNumber(bytes, random);
    case 6: // of another type
        return other;
    case 7:
        return random() % 2 ? inUtf16(bytes) : "\xef\xbb\xbf" + bytes + "\xe9";
    default: // huge numbers
        return bytes.replace(from, std::min<size_t>(4, bytes.size() - from),
                             random() % 2 ? "\xff\xff\xff\x7f" : "\xff\xff\xff\xff");
    }
}

// Empty where the reader took it or refused it well.
std::string complaintOf(const FuzzedReader& reader)
{
    try {
        reader.reader(reader.read);
    } catch (const Error& error) {
        const std::string message = error.what();
        const bool namesIt = message.find(reader.read.filename().string()) != std::string::npos ||
                             message.find(reader.file.filename().string()) != std::string::npos;
        return message.find('\n') == std::string::npos && namesIt ? "" : "message: " + message;
    } catch (const std::exception& exception) {
        return std::string("exception: ") + exception.what();
    }
    return "";
}

TEST(ReaderFuzz, DamagedFilesAreReadOrNamed)
{
    const TempFolder folder;
    const std::vector<FuzzedReader> readers = writeReaders(folder);
    std::vector<std::string> whole;
    for (const FuzzedReader& reader : readers) {
        whole.push_back(readWholeFile(reader.file, ""));
        if (reader.file.extension() != ".binary") { // 33 MB, were it whole
            EXPECT_NO_THROW(reader.reader(reader.read)) << reader.file;
        }
    }
    Random random(21);
    for (int input = 0; input < kInputs; ++input) {
        const size_t i = input % readers.size();
        const std::string bytes = damaged(whole[i], whole[below(random, whole.size())], random);
        writeText(readers[i].file, bytes);
        const std::string complaint = complaintOf(readers[i]);
        EXPECT_EQ(complaint, "") << "input " << input << ", " << readers[i].file.filename();
        writeText(readers[i].file, whole[i]);
    }
}

// What other seeds found.
TEST(ReaderFuzz, NumbersThatAreTooLargeAreNamed)
{
    const TempFolder folder;
    writeText(folder / "a.json", R"({"format": "nacre lights", "version": 1e999, "lights": []})");
    expectError([&] { loadLightFile(folder / "a.json"); }, {"a.json: is not JSON"});
    std::string targa(18, '\0'); // header of an uncompressed picture in colour
    targa[2] = 2, targa[12] = targa[14] = targa[13] = targa[15] = '\xff', targa[16] = 24;
    writeText(folder / "a.tga", targa);
    expectError([&] { loadPhotograph(folder / "a.tga", TransferCurve::linear); }, {"a.tga", "65535 x 65535"});
}

} // namespace
} // namespace nacre
