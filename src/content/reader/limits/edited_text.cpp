#include "content/reader/limits/edited_text.h"

#include "base/text.h"
#include "base/whole_text.h"
#include "content/reader/places.h"

#include <charconv>
#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace lfdsim::reader {
namespace {

// Returns the first word of a line, and removes it from the line; next_number() does so with a number.
std::string_view next_word(std::string_view& line) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t\r"), line.size()));
    const std::string_view word = line.substr(0, line.find_first_of(" \t\r"));
    line.remove_prefix(word.size());
    return word;
}

std::optional<double> next_number(std::string_view& line) {
    std::string_view word = next_word(line);
    if (word.starts_with('+')) word.remove_prefix(1);
    return whole_text<double>(word);
}

/// Decides for one line after the other whether it holds a position: after the keyword of OBJ or STL, or in OFF in as many lines
/// after the counts as there are vertices.
class Positions {
  public:
    explicit Positions(std::string_view ending) : off_(ending == ".off"), key_(ending == ".obj" ? "v" : "vertex") {}

    /// Returns what precedes the position in a line; nothing if the line has none.
    std::optional<std::string_view> before(std::string_view line) {
        std::string_view rest = line;
        const std::string_view word = next_word(rest);
        if (!off_) return word == key_ ? std::optional(line.substr(0, line.size() - rest.size())) : std::nullopt;
        if (word.empty() || word.starts_with('#')) return {};
        if (left_ > 0) return --left_, line.substr(0, 0);
        if (known_) return {};
        if (!word.ends_with("OFF")) rest = line;
        if (const auto count = next_number(rest)) {
            known_ = true;
            left_ = *count > 0 && *count < 9e15 ? std::size_t(*count) : 0;
        }
        return {};
    }

  private:
    bool off_, known_ = false;
    std::string_view key_;
    std::size_t left_ = 0;  // positions of an OFF file to come
};

/// A line's position, and what follows it.
struct EditedLine {
    Place place;
    std::string_view rest;
};
std::optional<EditedLine> position(std::string_view text) {
    EditedLine found;
    for (unsigned k = 0; k < 3; ++k) {
        const auto x = next_number(text);
        if (!x) return {};
        found.place[k] = *x;
    }
    found.rest = text;
    return found;
}

// Returns whether a position has a fourth number, by which it is divided, or continues in another line.
bool is_unusual(std::string_view rest) {
    int count = 0;
    while (next_number(rest)) ++count;
    return count == 1 || rest.ends_with('\\');
}

// Returns a colour's words as they are, and of a grey that is given by one number three. Throws std::runtime_error, which names the
// place, for other numbers of words.
std::string three_numbers(std::string_view colour, const std::string& place) {
    std::string all;
    std::string_view rest = colour, word;
    int count = 0;
    for (word = next_word(rest); !word.empty() && !word.starts_with('#'); word = next_word(rest), ++count)
        all.append(" ").append(word);
    if (count == 1) return all + all + all;
    if (count < 3) throw std::runtime_error(place + ": a colour (Kd) has one or three numbers, this one " + std::to_string(count));
    return all;
}

// Returns whether an STL file is binary: its size is that of a header and as many facets as it counts, as Assimp decides, too.
constexpr std::size_t stl_header = 84, stl_facet = 50;
bool is_binary_stl(std::string_view bytes) {
    std::uint32_t facets = 0;
    if (bytes.size() < stl_header) return false;
    std::memcpy(&facets, bytes.data() + stl_header - sizeof facets, sizeof facets);
    return bytes.size() == stl_header + stl_facet * std::size_t(facets);
}

}  // namespace

