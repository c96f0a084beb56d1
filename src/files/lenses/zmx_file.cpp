#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <span>

#include "base/counted.h"
#include "base/printable.h"
#include "base/problems.h"
#include "base/whole_text.h"
#include "files/description/decode.h"
#include "files/description/nearest.h"
#include "files/lenses/drawn_lens.h"

// Zemax's .zmx: a line is a keyword and its values. "SURF n" begins a surface, whose lines are indented.
namespace lfdsim {
namespace {

constexpr std::size_t most_surfaces_of_zmx = 1000;

// Keywords that change no ray: names and notes, how the program draws, analyses and optimises, and which values it solved for.
constexpr std::string_view harmless[] = {
    "NAME", "NOTE", "AUTH", "COMM", "LANG", "PFIL", "VERS", "ENVD", "GFAC", "GCAT", "RAIM", "PUSH", "SDMA", "ROPD", "PICB",
    "FWGN", "FWGT", "VANN", "VDXN", "VDYN", "VCXN", "VCYN", "ZVAN", "ZVDX", "ZVDY", "ZVCX", "ZVCY", "POLS", "GLRS", "GSTD",
    "NSCD", "COFN", "OPDX", "TRAC", "SURF", "FIMP", "HIDE", "MIRR", "SLAB", "POPS", "VDSZ", "PPAR", "VPAR", "PZUP", "CPUP",
    "MEMA", "OEMA", "MAZH", "XDAT", "HYPR", "OMMA", "WWGN", "WWGT", "TOL",  "MOFF", "RCMF", "BLNK", "FLOA", "EERA", "IWDP",
    "LUID", "SSID", "STUD", "FRAM", "DBDT", "SDIA", "CHIP", "UNDO", "CWGT", "WAVN", "XFLD", "YFLD"};

// Apertures other than a circle about the axis.
constexpr std::string_view other_apertures[] = {"SQAP", "SQOB", "ELAP", "ELOB", "OBSC", "SPID", "UDAD", "UDAP", "UDOB", "USAP"};

struct ZmxSurface {
    DrawnSurface drawn;
    std::size_t line = 0;  // of its SURF
    std::string type = "STANDARD";
    bool has_curvature = false, has_distance = false;
    std::array<double, 8> parameters{};  // PARM 1 to 8: of EVENASPH the coefficients of r^2, r^4, ..., r^16
};

// Reads lines one by one, each keyword by its function in the tables of words below; surfaces are checked when all lines are read.
class ZmxReader {
  public:
    ZmxReader(std::string_view all, std::string_view file) : text(all), name(file) {}

    DrawnLens read() {
        for (std::string_view rest = text; !rest.empty(); ++line) read_line(next_foreign_line(rest));
        finish();
        problems.report();
        return std::move(lens);
    }

  private:
    template <class... Values>
    void refuse(std::size_t at, fmt::format_string<Values...> what, Values&&... values) {
        problems.add(fmt::format("{}:{}", name, at), what, std::forward<Values>(values)...);
    }
    std::string here() const { return surfaces.empty() ? std::string() : fmt::format("surface {}: ", surfaces.size() - 1); }

    void read_line(std::string_view content) {
        words = words_of(content);
        if (words.empty()) return;
        const std::string_view key = words[0];
        in_surface = key == "SURF" || (in_surface && (content[0] == ' ' || content[0] == '\t'));
        if (key == "SURF") return begin_surface();
        const bool of_surface =
            std::any_of(std::begin(surface_words), std::end(surface_words), [&](const Word& word) { return word.key == key; });
        if (of_surface && surfaces.empty()) return refuse(line, "{} precedes the first SURF", key);
        for (const Word& word : of_surface ? std::span<const Word>(surface_words) : std::span<const Word>(system_words))
            if (word.key == key) {
                const std::string what =
                    word.times == Times::once_each && words.size() > 1 ? fmt::format("{} {}", key, words[1]) : std::string(key);
                auto& given = of_surface ? given_of_surface : given_of_system;
                if (word.times != Times::any && !given.insert(what).second)
                    return refuse(line, "{}{} is given twice", here(), shortened(what));
                return (this->*word.read)();
            }
        if (std::ranges::find(other_apertures, key) != std::end(other_apertures))
            return refuse(line, "{}{} is an aperture other than a circle about the axis; only such circles can be imported", here(),
                          key);
        // Words after the surfaces are those of the merit function and the tolerances, and are not listed as unread.
        if ((surfaces.empty() || in_surface) && std::ranges::find(harmless, key) == std::end(harmless) && unread.size() < 20)
            unread.push_back(fmt::format("{} (line {})", shortened(key), line));
    }

