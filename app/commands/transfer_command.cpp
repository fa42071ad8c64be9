#include <algorithm>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "app/arguments/destinations.h"
#include "app/commands/commands.h"
#include "app/materials/render_output.h"
#include "app/materials/transfer_sources.h"
#include "app/report/contact_sheet.h"
#include "engine/files/error.h"
#include "engine/files/stopwatch.h"
#include "engine/files/whole_file.h"
#include "engine/gpu/texture.h"
#include "engine/scene/coverage.h"
#include "engine/scene/picture_size.h"
#include "engine/scene/turn.h"
#include "shared/shading.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

// One picture or sequence that was drawn.
struct TransferPicture {
    std::string rig, row, target;
    double uncertain = 0; // see uncertainShare
    double seconds = 0;   // until the first picture was there, a new material's ball sizes included; coverage apart
};

constexpr int kLargestCell = 512; // pixels of a sheet's cell
constexpr const char* kBall = "ball";
// Up to so many lights every pixel looks each of them up; beyond, all are collapsed into a ball, whose texels show
// where a single light's shadow begins.
constexpr size_t kMostDirectLights = 16;

// The mean of boxes of pixels, in linear light; codes in [0,1].
Image shrunk(const Image& picture, int box)
{
    if (box == 1) {
        return picture;
    }
    Image small(picture.width / box, picture.height / box, 3);
    for (int y = 0; y < small.height; ++y) {
        for (int x = 0; x < small.width; ++x) {
            for (int c = 0; c < 3; ++c) {
                float sum = 0;
                for (int i = 0; i < box * box; ++i) {
                    sum += linearFromSrgb(picture.at(x * box + i % box, y * box + i / box, c));
                }
                small.at(x, y, c) = srgbFromLinear(sum / static_cast<float>(box * box));
            }
        }
    }
    return small;
}

// What fits below a cell.
std::string captionOf(const std::string& text, int cellWidth)
{
    constexpr int kLetterWidth = 7; // pixels, of most letters of a sheet
    const size_t letters = static_cast<size_t>(std::max(cellWidth / kLetterWidth, 4));
    return text.size() <= letters ? text : text.substr(0, letters - 2) + "..";
}

struct CellSize {
    int width = 0, height = 0;
    int box = 1; // pixels of a picture that become one of a cell
};

CellSize cellSizeOf(const TransferSources& sources)
{
    CellSize cell;
    for (const TransferTarget& target : sources.targets) {
        cell.width = std::max(cell.width, target.surface.normals.width);
        cell.height = std::max(cell.height, target.surface.normals.height);
    }
    cell.box = (std::max(cell.width, cell.height) + kLargestCell - 1) / kLargestCell;
    return {cell.width / cell.box, cell.height / cell.box, cell.box};
}

// Draws everything that one renderer has to: RIG_MATERIAL_on_TARGET.png (with frames numbered, and the same as .webp),
// RIG_MATERIAL_ball.png, and sheet_RIG.png with all of a rig: materials down, the ball and the targets across;
// sheet.png with all of several rigs. The folder exists.
class Studio {
public:
    Studio(const fs::path& folder, const TransferSources& sources, const RenderOutput& output, const Context& context)
        : folder_(folder), sources_(sources), output_(output), renderer_(context), cell_(cellSizeOf(sources)),
          sheets_(sources.rigs.size())
    {
    }

    std::vector<TransferPicture> draw()
    {
        for (auto& sheet : sheets_) {
            sheet.resize(sources_.rows.size());
        }
        for (size_t row = 0; row < sources_.rows.size(); ++row) {
            ballSizes_.clear();
            const int side = std::min(cell_.width, cell_.height) * cell_.box;
            drawColumn(row, kBall, referenceBall(sources_.rows[row], side));
            for (const TransferTarget& target : sources_.targets) {
                drawColumn(row, target.name, dressed(target, sources_.rows[row]));
            }
        }
        saveSheets();
        return std::move(pictures_);
    }

private:
    // One surface under all rigs.
    void drawColumn(size_t row, const std::string& target, Surface surface)
    {
        Stopwatch watch;
        Scene scene{.surface = std::move(surface), .lights = {}};
        renderer_.setSurface(scene.surface, ballSizes_);
        for (size_t rig = 0; rig < sources_.rigs.size(); ++rig) {
            scene.lights = sources_.rigs[rig].lights;
            TransferPicture picture{sources_.rigs[rig].name, sources_.rows[row].name, target};
            const Image first = save(scene, picture);
            picture.seconds = watch.seconds();
            picture.uncertain = uncertainShare(scene);
            const std::string caption =
                fmt::format("{}: {} {}{}", picture.rig, picture.row, target == kBall ? "" : "on ", target);
            sheets_[rig][row].push_back({shrunk(first, cell_.box), captionOf(caption, cell_.width)});
            pictures_.push_back(std::move(picture));
            watch.lap();
        }
    }