std::optional<ScaledText> readable_positions(std::string_view text, std::string_view ending) {
    // The first pass finds the middle, the second writes positions relative to it.
    BoxMiddle middle;
    std::string_view rest = text;
    for (Positions positions(ending); !rest.empty();) {
        const std::string_view line = next_line(rest);
        const auto before = positions.before(line);
        if (!before) continue;
        const auto found = position(line.substr(before->size()));
        if (!found || (ending == ".obj" && is_unusual(found->rest))) return {};
        middle.add(found->place);
    }
    const int exponent = middle.size() < 1e-6 ? middle.exponent() : 0;  // Assimp reads 15 digits after the point
    const Place offset = middle.offset();
    if (offset == Place() && exponent == 0) return {};
    const double factor = std::ldexp(1., exponent);
    std::string out;
    out.reserve(text.size());
    rest = text;
    for (Positions positions(ending); !rest.empty();) {
        const std::string_view line = next_line(rest);
        const auto before = positions.before(line);
        const auto found = before ? position(line.substr(before->size())) : std::nullopt;
        if (!found) {
            out.append(line) += '\n';
            continue;
        }
        out += *before;
        for (unsigned k = 0; k < 3; ++k) {
            char digits[64];
            const auto moved = float((found->place[k] - offset[k]) * factor);
            const auto end = std::to_chars(digits, digits + sizeof digits, moved, std::chars_format::fixed);
            out.append(" ").append(digits, end.ec == std::errc() ? end.ptr : digits);
        }
        out.append(found->rest) += '\n';
    }
    return ScaledText{std::move(out), exponent};
}

bool lower_keywords(std::string& text) {
    if (is_binary_stl(text)) return false;
    bool changed = false;
    const auto lower = [&](std::string_view word) {
        for (std::size_t i = std::size_t(word.data() - text.data()), end = i + word.size(); i < end; ++i) {
            changed |= text[i] != lower_case(text[i]);
            text[i] = lower_case(text[i]);
        }
    };
    std::string_view rest = text;
    while (!rest.empty()) {
        std::string_view line = next_line(rest);
        const std::string_view key = next_word(line);
        lower(key);
        if (!key.ends_with("solid")) lower(next_word(line));  // "normal" or "loop"; after "solid" comes a name
    }
    return changed;
}

bool invert_materialise_bits(std::string& bytes) {
    if (!is_binary_stl(bytes) || bytes.substr(0, 80).find("COLOR=") == std::string::npos) return false;
    bool coloured = false;
    for (std::size_t end = stl_header + stl_facet; end <= bytes.size(); end += stl_facet)
        coloured = coloured || bytes[end - 2] != 0 || bytes[end - 1] != 0;
    for (std::size_t end = stl_header + stl_facet; coloured && end <= bytes.size(); end += stl_facet)
        bytes[end - 1] = char(bytes[end - 1] ^ 0x80);
    return coloured;
}

bool separate_libraries(std::string& text) {
    bool changed = false;
    for (std::size_t at = text.find("mtllib "); at != std::string::npos; at = text.find("mtllib ", at + 1)) {
        if (at > 0 && text[at - 1] != '\n') continue;
        const std::string line = text.substr(at, text.find('\n', at) - at);
        const char* const end = strcasestr(line.c_str(), ".mtl ");
        if (!end) continue;
        const std::size_t after = at + std::size_t(end - line.c_str()) + 4, next = text.find_first_not_of(" \t", after);
        const bool last = next == std::string::npos || text[next] == '\r' || text[next] == '\n';
        text.replace(after, next - after, last ? "" : "\nmtllib ");
        changed = true;
    }
    return changed;
}

bool lead_with_digits(std::string& text) {
    std::string out;
    std::size_t copied = 0;  // of the text
    bool wanted = false, continues = false;
    for (std::string_view rest = text; !rest.empty();) {
        std::string_view words = next_line(rest);
        const std::size_t last = words.find_last_not_of('\r');
        const bool ends_open = last != words.npos && words[last] == '\\';  // the next line continues this one
        if (!continues) wanted = next_word(words).starts_with('v');
        continues = ends_open;
        for (std::size_t at = words.find('.'); wanted && at != words.npos; at = words.find('.', at + 1)) {
            if (at > 0 && std::string_view(" \t+-").find(words[at - 1]) == std::string_view::npos) continue;
            const auto point = std::size_t(words.data() + at - text.data());
            out.append(text, copied, point - copied) += '0';
            copied = point;
        }
    }
    if (copied == 0) return false;
    text = out.append(text, copied);
    return true;
}