    void begin_surface() {
        const std::string_view given = words.size() > 1 ? words[1] : "";
        if (whole_text<std::size_t>(given) != surfaces.size()) {
            refuse(line, "SURF {}, where surface {} should begin; a part of the file is missing", shortened(given),
                   surfaces.size());
            problems.report();
        }
        if (surfaces.size() >= most_surfaces_of_zmx) {
            refuse(line, "has more than {} surfaces", most_surfaces_of_zmx);
            problems.report();
        }
        const std::size_t number = surfaces.size();
        surfaces.emplace_back().line = line;
        given_of_surface.clear();
        surfaces.back().drawn.place = fmt::format("{}:{}: surface {}", name, line, number);
    }

    // Returns the number at a position in the line; refuses any other word, or none, and returns 0. Zemax writes decimal commas in
    // some languages.
    double number(std::size_t i) {
        std::string given(i < words.size() ? words[i] : "");
        std::ranges::replace(given, ',', '.');
        const auto value = whole_text<double>(std::string_view(given).substr(given.starts_with('+') ? 1 : 0));
        if (value && std::isfinite(*value)) return *value;
        refuse(line, "{}{} {}", here(), words[0],
               given.empty() ? fmt::format("has {} of its values; the line is cut", i - 1)
                             : fmt::format("\"{}\" is not a finite number", shortened(given)));
        return 0;
    }
    bool has_number(std::size_t i) const { return i < words.size(); }

    ZmxSurface& surface() { return surfaces.back(); }

    void read_type() {
        if (words.size() > 1) surface().type = words[1];
    }
    void read_curvature() {
        surface().drawn.curvature_per_mm = number(1);
        surface().has_curvature = true;
    }
    void read_distance() {
        surface().has_distance = true;
        const bool infinite = words.size() > 1 && words[1] == "INFINITY";
        surface().drawn.distance_mm = infinite ? std::numeric_limits<double>::infinity() : number(1);
    }
    void read_conic() { surface().drawn.conic = number(1); }
    void read_parameter() {
        const double i = number(1), value = number(2);
        if (i >= 1 && i <= 8 && i == std::floor(i))
            surface().parameters[std::size_t(i) - 1] = value;
        else if (value != 0 && surface().type == "EVENASPH")
            refuse(line, "{}PARM {} is not a coefficient; PARM 1 to 8 are", here(), shortened(words[1]));
    }
    void read_stop() { surface().drawn.is_stop = true; }
    // DIAM is the semi-diameter with which the program draws the surface; 0 where nothing determines it.
    void read_diameter() { limit(number(1)); }
    // CLAP and FLAP are circular apertures, "CLAP inner outer"; outside of them light is absorbed.
    void read_aperture() {
        if (number(1) != 0)
            refuse(line, "{}{} has a central obscuration; only full circles can be imported", here(), words[0]);
        else if (const double radius = number(2); radius > 0)
            limit(radius), surface().drawn.is_hole = true;
    }
    void limit(double semi_aperture) {
        std::optional<double>& semi = surface().drawn.semi_aperture_mm;
        if (semi_aperture > 0) semi = std::min(semi.value_or(semi_aperture), semi_aperture);
    }

    // A line is "GLAS name kind from n_d V_d". The numbers of a catalogue's glass are mostly fillers, 1.5 and 40. Kind 1 is a glass
    // of these numbers; 2 is that of another surface, with a name if that has one; 4 is a glass with an offset.
    void read_glass() {
        const std::string_view glass = words.size() > 1 ? words[1] : "";
        const std::string_view kind = words.size() > 2 ? words[2] : "0";
        const bool nameless = glass.empty() || glass.starts_with("___");
        DrawnMedium& medium = surface().drawn.medium;
        if (glass == "MIRROR") return refuse(line, "{}is a mirror; only lenses can be imported", here());
        if (kind == "4") return refuse(line, "{}glass {} has an offset, which is not supported", here(), shortened(glass));
        if (kind != "1" && !(kind == "2" && nameless)) {
            if (nameless) return refuse(line, "{}GLAS names no glass", here());
            medium.glass = glass;
            return;
        }
        medium.nd = number(4);
        if (const double vd = has_number(5) ? number(5) : 0; vd != 0) medium.vd = vd;
    }
    // OBDC x y, and SCBD with an index before its numbers, shift or tilt a surface.
    void read_shift() {
        for (std::size_t i = words[0] == "OBDC" ? 1 : 2; i < words.size(); ++i)
            if (number(i) != 0)
                return refuse(line, "{}{} shifts or tilts it; only lenses about one axis can be imported", here(), words[0]);
    }
    void read_coating() { coated.push_back(surfaces.size() - 1); }

