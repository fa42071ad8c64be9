#include "assets/synth/synth_options.h"

namespace nacre {

SynthOptions demoCapture()
{
    SynthOptions options;
    options.width = 300;
    options.height = 300;
    options.sphereSize = 320;
    options.material = "ggx:diffuse=0.10,0.34,0.30;specular=0.05,0.045,0.035;alpha=0.15"; // celadon glaze
    options.seed = 7;
    return options;
}

} // namespace nacre
