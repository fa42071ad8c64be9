#include "engine/lights/light_files.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"

namespace nacre {
namespace {

std::vector<glm::vec3> loadDirections(const std::filesystem::path& file)
{
    std::vector<glm::vec3> directions;
    for (const Light& light : loadDirectionTable(file).lights) {
        directions.push_back(light.direction);
    }
    return directions;
}

// Float rounding of a normalisation.
constexpr float kUnitTolerance = 1e-6f;

void expectVector(const glm::vec3& actual, const glm::vec3& expected)
{
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(actual[c], expected[c], kUnitTolerance);
    }
}

class LightFiles : public testing::Test {
protected:
    std::filesystem::path write(const std::string& name, const std::string& text)
    {
        writeText(folder_ / name, text);
        return folder_ / name;
    }
    TempFolder folder_;
};

TEST_F(LightFiles, TableOfThreeNumbersALine)
{
    const auto directions = loadDirections(write("l.txt", "0 0 2\r\n\r\n\t3  0 4 \r\n0,-5,0\r\n+1e-3 0 0"));
    ASSERT_EQ(directions.size(), 4u);
    expectVector(directions[0], {0, 0, 1});
    expectVector(directions[1], {0.6f, 0, 0.8f});
    expectVector(directions[2], {0, -1, 0});
    expectVector(directions[3], {1, 0, 0});
}

TEST_F(LightFiles, TablesOfSpreadsheetsHaveAHeadingAndNumbers)
{
    for (const char* text :
         {"led,x_mm,y_mm,z_mm\n1,0,0,300\n2,180,0,240\n", "\"x\";\"y\";\"z\"\n0;0;300\n180;0;240\n"}) {
        const auto directions = loadDirections(write("l.csv", text));
        ASSERT_EQ(directions.size(), 2u) << text;
        expectVector(directions[1], {0.6f, 0, 0.8f});
    }
    expectError([&] { loadDirections(write("l.csv", "led,x,y,z\n1,0,0,300\n3,180,0,240\n")); }, {"l.csv", "4 numbers"});
    expectError([&] { loadDirections(write("l.csv", "0,0,1\nled,0,1\n")); }, {"l.csv", "\"led\" is no number"});
}

TEST_F(LightFiles, TablesMayNamePhotographsAndHaveComments)
{
    const std::string rows = "a 1.png,0,0,300\nb.png,180,0,240\n";
    for (const std::string& text : {"file,x,y,z\n" + rows, "# numpy.savetxt\n" + rows, rows}) {
        const LightFile file = loadLightFile(write("l.csv", text));
        EXPECT_EQ(file.photographs, (std::vector<std::string>{"a 1.png", "b.png"}));
        ASSERT_EQ(file.lights.size(), 2u) << text;
        expectVector(file.lights[1].direction, {0.6f, 0, 0.8f});
    }
    EXPECT_EQ(loadDirections(write("l.txt", "# x y z\n0 0 1\n")).size(), 1u);
}

TEST_F(LightFiles, TableOfThreeLines)
{
    const auto directions = loadDirections(write("l.txt", "1 0 0 3\n0 1 0 0\n0 0 1 4\n"));
    ASSERT_EQ(directions.size(), 4u);
    expectVector(directions[1], {0, 1, 0});
    expectVector(directions[3], {0.6f, 0, 0.8f});
}

// As numpy.save writes a 2 x 3 array.
std::string npyBytes(const std::string& type, const std::string& isFortran, const std::string& data)
{
    std::string header = "{'descr': '" + type + "', 'fortran_order': " + isFortran + ", 'shape': (2, 3), }";
    header.resize(117, ' ');
    return std::string("\x93NUMPY\1\0", 8) + static_cast<char>(header.size() + 1) + '\0' + header + '\n' + data;
}

template <class Value> std::string bytesOf(const std::vector<Value>& values)
{
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)};
}