    void read_mode() {
        if (words.size() > 1 && words[1] != "SEQ")
            refuse(line, "MODE {}: only sequential lenses can be imported", shortened(words[1]));
    }
    void read_unit() {
        const std::string_view unit = words.size() > 1 ? words[1] : "";
        if (unit == "MM")
            unit_mm = 1;
        else if (unit == "CM")
            unit_mm = 10;
        else if (unit == "IN" || unit == "INCH")
            unit_mm = 25.4;
        else if (unit == "METER" || unit == "M")
            unit_mm = 1000;
        else
            refuse(line, "UNIT {} is unknown; known are MM, CM, IN and METER", shortened(unit));
    }
    void read_configurations() {
        if (const double count = number(1); count > 1)
            refuse(line, "MNUM {}: has {} configurations, of which only one can be imported; save it alone", count, count);
    }
    void read_pupil() { lens.beam.entrance_pupil_mm = number(1); }
    // FNUM's second number is 1 for the paraxial working f-number.
    void read_f_number() { (words.size() > 2 && words[2] == "1" ? lens.beam.working_f_number : lens.beam.f_number) = number(1); }
    // FTYP is "kind telecentric fields wavelengths ...", where XFLN and YFLN may have more values than there are fields. Kinds are
    // 0, angles, and 1, heights of the object; a chief ray that is telecentric before the lens crosses no pupil there.
    void read_field_type() {
        const std::string_view kind = words.size() > 1 ? words[1] : "";
        field_is_angle = kind == "0";
        field_is_height = kind == "1" && (words.size() < 3 || words[2] == "0");
        if (const double count = has_number(3) ? number(3) : 0; count >= 1) field_count = count;
    }
    void read_fields() {
        fields.resize(std::max(fields.size(), words.size() - 1));
        for (std::size_t i = 1; i < words.size(); ++i) fields[i - 1][words[0] == "XFLN" ? 0 : 1] = number(i);
    }
    void read_wavelength() {
        const double i = number(1), wavelength_um = number(2);
        if (i >= 1 && i <= 24) wavelengths_um[std::size_t(i) - 1] = wavelength_um;
    }
    void read_primary() {
        const double i = number(1);
        if (i >= 1 && i <= 24) primary = std::size_t(i) - 1;
    }
    void read_title() {
        for (std::size_t i = 1; i < words.size(); ++i) lens.title += (i > 1 ? " " : "") + std::string(words[i]);
    }

    enum class Times { any, once, once_each };  // once_each: for each number that follows the word
    struct Word {
        std::string_view key;
        void (ZmxReader::*read)();
        Times times;  // that a surface, or the lens, may have the word
    };
    static constexpr Word surface_words[] = {
        {"TYPE", &ZmxReader::read_type, Times::once},           {"CURV", &ZmxReader::read_curvature, Times::once},
        {"DISZ", &ZmxReader::read_distance, Times::once},       {"CONI", &ZmxReader::read_conic, Times::once},
        {"PARM", &ZmxReader::read_parameter, Times::once_each}, {"STOP", &ZmxReader::read_stop, Times::any},
        {"DIAM", &ZmxReader::read_diameter, Times::any},        {"CLAP", &ZmxReader::read_aperture, Times::any},
        {"FLAP", &ZmxReader::read_aperture, Times::any},        {"GLAS", &ZmxReader::read_glass, Times::once},
        {"OBDC", &ZmxReader::read_shift, Times::any},           {"SCBD", &ZmxReader::read_shift, Times::any},
        {"COAT", &ZmxReader::read_coating, Times::any},
    };
    static constexpr Word system_words[] = {
        {"MODE", &ZmxReader::read_mode, Times::any},
        {"UNIT", &ZmxReader::read_unit, Times::once},
        {"MNUM", &ZmxReader::read_configurations, Times::any},
        {"ENPD", &ZmxReader::read_pupil, Times::once},
        {"FNUM", &ZmxReader::read_f_number, Times::once},
        {"FTYP", &ZmxReader::read_field_type, Times::once},
        {"XFLN", &ZmxReader::read_fields, Times::once},
        {"YFLN", &ZmxReader::read_fields, Times::once},
        {"WAVM", &ZmxReader::read_wavelength, Times::once_each},
        {"PWAV", &ZmxReader::read_primary, Times::once},
        {"NAME", &ZmxReader::read_title, Times::any},
    };

