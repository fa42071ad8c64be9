#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include "app/arguments/destinations.h"
#include "app/commands/commands.h"
#include "app/materials/render_output.h"
#include "app/materials/transfer_pictures.h"
#include "engine/files/error.h"
#include "engine/files/stopwatch.h"
#include "engine/files/whole_file.h"
#include "engine/gpu/texture.h"
#include "engine/scene/picture_size.h"

namespace nacre {

namespace {

RenderOutput outputOf(const TransferArguments& arguments)
{
    if (arguments.frames < 1 || arguments.frames > kMostFrames) {
        throw Error("", fmt::format("--frames {} is out of range", arguments.frames),
                    fmt::format("1 to {}", kMostFrames), Error::kUsage);
    }
    if (!arguments.motion.empty() && arguments.frames == 1) {
        throw Error("", "--motion has nothing to move", "--frames with it", Error::kUsage);
    }
    if (!arguments.motion.empty() && arguments.motion != "turntable" && arguments.motion != "sweep") {
        throw Error("", fmt::format("--motion {} is not known", arguments.motion), "turntable or sweep", Error::kUsage);
    }
    RenderOutput output;
    output.frames = arguments.frames;
    output.motion = arguments.frames == 1         ? LightMotion::none
                    : arguments.motion == "sweep" ? LightMotion::sweep
                                                  : LightMotion::turntable;
    output.show = arguments.hatch ? Show::coverage : Show::picture;
    return output;
}

void print(const std::vector<TransferPicture>& pictures)
{
    size_t widest = 0;
    for (const TransferPicture& p : pictures) {
        widest = std::max(widest, p.rig.size() + p.row.size() + p.target.size());
    }
    for (const TransferPicture& p : pictures) {
        const std::string name = fmt::format("{}: {}, {}", p.rig, p.row, p.target);
        const std::string share = p.unmeasured <= 0 ? ""
                                                    : fmt::format("{:5.1f} % of the lit pixels ask for directions that "
                                                                  "were not measured",
                                                                  100 * p.unmeasured);
        fmt::print("{:<{}}  {:6.2f} s  {}\n", name, widest + 4, p.seconds, share);
    }
}

// Lists that would be half used are refused before anything is read.
void checkArguments(const TransferArguments& arguments)
{
    sizeFromArgument("--size", arguments.size);
    if (arguments.targets.empty()) {
        throw Error("", "no target is named", "--onto X,Y", Error::kUsage);
    }
}

void runTransfer(const TransferArguments& arguments)
{
    const Stopwatch watch;
    const auto seconds = [&] { return watch.seconds(); };
    checkArguments(arguments);
    const RenderOutput output = outputOf(arguments);
    requireDestination(arguments.output, arguments.force);
    WholeOutput folder(arguments.output, arguments.force);
    const Context context(arguments.device);
    const PictureSize size = sizeFromArgument("--size", arguments.size);
    requirePictureSize(context, size.width, size.height);
    const double deviceSeconds = seconds();
    const TransferSources sources = loadTransferSources(arguments);
    for (const std::string& warning : sources.warnings) {
        fmt::print(stderr, "nacre: warning: {}\n", warning);
    }
    const double before = seconds();
    std::filesystem::create_directory(folder.temporary());
    const std::vector<TransferPicture> pictures = saveTransferPictures(folder.temporary(), sources, output, context);
    folder.commit();
    if (!arguments.quiet) {
        print(pictures);
        fmt::print("seconds      device {:.2f}, materials {:.2f}, targets {:.2f}, pictures {:.2f}, in all {:.2f}\n",
                   deviceSeconds, sources.materialSeconds, sources.targetSeconds, seconds() - before, seconds());
        const std::string sheet = sources.rigs.size() > 1 ? "" : "_" + sources.rigs.front().name;
        fmt::print("wrote        {}/sheet{}.png and so on\n", arguments.output.string(), sheet);
    }
}

} // namespace

void addTransferCommand(CLI::App& app)
{
    auto arguments = std::make_shared<TransferArguments>();
    CLI::App* command = app.add_subcommand("transfer", "Materials on other shapes under several lights, side by side");
    command
        ->add_option("--materials", arguments->materials,
                     "Materials A,B,C: NAME.nacre[#MATERIAL], .binary, .bsdf, .exr, merl-abc:NAME, lambert:R,G,B, ...")
        ->allow_extra_args(false);
    command
        ->add_option("--onto", arguments->targets,
                     "Shapes X,Y, as nacre target takes them: mesh, normal or height map, NAME.nacre, make:NAME")
        ->allow_extra_args(false);
    command
        ->add_option("--rig", arguments->rigs,
                     "Rigs: key, three-point, raking, ring, environment; file of lights (.json, .lp; #N for one of "
                     "them) or environment (.exr, .hdr) [key]")
        ->allow_extra_args(false);
    command
        ->add_option("--labels", arguments->labels,
                     "One more row with a material for each part, 0=A,1=B; other parts have the first")
        ->allow_extra_args(false);
    command->add_option("--fits", arguments->fits,
                        "Folder of merl_abc_params.csv and merl_sgd_params.csv (default: $NACRE_FITS_DIR)");
    command->add_option("--size", arguments->size, "Size of each picture in pixels, WxH")->capture_default_str();
    command->add_option("--frames", arguments->frames, "Number of frames with moving lights, as .png and one .webp");
    command->add_option("--motion", arguments->motion,
                        "Motion of the lights: turntable (about the view) or sweep (left to right) [turntable]");
    command->add_flag("--hatch", arguments->hatch, "Stripes where the material was not measured");
    command->add_flag("--shadows", arguments->shadows, "Cast shadows, from the height of the shapes");
    command->add_option("-o,--output", arguments->output, "Folder for sheet_RIG.png and every single picture")
        ->required();
    command->add_option("--device", arguments->device,
                        "Vulkan device: number or part of its name in nacre info (default: the first)");
    command->add_option("--threads", arguments->threads, "Number of threads (0: all)")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    command->add_flag("--force", arguments->force, "Replacement of existing outputs");
    command->add_flag("--quiet", arguments->quiet, "No messages");
    command->footer(
        "Example:\n  nacre transfer --materials horse.nacre,merl-abc:brass --onto make:cloth,statue.obj "
        "--rig key,raking -o out\n"
        "  nacre transfer --labels 0=horse.nacre,1=lambert:0.8 --onto make:letters --rig lights.json#5 -o out");
    command->callback([arguments] { runTransfer(*arguments); });
}

} // namespace nacre