TEST_F(LightFiles, TablesOfNumPy)
{
    const std::string doubles = bytesOf<double>({0, 0, 2, 3, 0, 4}), floats = bytesOf<float>({0, 0, 2, 3, 0, 4});
    const std::string columns = bytesOf<double>({0, 3, 0, 0, 2, 4});
    for (const std::string& bytes :
         {npyBytes("<f8", "False", doubles), npyBytes("<f4", "False", floats), npyBytes("<f8", "True", columns)}) {
        const std::vector<Light> lights = loadLightFile(write("l.npy", bytes)).lights;
        ASSERT_EQ(lights.size(), 2u);
        expectVector(lights[1].direction, {0.6f, 0, 0.8f});
    }
    const auto expectRefused = [&](const std::string& bytes, const std::string& part) {
        expectError([&] { loadLightFile(write("l.npy", bytes)); }, {"l.npy", part, "NumPy"});
    };
    expectRefused(npyBytes(">f8", "False", doubles), "'>f8'");
    expectRefused(npyBytes("<i4", "False", floats), "'<i4'");
    expectRefused(npyBytes("<f8", "False", floats), "2 x 3 numbers and holds 3");
    expectRefused("1 0 0\n", "does not begin");
}

TEST_F(LightFiles, ThreeByThreeIsOneLightALine)
{
    const auto directions = loadDirections(write("l.txt", "1 2 2\n0 1 0\n0 0 1\n"));
    expectVector(directions[0], glm::vec3(1, 2, 2) / 3.0f);
}

TEST_F(LightFiles, AnnouncedCountIsCheckedAndNoLight)
{
    EXPECT_EQ(loadDirections(write("l.txt", "4\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n")).size(), 4u);
    EXPECT_EQ(loadDirections(write("l.txt", "4\n1 0 0 1\n0 1 0 1\n0 0 1 1\n")).size(), 4u);
    expectError([&] { loadDirections(write("l.txt", "12\n1 0 0\n0 1 0\n")); }, {"l.txt", "announces 12", "lists 2"});
}

TEST_F(LightFiles, IrradiancesMayBeGrey)
{
    const auto colour = loadIrradiances(write("i.txt", "1 2 3\n4 5 6\n"));
    EXPECT_EQ(colour, (std::vector<glm::vec3>{{1, 2, 3}, {4, 5, 6}}));
    const std::vector<glm::vec3> grey{glm::vec3(1), glm::vec3(2), glm::vec3(4)};
    EXPECT_EQ(loadIrradiances(write("i.txt", "1\n2\n4\n")), grey);
    EXPECT_EQ(loadIrradiances(write("i.txt", "1 2 4\n")), grey);
}

TEST_F(LightFiles, TablesRefuseWhatIsNoLight)
{
    expectError([&] { loadDirections(write("l.txt", "1 0 0\n0 0 0\n")); }, {"l.txt", "light 2", "(0, 0, 0)"});
    expectError([&] { loadDirections(write("l.txt", "1 0 nan\n")); }, {"\"nan\" is no number"});
    expectError([&] { loadDirections(write("l.txt", "1 0 inf\n")); }, {"\"inf\" is no number"});
    expectError([&] { loadDirections(write("l.txt", "1 0 0.5x\n")); }, {"\"0.5x\" is no number"});
    expectError([&] { loadDirections(write("l.txt", "1 0 0\n0 1\n")); }, {"row 2 has 2 numbers, row 1 has 3"});
    expectError([&] { loadDirections(write("l.txt", "1 0\n0 1\n")); }, {"2 rows of 2 numbers"});
    expectError([&] { loadDirections(write("l.txt", " \r\n")); }, {"is empty"});
    expectError([&] { loadDirections(folder_ / "missing.txt"); }, {"missing.txt"});
    expectError([&] { loadIrradiances(write("i.txt", "1 1 1\n1 -1 1\n")); }, {"i.txt", "light 2", "(1, -1, 1)"});
    expectError([&] { loadIrradiances(write("i.txt", "1\n0\n1\n")); }, {"light 2"});
}

TEST_F(LightFiles, LpNamesMayHoldSpacesAndNumbers)
{
    const LightFile lights =
        loadLpFile(write("a.lp", "\xef\xbb\xbf"
                                 "3\r\nD:\\my dome\\shot 1 2.jpg 0 0 2\r\nb.png\t3\t0\t4\r\n\r\nc.png 0 1 0"));
    EXPECT_EQ(lights.photographs, (std::vector<std::string>{"D:\\my dome\\shot 1 2.jpg", "b.png", "c.png"}));
    expectVector(lights.lights[0].direction, {0, 0, 1});
    expectVector(lights.lights[1].direction, {0.6f, 0, 0.8f});
    EXPECT_EQ(lights.lights[1].irradiance, glm::vec3(1));
    EXPECT_FALSE(lights.irradianceGiven);
}

