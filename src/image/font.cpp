#include "image/font.h"

#include "base/text.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

// The glyphs of ' ' to '~', then of the degree sign. Each character of a glyph is a row of five dots, top first, as a digit in base
// 32 (0-9, A-V; 16 is the left dot); rows eight and nine are below the base line.
constexpr std::string_view glyphs[] = {
    "",          "4444404",   "AAA",      "AAVAVAA",  "4FKE5U4",   "OP248J3", "CIK8LID", "44",      "2488842", "8422248",
    "04LEL4",    "044V44",    "00000C48", "000V",     "00000CC",   "11248GG", "EHJLPHE", "4C4444E", "EH1248V", "V2421HE",
    "26AIV22",   "VGU11HE",   "68GUHHE",  "V124888",  "EHHEHHE",   "EHHF12C", "0CC0CC0", "0CC0C48", "248G842", "00V0V",
    "8421248",   "EH12404",   "EHNLNGE",  "EHHVHHH",  "UHHUHHU",   "EHGGGHE", "SIHHHIS", "VGGUGGV", "VGGUGGG", "EHGNHHF",
    "HHHVHHH",   "E44444E",   "72222IC",  "HIKOKIH",  "GGGGGGV",   "HRLLHHH", "HHPLJHH", "EHHHHHE", "UHHUGGG", "EHHHLID",
    "UHHUKIH",   "FGGE11U",   "V444444",  "HHHHHHE",  "HHHHHA4",   "HHHLLLA", "HHA4AHH", "HHHA444", "V1248GV", "E88888E",
    "GG84211",   "E22222E",   "4AH",      "0000000V", "84",        "00E1FHF", "GGMPHHU", "00EGGHE", "11DJHHF", "00EHVGE",
    "698S888",   "00FHHHF1E", "GGMPHHH",  "40C444E",  "2062222IC", "GGIKOKI", "C44444E", "00QLLHH", "00MPHHH", "00EHHHE",
    "00UHHHUGG", "00FHHHF11", "00MPGGG",  "00FGE1U",  "88S8896",   "00HHHJD", "00HHHA4", "00HHLLA", "00HA4AH", "00HHHHF1E",
    "00V248V",   "2448442",   "4444444",  "8442448",  "008L2",     "CIIC"};
constexpr std::string_view box = "VHHHHHV", plus_minus = "44V440V";

// The letters of U+00C0 to U+00FF without their accents.
constexpr std::string_view latin = "AAAAAAACEEEEIIIIDNOOOOOxOUUUUYTsaaaaaaaceeeeiiiidnooooo/ouuuuyty";
static_assert(latin.size() == 64);

std::string_view glyph(char32_t c) {
    if (c == 0xb0) return glyphs[0x7f - 0x20];
    if (c == 0xb1) return plus_minus;
    if (c == 0x2032 || c == 0x2019) c = '\'';  // prime, apostrophe
    if (c >= 0xc0 && c <= 0xff) c = char32_t(latin[c - 0xc0]);
    if (c == 0xb5 || c == 0x3bc) c = 'u';                      // micro
    if ((c >= 0x2010 && c <= 0x2015) || c == 0x2212) c = '-';  // dashes, minus
    return c >= 0x20 && c < 0x7f ? glyphs[c - 0x20] : box;
}

// Removes the first character of a text that is not empty and returns its code. Bytes that are not UTF-8 are returned one by one,
// as U+FFFD, which has no glyph.
char32_t take_character(std::string_view& text) {
    const auto lead = static_cast<unsigned char>(text[0]);
    const std::size_t bytes = lead < 0xc0 ? 1 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
    char32_t code = bytes == 1 ? lead : lead & (0x7fu >> bytes);
    std::size_t n = 1;
    for (; n < bytes && n < text.size() && !begins_character(text[n]); ++n) code = code << 6 | (text[n] & 0x3f);
    text.remove_prefix(n);
    return n < bytes || (bytes == 1 && lead >= 0x80) ? 0xfffd : code;
}

// Returns the five bits of a digit in base 32.
int dots(char digit) { return digit <= '9' ? digit - '0' : digit - 'A' + 10; }

/// A glyph as pens draw it: lines of a dot's width, with round ends, from each dot to its neighbours.
class Strokes {
  public:
    explicit Strokes(std::string_view rows) : rows_(rows) {}
    int height() const { return int(rows_.size()); }
    /// Returns the distance in dots from a point, in dots from the upper left corner, to the nearest line; 10 if there is none.
    double distance(double x, double y) const {
        double least = 10;
        for (int j = 0; j < height(); ++j)
            for (int i = 0; i < 5; ++i) {
                if (!dot(i, j)) continue;
                least = std::min(least, to_line(x, y, i, j, i, j));
                if (dot(i + 1, j)) least = std::min(least, to_line(x, y, i, j, i + 1, j));
                if (dot(i, j + 1)) least = std::min(least, to_line(x, y, i, j, i, j + 1));
                for (const int side : {-1, 1})  // a diagonal, unless a third dot makes it a corner
                    if (dot(i + side, j + 1) && !dot(i + side, j) && !dot(i, j + 1))
                        least = std::min(least, to_line(x, y, i, j, i + side, j + 1));
            }
        return least;
    }

  private:
    bool dot(int i, int j) const { return i >= 0 && i < 5 && j < height() && (dots(rows_[std::size_t(j)]) >> (4 - i) & 1); }
    /// Returns the distance from a point to the line between the centres of two dots, which may be the same.
    static double to_line(double x, double y, int i, int j, int to_i, int to_j) {
        const double u = to_i - i, v = to_j - j, dx = x - i - 0.5, dy = y - j - 0.5, square = u * u + v * v;
        const double along = square > 0 ? std::clamp((dx * u + dy * v) / square, 0., 1.) : 0;
        return std::hypot(dx - along * u, dy - along * v);
    }
    std::string_view rows_;
};

}  // namespace

int readable_scale(int picture_width) { return std::max(1, (picture_width + 479) / 480); }

void draw_text(Image& image, int x, int y, int scale, std::string_view text, float light) {
    while (!text.empty()) {
        const Strokes strokes(glyph(take_character(text)));
        for (int dot_y = 0; dot_y < strokes.height() * scale; ++dot_y)
            for (int dot_x = 0; dot_x < 5 * scale; ++dot_x) {
                const int column = x + dot_x, row = y + dot_y;
                if (column < 0 || row < 0 || column >= image.width || row >= image.height) continue;
                const double away = scale * strokes.distance((dot_x + 0.5) / scale, (dot_y + 0.5) / scale);
                // Share of this pixel that the line covers, as if its edge were straight there; dots of one pixel are sharp.
                const auto covered = float(scale == 1 ? away == 0 : std::clamp(0.5 * scale - away + 0.5, 0., 1.));
                for (int channel = 0; channel < 3; ++channel) {
                    float& value = image.at(column, row)[channel];
                    value = covered < 1 ? value + covered * (light - value) : light;
                }
            }
        x += glyph_width * scale;
    }
}

}  // namespace lfdsim
