#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "files/drawn_lens.h"
#include "files/nearest.h"
#include "files/text_file.h"

// Optiland's .json: what the `to_dict()` of its Optic gives. Lengths are in mm, wavelengths in micrometres; a surface stands at its
// own place in a frame whose z is the axis.
namespace lfdsim {
namespace {

using OptilandJson = nlohmann::json;

constexpr std::size_t most_problems_of_optiland = 20, most_surfaces_of_optiland = 1000;

// Python writes Infinity and NaN, which JSON has not. They become words of the same length, so that places in messages stay right.
std::string without_bare_words(std::string text) {
    bool inside = false;  // a string
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\\' && inside) {
            ++i;
        } else if (text[i] == '"') {
            inside = !inside;
        } else if (!inside) {
            for (const auto& [word, replacement] :
                 {std::pair{"-Infinity", "\"-Infin.\""}, {"Infinity", "\"Infin.\""}, {"NaN", "\"N\""}})
                if (text.compare(i, std::string_view(word).size(), word) == 0)
                    text.replace(i, std::string_view(word).size(), replacement);
            if (text[i] == '"') inside = true;
        }
    }
    return text;
}

class OptilandReader {
  public:
    explicit OptilandReader(std::string_view file) : name(file) {}

    DrawnLens read(const OptilandJson& json) {
        const OptilandJson& surfaces = at(at(json, "surface_group"), "surfaces");
        if (!surfaces.is_array() || surfaces.size() < 3 || surfaces.size() > most_surfaces_of_optiland)
            throw InputError(
                name, fmt::format("surface_group.surfaces is no list of 3 to {} surfaces: is this a lens that Optiland saved?",
                                  most_surfaces_of_optiland));
        for (std::size_t i = 0; i < surfaces.size(); ++i) read_surface(surfaces[i], i);
        for (std::size_t i = 0; i + 1 < surfaces.size(); ++i) lens.surfaces[i].distance_mm = z_mm[i + 1] - z_mm[i];
        if (at(json, "name").is_string()) lens.title = at(json, "name").get<std::string>();
        read_beam(json);
        if (!coated.empty())
            lens.notes.push_back(fmt::format("The coatings of surfaces {} are not read: all glass is bare.", coated));
        if (!problems.empty()) throw InputError(std::move(problems));
        return std::move(lens);
    }

  private:
    template <class... Values>
    void refuse(const std::string& place, fmt::format_string<Values...> what, Values&&... values) {
        problems.push_back({fmt::format("{}: {}", name, place), fmt::format(what, std::forward<Values>(values)...)});
        if (problems.size() >= most_problems_of_optiland) throw InputError(std::move(problems));
    }

    // A member of an object; null if it is absent.
    static const OptilandJson& at(const OptilandJson& json, const char* key) {
        static const OptilandJson nothing;
        const auto found = json.is_object() ? json.find(key) : json.end();
        return json.is_object() && found != json.end() ? *found : nothing;
    }
    static bool is_true(const OptilandJson& json) { return json.is_boolean() && json.get<bool>(); }
    static std::string word(const OptilandJson& json) {
        return json.is_string() ? json.get<std::string>() : json.dump(-1, ' ', true, OptilandJson::error_handler_t::replace);
    }

    double number(const OptilandJson& json, const std::string& place, bool may_be_infinite = false) {
        if (json.is_number()) return json.get<double>();  // the parser refuses infinite ones
        if (may_be_infinite && json == "Infin.") return std::numeric_limits<double>::infinity();
        if (may_be_infinite && json == "-Infin.") return -std::numeric_limits<double>::infinity();
        refuse(place, "{}", json.is_null() ? "is missing" : shortened(word(json)) + " is not a finite number");
        return 0;
    }

    void read_surface(const OptilandJson& json, std::size_t i) {
        const std::string place = fmt::format("surface_group.surfaces[{}]", i);
        DrawnSurface& s = lens.surfaces.emplace_back();
        s.place = fmt::format("{}: {}", name, place);
        const std::string type = word(at(json, "type"));
        if (type != "Surface" && type != "ObjectSurface" && type != "ImageSurface")
            refuse(place, "is of type {}, which cannot be imported; Surface can", shortened(type));
        read_place(at(at(json, "geometry"), "cs"), place + ".geometry.cs", i == 0);
        read_shape(at(json, "geometry"), place + ".geometry", s);
        read_medium(at(json, "material_post"), place + ".material_post", s.medium);
        read_aperture(at(json, "aperture"), place + ".aperture", s);
        s.is_stop = is_true(at(json, "is_stop"));
        const OptilandJson& acts = at(json, "interaction_model");
        if (is_true(at(json, "is_reflective")) || is_true(at(acts, "is_reflective")))
            refuse(place, "is a mirror; only lenses can be imported");
        if (!acts.is_null() && at(acts, "type") != "RefractiveReflectiveModel" && at(acts, "type") != "refractive_reflective")
            refuse(place, "acts as a {}; only refraction can be imported", shortened(word(at(acts, "type"))));
        if (!at(acts, "bsdf").is_null() || !at(json, "bsdf").is_null())
            refuse(place, "scatters light; only refraction can be imported");
        if (!at(acts, "coating").is_null() || !at(json, "coating").is_null())
            coated += fmt::format("{}{}", coated.empty() ? "" : ", ", i);
    }

