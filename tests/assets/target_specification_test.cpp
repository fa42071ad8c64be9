// How targets are named, and what is said of names that do not exist.
#include <map>

#include <gtest/gtest.h>

#include "assets/targets.h"
#include "engine/files/error.h"

namespace nacre {
namespace {

std::string refusal(const std::string& specification)
{
    try {
        makeTarget(specification, 8, 8);
    } catch (const Error& error) {
        EXPECT_EQ(error.exitCode(), Error::kUsage) << specification;
        return error.what();
    }
    ADD_FAILURE() << specification << " was taken";
    return "";
}

bool contains(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

TEST(TargetSpecification, RefusalsListWhatThereIs)
{
    for (const TargetName& name : targetNames()) {
        EXPECT_PRED2(contains, refusal("marble"), name.name);
        EXPECT_FALSE(name.description.empty());
    }
    EXPECT_PRED2(contains, refusal("cloth:herringbone"), "satin8");
    EXPECT_PRED2(contains, refusal("cloth:twill,colour=1"), "threads");
    EXPECT_PRED2(contains, refusal("cloth:threads=3"), "from 4 to 200");
    EXPECT_PRED2(contains, refusal("letters:N%CRE"), "ABC");
    EXPECT_PRED2(contains, refusal("sphere:seed=1"), "no keys");
}

TEST(TargetSpecification, MalformedOnesAreRefused)
{
    for (const char* specification : {"",
                                      ":",
                                      "cloth:",
                                      "cloth,",
                                      "cloth:twill,",
                                      "cloth:twill,threads",
                                      "cloth:twill,threads=",
                                      "cloth:threads=many",
                                      "cloth:threads=20.5",
                                      "cloth:curl=nan",
                                      "cloth:curl=1e9",
                                      "cloth:curl=0.5x",
                                      "cloth:twill,satin5",
                                      "knit:plain",
                                      "letters:",
                                      "letters: ",
                                      "letters:/",
                                      "letters,stroke=1",
                                      "drape:flag",
                                      "head:turn=90",
                                      "Cloth"}) {
        refusal(specification);
    }
    EXPECT_THROW(makeTarget("cloth", 1, 64), Error);
}

TEST(TargetSpecificationSlow, DefaultsAreWhatTheirDescriptionSays)
{
    const std::pair<const char*, const char*> kSame[] = {
        {"cloth", "cloth:plain,threads=32,curl=0.5,drape=0.35,wander=1,seed=1"},
        {"cloth", "cloth,seed=1"},
        {"knit", "knit:loops=18,curl=0.5,drape=0.25,wander=1,stripes=4,seed=1"},
        {"letters", "letters:nacre,stroke=0.24,bevel=0.6,relief=0.13,roughness=1,seed=1"},
        {"drape", "drape:hung,stiffness=0.1,seed=1"},
        {"head", "head:turn=24,bow=5"}};
    for (const auto& [a, b] : kSame) {
        EXPECT_EQ(makeTarget(a, 32, 32).normals.normals, makeTarget(b, 32, 32).normals.normals) << b;
    }
}

TEST(TargetSpecificationSlow, EveryKeyChangesTheTarget)
{
    std::map<std::string, std::vector<glm::vec3>> made; // of defaults
    for (const char* specification :
         {"cloth:twill",         "cloth:seed=2",   "cloth:threads=31",   "cloth:curl=0.1",    "cloth:drape=0.1",
          "cloth:wander=0",      "knit:seed=2",    "knit:loops=12",      "knit:curl=0",       "knit:drape=0",
          "knit:wander=0",       "letters:seed=2", "letters:stroke=0.1", "letters:bevel=1",   "letters:relief=0.3",
          "letters:roughness=0", "letters:NACRA",  "drape:seed=2",       "drape:stiffness=1", "drape:ball",
          "head:turn=0",         "head:bow=0"}) {
        const std::string name(specification, std::string(specification).find(':'));
        if (!made.contains(name)) {
            made[name] = makeTarget(name, 48, 48).normals.normals;
        }
        EXPECT_NE(made[name], makeTarget(specification, 48, 48).normals.normals) << specification;
    }
    EXPECT_NE(makeTarget("knit", 48, 48).labels, makeTarget("knit:stripes=1", 48, 48).labels);
}

} // namespace
} // namespace nacre
