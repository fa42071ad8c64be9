#pragma once
#include <string>

#include "acquisition/brdf/model_ladder.h"
#include "engine/exchange/lobe_model.h"

namespace nacre {

enum class ExchangeFormat { gltf, standardSurface };

std::unique_ptr<LobeModel> modelOf(ExchangeFormat format, const LobeShape& shape, bool hasSheen);

struct LobeFit {
    ExchangeFormat format = ExchangeFormat::gltf;
    LobeShape shape{};
    LobeColours colours{}; // rounded as the files have them
    double psnr = 0;       // dB, as ModelJudge has it
    double corePsnr = 0;   // of the format's few parameters: what readers without extensions can show at best

    bool hasSheen() const { return colours.sheen != glm::vec3(0); }
};

// How near parameters can come is judged against these, in the same dB.
struct LobeFitScale {
    double expected = 0; // of a table that errs by its own expected error everywhere; infinite where it has none
    double black = 0;    // of nothing at all
};
LobeFitScale fitScale(const ModelJudge& judge);

// The fit misses by more than 3 % of the bright end (30 dB) and by more than the table itself is expected to.
bool isFar(const LobeFit& fit, const LobeFitScale& scale);
// What is missed is more than half of what is there (6 dB).
bool isNothing(const LobeFit& fit, const LobeFitScale& scale);

// The parameters nearest to the material. What a format has beyond its few first parameters (glTF's extensions,
// sheen) is used where it brings half a dB and less than 45 dB are reached. Colours stay below `most`. The judge must
// not be empty.
LobeFit fitLobes(const ModelJudge& judge, ExchangeFormat format, float most = 1, int threads = 0);

} // namespace nacre