    // Checks what can be checked only when all lines are read, and makes the lens.
    void finish() {
        if (surfaces.empty()) {
            refuse(1, "is not a lens in Zemax's format: no line begins with SURF");
            return;
        }
        // A file that Zemax wrote continues after its surfaces; one that ends within them, and within a line, is cut.
        const bool cut_line = in_surface && !text.ends_with('\n') && !text.ends_with('\r');
        if (cut_line && text.starts_with("VERS")) refuse(line - 1, "ends in the middle of this line; the file is cut");
        for (ZmxSurface& s : surfaces) finish_surface(s, &s - surfaces.data());
        if (const ZmxSurface& last = surfaces.back(); last.has_distance && last.drawn.distance_mm != 0)
            refuse(last.line, "ends with surface {}, which is not the image: another one follows at DISZ {}; the file is cut",
                   surfaces.size() - 1, last.drawn.distance_mm);
        else if (surfaces.size() < 3)
            refuse(last.line, "has {}; a lens needs an object, an image and surfaces between them",
                   counted(surfaces.size(), "surface"));
        // Notes on what was assumed or not read.
        if (unit_mm == 0) lens.notes.push_back("The file names no unit of length; taken as mm.");
        if (cut_line && !text.starts_with("VERS"))
            lens.notes.push_back("The file's last line has no end; if it was cut there, something may be missing.");
        if (!coated.empty())
            lens.notes.push_back(
                fmt::format("The coatings of surfaces {} are not read: all glass is bare.", fmt::join(coated, ", ")));
        if (!unread.empty())
            lens.notes.push_back(fmt::format("Words that are unknown and were not read: {}.", fmt::join(unread, ", ")));
        // The beam, and the surfaces in mm.
        double slope = 0, height = 0;
        for (std::size_t i = 0; i < fields.size() && double(i) < field_count; ++i) {
            slope = std::max(slope, slope_of_field(fields[i][0], fields[i][1]));
            height = std::max(height, std::hypot(fields[i][0], fields[i][1]));
        }
        if (field_is_angle) lens.beam.field_slope = slope;
        if (field_is_height) lens.beam.object_height_mm = height;
        if (wavelengths_um[primary] > 0) lens.beam.wavelength_nm = wavelengths_um[primary] * 1000;
        for (ZmxSurface& s : surfaces) lens.surfaces.push_back(std::move(s.drawn));
        if (unit_mm != 0 && unit_mm != 1) scale(lens, unit_mm);
    }

    void finish_surface(ZmxSurface& s, std::ptrdiff_t number) {
        if (s.type != "STANDARD" && s.type != "EVENASPH")
            return refuse(s.line, "surface {} is of type {}, which cannot be imported; STANDARD and EVENASPH can", number,
                          shortened(s.type));
        if (!s.has_curvature || !s.has_distance)
            return refuse(s.line, "surface {} has no {}; the file is cut, or a part of it is missing", number,
                          s.has_curvature ? "DISZ" : "CURV");
        if (s.type == "STANDARD") return;
        s.drawn.even_asphere.assign(s.parameters.begin() + 1, s.parameters.end());
        while (!s.drawn.even_asphere.empty() && s.drawn.even_asphere.back() == 0) s.drawn.even_asphere.pop_back();
        if (!fold_r2(s.drawn, s.parameters[0]))
            refuse(s.line,
                   "surface {} has PARM 1 = {}, a term in r^2 beside the conic constant {}, which surfaces here do not have",
                   number, s.parameters[0], s.drawn.conic);
    }

    std::string_view text;
    std::string name;
    std::size_t line = 1;
    bool in_surface = false;              // the line belongs to a surface: it is SURF or indented after one
    std::vector<std::string_view> words;  // of the line
    std::vector<ZmxSurface> surfaces;
    std::set<std::string> given_of_surface, given_of_system;  // words of the surface and of the lens so far that may be given once
    double unit_mm = 0;                                       // 0: not given
    std::array<double, 24> wavelengths_um{};
    std::size_t primary = 0;
    bool field_is_angle = false, field_is_height = false;
    double field_count = std::numeric_limits<double>::infinity();
    std::vector<std::array<double, 2>> fields;  // x and y of each: degrees, or heights
    std::vector<std::size_t> coated;            // numbers of surfaces with coatings
    std::vector<std::string> unread;            // unknown keywords, with their lines
    DrawnLens lens;
    Problems problems{Problems::most_of_a_file};
};

// Returns the bytes with a byte order mark before UTF-16 that has none: it is recognised by the zero byte of its first letter.
std::string marked(std::string_view bytes) {
    const bool little = bytes.size() > 1 && bytes[0] != 0 && bytes[1] == 0,
               big = bytes.size() > 1 && bytes[0] == 0 && bytes[1] != 0;
    return (little ? "\xff\xfe" : big ? "\xfe\xff" : "") + std::string(bytes);
}

}  // namespace

DrawnLens parse_zmx(std::string_view bytes, std::string_view name) { return ZmxReader(to_utf8(marked(bytes)), name).read(); }

}  // namespace lfdsim
