#include "image/font.h"

#include <algorithm>

namespace lfdsim {
namespace {

// ' ' to '~', then the degree sign. Each character of a glyph is a row of five dots, top first, as a digit in base 32 (0-9, A-V; 16
// is the left dot); rows eight and nine hang below the line.
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
constexpr std::string_view box = "VHHHHHV";

// UTF-8 writes the degree sign as c2 b0.
std::string_view glyph(unsigned char c) {
    if (c == 0xb0) return glyphs[0x7f - 0x20];
    return c >= 0x20 && c < 0x7f ? glyphs[c - 0x20] : box;
}

int dots(char digit) { return digit <= '9' ? digit - '0' : digit - 'A' + 10; }

}  // namespace

int readable_scale(int picture_width) { return std::max(1, (picture_width + 479) / 480); }

void draw_text(Image& image, int x, int y, int scale, std::string_view text, float light) {
    for (const char c : text) {
        if (c == '\xc2') continue;
        const std::string_view rows = glyph(static_cast<unsigned char>(c));
        for (int dot_y = 0; dot_y < int(rows.size()) * scale; ++dot_y)
            for (int dot_x = 0; dot_x < 5 * scale; ++dot_x) {
                const int column = x + dot_x, row = y + dot_y;
                if ((dots(rows[std::size_t(dot_y / scale)]) >> (4 - dot_x / scale) & 1) == 0) continue;
                if (column < 0 || row < 0 || column >= image.width || row >= image.height) continue;
                for (int channel = 0; channel < 3; ++channel) image.at(column, row)[channel] = light;
            }
        x += glyph_width * scale;
    }
}

}  // namespace lfdsim
