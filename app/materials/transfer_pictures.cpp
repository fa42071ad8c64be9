#include "app/materials/transfer_pictures.h"

#include <algorithm>

#include <fmt/format.h>

#include "app/report/contact_sheet.h"
#include "engine/files/stopwatch.h"
#include "engine/scene/coverage.h"
#include "shared/shading.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

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

// Draws everything that one renderer has to, and collects the sheets.
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
            picture.unmeasured = unmeasuredShare(scene).pixels;
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

} // namespace

std::vector<TransferPicture> saveTransferPictures(const fs::path& folder, const TransferSources& sources,
                                                  const RenderOutput& output, const Context& context)
{
    return Studio(folder, sources, output, context).draw();
}

} // namespace nacre