TEST_F(LightFiles, LpNamesMayBeQuoted)
{
    const LightFile lights = loadLpFile(write("a.lp", "2\n\"my coin 1.jpg\" 0 0 2\n'b c.png' 3 0 4\n"));
    EXPECT_EQ(lights.photographs, (std::vector<std::string>{"my coin 1.jpg", "b c.png"}));
}

TEST_F(LightFiles, LpWithoutCountIsUnderstood)
{
    const LightFile lights = loadLpFile(write("a.lp", "a.png 0 0 1\nb c.png 0 3 4\n"));
    EXPECT_EQ(lights.photographs, (std::vector<std::string>{"a.png", "b c.png"}));
    expectVector(lights.lights[1].direction, {0, 0.6f, 0.8f});
}

TEST_F(LightFiles, DecimalCommas)
{
    const glm::vec3 expected = glm::normalize(glm::vec3(0.123f, -0.456f, 1));
    const LightFile lp = loadLpFile(write("a.lp", "4\r\na 1,5.png 0,123 -0,456 1\r\nb.png\t0,123\t-0,456\t1,0\r\n"
                                                  "c,d.png;0,123;-0,456;1\r\ne.png, 0,123, -0,456, 1\r\n"));
    EXPECT_EQ(lp.photographs, (std::vector<std::string>{"a 1,5.png", "b.png", "c,d.png", "e.png"}));
    for (const Light& light : lp.lights) {
        expectVector(light.direction, expected);
    }
    const auto table = loadDirections(write("l.txt", "0,123 -0,456 1\n0,123;-0,456;1,000\n0,123\t-0,456\t1\n"));
    ASSERT_EQ(table.size(), 3u);
    for (const glm::vec3& direction : table) {
        expectVector(direction, expected);
    }
    EXPECT_EQ(loadIrradiances(write("i.txt", "0,5\n1,25\n")),
              (std::vector<glm::vec3>{glm::vec3(0.5f), glm::vec3(1.25f)}));
}

TEST_F(LightFiles, CommasBetweenNumbersAreSeparators)
{
    for (const char* line : {"0,3,4", "0.0,0.3,0.4", "0, 3, 4", "0 ,3 ,4", "0,3.0,4"}) {
        expectVector(loadDirections(write("l.txt", std::string(line) + "\n"))[0], {0, 0.6f, 0.8f});
        const LightFile lp = loadLpFile(write("a.lp", "1\na.png," + std::string(line) + "\n"));
        expectVector(lp.lights[0].direction, {0, 0.6f, 0.8f});
    }
}

TEST_F(LightFiles, LpRoundTrip)
{
    LightFile lights;
    lights.lights = {{glm::normalize(glm::vec3(1, 2, 3)), {}}, {{0, 0, 1}, {}}};
    lights.photographs = {"a b 1.png", "c.png"};
    saveLpFile(folder_ / "l.lp", lights);
    const LightFile read = loadLightFile(folder_ / "l.lp");
    EXPECT_EQ(read.photographs, lights.photographs);
    EXPECT_FALSE(read.irradianceGiven);
    for (size_t i = 0; i < 2; ++i) {
        expectVector(read.lights[i].direction, lights.lights[i].direction);
    }
}

TEST_F(LightFiles, LpRefusesWrongLines)
{
    expectError([&] { loadLpFile(write("a.lp", "3\na.png 0 0 1\nb.png 0 0 1\n")); },
                {"a.lp", "announces 3", "lists 2"});
    expectError([&] { loadLpFile(write("a.lp", "3 lights\na.png 0 0 1\n")); },
                {"a.lp", "begins with \"3 lights\"", "number of lights"});
    expectError([&] { loadLpFile(write("a.lp", "a.png 0 0 1\nb.png 0 0\n")); }, {"a.lp", "\"b.png 0 0\""});
    expectError([&] { loadLpFile(write("a.lp", "1\na.png 0 1\n")); }, {"\"a.png 0 1\""});
    expectError([&] { loadLpFile(write("a.lp", "1\n0 0 1\n")); }, {"\"0 0 1\""});
    expectError([&] { loadLpFile(write("a.lp", "1\na.png 0 0 0\n")); }, {"a.png", "(0, 0, 0)"});
    expectError([&] { loadLpFile(write("a.lp", "")); }, {"is empty"});
}