    void read_place(const OptilandJson& frame, const std::string& place, bool is_object) {
        for (const char* key : {"x", "y", "rx", "ry"})
            if (const double shift = number(at(frame, key), place + "." + key); shift != 0)
                refuse(place, "{} = {}: is shifted or tilted; only lenses about one axis can be imported", key, shift);
        if (!at(frame, "reference_cs").is_null()) refuse(place, "has a reference_cs; only lenses about one axis can be imported");
        z_mm.push_back(number(at(frame, "z"), place + ".z", is_object));
    }

    void read_shape(const OptilandJson& shape, const std::string& place, DrawnSurface& s) {
        const std::string type = word(at(shape, "type"));
        if (type == "Plane") return;
        if (type != "StandardGeometry" && type != "EvenAsphere")
            return refuse(place, "is of type {}, which cannot be imported; Plane, StandardGeometry and EvenAsphere can",
                          shortened(type));
        const double radius = number(at(shape, "radius"), place + ".radius", true);
        if (radius == 0) refuse(place + ".radius", "is 0");
        s.curvature_per_mm = radius == 0 ? 0 : 1 / radius;
        if (!at(shape, "conic").is_null()) s.conic = number(at(shape, "conic"), place + ".conic");
        if (type == "StandardGeometry") return;
        const OptilandJson& terms = at(shape, "coefficients");
        if (!terms.is_array() || terms.size() > 100) return refuse(place + ".coefficients", "is no list of numbers");
        for (std::size_t k = 1; k < terms.size(); ++k)
            s.even_asphere.push_back(number(terms[k], fmt::format("{}.coefficients[{}]", place, k)));
        while (!s.even_asphere.empty() && s.even_asphere.back() == 0) s.even_asphere.pop_back();
        if (const double a2 = terms.empty() ? 0 : number(terms[0], place + ".coefficients[0]"); !fold_r2(s, a2))
            refuse(place + ".coefficients[0]", "is {}, a term in r^2 beside a conic of constant {}, which no surface here has", a2,
                   s.conic);
    }

    void read_medium(const OptilandJson& material, const std::string& place, DrawnMedium& medium) {
        const std::string type = word(at(material, "type"));
        if (type == "Material") {
            medium.glass = at(material, "name").is_string() ? at(material, "name").get<std::string>() : "";
            if (medium.glass.empty()) refuse(place, "has no name");
        } else if (type == "IdealMaterial" || type == "AbbeMaterial") {
            medium.nd = number(at(material, "index"), place + ".index");
            if (type == "AbbeMaterial") medium.vd = number(at(material, "abbe"), place + ".abbe");
        } else {
            refuse(place, "is of type {}, which cannot be imported; Material, IdealMaterial and AbbeMaterial can", shortened(type));
        }
    }

    void read_aperture(const OptilandJson& aperture, const std::string& place, DrawnSurface& s) {
        if (aperture.is_null()) return;
        if (at(aperture, "type") != "RadialAperture")
            return refuse(place, "is of type {}, which cannot be imported; RadialAperture can",
                          shortened(word(at(aperture, "type"))));
        if (number(at(aperture, "r_min"), place + ".r_min") != 0)
            refuse(place, "has a dark middle; only whole circles can be imported");
        if (const double radius = number(at(aperture, "r_max"), place + ".r_max", true); std::isfinite(radius))
            s.semi_aperture_mm = radius, s.is_hole = true;
    }

    void read_beam(const OptilandJson& json) {
        const OptilandJson& aperture = at(json, "aperture");
        const std::string type = word(at(aperture, "type"));
        if (type == "EPD") lens.beam.entrance_pupil_mm = number(at(aperture, "value"), "aperture.value");
        if (type == "imageFNO") lens.beam.f_number = number(at(aperture, "value"), "aperture.value");
        if (type == "float_by_stop_size")
            for (DrawnSurface& s : lens.surfaces)
                if (s.is_stop && !s.semi_aperture_mm) s.semi_aperture_mm = number(at(aperture, "value"), "aperture.value") / 2;
        const OptilandJson& fields = at(json, "fields");
        const OptilandJson& kind = at(at(fields, "field_definition"), "field_type");
        if (kind == "AngleField" || at(fields, "field_type") == "angle")
            for (const OptilandJson& field : at(fields, "fields"))
                lens.beam.field_deg = std::max({lens.beam.field_deg.value_or(0), std::abs(number(at(field, "x"), "fields")),
                                                std::abs(number(at(field, "y"), "fields"))});
        for (const OptilandJson& wave : at(at(json, "wavelengths"), "wavelengths"))
            if (is_true(at(wave, "is_primary")) && at(wave, "unit") == "um")
                lens.beam.wavelength_nm = number(at(wave, "value"), "wavelengths") * 1000;
    }

    std::string name;
    std::vector<double> z_mm;
    std::string coated;
    DrawnLens lens;
    std::vector<Problem> problems;
};

}  // namespace

DrawnLens parse_optiland(std::string_view text, std::string_view name) {
    if (text.size() > largest_text_bytes)
        throw InputError(std::string(name), fmt::format("has {} bytes, allowed are {}", text.size(), largest_text_bytes));
    try {
        return OptilandReader(name).read(OptilandJson::parse(without_bare_words(std::string(text))));
    } catch (const OptilandJson::parse_error& error) {
        const std::string says = error.what();  // "[json.exception.parse_error.101] parse error at line 1, column 1: ..."
        const std::size_t begin = says.find("] ") + 2, end = std::min(says.find("; last read"), begin + 160);
        throw InputError(std::string(name), "is no lens in Optiland's format: " + says.substr(begin, end - begin));
    }
}

}  // namespace lfdsim
