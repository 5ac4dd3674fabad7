// Letters of 5 x 7 dots, drawn enlarged; knows ASCII letters, figures and the marks that captions need.
#pragma once

#include <string_view>

#include "tools/draw/image.h"

namespace echoloop::draw {

enum class Anchor { left, middle, right };

/// Width in px of a line of text at `scale` px per dot.
int text_width(std::string_view text, int scale);
/// Height in px of a capital letter.
constexpr int text_height(int scale) { return 7 * scale; }

/// Draws one line. `y` is its vertical middle, `x` its left end, middle or right end as `anchor` says. UTF-8;
/// a character without a glyph is drawn as a question mark.
void draw_text(Image& image, int x, int y, std::string_view text, Color color, int scale = 2,
               Anchor anchor = Anchor::left);

}  // namespace echoloop::draw