TEST_F(LightFiles, JsonRoundTrip)
{
    LightFile lights;
    lights.lights = {{glm::normalize(glm::vec3(1, 2, 3)), {0.1f, 0.2f, 0.3f}}, {{0, 0, 1}, {1, 2, 3}}};
    lights.photographs = {"a b.png", "c.png"};
    lights.irradianceGiven = true;
    saveLightFile(folder_ / "l.json", lights);
    const LightFile read = loadLightFile(folder_ / "l.json");
    EXPECT_EQ(read.photographs, lights.photographs);
    EXPECT_TRUE(read.irradianceGiven);
    for (size_t i = 0; i < 2; ++i) {
        expectVector(read.lights[i].direction, lights.lights[i].direction);
        EXPECT_EQ(read.lights[i].irradiance, lights.lights[i].irradiance);
        EXPECT_TRUE(std::isinf(read.lights[i].distance));
    }
    lights.lights[0].distance = 2.5f;
    lights.lights[1].distance = 1;
    saveLightFile(folder_ / "l.json", lights);
    EXPECT_EQ(loadLightFile(folder_ / "l.json").lights[0].distance, 2.5f);
    lights.lights[1].distance = 0.2f;
    saveLightFile(folder_ / "l.json", lights);
    expectError([&] { loadLightFile(folder_ / "l.json"); }, {"lights[1].distance", "0.2", "inside the object"});
}

TEST_F(LightFiles, JsonWithoutNamesAndIrradiances)
{
    LightFile lights;
    lights.lights = {{{0, 1, 0}, glm::vec3(7)}};
    saveLightFile(folder_ / "l.JSON", lights);
    const LightFile read = loadLightFile(folder_ / "l.JSON");
    EXPECT_FALSE(read.irradianceGiven);
    EXPECT_EQ(read.lights[0].irradiance, glm::vec3(1));
    EXPECT_TRUE(read.photographs.empty());
}

TEST_F(LightFiles, JsonIsReadStrictly)
{
    const auto load = [&](const std::string& lights,
                          const std::string& head = R"("format":"nacre lights","version":1)") {
        return [this, text = "{" + head + ",\"lights\":" + lights + "}"] { loadLightFile(write("l.json", text)); };
    };
    expectError(load(R"([{"direction":[0,0,1],"colour":1}])"), {"lights[0]", "unknown key \"colour\""});
    expectError(load(R"([{"direction":[0,0,"1"]}])"), {"lights[0].direction[2] is a string"});
    expectError(load(R"([{"direction":[0,0,0]}])"), {"lights[0].direction", "(0, 0, 0)"});
    expectError(load(R"([{"direction":[0,0,1],"irradiance":[1,0,1]}])"), {"lights[0].irradiance"});
    expectError(load(R"([{"direction":[0,0,1],"irradiance":[1,1,1]},{"direction":[0,0,1]}])"), {"lights[1]"});
    expectError(load(R"([{"irradiance":[1,1,1]}])"), {"lights[0] lacks \"direction\""});
    expectError(load("[]", R"("format":"nacre lights","version":2)"), {"version is 2"});
    expectError(load("[]", R"("format":"nacre capture","version":1)"), {"format is \"nacre capture\""});
}

TEST(LightFileKinds, AMatrixOfOpenCv)
{
    const TempFolder folder;
    writeText(folder / "m.yml", "%YAML:1.0\nLights: !!opencv-matrix\n   rows: 2\n   cols: 3\n   dt: f\n"
                                "   data: [ 6e-01, 0., 8.e-01,\n       0., -1., 0. ]\n");
    const LightFile lights = loadLightFile(folder / "m.yml");
    ASSERT_EQ(lights.lights.size(), 2u);
    EXPECT_NEAR(lights.lights[0].direction.z, 0.8f, 1e-6f);
    EXPECT_EQ(lights.lights[1].direction, glm::vec3(0, -1, 0));
    writeText(folder / "n.yml", "a: 1\n");
    expectError([&] { loadLightFile(folder / "n.yml"); }, {"n.yml", "holds no matrix"});
}

} // namespace
} // namespace nacre