void note_free_forms(std::string_view text, NotShown& not_shown) {
    while (!text.empty()) {
        std::string_view line = next_line(text);
        const std::string_view key = next_word(line);
        if (key == "cstype" || key == "curv" || key == "curv2" || key == "surf") not_shown.add("free-form curves and surfaces");
    }
}

void note_face_colours(std::string_view text, std::string_view ending, NotShown& not_shown) {
    if (ending == ".x3d") {
        for (const char* const of_faces : {"colorPerVertex=\"false\"", "colorPerVertex='false'"})
            if (text.find("<Color") != text.npos && text.find(of_faces) != text.npos)
                not_shown.add("colours of X3D faces (vertices have them instead, blended)");
        return;
    }
    // An OFF file has a header, the numbers of vertices, faces and edges, and a line for each vertex and face: "3 0 1 2 255 0 0".
    std::optional<double> vertices;
    while (!text.empty()) {
        std::string_view line = next_line(text);
        line = line.substr(0, line.find('#'));
        std::string_view rest = line;
        const std::string_view word = next_word(rest);
        if (word.empty()) continue;
        if (!vertices) {
            vertices = next_number(word.ends_with("OFF") ? rest : line);
            continue;
        }
        if ((*vertices)-- > 0) continue;
        std::size_t words = 0;
        while (!next_word(rest).empty()) ++words;
        if (words > whole_text<std::size_t>(word).value_or(words)) return not_shown.add("colours of OFF faces");
    }
}

std::string readable_materials(std::string_view text, const std::string& name, std::map<std::string, Tiling>& tilings,
                               NotShown& not_shown) {
    std::string out, material;
    std::size_t number = 0;  // of the line
    while (!text.empty()) {
        const std::string_view line = next_line(text);
        std::string_view rest = line;
        const std::string_view key = next_word(rest);
        if (same_without_case(key, "newmtl")) material = trimmed(rest);
        ++number;
        if (same_without_case(key, "Kd")) {
            out.append(key).append(three_numbers(rest, name + ", line " + std::to_string(number))) += '\n';
            continue;
        }
        if (!same_without_case(key, "map_Kd")) {
            out.append(line) += '\n';
            continue;
        }
        out.append(key);
        // One option after the other is removed from the line: -s and -o become the material's tiling, -clamp is kept.
        for (std::string_view after = rest; next_word(after).starts_with('-') && !after.empty(); after = rest) {
            const std::string option(next_word(rest));
            if (option == "-s" || option == "-o" || option == "-t") {
                Tiling& tiling = tilings[material];
                std::array<double, 2>& to = option == "-s" ? tiling.scale : tiling.offset;
                std::string_view numbers = rest;
                for (std::size_t k = 0; k < 3; ++k) {  // the third is of textures in space
                    const auto x = next_number(numbers);
                    if (!x || numbers.find_first_not_of(" \t\r") == std::string_view::npos) break;
                    if (k < 2 && option != "-t") to[k] = *x;
                    rest = numbers;
                }
                if (option == "-t") not_shown.add("turbulent textures");
                continue;
            }
            const std::size_t arguments = option == "-mm" ? 2 : 1;
            std::string all = " " + option;
            for (std::size_t k = 0; k < arguments; ++k) all.append(" ").append(next_word(rest));
            if (option == "-clamp")
                out += all;
            else if (option == "-mm" || option == "-boost" || option == "-imfchan")
                not_shown.add("options " + option + " of textures");
        }
        out.append(rest) += '\n';
    }
    return out;
}

}  // namespace lfdsim::reader
