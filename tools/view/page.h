// The page's files, built into the program from tools/view/page.
#pragma once

#include <string>
#include <string_view>

namespace echoloop::view {

struct PagePart {
    std::string_view path, type;  ///< "/", "text/html; charset=utf-8"
    std::string text;
};

/// nullptr if there is none at that path.
const PagePart* find_page_part(std::string_view path);

}  // namespace echoloop::view