    // One a rig, and of several rigs one with all of them, below each other.
    void saveSheets() const
    {
        std::vector<std::vector<SheetCell>> all;
        for (size_t rig = 0; rig < sheets_.size(); ++rig) {
            const fs::path file = folder_ / fmt::format("sheet_{}.png", sources_.rigs[rig].name);
            saveImage(file, contactSheet(sheets_[rig], cell_.width, cell_.height), PixelType::uint8);
            all.insert(all.end(), sheets_[rig].begin(), sheets_[rig].end());
        }
        if (sheets_.size() > 1) {
            saveImage(folder_ / "sheet.png", contactSheet(all, cell_.width, cell_.height), PixelType::uint8);
        }
    }

    // Answers the first frame.
    Image save(const Scene& scene, const TransferPicture& picture)
    {
        RenderOutput output = output_;
        output.path = scene.lights.size() <= kMostDirectLights ? RenderPath::direct : RenderPath::automatic;
        const char* between = picture.target == kBall ? "" : "on_";
        output.file = folder_ / fmt::format("{}_{}_{}{}.png", picture.rig, picture.row, between, picture.target);
        renderFrames(renderer_, output, scene);
        if (output.frames > 1) {
            output.isAnimation = true;
            output.file.replace_extension(".webp");
            renderFrames(renderer_, output, scene);
        }
        if (output.path == RenderPath::automatic) {
            ballSizes_ = renderer_.ballSizes();
        }
        renderer_.setLights(movedLights(scene.lights, output_.motion, 0, output_.frames));
        return renderer_.picture();
    }

    const fs::path& folder_;
    const TransferSources& sources_;
    const RenderOutput& output_;
    Renderer renderer_;
    CellSize cell_;
    std::vector<BallSize> ballSizes_;                         // of the row's materials, once they are known
    std::vector<std::vector<std::vector<SheetCell>>> sheets_; // by rig and row
    std::vector<TransferPicture> pictures_;
};

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
        fmt::print("{:<{}}  {:6.2f} s  {}\n", name, widest + 4, p.seconds, describeUncertainShare(p.uncertain));
    }
}

// Lists that would be half used are refused before anything is read.
void checkArguments(const TransferArguments& arguments)
{
    sizeFromArgument("--size", arguments.size);
    if (!arguments.turn.empty()) {
        turnFromText(arguments.turn);
    }
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
    requireWholeFolder(arguments.output, arguments.force, "sheet");
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
    const std::vector<TransferPicture> pictures = Studio(folder.temporary(), sources, output, context).draw();
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
                     "One more row with a material for each part, 1=A,2=B; other parts have the first")
        ->allow_extra_args(false);
    command->add_option("--fits", arguments->fits,
                        "Folder of merl_abc_params.csv and merl_sgd_params.csv (default: $NACRE_FITS_DIR)");
    command->add_option("--size", arguments->size, "Size of each picture in pixels, WxH")->capture_default_str();
    command->add_option("--frames", arguments->frames, "Number of frames with moving lights, as .png and one .webp");
    command->add_option("--motion", arguments->motion,
                        "Motion of the lights: turntable (about the view) or sweep (left to right) [turntable]");
    command->add_option("--turn", arguments->turn,
                        "Turn of the shapes, by their heights but for meshes, in degrees, YAW,PITCH[,ROLL] [0,0]");
    command->add_flag("--hatch", arguments->hatch, "Stripes where a picture is uncertain by over 20 %");
    command->add_flag("--shadows", arguments->shadows, "Cast shadows, from the height of the shapes");
    command->add_option("-o,--output", arguments->output, "Folder for sheet_RIG.png and every single picture")
        ->option_text("OUT")
        ->required();
    command->add_option(
        "--device", arguments->device,
        "Vulkan device: number or part of its name in nacre info (default: $NACRE_DEVICE, else the best)");
    command->add_option("--threads", arguments->threads, "Number of threads (0: all)")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    command->add_flag("--force", arguments->force, "Replacement of existing outputs");
    command->add_flag("--quiet", arguments->quiet, "No messages");
    command->footer(
        "Example:\n  nacre transfer --materials horse.nacre,merl-abc:brass --onto make:cloth,statue.obj "
        "--rig key,raking -o out\n"
        "  nacre transfer --labels 1=horse.nacre,2=lambert:0.8 --onto make:letters --rig lights.json#5 -o out");
    command->callback([arguments] { runTransfer(*arguments); });
}

} // namespace nacre
