#include "files/lenses/agf.h"

#include "base/printable.h"
#include "base/problems.h"
#include "base/whole_text.h"
#include "files/description/decode.h"
#include "files/description/nearest.h"
#include "files/description/text_file.h"

#include <fmt/format.h>
#include <cmath>
#include <optional>

namespace lfdsim {
namespace {

constexpr double nd_tolerance = 1e-4;  // printed values are rounded, some to four digits
constexpr std::size_t longest_glass_name = 64;

// AGF is a text of lines that begin with a word of two letters. Read are "NM name formula code n_d V_d ...", which begins a glass,
// "CD c0 c1 ..." with the coefficients of its formula, and "LD low high", the wavelengths in micrometres for which they hold.

/// Returns the finite number that the whole word is; nothing if it is none.
std::optional<double> number(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    const std::optional<double> value = whole_text<double>(word);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

/// A glass as its lines give it.
struct AgfGlass {
    std::string name;
    std::size_t line = 0;  // of its name
    int formula = 0;
    double nd = 0;                 // as printed; 1 or less: not given
    std::vector<double> c;         // of line CD; coefficients that are missing count as zero
    std::vector<double> range_um;  // of line LD
};

/// Returns pairs of a coefficient and its power of the wavelength, as Formula::power_series has them.
std::vector<double> with_powers(const std::vector<double>& c, std::initializer_list<double> powers) {
    std::vector<double> pairs;
    for (std::size_t k = 0; k < powers.size(); ++k) pairs.insert(pairs.end(), {c[k], powers.begin()[k]});
    return pairs;
}

/// Sets a glass's formula and coefficients by the number of AGF's formula (docs/model.md, "Colour"), which is 1 to 13. `e` has ten
/// coefficients or more.
void set_formula(const AgfGlass& e, Glass& glass) {
    const auto first = [&](Formula formula, std::size_t count) {
        glass.formula = formula;
        glass.coefficients.assign(e.c.begin(), e.c.begin() + std::ptrdiff_t(count));
    };
    const auto powers = [&](std::initializer_list<double> all) {
        glass.formula = Formula::power_series;
        glass.coefficients = with_powers(e.c, all);
    };
    switch (e.formula) {
        case 1:
            return powers({0, 2, -2, -4, -6, -8});
        case 2:
            return first(Formula::sellmeier, 6);
        case 3:
            return first(Formula::herzberger, 6);
        case 4:
            return first(Formula::sellmeier_2, 5);
        case 5:
            return first(Formula::conrady, 3);
        case 6:
            return first(Formula::sellmeier, 8);
        case 7:
            return first(Formula::handbook_1, 4);
        case 8:
            return first(Formula::handbook_2, 4);
        case 9:
            return first(Formula::resonances, 5);
        case 10:
            return powers({0, 2, -2, -4, -6, -8, -10, -12});
        case 11:
            return first(Formula::sellmeier, 10);
        case 12:
            return powers({0, 2, -2, -4, -6, -8, 4, 6});
        case 13:
            return powers({0, 2, 4, -2, -4, -6, -8, -10, -12});
        default:
            return;
    }
}

class AgfReader {
  public:
    explicit AgfReader(std::string_view name) { read_.file = name; }

    GlassCatalogue read(std::string_view text) {
        for (; !text.empty(); ++line_) read_line(next_foreign_line(text));
        finish();
        if (problems_.empty() && !names_) problems_.add({read_.file, "has no line NM with a glass, which an AGF catalogue has"});
        problems_.report();
        return std::move(read_);
    }

  private:
    std::string place(std::size_t line) const { return fmt::format("{}:{}", read_.file, line); }
    template <class... Values>
    void refuse(std::string_view key, fmt::format_string<Values...> what, Values&&... values) {
        problems_.add(place(line_), "{}: {}", key, fmt::format(what, std::forward<Values>(values)...));
    }
    /// Adds a doubt about the glass that finish() examines.
    void doubt(const std::string& glass, const std::string& what) {
        read_.doubts.push_back({glass, {place(entry_.line), fmt::format("{}{}", shortened(glass), what)}});
    }

    void read_line(std::string_view line) {
        const std::vector<std::string_view> words = words_of(line);
        if (words.empty()) return;
        if (words[0] == "NM") return begin(words);
        if (words[0] == "CD" || words[0] == "LD") {
            if (!names_) return refuse(words[0], "precedes the first glass, which begins with a line NM");
            (words[0] == "CD" ? entry_.c : entry_.range_um) = numbers(words);
        }
    }

    /// Returns all words but the first as numbers.
    std::vector<double> numbers(const std::vector<std::string_view>& words) {
        std::vector<double> all;
        for (std::size_t k = 1; k < words.size(); ++k) {
            const auto value = number(words[k]);
            if (!value) {
                refuse(words[0], "\"{}\" is not a number", shortened(words[k]));
                break;
            }
            all.push_back(*value);
        }
        return all;
    }

    void begin(const std::vector<std::string_view>& words) {
        finish();
        entry_ = {};
        entry_.line = line_;
        if (++names_ > most_glasses) return refuse("NM", "is more than the {} glasses allowed", most_glasses);
        if (words.size() < 3) return refuse("NM", "needs a name and the number of a formula");
        if (words[1].size() > longest_glass_name)
            return refuse("NM", "\"{}\" is longer than the {} bytes allowed", shortened(words[1]), longest_glass_name);
        entry_.name = words[1];
        const auto formula = number(words[2]);  // some catalogues write 2.0
        if (!formula) return refuse("NM", "\"{}\" is not the number of a formula", shortened(words[2]));
        if (*formula >= 1 && *formula <= 13 && *formula == std::floor(*formula)) entry_.formula = int(*formula);
        if (words.size() > 4) entry_.nd = number(words[4]).value_or(0);
    }

    /// Adds the glass whose lines have ended to the catalogue, or a doubt why it is left out. A glass is kept only if its index in
    /// the middle of its range is a number.
    void finish() {
        if (entry_.name.empty() || !problems_.empty()) return;
        Glass glass;
        glass.name = std::move(entry_.name);
        const auto leave_out = [&](const char* why) { doubt(glass.name, fmt::format(" is left out: {}", why)); };
        if (entry_.formula == 0) return leave_out("the format has formulas 1 to 13");
        if (entry_.c.empty()) return leave_out("it has no line CD with coefficients");
        entry_.c.resize(std::max<std::size_t>(entry_.c.size(), 10), 0);
        set_formula(entry_, glass);
        if (entry_.range_um.size() < 2 || !(0 < entry_.range_um[0] && entry_.range_um[0] < entry_.range_um[1]))
            return leave_out("it has no line LD with two wavelengths");
        glass.range_nm = {1000 * entry_.range_um[0], 1000 * entry_.range_um[1]};
        const double middle_nm = (glass.range_nm[0] + glass.range_nm[1]) / 2;
        if (!(index_of(glass, middle_nm) > 0 && std::isfinite(index_of(glass, middle_nm))))
            return leave_out("its coefficients give no index");
        if (const double nd = index_of(glass, d_line_nm);
            entry_.nd > 1 && glass.covers(d_line_nm) && !(std::abs(nd - entry_.nd) <= nd_tolerance))
            doubt(glass.name, fmt::format(": n_d is {:.6g} by its coefficients, {:.6g} by its line NM", nd, entry_.nd));
        read_.glasses.push_back(std::move(glass));
    }

    GlassCatalogue read_;
    Problems problems_{Problems::most_of_a_file};
    AgfGlass entry_;  // the glass whose lines are being read; without a name before the first
    std::size_t line_ = 1, names_ = 0;
};

}  // namespace

GlassCatalogue parse_agf(std::string_view bytes, std::string_view name) {
    if (bytes.size() > largest_agf_bytes)
        throw InputError(std::string(name),
                         fmt::format("has {} bytes, allowed are {}; is this a glass catalogue?", bytes.size(), largest_agf_bytes));
    const std::string text = to_utf8(bytes);
    if (text.find('\0') != text.npos) throw InputError(std::string(name), "is a binary file, not a glass catalogue in AGF");
    return AgfReader(name).read(text);
}

GlassCatalogue read_agf(const std::filesystem::path& path) {
    return parse_agf(read_text(path, "a glass catalogue", largest_agf_bytes), path.string());
}

}  // namespace lfdsim
