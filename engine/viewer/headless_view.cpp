#include "engine/viewer/headless_view.h"

#include <fmt/format.h>

#include "engine/scene/coverage.h"
#include "engine/scene/scene_residual.h"
#include "engine/view_state/verdict_picture.h"
#include "engine/viewer/screenshots.h"
#include "engine/viewer/view_pictures.h"

namespace nacre {

void viewHeadless(const Context& context, ViewState state, const Choices& choices, const SceneSource& source,
                  const std::filesystem::path& output)
{
    resolveCaptured(state, choices.captured);
    requireShown(state);
    ViewPictures pictures(context);
    if (state.show == Show::verdicts) {
        source.photographs->load([](float) {}, false);
        pictures.setPhotographs(source.photographs.get());
    }
    pictures.setScene(loadScene(source, state, choices, {}, {}), state);
    const glm::vec3 view = viewDirectionOf(state);
    requireResidual(pictures.scene().main->surface, view, state.residual);
    pictures.apply(state, view, choices.captured);
    saveScreenshot(output, pictures.picture(), state);
    if (const double share = pictures.uncertainShare(); share > 0) {
        fmt::print("uncertain    {}, judged by the BRDF alone\n", describeUncertainShare(share));
    }
    if (!pictures.verdicts().empty()) {
        fmt::print("verdicts     {}\n", describeVerdicts(pictures.verdicts()));
    }
}

} // namespace nacre
