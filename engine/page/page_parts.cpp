#include "engine/page/page_parts.h"

#include <algorithm>

#include <fmt/format.h>

namespace nacre {

size_t PageParts::add(const std::string& kind, std::string text)
{
    parts_.push_back({kind, std::move(text)});
    return parts_.size() - 1;
}

std::string PageParts::elements() const
{
    std::string html;
    for (size_t i = 0; i < parts_.size(); ++i) {
        html +=
            fmt::format("<script type=\"application/octet-stream\" id=\"part-{}\">{}</script>\n", i, parts_[i].text);
    }
    return html;
}

std::vector<PageParts::Share> PageParts::shares() const
{
    std::vector<Share> shares;
    for (const Part& part : parts_) {
        auto known = std::find_if(shares.begin(), shares.end(), [&](const Share& s) { return s.kind == part.kind; });
        if (known == shares.end()) {
            known = shares.insert(known, {part.kind, 0});
        }
        known->bytes += part.text.size();
    }
    return shares;
}

} // namespace nacre
