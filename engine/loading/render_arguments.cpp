#include "engine/loading/render_arguments.h"

namespace nacre {

void completeFromState(RenderArguments& arguments)
{
    if (!arguments.state.empty()) {
        completeScene(arguments, arguments.state);
    }
}

} // namespace nacre
