#include "app/report/contact_sheet.h"

#include <algorithm>

namespace nacre {

namespace {

constexpr int kGap = 8;
constexpr int kCaptionHeight = 22;
constexpr int kLetterHeight = 14;
constexpr float kBackground = 0.12f;

void place(const Image& picture, int left, int top, int width, int height, Image& sheet)
{
    const int x0 = left + std::max(0, (width - picture.width) / 2),
              y0 = top + std::max(0, (height - picture.height) / 2);
    for (int y = 0; y < std::min(height, picture.height); ++y) {
        for (int x = 0; x < std::min(width, picture.width); ++x) {
            sheet.setRgb(x0 + x, y0 + y, picture.rgb(x, y));
        }
    }
}

} // namespace

Image contactSheet(const std::vector<std::vector<SheetCell>>& rows, int cellWidth, int cellHeight)
{
    size_t columns = 0;
    for (const auto& row : rows) {
        columns = std::max(columns, row.size());
    }
    const int stepX = cellWidth + kGap, stepY = cellHeight + kCaptionHeight + kGap;
    Image sheet(static_cast<int>(columns) * stepX + kGap, static_cast<int>(rows.size()) * stepY + kGap, 3, kBackground);
    for (size_t r = 0; r < rows.size(); ++r) {
        for (size_t c = 0; c < rows[r].size(); ++c) {
            const int left = kGap + static_cast<int>(c) * stepX, top = kGap + static_cast<int>(r) * stepY;
            place(rows[r][c].picture, left, top, cellWidth, cellHeight, sheet);
            drawText(sheet, left + 2, top + cellHeight + kCaptionHeight - 6, rows[r][c].caption, kLetterHeight);
        }
    }
    return sheet;
}

} // namespace nacre
